#include "engine/pyramid.h"

#include "engine/gpu.h"
#include "optics/scene.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

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

}  // namespace

Pyramid::~Pyramid() = default;
Pyramid::Pyramid(Pyramid&&) noexcept = default;
Pyramid& Pyramid::operator=(Pyramid&&) noexcept = default;

Pyramid::Pyramid(const Texels& panel, int threads) : on_gpus_(std::make_shared<GpuPanels>()) {
    const auto level = [](const Texels& t) {
        return optics::PanelLevel{t.data(), std::uint32_t(t.columns()), std::uint32_t(t.rows())};
    };
    levels_.push_back(level(panel));
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    while (levels_.back().columns > 1 || levels_.back().rows > 1) {
        const optics::PanelLevel from = levels_.back();
        Texels to((std::int64_t(from.columns) + 1) / 2, (std::int64_t(from.rows) + 1) / 2);
        arena.execute([&] {
            tbb::parallel_for(
                tbb::blocked_range<std::int64_t>(0, to.rows(), 16), [&](const tbb::blocked_range<std::int64_t>& rows) {
                    for (std::int64_t r = rows.begin(); r < rows.end(); ++r) {
                        const float* const upper = from.texels + 2 * r * std::int64_t(from.columns) * 4;
                        const bool whole = 2 * r + 1 < std::int64_t(from.rows);
                        average_rows(upper, whole ? upper + std::int64_t(from.columns) * 4 : nullptr, from.columns, to.row(r));
                    }
                });
        });
        levels_.push_back(level(to));
        coarse_.push_back(std::move(to));
    }
}

}  // namespace lfdsim
