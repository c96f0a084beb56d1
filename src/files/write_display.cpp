#include <fmt/format.h>

#include "files/display_file.h"
#include "files/values.h"

namespace lfdsim {
namespace {

template <class T>
void write_keys(const Table<T>& table, const T& values, LensType type, std::string& text) {
    for (const Key<T>& key : table.keys) {
        if (!knows(key.lens_types, type)) continue;
        // an absent optional has no text, and a key without text is left out
        const std::string value = std::visit([&](auto member) { return toml_text(values.*member); }, key.member);
        if (!value.empty()) text += fmt::format("{} = {}\n", key.name, value);
    }
}

}  // namespace

std::string write_display(const Display& display) {
    std::string text = "schema = 1\n";
    const LensType type = display.lens.type;
    write_keys(display_table, display, type, text);
    visit_tables(display, [&]<class T, class Values>(const Table<T>& table, const Values& values) {
        // the diffuser alone may be absent
        if constexpr (std::is_same_v<Values, T>) {
            text += fmt::format("\n[{}]\n", table.name);
            write_keys(table, values, type, text);
        } else if (values) {
            text += fmt::format("\n[{}]\n", table.name);
            write_keys(table, *values, type, text);
        }
        if constexpr (std::is_same_v<T, Lens>) {
            for (const Surface& surface : values.surfaces) {
                text += fmt::format("\n[[{}]]\n", surface_table.name);
                write_keys(surface_table, surface, type, text);
            }
        }
    });
    return text;
}

}  // namespace lfdsim
