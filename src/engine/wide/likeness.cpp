#include "engine/wide/likeness.h"

#include <algorithm>
#include <array>
#include <vector>

namespace lfdsim::wide {

namespace {

constexpr int kRowsAtOnce = 256;  // of moments: thousands of items, and 32 bytes a pixel for these rows alone

std::size_t pixels_of(const Image& image) { return std::size_t(image.width) * std::size_t(image.height); }
std::size_t chunks_of(int width) { return std::size_t((width + kColumnsAtOnce - 1) / kColumnsAtOnce); }

/// Columns of each row of a picture that lie in the region.
void append_columns(std::vector<Region::Row>& all, const Region& region, int width, int height) {
    const Region whole = Region::of({0, 0, width, height}).intersected(region);
    all.insert(all.end(), whole.rows.begin(), whole.rows.end());
}

template <class T>
Buffer<T> uploaded(Queue& queue, const std::vector<T>& values) {
    const Buffer<T> there(queue, values.size());
    queue.upload(there.get(), values.data(), values.size() * sizeof(T));
    return there;
}

}  // namespace

Photograph::Photograph(Queue& queue, const Image& photograph)
    : width(photograph.width),
      height(photograph.height),
      srgb(uploaded(queue, srgb_lines())),
      code(queue, pixels_of(photograph)),
      light(queue, pixels_of(photograph)) {
    const Buffer<float> picture = uploaded(queue, photograph.rgb);
    LikenessFrame frame{};
    frame.srgb = srgb.get();
    frame.picture = picture.get();
    frame.photograph_code = code.get();
    frame.photograph_light = light.get();
    queue.run(LikenessStep::photograph, frame, std::int64_t(pixels_of(photograph)));
    queue.seconds();  // other queues may use it
}

std::size_t Photograph::bytes(const Image& photograph) { return pixels_of(photograph) * 5 * sizeof(float); }

std::size_t likeness_bytes(int width, int height) {
    const std::size_t w = std::size_t(width), h = std::size_t(height);
    return w * h * sizeof(float) + w * kRowsAtOnce * moments * sizeof(double) +
           kLikenessSums * h * chunks_of(width) * sizeof(double);
}

Likeness likeness(Queue& queue, const float* view, float gain, const Photograph& photograph, const Region& screen,
                  const Region& content) {
    const int width = photograph.width, height = photograph.height;
    std::vector<Region::Row> columns;
    std::int64_t windows[kLikenessRegions];
    const Region* const regions[] = {&screen, &content};
    for (int k = 0; k < kLikenessRegions; ++k) {
        const Region middles = ssim_middles(*regions[k], width, height);
        windows[k] = middles.pixels();
        append_columns(columns, middles, width, height);
    }
    append_columns(columns, screen, width, height);

    const std::size_t w = std::size_t(width), h = std::size_t(height);
    const Buffer<Region::Row> columns_there = uploaded(queue, columns);
    const Buffer<float> view_code(queue, w * h);
    const Buffer<double> moments_there(queue, w * kRowsAtOnce * moments), parts(queue, kLikenessSums * h * chunks_of(width)),
        sums(queue, kLikenessSums * h);
    LikenessFrame frame{width,
                        height,
                        photograph.srgb.get(),
                        ssim_weights(),
                        gain,
                        view,
                        photograph.code.get(),
                        photograph.light.get(),
                        view_code.get(),
                        columns_there.get(),
                        0,
                        0,
                        moments_there.get(),
                        parts.get(),
                        sums.get()};
    queue.run(LikenessStep::view, frame, std::int64_t(w * h));
    for (int row = 0; row < height; row += kRowsAtOnce) {
        frame.first_row = row;
        frame.row_count = std::min(kRowsAtOnce, height - row);
        queue.run(LikenessStep::moments, frame, std::int64_t(frame.row_count) * width);
        queue.run(LikenessStep::windows, frame, frame.row_count * std::int64_t(chunks_of(width)));
    }
    queue.run(LikenessStep::cover, frame, height * std::int64_t(chunks_of(width)));
    queue.run(LikenessStep::rows, frame, kLikenessSums * std::int64_t(height));

    std::vector<double> rows(kLikenessSums * h);
    queue.download(rows.data(), sums.get(), rows.size() * sizeof(double));
    double totals[kLikenessSums] = {}, cover[cover_sums];
    for (std::size_t k = 0; k < kLikenessSums; ++k)
        for (std::size_t y = 0; y < h; ++y) totals[k] += rows[k * h + y];
    std::copy_n(totals + kLikenessRegions, int(cover_sums), cover);
    return {totals[0] / double(windows[0]), totals[1] / double(windows[1]),
            covered_share(cover, screen.intersected(Region::of({0, 0, width, height})).pixels())};
}

}  // namespace lfdsim::wide
