#include "analysis/spots/aperture_wave.h"

#include "base/constants.h"
#include "base/sinc.h"
#include "geometry/resolve.h"
#include "optics/lattice.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lfdsim {
namespace {

using Corners = ApertureShape::Corners;

/// Returns the mean of exp(-2 pi i nu.q) over a polygon that is its own mirror image in the origin. By Green's theorem it is the
/// sum over edges e with the middle m of (nu x e) sinc(nu.e) sin(2 pi nu.m), over 2 pi |nu|^2 times the area.
double polygon_mean(const Corners& corners, double nu_x, double nu_y) {
    double area = 0, sum = 0;
    const double nu2 = nu_x * nu_x + nu_y * nu_y;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const auto &a = corners[k], &b = corners[(k + 1) % corners.size()];
        const double ex = b[0] - a[0], ey = b[1] - a[1];
        area += 0.5 * (a[0] * b[1] - b[0] * a[1]);
        const double middle = 0.5 * (nu_x * (a[0] + b[0]) + nu_y * (a[1] + b[1]));
        sum += (nu_x * ey - nu_y * ex) * sinc(nu_x * ex + nu_y * ey) * std::sin(2 * pi * middle);
    }
    return std::sqrt(nu2) * std::sqrt(std::abs(area)) < 1e-6 ? 1 : sum / (2 * pi * nu2 * area);
}

double area_of(const Corners& corners) {
    double area = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const auto &a = corners[k], &b = corners[(k + 1) % corners.size()];
        area += 0.5 * (a[0] * b[1] - b[0] * a[1]);
    }
    return area;
}

double border_of(const Corners& corners) {
    double length = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const auto &a = corners[k], &b = corners[(k + 1) % corners.size()];
        length += std::hypot(b[0] - a[0], b[1] - a[1]);
    }
    return length;
}

/// Returns the part of a convex polygon with position[axis] <= limit.
Corners cut_off(const Corners& corners, std::size_t axis, double limit) {
    Corners kept;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const auto &a = corners[k], &b = corners[(k + 1) % corners.size()];
        if (a[axis] <= limit) kept.push_back(a);
        if ((a[axis] < limit) == (b[axis] < limit)) continue;
        const double share = (limit - a[axis]) / (b[axis] - a[axis]);
        kept.push_back({a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])});
    }
    return kept;
}

Corners rectangle(double half_x, double half_y) {
    return {{half_x, -half_y}, {half_x, half_y}, {-half_x, half_y}, {-half_x, -half_y}};
}

/// Adds an arc as chords between equal angles. They lie a little outside of the circle, such that each triangle has its sector's
/// area: R^2 sin(step) = r^2 step.
void add_arc(Corners& to, double radius, double from, double until, int chords) {
    const double step = (until - from) / chords, outer = radius * std::sqrt(step / std::sin(step));
    for (int k = 0; k <= chords; ++k) to.push_back({outer * std::cos(from + step * k), outer * std::sin(from + step * k)});
}

/// Returns the part of a convex polygon about the origin within a circle that cuts off all of its corners and leaves parts of
/// some sides.
Corners within_circle(const Corners& corners, double radius) {
    constexpr int chords_a_turn = 192;
    std::vector<std::array<double, 2>> sides;  // the angles from which to which each of the remaining sides is the border
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const auto &a = corners[k], &b = corners[(k + 1) % corners.size()];
        const double ex = b[0] - a[0], ey = b[1] - a[1], away = (a[0] * ey - a[1] * ex) / std::hypot(ex, ey);
        if (away >= radius) continue;
        const double half = std::acos(away / radius), middle = std::atan2(-ex, ey);
        sides.push_back({middle - half, middle + half});
    }
    Corners cut;
    for (std::size_t k = 0; k < sides.size(); ++k) {
        // The arc from the end of a side to the beginning of the next
        const double from = sides[k][1];
        double until = sides[(k + 1) % sides.size()][0];
        while (until < from) until += 2 * pi;
        add_arc(cut, radius, from, until, std::max(1, int(std::ceil((until - from) / (2 * pi) * chords_a_turn))));
    }
    return cut;
}

}  // namespace

Corners cell_polygon(const Lattice<double>& lattice, double scale) {
    const auto cell = optics::corners_of_cell(lattice);
    Corners corners;
    for (int k = 0; k < cell.count; ++k) corners.push_back({scale * cell.x[k], scale * cell.y[k]});
    return corners;
}

