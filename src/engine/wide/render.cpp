#include "engine/wide/render.h"

#include "engine/refine.h"

#include <algorithm>

namespace lfdsim::wide {

namespace {

constexpr std::int64_t most_points = std::int64_t(1) << 31;  // in one step: a fraction of a second, after which Ctrl-C takes effect
constexpr int point_side = 16;

/// Bytes for a block and its entries in lists of work: of bundles, and two of blocks.
std::size_t listed_bytes(const BlockSize& block) { return block.bytes + (std::size_t(block.bundles) + 2) * sizeof(std::uint32_t); }

/// Memory for the blocks at hand: for all of a picture, if they take no more than a gigabyte, else for enough of them to fill any
/// machine. With a target error strata change, and any block must find room.
std::size_t block_memory(const Queue& queue, const Tile& tile) {
    const auto along = [&](std::int32_t from, std::int32_t to) { return std::size_t((to - from) / tile.block_side + 2); };
    const std::size_t all = along(tile.x0, tile.x1) * along(tile.y0, tile.y1) *
                            listed_bytes(queue.block_size(tile.strata, tile.scene->by_lens)),
                      largest = listed_bytes(queue.block_size(max_strata - more_strata, true));
    return std::max(largest, std::clamp(all, std::size_t(256) << 20, std::size_t(1) << 30));
}

constexpr std::size_t lists = 3;                // of work
constexpr std::int64_t most_workers = 1 << 17;  // more than any machine has threads at once

/// Renders blocks, a part of them at a time.
class Renderer {
  public:
    Renderer(Queue& queue, const DevicePanel& panel, const Tile& tile)
        : queue_(queue), memory_bytes_(tile.strata > 0 ? block_memory(queue, tile) : 0) {
        frame_.scene = *tile.scene;
        frame_.view = *tile.view;
        frame_.directions = *tile.directions;
        frame_.tile = tile;
        frame_.tile.texels = panel.texels();
        frame_.tile.panel.plane = panel.planes();  // the emission is that of the frame's scene
        if (auto*& lens = frame_.scene.placement.lens) {
            const auto& count = frame_.scene.lattice.count;
            const std::size_t lenses = std::size_t(count[0]) * std::size_t(count[1]);
            lenses_ = Buffer<optics::PlacedLens<float>>(queue_, lenses);
            queue_.upload(lenses_.get(), lens, lenses * sizeof *lens);
            lens = lenses_.get();
        }
    }
    Frame& frame() { return frame_; }

    /// Renders all blocks of the tile's rectangle, and calls after(n) after each part, of n pixels; stops, and returns false, where
    /// after() returns false before the last part.
    template <class After>
    bool run_all(After after) {
        prepare();
        const int side = frame_.tile.block_side;
        const Tile& t = frame_.tile;
        frame_.listed = nullptr;
        frame_.first_column = t.x0 / side;
        frame_.first_row = t.y0 / side;
        frame_.columns = (t.x1 - 1) / side + 1 - frame_.first_column;
        return run(std::int64_t(frame_.columns) * ((t.y1 - 1) / side + 1 - frame_.first_row), after);
    }

    /// Renders the blocks of whole squares of the frame.
    void run_listed(const std::vector<RefinedBlock>& squares) {
        prepare();
        const int side = frame_.tile.block_side;
        std::vector<ListedBlock> all;
        for (std::size_t k = 0; k < squares.size(); ++k)
            for (int y = 0; y < refined_side; y += side)
                for (int x = 0; x < refined_side; x += side) all.push_back({squares[k].x + x, squares[k].y + y, std::int32_t(k)});
        if (all.size() > listed_room_) {
            listed_ = Buffer<ListedBlock>(queue_, all.size());
            listed_room_ = all.size();
        }
        queue_.upload(listed_.get(), all.data(), all.size() * sizeof(ListedBlock));
        frame_.listed = listed_.get();
        run(std::int64_t(all.size()), [](std::int64_t) { return true; });
    }

  private:
    void prepare() {
        Tile& t = frame_.tile;
        if (t.strata == 0) {
            t.block_side = point_side;
            return;
        }
        const BlockSize block = queue_.block_size(t.strata, frame_.scene.by_lens);
        frame_.bytes_per_block = block.bytes;
        if (!memory_.get()) {
            even_ = Buffer<std::byte>(queue_, queue_.even_bytes());
            counts_ = Buffer<std::uint32_t>(queue_, lists);
            memory_ = Buffer<std::byte>(queue_, memory_bytes_);
        }
        at_once_ = std::int64_t(memory_bytes_ / listed_bytes(block));
        std::byte* const numbers = memory_.get() + std::size_t(at_once_) * block.bytes;
        frame_.even = even_.get();
        frame_.memory = memory_.get();
        frame_.busy = {counts_.get(), reinterpret_cast<std::uint32_t*>(numbers)};
        frame_.alone = {counts_.get() + 1, frame_.busy.number + at_once_};
        frame_.bundles = {counts_.get() + 2, frame_.alone.number + at_once_};
        queue_.run(Step::even, frame_, t.strata + 1);
    }

    template <class After>
    bool run(std::int64_t blocks, After after) {
        const Tile& t = frame_.tile;
        const std::int64_t pixels = std::int64_t(t.block_side) * t.block_side;
        const std::int64_t at_once =
            t.strata == 0 ? std::max<std::int64_t>(most_points / (pixels * std::max(t.samples, 1u)), 1) : at_once_;
        for (std::int64_t first = 0; first < blocks; first += at_once) {
            const std::int64_t count = std::min(at_once, blocks - first);
            frame_.first_block = first;
            t.strata == 0 ? queue_.run(Step::points, frame_, count * pixels) : run_filtered(count, pixels);
            if (!after(count * pixels) && first + count < blocks) return false;
        }
        return true;
    }

