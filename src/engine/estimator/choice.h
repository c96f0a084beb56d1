// Which estimator renders which part of a picture: measured against points, not decided by the kind of display. Floor 2.
//
// Filtered light is many times cheaper than points of the same error where lenses bend rays smoothly and pixels emit over their
// whole area. Where they do not, it may be wrong, and equally for every seed. So a region of the frame is rendered by filtered
// light only where that agrees with points at places spread over the region; elsewhere by as many points as a small error takes.
// docs/model.md, "What a default picture is made of".
#pragma once
#include "engine/estimator/gaussian_parts.h"
#include "engine/scene/work.h"

#include <list>
#include <optional>
#include <vector>

namespace lfdsim {

/// The choice of estimator for one region.
struct RegionChoice {
    int filtered = -1;         // which of the numbers of samples of filtered light; -1: by points
    std::uint32_t points = 0;  // points a pixel, if by points; 0: as many as the target error takes
    double error = 0;          // root mean square over pixels and colours, linear light, as measured at the region's places
    std::int64_t samples = 0;  // taken to measure
};

/// A display's picture by filtered light and by points, and what each region of its frame takes.
class EstimatorChoice {
  public:
    static constexpr int region_side = 256;  // pixels of the frame

    /// Throws what Work throws. When the job is cancelled, look(), choose() and render() return soon.
    EstimatorChoice(const Display&, const Geometry&, const std::vector<optics::SummedImage>& panel, const RenderOptions&,
                    const Job&);

    /// Returns the picture by points; its result is that of the whole picture.
    Work& work() { return points_; }
    const Work& work() const { return points_; }

    /// Measures the light of the whole frame, which errors are judged by. Comes before choose().
    void look(Kernel);
    /// Returns the choice for the region in this column and row of regions, counted from the frame's first. It depends neither on
    /// the crop nor on what is chosen elsewhere. May be called by several threads.
    RegionChoice choose(Kernel, int column, int row) const;
    /// Renders a tile that lies in a region by anything but a target error; returns the samples taken, or nothing where the
    /// job was cancelled on the way.
    std::optional<std::int64_t> render(Kernel, const RegionChoice&, const Tile&) const;

  private:
    using PixelColours = std::vector<float>;  // three numbers a pixel

    /// Filtered light with one number of samples: pictures, with their weights, that add up to it. A box diffuser takes one, a
    /// gaussian diffuser one for each box that it consists of.
    struct Part {
        Part(const EvenPart& of, const Geometry& geometry, const std::vector<optics::SummedImage>& panel,
             const RenderOptions& options, const Job& job)
            : work(of.display, geometry, panel, options, job), weight(of.weight) {}
        Work work;
        float weight;
    };
    using Filtered = std::list<Part>;

    /// Returns the filtered light of places, one after the other.
    static PixelColours filtered_at(Kernel, const std::vector<Rect>& places, const Filtered&);
    /// Returns the light of places by points; that of the panel if it were white, with `of_white`. Different repetitions use
    /// independent numbers.
    PixelColours points_at(Kernel, const std::vector<Rect>& places, std::uint32_t points, int repetition,
                           bool of_white = false) const;

    Work points_;
    std::list<Filtered> filtered_;        // one for each number of samples that is tried
    std::optional<std::uint32_t> given_;  // samples, where the description has a number of them
    double light_ = 0;                    // of the frame, by which errors are judged
};

}  // namespace lfdsim
