#include "inverse/fitted_views.h"

#include "image/compare/ssim.h"
#include "image/formats/encoding.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace lfdsim {
namespace {

constexpr double integers_of_largest = 1099511627776.;  // 2^40, so that 2^22 of the largest terms fit into a sum

/// Returns the number of rows of elements in a strip: a multiple of a packet's height, at which its rays take some megabytes.
int strip_rows(const ViewRows& rows) {
    const double most = 4e5 / (double(rows.width()) * double(rows.rays()));
    return std::max(4, int(most) / 4 * 4);
}

}  // namespace

FittedViews::FittedViews(std::vector<View> views, bool entries_are_pixels, bool errors_of_codes, Exposure exposure, const Job& job)
    : views_(std::move(views)), pixels_(entries_are_pixels), errors_of_codes_(errors_of_codes), exposure_(exposure), job_(job) {
    for (std::size_t k = 0; k < views_.size(); ++k)
        for (int y = 0, step = strip_rows(views_[k].rows); y < views_[k].rows.height(); y += step)
            strips_.push_back({k, y, std::min(y + step, views_[k].rows.height())});
}

double FittedViews::keep_rows(double bytes) {
    std::atomic<std::int64_t> taken{0};
    tbb::parallel_for(std::size_t(0), strips_.size(), [&](std::size_t k) {
        if (job_.cancelled() || double(taken) > bytes) return;
        Rows rows = views_[strips_[k].view].rows.of(strips_[k].y0, strips_[k].y1);
        const auto size = std::int64_t(rows.bytes());
        if (double(taken += size) > bytes) return;
        rows.entries.shrink_to_fit();
        strips_[k].kept = std::move(rows);
    });
    return std::min(double(taken), bytes);
}

/// Calls do_it(element's number in the view, its row) for each element that counts.
template <class Do>
void FittedViews::for_strip(const Strip& strip, const Do& do_it) const {
    const View& view = views_[strip.view];
    Rows made;
    if (!strip.kept) made = view.rows.of(strip.y0, strip.y1);
    const Rows& rows = strip.kept ? *strip.kept : made;
    const std::size_t first = std::size_t(strip.y0) * std::size_t(view.rows.width());
    for (std::size_t p = 0; p + 1 < rows.start.size(); ++p)
        if (view.expected[first + p] > 0) do_it(first + p, rows.row(p));
}

// A row r and channel c, each scaled so that of a white panel it sees what the view does:
//     y = (white / sum of shares) sum of shares x,    half the gradient: share (white / sum of shares) v u (y - t)
template <bool pixels>
double FittedViews::add_products(const Strip& strip, const PanelVector& x, bool of_target, std::vector<std::int64_t>* sums,
                                 double& largest) const {
    const View& view = views_[strip.view];
    double half_squares = 0;
    for_strip(strip, [&](std::size_t p, std::span<const PanelRay> row) {
        float light[3] = {}, shares[3] = {}, most[3] = {};
        for (const PanelRay& ray : row) {
            if constexpr (pixels) {
                const float* const texel = &x[std::size_t(ray.place) * 4];
                for (int c = 0; c < 3; ++c) light[c] += ray.share * texel[c];
                shares[0] += ray.share;
                most[0] = std::max(most[0], ray.share);
            } else {
                const std::uint32_t c = ray.place & 3;
                light[c] += ray.share * x[ray.place];
                shares[c] += ray.share;
                most[c] = std::max(most[c], ray.share);
            }
        }
        if constexpr (pixels) {
            shares[1] = shares[2] = shares[0];
            most[1] = most[2] = most[0];
        }
        double times[3] = {};  // by which a ray's share is multiplied in half the gradient
        for (std::size_t c = 0; c < 3; ++c) {
            if (!(shares[c] > 0)) continue;
            const float content = view.content.rgb[p * 3 + c], white = view.white.rgb[p * 3 + c], scale = white / shares[c];
            const float weight = view.weight * weight_of(content), target = exposure_.of(content) * view.expected[p];
            const float error = light[c] * scale - (of_target ? target : 0);
            half_squares += 0.5 * double(weight) * double(error) * double(error);
            times[c] = double(weight) * double(error) * double(scale);
            // x is from -1 to 2 where the solver looks ahead.
            largest = std::max(largest,
                               double(most[c]) * double(weight) * double(scale) * (2 * double(white) + std::abs(double(target))));
        }
        if (!sums) return;
        const auto add = [&](std::size_t place, double term) {
            std::atomic_ref<std::int64_t>((*sums)[place]).fetch_add(std::llrint(term * per_unit_), std::memory_order_relaxed);
        };
        for (const PanelRay& ray : row) {
            if constexpr (pixels)
                for (std::size_t c = 0; c < 3; ++c) add(std::size_t(ray.place) * 4 + c, double(ray.share) * times[c]);
            else
                add(ray.place, double(ray.share) * times[ray.place & 3]);
        }
    });
    return half_squares;
}

double FittedViews::products(const PanelVector& x, bool of_target, std::vector<std::int64_t>* sums, double& largest) const {
    std::vector<double> half_squares(strips_.size(), 0), most(strips_.size(), 0);
    tbb::parallel_for(std::size_t(0), strips_.size(), [&](std::size_t k) {
        if (job_.cancelled()) return;
        half_squares[k] = pixels_ ? add_products<true>(strips_[k], x, of_target, sums, most[k])
                                  : add_products<false>(strips_[k], x, of_target, sums, most[k]);
    });
    double sum = 0;
    for (const double part : half_squares) sum += part;
    for (const double m : most) largest = std::max(largest, m);
    return sum;
}

