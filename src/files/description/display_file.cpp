#include "files/description/display_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "base/printable.h"
#include "checks/findings.h"
#include "files/description/nearest.h"
#include "files/description/source.h"
#include "files/description/text_file.h"
#include "files/description/values.h"
#include "files/lenses/glasses.h"
#include "files/lenses/lens_table.h"
#include "geometry/geometry.h"

namespace lfdsim {
namespace {

constexpr std::int64_t known_schema = 1;  // the only version of the format so far

// More than a person fixes at once: a file of another kind in TOML can hold a hundred thousand unknown keys.
constexpr std::size_t most_problems_listed = 50;

// The most elements of any list of tables.
constexpr std::size_t most_elements = std::max({max_surfaces, max_layers, std::size_t(max_subpixels), max_objects});

// Fills a display from a parsed description, by the tables of keys. It continues after a fault: a value that cannot be read keeps
// its default, and its key is passed to validate()'s steps as known to be wrong, so that they check all others and each fault is
// reported once. The faults are then sorted by place.
class DisplayReader {
  public:
    DisplayReader(const Source& s, const std::filesystem::path& f) : source(s), folder(f) {}

    Display read() {
        Display display;
        read_schema();
        read_table(source.root(), "", display, {"schema"});
        visit_files(display, [&](const std::string& path, std::string& file) { place(path, file); });
        look_up_glasses(display);
        read_lens_errors(display);
        judge(display);
        return display;
    }

  private:
    // Adds the fault of a value that is missing or cannot be read: `where` is its key's dotted path, as validate() has it. Where
    // the kind is not known, one fault of a key is enough: kinds share keys.
    void add(std::string where, std::string what) {
        if (any_kind && is_wrong(where)) return;
        faults.push_back({std::move(where), std::move(what)});
    }
    bool is_wrong(std::string_view where) const {
        return std::any_of(faults.begin(), faults.end(), [&](const Problem& p) { return p.where == where; });
    }
    // Adds the fault of a key too many, which does not keep validate() from checking any value.
    void add_superfluous(SourcePosition place, std::string where, std::string what) {
        superfluous.push_back({std::move(place), std::move(where) + ": " + what});
    }

    void read_schema() {
        const toml::node* node = source.root().get("schema");
        if (!node) return add("schema", fmt::format("is missing; the first line of a description is schema = {}", known_schema));
        std::int64_t schema = 0;
        if (std::string fault = read_value(*node, schema); !fault.empty())
            add("schema", std::move(fault));
        else if (schema != known_schema)
            add("schema",
                fmt::format("is {}, allowed is {}; another version of the program wrote or reads this file", schema, known_schema));
    }

    // Reads all keys of a table at `prefix` ("lens."), and reports any others in it.
    template <class T>
    void read_table(const toml::table& from, const std::string& prefix, T& values, std::vector<std::string_view> known = {}) {
        add_known<T>(known);
        for (const auto& [key, node] : from)
            if (std::find(known.begin(), known.end(), key.str()) == known.end()) add_unknown(key, prefix, known);
        read_keys(from, prefix, values);
    }

    // Adds the names of a table's keys, including those of all kinds.
    template <class T>
    static void add_known(std::vector<std::string_view>& known) {
        for (const Key<T>& key : TableOf<T>::table.keys) {
            known.push_back(key.name);
            if constexpr (has_parts<T>)
                std::visit(
                    [&]<class Field>(Field T::*) {
                        if constexpr (part_kind<Field> == PartKind::kinds)
                            for_kinds(Field(), [&](auto kind) { add_known<decltype(kind)>(known); });
                    },
                    key.member);
        }
    }

    // Calls act for each kind, with a fresh value of it.
    template <class... Kinds>
    static void for_kinds(const std::variant<Kinds...>&, const auto& act) {
        (act(Kinds{}), ...);
    }

