#include "peers/pov.h"

#include "engine/scene.h"
#include "model/vec.h"
#include "peers/cell.h"
#include "peers/pov_mesh.h"
#include "peers/pov_surface.h"
#include "peers/text.h"

#include <algorithm>
#include <cmath>

// How POV-Ray follows light. A ray keeps a list of the media that it is in. Where it meets a shape whose medium is in the list, it
// leaves that medium; otherwise it enters it, from the medium it met last. So in `clear` and `plate`, where all faces of one glass
// share its medium, entering and leaving alternate, in whatever order the faces are met. In `opaque`, where each surface is met
// once, each surface has the medium behind it, even if that is air.
//
// Shapes that share a medium have to be parts of one union; copies of a shape have media of their own. POV-Ray ignores
// intersections closer than 1e-3 units to the ray's start: so a lens is 120 units wide.
namespace lfdsim::peers {
namespace {

constexpr double gap_pitches = 2.5e-5;  // between a square body and its cell's border: half the gap between bodies that would touch
constexpr double overlap_mm = 1e-6;     // of flat parts of neighbouring cells
constexpr double longest_units = 4e6;   // POV-Ray sees nothing beyond 1e7

std::string black() { return "texture { Black }"; }
std::string medium(double index) { return fmt::format("texture {{ Clear }} interior {{ ior {} }}", text(index)); }

class Writer {
  public:
    Writer(const Display& d, const Geometry& g, const PeerOptions& o)
        : d_(d),
          g_(g),
          lattice_(g.lattice),
          half_{d.array.pitch_mm[0] / 2, d.array.pitch_mm[1] / 2},
          gap_mm_(gap_pitches * d.array.pitch_mm.least()),
          options_(o) {}

    std::string scene(const std::vector<std::string>& head, const std::string& panel_file) const {
        const bool one_sheet = d_.array.surround == Surround::plate;
        std::string all = comment("//", head);
        all += fmt::format(
            "#version 3.7;\nglobal_settings {{ assumed_gamma 1.0 max_trace_level {} adc_bailout 0 }}\nbackground {{ rgb 0 }}\n",
            trace_levels());
        all += camera();
        all += fmt::format(
            "#declare Black = texture {{ pigment {{ rgb 0 }} finish {{ ambient 0 diffuse 0 }} }}\n"
            "#declare Clear = texture {{ pigment {{ rgbt 1 }} finish {{ ambient 0 diffuse 0{} }} }}\n",
            fresnel() ? " reflection { 0, 1 fresnel on } conserve_energy" : "");
        // POV-Ray's rows and columns of a matrix: images of the axes, then the shift
        all += fmt::format("#declare Place = transform {{ matrix <{},{},0,{},{},0,0,0,1,{},{},0> scale {} }}\n",
                           text(lattice_.cos_turn), text(lattice_.sin_turn), text(-lattice_.sin_turn), text(lattice_.cos_turn),
                           text(lattice_.offset[0]), text(lattice_.offset[1]), text(units_per_mm()));
        all += panel(panel_file) + "\n// One lens, about the z axis\n";
        all += "#declare Lens = " + (options_.triangles ? meshed_lens() : lens()) + "\n";
        all += one_sheet ? sheet() : lenses();
        return all;
    }

    // POV-Ray ignores intersections closer than this to a ray's start.
    double least_way_mm() const { return 1e-3 / units_per_mm(); }

    bool fresnel() const { return d_.render.fresnel == Fresnel::exact; }

    // Hits on the way: all surfaces once and the panel, or up to 16 surfaces and the panel.
    int trace_levels() const { return d_.array.surround == Surround::opaque ? int(g_.surfaces.size()) + 1 : 17; }

  private:
    double units_per_mm() const {
        return std::min(120 / d_.array.pitch_mm.least(), longest_units / (length(d_.camera.position_mm) + sheet_half(d_, g_)));
    }

    std::string camera() const {
        const optics::View view = make_view(d_, g_);
        const double u = units_per_mm(), width = view.pixel_mm * view.width, height = view.pixel_mm * view.height;
        double at[3], right[3], up[3];
        for (int k = 0; k < 3; ++k) {
            at[k] = view.position[k] * u;
            right[k] = view.right[k] * width / view.distance;
            up[k] = view.up[k] * height / view.distance;
        }
        return fmt::format("camera {{ location {} direction {} right {} up {} }}\n", vector(at), vector(view.forward),
                           vector(right), vector(up));
    }

