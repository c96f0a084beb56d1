// Light through opaque arrays of plano-convex lenses, flat towards the panel, ray by ray, forwards and backwards: written anew from
// Snell's and Fresnel's laws, with random numbers of its own. It shares nothing with the program but the description.
#pragma once
#include "geometry/geometry.h"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

namespace lfdsim::brute {

using Vec = std::array<double, 3>;

inline double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vec along(const Vec& a, const Vec& d, double t) { return {a[0] + t * d[0], a[1] + t * d[1], a[2] + t * d[2]}; }

/// Refracts the unit vector d at a surface with the unit normal n against it, from index n1 to n2; what passes, by the amplitudes
/// of both polarisations; 0 at total reflection.
inline double refract(Vec& d, const Vec& n, double n1, double n2) {
    const double c1 = -dot(d, n), s2 = n1 / n2 * n1 / n2 * (1 - c1 * c1);
    if (s2 >= 1) return 0;
    const double c2 = std::sqrt(1 - s2);
    for (std::size_t k = 0; k < 3; ++k) d[k] = n1 / n2 * d[k] + (n1 / n2 * c1 - c2) * n[k];
    const double rs = (n1 * c1 - n2 * c2) / (n1 * c1 + n2 * c2), rp = (n2 * c1 - n1 * c2) / (n2 * c1 + n1 * c2);
    return 1 - 0.5 * (rs * rs + rp * rp);
}

class PlanoConvexArray {
  public:
    PlanoConvexArray(const Display& d, unsigned seed) : d_(d), engine_(seed) {
        r_ = *d.lens.as<PlanoConvex>().aperture_radius_mm;
        sphere_ = d.lens.as<PlanoConvex>().sphere_radius_mm;
        index_ = *d.lens.as<PlanoConvex>().index;
        pitch_ = d.array.pitch_mm[0];
        const double root = std::sqrt(sphere_ * sphere_ - r_ * r_);
        const double thickness = d.lens.as<PlanoConvex>().cylinder_height_mm + sphere_ - root;
        flat_ = *d.array.gap_mm - thickness / index_;  // g counts to the principal plane T/n inside... from the flat face
        for (const Layer& layer : d.panel.layers) {    // ... and layers by their thickness over the index
            flat_ += layer.thickness_mm - layer.thickness_mm / *layer.index;
            layers_ += layer.thickness_mm;
        }
        glued_ = flat_ - layers_ < 1e-6;
        rim_ = flat_ + d.lens.as<PlanoConvex>().cylinder_height_mm;
        centre_ = rim_ - root;
        top_ = flat_ + thickness;
        width_ = double(d.panel.pixels[0]) * d.panel.pixel_pitch_mm;
        height_ = double(d.panel.pixels[1]) * d.panel.pixel_pitch_mm;
    }
    double number(double low, double high) { return low + (high - low) * double(engine_() >> 11) * 0x1p-53; }

    /// Mean radiance that an eye sees of the array's rectangle (in the plane of the apexes), by random rays.
    double luminance(const Vec& eye, int rays) {
        double sum = 0;
        const double w = double(d_.array.count->at(0)) * pitch_, h = double(d_.array.count->at(1)) * pitch_;
        for (int n = 0; n < rays; ++n) {
            const Vec at{number(-w / 2, w / 2), number(-h / 2, h / 2), top_};
            Vec to{at[0] - eye[0], at[1] - eye[1], at[2] - eye[2]};
            const double length = std::sqrt(dot(to, to));
            for (double& part : to) part /= length;
            sum += seen(at, to);
        }
        return sum / rays;
    }

    /// Of the light that leaves the panel into what lies on it: the shares that cross the array's rectangle at the height of the
    /// flat faces, and that leave the lenses for good.
    struct Shares {
        double reaches, leaves;
    };
    Shares forward(int rays) {
        double reaches = 0, leaves = 0;
        const double m = d_.panel.emission_exponent;
        for (int n = 0; n < rays; ++n) {
            Vec at{number(-width_ / 2, width_ / 2), number(-height_ / 2, height_ / 2), 0};
            const double c = std::pow(number(0, 1), 1 / (m + 2)), s = std::sqrt(1 - c * c), phi = number(0, 2 * std::numbers::pi);
            Vec to{s * std::cos(phi), s * std::sin(phi), c};
            double light = 1, medium = glued_ ? index_ : 1;
            for (std::size_t k = 0; k < d_.panel.layers.size() && light > 0; ++k) {
                medium = *d_.panel.layers[k].index;
                at = along(at, to, d_.panel.layers[k].thickness_mm / to[2]);
                const bool last = k + 1 == d_.panel.layers.size();
                if (last && glued_) break;
                const double next = last ? 1 : *d_.panel.layers[k + 1].index;
                light *= refract(to, {0, 0, -1}, medium, next);
                medium = next;
            }
            if (light == 0) continue;
            const Vec in = along(at, to, (flat_ - at[2]) / to[2]);
            if (std::abs(in[0]) < double(d_.array.count->at(0)) * pitch_ / 2 &&
                std::abs(in[1]) < double(d_.array.count->at(1)) * pitch_ / 2)
                reaches += light;
            leaves += light * left(in, to, medium);
        }
        return {reaches / rays, leaves / rays};
    }

