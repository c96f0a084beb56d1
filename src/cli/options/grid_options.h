// The options of commands that read or write grids of views. Floor 5.
#pragma once
#include "cli/output/output.h"
#include "cli/program/command.h"
#include "content/pictures/field_picture.h"
#include "content/pictures/read_views.h"
#include "display/display.h"
#include "geometry/geometry.h"
#include "inverse/inverse.h"

#include <optional>
#include <string>

namespace lfdsim::cli {

/// The options --focus-width-mm, --focus-depth-mm, --camera-distance-mm, --baseline-mm, --view-cone-deg, --cone.
class GridOptions {
  public:
    explicit GridOptions(Command command) : command_(command) {}
    /// Returns what the options say. Throws InputError with all faults.
    ViewsWish read() const;

  private:
    Command command_;
    Option width_ = command_.option("--focus-width-mm", "W", "Width of the views' focus, the rectangle without parallax");
    Option depth_ = command_.option("--focus-depth-mm", "Z", "Depth of the views' focus in front of the lenses' vertex plane");
    Option distance_ = command_.option("--camera-distance-mm", "D", "Distance from the views' cameras to their focus");
    Option baseline_ =
        command_.option("--baseline-mm", "B|BX,BY", "Distance between neighbouring cameras: along x and y, or the same along both");
    Option cone_ = command_.option("--view-cone-deg", "A", "Angle that the cameras of a row span, in equal steps");
    Option cameras_ = command_.option("--cone", "ends|bins",
                                      "Division of that angle A between n cameras. ends: the first and last at its ends, camera i "
                                      "at (i/(n-1) - 1/2) A, as makers of quilts define it (default for quilts); bins: each in the "
                                      "middle of one of n equal parts, at ((i + 1/2)/n - 1/2) A");
};

/// Returns the properties of a display by which grids of views are placed before it.
ViewsPlace views_place(const Display&, const Geometry&);

/// Returns a grid in words, or as JSON.
std::string grid_text(const ViewGrid&);
Json grid_json(const ViewGrid&);

/// The option --views, --flip-views and the options of its grid.
class ViewsOption {
  public:
    explicit ViewsOption(Command command) : command_(command) {}
    bool given() const { return views_.given(); }
    /// Finds the views, before long work, and remembers their files as inputs, which no output may replace. Throws InputError.
    void check();
    struct PanelOfViews {
        FieldPicture field;
        std::string text;                           // the views and their grid, in words
        Json json;                                  // the same for --json
        std::optional<InverseReport> inverse = {};  // of the inverse pick-up
    };
    /// Reads the views and makes elemental images of them; warns if their order seems wrong. Throws InputError, and Interrupted
    /// where a signal ends the reading.
    PanelOfViews make(const Display&, const Geometry&, int threads, Progress&) const;

  private:
    Command command_;
    Option views_ =
        command_.option("--views", "FOLDER|FILE",
                        "Views to show in place of a model: a folder with views.toml, HCI 4D or Stanford archive pictures, "
                        "or a quilt NAME_qs8x6a0.75.png");
    GridOptions grid_{command_};
    Flag flip_ = command_.flag("--flip-views", "Reverse the order of the views: makes pseudoscopic ones orthoscopic");
    ViewsSource source_;
    ViewsWish wish_;
};

}  // namespace lfdsim::cli
