#include "engine/estimator/choice.h"

#include "engine/estimator/limits.h"
#include "engine/scene/traced_display.h"
#include "optics/sampler.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace lfdsim {

namespace {

using Limits = FilteredLimits;

/// Returns squares of 4 x 4 pixels, one at a random place in each cell of a grid of an_axis x an_axis cells over the region: lenses
/// that appear at an even pitch would otherwise be met at the same part each time. They depend on the region alone.
std::vector<Rect> places_in(const Rect& region, int an_axis) {
    std::vector<Rect> places;
    const auto start = [&](std::int64_t low, std::int64_t high, int k, std::uint32_t number) {
        const std::int64_t from = low + (high - low) * k / an_axis, size = low + (high - low) * (k + 1) / an_axis - from;
        return int((from + Limits::place_side * (number % std::max<std::int64_t>(size / Limits::place_side, 1))) /
                   Limits::place_side * Limits::place_side);
    };
    for (int j = 0; j < an_axis; ++j)
        for (int i = 0; i < an_axis; ++i) {
            const std::uint32_t number =
                optics::mix((std::uint32_t(region.y0) * 8191 + std::uint32_t(region.x0)) * 1024 + std::uint32_t(j * an_axis + i));
            const int x = start(region.x0, region.x1, i, number & 0xffff), y = start(region.y0, region.y1, j, number >> 16);
            places.push_back({x, y, std::min(x + Limits::place_side, region.x1), std::min(y + Limits::place_side, region.y1)});
        }
    return places;
}

std::size_t colours_of(const Rect& r) { return std::size_t(r.x1 - r.x0) * std::size_t(r.y1 - r.y0) * 3; }

/// Makes a tile that of a place, whose pixels it writes one after the other.
void move_to(Tile& tile, const Rect& place) {
    tile.crop_x = tile.x0 = place.x0;
    tile.crop_y = tile.y0 = place.y0;
    tile.x1 = place.x1;
    tile.y1 = place.y1;
    tile.crop_width = place.x1 - place.x0;
}

/// Returns the light of places, one after the other, by the tile's estimator.
std::vector<float> light_at(Kernel kernel, Tile tile, const std::vector<Rect>& places) {
    std::vector<float> light;
    for (const Rect& at : places) {
        light.resize(light.size() + colours_of(at));
        move_to(tile, at);
        tile.out = light.data() + light.size() - colours_of(at);
        kernel(tile);
    }
    return light;
}

/// Returns the light of places by points if the panel were white: the shares of the rays that meet it.
std::vector<float> white_at(Kernel kernel, Tile tile, const std::vector<Rect>& places, bool subpixels) {
    std::vector<PanelRay> rays(std::size_t(Limits::place_side * Limits::place_side) * tile.samples);
    std::vector<float> light;
    for (const Rect& at : places) {
        move_to(tile, at);
        tile.rays = rays.data();
        kernel(tile);
        for (std::size_t pixel = 0; pixel < colours_of(at) / 3; ++pixel) {
            float of[3] = {};
            for (std::uint32_t k = 0; k < tile.samples; ++k) {
                const PanelRay& ray = rays[pixel * tile.samples + k];
                for (std::uint32_t c = 0; c < 3; ++c) of[c] += ray.lights(c, subpixels) ? ray.share : 0;
            }
            for (const float sum : of) light.push_back(sum / float(tile.samples));
        }
    }
    return light;
}

/// Returns the mean square error of a picture, from two independent ones with the same expectation: the mean of (a - b)^2/2.
double spread2_of(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += 0.5 * (a[k] - b[k]) * (a[k] - b[k]);
    return sum / double(a.size());
}

/// The error of filtered light f at a region's places, estimated from two independent pictures by points, a and b: the mean of a
/// product of two independent estimates of an error is the error's square, without the noise of either.
struct FilteredError {
    // Each with the standard deviation of the estimate.
    double square = 0, square_noise = 0;   // of a pixel's error: mean of (f - a) (f - b)
    double local2 = 0, local_noise = 0;    // square of the error of the mean over a neighbourhood: mean of products of two places
    double region2 = 0, region_noise = 0;  // square of the error of the mean over the region

