#include "model/bands.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "model/numbers.h"
#include "model/prescription.h"

namespace lfdsim {
namespace {

/// Radius of a lens's pupil for lines of sight parallel to its axis, without the walls of its cell: the least of all aperture
/// radii, each divided by the height at which a paraxial ray passes it that comes from the viewer at height 1.
double pupil_radius_mm(const Display& d, const Geometry& g) {
    double radius = std::numeric_limits<double>::infinity(), height = 1, slope = 0, z = g.vertex_plane_mm;
    const auto narrow = [&](double aperture) { radius = std::min(radius, aperture / std::abs(height)); };
    for (std::size_t k = g.surfaces.size(); k-- > 0;) {
        const PlacedSurface& s = g.surfaces[k];
        height += slope * (z - s.z_mm);
        z = s.z_mm;
        narrow(s.semi_aperture_mm);
        if (d.lens.stop_radius_mm && s.z_mm == g.stop_z_mm) narrow(*d.lens.stop_radius_mm);
        // Going down, a surface with c < 0 is convex to the ray.
        slope = (s.index_above * slope + s.curvature_per_mm * (s.index_below - s.index_above) * height) / s.index_below;
    }
    return radius;
}

constexpr int bins = 32, places = 32 * bins, harmonics = places / 4;

/// Amplitudes of the waves cos(2 pi k x / p) in the share of a cell's height that is lit at x from the joint between two lenses,
/// for lenses of that radius in cells `pitch` wide and `other_pitch` high.
std::vector<double> lit_waves(double pitch, double other_pitch, double radius) {
    std::vector<double> amplitudes(harmonics), wave(2 * places);
    for (std::size_t m = 0; m < wave.size(); ++m) wave[m] = std::cos(pi * double(m) / places);
    for (std::size_t n = 0; n < places; ++n) {
        const double x = pitch * ((double(n) + 0.5) / places - 0.5);
        const double lit = std::abs(x) < radius ? std::min(2 * std::sqrt(radius * radius - x * x) / other_pitch, 1.) : 0;
        for (std::size_t k = 0; k < harmonics; ++k)
            amplitudes[k] += (k == 0 ? 1. : 2.) / places * lit * wave[k * (2 * n + 1) % wave.size()];
    }
    return amplitudes;
}

double sinc(double x) { return std::abs(x) < 1e-9 ? 1 : std::sin(x) / x; }

/// The diffuser's transfer factor along one of its axes for a wave of light of `frequency` periods per mm at the lenses.
double spread_transform(const Diffuser& diffuser, int axis, double height_mm, double frequency) {
    const double width = 2 * height_mm * std::tan(diffuser.angle_deg[std::size_t(axis)] * degree / 2), x = pi * frequency * width;
    if (diffuser.profile == Profile::gaussian) return std::exp(-x * x / (4 * std::numbers::ln2));
    return sinc(x);
}

double michelson_of(const std::vector<double>& waves) {
    double least = std::numeric_limits<double>::infinity(), greatest = 0;
    for (int b = 0; b < bins; ++b) {
        double light = 0;
        for (std::size_t k = 0; k < harmonics; ++k)
            light += waves[k] * sinc(pi * double(k) / bins) * std::cos(2 * pi * double(k) * (b + 0.5) / bins);
        least = std::min(least, std::max(light, 0.));
        greatest = std::max(greatest, light);
    }
    return greatest > 0 ? (greatest - least) / (greatest + least) : 0;
}

}  // namespace

double aperture_plane_mm(const Display& d, const Geometry& g, std::size_t axis) {
    if (d.lens.is_thin() || stop_at_entrance(d, g)) return g.entrance_z_mm;
    const PlacedSurface& last = g.surfaces.back();
    const bool filled = d.array.aperture == Aperture::cell;
    return last.z_mm + sag_mm(last.curvature_per_mm, last.conic, last.even_asphere,
                              filled ? std::min(d.array.pitch_mm[axis] / 2, last.semi_aperture_mm) : last.semi_aperture_mm);
}

double gap_closing_angle_deg(double pitch_mm, double height_mm) { return 2 * std::atan(pitch_mm / (2 * height_mm)) / degree; }

std::array<double, 2> band_contrast(const Display& d, const Geometry& g) {
    if (is_staggered(d.array) || is_strips(d.array)) return {nan, nan};  // the waves are those of rows and columns
    // Without an opaque surround light passes between the lenses too; a sheet of stops is black in any case.
    if (d.array.surround != Surround::opaque && !d.lens.stop_radius_mm) return {0, 0};
    const double turn = d.array.turn_deg() * degree, radius = pupil_radius_mm(d, g);
    std::array<double, 2> contrast{};
    for (const std::size_t axis : {0u, 1u}) {
        const double height = d.diffuser ? *g.diffuser_z_mm - aperture_plane_mm(d, g, axis) : 0, pitch = d.array.pitch_mm[axis];
        // The waves run along the array's axis, the diffuser spreads along the display's.
        const double across = axis == 0 ? std::cos(turn) : -std::sin(turn), up = axis == 0 ? std::sin(turn) : std::cos(turn);
        std::vector<double> seen = lit_waves(pitch, d.array.pitch_mm[1 - axis], radius);
        for (std::size_t k = 0; d.diffuser && k < seen.size(); ++k) {
            const double frequency = double(k) / pitch;
            seen[k] *= spread_transform(*d.diffuser, 0, height, frequency * across) *
                       spread_transform(*d.diffuser, 1, height, frequency * up);
        }
        contrast[axis] = michelson_of(seen);
    }
    return contrast;
}

}  // namespace lfdsim
