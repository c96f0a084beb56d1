#include "geometry/dark_bands.h"

#include "base/constants.h"
#include "base/sinc.h"
#include "geometry/diffuser_profile.h"
#include "geometry/prescription.h"
#include "geometry/resolve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

namespace lfdsim {
namespace {

constexpr int bins = 32, places = 32 * bins, harmonics = places / 4;

/// Amplitudes of the waves cos(2 pi k x / p) in the share of a cell's height that is lit at x from the joint between two
/// lenses, for pupils of that radius, and no more than that part of their cells, in cells `pitch` wide and `other_pitch` high.
std::vector<double> lit_waves(double pitch, double other_pitch, const Pupil& pupil) {
    const double radius = pupil.radius_mm, half = 0.5 * pupil.cells * pitch;
    std::vector<double> amplitudes(harmonics), wave(2 * places);
    for (std::size_t m = 0; m < wave.size(); ++m) wave[m] = std::cos(pi * double(m) / places);
    for (std::size_t n = 0; n < places; ++n) {
        const double x = pitch * ((double(n) + 0.5) / places - 0.5);
        const double lit =
            std::abs(x) < std::min(radius, half) ? std::min(2 * std::sqrt(radius * radius - x * x) / other_pitch, pupil.cells) : 0;
        for (std::size_t k = 0; k < harmonics; ++k)
            amplitudes[k] += (k == 0 ? 1. : 2.) / places * lit * wave[k * (2 * n + 1) % wave.size()];
    }
    return amplitudes;
}

/// The diffuser's transfer factor along one of its axes for a wave of light of `frequency` periods per mm at the lenses.
double spread_transform(const Diffuser& diffuser, int axis, double height_mm, double frequency) {
    const double width = 2 * height_mm * std::tan(diffuser.angle_deg[std::size_t(axis)] * degree / 2);
    return figures_of(diffuser.profile).transfer(frequency * width);
}

/// The diffuser's transfer factor for a wave over the array's own x and y, periods per mm.
class DiffuserTransfer {
  public:
    DiffuserTransfer(const Display& d, const Geometry& g, std::size_t axis)
        : diffuser_(d.diffuser),
          height_mm_(d.diffuser ? *g.diffuser_z_mm - aperture_plane_mm(d, g, axis) : 0),
          cosine_(g.lattice.cos_turn),
          sine_(g.lattice.sin_turn) {}

    double operator()(double across, double up) const {
        if (!diffuser_) return 1;
        return spread_transform(*diffuser_, 0, height_mm_, across * cosine_ - up * sine_) *
               spread_transform(*diffuser_, 1, height_mm_, across * sine_ + up * cosine_);
    }

  private:
    const std::optional<Diffuser>& diffuser_;
    double height_mm_, cosine_, sine_;
};

/// Strips that are lit for |x| < radius: waves from joint to joint, after the diffuser.
std::vector<double> strip_waves(double pitch, double radius, const DiffuserTransfer& spread) {
    std::vector<double> waves(harmonics);
    waves[0] = std::min(2 * radius / pitch, 1.);
    for (std::size_t k = 1; k < waves.size(); ++k) {
        const double order = double(k), lit = 2 * std::sin(2 * pi * order * std::min(radius / pitch, 0.5)) / (pi * order);
        waves[k] = (k % 2 == 0 ? 1 : -1) * lit * spread(order / pitch, 0);
    }
    return waves;
}

/// Lenses in staggered rows, lit within their pupils in their cells: their light has the waves (m/px, n/2py) with m + n even.
class StaggeredLight {
  public:
    StaggeredLight(const Lattice<double>& lattice, const Pupil& pupil) : lattice_(lattice), wave_(2 * places) {
        const double radius = pupil.radius_mm, part = pupil.cells;
        for (std::size_t m = 0; m < wave_.size(); ++m) wave_[m] = std::cos(pi * double(m) / places);
        for (std::size_t n = 0; n < places; ++n) {
            const double x = lattice.pitch[0] * ((double(n) + 0.5) / places - 0.5), p = lattice.pitch[0];
            const double cell = lattice.hexagonal ? (part * p - std::abs(x)) / std::numbers::sqrt3 : 0.5 * part * lattice.pitch[1];
            const bool lit = std::abs(x) < std::min(radius, 0.5 * part * p);
            lit_half_[n] = lit ? std::min(std::sqrt(radius * radius - x * x), cell) : 0;
        }
    }

    /// The mean along one row of what is seen across a pitch, from joint to joint.
    std::vector<double> across(const DiffuserTransfer& spread) const {
        constexpr int most_m = 128, most_n = 63;
        std::vector<double> waves(harmonics);
        const double px = lattice_.pitch[0], py = lattice_.pitch[1];
        for (int m = 0; m <= most_m; m += 2) waves[std::size_t(m)] = (m == 0 ? 1 : 2) * amplitude(m, chords(0)) * spread(m / px, 0);
        for (int n = 1; n <= most_n; n += 2) {  // waves of an even order along y vanish in the mean over a row
            const std::vector<double> of_n = chords(n);
            const double mean = sinc(0.5 * n), up = 0.5 * n / py;
            for (int m = 1; m <= most_m; m += 2)
                waves[std::size_t(m)] += 2 * amplitude(m, of_n) * mean * (spread(m / px, up) + spread(m / px, -up));
        }
        return waves;
    }

    /// The mean along x of what is seen from row to row.
    std::vector<double> up(const DiffuserTransfer& spread) const {
        std::vector<double> waves(harmonics);
        for (int k = 0; k < 128; ++k)
            waves[std::size_t(k)] = (k == 0 ? 1 : 2) * amplitude(0, chords(2 * k)) * spread(0, k / lattice_.pitch[1]);
        return waves;
    }