    FilteredError(const std::vector<float>& f, const std::vector<float>& a, const std::vector<float>& b,
                  const std::vector<Rect>& places) {
        // At each place: the mean product (f - a)(f - b), and the mean error e = f - (a + b)/2
        constexpr double all = Limits::places_an_axis * Limits::places_an_axis, pairs = all * (all - 1);
        double error[Limits::places_an_axis][Limits::places_an_axis], sum = 0, squares = 0, fourth = 0;
        std::size_t k = 0;
        for (std::size_t n = 0; n < places.size(); ++n) {
            double here = 0, product = 0;
            for (const std::size_t end = k + colours_of(places[n]); k < end; ++k) {
                const double to_a = f[k] - a[k], to_b = f[k] - b[k];
                product += to_a * to_b / double(colours_of(places[n]));
                here += 0.5 * (to_a + to_b) / double(colours_of(places[n]));
            }
            error[n / Limits::places_an_axis][n % Limits::places_an_axis] = here;
            sum += here;
            squares += here * here;
            square += product / all;
            fourth += product * product / all;
        }
        // Over all ordered pairs of places the sum of e e' is (sum of e)^2 - (sum of e^2). If errors were independent and their
        // mean 0, the mean over the pairs would vary by <e^2> sqrt(2/pairs).
        square_noise = std::sqrt(std::max(fourth - square * square, 0.0) / (all - 1));
        region2 = (sum * sum - squares) / pairs;
        region_noise = squares / all * std::sqrt(2 / pairs);

        // The same over the pairs within each neighbourhood of `together` x `together` places
        constexpr int hoods = Limits::places_an_axis / Limits::together;  // neighbourhoods along an axis
        constexpr double each = Limits::together * Limits::together, local_pairs = hoods * hoods * each * (each - 1);
        for (int n = 0; n < hoods * hoods; ++n) {
            double total = 0, own = 0;
            for (int q = 0; q < Limits::together * Limits::together; ++q) {
                const double of =
                    error[n / hoods * Limits::together + q / Limits::together][n % hoods * Limits::together + q % Limits::together];
                total += of;
                own += of * of;
            }
            local2 += (total * total - own) / local_pairs;
        }
        local_noise = squares / all * std::sqrt(2 / local_pairs);
    }

    /// Returns an upper estimate of a pixel's error, its square being larger by one standard deviation.
    double rms() const { return std::sqrt(std::max(square, 0.0) + square_noise); }
    /// Returns a lower estimate of it.
    double least_rms() const { return std::sqrt(std::max(square - square_noise, 0.0)); }
    /// Returns whether a pixel's error is at most `allowed`, and that of the mean at most `mean` in neighbourhoods, `mean`/sqrt(2)
    /// in the region. Where neither right() nor wrong() holds, more points decide.
    bool right(double allowed, double mean) const {
        return rms() <= allowed && std::max(local2, 0.0) + 0.5 * local_noise <= mean * mean &&
               region2 <= 0.5 * mean * mean + region_noise;
    }
    bool wrong(double allowed, double mean) const {
        return square > allowed * allowed + 2 * square_noise || local2 > mean * mean + 3 * local_noise ||
               region2 > 0.5 * mean * mean + 3 * region_noise;
    }
};

/// Returns the index of the first error, or of a later one that is smaller by the standard deviations of both.
std::size_t best_of(const std::vector<FilteredError>& errors) {
    std::size_t best = 0;
    for (std::size_t k = 1; k < errors.size(); ++k)
        if (errors[k].rms() < errors[best].least_rms()) best = k;
    return best;
}

}  // namespace

