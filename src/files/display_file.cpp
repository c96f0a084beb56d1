#include "files/display_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <tuple>

#include "files/nearest.h"
#include "files/source.h"
#include "files/text_file.h"
#include "files/values.h"
#include "model/findings.h"
#include "model/geometry.h"

namespace lfdsim {
namespace {

constexpr std::int64_t known_schema = 1;

// More than a person mends in one go: a file of another kind in TOML can hold a hundred thousand unknown keys.
constexpr std::size_t most_problems_told = 50;

// Fills a display from a parsed description, by the tables of keys. It goes on after a fault: a value that cannot be read keeps its
// default, and its key is passed to validate()'s steps as known to be wrong, so that they judge all others and each fault is
// reported once. In the end all are sorted by place.
class DisplayReader {
  public:
    explicit DisplayReader(const Source& s) : source(s) {}

    Display read() {
        Display display;
        read_top_level(display);
        // the lens's type first: it decides which keys of [lens] have a meaning
        if (const toml::node* type = source.root().at_path("lens.type").node())
            lens_type_read = read_value(*type, display.lens.type).empty();
        lens_type = display.lens.type;
        visit_tables(display, [&](const auto& table, auto& values) { read_table(table, values); });
        judge(display);
        return display;
    }

  private:
    // A value that is missing or cannot be read: `where` is its key's dotted path, as validate() has it.
    void add(std::string where, std::string what) { faults.push_back({std::move(where), std::move(what)}); }
    // A key too many; it takes no value away from what validate() may judge.
    void add_superfluous(Place place, std::string where, std::string what) {
        superfluous.push_back({std::move(place), std::move(where) + ": " + what});
    }

    void read_top_level(Display& display) {
        std::vector<std::string_view> known{"schema", display_table.keys[0].name};
        visit_tables(display, [&](const auto& table, const auto&) { known.push_back(table.name); });
        for (const auto& [key, node] : source.root())
            if (std::find(known.begin(), known.end(), key.str()) == known.end()) add_unknown(key, "", known);

        std::int64_t schema = 0;
        if (const toml::node* node = source.root().get("schema")) {
            if (std::string fault = read_value(*node, schema); !fault.empty())
                add("schema", std::move(fault));
            else if (schema != known_schema)
                add("schema", fmt::format("is {}, allowed is {}; another version of the program wrote or reads this file", schema,
                                          known_schema));
        } else {
            add("schema", fmt::format("is missing; the first line of a description is schema = {}", known_schema));
        }
        for (const Key<Display>& key : display_table.keys) read_key(key, source.root(), "", display);
    }

    // A table that a display always has, and one that it may lack.
    template <class T>
    void read_table(const Table<T>& table, T& values) {
        static const toml::table nothing;  // an absent table is an empty one: required keys are missing, others have defaults
        const std::string path(table.name);
        if (const toml::node* node = source.root().get(path); !node)
            read_keys(table, nothing, path, values);
        else if (const toml::table* from = node->as_table())
            read_keys(table, *from, path, values);
        else
            add(path, fmt::format("is {}, wanted is a table: [{}]", kind_of(*node), path));
    }
    void read_table(const Table<Diffuser>& table, std::optional<Diffuser>& values) {
        if (source.root().contains(table.name)) read_table(table, values.emplace());
    }

    template <class T>
    void read_keys(const Table<T>& table, const toml::table& from, const std::string& path, T& values) {
        std::vector<std::string_view> known;
        for (const Key<T>& key : table.keys) known.push_back(key.name);
        if constexpr (std::is_same_v<T, Lens>) known.push_back("surface");
        for (const auto& [key, node] : from)
            if (std::find(known.begin(), known.end(), key.str()) == known.end()) add_unknown(key, path, known);
        for (const Key<T>& key : table.keys) read_key(key, from, path + ".", values);
        if constexpr (std::is_same_v<T, Lens>)
            if (const toml::node* node = from.get("surface")) read_surfaces(*node, values.surfaces);
    }

