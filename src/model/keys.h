// Every key of a display description: its name, range, meaning and the field it fills. Floor 0.
//
// One table serves all: validate() takes the ranges from it, the TOML reader and writer the names and types, docs/format.md the
// words. A key's type is that of its field, its default the one of a fresh struct, its unit the end of its name.
#pragma once
#include "model/display.h"

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
    std::string text() const;  // "0 <= x < 180" with "x" left out: "0 or more, below 180"
};

// Nothing in a display is thinner than a nanometre or longer than a kilometre, so no length overflows any sum or product here.
inline constexpr double shortest_mm = 1e-6, longest_mm = 1e6;
inline constexpr Range any_length{-longest_mm, longest_mm}, positive_length{shortest_mm, longest_mm}, length_or_zero{0, longest_mm};
inline constexpr double two_to_31 = 2147483648.0;

template <class T>
using Member =
    std::variant<double T::*, std::optional<double> T::*, std::int64_t T::*, std::optional<std::int64_t> T::*, std::string T::*,
                 std::array<double, 2> T::*, Vec3d T::*, std::array<std::int64_t, 2> T::*, std::vector<double> T::*, Pitch T::*,
                 Encoding T::*, LensType T::*, Facing T::*, Surround T::*, LatticeKind T::*, Aperture T::*, Profile T::*,
                 PixelFilter T::*, Estimator T::*, Sampling T::*, Fresnel T::*>;

// The types of lens that a key belongs to.
inline constexpr unsigned for_plano_convex = 1u << unsigned(LensType::plano_convex),
                          for_surfaces = 1u << unsigned(LensType::surfaces), for_ideal = 1u << unsigned(LensType::ideal),
                          for_all = for_plano_convex | for_surfaces | for_ideal;

template <class T>
struct Key {
    std::string_view name;
    Member<T> member;
    Range range;  // of a number or of each in an array; unused for words
    bool required;
    std::string_view doc;
    std::string_view absent = {};     // what holds without the key, where the field's own default does not say it
    unsigned lens_types = for_all;    // the lens types that know the key
    unsigned required_for = for_all;  // those that need it, if `required`
};

template <class T>
struct Table {
    std::string_view name;
    std::string_view doc;
    std::span<const Key<T>> keys;
};

extern const Table<Display> display_table;  // the keys before the first [table]
extern const Table<Panel> panel_table;
extern const Table<Lens> lens_table;
extern const Table<Surface> surface_table;  // [[lens.surface]]
extern const Table<LensArray> array_table;
extern const Table<Diffuser> diffuser_table;
extern const Table<Camera> camera_table;
extern const Table<Content> content_table;
extern const Table<Render> render_table;

/// Calls visit(table, its values) for the tables of a display, in the order of a description. The diffuser's values are optional.
/// display_table and surface_table are not among them: they are the frame of the whole and a part of [lens].
template <class Visit>
void visit_tables(auto& display, Visit&& visit) {
    visit(panel_table, display.panel);
    visit(lens_table, display.lens);
    visit(array_table, display.array);
    visit(diffuser_table, display.diffuser);
    visit(camera_table, display.camera);
    visit(content_table, display.content);
    visit(render_table, display.render);
}

/// Words of an enumeration, in the order of its values.
template <class E>
std::span<const std::string_view> words();

template <class E>
std::string_view word(E value) {
    return words<E>()[std::size_t(value)];
}

inline bool knows(unsigned lens_types, LensType type) { return lens_types >> unsigned(type) & 1u; }

}  // namespace lfdsim