EstimatorChoice::EstimatorChoice(const Display& display, const Geometry& geometry, const std::vector<optics::SummedImage>& panel,
                                 const RenderOptions& options, const Job& job)
    : points_(by_points(display), geometry, panel, options, job) {
    points_.result.estimator = Estimator::filtered;
    const auto try_with = [&](std::int64_t samples) {
        Display tried = display;
        tried.render.samples = samples;
        filtered_.emplace_back();
        for (const EvenPart& part : even_parts(tried)) filtered_.back().emplace_back(part, geometry, panel, options, job);
    };
    if (options.target_error) {
        for (const int samples : {4, 16, 64}) try_with(samples);
        return;
    }
    try_with(samples_of(display));
    if (!display.render.samples) return;
    given_ = std::uint32_t(*display.render.samples);
    for (std::int64_t samples = *given_ / 4; samples >= 4; samples /= 4) try_with(samples);  // more are not always better
}

EstimatorChoice::PixelColours EstimatorChoice::filtered_at(Kernel kernel, const std::vector<Rect>& places,
                                                           const Filtered& filtered) {
    PixelColours sum;
    for (const Part& part : filtered) {
        const PixelColours light = light_at(kernel, part.work.tile, places);
        sum.resize(light.size());
        for (std::size_t k = 0; k < light.size(); ++k) sum[k] += part.weight * light[k];
    }
    return sum;
}

EstimatorChoice::PixelColours EstimatorChoice::points_at(Kernel kernel, const std::vector<Rect>& places, std::uint32_t points,
                                                         int repetition, bool of_white) const {
    optics::RayOrigin view = points_.view;
    view.seed += std::uint64_t(repetition) * 0x9e3779b97f4a7c15u;  // the golden ratio, far from seeds that users count up
    Tile tile = points_.tile;
    tile.view = &view;
    tile.samples = points;
    return of_white ? white_at(kernel, tile, places, !tile.display->emission.whole) : light_at(kernel, tile, places);
}

// The frame's light is the root mean square of the content's picture, so that a dark background does not count, times the mean of a
// white panel's picture over its root mean square: where the display sends its light into few pixels, errors are judged by the
// mean.
void EstimatorChoice::look(Kernel kernel) {
    const std::vector<Rect> places = places_in({0, 0, points_.view.width, points_.view.height}, Limits::frame_places_an_axis);
    struct FrameLight {
        double rms, mean;
    };
    const auto light = [&](bool of_white) {
        const PixelColours a = points_at(kernel, places, Limits::first_points, 3, of_white),
                           b = points_at(kernel, places, Limits::first_points, 4, of_white);
        double squares = 0, sum = 0;
        for (std::size_t k = 0; k < a.size(); ++k) {
            squares += double(a[k]) * b[k];
            sum += 0.5 * (double(a[k]) + b[k]);
        }
        return FrameLight{std::sqrt(squares / double(a.size())), sum / double(a.size())};
    };
    const FrameLight content = light(false), white = light(true);
    light_ = std::max(white.rms > 0 ? content.rms * std::min(white.mean / white.rms, 1.) : 0,
                      Limits::least_light * std::max(white.mean, Limits::least_white));
}

