// Pictures of cameras that were turned: how the stored pixels lie in the picture that viewers show. Floor 0, public.
#pragma once
#include <cstdint>
#include <cstdio>

namespace lfdsim {

/// Returns how a camera was held, by the Exif data of a JPEG or PNG file (CIPA DC-008, tag Orientation): from 1, upright, to 8; 1
/// where there is no such tag, and for damaged files and other formats. The stream is left at its beginning.
int read_orientation(std::FILE*);

/// The places of a stored picture's pixels in the picture that viewers show, which is columns x rows.
struct Upright {
    std::int64_t columns, rows, stored_columns, stored_rows;
    std::int64_t first, row_step, pixel_step;

    Upright(int orientation, std::int64_t width, std::int64_t height);

    /// Returns the index, row by row, of a stored row's first pixel; each of the others follows after `pixel_step`.
    std::int64_t row(std::int64_t stored) const { return first + stored * row_step; }
    /// Returns as how many of `rows` some of the stored rows count, for progress.
    std::int64_t progress(std::int64_t stored) const { return rows * stored / stored_rows; }
};

}  // namespace lfdsim
