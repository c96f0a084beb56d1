#include "cli/random_light.h"

#include "analysis/subject.h"
#include "model/lens_errors.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace lfdsim::cli {
namespace {

constexpr int sample_side = 16, samples_along = 4;

/// Evenly spread over a frame. As many pixels in its middle where it is small, or where each picture takes time to begin.
std::vector<Rect> sample_squares(const Rect& frame, bool one) {
    constexpr int whole = samples_along * sample_side;
    const int width = frame.x1 - frame.x0, height = frame.y1 - frame.y0;
    if (one || std::min(width, height) < whole) {
        const int across = std::min(width, whole), up = std::min(height, whole), x = frame.x0 + (width - across) / 2,
                  y = frame.y0 + (height - up) / 2;
        return {{x, y, x + across, y + up}};
    }
    std::vector<Rect> squares;
    for (int j = 0; j < samples_along; ++j)
        for (int i = 0; i < samples_along; ++i) {
            const int x = frame.x0 + (2 * i + 1) * width / (2 * samples_along) - sample_side / 2,
                      y = frame.y0 + (2 * j + 1) * height / (2 * samples_along) - sample_side / 2;
            squares.push_back({x, y, x + sample_side, y + sample_side});
        }
    return squares;
}

}  // namespace

std::optional<RandomLight> random_light(const Display& display, const Geometry& geometry, const SummedPanel& panel,
                                        const Rendering& r, RenderOptions options, const Job& whole) {
    const Rect frame = options.crop.value_or(Rect{0, 0, r.image.width, r.image.height});
    Display other = display;
    other.render.seed ^= 1;  // stays within its range
    Quiet job(whole);
    std::int64_t lit = 0, changed = 0;
    double squares = 0;
    for (const Rect& square : sample_squares(frame, lenses_differ(display.errors))) {
        options.crop = square;
        const Rendering again = render(other, geometry, panel, options, job);
        if (!again.complete) return {};
        for (int y = square.y0; y < square.y1; ++y)
            for (int x = square.x0; x < square.x1; ++x) {
                const float* const first = r.image.at(x - frame.x0, y - frame.y0);
                const float* const second = again.image.at(x - square.x0, y - square.y0);
                double difference = 0, light = 0;
                for (int c = 0; c < 3; ++c) {
                    difference += (double(first[c]) - second[c]) * (double(first[c]) - second[c]);
                    light += double(first[c]) + second[c];
                }
                lit += light > 0;
                changed += difference > 0;
                squares += difference;
            }
    }
    if (lit == 0) return {};
    // Two independent pictures differ by the root of 2 times the noise of each.
    return RandomLight{double(changed) / double(lit), std::sqrt(squares / (2 * 3 * double(lit)))};
}

std::string words_of(const RandomLight& random) {
    if (random.share < 0.005) return {};
    return fmt::format("{:.0f} % of pixels by random rays of their own: noise {:.2g}", 100 * random.share, random.noise_rms);
}

Json json_of(const RandomLight& random) { return {{"share", random.share}, {"noise_rms", random.noise_rms}}; }

}  // namespace lfdsim::cli
