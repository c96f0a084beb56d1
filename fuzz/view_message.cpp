// Any bytes given as a message of the viewer's page: refused with an InputError, or a message whose parts are within their limits
// and whose settings a description takes or refuses. Anything else is a crash.
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "files/description/display_file.h"
#include "view/server/messages.h"

namespace {

constexpr std::string_view description = R"(schema = 1
[panel]
pixels = [64, 64]
pixel_pitch_mm = 0.1
[lens]
type = "ideal"
focal_length_mm = 2
aperture_radius_mm = 0.4
[array]
count = [8, 8]
pitch_mm = 0.8
gap_mm = 2.1
)";

void require(bool holds) {
    if (!holds) std::abort();
}

void check(const lfdsim::view::Wanted& w) {
    require(w.id >= 0 && w.set.size() <= 100);
    for (const double x : w.eye_mm) require(std::abs(x) <= 1e6);
    for (const int n : w.size) require(n >= 16 && n <= 4096);
    require(w.size[0] * w.size[1] <= 3840 * 2160 && w.eye_distance_mm >= 0 && w.eye_distance_mm <= 1000);
    try {
        lfdsim::parse_display(description, "fuzz", w.set);
    } catch (const lfdsim::InputError& error) {
        require(!error.problems.empty());
    }
}

void check(const lfdsim::view::Ask& a) {
    require(a.id >= 0 && a.name.size() <= 1000);
    for (const double x : a.at) require(x >= 0 && x <= 1);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    lfdsim::view::Message message;
    try {
        message = lfdsim::view::parse_message({reinterpret_cast<const char*>(data), size});
    } catch (const lfdsim::InputError& error) {
        require(!error.problems.empty());
        return 0;
    }
    std::visit([](const auto& parsed) { check(parsed); }, message);
    return 0;
}