PanelVector FittedViews::bound(std::size_t size) {
    // The largest term that any later sum may contain, then the sums
    const PanelVector ones(size, 1);
    double largest = 0;
    products(ones, false, nullptr, largest);
    per_unit_ = largest > 0 ? integers_of_largest / largest : 0;
    PanelVector result(size, 0);
    std::vector<std::int64_t> sums(size, 0);
    products(ones, false, &sums, largest);
    tbb::parallel_for(std::size_t(0), size, [&](std::size_t j) { result[j] = float(double(sums[j]) / per_unit_); });
    return result;
}

double FittedViews::half_gradient(const PanelVector& x, PanelVector& half) {
    std::vector<std::int64_t> sums(x.size(), 0);
    double largest = 0;
    const double value = products(x, true, &sums, largest);
    half.resize(x.size());
    tbb::parallel_for(std::size_t(0), x.size(), [&](std::size_t j) { half[j] = float(double(sums[j]) / per_unit_); });
    return value;
}

std::vector<double> FittedViews::light_in(std::size_t first, std::size_t end, std::size_t size) const {
    std::vector<double> light(size, 0);
    for (const Strip& strip : strips_) {
        if (strip.view < first || strip.view >= end || (strip.view - first) % 2 != 0) continue;
        for_strip(strip, [&](std::size_t, std::span<const PanelRay> row) {
            for (const PanelRay& ray : row) {
                if (!pixels_) light[ray.place] += double(ray.share);
                for (std::size_t c = 0; pixels_ && c < 3; ++c) light[std::size_t(ray.place) * 4 + c] += double(ray.share);
            }
        });
    }
    return light;
}

double FittedViews::crosstalk(std::size_t in_boxes, std::size_t size) const {
    const std::vector<double> light[2] = {light_in(0, in_boxes, size), light_in(1, in_boxes, size)};
    double signal[2] = {}, leak[2] = {};
    for (std::size_t j = 0; j < size; ++j) {
        const std::size_t owner = light[1][j] > light[0][j] ? 1 : 0;
        signal[owner] += light[owner][j];
        leak[1 - owner] += light[1 - owner][j];
    }
    return 0.5 * (leak[0] / signal[0] + leak[1] / signal[1]);
}

Image FittedViews::seen(std::size_t k, const PanelVector& x) const {
    const View& view = views_[k];
    Image image(view.rows.width(), view.rows.height());
    std::vector<const Strip*> strips;
    for (const Strip& strip : strips_)
        if (strip.view == k) strips.push_back(&strip);
    tbb::parallel_for(std::size_t(0), strips.size(), [&](std::size_t s) {
        for_strip(*strips[s], [&](std::size_t p, std::span<const PanelRay> row) {
            double light[3] = {}, shares[3] = {};
            for (const PanelRay& ray : row)
                for (std::uint32_t c = 0; c < 3; ++c) {
                    if (!pixels_ && c != (ray.place & 3)) continue;
                    light[c] += double(ray.share) * double(x[pixels_ ? std::size_t(ray.place) * 4 + c : ray.place]);
                    shares[c] += double(ray.share);
                }
            for (std::size_t c = 0; c < 3; ++c) {
                const double scale = shares[c] > 0 ? double(view.white.rgb[p * 3 + c]) / shares[c] : 0;
                image.rgb[p * 3 + c] = exposure_.content_of(float(light[c] * scale / double(view.expected[p])));
            }
        });
    });
    return image;
}

Nearness FittedViews::nearness(std::size_t k, const PanelVector& x) const {
    constexpr double most_between = 0.25;  // of the elements that count, those in between that do not
    const View& view = views_[k];
    Image image = seen(k, x);
    // Elements that do not count get the content's light, so that they differ from it by nothing; the region reaches in each row
    // from the first to the last element that counts.
    double squares = 0, count = 0, between = 0;
    Region region;
    for (int y = 0; y < image.height; ++y) {
        Region::Row row{image.width, 0};
        for (int column = 0; column < image.width; ++column) {
            const std::size_t p = std::size_t(y) * std::size_t(image.width) + std::size_t(column);
            if (view.expected[p] > 0) {
                row = {std::min(row.from, column), column + 1};
                count += 3;
            }
            for (std::size_t c = 3 * p; c < 3 * p + 3; ++c) {
                if (!(view.expected[p] > 0)) image.rgb[c] = view.content.rgb[c];
                const auto code = [](float light) { return linear_to_srgb(std::clamp(double(light), 0., 1.)); };
                const double difference = code(image.rgb[c]) - code(view.content.rgb[c]);
                squares += difference * difference;
            }
        }
        for (int column = row.from; column < row.to; ++column)
            between += !(view.expected[std::size_t(y) * std::size_t(image.width) + std::size_t(column)] > 0);
        region.rows.push_back(row);
    }
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return {count > 0 ? -10 * std::log10(std::max(squares / count, 1e-12)) : nan,
            3 * between > most_between * count ? nan : ssim(image, view.content, std::span(&region, 1))[0]};
}

Nearness FittedViews::nearness(const PanelVector& x, std::size_t count, std::size_t step) const {
    double psnr = 0, psnr_eyes = 0, similarity = 0, similarity_eyes = 0;
    for (std::size_t k = 0; k < count; k += step) {
        const Nearness one = nearness(k, x);  // NaN where too few elements see the screen
        if (!std::isnan(one.psnr_db)) psnr += one.psnr_db, ++psnr_eyes;
        if (!std::isnan(one.ssim)) similarity += one.ssim, ++similarity_eyes;
    }
    return {psnr / psnr_eyes, similarity / similarity_eyes};  // 0/0 is NaN
}

std::int64_t FittedViews::rays() const {
    std::int64_t sum = 0;
    for (const View& view : views_) sum += std::int64_t(view.rows.width()) * view.rows.height() * view.rows.rays();
    return sum;
}

}  // namespace lfdsim