    template <class T>
    void read_key(const Key<T>& key, const toml::table& from, const std::string& prefix, T& values) {
        const std::string path = prefix + std::string(key.name);
        const toml::node* node = from.get(key.name);
        // Without a lens type no key of [lens] can be called missing or meaningless.
        if (!node) {
            if (key.required && (key.required_for == for_all || (lens_type_read && knows(key.required_for, lens_type))))
                add(path, "is missing");
        } else if (lens_type_read && !knows(key.lens_types, lens_type)) {
            add_superfluous(source.place(path), path,
                            fmt::format("has no meaning for a lens of type \"{}\"; leave it out", word(lens_type)));
        } else if (std::string fault = std::visit([&](auto member) { return read_value(*node, values.*member); }, key.member);
                   !fault.empty()) {
            add(path, std::move(fault));
        }
    }

    void read_surfaces(const toml::node& node, std::vector<Surface>& surfaces) {
        const std::string path(surface_table.name);
        const toml::array* array = node.as_array();
        if (lens_type_read && lens_type != LensType::surfaces)
            return add_superfluous(
                source.place(path), path,
                fmt::format("has no meaning for a lens of type \"{}\"; take type = \"surfaces\", or leave it out",
                            word(lens_type)));
        if (!array || (!array->empty() && !array->is_array_of_tables()))
            return add(path, fmt::format("is {}, wanted is a list of tables: [[{}]]", kind_of(node), path));
        surfaces.resize(std::min(array->size(), max_surfaces + 1));  // validate() will refuse one too many
        for (std::size_t i = 0; i < surfaces.size(); ++i)
            read_keys(surface_table, *(*array)[i].as_table(), fmt::format("{}.{}", path, i), surfaces[i]);
    }

    void add_unknown(const toml::key& key, const std::string& path, const std::vector<std::string_view>& known) {
        const std::string where = path + (path.empty() ? "" : ".") + shortened(key.str());
        const std::string_view meant = nearest(key.str(), known);
        std::string elsewhere;  // the same key, in the table where it belongs
        Display any;
        visit_tables(any, [&](const auto& table, const auto&) {
            for (const auto& other : table.keys)
                if (other.name == key.str()) elsewhere = table.name;
        });
        add_superfluous(source.place(key, where), where,
                        elsewhere.empty()
                            ? fmt::format("is unknown; {}", meant.empty() ? fmt::format("known are {}", fmt::join(known, ", "))
                                                                          : fmt::format("did you mean {}?", meant))
                            : fmt::format("is unknown here; it belongs into [{}]", elsewhere));
    }

    // Adds what is wrong with the values that could be read, and throws if anything is. Places without a line, of overrides, come
    // first: whoever gives a wrong option should not have to look for it below the file's own faults.
    void judge(const Display& display) {
        Findings findings(faults);
        validate_values(display, findings);
        validate_lens(display, findings);
        validate_layout(display, findings);
        std::vector<Located> all = std::move(superfluous);
        for (const Problem& fault : faults)  // an element's place is its list's
            all.push_back(
                {source.place(std::string_view(fault.where).substr(0, fault.where.find('['))), fault.where + ": " + fault.what});
        if (all.empty()) return;
        std::stable_sort(all.begin(), all.end(), [](const Located& a, const Located& b) {
            return std::tie(a.place.line, a.place.column) < std::tie(b.place.line, b.place.column);
        });
        std::vector<Problem> problems;
        for (std::size_t i = 0; i < std::min(all.size(), most_problems_told); ++i)
            problems.push_back({std::move(all[i].place.text), std::move(all[i].what)});
        if (all.size() > most_problems_told) problems.push_back({"", fmt::format("and {} more", all.size() - most_problems_told)});
        throw InputError(std::move(problems));
    }

    struct Located {
        Place place;
        std::string what;
    };

    const Source& source;
    LensType lens_type{};
    bool lens_type_read = false;
    std::vector<Problem> faults;  // of keys that are missing or could not be read, by dotted path
    std::vector<Located> superfluous;
};

}  // namespace

Display parse_display(std::string_view text, std::string_view name, const std::vector<std::string>& overrides) {
    check_text(text, name);
    const Source source(text, name, overrides);
    return DisplayReader(source).read();
}

Display read_display(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
    Display display = parse_display(read_text(path), path.string(), overrides);
    // A path on the command line is relative to where it was typed, one in a file to where the file is.
    const bool overridden =
        std::any_of(overrides.begin(), overrides.end(), [](const std::string& o) { return o.starts_with("content.model="); });
    if (!display.content.model.empty() && !overridden && !display.content.model.starts_with("built-in:"))
        display.content.model = (path.parent_path() / display.content.model).lexically_normal().string();
    return display;
}

}  // namespace lfdsim
