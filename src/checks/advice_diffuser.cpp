// Advice on dark bands between lenses, and on diffusers that are too strong. docs/model.md, "Dark bands between lenses".

#include "base/bisection.h"
#include "base/constants.h"
#include "checks/advice_parts.h"
#include "geometry/dark_bands.h"
#include "geometry/diffuser_profile.h"
#include "geometry/resolve.h"
#include "geometry/seen_width.h"
#include "geometry/sharp_range.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr double strongest_deg = 30;  // beyond it views of any usual field of view mix

/// Returns the best distance, mm from the vertex plane, for a diffuser that joins the lenses' light: that of the central depth
/// plane, where it costs no sharpness, if that is in front of the lenses and at most halfway to the eye; else 20 lens pitches. It
/// is no less than where views separate with it, and at most halfway to the eye.
double best_distance_mm(const Display& d, const Geometry& g, const Theory& t, double eye_mm) {
    const double from_vertex = g.rear_principal_mm - g.vertex_plane_mm, central = t.central_depth_mm + from_vertex;
    const bool there = central > g.top_z_mm - g.vertex_plane_mm && central < eye_mm / 2;
    // A diffuser at d above H' that spreads light over p there adds g p/d (1 - d/E), times its profile's width, to what an eye sees
    // of the panel at once.
    const std::array<double, 2> pitch{lens_pitch_mm(g, 0), lens_pitch_mm(g, 1)};
    const double spread = g.gap_mm * pitch[axis_of_eyes(g)] * even_width_of(d.diffuser ? d.diffuser->profile : Profile::box);
    const std::size_t axis = axis_of_eyes(g);
    const double away = eye_mm - from_vertex,
                 left = most_seen_share * t.along[axis].elemental_pitch_mm - seen_through_lens_mm(g, away),
                 least = left > 0 ? 1.05 / (left / spread + 1 / away) + from_vertex : 0;
    return std::min(std::max(there ? central : 20 * std::min(pitch[0], pitch[1]), least), eye_mm / 2);
}

/// Returns whether the pupil's defocus closes the gaps as a diffuser would: an eye with a pupil of diameter A, focused at F, sees
/// each point of the lenses' plane, at distance E, as a disk A |1 - E/F| wide. A disk three pitches wide leaves a contrast of at
/// most 0.08 of dots of that pitch, twice the fourth lobe of 2 J1(x)/x.
bool joined_by_pupil(const Display& d, const Geometry& g, double eye) {
    return d.camera.pupil_diameter_mm.value_or(0) * std::abs(1 - eye / g.focus_distance_mm) >=
           3 * std::max(lens_pitch_mm(g, 0), lens_pitch_mm(g, 1));
}

/// Returns what a diffuser would do to what is shown: "mix views" that do not separate through it, "blur the content" to less than
/// half of the resolution that lenses and pixels allow at its depth; nothing if it is harmless. `distance_mm`: from the vertex
/// plane; `main`: the axis of its angles along which views lie side by side.
std::optional<std::string> harm(const Advised& a, double distance_mm, const std::array<double, 2>& deg, std::size_t main) {
    const Display& d = a.display;
    const Geometry& g = a.geometry;
    const double eye = camera_distance_mm(d), away = eye - g.rear_principal_mm;
    const Profile profile = d.diffuser ? d.diffuser->profile : Profile::box;
    if (seen_through_lens_mm(g, away) +
            seen_by_diffuser_mm(g, away, profile, deg[main], distance_mm + g.vertex_plane_mm - g.rear_principal_mm) >
        most_seen_share * a.theory.along[axis_of_eyes(g)].elemental_pitch_mm)
        return "mix views";
    // Modulation behind a box falls to one half at 0.603 cycles per width, behind a gaussian at 0.441 cycles.
    const double cycles = bisected(0, 1, 40, [&](double f) { return figures_of(profile).transfer(f) > 0.5; }).in;
    const double z = g.content_depth_mm;
    for (const std::size_t k : {0u, 1u}) {
        const std::size_t axis = array_axis(g, k);
        const double wide = 2 * std::abs(z - distance_mm) * std::tan(deg[k] * degree / 2);
        const double finest = std::min(lens_limit_per_mm(d, g, a.theory, z, eye, axis), pixel_limit_per_mm(d, g, z));
        if ((!is_strips(d.array) || k == main) && cycles / wide < 0.5 * finest) return "blur the content";
    }
    return {};
}

/// "0.8 degrees" or, where the axes differ, "0.8 x 0.6 degrees"; four digits.
std::string degrees_text(const std::array<double, 2>& deg) {
    return deg[0] == deg[1] ? fmt::format("{:.4g} degrees", deg[0]) : fmt::format("{:.4g} x {:.4g} degrees", deg[0], deg[1]);
}

/// Returns the angle as options of the command line.
std::string option_text(const std::array<double, 2>& deg) {
    return fmt::format("--set 'diffuser.angle_deg=[{:.4g}, {:.4g}]'", deg[0], deg[1]);
}

}  // namespace

