#include "interchange/pov/pov.h"

#include "engine/scene/traced_display.h"
#include "geometry/lens_misalignment.h"
#include "geometry/prescription.h"
#include "geometry/resolve.h"
#include "interchange/meshed/cell_sides.h"
#include "interchange/peers/array_frame.h"
#include "interchange/peers/cell.h"
#include "interchange/peers/scene_text.h"
#include "interchange/pov/pov_cell.h"
#include "interchange/pov/pov_limits.h"
#include "interchange/pov/pov_matter.h"
#include "interchange/pov/pov_mesh.h"
#include "interchange/pov/pov_misaligned.h"
#include "interchange/pov/pov_moved_caps.h"
#include "interchange/pov/pov_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

// How POV-Ray follows light. A ray keeps a list of the media that it is in. Where it meets a shape whose medium is in the list, it
// leaves that medium; otherwise it enters it, from the medium it met last. So in `clear` and `plate`, where all faces of one glass
// share its medium, entering and leaving alternate, in whatever order the faces are met. In `opaque`, where each surface is met
// once, each surface has the medium behind it, even if that is air. So have the layers on the panel, which light enters from above
// only; from below they are black, as totally reflected light is there. Where a body of glass is glued on it has no lower face:
// light enters the layer's medium from that of the glass, and beside it from air.
//
// Shapes that share a medium have to be parts of one union; copies of a shape have separate media.
namespace lfdsim::peers {
namespace {

constexpr double overlap_mm = 1e-6;  // of walls of neighbouring cells

/// Writes a display as a scene. Its functions return text of POV-Ray; shapes are in mm, `Place` scales them to POV-Ray's units.
class PovWriter {
  public:
    PovWriter(const Display& d, const Geometry& g, const PeerOptions& o)
        : d_(d),
          g_(g),
          lattice_(g.lattice),
          cell_(g),
          glued_(g.glued ? &g.surfaces.front() : nullptr),
          gap_mm_(pov_gap_pitches * d.array.pitch_mm.least()),
          units_per_mm_(pov_units_per_mm(d, g)),
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
        all += place();
        all += panel(panel_file) + layers();
        if (differ()) return all + "\n// Each lens\n" + (one_sheet ? pov_moved_caps(d_, g_) : pov_placed(d_, g_));
        all += "\n// One lens, about the z axis\n";
        all += "#declare Lens = " + (options_.triangles ? meshed_lens() : lens()) + "\n";
        all += one_sheet ? sheet() : lenses();
        return all;
    }

    bool fresnel() const { return d_.render.fresnel == Fresnel::exact; }
    bool differ() const { return lenses_differ(d_.errors); }
    // Objects are not visible in reflections where these are only the loss by Fresnel's equations, or end in black.
    std::string flag() const { return fresnel() || (differ() && d_.array.surround == Surround::opaque) ? " no_reflection" : ""; }

    /// Returns the most hits of a ray: all surfaces once, or up to 16, then the layers and the panel. A glued face, unless it
    /// vanishes between equal indices, counts as a surface and as a layer's face; beside a glued body of glass, light that meets as
    /// many surfaces may therefore be lost.
    int trace_levels() const {
        const int below = int(g_.layers.size()) + 1;
        if (d_.lens.is_thin()) return below;
        if (d_.array.surround == Surround::opaque)
            return below + int(g_.surfaces.size()) - (glued_ ? 1 : 0) + (differ() ? pov_passed_by : 0);
        return below + 16 - (glued_ && glued_->index_below != glued_->index_above ? 1 : 0);
    }

  private:
    std::string camera() const {
        const optics::RayOrigin view = make_ray_origin(d_, g_);
        const double u = units_per_mm_, width = view.pixel_mm * view.width, height = view.pixel_mm * view.height;
        double at[3], right[3], up[3];
        for (int k = 0; k < 3; ++k) {
            at[k] = view.position[k] * u;
            right[k] = view.right[k] * width / view.distance;
            up[k] = view.up[k] * height / view.distance;
        }
        return fmt::format("camera {{ location {} direction {} right {} up {} }}\n", vector(at), vector(view.forward),
                           vector(right), vector(up));
    }

