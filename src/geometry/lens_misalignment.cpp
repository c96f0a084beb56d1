#include "geometry/lens_misalignment.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace lfdsim {
namespace {

constexpr double most_sd = 3;  // standard deviations; a manufacturer rejects lenses that are further off

/// Returns 64 bits that look random, different ones for each number; a step of SplitMix64 (Steele, Lea and Flood 2014).
std::uint64_t mixed(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// Returns the upper 53 bits as a number x, 0 <= x < 1.
double unit(std::uint64_t bits) { return double(bits >> 11) * 0x1p-53; }

/// Returns exp(-y) for 0 <= y <= 4.5 to 1e-15, as (exp(-y/64))^64 by Taylor's series: of sums and products alone, which every
/// machine rounds alike.
double falling_exponential(double y) {
    const double x = -y / 64;
    double sum = 1;
    for (int k = 8; k > 0; --k) sum = 1 + sum * x / k;
    for (int k = 0; k < 6; ++k) sum *= sum;
    return sum;
}

/// Returns a number of the standard normal distribution within `most_sd`, by rejection: of numbers spread evenly there the share
/// exp(-x^2/2) is taken.
double normal(std::uint64_t key) {
    for (std::uint64_t attempt = 0;; ++attempt) {
        const std::uint64_t bits = mixed(key + attempt);
        const double x = most_sd * (2 * unit(bits) - 1);
        if (unit(mixed(bits)) < falling_exponential(x * x / 2)) return x;
    }
}

enum class Quantity : std::uint64_t { aside_x, aside_y, height, tilt_x, tilt_y, curvature };

/// The random numbers of lens (i, j): functions of seed, i, j and quantity alone.
class Draw {
  public:
    Draw(const Errors& e, std::int64_t i, std::int64_t j)
        : lens_(mixed(mixed(mixed(std::uint64_t(e.seed)) ^ std::uint64_t(i)) ^ std::uint64_t(j))) {}
    double operator()(Quantity quantity, double sd) const {
        return sd == 0 ? 0 : sd * normal(mixed(lens_ ^ std::uint64_t(quantity)));
    }

  private:
    std::uint64_t lens_;
};

/// Returns the random errors of lens (i, j). Strips move across themselves and tilt about their axes only.
LensError drawn(const LensArray& array, const Errors& e, std::int64_t i, std::int64_t j) {
    const Draw draw(e, i, j);
    const bool strips = is_strips(array);
    return {{draw(Quantity::aside_x, e.decenter_sd_mm), draw(Quantity::aside_y, strips ? 0 : e.decenter_sd_mm)},
            draw(Quantity::height, e.height_sd_mm),
            {draw(Quantity::tilt_x, strips ? 0 : e.tilt_sd_deg), draw(Quantity::tilt_y, e.tilt_sd_deg)},
            draw(Quantity::curvature, e.curvature_sd)};
}

/// Returns whether lenses have individual errors, drawn or given.
bool of_each_lens(const Errors& e) {
    return e.decenter_sd_mm != 0 || e.height_sd_mm != 0 || e.tilt_sd_deg != 0 || e.curvature_sd != 0 || e.given;
}

}  // namespace

bool lenses_differ(const Errors& e) { return of_each_lens(e) || e.bow_mm != 0; }

bool is_wedged(const Errors& e) { return e.wedge_deg[0] != 0 || e.wedge_deg[1] != 0; }

bool is_irregular(const Errors& e) { return lenses_differ(e) || is_wedged(e); }

bool has_errors(const Errors& e) {
    Errors none;
    none.seed = e.seed;
    return e != none;
}

Display without_errors(Display d) {
    d.errors = {};
    return d;
}

bool knows_no_errors(const Display& d) { return d.content.made_for == MadeFor::description && has_errors(d.errors); }

LensErrorBounds bounds(const LensArray& array, const Errors& e) {
    LensErrorBounds b;
    const bool strips = is_strips(array);
    b.aside_mm = {most_sd * e.decenter_sd_mm, strips ? 0 : most_sd * e.decenter_sd_mm};
    b.tilt_deg = {strips ? 0 : most_sd * e.tilt_sd_deg, most_sd * e.tilt_sd_deg};
    LensErrorBounds table;
    if (e.given)
        for (const GivenLensError& lens : *e.given) {
            for (std::size_t k = 0; k < 2; ++k) {
                table.aside_mm[k] = std::max(table.aside_mm[k], std::abs(lens.error.aside_mm[k]));
                table.tilt_deg[k] = std::max(table.tilt_deg[k], std::abs(lens.error.tilt_deg[k]));
            }
            const auto widen = [](double(&range)[2], double x) {
                range[0] = std::min(range[0], x), range[1] = std::max(range[1], x);
            };
            widen(table.height_mm, lens.error.height_mm);
            widen(table.curvature, lens.error.curvature);
        }
    for (std::size_t k = 0; k < 2; ++k) {
        b.aside_mm[k] += table.aside_mm[k];
        b.tilt_deg[k] += table.tilt_deg[k];
        const double side = k == 0 ? -most_sd : most_sd;
        b.height_mm[k] = side * e.height_sd_mm + table.height_mm[k];
        b.curvature[k] = side * e.curvature_sd + table.curvature[k];
    }
    return b;
}

std::vector<LensError> lens_errors(const Display& d, const Lattice<double>& lattice) {
    const Errors& e = d.errors;
    const auto columns = std::int64_t(lattice.count[0]), rows = std::int64_t(lattice.count[1]);
    std::vector<LensError> all(std::size_t(columns * rows));
    if (!of_each_lens(e)) return all;
    for (std::int64_t j = 0; j < rows; ++j)
        for (std::int64_t i = 0; i < columns; ++i) all[std::size_t(j * columns + i)] = drawn(d.array, e, i, j);
    if (!e.given) return all;
    for (const GivenLensError& lens : *e.given) {
        LensError& to = all[std::size_t(lens.j * columns + lens.i)];
        for (std::size_t k = 0; k < 2; ++k) {
            to.aside_mm[k] += lens.error.aside_mm[k];
            to.tilt_deg[k] += lens.error.tilt_deg[k];
        }
        to.height_mm += lens.error.height_mm;
        to.curvature += lens.error.curvature;
    }
    return all;
}

double raised_mm(const Errors& e, const Lattice<double>& lattice, double x, double y) {
    const double half_x = lattice.count[0] * lattice.pitch[0] / 2,
                 half_y = lattice.strips ? 0 : lattice.count[1] * lattice.pitch[1] / 2;
    if (lattice.strips) y = 0;
    return e.bow_mm * (1 - (x * x + y * y) / (half_x * half_x + half_y * half_y));
}

}  // namespace lfdsim
