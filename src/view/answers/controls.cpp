#include "view/answers/controls.h"

#include "base/constants.h"
#include "display/keys.h"
#include "engine/scene/traced_display.h"
#include "geometry/dark_bands.h"
#include "geometry/geometry.h"
#include "geometry/lattice.h"
#include "geometry/resolve.h"
#include "report/folder/description.h"
#include "view/answers/slider.h"

#include <fmt/format.h>
#include <cmath>

namespace lfdsim::view {
namespace {

// Other parts of a message decide these, or nothing of the picture depends on them.
constexpr std::string_view left_out[] = {"name", "camera.position_mm", "camera.resolution", "panel.subpixel_cell"};

std::string label(std::string_view key) {
    for (const std::string_view unit : {"_per_mm", "_mm", "_nm", "_deg"})
        if (key.ends_with(unit)) key.remove_suffix(unit.size());
    if (key == "fov") return "field of view";
    std::string words(key);
    std::replace(words.begin(), words.end(), '_', ' ');
    return words;
}

Json control_json(double x) {
    if (std::isfinite(x)) return x;
    return x > 0 ? "infinite" : "-infinite";
}
Json control_json(std::int64_t n) { return n; }
template <class List>
Json control_json(const List& list) {
    Json json = Json::array();
    for (const auto& x : list) json.push_back(control_json(x));
    return json;
}

/// A diffuser that could be put in front of a display that has none, wide enough to close the gaps between lenses.
Diffuser new_diffuser(const Display& d, const Geometry& g) {
    const double distance = rounded(g.top_z_mm - g.vertex_plane_mm + 10 * std::max(g.gap_mm, 1.), 2);
    const auto joining = [&](std::size_t axis) {
        const double height = g.vertex_plane_mm + distance - aperture_plane_mm(d, g, axis);
        return rounded(std::clamp(gap_closing_angle_deg(lens_pitch_mm(g, axis), height), 0.1, 20.), 2);
    };
    return {distance, {joining(0), joining(1)}, Profile::box};
}

/// Values for keys that are absent: what applies without them, or else a starting value.
double suggested(std::string_view path, const Display& d, const Geometry& g) {
    const std::pair<std::string_view, double> all[] = {
        {"lens.aperture_radius_mm", g.glass_radius_mm},
        {"lens.stop_radius_mm", 0.5 * std::min(g.clear_aperture_mm[0], g.clear_aperture_mm[1])},
        {"array.gap_mm", g.gap_mm},
        {"array.base_z_mm", std::max(g.base_z_mm, 0.)},
        {"camera.frame_width_mm", g.frame_width_mm},
        {"camera.fov_deg", 2 * std::atan(0.5 * g.frame_width_mm / g.focus_distance_mm) / degree},
        {"camera.pupil_diameter_mm", usual_pupil_mm},
        {"camera.focus_distance_mm", g.focus_distance_mm},
        {"content.depth_mm", g.content_depth_mm},
        {"content.height_mm", g.content_height_mm.value_or(0.5 * g.panel_height_mm)},
        {"render.samples", double(samples_of(d))},
    };
    for (const auto& [key, value] : all)
        if (key == path) return rounded(value, 6);
    return 1;
}

/// The value at a path, if there is one.
std::optional<ConstValueRef> value_at(const Display& d, std::string_view path) {
    std::optional<ConstValueRef> found;
    visit_all(d, [&](const std::string& here, const KeyInfo&, ConstValueRef value, ConstValueRef) {
        if (here == path) found = value;
    });
    return found;
}

class Lister {
  public:
    Lister(const Display& display, const Display& described)
        : lens_(display.lens), trial_(display), described_(described), geometry_(resolve(described)) {
        if (trial_.diffuser) return;
        no_diffuser_ = true;
        suggested_diffuser_ = new_diffuser(described, geometry_);
    }

    Json list() {
        add_all("");
        if (no_diffuser_) add_diffuser();
        return std::move(list_);
    }

  private:
    void add_all(std::string_view prefix) {
        visit_all(trial_, [&](const std::string& path, const KeyInfo& key, ValueRef value) {
            if (path.starts_with(prefix)) std::visit([&](auto* field) { add_key(path, key, *field); }, value);
        });
    }

    /// Adds a suggested diffuser where there is none, after the preceding table.
    void add_diffuser() {
        Json all = std::exchange(list_, Json::array());
        trial_.diffuser = suggested_diffuser_;
        add_all("diffuser.");
        for (Json& control : list_) control["suggested"] = std::exchange(control["value"], nullptr);
        const auto after =
            std::find_if(all.begin(), all.end(), [](const Json& c) { return c["table"] == TableOf<Camera>::table.name; });
        all.insert(after, list_.begin(), list_.end());
        list_ = std::move(all);
    }

