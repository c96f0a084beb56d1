#include "engine/wide/likeness.h"

#include <algorithm>
#include <vector>

namespace lfdsim::wide {

namespace {

constexpr int rows_at_once = 256;  // of moments: thousands of items, and 32 bytes a pixel for these rows alone

std::size_t pixels_of(const Image& image) { return std::size_t(image.width) * std::size_t(image.height); }

/// Appends the range of columns of each row of a picture that lies in the region.
void append_columns(std::vector<Region::Row>& all, const Region& region, int width, int height) {
    const Region whole = Region::of({0, 0, width, height}).intersected(region);
    all.insert(all.end(), whole.rows.begin(), whole.rows.end());
}

/// Returns a copy of the values in the machine's memory.
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
    queue.seconds();  // waits, as other queues may use the photograph from now on
}

std::size_t Photograph::bytes(const Image& photograph) { return pixels_of(photograph) * 5 * sizeof(float); }

std::size_t ViewComparison::bytes(int width, int height) {
    const std::size_t w = std::size_t(width), h = std::size_t(height);
    return w * h * (sizeof(float) + sizeof(double)) + w * rows_at_once * moments * sizeof(double) +
           likeness_sums * h * (column_groups + 1) * sizeof(double);
}

ViewComparison::ViewComparison(Queue& queue, const Photograph& photograph, const Region& screen, const Region& content)
    : queue_(queue) {
    // The columns that count in each row: middles of windows in both regions, then the screen
    const int width = photograph.width, height = photograph.height;
    std::vector<Region::Row> columns;
    const Region* const regions[] = {&screen, &content};
    for (int k = 0; k < likeness_regions; ++k) {
        const Region middles = ssim_middles(*regions[k], width, height);
        windows_[k] = middles.pixels();
        append_columns(columns, middles, width, height);
    }
    append_columns(columns, screen, width, height);
    on_screen_ = screen.intersected(Region::of({0, 0, width, height})).pixels();

    const std::size_t w = std::size_t(width), h = std::size_t(height);
    columns_ = uploaded(queue, columns);
    view_code_ = Buffer<float>(queue, w * h);
    moments_ = Buffer<double>(queue, w * rows_at_once * moments);
    values_ = Buffer<double>(queue, w * h);
    parts_ = Buffer<double>(queue, likeness_sums * h * column_groups);
    sums_ = Buffer<double>(queue, likeness_sums * h);
    frame_.width = width;
    frame_.height = height;
    frame_.srgb = photograph.srgb.get();
    frame_.weights = ssim_weights();
    frame_.photograph_code = photograph.code.get();
    frame_.photograph_light = photograph.light.get();
    frame_.view_code = view_code_.get();
    frame_.columns = columns_.get();
    frame_.moments = moments_.get();
    frame_.values = values_.get();
    frame_.parts = parts_.get();
    frame_.sums = sums_.get();
}

Likeness ViewComparison::with(const float* view, float gain) {
    const std::int64_t width = frame_.width, height = frame_.height;
    LikenessFrame frame = frame_;
    frame.picture = view;
    frame.gain = gain;
    queue_.run(LikenessStep::view, frame, width * height);
    for (int row = 0; row < height; row += rows_at_once) {
        frame.first_row = row;
        frame.row_count = std::min(rows_at_once, frame.height - row);
        queue_.run(LikenessStep::moments, frame, (frame.row_count + moment_rows - 1) / moment_rows * width);
        queue_.run(LikenessStep::values, frame, frame.row_count * width);
    }
    queue_.run(LikenessStep::windows, frame, height * column_groups);
    queue_.run(LikenessStep::cover, frame, height * column_groups);
    queue_.run(LikenessStep::rows, frame, likeness_sums * height);

    // The sums of rows are added on the CPU.
    const std::size_t h = std::size_t(height);
    std::vector<double> rows(likeness_sums * h);
    queue_.download(rows.data(), sums_.get(), rows.size() * sizeof(double));
    double totals[likeness_sums] = {}, cover[cover_sums];
    for (std::size_t k = 0; k < likeness_sums; ++k)
        for (std::size_t y = 0; y < h; ++y) totals[k] += rows[k * h + y];
    std::copy_n(totals + likeness_regions, int(cover_sums), cover);
    return {totals[0] / double(windows_[0]), totals[1] / double(windows_[1]), covered_share(cover, on_screen_)};
}

}  // namespace lfdsim::wide
