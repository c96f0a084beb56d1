// Errors of single lenses as a table: a CSV file with one lens a line. Floor 2.
#pragma once
#include "display/display.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace lfdsim {

/// Reads errors.table of a display, sorted by row and column of lenses: the header
/// `i,j,dx_mm,dy_mm,dz_mm,tilt_x_deg,tilt_y_deg,curvature`, in any order of columns, then a line for each lens. Throws InputError
/// with the line of what is wrong: columns that are missing or unknown, words that are not finite numbers, lenses that the array
/// does not have or that are listed twice, and motions that strips cannot make. A file has at most 1 GiB.
std::shared_ptr<const std::vector<GivenLensError>> read_lens_table(const std::filesystem::path&, const Display&);

/// Returns the errors of all lenses of a valid display, random and given ones added up, as a table that reads back as the same
/// bits.
std::string write_lens_table(const Display&);

}  // namespace lfdsim
