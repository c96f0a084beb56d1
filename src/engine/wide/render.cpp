#include "engine/wide/render.h"

#include "engine/estimator/refine.h"

#include <algorithm>

namespace lfdsim::wide {

namespace {

constexpr std::int64_t square_pixels = refined_side * refined_side;

/// Renders squares of the frame, a part of them at a time.
class Renderer {
  public:
    Renderer(Queue& queue, const DevicePanel& panel, const Tile& tile) : queue_(queue) {
        frame_.display = *tile.display;
        frame_.view = *tile.view;
        frame_.directions = *tile.directions;
        frame_.tile = tile;
        frame_.tile.texels = panel.texels();
        if (auto*& lens = frame_.display.misaligned.lens) {
            const auto& count = frame_.display.lattice.count;
            const std::size_t lenses = std::size_t(count[0]) * std::size_t(count[1]);
            lenses_ = Buffer<optics::MisalignedLens<float>>(queue_, lenses);
            queue_.upload(lenses_.get(), lens, lenses * sizeof *lens);
            lens = lenses_.get();
        }
    }
    Frame& frame() { return frame_; }

    /// Renders all squares of the tile's rectangle in parts of Queue::points_at_once() points, and calls after(n) after each part,
    /// of n pixels; ends, and returns false, where after() returns false before the last part.
    template <class After>
    bool run_all(After after) {
        const Tile& t = frame_.tile;
        frame_.listed = nullptr;
        frame_.first_column = t.x0 / refined_side;
        frame_.first_row = t.y0 / refined_side;
        frame_.columns = (t.x1 - 1) / refined_side + 1 - frame_.first_column;
        const std::int64_t squares = std::int64_t(frame_.columns) * ((t.y1 - 1) / refined_side + 1 - frame_.first_row);
        const std::int64_t at_once = std::max<std::int64_t>(queue_.points_at_once() / (square_pixels * std::max(t.samples, 1u)), 1);
        for (std::int64_t first = 0; first < squares; first += at_once) {
            const std::int64_t count = std::min(at_once, squares - first);
            frame_.first_square = first;
            queue_.run(frame_, count * square_pixels);
            if (!after(count * square_pixels) && first + count < squares) return false;
        }
        return true;
    }

    /// Renders these squares of the frame, a few samples a pixel.
    void run_listed(const std::vector<RefinedBlock>& squares) {
        std::vector<ListedSquare> all;
        for (const RefinedBlock& square : squares) all.push_back({square.x, square.y});
        if (all.size() > listed_room_) {
            listed_ = Buffer<ListedSquare>(queue_, all.size());
            listed_room_ = all.size();
        }
        queue_.upload(listed_.get(), all.data(), all.size() * sizeof(ListedSquare));
        frame_.listed = listed_.get();
        queue_.run(frame_, std::int64_t(all.size()) * square_pixels);
    }

  private:
    Queue& queue_;
    Frame frame_{};
    Buffer<optics::MisalignedLens<float>> lenses_;
    std::size_t listed_room_ = 0;
    Buffer<ListedSquare> listed_;
};

/// Renders squares of the frame for refine_tile(): whole ones, whatever the crop.
class WidePainter : public BlockPainter {
  public:
    WidePainter(Queue& queue, Renderer& renderer) : queue_(queue), renderer_(renderer) {
        Tile& t = renderer_.frame().tile;  // whole squares, whatever the crop
        t.x0 = t.y0 = 0;
        t.x1 = t.view->width;
        t.y1 = t.view->height;
    }
    void paint(const std::vector<RefinedBlock>& squares, std::uint32_t points, std::uint64_t seed,
               std::vector<RefinedPicture>& pictures) override {
        Frame& frame = renderer_.frame();
        if (pictures.size() > room_) out_ = Buffer<RefinedPicture>(queue_, room_ = pictures.size());
        queue_.upload(out_.get(), pictures.data(), pictures.size() * sizeof(RefinedPicture));
        frame.tile.out = reinterpret_cast<float*>(out_.get());
        frame.tile.samples = points;
        frame.view.seed = seed;
        renderer_.run_listed(squares);
        queue_.download(pictures.data(), out_.get(), pictures.size() * sizeof(RefinedPicture));
    }

