// Light along any ray, from a grid of views. Floor 2. docs/model.md, "Grids of views".
#pragma once
#include "display/view_grid.h"
#include "image/image.h"

#include <cstdint>
#include <vector>

namespace lfdsim {

/// A picture and ever coarser ones of it, each pixel the mean light of those it covers.
class ViewPyramid {
  public:
    explicit ViewPyramid(Image);
    /// Trilinear: at the place (x, y) in pixels of the finest level, from its upper left corner, filtered over `width` of them (1
    /// or less: bilinear). Beyond the border the border's pixels go on.
    void sample(float x, float y, float width, float light[3]) const;
    int width() const { return levels_.front().width; }
    int height() const { return levels_.front().height; }

  private:
    std::vector<Image> levels_;
};

/// How far points in a view are from the focus: kappa = z/(D - z), z before the focus, D the cameras' distance from it. In the
/// focus's plane a point moves by -kappa for each mm of a camera's. Positive before the focus; -1 at infinity.
struct KappaMap {
    int width = 0, height = 0;
    std::vector<float> kappa;  // row 0 at the top; empty: this view has none

    float at(int column, int row) const { return kappa[std::size_t(row) * std::size_t(width) + std::size_t(column)]; }
};

/// The views of a grid, in its order, with a depth map for each of them, for some or for none.
class LightField {
  public:
    /// The maps have the pictures' order; none, or as many. Throws InputError, which names the number of the view, for pictures
    /// that are not all of one size, for another number of them than cameras, and for impossible grids.
    LightField(ViewGrid, std::vector<Image> views, std::vector<KappaMap> = {});

    /// A line, by where it passes the focus's plane and the cameras', mm from the focus's middle.
    struct FieldLine {
        float focus_x, focus_y, camera_x, camera_y;
    };
    enum class Answer {
        seen,
        beside_focus,   // it passes the focus's plane outside the rectangle (by depth: no view shows the point)
        beside_cameras  // it leaves between no cameras, and by more than half their step beside the outermost
    };
    /// Its light: the views of the four cameras around it, weighted bilinearly. Without depth maps they are read where the line
    /// meets the focus; with them where it meets the scene. A row (or column) of cameras has parallax along it only: across it any
    /// line belongs to it. `width_mm` is the line's width at the height z over the focus: width_per_mm |z - waist_z|.
    /// Anything but `seen` is black.
    struct Width {
        float per_mm, waist_z_mm;
    };
    Answer light(const FieldLine&, const Width&, float light[3]) const;

    const ViewGrid& grid() const { return grid_; }
    bool by_depth() const { return by_depth_; }

  private:
    struct Cell;  // the four cameras around a line
    bool cell_of(const FieldLine&, Cell&) const;
    bool surface(const KappaMap&, const std::array<double, 2>& camera, const FieldLine&, float& kappa) const;
    bool read(std::size_t view, const FieldLine&, float kappa, const Width&, float light[3]) const;

    ViewGrid grid_;
    std::vector<ViewPyramid> views_;
    std::vector<KappaMap> maps_;
    bool by_depth_ = false;
    std::size_t only_map_ = 0;              // the view whose map serves for those without
    float nearest_ = 0, furthest_ = 0;      // kappa of the scene, all maps together
    std::vector<double> column_x_, row_y_;  // means of the cameras' places; row_y_ falls
    float pixels_per_mm_[2];
    float disparity_tolerance_;  // difference of kappa that is one pixel between neighbouring cameras
};

}  // namespace lfdsim