void advise_on_diffuser(Advised& a) {
    const Display& d = a.display;
    const Geometry& g = a.geometry;
    const bool strips = is_strips(d.array);
    if (strips && d.lens.type() == LensType::pinhole) return;  // a barrier is meant to be dark between its slits
    // Each axis has its angle 2 atan(S/2d) that closes the gaps, S the spread that joins neighbouring lenses' light there and d
    // the diffuser's height above the plane that limits the light: at the best distance (best_deg) and at the actual one (angle).
    const double eye = camera_distance_mm(d) - g.vertex_plane_mm, best_distance = best_distance_mm(d, g, a.theory, eye);
    const std::array<double, 2> joining = joining_spread_mm(g);
    const std::size_t main = joining[0] > 0 ? 0 : 1;  // strips need one angle alone
    std::array<double, 2> best_deg, height, angle;
    for (const std::size_t k : {0u, 1u}) {
        const std::size_t axis = array_axis(g, k);
        const double given = d.diffuser ? d.diffuser->angle_deg[k] : 0;  // stays, where it does not matter
        const auto closing = [&](double above) { return joining[k] > 0 ? gap_closing_angle_deg(joining[k], above) : given; };
        best_deg[k] = closing(g.vertex_plane_mm + best_distance - aperture_plane_mm(d, g, axis));
        height[k] = g.diffuser_z_mm.value_or(0) - aperture_plane_mm(d, g, axis);
        angle[k] = closing(height[k]);
    }
    const std::optional<std::string> harmful = harm(a, best_distance, best_deg, main);
    const std::string best =
        harmful ? fmt::format("Use lenses that fill more of their cells: a diffuser that closes the gaps would {}", *harmful)
                : fmt::format("{3} one of {0} {1:.5g} mm in front of the lenses (--set diffuser.distance_mm={1:.5g} {2})",
                              degrees_text(best_deg), best_distance, option_text(best_deg), d.diffuser ? "Use" : "Add");
    const auto [across, up] = band_contrast(d, g);
    const bool bands = (strips ? across : std::max(across, up)) > visible_band_contrast;
    const std::string seen =
        strips ? fmt::format("dark bands between the lenses (Michelson contrast {:.2f} across the strips)", across)
               : fmt::format("dark bands between the lenses (Michelson contrast {:.2f} across, {:.2f} upwards)", across, up);
    if (bands && !d.diffuser && !joined_by_pupil(d, g, eye))
        a.say("{}: the lenses do not fill their cells, and no diffuser closes the gaps. {}", seen, best);
    if (!d.diffuser) return;

    // Strips have views across them only, so only the spread across them can be too strong.
    const bool too_near = (strips ? angle[main] : std::max(angle[0], angle[1])) > strongest_deg;
    const auto [wide, high] = d.diffuser->angle_deg;
    const double strong = strips ? d.diffuser->angle_deg[main] : std::max(wide, high);
    if (bands) {
        // The spread 2 d tan(omega/2) of this diffuser, relative to the one that closes the gaps
        const auto spread = [&](std::size_t k) {
            return 2 * height[k] * std::tan(d.diffuser->angle_deg[k] * degree / 2) / joining[k];
        };
        const double distance = d.diffuser->distance_mm + height[main] * (1 / spread(main) - 1);  // where this diffuser joins them
        std::string remedy;
        if (!too_near && !harm(a, d.diffuser->distance_mm, angle, main))
            remedy = fmt::format("At its distance use {} ({})", degrees_text(angle), option_text(angle));
        else if (!harmful)
            remedy = best;
        if ((strips || (joining[0] == joining[1] && wide == high)) && distance > g.top_z_mm - g.vertex_plane_mm &&
            distance < eye / 2 && !harm(a, distance, d.diffuser->angle_deg, main))
            remedy += fmt::format("{1} its angle at a distance of {0:.5g} mm (--set diffuser.distance_mm={0:.5g})", distance,
                                  remedy.empty() ? "Keep" : ", or keep");
        if (remedy.empty()) remedy = best;
        const std::string spreads =
            strips ? fmt::format("{:.3g} lens pitches along the panel's {}; 1", spread(main), main == 0 ? "rows" : "columns")
                   : fmt::format("{:.3g} x {:.3g} lens pitches; 1 x 1", spread(0), spread(1));
        a.say("{}: the diffuser spreads lines of sight over {} would close the gaps. {}", seen, spreads, remedy);
    }
    if (strong > strongest_deg)
        a.say(
            "the diffuser ({:.4g} x {:.4g} degrees) is stronger than {:g} degrees: it mixes views far apart in a field of view of "
            "{:.4g} degrees. {:.4g} degrees close the gaps between lenses{}",
            wide, high, strongest_deg, a.theory.along[0].fov_elemental_deg, angle[main],
            too_near ? ", fewer at a greater distance (--set diffuser.distance_mm)" : "");
}

}  // namespace lfdsim