    /// Returns the transformation from the array's frame to the display's, in units. POV-Ray's order of a matrix: images of the
    /// axes, then the shift.
    std::string place() const {
        const ArrayFrame frame = array_frame(d_, g_);
        std::string numbers;
        for (int axis = 0; axis < 3; ++axis)
            for (const auto& row : frame.turn) numbers += text(row[axis]) + ",";
        const auto& [x, y, z] = frame.shift_mm;
        return fmt::format("#declare Place = transform {{ matrix <{}{},{},{}> scale {} }}\n", numbers, text(x), text(y), text(z),
                           text(units_per_mm_));
    }

    std::string panel(const std::string& file) const {
        const double w = g_.panel_width_mm, h = g_.panel_height_mm;
        return fmt::format(
            "plane {{ z, 0\n  pigment {{ image_map {{ png \"{}\" gamma 1.0 map_type 0 once }} scale {} translate {} }}\n"
            "  finish {{ ambient 0 diffuse 0 emission 1 }}\n  scale {}{} }}\n",
            file, vector(w, h, 1), vector(-w / 2, -h / 2, 0), text(units_per_mm_), flag());
    }

    /// Returns the layers' upper faces, except where a lens's glued face is the top layer's. interior_texture is that from below.
    std::string layers() const {
        std::string all;
        double z = g_.layers_top_mm;
        for (std::size_t k = g_.layers.size(); k-- > 0; z -= g_.layers[k].thickness_mm) {
            const bool of_lens = glued_ && d_.array.surround == Surround::opaque && k + 1 == g_.layers.size();
            if (!of_lens)
                all += fmt::format("{}{} interior_texture {{ Black }} scale {}{} }}\n", face(z), medium(g_.layers[k].index),
                                   text(units_per_mm_), flag());
        }
        return all;
    }

    /// Returns the bounding box of a lens in a union of all lenses; POV-Ray gives one to lenses that are separate objects.
    std::string cell_bounds() const {
        if (d_.array.surround != Surround::plate) return "";
        double low = g_.base_z_mm, high = g_.top_z_mm;
        if (d_.lens.stop_radius_mm) low = std::min(low, g_.stop_z_mm), high = std::max(high, g_.stop_z_mm);
        return fmt::format("  bounded_by {{ {} }}\n", cell_.box(low - 0.01, high + 0.01, 0.01));
    }

    /// Returns whether a cell has room beside a hole of this radius.
    bool beside_hole(double radius) const { return radius < outer_radius_mm(d_, g_); }

    /// Returns the flat part of the cell outside a lens's aperture.
    std::string ring(double z, double radius, const std::string& matter) const {
        return fmt::format("{} {} }}\n", cell_.flat(z, radius), matter);
    }
    /// Returns the flat part outside the array, without the closing brace.
    std::string beside(double z, const std::string& matter) const {
        const auto [x, y] = array_half(g_);
        return fmt::format("disc {{ {}, z, {} clipped_by {{ box {{ {}, {} inverse }} }} {}", vector(0, 0, z),
                           text(100 * sheet_half(g_)), vector(-x, -y, z - 1), vector(x, y, z + 1), matter);
    }

    /// Returns the places in the box about all cells that no cell of staggered rows covers: cells without lenses, cut at the box.
    std::string between(const std::string& flats) const {
        if (!lattice_.staggered || flats.empty()) return "";
        const auto [x, y] = array_half(g_);
        const auto right = cell_.last(0), top = cell_.last(1);
        const int more =
            cell_.half()[1] > lattice_.half_pitch[1] ? 1 : 0;  // rows below and above, whose corners reach into the box
        return fmt::format(
            "union {{\n  #for (J, {}, {}) #for (I, -1, {}, (J < 0 | J > {} ? 1 : {}))\n    union {{\n{}    translate <{}, {}, 0> "
            "}}\n"
            "  #end #end\n  clipped_by {{ box {{ {}, {} }} }} }}\n",
            -more, top + more, right + 1, top, right + 2, flats, cell_.axis_x(), cell_.axis_y(), vector(-x, -y, g_.base_z_mm - 1),
            vector(x, y, g_.top_z_mm + 1));
    }