    template <class Field>
    void add_key(const std::string& path, const KeyInfo& key, Field& field) {
        const std::string table(table_of_path(path));
        const bool idle = table == last_surface() && (key.name == "distance_mm" || key.name == "index");  // no surface follows
        if (key.names_file || idle || path.starts_with("content.inverse.") || gives_way(path) || of_no_object(path, field) ||
            std::find(std::begin(left_out), std::end(left_out), path) != std::end(left_out))
            return;
        Json control{{"key", path}, {"table", table}, {"label", label(key.name)}, {"unit", unit_of(std::string(key.name))}};
        auto described = value_at(described_, path);
        if (!described && table == TableOf<Diffuser>::table.name) described = value_at(trial_, path);
        const Field* const* same = described ? std::get_if<const Field*>(&*described) : nullptr;
        add(control, path, key.range, field, same ? *same : nullptr);
        if (!key.absent.empty()) control["absent"] = key.absent;  // such a key may be removed
        control["doc"] = key.doc;
        list_.push_back(std::move(control));
    }

    /// Sizes and colours that an object does not have.
    template <class Field>
    static bool of_no_object(std::string_view path, const Field& field) {
        if (!path.starts_with("content.object.")) return false;
        if constexpr (std::is_same_v<Field, std::optional<double>> || std::is_same_v<Field, std::optional<Vec3d>>)
            return !field.has_value();
        else
            return false;
    }

    /// A medium's glass is shown where it has a name, its index where it has no glass.
    bool gives_way(std::string_view path) const {
        const bool of_glass = path.ends_with(".glass");
        if (!of_glass && !path.ends_with(".index")) return false;
        const auto value = value_at(trial_, std::string(table_of_path(path)) + ".glass");
        const auto& glass = *std::get<const std::optional<Glass>*>(*value);
        return of_glass ? !glass || glass->name.empty() : glass.has_value();
    }

    std::string last_surface() const {
        const auto* lens = std::get_if<SurfaceLens>(&trial_.lens.kind);
        return lens ? fmt::format("lens.surface.{}", lens->surfaces.size() - 1) : "";
    }

    // This takes most of the time, so it is skipped for keys that are limited only by their range.
    bool valid(std::string_view path) const {
        const bool free = (path.starts_with("render.") && path != "render.wavelength_samples") || path == "errors.seed" ||
                          (path.starts_with("content.") && path != "content.viewing_distance_mm" && path != "content.made_for") ||
                          path == "panel.encoding" || path == "panel.emission_exponent" || path == "diffuser.profile";
        return free || validate(trial_).empty();
    }

    /// The slider of a number that put() sets.
    template <class Put>
    Slider slider(const std::string& path, const Range& range, double value, double described, bool whole, Put put) {
        if (std::isinf(value)) value = geometry_.focus_distance_mm;  // the viewing distance: start at the camera's
        if (std::isinf(described)) described = geometry_.focus_distance_mm;
        return valid_part(sensible_ends(path, range, described, described_, geometry_), value, whole, [&](double x) {
            put(x);
            return valid(path);
        });
    }
    static void set_slider(Json& control, const Slider& s, bool whole) {
        const auto number = [&](double x) { return whole ? Json(to<std::int64_t>(x)) : Json(x); };
        control["low"] = number(s.low);
        control["high"] = number(s.high);
        control["step"] = number(s.step);
    }

    template <class Number>
    static Number to(double x) {
        if constexpr (std::is_integral_v<Number>)
            return std::llround(std::clamp(x, -9e18, 9e18));  // seeds go to 2^63
        else
            return x;
    }

    template <class Number>
    requires std::is_arithmetic_v<Number>
    void add(Json& control, const std::string& path, const Range& range, Number& field, const Number* described) {
        constexpr bool whole = std::is_integral_v<Number>;
        const Number value = field;
        control["value"] = control_json(value);
        const Slider s = slider(path, range, double(value), double(described ? *described : value), whole,
                                [&](double x) { field = to<Number>(x); });
        field = value;
        set_slider(control, s, whole);
        control["form"] = whole ? "integer" : "number";
    }

    // A single slider where both pitches are equal by definition; radii follow it.
    void add(Json& control, const std::string& path, const Range& range, Pitch& field, const Pitch* described) {
        using Both = std::array<double, 2>;
        if (differs_by_axis(trial_.array))
            return add(control, path, range, static_cast<Both&>(field), static_cast<const Both*>(described));
        const Pitch value = field;
        control["value"] = control_json(value[0]);
        const Slider s = slider(path, range, value[0], described ? (*described)[0] : value[0], false, [&](double x) {
            field = x;
            lower_limited();
        });
        field = value;
        trial_.lens = lens_;
        control["limits"] = Json::object();
        visit_limited(trial_, [&](const std::string& key, double&) { control["limits"][key] = most_of_pitch; });
        set_slider(control, s, false);
        control["form"] = "number";
    }

    template <class Number>
    void add(Json& control, const std::string& path, const Range& range, std::optional<Number>& field,
             const std::optional<Number>* described) {
        const Number start = to<Number>(suggested(path, described_, geometry_));
        const Number anchor = described && *described ? **described : start;
        add_or_suggest(control, path, range, field, start, &anchor);
    }

    // A count that is not given follows panel and pitch.
    template <class Number>
    void add(Json& control, const std::string& path, const Range& range, std::optional<std::array<Number, 2>>& field,
             const std::optional<std::array<Number, 2>>* described) {
        add_or_suggest(control, path, range, field, lens_count(trial_.panel, trial_.array),
                       described && *described ? &**described : nullptr);
    }