  private:
    Queue& queue_;
    Renderer& renderer_;
    Buffer<RefinedPicture> out_;
    std::size_t room_ = 0;
};

/// Renders to a target error, by rows of squares, some thousands of squares at a time: each takes 30 KB of the caller's memory.
Done render_refined(Queue& queue, Renderer& renderer, const Tile& tile, double target, float* error, Job& job) {
    constexpr std::int64_t at_once = 4096;
    const std::int64_t columns = (tile.x1 - tile.x0) / refined_side + 2;
    const int rows = int(std::max<std::int64_t>(at_once / columns, 1)) * refined_side;
    WidePainter painter(queue, renderer);
    std::int64_t samples = 0;
    Tile part = tile;
    for (int y = tile.y0 / refined_side * refined_side; y < tile.y1; y += rows) {
        part.y0 = std::max(y, tile.y0);
        part.y1 = std::min(y + rows, tile.y1);
        const auto taken = refine_tile(painter, part, target, error, job);
        if (!taken) return {samples, false};
        samples += *taken;
        job.advance(std::int64_t(part.x1 - part.x0) * (part.y1 - part.y0));
    }
    return {samples, true};
}

std::size_t texel_count(const optics::SummedImage& image) { return std::size_t(image.columns) * image.rows * 4; }

}  // namespace

DevicePanel::DevicePanel(Queue& queue, const optics::SummedImage& panel) : texels_(queue, texel_count(panel)) {
    queue.upload(texels_.get(), panel.texels, texel_count(panel) * sizeof(float));
}

std::size_t DevicePanel::bytes(const optics::SummedImage& panel) { return texel_count(panel) * sizeof(float); }

std::size_t picture_bytes(const Tile& tile) {
    return std::size_t(tile.x1 - tile.x0) * std::size_t(tile.y1 - tile.y0) * 3 * sizeof(float);
}

Done render_there(Queue& queue, const DevicePanel& panel, const Tile& tile, float* out, Job& job) {
    Renderer renderer(queue, panel, tile);
    const std::int64_t pixels = std::int64_t(tile.x1 - tile.x0) * (tile.y1 - tile.y0);
    queue.clear(out, std::size_t(pixels) * 3 * sizeof(float));  // what is not finished is black
    Frame& frame = renderer.frame();
    frame.tile.out = out;
    frame.tile.crop_x = tile.x0;
    frame.tile.crop_y = tile.y0;
    frame.tile.crop_width = tile.x1 - tile.x0;
    std::int64_t reported = 0;  // pixels reported to the job
    const bool complete = renderer.run_all([&](std::int64_t done) {
        done = std::min(done, pixels - reported);  // squares reach beyond the tile
        reported += done;
        if (reported < pixels) queue.seconds();  // waits, so that the caller does not run far ahead of the machine
        job.advance(done);
        return !job.cancelled();
    });
    return {reported * std::int64_t(tile.samples), complete};
}

Done render(Queue& queue, const DevicePanel& panel, const Tile& tile, std::optional<double> target_error, float* error, Job& job) {
    if (target_error) {
        Renderer renderer(queue, panel, tile);
        return render_refined(queue, renderer, tile, *target_error, error, job);
    }
    const std::size_t count = std::size_t(tile.x1 - tile.x0) * std::size_t(tile.y1 - tile.y0) * 3;
    const Buffer<float> out(queue, count);
    const Done done = render_there(queue, panel, tile, out.get(), job);
    queue.download(tile.out, out.get(), count * sizeof(float));
    return done;
}

}  // namespace lfdsim::wide
