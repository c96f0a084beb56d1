// The panel as the renderer reads it: its image and, for the filtered estimator, the same at ever coarser resolution. Floor 2.
#pragma once
#include "image/texels.h"
#include "model/subpixels.h"

#include <memory>
#include <vector>

namespace lfdsim {

class GpuPanels;  // gpu.h
struct Geometry;

namespace optics {  // optics/scene.h
template <class S>
struct Emission;
struct PanelLevel;
struct PanelLevels;
}  // namespace optics

/// Which way the footprints of lenses are long: strips focus along one direction only.
enum class Long { none, down, across };
Long long_footprints(const Geometry&);

/// What a display's pictures read of a panel.
struct PanelReading {
    bool coarser = true;  // levels beyond the image, which single rays do without
    Long footprints = Long::none;
    std::vector<PanelPlane> planes{PanelPlane()};  // of its subpixels; the first is the panel itself
    auto operator<=>(const PanelReading&) const = default;
};
PanelReading panel_reading(const Display&, const Geometry&);

/// Levels made for a reading, for the tracer. They and the emission must outlive it.
optics::PanelLevels panel_levels(const std::vector<optics::PanelLevel>&, const PanelReading&, const optics::Emission<float>&);

/// Level 0 is the panel image. Level k + 1 has half the columns and rows of level k, rounded up; a cell is the mean of 2 x 2, black
/// outside the panel. They take a third of the panel image's memory. The panel image must outlive it, unchanged.
class Pyramid {
  public:
    /// Nothing is made yet. threads, 0: all, will make it.
    explicit Pyramid(const Texels& panel, int threads = 0);
    ~Pyramid();
    Pyramid(Pyramid&&) noexcept;
    Pyramid& operator=(Pyramid&&) noexcept;

    /// Level after level and, where footprints are long, as many of sums: row k (or column k) of one holds the sum of the level's
    /// rows (columns) before k, so that the mean over any length takes two of them; then as many of each further plane. All are
    /// made at the first call. Sums take one and a third times the panel image's memory, the planes of a cell together another one
    /// and a third. Throws std::bad_alloc. May be called by several threads.
    const std::vector<optics::PanelLevel>& levels(const PanelReading& = {}) const;

    /// The copies of such levels that GPUs hold, made at first use.
    GpuPanels& on_gpus(const std::vector<optics::PanelLevel>& levels) const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace lfdsim
