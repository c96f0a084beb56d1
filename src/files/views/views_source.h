// Grids of views in files, of other programs and of this one: which pictures there are, in which order, and what is known of their
// cameras. docs/views.md describes the forms. No picture is read here. Floor 2.
#pragma once
#include "base/input_error.h"
#include "display/view_grid.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lfdsim {

/// How a grid of views is kept in files. `numbered`: as views.toml describes it.
enum class ViewsForm { hci, stanford, row_column, numbered, quilt };
/// Returns the form in words, for messages.
std::string_view name_of(ViewsForm);

/// What the values of depth maps are.
enum class DepthValue {
    distance,   // from the cameras' plane, in `depth_unit_mm`; 0 or less where there is nothing
    disparity,  // pixels by which a point moves from a camera to its neighbour; positive in front of the focus
};

/// A grid of views as its files describe it. Lengths are those of the scene where the pictures were taken, unless for_display.
struct ViewsSource {
    ViewsForm form = ViewsForm::numbered;
    std::string name;                             // of the folder or file, for messages
    int columns = 1, rows = 1;                    // of cameras; a quilt is one row, whatever its tiles
    std::vector<std::filesystem::path> pictures;  // row by row from the upper left camera; of a quilt the one file
    std::array<int, 2> tiles{1, 1};               // of a quilt: columns and rows of pictures in it
    std::optional<double> aspect;                 // of the focus, width / height; absent: that of a picture's pixels
    std::vector<std::filesystem::path> depths;    // in the pictures' order; an empty name where a view has none; empty: no view has
    DepthValue depth_value = DepthValue::distance;
    double depth_unit_mm = 1;                     // unit of the distances in depth maps
    std::vector<std::array<double, 2>> cameras;   // positions in the pictures' order, x right, y up; empty: not known
    std::string cameras_key = {};                 // the key that states them, with its place: "views.toml:4:15: baseline_mm"
    bool in_mm = true;                            // the unit of these positions is mm; false: it is not known
    std::optional<double> cone_deg;               // angle that the cameras of a row span, in place of their positions
    std::optional<ConeCameras> cone;              // how they divide it; absent: `ends` of quilts, else `bins`
    std::optional<double> distance_mm, width_mm;  // from the cameras' plane to the focus; width of the focus
    std::optional<double> depth_mm;               // of the focus before a display's vertex plane
    bool flipped = false;                         // pictures and cameras have been reversed; the tiles of a quilt's file are not
    bool for_display = false;                     // lengths are those in front of a display, and are not scaled to fit
    std::vector<std::filesystem::path> read;      // files that were read to know all this

    std::size_t views() const { return std::size_t(columns) * std::size_t(rows); }
    /// Returns the mean step from camera to camera along x, or y where there is one column; 0 of a single camera or unknown
    /// positions.
    double step() const;
};

/// Finds the grid of a folder with views.toml, parameters.cfg (HCI 4D) or names of the Stanford archive or ROW_COLUMN, tried in
/// this order, of one of these two files, or of a quilt. Throws InputError that names the file and what is missing or wrong.
ViewsSource find_views(const std::filesystem::path&);

/// Reverses the order of pictures and depth maps, and puts the cameras opposite: pseudoscopic views become orthoscopic.
void flip(ViewsSource&);

/// Columns and rows of tiles and the aspect (width / height) of a view, as the name of a quilt has them: NAME_qs8x6a0.75.
struct QuiltName {
    int columns, rows;
    double aspect;
};
/// Reads the name of a quilt; nothing if it is not of that form. Throws InputError for numbers out of range.
std::optional<QuiltName> quilt_name(const std::filesystem::path&);

/// What the placing of a grid needs to know about the display.
struct ViewsPlace {
    double panel_width_mm = 0, panel_height_mm = 0;
    double vertex_plane_mm = 0;                // z_v
    double depth_mm = 0;                       // default depth of the focus, from the vertex plane
    double viewing_distance_mm = 0;            // D', from the panel; infinity allowed
    std::optional<double> view_cone_deg = {};  // of quilts made for the display: content.view_cone_deg
    // Of a display with such a cone: the distance from lens to lens along the panel's rows, and the width W in which an elemental
    // image is visible at the viewing distance.
    double lens_mm = 0, zone_width_mm = 0;
};

/// What the caller wants of a grid's geometry in place of what its files say.
struct ViewsWish {
    std::optional<double> width_mm, depth_mm, distance_mm, cone_deg;
    std::optional<ConeCameras> cone;
    std::optional<std::array<double, 2>> baseline_mm;
};

/// The cone for views whose files state none, before a display without content.view_cone_deg: that of most devices that show
/// quilts.
inline constexpr double usual_cone_deg = 40;

/// Returns the grid before a display, in its frame. Without wishes the focus is as large as fits the panel (of lengths for_display,
/// as it is) and all lengths are scaled alike; quilts and the Stanford archive, whose distance is not known, get cameras at the
/// viewing distance. A row of views of which nothing is known, before a display with a view cone, is placed as that display shows
/// quilts: camera k of n is where the k-th of n equal parts of the elemental images is visible (docs/model.md, "Grids of views").
/// `focus_aspect` is width / height. What was assumed is appended to `notes`, in words. Throws InputError for what is neither known
/// nor wished, and for impossible grids.
ViewGrid placed(const ViewsSource&, const ViewsWish&, const ViewsPlace&, double focus_aspect, std::vector<std::string>& notes);

/// Returns the text of a views.toml that reads back as the same grid: for pictures of a name ("view_*.png"; empty: of a quilt,
/// whose name states them), numbered row by row from the upper left, and for depth maps of a name unless it is empty. `how`, which
/// may be empty, becomes a comment on how the cameras were placed.
std::string views_toml(const ViewGrid&, const std::string& pictures, const std::string& depth_pictures,
                       const std::string& how = {});

}  // namespace lfdsim
