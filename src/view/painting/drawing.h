// Renders and encodes the pictures of one state, coarse, fine and final. Floor 5. For one visitor, on one thread.
#pragma once
#include "analysis/core/elemental_panel.h"
#include "view/answers/likeness.h"
#include "view/painting/eye_displays.h"
#include "view/painting/frame.h"
#include "view/painting/pace.h"

#include <memory>
#include <string>
#include <vector>

namespace lfdsim::view {

class Drawing {
  public:
    Drawing(const Library& library, Panels& panels, int threads) : library_(library), panels_(panels), threads_(threads) {}

    /// A frame as frame.h makes it, and the lane in which it is sent.
    struct DrawnFrame {
        std::string lane, bytes;
    };
    /// Frames that belong together: all of one state and quality.
    using Frames = std::vector<DrawnFrame>;

    /// Begins another state. Throws InputError, also where its pictures or panel would not fit into memory. With two eyes, the
    /// photograph or difference beside them is that of the left one.
    void begin(const Wanted&);
    /// Returns why the photograph or difference is not possible; empty: it is.
    std::string beside_problem() const;

    // The functions that draw throw InputError, and Stopped where the job is cancelled.

    /// Renders at the best size and quality that take about 22 ms. The panel's light is a stand-in, made in about 12 ms, unless the
    /// true one exists already.
    Frames coarse(Job&);
    /// Whether final() would keep the page waiting and fine() shows more than coarse() did.
    bool wants_fine() const;
    /// Renders in full size with the true panel, and as few samples as coarse() takes.
    Frames fine(Job&);
    /// Renders the final picture, which has the same bits as that of lfdsim render.
    Frames final(Job&);
    /// Renders the final picture as an OpenEXR file; the right eye's picture is its layer "right".
    DrawnFrame exr(std::int64_t id, Job&);

  private:
    /// A display as one eye sees it, with the light of its panel.
    struct LitDisplay {
        EyeDisplay seen;
        std::shared_ptr<const ShownPanel> light;
    };
    LitDisplay true_light(const EyeDisplay&, Job&);
    LitDisplay quick_light(const EyeDisplay&, Job&);
    Frames pictures(const std::vector<LitDisplay>&, Quality, double scale, Job&);
    void beside(const LitDisplay&, const Display&, const Geometry&, FrameHeader, Image& view, Frames&, FrameHeader& of_view, Job&);
    double coarse_cost(const EyeDisplay&, double scale) const;
    double final_cost() const;

    const Library& library_;
    Panels& panels_;
    const int threads_;
    Wanted wanted_;
    MemoryBudget::Claim pictures_;
    std::vector<EyeDisplay> eyes_;
    bool on_gpu_ = false;          // pictures are rendered on a GPU
    bool coarse_is_full_ = false;  // the last coarse picture of this state has its full size and the true panel
    Pace coarse_pace_{1}, final_pace_{1}, panel_pace_{1};
    int coarse_scale_ = 0, coarse_panel_ = 0;  // the last choices, as indices
    PanelKey stand_in_key_;
    std::shared_ptr<const ShownPanel> stand_in_;  // the last stand-in: reused while only the eye moves
    WhiteField quick_white_, white_;              // of moving pictures, and of final ones
};

}  // namespace lfdsim::view