    // Reads the keys of a table. Values are read through pointers of all types, so that read_value_of() is compiled once and not
    // for each struct.
    template <class T>
    void read_keys(const toml::table& from, const std::string& prefix, T& values) {
        for (const Key<T>& key : TableOf<T>::table.keys) {
            const auto value = std::visit(
                [&]<class Field>(Field T::*member) -> std::optional<ValueRef> {
                    if constexpr (part_kind<Field> == PartKind::value) return &(values.*member);
                    return {};
                },
                key.member);
            if (value)
                read_value_of(from.get(key.name), prefix + std::string(key.name), key.required, *value);
            else if constexpr (has_parts<T>)
                std::visit([&](auto member) { read_part(key, from, prefix, values.*member); }, key.member);
        }
    }

    void read_value_of(const toml::node* node, std::string path, bool required, ValueRef value) {
        if (!node) {
            if (required && !any_kind) add(std::move(path), "is missing");
            return;
        }
        std::string fault = std::visit([&](auto* field) { return read_value(*node, *field); }, value);
        // Descriptions that the program writes have empty names of files where there are none.
        if (fault.empty() && source.is_set(path) && has_empty_text(value) && key_at(path)->key.names_file)
            fault = "has an empty text; give the name of a file, or none";
        if (!fault.empty()) add(std::move(path), std::move(fault));
    }

    static bool has_empty_text(ValueRef value) {
        if (const auto* const text = std::get_if<std::string*>(&value)) return (**text).empty();
        const auto* const texts = std::get_if<std::vector<std::string>*>(&value);
        return texts && std::ranges::count(**texts, "") > 0;
    }

    // Reads a field that is a table, by its PartKind.
    template <class T, class Field>
    void read_part(const Key<T>& key, const toml::table& from, const std::string& prefix, Field& field) {
        static const toml::table nothing;  // an absent table is an empty one: required keys are missing, others have defaults
        constexpr PartKind is = part_kind<Field>;
        if constexpr (is == PartKind::kinds) {
            read_kind(key, from, prefix, field);
        } else if constexpr (is != PartKind::value) {
            const std::string path = prefix + std::string(key.name);
            const toml::node* node = from.get(key.name);
            if constexpr (is == PartKind::list) {
                if (node) read_list(*node, path, field);
            } else {
                if (!node && is == PartKind::optional) return;
                const toml::table* table = node ? node->as_table() : &nothing;
                if (!table) return add(path, fmt::format("is {}; give a table: [{}]", kind_of(*node), path));
                if constexpr (is == PartKind::optional)
                    read_table(*table, path + ".", field.emplace());
                else
                    read_table(*table, path + ".", field);
            }
        }
    }

    // Reads the word of a kind, which decides which keys of its table have a meaning, and those keys. Without a valid word none can
    // be called missing or meaningless, and values are read as those of any kind.
    template <class T, class Kind>
    void read_kind(const Key<T>& key, const toml::table& from, const std::string& prefix, Kind& field) {
        const toml::node* node = from.get(key.name);
        std::string fault = node ? read_value(*node, field) : "is missing";
        if (fault.empty()) {
            std::visit([&](auto& kind) { read_keys(from, prefix, kind); }, field);
            return refuse_other_kinds(from, prefix, field);
        }
        add(prefix + std::string(key.name), std::move(fault));
        any_kind = true;
        for_kinds(field, [&](auto kind) { read_keys(from, prefix, kind); });
        any_kind = false;
    }

    // Refuses keys of other kinds that the kind read does not have, each once.
    template <class Kind>
    void refuse_other_kinds(const toml::table& from, const std::string& prefix, const Kind& field) {
        std::vector<std::string_view> known;
        std::visit([&]<class One>(const One&) { add_known<One>(known); }, field);
        for_kinds(Kind(), [&]<class Other>(const Other&) {
            for (const Key<Other>& key : TableOf<Other>::table.keys) {
                if (!from.contains(key.name) || std::find(known.begin(), known.end(), key.name) != known.end()) continue;
                known.push_back(key.name);
                const bool list =
                    has_parts<Other> &&
                    std::visit([]<class Field>(Field Other::*) { return part_kind<Field> == PartKind::list; }, key.member);
                const std::string path = prefix + std::string(key.name);
                add_superfluous(
                    source.place(path), path,
                    fmt::format("has no meaning for a {} of type \"{}\"; {}leave it out", prefix.substr(0, prefix.size() - 1),
                                word(field), list ? fmt::format("take type = \"{}\", or ", TableOf<Other>::table.name) : ""));
            }
        });
    }

