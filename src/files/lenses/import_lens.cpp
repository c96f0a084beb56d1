#include "files/lenses/import_lens.h"

#include "base/constants.h"
#include "base/counted.h"
#include "base/printable.h"
#include "base/problems.h"
#include "checks/first_order.h"
#include "display/colour.h"
#include "display/keys.h"
#include "files/description/nearest.h"
#include "files/lenses/drawn_beam.h"
#include "geometry/geometry.h"
#include "geometry/lattice.h"
#include "geometry/prescription.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

namespace lfdsim {
namespace {

/// A medium as a description has it; without both it is air.
struct LensMedium {
    std::optional<double> index;
    std::optional<Glass> glass;
    bool operator==(const LensMedium&) const = default;
};

/// An object at this distance or further, mm, counts as at infinity; programs write such numbers for it.
constexpr double infinite_mm = 1e9;

/// Returns a number without the noise of the last digits that scaling leaves.
double tidy(double x) {
    const std::string text = fmt::format("{:.14g}", x);
    std::from_chars(text.data(), text.data() + text.size(), x);
    return x;
}

// Makes a display of a lens in steps, each of which stops with all of its faults.
class LensImport {
  public:
    LensImport(DrawnLens l, const ImportRequest& r) : lens(std::move(l)), request(r), notes(lens.notes) {}

    Imported import() {
        // The lens in the display's lengths, its media, and the surfaces and apertures that count.
        double& object = lens.surfaces.front().distance_mm;
        if (std::abs(object) >= infinite_mm) object = infinity;
        scale(lens, request.scale);
        if (request.scale != 1)
            notes.push_back(fmt::format("All lengths of the lens are {:g} times those of the file.", request.scale));
        find_media();
        if (kept_surfaces()) give_apertures();
        problems.report();
        // The display.
        Imported made;
        made.what = "A lens from a lens design program, and a display for it";
        made.display.name = lens.title;
        made.display.lens.kind = surface_lens(made.surfaces);
        problems.report();
        furnish(made.display);
        judge(made.display, "");
        warn(made.display);
        for (const GlassCatalogue& c : request.catalogues)
            if (std::any_of(media.begin(), media.end(), [&](const LensMedium& m) { return is_in(c, m); }))
                made.catalogues.push_back(c.file);
        made.notes = std::move(notes);
        return made;
    }

  private:
    static bool is_in(const GlassCatalogue& catalogue, const LensMedium& medium) {
        return medium.glass && !medium.glass->name.empty() &&
               std::find(catalogue.glasses.begin(), catalogue.glasses.end(), *medium.glass) != catalogue.glasses.end();
    }

    // Finds the medium after each surface and its index at the file's main wavelength. Object and image must be in air.
    void find_media() {
        for (const DrawnSurface& s : lens.surfaces) media.push_back(medium_of(s));
        const double nm = lens.beam.wavelength_nm.value_or(d_line_nm);
        for (const LensMedium& m : media) indices.push_back(index_at(m.index, m.glass, nm));
        for (const std::size_t i : {std::size_t(0), lens.surfaces.size() - 2})
            if (media[i] != LensMedium())
                problems.add(lens.surfaces[i].place, "has no air behind it; {} must be in air",
                             i == 0 ? "the object" : "the image");
        for (const GlassChoice& choice : request.glasses)
            if (taken.contains(choice.name))
                notes.push_back(fmt::format("Replaced by --glass: {}.", choice.name));
            else
                problems.add("--glass", "the lens has no glass {}", shortened(choice.name));
        if (std::any_of(media.begin(), media.end(), [](const LensMedium& m) { return m.glass.has_value(); }))
            notes.push_back(fmt::format("The lens was designed for light of {:.4g} nm{}; lengths here hold for green light.", nm,
                                        lens.beam.wavelength_nm ? "" : ", as far as is known"));
    }