    std::string face(double z) const { return fmt::format("disc {{ {}, z, {} ", vector(0, 0, z), text(100 * sheet_half(g_))); }

    /// Returns the height of a black part, which may end in the plane of a flat face, but not in that of the panel.
    double above_panel(double z) const { return std::max(z, gap_mm_); }

    /// Returns whether this surface is glued onto the bare panel: the scene has none then.
    bool on_panel(const PlacedSurface& s) const { return &s == glued_ && g_.layers.empty(); }

    std::string lens() const {
        std::string parts;
        const auto& surfaces = g_.surfaces;
        for (const Ring& r : stop_rings(d_, g_)) parts += ring(before_faces(g_, r.z_mm, gap_mm_), r.radius_mm, black());
        if (d_.array.surround == Surround::clear) {
            if (parts.empty()) return body();
            parts += body();
        } else if (d_.array.surround == Surround::plate) {
            for (const PlacedSurface& s : surfaces) {
                if (is_plane(s)) continue;
                parts += "  " + pov_skin(s, d_.array, cell_) + " }\n";
                if (beside_hole(s.semi_aperture_mm)) parts += ring(rim_z_mm(s), s.semi_aperture_mm, "");
            }
        } else {
            for (const PlacedSurface& s : surfaces)
                if (!d_.lens.is_thin() && !on_panel(s))
                    parts += "  " + pov_skin(s, d_.array, cell_) + " " + medium(s.index_below) + " }\n";
            parts += black_parts();
        }
        return fmt::format("union {{\n{}{}}}", parts, cell_bounds());
    }

    std::string black_parts() const {
        std::string parts;
        const auto [low, high, widest] = rims(g_.surfaces);
        for (const Ring& r : black_rings(d_, g_))
            if (beside_hole(r.radius_mm)) parts += ring(above_panel(r.z_mm), r.radius_mm, black());
        if (d_.array.aperture == Aperture::circle) {
            if (high > low + 1e-6) parts += barrel(widest, low, high);
            return parts;
        }
        // Black walls on the cell's borders: between the rims, and up to the glass there
        if (high > low + 1e-6)
            parts += fmt::format("  difference {{ {} {} {} }}\n", cell_.prism(low, high, overlap_mm),
                                 cell_.prism(low - 1, high + 1, -gap_mm_), black());
        const double z0 = g_.base_z_mm - 1, z1 = g_.top_z_mm + 1, reach = cell_.widest_half() + 2 * gap_mm_;
        parts += fmt::format("  intersection {{ {} {} {} {} {} }}\n", cell_.prism(z0, z1, overlap_mm),
                             "object { " + cell_.prism(z0 - 1, z1 + 1, -gap_mm_) + " inverse }",
                             pov_space(g_.surfaces.front(), cell_, true, reach, z0 - 1, z1 + 1),
                             pov_space(g_.surfaces.back(), cell_, false, reach, z0 - 1, z1 + 1), black());
        return parts;
    }

    /// Returns the black wall around a lens; of a strip those to its left and right.
    std::string barrel(double radius, double low, double high) const {
        if (!lattice_.strips)
            return fmt::format("  cylinder {{ {}, {}, {} open {} }}\n", vector(0, 0, low), vector(0, 0, high), text(radius),
                               black());
        const double y = cell_.half_length();
        return upright({-radius, -y}, {-radius, y}, low, high, black()) + upright({radius, -y}, {radius, y}, low, high, black());
    }

    /// Returns an upright rectangle over the line between two points, from one height to another.
    static std::string upright(std::array<double, 2> from, std::array<double, 2> to, double low, double high,
                               const std::string& matter) {
        const std::string begin = vector(from[0], from[1], low);
        return fmt::format("  polygon {{ 5, {}, {}, {}, {}, {} {} }}\n", begin, vector(to[0], to[1], low),
                           vector(to[0], to[1], high), vector(from[0], from[1], high), begin, matter);
    }

