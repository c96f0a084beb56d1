#include "engine/pyramid.h"

#include "engine/gpu.h"
#include "engine/scene.h"
#include "model/geometry.h"
#include "optics/scene.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <stdexcept>

namespace lfdsim {

namespace {

// One row of cells from two rows of the level below; `lower` is null where it lies outside the panel.
void average_rows(const float* upper, const float* lower, std::int64_t columns, float* out) {
    for (std::int64_t i = 0; i < (columns + 1) / 2; ++i) {
        const bool whole = 2 * i + 1 < columns;
        for (int c = 0; c < 4; ++c) {
            auto pair = [&](const float* row) { return row[8 * i + c] + (whole ? row[8 * i + 4 + c] : 0.0f); };
            out[4 * i + c] = 0.25f * (pair(upper) + (lower ? pair(lower) : 0.0f));
        }
    }
}

Texels halved(const optics::PanelLevel& from, tbb::task_arena& arena) {
    Texels to((std::int64_t(from.columns) + 1) / 2, (std::int64_t(from.rows) + 1) / 2);
    arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, to.rows(), 16), [&](const tbb::blocked_range<std::int64_t>& rows) {
            for (std::int64_t r = rows.begin(); r < rows.end(); ++r) {
                const float* const upper = from.texels + 2 * r * std::int64_t(from.columns) * 4;
                const bool whole = 2 * r + 1 < std::int64_t(from.rows);
                average_rows(upper, whole ? upper + std::int64_t(from.columns) * 4 : nullptr, from.columns, to.row(r));
            }
        });
    });
    return to;
}

// One pixel of each cell of a panel; black where that lies outside of it, or where only whole cells show it.
Texels picked(const optics::PanelLevel& from, const PanelPlane& plane, tbb::task_arena& arena) {
    const std::int64_t columns = from.columns, rows = from.rows, across = plane.cell[0], down = plane.cell[1];
    Texels to((columns + across - 1) / across, (rows + down - 1) / down);
    const std::int64_t last_column = plane.whole[0] ? columns / across : to.columns(),
                       last_row = plane.whole[1] ? rows / down : to.rows();
    const auto pick_row = [&](std::int64_t r) {
        const std::int64_t row = r * down + plane.pixel[1];
        for (std::int64_t c = 0; c < to.columns(); ++c) {
            const std::int64_t column = c * across + plane.pixel[0];
            const bool there = column >= 0 && column < columns && row >= 0 && row < rows && c < last_column && r < last_row;
            for (int k = 0; k < 4; ++k) to.row(r)[4 * c + k] = there ? from.texels[4 * (row * columns + column) + k] : 0;
        }
    };
    arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, to.rows(), 16), [&](const tbb::blocked_range<std::int64_t>& some) {
            for (std::int64_t r = some.begin(); r < some.end(); ++r) pick_row(r);
        });
    });
    return to;
}

// Sums over columns (down) or along rows, in double precision.
Texels sums(const optics::PanelLevel& from, Long along, tbb::task_arena& arena) {
    const bool down = along == Long::down;
    const std::int64_t columns = from.columns, rows = from.rows;
    Texels to(down ? columns : columns + 1, down ? rows + 1 : rows);
    const auto sum_line = [&](std::int64_t line) {
        double sum[4] = {};
        for (std::int64_t k = 0; k < (down ? rows : columns); ++k) {
            const std::int64_t column = down ? line : k, row = down ? k : line;
            for (int c = 0; c < 4; ++c) {
                sum[c] += double(from.texels[(row * columns + column) * 4 + c]);
                to.row(down ? row + 1 : row)[(down ? column : column + 1) * 4 + c] = float(sum[c]);
            }
        }
    };
    arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, down ? columns : rows, 16),
                          [&](const tbb::blocked_range<std::int64_t>& lines) {
                              for (std::int64_t line = lines.begin(); line < lines.end(); ++line) sum_line(line);
                          });
    });
    return to;
}

optics::PanelLevel level(const Texels& t) { return {t.data(), std::uint32_t(t.columns()), std::uint32_t(t.rows())}; }

struct Levels {
    std::vector<Texels> made;
    std::vector<optics::PanelLevel> all;
    std::shared_ptr<GpuPanels> on_gpus = std::make_shared<GpuPanels>();

    void add(Texels cells) {
        all.push_back(level(cells));
        made.push_back(std::move(cells));
    }
};

}  // namespace

Long long_footprints(const Geometry& geometry) {
    if (!geometry.lattice.strips) return Long::none;
    return std::abs(geometry.lattice.cos_turn) >= std::abs(geometry.lattice.sin_turn) ? Long::down : Long::across;
}

PanelReading panel_reading(const Display& display, const Geometry& geometry) {
    if (estimator_of(display) == Estimator::point) return {.coarser = false};
    return {.footprints = long_footprints(geometry), .planes = planes(display.panel)};
}

optics::PanelLevels panel_levels(const std::vector<optics::PanelLevel>& levels, const PanelReading& reading,
                                 const optics::Emission<float>& emission) {
    const bool sums = reading.footprints != Long::none;
    const int lists = (sums ? 2 : 1) * int(reading.planes.size());
    return {levels.data(),  int(levels.size()) / lists, sums,           reading.footprints == Long::down,
            emission.whole, levels[0].columns,          levels[0].rows, &emission};
}

struct Pyramid::Parts {
    optics::PanelLevel image;
    tbb::task_arena arena;
    std::mutex mutex;
    std::map<PanelReading, Levels> of;

    Levels made(const PanelReading& reading) {
        std::size_t count = 1;  // of levels of the panel, and of each plane
        for (std::uint32_t n = std::max(image.columns, image.rows); reading.coarser && n > 1; n = (n + 1) / 2) ++count;
        Levels levels;
        for (const PanelPlane& plane : reading.planes) {
            const std::size_t first = levels.all.size();
            first == 0 ? levels.all.push_back(image) : levels.add(picked(image, plane, arena));
            for (std::size_t k = 1; k < count; ++k) levels.add(halved(levels.all.back(), arena));
            if (reading.footprints == Long::none) continue;
            for (std::size_t k = 0; k < count; ++k) levels.add(sums(levels.all[first + k], reading.footprints, arena));
        }
        return levels;
    }
};

Pyramid::~Pyramid() = default;
Pyramid::Pyramid(Pyramid&&) noexcept = default;
Pyramid& Pyramid::operator=(Pyramid&&) noexcept = default;

Pyramid::Pyramid(const Texels& panel, int threads) : parts_(std::make_unique<Parts>()) {
    parts_->image = level(panel);
    parts_->arena.initialize(threads > 0 ? threads : tbb::task_arena::automatic);
}

const std::vector<optics::PanelLevel>& Pyramid::levels(const PanelReading& reading) const {
    const std::lock_guard lock(parts_->mutex);
    Levels& wanted = parts_->of[reading];
    if (wanted.all.empty()) wanted = parts_->made(reading);
    return wanted.all;
}

GpuPanels& Pyramid::on_gpus(const std::vector<optics::PanelLevel>& levels) const {
    const std::lock_guard lock(parts_->mutex);
    for (const auto& [reading, of] : parts_->of)
        if (&of.all == &levels) return *of.on_gpus;
    throw std::logic_error("levels of another pyramid");
}

}  // namespace lfdsim