    std::string panel(const std::string& file) const {
        const double w = g_.panel_width_mm, h = g_.panel_height_mm;
        return fmt::format(
            "plane {{ z, 0\n  pigment {{ image_map {{ png \"{}\" gamma 1.0 map_type 0 once }} scale {} translate {} }}\n"
            "  finish {{ ambient 0 diffuse 0 emission 1 }}\n  scale {}{} }}\n",
            file, vector(w, h, 1), vector(-w / 2, -h / 2, 0), text(units_per_mm()), fresnel() ? " no_reflection" : "");
    }

    std::string cell_box(double low, double high, double wider) const {
        const double x = half_[0] + wider, y = half_[1] + wider;
        return fmt::format("box {{ {}, {} }}", vector(-x, -y, low), vector(x, y, high));
    }
    // In a union of all lenses each needs a bounding box; POV-Ray gives one to lenses that are separate objects.
    std::string cell_bounds() const {
        if (d_.array.surround != Surround::plate) return "";
        double low = g_.base_z_mm, high = g_.top_z_mm;
        if (d_.lens.stop_radius_mm) low = std::min(low, g_.stop_z_mm), high = std::max(high, g_.stop_z_mm);
        return fmt::format("  bounded_by {{ {} }}\n", cell_box(low - 0.01, high + 0.01, 0.01));
    }

    double widest_half() const { return std::max(half_[0], half_[1]); }

    // Whether a cell has room beside a hole of this radius.
    bool beside_hole(double radius) const { return radius < outer_radius_mm(d_.array); }

    // The flat part of the cell outside a circle.
    std::string ring(double z, double radius, const std::string& matter) const {
        return fmt::format("  disc {{ {}, z, {}, {} clipped_by {{ {} }} {} }}\n", vector(0, 0, z),
                           text(1.06 * outer_radius_mm(d_.array)), text(radius), cell_box(z - 1, z + 1, overlap_mm), matter);
    }
    // The flat part outside the array.
    std::string beside(double z, const std::string& matter) const {
        const auto [x, y] = array_half(g_);
        return fmt::format("disc {{ {}, z, {} clipped_by {{ box {{ {}, {} inverse }} }} {}", vector(0, 0, z),
                           text(100 * sheet_half(d_, g_)), vector(-x, -y, z - 1), vector(x, y, z + 1), matter);
    }

    std::string face(const PlacedSurface& s) const {
        return fmt::format("disc {{ {}, z, {} ", vector(0, 0, s.z_mm), text(100 * sheet_half(d_, g_)));
    }

    // A stop in the plane of a flat face is placed in front of it.
    double before_faces(double z) const {
        for (const PlacedSurface& s : g_.surfaces)
            if (is_plane(s) && std::abs(s.z_mm - z) < gap_mm_) z = s.z_mm + gap_mm_;
        return z;
    }

    std::string lens() const {
        std::string parts;
        const auto& surfaces = g_.surfaces;
        for (const Ring& r : stop_rings(d_, g_)) parts += ring(before_faces(r.z_mm), r.radius_mm, black());
        if (d_.array.surround == Surround::clear) {
            if (parts.empty()) return body();
            parts += body();
        } else if (d_.array.surround == Surround::plate) {
            for (const PlacedSurface& s : surfaces) {
                if (is_plane(s)) continue;
                parts += "  " + pov_skin(s, d_.array) + " }\n";
                if (beside_hole(s.semi_aperture_mm)) parts += ring(rim_z(s), s.semi_aperture_mm, "");
            }
        } else {
            for (const PlacedSurface& s : surfaces) parts += "  " + pov_skin(s, d_.array) + " " + medium(s.index_below) + " }\n";
            parts += black_parts();
        }
        return fmt::format("union {{\n{}{}}}", parts, cell_bounds());
    }

    std::string black_parts() const {
        std::string parts;
        double widest = 0, low = INFINITY, high = -INFINITY;
        for (const PlacedSurface& s : g_.surfaces) {
            widest = std::max(widest, s.semi_aperture_mm);
            low = std::min(low, rim_z(s));
            high = std::max(high, rim_z(s));
        }
        for (const Ring& r : black_rings(d_, g_))
            if (beside_hole(r.radius_mm)) parts += ring(r.z_mm, r.radius_mm, black());
        if (d_.array.aperture == Aperture::circle) {
            if (high > low + 1e-6)
                parts += fmt::format("  cylinder {{ {}, {}, {} open {} }}\n", vector(0, 0, low), vector(0, 0, high), text(widest),
                                     black());
            return parts;
        }
        // Black walls on the cell's borders: between the rims, and up to the glass there
        if (high > low + 1e-6)
            parts += fmt::format("  difference {{ {} {} {} }}\n", cell_box(low, high, overlap_mm),
                                 cell_box(low - 1, high + 1, -gap_mm_), black());
        const double z0 = g_.base_z_mm - 1, z1 = g_.top_z_mm + 1, reach = widest_half() + 2 * gap_mm_;
        parts += fmt::format("  intersection {{ {} {} {} {} {} }}\n", cell_box(z0, z1, overlap_mm),
                             "object { " + cell_box(z0 - 1, z1 + 1, -gap_mm_) + " inverse }",
                             pov_space(g_.surfaces.front(), true, reach, z0 - 1, z1 + 1),
                             pov_space(g_.surfaces.back(), false, reach, z0 - 1, z1 + 1), black());
        return parts;
    }

