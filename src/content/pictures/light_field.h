// The light along any line, from a grid of views. Floor 2. docs/model.md, "Grids of views".
#pragma once
#include "display/view_grid.h"
#include "image/image.h"

#include <vector>

namespace lfdsim {

/// A picture and ever coarser ones, each half as wide and high, whose pixels are means of light.
class ViewPyramid {
  public:
    explicit ViewPyramid(Image);
    /// Returns the light at (x, y), pixels of the finest level from its upper left corner, filtered over `width` of them,
    /// trilinearly (1 or less: bilinearly). Beyond the border the border's pixels continue.
    void sample(float x, float y, float width, float light[3]) const;
    int width() const { return levels_.front().width; }
    int height() const { return levels_.front().height; }

  private:
    std::vector<Image> levels_;
};

/// The distance of a view's points from the focus as kappa = z/(B - z), z the height over the focus, B the cameras' distance from
/// it: in the plane of the focus a point moves by -kappa for each mm of the camera. Positive in front of the focus; -1 at
/// infinity.
struct KappaMap {
    int width = 0, height = 0;
    std::vector<float> kappa;  // row 0 at the top; empty: the view has no map

    float at(int column, int row) const { return kappa[std::size_t(row) * std::size_t(width) + std::size_t(column)]; }
};

/// The views of a grid, in its order, with depth maps for all, some or none of them.
class LightField {
  public:
    /// Views and maps are in the grid's order; there are no maps, or as many as views, some of which may be empty. Throws
    /// InputError, which names the view's number, for pictures of different sizes, for numbers that differ from that of the
    /// cameras, and for impossible grids.
    LightField(ViewGrid, std::vector<Image> views, std::vector<KappaMap> = {});

    /// A line, by the points at which it meets the plane of the focus and that of the cameras, mm from the focus's centre.
    struct FieldLine {
        float focus_x, focus_y, camera_x, camera_y;
    };
    /// Whether the views show a line.
    enum class Answer {
        seen,
        beside_focus,   // it meets the plane of the focus outside of the rectangle (with depth maps: no view shows the point)
        beside_cameras  // it passes more than half a step beside the outermost cameras
    };
    /// The width of a line at the height z over the focus, mm: per_mm |z - waist_z_mm|.
    struct Width {
        float per_mm, waist_z_mm;
    };
    /// Gives the light of a line: the views of the four cameras around it, weighted bilinearly, each read at F + kappa (C - c_k).
    /// Without depth maps kappa is 0; with them it is where the line meets the scene. A row (or column) of cameras has parallax
    /// along it only: across it every line belongs to it. Anything but `seen` is black.
    Answer light(const FieldLine&, const Width&, float light[3]) const;

    const ViewGrid& grid() const { return grid_; }
    /// Returns whether there are depth maps.
    bool by_depth() const { return by_depth_; }

  private:
    struct Cell;  // the four cameras around a line
    /// Finds the four cameras around a line. Returns false beside the outermost ones.
    bool cell_of(const FieldLine&, Cell&) const;
    /// Finds kappa where the line meets the surface that a camera's map describes. Returns false if another surface hides it from
    /// that camera.
    bool surface(const KappaMap&, const std::array<double, 2>& camera, const FieldLine&, float& kappa) const;
    /// Gives a view's light for a line at kappa. Returns false outside of the view.
    bool read(std::size_t view, const FieldLine&, float kappa, const Width&, float light[3]) const;

    ViewGrid grid_;
    std::vector<ViewPyramid> views_;
    std::vector<KappaMap> maps_;
    bool by_depth_ = false;
    std::size_t only_map_ = 0;              // the view, nearest to the middle, whose map serves views that have none
    float nearest_ = 0, furthest_ = 0;      // kappa of the nearest and the farthest point in all maps
    std::vector<double> column_x_, row_y_;  // mean positions of the cameras of each column and row; row_y_ descends
    float pixels_per_mm_[2];                // of a view, in the plane of the focus
    float disparity_tolerance_;             // difference of kappa that moves a point by a pixel between neighbouring cameras
};

}  // namespace lfdsim
