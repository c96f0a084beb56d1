// Light that is more than white can be: most often codes that were taken for light. Floor 0.
#pragma once
#include <cstdint>
#include <string>

namespace lfdsim {

/// What light of 3 values in each `stride` floats is for.
enum class LightOf {
    panel,   // which shows at most 1, its white
    picture  // of a display, whose subpixels and lenses may be some times as bright as its mean white
};
/// What to warn of, after the picture's name; empty: nothing. A picture is doubted where it holds whole numbers only, or more
/// than 16.
std::string above_white(const float* light, std::int64_t pixels, int stride, LightOf);

}  // namespace lfdsim