    // One closed body of glass.
    std::string body() const {
        const PlacedSurface &lower = g_.surfaces.front(), &upper = g_.surfaces.back();
        const bool filled = d_.array.aperture == Aperture::cell;
        const double low = g_.base_z_mm - 0.01, high = g_.top_z_mm + 0.01, r = upper.semi_aperture_mm;
        const std::string round = fmt::format("cylinder {{ {}, {}, {} }}", vector(0, 0, low), vector(0, 0, high), text(r));
        const double reach = (filled ? widest_half() : r) + 0.01;
        std::string sides = filled ? cell_box(low, high, -gap_mm_) : round;
        if (filled && beside_hole(r)) sides += " " + round;
        return fmt::format("  intersection {{ {}\n    {}\n    {}\n    {} }}\n", sides,
                           pov_space(lower, true, reach, low - 1, high + 1), pov_space(upper, false, reach, low - 1, high + 1),
                           medium(lower.index_above));
    }

    // The same lens as triangles; copies share each patch's mesh.
    std::string meshed_lens() const {
        const MeshedArray made = mesh_array(d_, g_, *options_.triangles);
        const bool opaque = d_.array.surround == Surround::opaque;
        std::string glass, blacks;
        for (const Patch& patch : made.cell) {
            const double below = patch.normals[2] > 0 ? patch.index_back : patch.index_front;
            const std::string matter = patch.black ? black() : opaque ? medium(below) : "";
            (patch.black ? blacks : glass) +=
                pov_mesh(patch, !patch.black && options_.normals == MeshNormals::smooth) + " " + matter + " }\n";
        }
        if (d_.array.surround == Surround::clear)
            glass = fmt::format("union {{\n{}{} }}\n", glass, medium(g_.surfaces.front().index_above));
        return fmt::format("union {{\n{}{}  translate {}\n{}}}", glass, blacks, vector(0, 0, g_.base_z_mm), cell_bounds());
    }

    std::string lenses() const {
        const std::string flag = fresnel() ? " no_reflection" : "";
        std::string all = fmt::format(
            "#for (J, 0, {1}) #for (I, 0, {0})\n  object {{ Lens translate <(I - {2}) * {4}, (J - {3}) * {6}, 0> transform {{ "
            "Place "
            "}}{5} }}\n#end #end\n",
            lattice_.count[0] - 1, lattice_.count[1] - 1, text(0.5 * (lattice_.count[0] - 1)), text(0.5 * (lattice_.count[1] - 1)),
            text(lattice_.pitch[0]), flag, text(lattice_.pitch[1]));
        const std::vector<Ring> rings = black_rings(d_, g_);
        std::vector<double> heights;
        if (!rings.empty()) heights = {rings.front().z_mm, rings.back().z_mm};
        for (const Ring& r : stop_rings(d_, g_)) heights.push_back(before_faces(r.z_mm));
        for (const double z : heights) all += beside(z, black()) + " transform { Place } }\n";
        if (options_.triangles && d_.array.surround == Surround::opaque)  // flat faces are common to all lenses
            for (const PlacedSurface& s : g_.surfaces)
                if (is_plane(s)) all += face(s) + medium(s.index_below) + " transform { Place }" + flag + " }\n";
        return all;
    }

    // For a plate whose lenses fill their cells: the walls in which caps end at the array's border, here on the cell's right (axis
    // 0) or upper side.
    std::string border_wall(int axis) const {
        std::string walls;
        for (const PlacedSurface& s : g_.surfaces) {
            if (is_plane(s)) continue;
            const bool upper = &s == &g_.surfaces.back();
            const double z0 = upper ? rim_z(s) : g_.base_z_mm, z1 = upper ? g_.top_z_mm : rim_z(s);
            const auto corner = [&](int side, double z) {
                return axis == 0 ? vector(half_[0], side * half_[1], z) : vector(side * half_[0], half_[1], z);
            };
            walls += fmt::format("  polygon {{ 5, {}, {}, {}, {}, {} clipped_by {{ {} }} }}\n", corner(-1, z0), corner(1, z0),
                                 corner(1, z1), corner(-1, z1), corner(-1, z0),
                                 pov_space(s, !upper, widest_half() + 0.01, g_.base_z_mm - 1, g_.top_z_mm + 1));
        }
        return fmt::format("#declare Wall{} = union {{\n{}  {}\n}}\n", axis, walls, cell_bounds());
    }

