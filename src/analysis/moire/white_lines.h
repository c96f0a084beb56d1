// Lines of sight from one eye to a white panel, spread over a window of the screen, and the light that they see. Floor 3.
//
// The window is divided into equal squares; each set of lines has one through each square, at a random position. The mean of
// light times a wave over such lines is, in expectation, the mean over the plane, at any frequency: evenly spaced lines would
// beat with lenses and pixels.
#pragma once
#include "analysis/core/estimate.h"
#include "analysis/core/eye_rays.h"
#include "analysis/core/parallel.h"
#include "analysis/moire/moire_theory.h"
#include "analysis/moire/wave_sums.h"

#include <optional>
#include <vector>

namespace lfdsim {

/// A rectangle of the vertex plane about the display's axis, divided into squares.
struct Window {
    int columns, rows;
    double square_mm;
    double width_mm() const { return columns * square_mm; }
    double height_mm() const { return rows * square_mm; }
};

/// Returns Blackman's window over [0, 1], normalised to a mean of 1.
double blackman(double u);

/// Returns a random number in [0, 1) that depends on the counter alone.
double counted_random(std::uint64_t counter);

/// The light that a line of sight brings from a white panel, relative to the panel's along its normal.
struct WhiteLight {
    double plain = 0;  // of a panel without subpixels and black matrix
    double seen = 0;   // of the panel at the line's end
};

/// A white panel seen through the lenses, each channel in its light where glass disperses. It is seen in one or several mixtures
/// of its channels, such as luminance and red alone, which share the lines, since these take most of the time.
class WhiteSeen {
  public:
    /// `green`: the display's geometry. `mixtures`: the weights of red, green and blue in each.
    WhiteSeen(const Display&, const Geometry& green, const std::vector<ChannelWeights>& mixtures);
    std::size_t mixtures() const { return mixtures_; }

    /// Traces the line from an eye that aims at (x, y) of the vertex plane, mm, with the diffuser's numbers a and b in [-1, 1];
    /// light[m] becomes the light of mixture m.
    void look(const Vec3d& eye, double x, double y, double a, double b, std::vector<WhiteLight>& light) const;

    /// Returns the number of light paths; channels that take the same path count once.
    std::size_t paths() const { return paths_.size(); }
    /// Returns the white panel of the channels of a mixture that take a path; null if none does.
    const WhitePanel* white(std::size_t path, std::size_t mixture) const {
        const std::optional<WhitePanel>& white = paths_[path].white[mixture];
        return white ? &*white : nullptr;
    }
    /// The end of a line of sight in the light of one path: pixels from the panel's top left corner; `light`, of a panel without
    /// structure, is 0 if the line is blocked or ends beside the panel.
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
    /// Traces eight lines through each square, and returns an object for each mixture. Takes window.rows parts.
    static std::vector<WhiteLines> of(const WhiteSeen&, std::int64_t seed, const Vec3d& eye, const Window&, Parts&);

    const Window& window() const { return window_; }

    /// Returns the mean light of a panel without structure, weighted by the window as waves are.
    double mean() const { return mean_; }

    /// Returns the change of light in each square that subpixels and black matrix make, over all lines, times Blackman's window
    /// along both axes; row by row, upwards.
    const std::vector<double>& weighted_change() const { return change_; }

    /// Returns the standard deviation of a wave's amplitude, relative to mean(), if each line's change of light had a random
    /// phase.
    double noise() const { return noise_; }

  private:
    explicit WhiteLines(const Window& window) : window_(window) {}

    Window window_;
    std::vector<double> change_;  // weighted: row, column
    double mean_ = 0, noise_ = 0;
};

}  // namespace lfdsim