    template <class Element>
    void read_list(const toml::node& node, const std::string& path, std::vector<Element>& list) {
        const toml::array* array = node.as_array();
        if (!array || (!array->empty() && !array->is_array_of_tables()))
            return add(path, fmt::format("is {}; give a list of tables: [[{}]]", kind_of(node), path));
        list.resize(std::min(array->size(), most_elements + 1));  // validate() will refuse one too many
        for (std::size_t i = 0; i < list.size(); ++i) read_table(*(*array)[i].as_table(), fmt::format("{}.{}.", path, i), list[i]);
    }

    void add_unknown(const toml::key& key, const std::string& prefix, const std::vector<std::string_view>& known) {
        const std::string where = prefix + shortened(key.str());
        const std::string_view meant = nearest(key.str(), known);
        std::set<std::string> elsewhere;  // the tables that have this key
        for (const FormatTable& table : format_tables())
            if (table.is != PartKind::list && has_key(table, key.str()))
                elsewhere.insert(table.path.empty() ? "the file's beginning, before all tables" : "[" + table.path + "]");
        add_superfluous(source.place(key, where), where,
                        elsewhere.empty()
                            ? fmt::format("is unknown; {}", meant.empty() ? fmt::format("known are {}", fmt::join(known, ", "))
                                                                          : fmt::format("did you mean {}?", meant))
                            : fmt::format("is unknown here; it belongs in {}", fmt::join(elsewhere, " or ")));
    }

    static bool has_key(const FormatTable& table, std::string_view name) {
        return std::any_of(table.values.begin(), table.values.end(),
                           [&](const FormatTable::Value& value) { return value.key.name == name; });
    }

    // Makes the name of a file relative to the working directory. A name in the description is relative to the description's
    // folder; one of an override, alone or within a table or list that the override gave, already is.
    void place(std::string_view key, std::string& path) const {
        if (folder.empty() || path.empty() || path.starts_with("built-in:")) return;
        for (; !key.empty(); key = table_of_path(key))
            if (source.is_set(key)) return;
        path = (folder / path).lexically_normal().string();
    }

    // Reads the file of errors.table, unless its name or the array is known to be wrong.
    void read_lens_errors(Display& display) {
        constexpr const char* key = "errors.table";
        std::string& file = display.errors.table;
        if (file.empty() || is_wrong(key)) return;
        // The table names lenses by their numbers, so these keys must be known.
        for (const char* needed : {"panel.pixels", "panel.pixel_pitch_mm", "array.pitch_mm", "array.count", "array.lattice"})
            if (is_wrong(needed)) return;
        try {
            display.errors.given = read_lens_table(file, display);
        } catch (const InputError& error) {
            for (const Problem& p : error.problems) add(key, fmt::format("{}: {}", p.where, p.what));
        }
    }

    std::vector<GlassCatalogue> read_catalogues(const std::vector<std::string>& files) {
        constexpr const char* key = "glass_catalogues";
        std::vector<GlassCatalogue> catalogues;
        if (is_wrong(key)) return catalogues;
        if (files.size() > max_catalogues) {
            add(key, fmt::format("has {} files, allowed are {}", files.size(), max_catalogues));
            return catalogues;
        }
        for (const std::string& file : files) {
            try {
                catalogues.push_back(read_agf(file));
            } catch (const InputError& error) {
                for (const Problem& p : error.problems) add(key, fmt::format("{}: {}", p.where, p.what));
            }
        }
        return catalogues;
    }