    // The plate: a single union, so that its faces share their medium; rows of lenses in boxes, so that a ray is tested against
    // few.
    std::string sheet() const {
        const double index = g_.surfaces.front().index_above;
        const auto [x, y] = array_half(g_);
        const auto right = std::int64_t(lattice_.count[0]) - 1, top = std::int64_t(lattice_.count[1]) - 1;
        std::string walls, all;
        if (d_.array.aperture == Aperture::cell) {
            all = border_wall(0) + border_wall(1);
            const std::tuple<std::string, int, int> sides[] = {
                {fmt::format("I = {}", right), 0, 0}, {fmt::format("J = {}", top), 1, 0}, {"I = 0", 0, 180}, {"J = 0", 1, 180}};
            for (const auto& [where, wall, turn] : sides)
                walls += fmt::format("    #if ({}) object {{ Wall{} rotate {} * z translate At }} #end\n", where, wall, turn);
        }
        all += fmt::format("union {{\n#for (J, 0, {})\n  #declare Y = (J - {}) * {};\n  union {{\n", top, text(0.5 * double(top)),
                           text(lattice_.pitch[1]));
        all += fmt::format(
            "  #for (I, 0, {})\n    #declare At = <(I - {}) * {}, Y, 0>;\n    object {{ Lens translate At }}\n{}  #end\n", right,
            text(0.5 * double(right)), text(lattice_.pitch[0]), walls);
        all += fmt::format("    bounded_by {{ box {{ <{0}, Y - {2}, {3}>, <{1}, Y + {2}, {4}> }} }}\n  }}\n#end\n", text(-x - 0.02),
                           text(x + 0.02), text(0.51 * lattice_.pitch[1]), text(g_.base_z_mm - 0.02), text(g_.top_z_mm + 0.02));
        for (const PlacedSurface& s : g_.surfaces) all += "  " + (is_plane(s) ? face(s) : beside(rim_z(s), "")) + " }\n";
        all += fmt::format("  {} transform {{ Place }}\n}}\n", medium(index));
        for (const Ring& r : stop_rings(d_, g_)) all += beside(before_faces(r.z_mm), black()) + " transform { Place } }\n";
        return all;
    }

    const Display& d_;
    const Geometry& g_;
    Lattice<double> lattice_;
    const double half_[2], gap_mm_;
    const PeerOptions& options_;
};

}  // namespace

void write_pov(const Display& display, const Geometry& geometry, const PeerOptions& options, std::vector<std::string> head,
               PeerScene& scene) {
    const bool opaque = display.array.surround == Surround::opaque;
    auto& deviations = scene.deviations;
    scene.shown = display;
    scene.shown.panel.encoding = Encoding::linear;
    const Fresnel fresnel = display.render.fresnel;
    if (fresnel == Fresnel::schlick || (fresnel == Fresnel::exact && !opaque)) {
        scene.shown.render.fresnel = Fresnel::none;
        deviations.push_back(opaque ? "render.fresnel: POV-Ray has no Schlick weights; refraction is without loss here"
                                    : "render.fresnel: POV-Ray's weights would also remove totally reflected light; refraction is "
                                      "without loss here");
    }
    if (opaque && options.triangles == std::nullopt && display.array.aperture == Aperture::cell)
        deviations.push_back(
            fmt::format("array.aperture: the black walls between filled cells are {} pitches thick", 2 * gap_pitches));
    if (display.array.surround == Surround::clear && display.array.aperture == Aperture::cell)
        deviations.push_back(
            fmt::format("array.aperture: bodies of glass that fill their cells are {} pitches of air apart; in lfdsim they touch",
                        2 * gap_pitches));
    const Writer writer(scene.shown, geometry, options);
    if (writer.least_way_mm() > 1e-4 * display.array.pitch_mm.least())
        deviations.push_back(fmt::format("camera.position_mm: so far away that POV-Ray may miss surfaces less than {:.3g} mm apart",
                                         writer.least_way_mm()));
    scene.panel_file = "panel.png";
    scene.picture = "view.png";
    const auto [width, height] = display.camera.resolution;
    scene.command = fmt::format("povray +Iscene.pov +O{} +W{} +H{} -D -A +FN16 File_Gamma=1.0", scene.picture, width, height);
    head.push_back("Render: " + scene.command);
    for (const std::string& d : deviations) head.push_back("Deviates: " + d);
    scene.files.push_back({"scene.pov", writer.scene(head, scene.panel_file)});
}

}  // namespace lfdsim::peers
