// Options about grids of views, read and written. Floor 5.
#pragma once
#include "cli/output/output.h"
#include "cli/program/command.h"
#include "content/pictures/field_picture.h"
#include "content/pictures/read_views.h"
#include "display/display.h"
#include "geometry/geometry.h"

#include <optional>
#include <string>

namespace lfdsim::cli {

/// --focus-width-mm, --focus-depth-mm, --camera-distance-mm, --baseline-mm, --view-cone-deg, --cone.
class GridOptions {
  public:
    explicit GridOptions(Command command);
    /// Throws InputError with all that is wrong.
    ViewsWish read() const;

  private:
    std::string width_, depth_, distance_, baseline_, cone_, cameras_;
};

/// Where a grid is placed that says nothing of it.
ViewsPlace views_place(const Display&, const Geometry&);

/// The grid in words, and as JSON.
std::string grid_text(const ViewGrid&);
Json grid_json(const ViewGrid&);

/// --views, --flip-views and the options of its grid.
class ViewsOption {
  public:
    explicit ViewsOption(Command command);
    bool given() const { return option_.count() > 0; }
    /// To be called before long work: finds out what there is. No output may replace any of it. Throws InputError.
    void check();
    struct Made {
        FieldPicture field;
        std::string text;  // of what it was made
        Json json;
    };
    /// Reads the views and makes elemental images of them; warns of what is wrong with their order. Throws InputError, and
    /// Interrupted where a signal ends the reading.
    Made make(const Display&, const Geometry&, int threads, Progress&) const;

  private:
    std::string path_;
    bool flip_ = false;
    Option option_;
    GridOptions grid_;
    ViewsSource source_;
    ViewsWish wish_;
};

}  // namespace lfdsim::cli
