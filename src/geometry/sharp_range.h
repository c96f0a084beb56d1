// Which depths are sharp: in front of the lenses, and behind them, as far as the viewer. Floor 0.
#pragma once
#include "geometry/geometry.h"

#include <cstddef>
#include <string>

namespace lfdsim {

/// A range of depths from `low` to `high`, mm from the viewer-side vertex plane, positive in front of it; `low` may be minus
/// infinity. Both are NaN if it is empty.
struct DepthSpan {
    double low, high;
    bool empty() const { return !(low <= high); }
    bool holds(double depth) const { return low <= depth && depth <= high; }
};

/// The sharp depths behind the lenses and in front of them. In front they end at the viewer.
struct SharpRange {
    DepthSpan behind, in_front;
    bool holds(double depth) const { return behind.holds(depth) || in_front.holds(depth); }
};

/// Returns the range of all z with far <= 1/z <= near, z from the rear principal plane towards the viewer; near and far in 1/mm,
/// `eye_mm` from the panel. Where the signs of the two ends differ, the depths go through infinity: they begin at some distance on
/// either side, and the lenses themselves are not among them.
SharpRange range_of_inverse(const Geometry&, double near_per_mm, double far_per_mm, double eye_mm);

/// Returns the range of all z from low to high, mm from the rear principal plane.
SharpRange range_between(const Geometry&, double low_mm, double high_mm, double eye_mm);

/// Returns the depth of field by the pixel: where a lens's spot is no wider than the image of a panel pixel, D |1 - z/L| <= a
/// |z|/g.
SharpRange sharp_by_pixel(const Geometry&, const Theory&, double eye_mm);

/// Returns the axis of the array along which fewer depths are sharp by the lens: that of the smaller p/D, of equal ones that of the
/// wider D. What is sharp along it is sharp along both.
std::size_t tighter_axis(const Geometry&);

/// Returns the depth of field by the lens: where a lens's spot is no wider than the lens pitch, D |1 - z/L| <= p, along both axes.
/// Detail there is as fine as the lens pitch, however fine the pixels are. Contains the lenses, where the spot is D wide.
SharpRange sharp_by_lens(const Geometry&, const Theory&, double eye_mm);

/// Describes a range in words: "from 21.5 to 280 mm in front of the lenses", or for two intervals "from 70 mm behind the lenses
/// to infinity and from 90 mm in front of the lenses to the viewer"; "no depth up to the viewer" for none.
std::string depths_in_words(const Geometry&, const SharpRange&, double eye_mm);

/// Returns the limit of resolution by the lens pitch at a depth z, cycles per mm in that plane (docs/measures.md, "Resolution").
/// Each lens shows a piece of the plane, and from lens to lens the picture jumps by p |1 - z/L|: half a cycle per jump, infinite at
/// L. A lens through which an eye sees less than a pixel, D g |1/E - 1/L| < a, shows one point: half a cycle per lens pitch,
/// projected from the eye, E/(2 p (E - z)). `eye_mm`: from the panel along its normal; `axis`: 0 along x', 1 along y'.
double lens_limit_per_mm(const Display&, const Geometry&, const Theory&, double depth_mm, double eye_mm, std::size_t axis);
/// Returns the limit of resolution by the panel pixels at a depth, cycles per mm: half a cycle per image of a pixel, g/(2 a |z|).
double pixel_limit_per_mm(const Display&, const Geometry&, double depth_mm);

/// Returns the cycles per degree that an eye, `eye_mm` from the panel, sees of cycles per mm at a depth: (E - z) pi/180 times
/// these, by the small-angle approximation, at the middle of the screen.
double cycles_per_degree(const Geometry&, double per_mm, double depth_mm, double eye_mm);

}  // namespace lfdsim