    // Returns the medium after a surface. An unknown glass is refused once, and read as index 1.5 so that all faults are found.
    LensMedium medium_of(const DrawnSurface& s) {
        const DrawnMedium& drawn = s.medium;
        if (drawn.is_air()) return {};
        if (drawn.glass.empty() && drawn.vd) return {{}, Glass{"", Formula::nd_vd, {drawn.nd, *drawn.vd}}};
        if (drawn.glass.empty()) return {drawn.nd, {}};
        if (same_name(drawn.glass, "air") || same_name(drawn.glass, "vacuum")) return {};
        const auto choice = std::find_if(request.glasses.begin(), request.glasses.end(),
                                         [&](const GlassChoice& c) { return same_name(c.name, drawn.glass); });
        if (choice != request.glasses.end()) {
            taken.insert(choice->name);
            return {choice->index, choice->glass};
        }
        if (const Glass* found = find_glass(drawn.glass, request.catalogues)) return {{}, *found};
        if (unknown.insert(drawn.glass).second)
            problems.add(s.place, "{} (or --glass {}=OTHER, or --glass {}=ND,VD, or its maker's catalogue by --catalogue FILE.agf)",
                         unknown_glass(drawn.glass, request.catalogues), shortened(drawn.glass), shortened(drawn.glass));
        return {1.5, {}};
    }

    // Finds the surfaces that refract or stop light; others only take up space. Returns false, which is refused, where there is no
    // glass or too many surfaces are left.
    bool kept_surfaces() {
        std::vector<std::string> left_out;
        for (std::size_t i = 1; i + 1 < lens.surfaces.size(); ++i) {
            const DrawnSurface& s = lens.surfaces[i];
            if (media[i] != media[i - 1] || s.is_stop || s.is_hole)
                kept.push_back(i);
            else
                left_out.push_back(fmt::to_string(i));
        }
        if (!left_out.empty())
            notes.push_back(
                fmt::format("Left out, as they neither refract nor stop light: surfaces {}.", fmt::join(left_out, ", ")));
        const bool bends = std::any_of(media.begin(), media.end(), [](const LensMedium& m) { return m != LensMedium(); });
        if (!bends)
            problems.add(lens.surfaces.front().place, "is not followed by any glass: there is no lens");
        else if (kept.size() > max_surfaces)
            problems.add(lens.surfaces[kept[max_surfaces]].place, "is one too many: the lens has {} surfaces, allowed are {}",
                         kept.size(), max_surfaces);
        if (const double curvature = lens.surfaces.back().curvature_per_mm; curvature != 0)
            notes.push_back(
                fmt::format("The file's image is curved, with a radius of {:.6g} mm; the panel is flat.", 1 / curvature));
        return bends && kept.size() <= max_surfaces;
    }

    // Gives each kept surface a semi-aperture: the file's, else that of the request, else that of the file's beam.
    void give_apertures() {
        std::vector<std::string> without;
        for (const std::size_t i : kept)
            if (!lens.surfaces[i].semi_aperture_mm) without.push_back(fmt::to_string(i));
        notes.push_back("Each surface absorbs beyond its semi-aperture; a lens design program may transmit such light.");
        if (without.empty()) {
            if (request.semi_aperture_mm)
                notes.push_back("--semi-aperture-mm has no effect: the file has semi-apertures of all surfaces.");
            return;
        }
        if (request.semi_aperture_mm) {
            for (const std::size_t i : kept)
                if (std::optional<double>& semi = lens.surfaces[i].semi_aperture_mm; !semi) semi = request.semi_aperture_mm;
            notes.push_back(fmt::format("The file has no semi-apertures of surfaces {}: {} mm by --semi-aperture-mm.",
                                        fmt::join(without, ", "), *request.semi_aperture_mm));
            return;
        }
        const std::optional<std::string> missing = fill_apertures(lens, indices);
        by_beam = !missing;
        if (by_beam)
            notes.push_back(fmt::format(
                "The file has no semi-apertures of surfaces {}: they are as wide as its beam requires, by paraxial rays.",
                fmt::join(without, ", ")));
        else
            problems.add(
                lens.surfaces[kept.front()].place,
                "no semi-aperture is given for surfaces {}, and of a beam from which they would follow no {} is known; give "
                "--semi-aperture-mm",
                fmt::join(without, ", "), *missing);
    }

    // Returns the distance along the axis between two of the file's surfaces, over those that are left out.
    double between(std::size_t from, std::size_t to) const {
        double sum = 0;
        for (std::size_t i = from; i < to; ++i) sum += lens.surfaces[i].distance_mm;
        return sum;
    }

