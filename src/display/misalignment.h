// How the array as built differs from the one that a description asks for: docs/model.md, "Errors". Floor 0, public as a part of
// display.h: plain data.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lfdsim {

/// The misalignment of one lens, in the array's frame: its body is rotated about its viewer-side vertex, about x' and then about
/// y', and moved. Random and given values are both of this form and are added.
struct LensError {
    std::array<double, 2> aside_mm{};  // along x' and y'
    double height_mm = 0;              // towards the viewer
    std::array<double, 2> tilt_deg{};  // about x' and y', right-handed
    double curvature = 0;              // e: every curvature times 1 + e, an ideal lens's f over 1 + e; vertices and asphere stay
    bool operator==(const LensError&) const = default;
};

/// The error of one lens as a table gives it: lens (i, j), counted from 0 to the right and upwards.
struct GivenLensError {
    std::int64_t i = 0, j = 0;
    LensError error;
    bool operator==(const GivenLensError&) const = default;
};

/// The table [errors] of a description.
struct Errors {
    // Errors of the whole array
    std::array<double, 2> shift_mm{};   // along the panel's x and y
    double gap_mm = 0;                  // towards the viewer
    double rotation_deg = 0;            // counter-clockwise as the viewer sees it
    double pitch_ppm = 0;               // lens axes and cells are scaled by 1 + 1e-6 times this; lenses of glass keep their size
    std::array<double, 2> wedge_deg{};  // rotation about the panel's x, then about its y, right-handed
    double bow_mm = 0;                  // height of the array's middle above its corners, falling with the squared distance

    // Errors of each lens: standard deviations of normal distributions, redrawn beyond three of them
    double decenter_sd_mm = 0;  // along x' and y'
    double height_sd_mm = 0;
    double tilt_sd_deg = 0;  // about x' and y'
    double curvature_sd = 0;
    std::int64_t seed = 0;
    std::string table;                                         // CSV file of further errors of single lenses, which are added
    std::shared_ptr<const std::vector<GivenLensError>> given;  // the lines of that file; shared by copies of a display
    bool operator==(const Errors&) const = default;
};

}  // namespace lfdsim
