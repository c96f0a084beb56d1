// Every key of a display description: its name, range, meaning and the field it fills. Floor 0.
//
// One table serves all: validate() takes the ranges from it, the TOML reader and writer the names and types, docs/format.md the
// words. A key's type is that of its field, its default the one of a fresh struct, its unit the end of its name (_mm, _per_mm, _nm,
// _deg).
//
// A new key needs a field in its struct and a row in that struct's table; then docs/format.md is written anew (test
// FormatReference). A field of a type that no key has yet also needs that type in ValuesOf (of Panel, Display and Content: in their
// MemberOf), and overloads of read_value() and toml_text() in files/description/values.h, of type_text() in format_reference.cpp
// and of json_of() in report/folder/description.cpp. A new enumeration needs words<E>(), in the order of its values. A new struct
// needs TableOf<>::table, its name in LFDSIM_STRUCTS_WITH_TABLES, and in has_parts if it contains tables.
#pragma once
#include "display/display.h"

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

namespace lfdsim {

/// An interval of numbers. NaN is in none, infinity only where `high` is infinite.
struct Range {
    double low, high;
    bool low_open = false, high_open = false;
    bool contains(double x) const { return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high); }
    std::string text() const;  // as docs/format.md has it: "0 to below 180", "more than 0 to 1000", "0 or more, or inf"
};

