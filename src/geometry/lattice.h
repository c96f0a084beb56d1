// Where the lenses of an array are. Floor 0, public as a part of geometry.h: plain data; the functions on it are in
// optics/lattice.h, compiled once for each instruction set.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace lfdsim {

struct LensArray;
struct Panel;

/// The lattice of an array's lens axes; lengths in mm (docs/model.md, "Lens array and surround"). The array's frame has x' along
/// its rows and y' along its columns. Lens (i, j), counted from 0 to the right and upwards, has its axis at ((i + 1/2 - nx/2) px,
/// (j + 1/2 - ny/2) py) from the array's middle; staggered rows are shifted by px/4 to the right of that where j is odd and by px/4
/// to the left where it is even. A cell is the rectangle about the axis, or, where lenses are nearest to each other at 60 degrees,
/// the hexagon with corners up and down. Strips are cells without end along y'.
template <class S>
struct Lattice {
    S pitch[2], per_pitch[2], half_pitch[2];  // along x', and from row to row; 1/pitch; pitch/2
    S count[2];                               // lenses along x' and y'
    S offset[2];                              // of the array's middle in the display's frame
    S cos_turn, sin_turn;                     // of the array's frame against the display's, counter-clockwise to the viewer
    bool staggered, hexagonal, strips;        // hexagonal ones are staggered, too
};

/// Returns whether rows alternate by half a pitch (hexagon, brick).
bool is_staggered(const LensArray&);

/// Returns whether the array consists of cylindrical lenses side by side.
bool is_strips(const LensArray&);

/// Returns the number of axes of the array's frame along which the lenses image: strips do so along x' alone.
inline int imaging_axes(const LensArray& array) { return is_strips(array) ? 1 : 2; }

/// Returns whether figures that depend on the pitch differ between the array's x' and y', and are reported for each.
bool differs_by_axis(const LensArray&);

/// Returns the length of strips rotated by `turn_deg`, mm: as long as the panel reaches along them.
double strip_length_mm(const Panel&, double turn_deg);

/// Returns the distance between neighbouring lenses along x' and between rows along y', mm; strips form one row, whose "pitch"
/// along y' is their length over the panel.
std::array<double, 2> spacing_mm(const Panel&, const LensArray&);

/// Returns the least number of lenses along x' and y', about the array's middle, that cover the panel (docs/model.md, "Lens array
/// and surround", "Extent"); of strips {n, 1}.
std::array<std::int64_t, 2> covering_count(const Panel&, const LensArray&);

/// Returns the number of lenses along x' and y': array.count, or the smallest that covers the panel (docs/model.md, "Lens array
/// and surround"). At most 1e10, also for unbounded sizes.
std::array<std::int64_t, 2> lens_count(const Panel&, const LensArray&);

/// Returns the size of the box about all cells along x' and y', mm.
std::array<double, 2> array_size_mm(const Panel&, const LensArray&);

/// Returns the radius of the largest disk within a cell, mm; of strips p/2.
double inner_radius_mm(const LensArray&);
/// Returns the radius of the smallest disk around a cell, mm; of strips p/2.
double outer_radius_mm(const LensArray&);

/// Returns the lattice of a description, without errors. That of strips has one row, half_pitch[1] beyond every panel, and
/// per_pitch[1] 0, so that any finite point lies in row 0.
Lattice<double> make_lattice(const Panel&, const LensArray&);

/// Returns the axis of the display along which eyes see different views of strips, and on which their content is made for eyes: 0,
/// side by side on the line y = 0, or 1, one above the other on x = 0, where strips lie nearer to the horizontal than 15 degrees.
/// Of lenses, whose views differ along both, 0.
inline std::size_t line_of_eyes(const Lattice<double>& l) {
    constexpr double cos_75_deg = 0.2588190451;  // rounded down: content of a rotation of 75 degrees is for eyes side by side
    return l.strips && std::abs(l.cos_turn) < cos_75_deg ? 1 : 0;
}

/// Returns the component x' across strips of a step of 1 along that line, with its sign.
inline double across_strips(const Lattice<double>& l) { return line_of_eyes(l) == 1 ? l.sin_turn : l.cos_turn; }

/// Returns the width across strips of a width of 1 along that line; 1 for lenses.
inline double across_share(const Lattice<double>& l) { return l.strips ? std::abs(across_strips(l)) : 1; }

/// Returns why figures along the other axis are missing for strips.
inline const char* same_from_both_sides(const Lattice<double>& l) {
    return line_of_eyes(l) == 1 ? "strips that lie flat show the same from the left and from the right"
                                : "strips show the same from above and from below";
}

}  // namespace lfdsim