    void run_filtered(std::int64_t blocks, std::int64_t pixels) {
        const Tile& t = frame_.tile;
        frame_.workers = std::min(blocks * pixels, most_workers);
        queue_.clear(counts_.get(), lists * sizeof(std::uint32_t));
        queue_.run(Step::blocks, frame_, blocks);
        queue_.run(Step::bundles, frame_, frame_.workers);
        queue_.run(Step::survey, frame_, blocks);
        if (const std::int64_t places = queue_.places_per_axis(t)) {
            queue_.run(Step::places, frame_, blocks * places * places);
            queue_.run(Step::soft, frame_, blocks * pixels);
        }
        queue_.run(Step::pixels, frame_, frame_.workers);
        queue_.run(Step::alone, frame_, frame_.workers);
    }

    Queue& queue_;
    const std::size_t memory_bytes_;
    Frame frame_{};
    Buffer<optics::PlacedLens<float>> lenses_;
    Buffer<std::byte> even_, memory_;
    Buffer<std::uint32_t> counts_;  // of the lists of work
    std::size_t listed_room_ = 0;
    std::int64_t at_once_ = 0;  // blocks
    Buffer<ListedBlock> listed_;
};

/// Renders squares of the frame for refine_tile.
class Painter : public BlockPainter {
  public:
    Painter(Queue& queue, Renderer& renderer) : queue_(queue), renderer_(renderer) {
        Tile& t = renderer_.frame().tile;  // whole squares, whatever the crop
        t.x0 = t.y0 = 0;
        t.x1 = t.view->width;
        t.y1 = t.view->height;
        side_ = t.block_side;
    }
    void paint(const std::vector<RefinedBlock>& squares, int strata, std::uint32_t points, std::uint64_t seed,
               std::vector<RefinedPicture>& pictures) override {
        Frame& frame = renderer_.frame();
        if (pictures.size() > room_) out_ = Buffer<RefinedPicture>(queue_, room_ = pictures.size());
        queue_.upload(out_.get(), pictures.data(), pictures.size() * sizeof(RefinedPicture));
        frame.tile.out = reinterpret_cast<float*>(out_.get());
        frame.tile.strata = strata;
        frame.tile.samples = points;
        frame.tile.block_side = side_;
        frame.view.seed = seed;
        renderer_.run_listed(squares);
        queue_.download(pictures.data(), out_.get(), pictures.size() * sizeof(RefinedPicture));
    }

  private:
    Queue& queue_;
    Renderer& renderer_;
    int side_;
    Buffer<RefinedPicture> out_;
    std::size_t room_ = 0;
};

/// Renders rows of squares, some thousands of squares at a time: each takes 30 KB of the caller's memory.
Done render_refined(Queue& queue, Renderer& renderer, const Tile& tile, double target, float* error, Job& job) {
    constexpr std::int64_t at_once = 4096;
    const std::int64_t columns = (tile.x1 - tile.x0) / refined_side + 2;
    const int rows = int(std::max<std::int64_t>(at_once / columns, 1)) * refined_side;
    Painter painter(queue, renderer);
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
std::size_t sum_count(const optics::SummedImage& image) {
    return (std::size_t(image.columns) + 1) * (std::size_t(image.rows) + 1) * 4;
}

}  // namespace

DevicePanel::DevicePanel(Queue& queue, const std::vector<optics::SummedImage>& planes) {
    std::vector<optics::SummedImage> there = planes;
    for (optics::SummedImage& plane : there) {
        texels_.emplace_back(queue, texel_count(plane));
        queue.upload(texels_.back().get(), plane.texels, texel_count(plane) * sizeof(float));
        plane.texels = texels_.back().get();
        if (!plane.sums) continue;
        sums_.emplace_back(queue, sum_count(plane));
        queue.upload(sums_.back().get(), plane.sums, sum_count(plane) * sizeof(std::uint32_t));
        plane.sums = sums_.back().get();
    }
    planes_ = Buffer<optics::SummedImage>(queue, there.size());
    queue.upload(planes_.get(), there.data(), there.size() * sizeof there[0]);
}

std::size_t DevicePanel::bytes(const std::vector<optics::SummedImage>& planes) {
    std::size_t all = 0;
    for (const optics::SummedImage& plane : planes)
        all += texel_count(plane) * sizeof(float) + (plane.sums ? sum_count(plane) * sizeof(std::uint32_t) : 0);
    return all;
}

std::size_t picture_bytes(const Queue& queue, const Tile& tile) {
    const std::size_t picture = std::size_t(tile.x1 - tile.x0) * std::size_t(tile.y1 - tile.y0) * 3 * sizeof(float);
    return picture + (tile.strata > 0 ? block_memory(queue, tile) : 0);
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
    std::int64_t told = 0;
    const bool complete = renderer.run_all([&](std::int64_t done) {
        done = std::min(done, pixels - told);  // blocks reach beyond the tile
        told += done;
        if (told < pixels) queue.seconds();  // waits, so that the caller does not run far ahead of the machine
        job.advance(done);
        return !job.cancelled();
    });
    return {told * (tile.strata > 0 ? std::int64_t(tile.strata) * tile.strata : std::int64_t(tile.samples)), complete};
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
