#include "files/description/commented.h"
#include "files/lenses/import_lens.h"

#include <charconv>

namespace lfdsim {
namespace {

constexpr std::string_view surface_table = "lens.surface.";

/// Returns the place, in the lens file, of the surface that a table describes; empty for other tables.
std::string_view place_of_surface(const Imported& made, std::string_view table) {
    std::size_t i = 0;
    if (!table.starts_with(surface_table)) return {};
    std::from_chars(table.data() + surface_table.size(), table.data() + table.size(), i);
    return made.surfaces[i];
}

}  // namespace

std::string write_imported(const Imported& made, const std::vector<std::string>& catalogues, const std::string& made_by) {
    CommentedText text;
    text.note("{}, as a starting point. Made by: {}", made.what, made_by);
    for (const std::string& note : made.notes) text.note("- {}", note);
    text.key("schema", std::int64_t{1});
    std::string table;
    visit_all(made.display, [&](const std::string& path, const KeyInfo& key, ConstValueRef ref, ConstValueRef fresh) {
        const auto written = [](ConstValueRef value) { return std::visit([](const auto* v) { return toml_text(*v); }, value); };
        const std::string value = path == "glass_catalogues" ? toml_text(catalogues) : written(ref);
        // An absent optional has no text; a value that holds without its key is left out.
        if (value.empty() || (!key.required && value == written(fresh))) return;
        const std::string_view in = table_of_path(path);
        if (in != table) {  // the header of an element ("lens.surface.0") is the list's name in two brackets
            const std::size_t end = in.find_last_not_of("0123456789");
            end + 1 == in.size() ? text.table(in) : text.list(in.substr(0, end));
            if (const std::string_view place = place_of_surface(made, in); !place.empty()) text.note("{}", place);
            table = in;
        }
        text.all += fmt::format("{} = {}\n", key.name, value);
    });
    return text.all;
}

}  // namespace lfdsim
