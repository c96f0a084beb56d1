// A picture in linear light. Floor 0, public.
#pragma once
#include <cstddef>
#include <vector>

namespace lfdsim {

/// Linear-light RGB, float32, row 0 at the top; pixel (column i, row j) has its centre at (i + 0.5, j + 0.5).
struct Image {
    int width = 0, height = 0;
    std::vector<float> rgb;  // height x width x 3

    Image() = default;
    Image(int w, int h);  // black; throws std::bad_alloc
    float* at(int column, int row) { return &rgb[(std::size_t(row) * width + column) * 3]; }
    const float* at(int column, int row) const { return &rgb[(std::size_t(row) * width + column) * 3]; }
};

/// A part of a picture.
struct Rect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // columns x0 .. x1-1, rows y0 .. y1-1
};

}  // namespace lfdsim
