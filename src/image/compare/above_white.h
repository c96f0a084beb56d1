// A warning of light above white: most often codes that were saved as light. Floor 0.
#pragma once
#include <cstdint>
#include <string>

namespace lfdsim {

/// What light is of, which decides how bright it may be.
enum class LightOf {
    panel,   // shows at most 1, its white
    picture  // of a display, whose subpixels and lenses may be some times as bright as its mean white
};
/// Returns the warning, to follow the picture's name, or an empty text. `light` has R, G, B at the beginning of each `stride`
/// floats. A panel's light is doubted above 1; a picture's where it also has whole numbers only, or exceeds 16.
std::string above_white(const float* light, std::int64_t pixels, int stride, LightOf);

}  // namespace lfdsim