ApertureShape aperture_shape(const Display& d, const Geometry& g) {
    using ApertureForm = ApertureShape::ApertureForm;
    const Pupil& pupil = g.pupil;
    if (g.lattice.strips) return {ApertureForm::slit, g.clear_aperture_mm};
    if (d.array.aperture == Aperture::circle) return {ApertureForm::disk, g.clear_aperture_mm};
    // A cell that the pupil contains, or that contains the pupil, is not cut.
    const std::array<double, 2> cell{pupil.cells * lens_pitch_mm(g, 0), pupil.cells * lens_pitch_mm(g, 1)};
    const Corners corners = cell_polygon(g.lattice, pupil.cells);
    if (pupil.radius_mm <= 0.5 * std::min(cell[0], cell[1])) return {ApertureForm::disk, g.clear_aperture_mm};
    if (pupil.radius_mm >= pupil.cells * outer_radius_mm(d, g) * (1 - 1e-12)) {
        if (corners.size() == 4) return {ApertureForm::rectangle, cell};
        return {ApertureForm::polygon, cell, corners};
    }
    return {ApertureForm::polygon, g.clear_aperture_mm, within_circle(corners, pupil.radius_mm)};
}

bool ApertureShape::holds(double x, double y) const {
    const double half_x = 0.5 * width_mm[0], half_y = 0.5 * width_mm[1];
    switch (form) {
        case ApertureForm::slit:
            return std::abs(x) <= half_x;
        case ApertureForm::disk:
            return x * x + y * y <= half_x * half_x;
        case ApertureForm::rectangle:
            return std::abs(x) <= half_x && std::abs(y) <= half_y;
        case ApertureForm::polygon:
            break;
    }
    // The position must lie to the left of each edge.
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const auto &a = outline[k], &b = outline[(k + 1) % outline.size()];
        if ((b[0] - a[0]) * (y - a[1]) < (b[1] - a[1]) * (x - a[0])) return false;
    }
    return true;
}

double ApertureShape::most(double nu) const {
    const double border_per_area = form == ApertureForm::slit        ? 2 / width_mm[0]
                                   : form == ApertureForm::rectangle ? 2 / width_mm[0] + 2 / width_mm[1]
                                   : form == ApertureForm::polygon   ? border_of(outline) / area_of(outline)
                                                                     : 4 / width_mm[0];
    return std::min(1., border_per_area / (2 * pi * nu));
}

double ApertureShape::mean(double nu_x, double nu_y) const {
    switch (form) {
        case ApertureForm::slit:
            return sinc(nu_x * width_mm[0]);
        case ApertureForm::disk: {
            const double x = pi * width_mm[0] * std::hypot(nu_x, nu_y);
            return x < 1e-6 ? 1 : 2 * std::cyl_bessel_j(1, x) / x;
        }
        case ApertureForm::rectangle:
            return sinc(nu_x * width_mm[0]) * sinc(nu_y * width_mm[1]);
        case ApertureForm::polygon:
            break;
    }
    return polygon_mean(outline, nu_x, nu_y);
}

double ApertureShape::extent_mm(std::size_t axis) const {
    if (form != ApertureForm::polygon) return width_mm[axis];
    double greatest = 0;
    for (const auto& corner : outline) greatest = std::max(greatest, corner[axis]);
    return 2 * greatest;
}

double ApertureShape::below(std::size_t axis, double place) const {
    const double u = std::clamp(2 * place / width_mm[axis], -1., 1.);
    if (form == ApertureForm::slit || form == ApertureForm::rectangle) return 0.5 * (1 + u);
    if (form == ApertureForm::disk) return 0.5 + (u * std::sqrt(1 - u * u) + std::asin(u)) / pi;  // segment of a circle
    return area_of(cut_off(outline, axis, place)) / area_of(outline);
}

ApertureShape::Corners ApertureShape::corners(double length_mm) const {
    constexpr int drawn = 60;
    const double half_x = 0.5 * width_mm[0];
    Corners disk;
    switch (form) {
        case ApertureForm::slit:
            return rectangle(half_x, 0.5 * length_mm);
        case ApertureForm::rectangle:
            return rectangle(half_x, 0.5 * width_mm[1]);
        case ApertureForm::polygon:
            return outline;
        case ApertureForm::disk:
            break;
    }
    for (int k = 0; k < drawn; ++k) disk.push_back({half_x * std::cos(2 * pi * k / drawn), half_x * std::sin(2 * pi * k / drawn)});
    return disk;
}

}  // namespace lfdsim