    /// Returns one body of glass of the surround `clear`: closed, unless it is glued on.
    std::string body() const {
        const PlacedSurface &lower = g_.surfaces.front(), &upper = g_.surfaces.back();
        const bool filled = d_.array.aperture == Aperture::cell;
        const double low = g_.base_z_mm - 0.01, high = g_.top_z_mm + 0.01, r = upper.semi_aperture_mm;
        const std::string round = cell_.column(r, low, high);
        const double reach = (filled ? cell_.widest_half() : r) + 0.01;
        std::string sides = filled ? cell_.prism(low, high, -gap_mm_) : round;
        // A strip's column has to end where the strip does
        if (lattice_.strips ? !filled : filled && beside_hole(r)) sides = cell_.prism(low, high, -gap_mm_) + " " + round;
        const std::string below = glued_ ? "" : pov_space(lower, cell_, true, reach, low - 1, high + 1) + "\n    ",
                          cut = glued_ ? fmt::format(" clipped_by {{ {} }}", pov_space(lower, cell_, true, 0, 0, 0)) : "";
        return fmt::format("  intersection {{ {}\n    {}{}\n    {}{} }}\n", sides, below,
                           pov_space(upper, cell_, false, reach, low - 1, high + 1), medium(lower.index_above), cut);
    }

