// The views that are fitted or compared: what each eye should see, its rows, and their products with the panel's light. Floor 3.
#pragma once
#include "base/job.h"
#include "image/image.h"
#include "inverse/nearness.h"
#include "inverse/view_rows.h"

#include <optional>
#include <vector>

namespace lfdsim {

/// The light of a panel: four numbers a pixel (R, G, B, unused), 1 = white.
using PanelVector = std::vector<float>;

/// What an eye should see, and how much each element of its view counts.
struct View {
    ViewRows rows;
    float weight;                      // of its errors
    Image content;                     // what it should see, in the content's light: s, not yet the exposure's t
    Image white;                       // what it sees of a white panel
    int elements_per_lens = 1;         // across a lens pitch
    std::vector<float> expected = {};  // of each element the share of the gain that it can show: 1, less where it lies partly
                                       // between lenses or beside the array; 0: it does not count
};

/// Conversion from the content's light s to a view's, t = G (B + (W - B) s).
struct Exposure {
    double black, white, gain;  // B and W, the levels of the content's black and white over a white panel's light; G, that light
    float of(float content) const { return float(gain * (black + (white - black) * double(content))); }
    float content_of(float light) const { return float((double(light) / gain - black) / (white - black)); }
};

/// Views, and the products of their rows with the panel's light x that a fit needs: the matrix M, the diagonal matrices V of the
/// views' weights and U of those of their elements (docs/inverse.md, "What is minimised"). Rows are kept or computed anew.
class FittedViews {
  public:
    /// The job must outlive this object; where it is cancelled, products end soon, unfinished.
    FittedViews(std::vector<View>, bool entries_are_pixels, bool errors_of_codes, Exposure, const Job&);

    const std::vector<View>& views() const { return views_; }
    /// Makes rows and keeps them while they take no more bytes; the others are made again at each product, with the same result.
    /// Returns the bytes taken. A cancelled job keeps no more.
    double keep_rows(double bytes);

    /// Returns M'VU(M 1), the bound of the solver, and sets the scale of later sums. It is 0 for what no element sees that counts.
    PanelVector bound(std::size_t size);
    /// Computes half = M'VU(M x - t), half the gradient, and returns half the sum of squares. Sums are integers, so that the order
    /// in which threads add does not matter. bound() comes first.
    double half_gradient(const PanelVector& x, PanelVector& half);
    /// Returns leak over signal of two boxes' eyes, whose views take turns in the first `in_boxes` ones, if each subpixel shows the
    /// picture of those that get most of its light: the mean of both boxes' ratios. `size`: of the panel's light.
    double crosstalk(std::size_t in_boxes, std::size_t size) const;
    /// Returns what view k sees of a panel, in the content's light.
    Image seen(std::size_t k, const PanelVector& x) const;
    /// Returns how near that comes to the content, over the elements of view k that count. SSIM takes those in between as right; it
    /// is NaN where they are more than a quarter.
    Nearness nearness(std::size_t k, const PanelVector& x) const;
    /// Returns the mean over each `step`-th of the first `count` views that can be compared; NaN if there are none.
    Nearness nearness(const PanelVector& x, std::size_t count, std::size_t step) const;
    Nearness nearness(const PanelVector& x) const { return nearness(x, views_.size(), 1); }

    /// Returns the number of rays of all elements of all views.
    std::int64_t rays() const;

  private:
    struct Strip {  // rows y0 to y1 - 1 of a view
        std::size_t view;
        int y0, y1;
        std::optional<Rows> kept = {};  // else they are made again for each product
    };
    template <class Do>
    void for_strip(const Strip&, const Do&) const;
    /// Returns the light of each number of a white panel in the views from `first` on, each second before `end`, summed over their
    /// elements that count.
    std::vector<double> light_in(std::size_t first, std::size_t end, std::size_t size) const;
    template <bool pixels>
    double add_products(const Strip&, const PanelVector& x, bool of_target, std::vector<std::int64_t>* sums, double& largest) const;
    /// Returns half the sum of squares of M x - t, or of M x unless `of_target`. Adds M'VU of that to `sums`, unless null, and
    /// raises `largest` to the largest term that may occur. add_products() does so for a strip.
    double products(const PanelVector& x, bool of_target, std::vector<std::int64_t>* sums, double& largest) const;
    /// Returns u = 1/(s + 0.05), by which errors count about as differences of sRGB codes; 1 for errors of light.
    float weight_of(float content) const { return errors_of_codes_ ? 1 / (std::max(content, 0.f) + 0.05f) : 1; }

    std::vector<View> views_;
    bool pixels_, errors_of_codes_;
    Exposure exposure_;
    const Job& job_;
    std::vector<Strip> strips_;
    double per_unit_ = 0;  // integers for a unit of the sums
};

}  // namespace lfdsim