    // Gives glasses that were given by name their formulas.
    void look_up_glasses(Display& display) {
        const std::vector<GlassCatalogue> catalogues = read_catalogues(display.glass_catalogues);
        visit_all(display, [&](const std::string& path, const KeyInfo&, ValueRef value) {
            auto* const glass = std::get_if<std::optional<Glass>*>(&value);
            if (!glass || !**glass || (**glass)->name.empty() || (**glass)->formula != Formula::unknown) return;
            const std::string& name = (**glass)->name;
            if (const Glass* found = find_glass(name, catalogues))
                **glass = *found;
            else if (!is_wrong("glass_catalogues"))
                add(path, unknown_glass(name, catalogues));
        });
    }

    // Validates the values that could be read, and throws InputError if any fault has been found. Places without a line, of
    // overrides, come first: whoever gives a wrong option should not have to look for it below the faults of the file.
    void judge(const Display& display) {
        Findings findings(faults);
        validate_all(display, findings, !is_wrong("glass_catalogues"));
        std::vector<Located> all = std::move(superfluous);
        for (const Problem& fault : faults)  // the checks write elements as "[2]", and their place is that of the list
            all.push_back(
                {source.place(std::string_view(fault.where).substr(0, fault.where.find('['))), fault.where + ": " + fault.what});
        if (all.empty()) return;
        std::stable_sort(all.begin(), all.end(), [](const Located& a, const Located& b) {
            return std::tie(a.place.line, a.place.column) < std::tie(b.place.line, b.place.column);
        });
        std::vector<Problem> problems;
        for (std::size_t i = 0; i < std::min(all.size(), most_problems_listed); ++i)
            problems.push_back({std::move(all[i].place.text), std::move(all[i].what)});
        if (all.size() > most_problems_listed)
            problems.push_back({"", fmt::format("and {} more", all.size() - most_problems_listed)});
        throw InputError(std::move(problems));
    }

    struct Located {
        SourcePosition place;
        std::string what;
    };

    const Source& source;
    const std::filesystem::path& folder;  // of the file; empty: names of files are left as they are
    bool any_kind = false;                // the word of the kind being read is missing or wrong
    std::vector<Problem> faults;          // of keys that are missing or could not be read, by dotted path
    std::vector<Located> superfluous;
};

/// Returns the depth that a model has by default in the description as written: if it moved with each change of the gap or the
/// lens, a sweep would compare pictures of different scenes. A description that cannot be shown without its overrides has no such
/// depth.
std::optional<double> written_depth_mm(std::string_view text, std::string_view name, const std::filesystem::path& folder) {
    try {
        const Source source(text, name, {});
        Display written = DisplayReader(source, folder).read();
        written.content.depth_mm.reset();
        written.content.objects.clear();
        written.errors = {};  // content is made for the display without them
        return resolve(written).content_depth_mm;
    } catch (const InputError&) {
        return {};
    }
}

}  // namespace

Display parse_display(std::string_view text, std::string_view name, const std::vector<std::string>& overrides,
                      const std::filesystem::path& folder) {
    check_text(text, name);
    const Source source(text, name, overrides);
    Display display = DisplayReader(source, folder).read();
    if (!overrides.empty()) display.content.written_depth_mm = written_depth_mm(text, name, folder);
    return display;
}

Display changed(const Display& display, const std::vector<std::string>& overrides) {
    Display keys = display;
    keys.content.written_depth_mm.reset();
    Display made = parse_display(write_display(keys), "display", overrides);
    if (display.content.written_depth_mm) made.content.written_depth_mm = display.content.written_depth_mm;
    // The text lacks the catalogues, because it has the coefficients of their glasses; later overrides may name glasses of them.
    if (made.glass_catalogues.empty()) made.glass_catalogues = display.glass_catalogues;
    return made;
}

Display read_display(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
    return parse_display(read_text(path), path.string(), overrides, path.parent_path());
}

}  // namespace lfdsim
