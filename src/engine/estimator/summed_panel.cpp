#include "engine/estimator/summed_panel.h"

#include "engine/devices/gpu.h"
#include "engine/estimator/panel_planes.h"
#include "engine/scene/traced_display.h"
#include "image/formats/huge_pages.h"
#include "optics/traced_display.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <stdexcept>

namespace lfdsim {

namespace {

using optics::SummedImage;
using Range = tbb::blocked_range<std::int64_t>;

/// Returns the picture of one pixel of each cell of a panel (docs/model.md, "Black matrix and subpixels"). It is black where that
/// pixel lies outside the panel, or where its cell is cut off by the panel's border and only whole cells show it
/// (PanelPlane::whole).
Texels picked(const SummedImage& from, const PanelPlane& plane, tbb::task_arena& arena) {
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
        tbb::parallel_for(Range(0, to.rows(), 16), [&](const Range& some) {
            for (std::int64_t r = some.begin(); r < some.end(); ++r) pick_row(r);
        });
    });
    return to;
}

/// Returns the smallest power of two, at least 1, by which the image's light is 1 at most after division.
float scale_of(const SummedImage& image) {
    const float* const texels = image.texels;
    const float most = tbb::parallel_reduce(
        Range(0, std::int64_t(image.columns) * image.rows * 4, 1 << 16), 1.0f,
        [&](const Range& some, float found) {
            for (std::int64_t k = some.begin(); k < some.end(); ++k) found = std::max(found, texels[k]);
            return found;
        },
        [](float a, float b) { return std::max(a, b); });
    return std::exp2(std::ceil(std::log2(most)));
}

/// The summed-area table of an image (docs/model.md, "Filtered estimator"), and the light of one unit.
struct SummedTable {
    std::unique_ptr<std::uint32_t[]> sums;
    float light_per_unit;

    SummedTable(const SummedImage& image, tbb::task_arena& arena) {
        const std::int64_t columns = image.columns, rows = image.rows, pitch = (columns + 1) * 4;
        sums.reset(new std::uint32_t[std::size_t(pitch * (rows + 1))]);  // not cleared
        detail::want_huge_pages(sums.get(), std::size_t(pitch * (rows + 1)) * sizeof(std::uint32_t));
        arena.execute([&] {
            light_per_unit = scale_of(image) / float(SummedImage::units);
            const float units = 1 / light_per_unit;
            // Along each row, then down the columns
            std::fill_n(sums.get(), pitch, 0u);
            tbb::parallel_for(Range(0, rows, 16), [&](const Range& some) {
                for (std::int64_t r = some.begin(); r < some.end(); ++r)
                    sum_row(image.texels + r * columns * 4, columns, units, row(r + 1, pitch));
            });
            // Bands of 32 columns are a few cache lines wide.
            tbb::parallel_for(Range(0, pitch, 128), [&](const Range& some) {
                for (std::int64_t r = 1; r < rows; ++r)
                    for (std::int64_t k = some.begin(); k < some.end(); ++k) row(r + 1, pitch)[k] += row(r, pitch)[k];
            });
        });
    }

  private:
    std::uint32_t* row(std::int64_t r, std::int64_t pitch) { return sums.get() + r * pitch; }
    /// Writes the sums of one row from its left end on, the first being 0. They wrap: differences of sums modulo 2^32 stay exact.
    static void sum_row(const float* light, std::int64_t columns, float units, std::uint32_t* to) {
        std::uint32_t sum[4] = {};
        std::fill_n(to, 4, 0u);
        for (std::int64_t c = 0; c < columns; ++c)
            for (int k = 0; k < 4; ++k) to[4 * c + 4 + k] = sum[k] += std::uint32_t(std::int32_t(light[4 * c + k] * units + 0.5f));
    }
};

/// The planes that a reading of a panel needs. `all` has the panel first and points into the other two.
struct SummedPlanes {
    std::vector<Texels> picked;
    std::vector<SummedTable> tables;
    std::vector<SummedImage> all;
    std::shared_ptr<GpuPanels> on_gpus = std::make_shared<GpuPanels>();
};

SummedImage unsummed(const Texels& t) { return {t.data(), nullptr, 0, std::uint32_t(t.columns()), std::uint32_t(t.rows())}; }

}  // namespace

PanelReading panel_reading(const Display& display) {
    if (estimator_of(display) == Estimator::point) return {.summed = false};
    return {.planes = planes(display.panel)};
}

struct SummedPanel::Parts {
    SummedImage image;  // the panel, without a table
    tbb::task_arena arena;
    std::mutex mutex;  // of `of`
    std::map<PanelReading, SummedPlanes> of;

    SummedPlanes made(const PanelReading& reading) {
        SummedPlanes made;
        for (const PanelPlane& plane : reading.planes) {
            made.all.push_back(image);
            SummedImage& one = made.all.back();
            if (made.all.size() > 1) one = unsummed(made.picked.emplace_back(picked(image, plane, arena)));
            if (!reading.summed) continue;
            const SummedTable& table = made.tables.emplace_back(one, arena);
            one.sums = table.sums.get();
            one.light_per_unit = table.light_per_unit;
        }
        return made;
    }
};

SummedPanel::~SummedPanel() = default;
SummedPanel::SummedPanel(SummedPanel&&) noexcept = default;
SummedPanel& SummedPanel::operator=(SummedPanel&&) noexcept = default;

SummedPanel::SummedPanel(const Texels& panel, int threads) : parts_(std::make_unique<Parts>()) {
    parts_->image = unsummed(panel);
    parts_->arena.initialize(threads > 0 ? threads : tbb::task_arena::automatic);
}

const std::vector<SummedImage>& planes_of(const SummedPanel& panel, const PanelReading& reading) {
    SummedPanel::Parts& parts = panel.parts();
    const std::lock_guard lock(parts.mutex);
    SummedPlanes& wanted = parts.of[reading];
    if (wanted.all.empty()) wanted = parts.made(reading);
    return wanted.all;
}

GpuPanels& gpu_panels_of(const SummedPanel& panel, const std::vector<SummedImage>& planes) {
    SummedPanel::Parts& parts = panel.parts();
    const std::lock_guard lock(parts.mutex);
    for (const auto& [reading, of] : parts.of)
        if (&of.all == &planes) return *of.on_gpus;
    throw std::logic_error("planes of another panel");
}

}  // namespace lfdsim
