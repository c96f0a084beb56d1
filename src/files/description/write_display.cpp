#include <fmt/format.h>

#include "files/description/display_file.h"
#include "files/description/values.h"

namespace lfdsim {

std::string write_display(const Display& display) {
    if (display.content.written_depth_mm) {  // the description that is read back has no other as written: its model gets the depth
        Display whole = display;
        if (whole.content.objects.empty() && !whole.content.depth_mm) whole.content.depth_mm = whole.content.written_depth_mm;
        whole.content.written_depth_mm.reset();
        return write_display(whole);
    }
    std::string text = "schema = 1\n", table;
    visit_all(display, [&](const std::string& path, const KeyInfo& key, ConstValueRef ref, ConstValueRef) {
        // An absent optional has no text, and a key without text is left out.
        const std::string value = std::visit([](const auto* v) { return toml_text(*v); }, ref);
        if (value.empty() || path == "glass_catalogues") return;
        const std::string_view in = table_of_path(path);
        if (in != table) {  // the header of an element ("lens.surface.0") is the list's name in two brackets
            const std::size_t end = in.find_last_not_of("0123456789");
            text += end + 1 == in.size() ? fmt::format("\n[{}]\n", in) : fmt::format("\n[[{}]]\n", in.substr(0, end));
            table = in;
        }
        text += fmt::format("{} = {}\n", key.name, value);
    });
    return text;
}

}  // namespace lfdsim
