// Lines of sight from one eye to a white panel, spread over a window of the screen, and waves in the light that they see. Floor 3.
//
// The window is cut into equal squares; each set of lines has one through each square, at a random place. The mean of light times a
// wave over such lines is that over the plane, whatever else the light holds: unlike evenly spaced points they make no false beats.
#pragma once
#include "analysis/core/estimate.h"
#include "analysis/core/eye_rays.h"
#include "analysis/core/parallel.h"
#include "analysis/moire/moire_theory.h"
#include "analysis/moire/wave_sums.h"

#include <optional>
#include <vector>

namespace lfdsim {

/// A rectangle of the vertex plane about the display's axis, in squares of `square_mm`.
struct Window {
    int columns, rows;
    double square_mm;
    double width_mm() const { return columns * square_mm; }
    double height_mm() const { return rows * square_mm; }
};

/// Blackman's window over [0, 1], 1 in the mean.
double blackman(double u);

/// A number in [0, 1) for each counter.
double counted_random(std::uint64_t counter);

/// Light that a line of sight brings from a white panel, over the panel's own along its normal.
struct WhiteLight {
    double plain = 0;  // of a panel without subpixels and black matrix: the mean
    double seen = 0;   // where the line ends
};

/// A white panel behind the lenses, each channel in its own light. It is looked at in one or several mixtures of its channels, such
/// as luminance and red alone: they share the lines, which take most of the time.
class WhiteSeen {
  public:
    /// `green`: the display's own geometry.
    WhiteSeen(const Display&, const Geometry& green, const std::vector<ChannelWeights>& mixtures);
    std::size_t mixtures() const { return mixtures_; }

    /// Looks along the line from an eye that aims at (x, y) of the vertex plane, with the diffuser's numbers a and b: light[m] is
    /// that of mixture m.
    void look(const Vec3d& eye, double x, double y, double a, double b, std::vector<WhiteLight>& light) const;

    /// Colours that take the same path count as one.
    std::size_t paths() const { return paths_.size(); }
    /// The white panel of the part of a mixture that takes a path; null if no part does.
    const WhitePanel* white(std::size_t path, std::size_t mixture) const {
        const std::optional<WhitePanel>& white = paths_[path].white[mixture];
        return white ? &*white : nullptr;
    }
    /// The end of a line of sight in the light of one path: columns and rows of the panel from its corner; the mean light there
    /// is 0 where the line is blocked or ends beside the panel.
    struct End {
        double column = 0, row = 0, light = 0;
    };
    End end(std::size_t path, const Vec3d& eye, double x, double y, double a, double b) const;

  private:
    /// A path of light and the white panels of the channels that take it.
    struct ChannelPath {
        EyeRays rays;
        std::vector<std::optional<WhitePanel>> white;  // of each mixture
    };
    const Panel& panel_;
    double vertex_plane_;
    std::size_t mixtures_;
    std::vector<ChannelPath> paths_;
};

/// The light of a window of the screen in one mixture, by lines of sight.
class WhiteLines {
  public:
    /// Traces the lines and makes one object for each mixture. Takes window.rows parts.
    static std::vector<WhiteLines> of(const WhiteSeen&, std::int64_t seed, const Vec3d& eye, const Window&, Parts&);

    const Window& window() const { return window_; }

    /// The mean luminance, weighted as waves are, of a panel without structure.
    double mean() const { return mean_; }

    /// The change of light in each square by subpixels and black matrix, all sets together, times weights that fall to 0 at the
    /// window's border: Blackman's along both axes, 1 in the mean.
    const std::vector<double>& weighted_change() const { return change_; }

    /// Standard deviation of a wave's amplitude over mean(), all sets together, if each line's light were chance.
    double noise() const { return noise_; }

  private:
    explicit WhiteLines(const Window& window) : window_(window) {}

    Window window_;
    std::vector<double> change_;  // weighted: row, column
    double mean_ = 0, noise_ = 0;
};

}  // namespace lfdsim