  private:
    /// The integral of cos(2 pi n y / 2py) over the lit chord at each place across, in units of py.
    std::vector<double> chords(int n) const {
        std::vector<double> all(places);
        const double pitch = lattice_.pitch[1];
        for (std::size_t k = 0; k < places; ++k) all[k] = 2 * lit_half_[k] * sinc(n * lit_half_[k] / pitch) / pitch;
        return all;
    }
    /// The amplitude of the wave cos(2 pi m x / px), x from a joint.
    double amplitude(int m, const std::vector<double>& chord) const {
        double sum = 0;
        for (std::size_t n = 0; n < places; ++n) sum += chord[n] * wave_[std::size_t(m) * (2 * n + 1) % wave_.size()];
        return sum / places;
    }

    const Lattice<double>& lattice_;
    std::vector<double> wave_;
    std::array<double, places> lit_half_{};
};

double michelson_of(const std::vector<double>& waves) {
    double least = std::numeric_limits<double>::infinity(), greatest = 0;
    for (int b = 0; b < bins; ++b) {
        double light = 0;
        for (std::size_t k = 0; k < harmonics; ++k)
            light += waves[k] * sinc(double(k) / bins) * std::cos(2 * pi * double(k) * (b + 0.5) / bins);
        least = std::min(least, std::max(light, 0.));
        greatest = std::max(greatest, light);
    }
    constexpr double rounding = 1e-12;  // of the sums: what lies below it is an even light
    return greatest - least > rounding * greatest ? (greatest - least) / (greatest + least) : 0;
}

}  // namespace

double aperture_plane_mm(const Display& d, const Geometry& g, std::size_t axis) {
    const bool filled = d.array.aperture == Aperture::cell, round = !filled || g.pupil.radius_mm < outer_radius_mm(d, g);
    if (g.pupil.inner_z && round) return *g.pupil.inner_z;
    if (d.lens.is_thin() || stop_at_entrance(d, g)) return g.entrance_z_mm;
    const PlacedSurface& last = g.surfaces.back();
    return last.z_mm + sag_mm(last, filled ? std::min(lens_pitch_mm(g, axis) / 2, last.semi_aperture_mm) : last.semi_aperture_mm);
}

std::array<double, 2> joining_spread_mm(const Geometry& g) {
    // Waves of the frequency k/p along an axis at the angle alpha to the display's nearest one have k cos(alpha)/p along that: a
    // box of the width p/cos(alpha) leaves none of them.
    const Lattice<double>& l = g.lattice;
    const double c = std::abs(l.cos_turn), s = std::abs(l.sin_turn), across = l.pitch[0] / std::max(c, s),
                 up = l.strips ? 0 : l.pitch[1] / std::max(c, s);
    std::array<double, 2> spread = c >= s ? std::array{across, up} : std::array{up, across};
    if (!l.staggered || std::min(c, s) < 1e-9) return spread;
    // Staggered rows have the waves (m/px, n/2py), m + n even. Where they are rotated, no box leaves none of the longest: it is
    // made wider or narrower so that the strongest that is left is as weak as possible.
    const auto left = [&](double scale) {
        double most = 0;
        for (const auto& [m, n] : {std::array{1., 1.}, {1., -1.}, {0., 2.}, {2., 0.}}) {
            const double x = m / l.pitch[0], y = n / (2 * l.pitch[1]);
            most = std::max(most, std::abs(sinc(scale * spread[0] * (x * l.cos_turn - y * l.sin_turn)) *
                                           sinc(scale * spread[1] * (x * l.sin_turn + y * l.cos_turn))));
        }
        return most;
    };
    double best = 1;
    for (double scale = 0.7; scale < 1.5; scale += 0.01)
        if (left(scale) < left(best)) best = scale;
    return {best * spread[0], best * spread[1]};
}

double gap_closing_angle_deg(double pitch_mm, double height_mm) { return 2 * std::atan(pitch_mm / (2 * height_mm)) / degree; }

std::array<double, 2> band_contrast(const Display& d, const Geometry& g) {
    // Without an opaque surround light passes between the lenses too; a sheet of stops is black in any case.
    const bool strips = is_strips(d.array);
    if (d.array.surround != Surround::opaque && !d.lens.stop_radius_mm) return {0, strips ? nan : 0};
    Pupil pupil = g.pupil;
    if (d.array.aperture == Aperture::circle) pupil.cells = 1;
    const bool whole = pupil.cells == 1 && pupil.radius_mm >= outer_radius_mm(d, g);
    if (strips) {
        const double half = std::min(pupil.radius_mm, 0.5 * pupil.cells * g.lattice.pitch[0]);
        return {whole ? 0 : michelson_of(strip_waves(g.lattice.pitch[0], half, {d, g, 0})), nan};
    }
    if (is_staggered(d.array)) {
        if (whole) return {0, 0};
        const StaggeredLight light(g.lattice, pupil);
        return {michelson_of(light.across({d, g, 0})), michelson_of(light.up({d, g, 1}))};
    }
    std::array<double, 2> contrast{};
    for (const std::size_t axis : {0u, 1u}) {
        const double height = d.diffuser ? *g.diffuser_z_mm - aperture_plane_mm(d, g, axis) : 0, pitch = g.lattice.pitch[axis];
        // The waves run along the array's axis, the diffuser spreads along the display's.
        const double c = g.lattice.cos_turn, s = g.lattice.sin_turn, across = axis == 0 ? c : -s, up = axis == 0 ? s : c;
        std::vector<double> seen = lit_waves(pitch, g.lattice.pitch[1 - axis], pupil);
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