    // Returns the lens from the panel's side to the viewer's. The panel is at the file's image, the end of the file's light, so
    // order and axis are reversed and curvatures and aspheric terms change their sign, unless the lens is flipped.
    SurfaceLens surface_lens(std::vector<std::string>& places) {
        SurfaceLens made;
        for (std::size_t k = 0; k < kept.size(); ++k) {
            const std::size_t at = request.flip ? k : kept.size() - 1 - k, i = kept[at];
            const DrawnSurface& s = lens.surfaces[i];
            const double sign = request.flip ? 1 : -1;
            Surface& surface = made.surfaces.emplace_back();
            surface.curvature_per_mm = s.curvature_per_mm == 0 ? 0 : tidy(sign * s.curvature_per_mm);
            surface.conic = s.conic;
            for (const double a : s.even_asphere) surface.even_asphere.push_back(a == 0 ? 0 : tidy(sign * a));
            surface.semi_aperture_mm = tidy(*s.semi_aperture_mm);
            places.push_back(s.place + (s.is_stop ? ", the stop" : ""));
            if (k + 1 == kept.size()) continue;
            // The space to the next surface is, in the file, the one after this surface (flipped) or after the next one (not
            // flipped).
            const std::size_t behind = request.flip ? i : kept[at - 1], next = request.flip ? kept[at + 1] : i;
            surface.index = media[behind].index;
            surface.glass = media[behind].glass;
            surface.distance_mm = tidy(between(behind, next));
            if (!(surface.distance_mm >= 0 && surface.distance_mm <= longest_mm))
                problems.add(lens.surfaces[behind].place, "the next surface is {} mm behind it, allowed is {}", surface.distance_mm,
                             length_or_zero.text());
        }
        return made;
    }

    // Adds panel, array, eye and diffuser to the lens, by the request and by rules of first designs.
    void furnish(Display& d) {
        // The panel, and lenses as far apart as they are wide. The lens is checked before its gap is computed.
        d.panel.pixels = request.pixels;
        d.panel.pixel_pitch_mm =
            to_nanometre(25.4 * request.panel_inch / std::hypot(double(request.pixels[0]), double(request.pixels[1])));
        double widest = 0;
        for (const Surface& s : d.lens.as<SurfaceLens>().surfaces) widest = std::max(widest, s.semi_aperture_mm);
        d.array.pitch_mm = request.pitch_mm.value_or(2 * widest);
        d.array.gap_mm = longest_mm;  // until the lens is valid
        judge(d, "lens.");
        d.array.gap_mm = gap(d);
        d.camera.position_mm = {0, 0, request.distance_mm};
        d.camera.resolution = {1280, 720};
        d.content.model = "built-in:spheres";
        d.content.viewing_distance_mm = request.distance_mm;
        notes.push_back(fmt::format("Assumed: a panel of {:g} inches with {} x {} pixels, an eye at {:g} mm{}.", request.panel_inch,
                                    request.pixels[0], request.pixels[1], request.distance_mm,
                                    request.pitch_mm ? "" : ", a pitch as wide as the lens"));
        // An eye near the lenses has a pupil; one further away looks through a diffuser.
        const Geometry g = resolve_unchecked(d);
        const double room = request.distance_mm - g.vertex_plane_mm, depth = theory(d, g).central_depth_mm;
        if (request.distance_mm < nearest_sight_mm) {
            d.camera.pupil_diameter_mm = usual_pupil_mm;
            d.camera.focus_distance_mm = depth < 0 && depth > -longest_mm ? rounded(room - depth) : 1000;
            notes.push_back("The eye is too near to see the lenses sharply: it has a pupil, and there is no diffuser.");
            return;
        }
        Diffuser& diffuser = d.diffuser.emplace();
        // The angle of a lens pitch from the diffuser at the distance d, 2 atan(p / 2d), closes the gaps between lenses.
        diffuser.distance_mm = rounded(std::min(std::abs(depth), room / 4));
        diffuser.angle_deg.fill(rounded(2 * std::atan(d.array.pitch_mm[0] / (2 * diffuser.distance_mm)) / degree));
        notes.push_back(fmt::format(
            "A diffuser closes the dark gaps between the lenses; it is {}, at most a quarter of the way to the eye.",
            depth > 0 ? "on the central depth plane" : "as far in front of the lenses as the central depth plane is behind them"));
    }

