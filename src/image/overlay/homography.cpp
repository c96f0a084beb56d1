#include "image/overlay/homography.h"

#include "base/input_error.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

using Matrix = std::array<double, 9>;

constexpr const char* names[] = {"top left", "top right", "bottom right", "bottom left"};
constexpr double least_side = 16, least_sine = 0.0175;  // pixels; of 1 degree

// Returns the map of the unit square's corners (0,0), (1,0), (1,1), (0,1) to p: Heckbert 1989, section 2.2.3.
Matrix from_square(const Corners& p) {
    const auto& [p0, p1, p2, p3] = p;
    const double sx = p0[0] - p1[0] + p2[0] - p3[0], sy = p0[1] - p1[1] + p2[1] - p3[1];
    const double dx1 = p1[0] - p2[0], dx2 = p3[0] - p2[0], dy1 = p1[1] - p2[1], dy2 = p3[1] - p2[1];
    const double area = dx1 * dy2 - dx2 * dy1;
    const double g = (sx * dy2 - dx2 * sy) / area, h = (dx1 * sy - sx * dy1) / area;
    return {p1[0] - p0[0] + g * p1[0],
            p3[0] - p0[0] + h * p3[0],
            p0[0],
            p1[1] - p0[1] + g * p1[1],
            p3[1] - p0[1] + h * p3[1],
            p0[1],
            g,
            h,
            1};
}

// Returns the inverse up to a factor, which cancels in a homography.
Matrix adjugate(const Matrix& m) {
    const auto minor = [&](int a, int b, int c, int d) {
        return m[std::size_t(a)] * m[std::size_t(d)] - m[std::size_t(b)] * m[std::size_t(c)];
    };
    return {minor(4, 5, 7, 8), minor(2, 1, 8, 7), minor(1, 2, 4, 5), minor(5, 3, 8, 6), minor(0, 2, 6, 8),
            minor(2, 0, 5, 3), minor(3, 4, 6, 7), minor(1, 0, 7, 6), minor(0, 1, 3, 4)};
}

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix c{};
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column)
            for (std::size_t k = 0; k < 3; ++k) c[3 * row + column] += a[3 * row + k] * b[3 * k + column];
    return c;
}

}  // namespace

void check_corners(const std::string& where, const Corners& corners) {
    constexpr const char* order = "give top left, top right, bottom right, bottom left of the screen as its viewer sees it";
    const auto named = [&](std::size_t k) { return fmt::format("{} ({:g},{:g})", names[k], corners[k][0], corners[k][1]); };
    std::array<double, 4> sines;  // of the change of direction to the right at each corner
    for (std::size_t k = 0; k < 4; ++k) {
        const Point &before = corners[(k + 3) % 4], &here = corners[k], &after = corners[(k + 1) % 4];
        const double ax = here[0] - before[0], ay = here[1] - before[1], bx = after[0] - here[0], by = after[1] - here[1];
        if (const double side = std::hypot(bx, by); !(side >= least_side))
            throw InputError(where, fmt::format("{} and {} are {:.3g} pixels apart; {} or more are needed", named(k),
                                                named((k + 1) % 4), side, least_side));
        sines[k] = (ax * by - ay * bx) / (std::hypot(ax, ay) * std::hypot(bx, by));  // y counts downwards
    }
    if (std::all_of(sines.begin(), sines.end(), [](double sine) { return sine > least_sine; })) return;
    if (std::all_of(sines.begin(), sines.end(), [](double sine) { return sine < -least_sine; }))
        throw InputError(where, fmt::format("the corners run counter-clockwise, as in a mirror; {}", order));
    const auto wrong = std::find_if(sines.begin(), sines.end(), [](double sine) { return !(sine > least_sine); }) - sines.begin();
    throw InputError(where,
                     fmt::format("the corners do not make a convex quadrilateral: see {}; {}", named(std::size_t(wrong)), order));
}

Homography::Homography(const Corners& from, const Corners& to) : m_(product(from_square(to), adjugate(from_square(from)))) {
    const double scale = 1 / w(from[0][0], from[0][1]);
    for (double& x : m_) x *= scale;
}

Point Homography::operator()(double x, double y) const {
    const double per_w = 1 / w(x, y);
    return {(m_[0] * x + m_[1] * y + m_[2]) * per_w, (m_[3] * x + m_[4] * y + m_[5]) * per_w};
}

// With p = (X/w, Y/w): dp/dx = (a - p_x g)/w, (d - p_y g)/w, and by y with b, e and h.
std::array<Point, 2> Homography::derivatives(double x, double y) const {
    const Point p = (*this)(x, y);
    const double per_w = 1 / w(x, y);
    return {Point{(m_[0] - p[0] * m_[6]) * per_w, (m_[3] - p[1] * m_[6]) * per_w},
            Point{(m_[1] - p[0] * m_[7]) * per_w, (m_[4] - p[1] * m_[7]) * per_w}};
}

}  // namespace lfdsim
