#include "engine/wide/likeness.h"

#include <algorithm>
#include <array>
#include <vector>

namespace lfdsim::wide {

namespace {

constexpr int rows_at_once = 256;  // of moments: thousands of items, and 32 bytes a pixel for these rows alone

std::size_t pixels_of(const Image& image) { return std::size_t(image.width) * std::size_t(image.height); }
std::size_t chunks_of(int width) { return std::size_t((width + columns_at_once - 1) / columns_at_once); }

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
    return w * h * sizeof(float) + w * rows_at_once * moments * sizeof(double) +
           likeness_sums * h * chunks_of(width) * sizeof(double);
}

Likeness likeness(Queue& queue, const float* view, float gain, const Photograph& photograph, const Region& screen,
                  const Region& content) {
    const int width = photograph.width, height = photograph.height;
    std::vector<Region::Row> columns;
    std::int64_t windows[likeness_regions];
    const Region* const regions[] = {&screen, &content};
    for (int k = 0; k < likeness_regions; ++k) {
        const Region middles = ssim_middles(*regions[k], width, height);
        windows[k] = middles.pixels();
        append_columns(columns, middles, width, height);
    }
    append_columns(columns, screen, width, height);

    const std::size_t w = std::size_t(width), h = std::size_t(height);
    const Buffer<Region::Row> columns_there = uploaded(queue, columns);
    const Buffer<float> view_code(queue, w * h);
    const Buffer<double> moments_there(queue, w * rows_at_once * moments), parts(queue, likeness_sums * h * chunks_of(width)),
        sums(queue, likeness_sums * h);
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
    for (int row = 0; row < height; row += rows_at_once) {
        frame.first_row = row;
        frame.row_count = std::min(rows_at_once, height - row);
        queue.run(LikenessStep::moments, frame, std::int64_t(frame.row_count) * width);
        queue.run(LikenessStep::windows, frame, frame.row_count * std::int64_t(chunks_of(width)));
    }
    queue.run(LikenessStep::cover, frame, height * std::int64_t(chunks_of(width)));
    queue.run(LikenessStep::rows, frame, likeness_sums * std::int64_t(height));

    std::vector<double> rows(likeness_sums * h);
    queue.download(rows.data(), sums.get(), rows.size() * sizeof(double));
    double totals[likeness_sums] = {}, cover[cover_sums];
    for (std::size_t k = 0; k < likeness_sums; ++k)
        for (std::size_t y = 0; y < h; ++y) totals[k] += rows[k * h + y];
    std::copy_n(totals + likeness_regions, int(cover_sums), cover);
    return {totals[0] / double(windows[0]), totals[1] / double(windows[1]),
            covered_share(cover, screen.intersected(Region::of({0, 0, width, height})).pixels())};
}

}  // namespace lfdsim::wide