  private:
    /// The axis of the lens in whose cell (x, y) lies, or of the one `di`, `dj` further.
    std::optional<std::array<double, 2>> axis(double x, double y, int di = 0, int dj = 0) const {
        const double nx = double(d_.array.count->at(0)), ny = double(d_.array.count->at(1));
        const double i = std::floor(x / pitch_ + nx / 2) + di, j = std::floor(y / pitch_ + ny / 2) + dj;
        if (i < 0 || j < 0 || i >= nx || j >= ny) return {};
        return std::array{(i + 0.5 - nx / 2) * pitch_, (j + 0.5 - ny / 2) * pitch_};
    }
    /// Ways to where the line meets the ball about the axis `c`: the cap is what stands above the rim.
    std::array<double, 2> ball(const Vec& at, const Vec& to, const std::array<double, 2>& c) const {
        const Vec q{at[0] - c[0], at[1] - c[1], at[2] - centre_};
        const double b = dot(q, to), root = b * b - dot(q, q) + sphere_ * sphere_;
        if (root < 0) return {-1, -1};
        return {-b - std::sqrt(root), -b + std::sqrt(root)};
    }
    bool on_cap(const Vec& p, const std::array<double, 2>& c) const {
        return p[2] > centre_ && std::hypot(p[0] - c[0], p[1] - c[1]) <= r_;
    }
    Vec normal(const Vec& p, const std::array<double, 2>& c) const {
        return {(p[0] - c[0]) / sphere_, (p[1] - c[1]) / sphere_, (p[2] - centre_) / sphere_};
    }

    /// Backwards from a point in the plane of the apexes to the panel.
    double seen(const Vec& at, Vec to) const {
        double best = 1e30;
        std::array<double, 2> lens{};
        for (int i = -2; i <= 2; ++i)
            for (int j = -2; j <= 2; ++j)
                if (const auto c = axis(at[0], at[1], i, j)) {
                    const double t = ball(at, to, *c)[0];
                    if (t > -1e-9 && t < best && on_cap(along(at, to, t), *c)) best = t, lens = *c;
                }
        if (best > 1e29) return 0;
        Vec p = along(at, to, best);
        double light = refract(to, normal(p, lens), 1, index_);
        if (light == 0 || to[2] >= 0) return 0;
        p = along(p, to, (flat_ - p[2]) / to[2]);
        if (std::hypot(p[0] - lens[0], p[1] - lens[1]) > r_) return 0;
        light *= refract(to, {0, 0, 1}, index_, 1);
        if (light == 0) return 0;
        p = along(p, to, -p[2] / to[2]);
        return 2 * std::abs(p[0]) <= width_ && 2 * std::abs(p[1]) <= height_ ? light * std::pow(-to[2], d_.panel.emission_exponent)
                                                                             : 0;
    }

    /// Forwards from a point in the plane of the flat faces to the open.
    double left(const Vec& in, Vec to, double medium) const {
        const auto lens = axis(in[0], in[1]);
        if (!lens || std::hypot(in[0] - (*lens)[0], in[1] - (*lens)[1]) > r_) return 0;
        double light = refract(to, {0, 0, -1}, medium, index_);
        if (light == 0) return 0;
        const Vec p = along(in, to, ball(in, to, *lens)[1]);
        if (!on_cap(p, *lens)) return 0;
        Vec n = normal(p, *lens);
        for (double& part : n) part = -part;
        light *= refract(to, n, index_, 1);
        if (light == 0 || to[2] <= 0) return 0;
        for (int i = -2; i <= 2; ++i)  // another cap in the way?
            for (int j = -2; j <= 2; ++j)
                if (const auto c = axis(p[0], p[1], i, j); c && *c != *lens) {
                    const double t = ball(p, to, *c)[0];
                    if (t > 0 && on_cap(along(p, to, t), *c)) return 0;
                }
        return light;
    }

    Display d_;
    std::mt19937_64 engine_;
    double r_, sphere_, index_, pitch_, flat_, rim_, centre_, top_, width_, height_, layers_ = 0;
    bool glued_ = false;
};

}  // namespace lfdsim::brute
