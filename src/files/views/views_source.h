// Grids of views in files, as others make them and as we do: which pictures there are, in which order, and what is known of their
// cameras. Floor 2. docs/views.md says what the forms look like. No picture is read here.
#pragma once
#include "base/input_error.h"
#include "display/view_grid.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lfdsim {

enum class ViewsForm { hci, stanford, row_column, numbered, quilt };
std::string_view name_of(ViewsForm);

/// What the values of depth maps are.
enum class DepthValue {
    distance,   // from the cameras' plane, in `depth_unit_mm`; 0 or less where there is nothing
    disparity,  // pixels by which a point moves from a camera to its neighbour; positive in front of the focus
};

/// A grid of views as its files describe it. Lengths are those of the place where the pictures were taken.
struct ViewsSource {
    ViewsForm form = ViewsForm::numbered;
    std::string name;                             // of the folder or file, for messages
    int columns = 1, rows = 1;                    // of cameras
    std::vector<std::filesystem::path> pictures;  // row by row from the upper left camera; of a quilt the one file
    std::array<int, 2> tiles{1, 1};               // of a quilt: columns and rows of pictures in it
    std::optional<double> aspect;                 // of the focus, width / height; absent: that of a picture's pixels
    std::vector<std::filesystem::path> depths;    // in the pictures' order; an empty name where a view has none; empty: no view has
    DepthValue depth_value = DepthValue::distance;
    double depth_unit_mm = 1;
    std::vector<std::array<double, 2>> cameras;  // in the pictures' order, in an unknown unit unless in_mm; empty: not known
    bool in_mm = true;
    std::optional<double> cone_deg;               // what the cameras of a row span, in place of their places
    std::optional<ConeCameras> cone;              // how; absent: ends of quilts, else bins
    std::optional<double> distance_mm, width_mm;  // from the cameras' plane to the focus, the focus's width
    std::optional<double> depth_mm;               // of the focus before a display's vertex plane
    bool flipped = false;                         // the views are in reversed order already; a quilt's tiles still are not
    bool for_display = false;                     // lengths are meant as they are in front of a display
    std::vector<std::filesystem::path> read;      // files that were read to know this

    std::size_t views() const { return std::size_t(columns) * std::size_t(rows); }
    /// The mean step from camera to camera along x, or y where there is one column; 0 of a single camera.
    double step() const;
};

/// A folder with views.toml, parameters.cfg (HCI 4D) or names of the Stanford archive, one of these two files itself, or a quilt.
/// Throws InputError that names the file and what is missing or wrong.
ViewsSource find_views(const std::filesystem::path&);

/// Pictures, depth maps and cameras in reversed order; what was pseudoscopic is then orthoscopic.
void flip(ViewsSource&);

/// Columns, rows and aspect in the name of a quilt: NAME_qs8x6a0.75. Nothing if there are none.
struct QuiltName {
    int columns, rows;
    double aspect;
};
std::optional<QuiltName> quilt_name(const std::filesystem::path&);

/// Where the display stands that a grid is placed before.
struct ViewsPlace {
    double panel_width_mm = 0, panel_height_mm = 0;
    double vertex_plane_mm = 0;                // from the panel
    double depth_mm = 0;                       // where content is put by default, from there
    double viewing_distance_mm = 0;            // from the panel; infinity allowed
    std::optional<double> view_cone_deg = {};  // of quilts made for the display: content.view_cone_deg
    // Of a display with such a cone: from lens to lens along the panel's rows, and in what width an elemental image is seen at the
    // viewing distance.
    double lens_mm = 0, zone_width_mm = 0;
};

/// What is asked of a grid's geometry in place of what its files say.
struct ViewsWish {
    std::optional<double> width_mm, depth_mm, distance_mm, cone_deg;
    std::optional<ConeCameras> cone;
    std::optional<std::array<double, 2>> baseline_mm;
};

/// A cone for views that say nothing of theirs, before a display that has none of its own: that of most devices that show quilts.
inline constexpr double usual_cone_deg = 40;

/// The grid before a display. Where nothing else is asked for: the focus is as large as fits the panel (as it is, of lengths
/// for_display) and all lengths are scaled alike; quilts and the Stanford archive, whose distance is not known, get cameras at the
/// viewing distance. A row of views of which nothing is known, before a display with a view cone of its own, is placed as that
/// display shows quilts: view k of n stands where the k-th of n equal parts of the elemental images is seen. `focus_aspect`: width
/// / height. `notes` gets what was assumed, in words. Throws InputError for what is neither known nor asked for, and for impossible
/// grids.
ViewGrid placed(const ViewsSource&, const ViewsWish&, const ViewsPlace&, double focus_aspect, std::vector<std::string>& notes);

/// views.toml for pictures of such a name ("view_*.png"; empty: a quilt's, which has them in its own name), in the order rows from
/// the upper left, and with depth maps of this name if it is not empty. `how` the cameras were placed, for those who read it, may
/// be empty. Reads back as the same grid.
std::string views_toml(const ViewGrid&, const std::string& pictures, const std::string& depth_pictures,
                       const std::string& how = {});

}  // namespace lfdsim