    // A value that is not given is suggested: `start`.
    template <class T>
    void add_or_suggest(Json& control, const std::string& path, const Range& range, std::optional<T>& field, const T& start,
                        const T* described) {
        const bool absent = !field;
        if (absent) field = start;
        add(control, path, range, *field, described);
        if (!absent) return;
        control["suggested"] = std::exchange(control["value"], nullptr);
        field.reset();
    }

    // Each of the two numbers has a separate slider, whose ends are found with the other number fixed.
    template <class Number>
    void add(Json& control, const std::string& path, const Range& range, std::array<Number, 2>& field,
             const std::array<Number, 2>* described) {
        constexpr bool whole = std::is_integral_v<Number>;
        const std::array<Number, 2> value = field;
        control["value"] = control_json(value);
        Slider s[2];
        for (std::size_t k = 0; k < 2; ++k) {
            s[k] = slider(path, range, double(value[k]), double(described ? (*described)[k] : value[k]), whole,
                          [&](double x) { field[k] = to<Number>(x); });
            field = value;
        }
        const double less = double(std::min(value[0], value[1])), more = double(std::max(value[0], value[1]));
        set_slider(control,
                   {std::min(std::max(s[0].low, s[1].low), less), std::max(std::min(s[0].high, s[1].high), more),
                    std::min(s[0].step, s[1].step)},
                   whole);
        control["form"] = "pair";
    }

    template <class List>
    requires std::is_same_v<List, Vec3d> || std::is_same_v<List, std::array<double, 4>> || std::is_same_v<List, std::vector<double>>
    void add(Json& control, const std::string&, const Range&, List& field, const List*) {
        control["value"] = control_json(field);
        control["form"] = "list";
    }

    // The words with which the display stays valid.
    template <class E>
    requires has_words<E>
    void add(Json& control, const std::string& path, const Range&, E& field, const E*) {
        const E value = field;
        control["value"] = word(value);
        control["form"] = "word";
        control["words"] = Json::array();
        const std::size_t here = std::size_t(std::find(words<E>().begin(), words<E>().end(), word(value)) - words<E>().begin());
        for (std::size_t i = 0; i < words<E>().size(); ++i) {
            if (i == here || (set_word(field, i), valid(path))) control["words"].push_back(words<E>()[i]);
        }
        field = value;
    }

    void add(Json& control, const std::string&, const Range&, std::optional<Vec3d>& field, const std::optional<Vec3d>*) {
        control["value"] = field ? control_json(*field) : Json();
        control["form"] = "list";
    }

    // The names that ship, and the one that is given.
    void add(Json& control, const std::string&, const Range&, std::optional<Glass>& field, const std::optional<Glass>*) {
        control["value"] = field->name;
        control["form"] = "word";
        control["words"] = Json::array();
        if (!shipped_glass(field->name)) control["words"].push_back(field->name);
        for (const ShippedGlass& shipped : shipped_glasses()) control["words"].push_back(shipped.glass.name);
    }

    // Names of files (content.model, glass_catalogues, content.inverse.start) have no control.
    void add(Json&, const std::string&, const Range&, std::string&, const std::string*) {}
    void add(Json&, const std::string&, const Range&, std::vector<std::string>&, const std::vector<std::string>*) {}
    // Lists of points (content.inverse.eyes_mm) have no control.
    void add(Json&, const std::string&, const Range&, std::vector<Vec3d>&, const std::vector<Vec3d>*) {}

    /// Radii that are limited to half the pitch. They shrink with the pitch, which could otherwise not be reduced.
    template <class Visit>
    static void visit_limited(Display& d, const Visit& visit) {
        if (d.array.aperture == Aperture::circle)
            visit_all(d, [&](const std::string& path, const KeyInfo&, ValueRef value) {
                if (path == "lens.aperture_radius_mm") {
                    auto* const may_be_absent = std::get_if<std::optional<double>*>(&value);
                    if (!may_be_absent) visit(path, *std::get<double*>(value));
                    if (may_be_absent && **may_be_absent) visit(path, ***may_be_absent);
                }
                if (path.ends_with(".semi_aperture_mm")) visit(path, *std::get<double*>(value));
            });
        if (d.lens.stop_radius_mm) visit("lens.stop_radius_mm", *d.lens.stop_radius_mm);
    }
    static constexpr double most_of_pitch = 0.5;

    void lower_limited() {
        trial_.lens = lens_;
        visit_limited(trial_, [&](const std::string&, double& radius) {
            radius = std::min(radius, most_of_pitch * trial_.array.pitch_mm.least());
        });
    }

    const Lens lens_;
    Display trial_;
    const Display& described_;
    const Geometry geometry_;
    bool no_diffuser_ = false;
    Diffuser suggested_diffuser_;
    Json list_ = Json::array();
};

}  // namespace

Json controls(const Display& display, const Display& described) { return Lister(display, described).list(); }

}  // namespace lfdsim::view