// Nothing in a display is thinner than a nanometre or longer than a kilometre, so no length overflows any sum or product here.
inline constexpr double shortest_mm = 1e-6, longest_mm = 1e6;
inline constexpr Range no_range{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
inline constexpr Range any_length{-longest_mm, longest_mm}, positive_length{shortest_mm, longest_mm}, length_or_zero{0, longest_mm};
inline constexpr double two_to_31 = 2147483648.0,
                        two_to_63 = 9223372036854775808.0;  // what the largest 64-bit integer, 2^63 - 1, rounds to

/// A variant over all types that a value of a description may have; Of<V> is a pointer to a V, or to a member of that type.
template <template <class> class Of>
using ValuesOf =
    std::variant<Of<double>, Of<std::optional<double>>, Of<std::int64_t>, Of<std::optional<std::int64_t>>, Of<std::string>,
                 Of<std::array<double, 2>>, Of<Vec3d>, Of<std::array<std::int64_t, 2>>, Of<std::array<double, 4>>,
                 Of<std::optional<std::array<std::int64_t, 2>>>, Of<std::vector<double>>, Of<Pitch>, Of<Encoding>,
                 Of<std::optional<Vec3d>>, Of<std::optional<Glass>>, Of<std::vector<std::string>>, Of<SubpixelLayout>, Of<Channel>,
                 Of<LensKind>, Of<Facing>, Of<Surround>, Of<LatticeKind>, Of<Aperture>, Of<Profile>, Of<PixelFilter>,
                 Of<ContentSampling>, Of<MadeFor>, Of<PickupKind>, Of<ErrorOf>, Of<std::vector<Vec3d>>, Of<Shading>, Of<Estimator>,
                 Of<Sampling>, Of<Fresnel>>;

/// The member of T that a key fills. Only Display, Panel, SurfaceLens and Content contain tables: one that is always there, one
/// that may be absent, or a list. The keys of a kind are in the same table as the word that names it: [lens] has `type` and the
/// keys of that type.
template <class T>
struct MemberOf {
    template <class V>
    using Of = V T::*;
    using Type = ValuesOf<Of>;
};
template <>
struct MemberOf<Display> {
    using Type = std::variant<std::string Display::*, std::vector<std::string> Display::*, Panel Display::*, Lens Display::*,
                              LensArray Display::*, Errors Display::*, std::optional<Diffuser> Display::*, Camera Display::*,
                              Content Display::*, Render Display::*>;
};
template <>
struct MemberOf<Panel> {
    using Type = std::variant<std::array<std::int64_t, 2> Panel::*, double Panel::*, Vec3d Panel::*, std::optional<Vec3d> Panel::*,
                              Encoding Panel::*, SubpixelLayout Panel::*, std::optional<std::array<std::int64_t, 2>> Panel::*,
                              std::vector<Layer> Panel::*, std::vector<Subpixel> Panel::*>;
};
template <>
struct MemberOf<SurfaceLens> {
    using Type = std::variant<std::vector<Surface> SurfaceLens::*>;
};
template <>
struct MemberOf<Content> {
    using Type = std::variant<std::string Content::*, double Content::*, std::int64_t Content::*, std::optional<double> Content::*,
                              ContentSampling Content::*, MadeFor Content::*, PickupKind Content::*, Inverse Content::*,
                              ContentLight Content::*, std::vector<SceneObject> Content::*>;
};

/// What a text in a description is. By default a text counts as a file's name, which visitors of the viewer may not set.
enum class TextOf { file, label };

/// A row of a table: one key of the struct T.
template <class T>
struct Key {
    std::string_view name;  // with the unit as its end: "distance_mm"
    typename MemberOf<T>::Type member;
    Range range;                   // of a number, or of each in an array; unused for words, texts and tables
    bool required;                 // of a value: it must be given where its table is
    std::string_view doc;          // the meaning, as docs/format.md prints it; empty for a table, whose `doc` says it
    std::string_view absent = {};  // what holds without the key, where the default of the field does not say it
    TextOf text = TextOf::file;    // unused for values that are not texts
};

/// The keys of the struct T, in the order in which they are written.
template <class T>
struct Table {
    std::string_view name;  // the last part of its path, "layer" of [[panel.layer]]; of a kind its word, "ideal"
    std::string_view doc;   // what the table describes
    std::span<const Key<T>> keys;
};

/// The table of a struct that has one.
template <class T>
struct TableOf {
    static const Table<T> table;
};
template <class T>
inline constexpr bool has_table = false;

// clang-format off
#define LFDSIM_STRUCTS_WITH_TABLES(OF) \
    OF(Display) OF(Panel) OF(Layer) OF(Subpixel) OF(Lens) OF(PlanoConvex) OF(SurfaceLens) OF(IdealLens) OF(Pinhole) OF(Surface) \
    OF(LensArray) OF(Errors) OF(Diffuser) OF(Camera) OF(Content) OF(Inverse) OF(ContentLight) OF(SceneObject) OF(Render)
#define LFDSIM_HAS_TABLE(Struct) \
    template <> const Table<Struct> TableOf<Struct>::table; \
    template <> inline constexpr bool has_table<Struct> = true;
// clang-format on
LFDSIM_STRUCTS_WITH_TABLES(LFDSIM_HAS_TABLE)
#undef LFDSIM_HAS_TABLE
#undef LFDSIM_STRUCTS_WITH_TABLES

/// What a field of a struct is: a value, a table, a table that may be absent, a list of tables, or one of several kinds, whose word
/// and keys are in the same table.
enum class PartKind { value, table, optional, list, kinds };

/// The part kind of a field's type, and the struct that has the table.
template <class T>
struct Part {
    using Struct = T;
    static constexpr PartKind is = has_table<T> ? PartKind::table : PartKind::value;
};
template <class T>
struct Part<std::optional<T>> {
    using Struct = T;
    static constexpr PartKind is = has_table<T> ? PartKind::optional : PartKind::value;
};
template <class T>
struct Part<std::vector<T>> {
    using Struct = T;
    static constexpr PartKind is = has_table<T> ? PartKind::list : PartKind::value;
};
template <class... Kinds>
struct Part<std::variant<Kinds...>> {
    static constexpr PartKind is = PartKind::kinds;
};
template <class Field>
inline constexpr PartKind part_kind = Part<std::remove_cvref_t<Field>>::is;

/// Whether a struct has tables or a kind within it. All others have values only; this knowledge saves half a minute of compilation.
template <class T>
inline constexpr bool has_parts = std::is_same_v<T, Display> || std::is_same_v<T, Panel> || std::is_same_v<T, Lens> ||
                                  std::is_same_v<T, SurfaceLens> || std::is_same_v<T, Content>;

/// The table part of a dotted path: "lens.surface.0" of "lens.surface.0.conic", "" of "name".
inline std::string_view table_of_path(std::string_view path) {
    const std::size_t point = path.rfind('.');
    return point == path.npos ? std::string_view() : path.substr(0, point);
}

/// A key's entry in its table, without the type of its struct.
struct KeyInfo {
    std::string_view name;
    Range range;
    bool required;
    std::string_view doc, absent;
    bool names_file;  // its value is the name of a file or a list of such names
};

template <class V>
using PointerTo = V*;
template <class V>
using PointerToConst = const V*;
using ValueRef = ValuesOf<PointerTo>;
using ConstValueRef = ValuesOf<PointerToConst>;

/// Calls visit for each value of a display, in the order of a description, with its path ("lens.surface.0.conic"), its key, and
/// the value that a fresh struct has. Tables and fields that a display lacks are not visited. A kind is visited as the value of
/// its word, then its keys.
void visit_all(const Display&,
               const std::function<void(const std::string& path, const KeyInfo&, ConstValueRef, ConstValueRef fresh)>& visit);
/// Visits all values in the same order; `visit` may change them, except a kind, whose keys follow.
void visit_all(Display&, const std::function<void(const std::string& path, const KeyInfo&, ValueRef)>& visit);

/// A table that a description may have, and its keys that are values, each with the value of a fresh struct.
struct FormatTable {
    std::string path;  // of a kind the path of the table that has its keys; of a list without numbers: "lens.surface"
    std::string_view name, doc;
    PartKind is;  // in the table above it
    struct Value {
        KeyInfo key;
        ConstValueRef fresh;
    };
    std::vector<Value> values;
};
/// Returns the tables of every kind, in the order of a description; the first is the top level, "".
const std::vector<FormatTable>& format_tables();

/// The key at a dotted path ("lens.surface.0.conic"), of any kind, with a fresh value; null if there is none.
const FormatTable::Value* key_at(std::string_view path);

/// Calls visit for each file that a display names, with the dotted path of its key ("content.object.0.image",
/// "glass_catalogues.1").
void visit_files(Display&, const std::function<void(const std::string& path, std::string& file)>& visit);

/// Whether what is set at a dotted path, in whatever form, could change which files a description names: at a key that names
/// one, at a table or list that has such a key, or at an element of one.
bool decides_a_file(std::string_view path);

/// Returns the words of an enumeration in the order of its values, or of a variant of kinds in the order of its alternatives.
template <class E>
std::span<const std::string_view> words();

/// Returns the word of a value, as a description has it.
template <class E>
std::string_view word(const E& value) {
    if constexpr (std::is_enum_v<E>)
        return words<E>()[std::size_t(value)];
    else
        return words<E>()[value.index()];
}

/// Whether a field is written as one of a set of words.
template <class Field>
inline constexpr bool has_words = std::is_enum_v<Field> || part_kind<Field> == PartKind::kinds;

/// Sets the value that words<E>()[index] names; a kind becomes a fresh one of that word.
template <class E>
void set_word(E& value, std::size_t index) {
    if constexpr (std::is_enum_v<E>) {
        value = E(index);
    } else {
        [&]<class... Kinds>(std::variant<Kinds...>& kind) {
            std::size_t k = 0;
            ((k++ == index ? void(kind = Kinds{}) : void()), ...);
        }(value);
    }
}

}  // namespace lfdsim
