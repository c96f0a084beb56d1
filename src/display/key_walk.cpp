// Walks the tree of tables that a description is: the values, files and tables of a display, each with its dotted path.
#include "display/keys.h"

#include <optional>

namespace lfdsim {
namespace {

// A type that has no line here counts as one that can name a file, so that visitors of the viewer cannot set it.
template <class Field>
struct Plain : std::bool_constant<std::is_arithmetic_v<Field> || has_words<Field>> {};
template <class Number>
struct Plain<std::optional<Number>> : Plain<Number> {};
template <class Number>
struct Plain<std::vector<Number>> : Plain<Number> {};
template <class Number, std::size_t n>
struct Plain<std::array<Number, n>> : Plain<Number> {};
template <>
struct Plain<Pitch> : std::true_type {};
template <>
struct Plain<Glass> : std::true_type {};  // a name is looked up in the catalogues, and a table has numbers
/// Whether a value of this type cannot name a file: numbers, words and glasses.
template <class Field>
inline constexpr bool is_plain = Plain<Field>::value;

template <class T>
bool names_file(const Key<T>& key) {
    return key.text == TextOf::file &&
           std::visit([]<class Field>(Field T::*) { return part_kind<Field> == PartKind::value && !is_plain<Field>; }, key.member);
}

template <class T>
KeyInfo info(const Key<T>& key) {
    return {key.name, key.range, key.required, key.doc, key.absent, names_file(key)};
}

/// Returns a struct whose fields have their defaults.
template <class T>
const T& fresh_one() {
    static const T fresh{};
    return fresh;
}

/// Calls visit(key, member) for each key of a table.
template <class T, class Visit>
void each_key(const Visit& visit) {
    for (const Key<T>& key : TableOf<T>::table.keys) std::visit([&](auto member) { visit(key, member); }, key.member);
}

/// The value that a key of a struct fills, and the one that a fresh struct has. What a walk does with them is compiled once for
/// each struct, not for each type that a value may have.
template <class Ref>
struct ValueAndDefault {
    Ref value;
    ConstValueRef fresh;
};
/// Returns the value of a key; nothing if the key is a table.
template <class Ref, class T, class Struct = std::remove_const_t<T>>
std::optional<ValueAndDefault<Ref>> value_of(T& in, const Key<Struct>& key) {
    return std::visit(
        [&](auto member) -> std::optional<ValueAndDefault<Ref>> {
            constexpr PartKind is = part_kind<decltype(in.*member)>;
            if constexpr (is == PartKind::value || is == PartKind::kinds)
                return ValueAndDefault<Ref>{&(in.*member), &(fresh_one<Struct>().*member)};
            else
                return {};
        },
        key.member);
}

// Visits the values of a struct and of its kind, all of which have the same prefix. They come before the tables within it, as TOML
// requires: a key that follows the header of a table belongs to that table.
template <class Ref, class T, class Visit>
void walk_values(T& in, const std::string& prefix, const Visit& visit) {
    using Struct = std::remove_const_t<T>;
    for (const Key<Struct>& key : TableOf<Struct>::table.keys) {
        if (const auto found = value_of<Ref>(in, key)) visit(prefix + std::string(key.name), info(key), found->value, found->fresh);
        if constexpr (has_parts<Struct>)
            std::visit(
                [&]<class Field>(Field Struct::*member) {
                    if constexpr (part_kind<Field> == PartKind::kinds)
                        std::visit([&](auto& kind) { walk_values<Ref>(kind, prefix, visit); }, in.*member);
                },
                key.member);
    }
}

template <class Ref, class T, class Visit>
void walk(T& in, const std::string& prefix, const Visit& visit);

// Visits the tables within a struct: those that the display has, each element of a list under its number, and those of its kind.
template <class Ref, class T, class Visit>
void walk_parts(T& in, const std::string& prefix, const Visit& visit) {
    using Struct = std::remove_const_t<T>;
    each_key<Struct>([&](const Key<Struct>& key, auto member) {
        auto& field = in.*member;
        constexpr PartKind is = part_kind<decltype(field)>;
        const auto path = [&] { return prefix + std::string(key.name) + "."; };
        if constexpr (is == PartKind::table) {
            walk<Ref>(field, path(), visit);
        } else if constexpr (is == PartKind::optional) {
            if (field) walk<Ref>(*field, path(), visit);
        } else if constexpr (is == PartKind::list) {
            for (std::size_t i = 0; i < field.size(); ++i) walk<Ref>(field[i], path() + std::to_string(i) + ".", visit);
        } else if constexpr (is == PartKind::kinds) {
            std::visit(
                [&]<class Kind>(Kind& kind) {
                    if constexpr (has_parts<std::remove_const_t<Kind>>) walk_parts<Ref>(kind, prefix, visit);
                },
                field);
        }
    });
}

template <class Ref, class T, class Visit>
void walk(T& in, const std::string& prefix, const Visit& visit) {
    walk_values<Ref>(in, prefix, visit);
    if constexpr (has_parts<std::remove_const_t<T>>) walk_parts<Ref>(in, prefix, visit);
}

// Adds the table of a struct, then those within it; of a kind, the tables of all its alternatives.
template <class T>
void add_tables(const std::string& path, PartKind is, std::vector<FormatTable>& all) {
    all.push_back({path, TableOf<T>::table.name, TableOf<T>::table.doc, is, {}});
    const std::size_t here = all.size() - 1;
    for (const Key<T>& key : TableOf<T>::table.keys)
        if (const auto found = value_of<ConstValueRef>(fresh_one<T>(), key)) all[here].values.push_back({info(key), found->fresh});
    if constexpr (has_parts<T>)
        each_key<T>([&]<class Field>(const Key<T>& key, Field T::*member) {
            constexpr PartKind part = part_kind<Field>;
            if constexpr (part == PartKind::kinds)
                [&]<class... Kinds>(const std::variant<Kinds...>&) {
                    (add_tables<Kinds>(path, PartKind::kinds, all), ...);
                }(fresh_one<T>().*member);
            else if constexpr (part != PartKind::value)
                add_tables<typename Part<Field>::Struct>((path.empty() ? "" : path + ".") + std::string(key.name), part, all);
        });
}

}  // namespace

void visit_all(const Display& d,
               const std::function<void(const std::string& path, const KeyInfo&, ConstValueRef, ConstValueRef fresh)>& visit) {
    walk<ConstValueRef>(d, "", visit);
}

void visit_all(Display& d, const std::function<void(const std::string& path, const KeyInfo&, ValueRef)>& visit) {
    walk<ValueRef>(d, "",
                   [&](const std::string& path, const KeyInfo& key, ValueRef value, ConstValueRef) { visit(path, key, value); });
}

const std::vector<FormatTable>& format_tables() {
    static const std::vector<FormatTable> tables = [] {
        std::vector<FormatTable> all;
        add_tables<Display>("", PartKind::table, all);
        return all;
    }();
    return tables;
}

const FormatTable::Value* key_at(std::string_view path) {
    const std::string_view name = path.substr(path.rfind('.') + 1), in = table_of_path(path);
    for (const FormatTable& table : format_tables()) {
        // The path of an element, "lens.surface.0", less its point and number is that of the list.
        const std::string_view here = table.is == PartKind::list ? in.substr(0, in.find_last_not_of("0123456789")) : in;
        if (here != table.path) continue;
        for (const FormatTable::Value& value : table.values)
            if (value.key.name == name) return &value;
    }
    return nullptr;
}

void visit_files(Display& d, const std::function<void(const std::string& path, std::string& file)>& visit) {
    visit_all(d, [&](const std::string& path, const KeyInfo& key, ValueRef value) {
        if (!key.names_file) return;
        if (auto* const file = std::get_if<std::string*>(&value)) return visit(path, **file);
        auto& files = *std::get<std::vector<std::string>*>(value);
        for (std::size_t k = 0; k < files.size(); ++k) visit(path + "." + std::to_string(k), files[k]);
    });
}

bool decides_a_file(std::string_view path) {
    std::string key;  // without the numbers of elements, which format_tables() does not have
    for (std::size_t start = 0; start <= path.size();) {
        const std::size_t end = std::min(path.find('.', start), path.size());
        const std::string_view part = path.substr(start, end - start);
        if (part.find_first_not_of("0123456789") != part.npos) key.append(key.empty() ? "" : ".").append(part);
        start = end + 1;
    }
    // Either path may contain the other: what is set at "content" sets all of its keys.
    const auto within = [](std::string_view inner, std::string_view outer) {
        return inner.starts_with(outer) && (inner.size() == outer.size() || inner[outer.size()] == '.');
    };
    for (const FormatTable& table : format_tables())
        for (const FormatTable::Value& value : table.values) {
            const std::string file = (table.path.empty() ? "" : table.path + ".") + std::string(value.key.name);
            if (value.key.names_file && (within(key, file) || within(file, key))) return true;
        }
    return false;
}

}  // namespace lfdsim
