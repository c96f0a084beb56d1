// Any bytes given as a display description: refused with an InputError, or a display that resolves, has a theory, and writes out to
// a text that reads back the same. Anything else is a crash.
#include <cstdlib>
#include <string_view>

#include "files/description/display_file.h"
#include "geometry/geometry.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    using namespace lfdsim;
    std::string_view text(reinterpret_cast<const char*>(data), size);
    // What follows a form feed, which no TOML holds, is an override.
    std::vector<std::string> overrides;
    if (const std::size_t end = text.find('\f'); end != text.npos) {
        overrides.emplace_back(text.substr(end + 1));
        text = text.substr(0, end);
    }
    Display display;
    try {
        display = parse_display(text, "fuzz", overrides);
    } catch (const InputError& error) {
        if (error.problems.empty()) std::abort();
        return 0;
    }
    theory(display, resolve(display));
    if (parse_display(write_display(display), "written") != display) std::abort();
    return 0;
}