    /// Returns what lens() does, as triangles; copies share each patch's mesh.
    std::string meshed_lens() const {
        const MeshedArray made = mesh_array(d_, g_, *options_.triangles);
        const bool opaque = d_.array.surround == Surround::opaque, clear = d_.array.surround == Surround::clear;
        std::string glass, blacks;
        for (const Patch& patch : made.cell) {
            if (clear && glued_ && (!patch.of_lens || patch.name == "surface-1")) continue;  // layers() has that face
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
        std::string all = fmt::format(
            "#for (J, 0, {}) #for (I, 0, {})\n  object {{ Lens translate <{}, {}, 0> transform {{ Place }}{} }}\n#end #end\n",
            cell_.last(1), cell_.last(0), cell_.axis_x(), cell_.axis_y(), flag());
        const std::vector<Ring> rings = black_rings(d_, g_);
        std::vector<double> heights;
        if (!rings.empty()) heights = {above_panel(rings.front().z_mm), above_panel(rings.back().z_mm)};
        for (const Ring& r : stop_rings(d_, g_)) heights.push_back(before_faces(g_, r.z_mm, gap_mm_));
        std::string flats;
        for (const double z : heights) {
            all += beside(z, black()) + " transform { Place } }\n";
            flats += ring(z, 0, black());
        }
        if (const std::string rest = between(flats); !rest.empty())
            all += fmt::format("object {{ {} transform {{ Place }} }}\n", rest);
        if (options_.triangles && d_.array.surround == Surround::opaque)  // flat faces are common to all lenses
            for (const PlacedSurface& s : g_.surfaces)
                if (is_plane(s) && !on_panel(s))
                    all += face(s.z_mm) + medium(s.index_below) + " transform { Place }" + flag() + " }\n";
        return all;
    }

    /// Returns the upright faces on a cell's side, for a plate whose lenses fill their cells: between a cap and the flat part where
    /// there is no lens beyond it, and between the caps of bricks, which meet at different heights.
    std::string side_walls(const PovCell::PrismSide& side, bool at_border) const {
        std::string walls;
        for (const PlacedSurface& s : g_.surfaces) {
            if (is_plane(s)) continue;
            const auto space = [&](bool above) {
                return pov_space(s, cell_, above, cell_.widest_half() + 0.01, g_.base_z_mm - 1, g_.top_z_mm + 1);
            };
            const auto wall = [&](double low, double high, const std::string& within) {
                if (high > low + 1e-9) walls += upright(side.from, side.to, low, high, "clipped_by { " + within + " }");
            };
            const auto [sag_low, sag_high] = sag_range_mm(s);
            const double low = s.z_mm + sag_low, high = s.z_mm + sag_high, flat = rim_z_mm(s);
            if (at_border) {
                wall(flat, high, space(false));
                wall(low, flat, space(true));
            } else {
                const auto beyond = [&](bool above) {
                    return fmt::format("object {{ {} translate {} }}", space(above), vector(side.beyond[0], side.beyond[1], 0));
                };
                wall(low, high, space(false) + " " + beyond(true));
                wall(low, high, space(true) + " " + beyond(false));
            }
        }
        return walls;
    }

    /// Returns the plate: a single union, so that its faces share their medium; rows of lenses in boxes, so that a ray is tested
    /// against few.
    std::string sheet() const {
        const double index = g_.surfaces.front().index_above;
        const auto [x, y] = array_half(g_);
        std::string walls, all, flats;
        if (d_.array.aperture == Aperture::cell) {
            int number = 0;
            for (const PovCell::PrismSide& side : cell_.sides()) {
                const bool steps = d_.array.lattice == LatticeKind::brick && side.to[1] > 0 && side.beyond[1] > 0;
                const auto declare = [&](const char* name, bool at_border) {
                    all += fmt::format("#declare {}{} = union {{\n{}  {}\n}}\n", name, number, side_walls(side, at_border),
                                       cell_bounds());
                };
                declare("Wall", true);
                if (steps) declare("Step", false);
                walls += fmt::format("    #if ({}) object {{ Wall{} translate At }}{} #end\n", side.at_border, number,
                                     steps ? fmt::format(" #else object {{ Step{} translate At }}", number) : "");
                ++number;
            }
        }
        // The lenses row by row, then the flat parts beside and between them, then the stop
        all += fmt::format("union {{\n#for (J, 0, {})\n  #declare Y = {};\n  union {{\n", cell_.last(1), cell_.axis_y());
        all += fmt::format("  #for (I, 0, {})\n    #declare At = <{}, Y, 0>;\n    object {{ Lens translate At }}\n{}  #end\n",
                           cell_.last(0), cell_.axis_x(), walls);
        all += fmt::format("    bounded_by {{ box {{ <{0}, Y - {2}, {3}>, <{1}, Y + {2}, {4}> }} }}\n  }}\n#end\n", text(-x - 0.02),
                           text(x + 0.02), text(cell_.half()[1] + 0.02), text(g_.base_z_mm - 0.02), text(g_.top_z_mm + 0.02));
        for (const PlacedSurface& s : g_.surfaces) {
            if (!is_plane(s)) flats += ring(rim_z_mm(s), 0, "");
            if (&s != glued_) all += "  " + (is_plane(s) ? face(s.z_mm) : beside(rim_z_mm(s), "")) + " }\n";
        }
        all += fmt::format("  {}{} transform {{ Place }}\n}}\n", between(flats), medium(index));
        for (const Ring& r : stop_rings(d_, g_)) {
            const double z = before_faces(g_, r.z_mm, gap_mm_);
            all += beside(z, black()) + " transform { Place } }\n";
            if (const std::string rest = between(ring(z, 0, black())); !rest.empty())
                all += fmt::format("object {{ {} transform {{ Place }} }}\n", rest);
        }
        return all;
    }

    const Display& d_;
    const Geometry& g_;
    Lattice<double> lattice_;
    const PovCell cell_;
    const PlacedSurface* glued_;  // the face that lies on the layers or the panel without air; null: there is none
    const double gap_mm_, units_per_mm_;
    const PeerOptions& options_;
};

}  // namespace

void write_pov(const Display& display, const Geometry& geometry, const PeerOptions& options, std::vector<std::string> head,
               PeerScene& scene) {
    scene.shown = display;
    for (std::string& d : pov_deviations(scene.shown, geometry, options)) scene.deviations.push_back(std::move(d));
    scene.panel_file = "panel.png";
    scene.picture = "view.png";
    const auto [width, height] = display.camera.resolution;
    scene.command = fmt::format("povray +Iscene.pov +O{} +W{} +H{} -D -A +FN16 File_Gamma=1.0", scene.picture, width, height);
    head.push_back("Render: " + scene.command);
    for (const std::string& d : scene.deviations) head.push_back("Deviates: " + d);
    const PovWriter writer(scene.shown, geometry, options);
    scene.files.push_back({"scene.pov", writer.scene(head, scene.panel_file)});
}

}  // namespace lfdsim::peers
