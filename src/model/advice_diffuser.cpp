#include "model/advice_parts.h"
#include "model/bands.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lfdsim {
namespace {

constexpr double strongest_deg = 30;  // beyond it light of any usual field of view mixes

/// Where a diffuser may best be put that is not there yet: on the central depth plane, as long as that lies well before the eye.
double best_distance_mm(const Geometry& g, const Theory& t, double pitch, double eye_mm) {
    const double central = g.rear_principal_mm + t.central_depth_mm - g.vertex_plane_mm;
    return central > g.top_z_mm - g.vertex_plane_mm && central < eye_mm / 2 ? central : std::min(20 * pitch, eye_mm / 2);
}

/// Whether a pupil does what a diffuser would: out of focus at the lenses, it sees each of their places as a disk of A |1 - E/F|.
/// One of three pitches leaves of the finest dots bands of a contrast of 0.08, twice the fourth lobe of 2 J1(x)/x.
bool joined_by_pupil(const Display& d, const Geometry& g, double eye) {
    return d.camera.pupil_diameter_mm.value_or(0) * std::abs(1 - eye / g.focus_distance_mm) >= 3 * d.array.pitch_mm;
}

}  // namespace

void advise_on_diffuser(Advised& a) {
    const Display& d = a.display;
    const Geometry& g = a.geometry;
    const double p = d.array.pitch_mm, eye = eye_distance_mm(d) - g.vertex_plane_mm;
    const double best_distance = best_distance_mm(g, a.theory, p, eye),
                 best_angle = gap_closing_angle_deg(p, g.vertex_plane_mm + best_distance - aperture_plane_mm(d, g));
    const std::string best = fmt::format(
        "{0:.4g} degrees {1:.5g} mm before the lenses (--set diffuser.distance_mm={1:.5g} --set 'diffuser.angle_deg=[{0:.4g}, "
        "{0:.4g}]')",
        best_angle, best_distance);
    const auto [across, up] = band_contrast(d, g);
    const bool bands = std::max(across, up) > visible_band_contrast;
    const std::string seen =
        fmt::format("dark bands between the lenses (Michelson contrast {:.2f} across, {:.2f} upwards)", across, up);
    if (bands && !d.diffuser && !joined_by_pupil(d, g, eye))
        a.say("{}: the lenses do not fill their cells, and no diffuser joins them. One would, of {}", seen, best);
    if (!d.diffuser) return;

    const double height = *g.diffuser_z_mm - aperture_plane_mm(d, g), angle = a.theory.gap_closing_here_deg;
    const auto [wide, high] = d.diffuser->angle_deg;
    if (bands) {
        const auto spread = [&](double deg) { return 2 * height * std::tan(deg * std::numbers::pi / 360); };
        const double distance = d.diffuser->distance_mm + height * (p / spread(wide) - 1);  // where this diffuser joins them
        std::string remedy =
            angle > strongest_deg
                ? "It takes " + best
                : fmt::format("Where it stands it takes {0:.4g} degrees (--set 'diffuser.angle_deg=[{0:.4g}, {0:.4g}]')", angle);
        if (wide == high && distance > g.top_z_mm - g.vertex_plane_mm && distance < eye / 2)
            remedy += fmt::format(", or with its angle a distance of {0:.5g} mm (--set diffuser.distance_mm={0:.5g})", distance);
        a.say("{}: the diffuser spreads lines of sight over {:.3g} x {:.3g} lens pitches, 1 x 1 join the lenses. {}", seen,
              spread(wide) / p, spread(high) / p, remedy);
    }
    if (std::max(wide, high) > strongest_deg)
        a.say(
            "the diffuser ({:.4g} x {:.4g} degrees) is stronger than {:g} degrees: it mixes views far apart, of a field of view of "
            "{:.4g} degrees. The lenses are joined by {:.4g} degrees{}",
            wide, high, strongest_deg, a.theory.fov_elemental_deg, angle,
            angle > strongest_deg ? ", by less from farther before them (--set diffuser.distance_mm)" : "");
}

}  // namespace lfdsim
