#include "analysis/aperture_wave.h"

#include "analysis/fourier.h"
#include "model/numbers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace lfdsim {
namespace {

/// Of a polygon that is its own mirror image in the origin, so that the mean is real: by Green's theorem a sum over the edges.
double polygon_mean(const std::vector<std::array<double, 2>>& corners, double nu_x, double nu_y) {
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

}  // namespace

ApertureShape aperture_shape(const Display& d, const Geometry& g) {
    using Form = ApertureShape::Form;
    const bool round = d.array.aperture == Aperture::circle || d.lens.stop_radius_mm;
    const Form form = g.lattice.strips ? Form::slit : round ? Form::disk : g.lattice.hexagonal ? Form::hexagon : Form::rectangle;
    return {form, g.clear_aperture_mm};
}

bool ApertureShape::holds(double x, double y) const {
    const double half_x = 0.5 * width_mm[0], half_y = 0.5 * width_mm[1];
    switch (form) {
        case Form::slit:
            return std::abs(x) <= half_x;
        case Form::disk:
            return x * x + y * y <= half_x * half_x;
        case Form::rectangle:
            return std::abs(x) <= half_x && std::abs(y) <= half_y;
        case Form::hexagon:
            break;
    }
    return std::abs(x) <= half_x && 0.5 * std::abs(x) + 0.5 * std::numbers::sqrt3 * std::abs(y) <= half_x;
}

double ApertureShape::most(double nu) const {
    const double border_per_area = form == Form::slit        ? 2 / width_mm[0]
                                   : form == Form::rectangle ? 2 / width_mm[0] + 2 / width_mm[1]
                                                             : 4 / width_mm[0];
    return std::min(1., border_per_area / (2 * pi * nu));
}

double ApertureShape::mean(double nu_x, double nu_y) const {
    switch (form) {
        case Form::slit:
            return sinc(nu_x * width_mm[0]);
        case Form::disk: {
            const double x = pi * width_mm[0] * std::hypot(nu_x, nu_y);
            return x < 1e-6 ? 1 : 2 * std::cyl_bessel_j(1, x) / x;
        }
        case Form::rectangle:
            return sinc(nu_x * width_mm[0]) * sinc(nu_y * width_mm[1]);
        case Form::hexagon:
            break;
    }
    const double half = 0.5 * width_mm[0], corner = half * 2 / std::numbers::sqrt3;
    return polygon_mean(
        {{half, -corner / 2}, {half, corner / 2}, {0, corner}, {-half, corner / 2}, {-half, -corner / 2}, {0, -corner}}, nu_x,
        nu_y);
}

}  // namespace lfdsim