    // Returns the gap from the panel to the lens's principal plane, mm, in the green light that determines lengths here.
    double gap(const Display& d) {
        const Cardinal c = cardinal_points(prescription(d.lens, d.array, d.panel.wavelengths_nm[green_channel]));
        const bool diverges = c.focal_length_mm < 0;
        if (diverges)
            notes.insert(notes.begin(),
                         fmt::format("The lens diverges (focal length {:.6g} mm): it forms no real image of the panel at any gap.",
                                     c.focal_length_mm));
        if (request.gap_mm) return *request.gap_mm;
        // From the panel to the lens's first surface, and from that to the principal plane.
        const std::size_t last = lens.surfaces.size() - 1;
        const double to_image = between(kept.back(), last), to_object = between(0, kept.front());
        if (const double distance = request.flip ? to_object : to_image; std::isfinite(distance)) {
            if (const double gap_mm = distance + c.front_principal_mm; diverges && !(gap_mm > 0)) {
                problems.add(
                    "--gap-mm",
                    "the lens diverges (focal length {:.6g} mm): the file's {} is virtual, and no panel can be there; give the "
                    "gap, or a lens that converges",
                    c.focal_length_mm, request.flip ? "object" : "image");
                problems.report();
            }
            notes.push_back(fmt::format("The panel is at the file's {}, {:.6g} mm from the nearest surface.",
                                        request.flip ? "object" : "image", distance));
            return tidy(distance + c.front_principal_mm);
        }
        if (!(c.focal_length_mm > 0 && c.focal_length_mm <= longest_mm)) {
            problems.add("--gap-mm",
                         "the file's {} is at infinity, and a lens of focal length {:.6g} mm{} has no focus there; give the gap",
                         request.flip ? "object" : "image", c.focal_length_mm, diverges ? ", which diverges," : "");
            problems.report();
        }
        notes.push_back(fmt::format("The file's {} is at infinity: the panel is in the lens's focal plane.",
                                    request.flip ? "object" : "image"));
        return c.focal_length_mm;  // exactly, so that the lens collimates
    }

    // Returns the place in the file that a key of a surface, "lens.surface.2.index", comes from. Unless the lens is flipped, the
    // space after a surface of the display is, in the file, after the neighbour.
    const std::string& place_of(std::string_view key) const {
        std::size_t k = 0;
        const std::string_view number = key.substr(std::string_view("lens.surface.").size());
        std::from_chars(number.data(), number.data() + number.size(), k);
        const bool of_space = key.ends_with("index") || key.ends_with("glass") || key.ends_with("distance_mm");
        const std::size_t at = request.flip ? k : kept.size() - 1 - k;
        return lens.surfaces[kept[of_space && !request.flip && at > 0 ? at - 1 : at]].place;
    }

    // Notes a display with few lenses or few pixels behind each.
    void warn(const Display& d) {
        const Geometry g = resolve_unchecked(d);
        const std::int64_t across = std::min(g.lattice.count[0], g.lattice.count[1]);
        if (across < fewest_lenses)
            notes.push_back(fmt::format("Only {} of {:.4g} mm fit along the panel's shorter side; --scale makes them smaller.",
                                        counted(across, "lens", "lenses"), d.array.pitch_mm[0]));
        else if (const double views = d.array.pitch_mm[0] / d.panel.pixel_pitch_mm; views < fewest_views)
            notes.push_back(
                fmt::format("Only {:.3g} pixels lie behind a lens; --scale makes lenses larger, --pixels pixels smaller.", views));
    }

    // Throws what the checks of a description find about the keys of a table ("lens."; "": of all), each at the place in the file
    // or with the options that it comes from.
    void judge(const Display& d, std::string_view table) {
        for (Problem& p : validate(d)) {
            if (!p.where.starts_with(table)) continue;
            if (p.where.starts_with("lens.surface.")) {
                p.where = fmt::format("{}: {}", place_of(p.where), p.where);
                if (by_beam && p.where.ends_with("_mm"))
                    p.what += "; the semi-aperture is that of the file's beam, --semi-aperture-mm gives another";
            } else if (p.where.starts_with("array.")) {
                p.what += "; --gap-mm, --pitch-mm and --scale change that";
            } else if (p.where.starts_with("camera.") || p.where.starts_with("diffuser.")) {
                p.what += "; --distance-mm and --scale change that";
            }
            problems.add(std::move(p));
        }
        problems.report();
    }

    DrawnLens lens;
    const ImportRequest& request;
    std::vector<std::string> notes;
    std::vector<LensMedium> media;  // after each surface of the file
    std::vector<double> indices;    // of these media, at the file's main wavelength
    std::vector<std::size_t> kept;  // the file's numbers of the lens's surfaces
    bool by_beam = false;           // semi-apertures follow from the file's beam
    std::set<std::string> unknown;  // glasses that no catalogue has
    std::set<std::string> taken;    // glasses that the user replaces
    Problems problems;
};

}  // namespace

Imported import_lens(DrawnLens lens, const ImportRequest& request) { return LensImport(std::move(lens), request).import(); }

}  // namespace lfdsim
