// Errors of single lenses as a table: a CSV file with one lens a line. Floor 2.
#pragma once
#include "display/display.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace lfdsim {

/// Reads errors.table of a display: the header `i,j,dx_mm,dy_mm,dz_mm,tilt_x_deg,tilt_y_deg,curvature`, in any order of columns,
/// then a line for each lens. Throws InputError with the line of what is wrong: columns that are missing or unknown, words that are
/// no finite numbers, lenses that the array does not have or that stand there twice, and motions that strips cannot make. At most
/// 1 GiB.
std::shared_ptr<const std::vector<GivenLensError>> read_lens_table(const std::filesystem::path&, const Display&);

/// The errors of all lenses of a valid display, drawn and given together, as such a table: read back, the same bits.
std::string write_lens_table(const Display&);

}  // namespace lfdsim