RegionChoice EstimatorChoice::choose(Kernel kernel, int column, int row) const {
    const int x0 = column * region_side, y0 = row * region_side;
    const std::vector<Rect> places =
        places_in({x0, y0, std::min(x0 + region_side, points_.view.width), std::min(y0 + region_side, points_.view.height)},
                  Limits::places_an_axis);
    // Filtered light at the region's places, with each number of samples
    std::vector<PixelColours> filtered;
    for (const Filtered& one : filtered_) filtered.push_back(filtered_at(kernel, places, one));

    // It is compared with more and more points, until it is right or wrong. With a target error the first number of samples that is
    // right is used; with a given number of samples that number, or a smaller one if it is better, which has to be better than that
    // number of points.
    const double target = points_.target_error.value_or(0);
    RegionChoice choice;
    std::size_t candidate = 0;
    double spread = 0, rms = target > 0 ? target : Limits::rms_allowed * light_,
           mean = std::max(Limits::mean_allowed * light_, Limits::mean_of_target * target);
    std::uint32_t points = Limits::first_points;
    const auto error_of = [&](std::uint32_t wanted) { return spread * std::pow(double(wanted) / points, Limits::falls_as); };
    for (;; points *= 4) {
        const PixelColours a = points_at(kernel, places, points, 1), b = points_at(kernel, places, points, 2);
        choice.samples += std::int64_t(2 * points * (a.size() / 3));
        spread = std::sqrt(spread2_of(a, b));
        if (given_ && target == 0) rms = mean = error_of(*given_);  // the better of two
        if (!given_ && target == 0 && points == Limits::first_points) rms = std::max(rms, Limits::of_36_points * spread);
        std::vector<FilteredError> errors;
        for (const PixelColours& light : filtered) errors.emplace_back(light, a, b, places);
        while (candidate < errors.size()) {
            if (target == 0) candidate = best_of(errors);
            if (errors[candidate].right(rms, mean)) {
                choice.filtered = int(candidate);
                choice.error = errors[candidate].rms();
                return choice;
            }
            if (!errors[candidate].wrong(rms, mean)) break;
            candidate = target == 0 ? errors.size() : candidate + 1;
        }
        const bool enough = given_ || target > 0 || spread <= (points < 36 ? Limits::rms_allowed : Limits::points_rms) * light_;
        if (points == Limits::last_points || (candidate == filtered.size() && enough)) break;
    }
    // By points: as many as are given, or as make the error small enough
    if (target > 0) return choice;
    choice.points = given_.value_or(points);
    if (!given_)
        while (error_of(choice.points) > Limits::points_rms * light_ && choice.points < Limits::most_chosen_points)
            choice.points *= 2;
    const double many = double(choice.points) / points;
    choice.error = spread * std::pow(many, many > 1 ? Limits::falls_at_least_as : Limits::falls_as);
    return choice;
}

std::optional<std::int64_t> EstimatorChoice::render(Kernel kernel, const RegionChoice& choice, const Tile& of) const {
    const std::int64_t pixels = std::int64_t(of.x1 - of.x0) * (of.y1 - of.y0);
    std::int64_t samples = 0;
    // Renders the tile of a work, with its scene, to the place of the tile `of`; returns false where the job was cancelled.
    const auto run = [&](const Work& work, std::uint32_t points) {
        Tile tile = work.tile;
        tile.out = of.out;
        tile.x0 = of.x0;
        tile.y0 = of.y0;
        tile.x1 = of.x1;
        tile.y1 = of.y1;
        tile.samples = points;
        samples += pixels * (tile.strata > 0 ? tile.strata * tile.strata : std::int64_t(points));
        return kernel(tile);
    };
    if (choice.filtered < 0) return run(points_, choice.points) ? std::optional(samples) : std::nullopt;
    const Filtered& filtered = *std::next(filtered_.begin(), choice.filtered);
    if (filtered.size() == 1) {
        if (!run(filtered.front().work, 0)) return {};
    } else {
        // The weighted sum of the pictures that a gaussian diffuser consists of, each of which is rendered to the tile in turn
        const std::size_t width = std::size_t(of.x1 - of.x0) * 3;
        PixelColours sum(std::size_t(pixels) * 3);
        const auto row = [&](std::int32_t y) {
            return of.out + (std::int64_t(y - of.crop_y) * of.crop_width + of.x0 - of.crop_x) * 3;
        };
        for (const Part& part : filtered) {
            if (!run(part.work, 0)) {
                for (std::int32_t y = of.y0; y < of.y1; ++y) std::fill_n(row(y), width, 0.f);
                return {};
            }
            for (std::int32_t y = of.y0; y < of.y1; ++y)
                for (std::size_t k = 0; k < width; ++k) sum[std::size_t(y - of.y0) * width + k] += part.weight * row(y)[k];
        }
        for (std::int32_t y = of.y0; y < of.y1; ++y) std::copy_n(sum.data() + std::size_t(y - of.y0) * width, width, row(y));
    }
    return samples;
}

}  // namespace lfdsim
