#include "model/validate.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "model/keys.h"

namespace lfdsim {
namespace {

class ValueChecks {
  public:
    ValueChecks(const Display& display, std::vector<Problem>& problems)
        : type_(display.lens.type), known_(problems.size()), problems_(problems) {}

    /// False when the key's value could not be read: it has been reported and means nothing.
    bool was_read(std::string_view key) const {
        return std::none_of(problems_.begin(), problems_.begin() + std::ptrdiff_t(known_),
                            [&](const Problem& p) { return p.where == key; });
    }

    template <class T>
    void table(const Table<T>& table, const T& values, const std::string& prefix) {
        for (const Key<T>& key : table.keys) {
            if (!knows(key.lens_types, type_)) continue;
            const std::string where = prefix + std::string(key.name);
            if (was_read(where)) std::visit([&](auto member) { check(where, key.range, values.*member); }, key.member);
        }
    }

    bool sound(std::string_view part) const {
        return std::none_of(problems_.begin(), problems_.end(), [&](const Problem& p) { return p.where.starts_with(part); });
    }

    void add(std::string where, std::string what) { problems_.push_back({std::move(where), std::move(what)}); }

    void product(const std::string& where, const std::array<std::int64_t, 2>& n) {
        const double total = double(n[0]) * double(n[1]);
        if (n[0] >= 1 && n[1] >= 1 && total >= two_to_31)
            add(where, fmt::format("{} x {} = {:.0f}, allowed is a product below 2^31 = 2147483648", n[0], n[1], total));
    }

  private:
    template <class Value>
    void check(const std::string& where, const Range& range, const Value& value) {
        if constexpr (std::is_arithmetic_v<Value>) {
            if (!range.contains(double(value))) add(where, fmt::format("is {}, allowed is {}", value, range.text()));
        }
    }

    void check(const std::string& where, const Range& range, const std::optional<double>& value) {
        if (value) check(where, range, *value);
    }
    template <class Value, std::size_t n>
    void check(const std::string& where, const Range& range, const std::array<Value, n>& values) {
        for (std::size_t i = 0; i < n; ++i) check(fmt::format("{}[{}]", where, i), range, values[i]);
    }
    void check(const std::string& where, const Range& range, const std::vector<double>& values) {
        if (values.size() > max_asphere_terms)
            add(where, fmt::format("has {} coefficients, allowed are {}", values.size(), max_asphere_terms));
        else
            for (std::size_t i = 0; i < values.size(); ++i) check(fmt::format("{}[{}]", where, i), range, values[i]);
    }

    LensType type_;
    std::size_t known_;
    std::vector<Problem>& problems_;
};

void check_lens(const Display& d, ValueChecks& checks) {
    if (!checks.was_read("lens.type")) return;
    checks.table(lens_table, d.lens, "lens.");
    if (d.lens.type == LensType::surfaces) {
        const std::size_t n = d.lens.surfaces.size();
        if (n == 0)
            checks.add("lens.surface", "a lens of type \"surfaces\" needs at least one [[lens.surface]]");
        else if (n > max_surfaces)
            checks.add("lens.surface", fmt::format("{} surfaces, allowed are {}", n, max_surfaces));
        else
            for (std::size_t i = 0; i < n; ++i) checks.table(surface_table, d.lens.surfaces[i], fmt::format("lens.surface.{}.", i));
    } else if (d.array.aperture == Aperture::circle && !d.lens.aperture_radius_mm && checks.was_read("array.aperture") &&
               checks.was_read("lens.aperture_radius_mm")) {
        checks.add("lens.aperture_radius_mm", "is missing; only a lens with array.aperture = \"square\" can do without");
    }
    if (d.array.surround == Surround::opaque) return;
    const std::string_view surround = word(d.array.surround);
    if (d.lens.type == LensType::ideal)
        checks.add("array.surround", fmt::format("is \"{}\", but an ideal lens has no glass; take \"opaque\"", surround));
    else if (d.lens.type == LensType::surfaces && d.lens.surfaces.size() != 2)
        checks.add("array.surround",
                   fmt::format("is \"{}\", which takes a single glass body, two surfaces; the lens has {}; take \"opaque\"",
                               surround, d.lens.surfaces.size()));
}

// Where the camera is and where it looks, as far as the display's solid does not matter.
void check_view(const Camera& camera, ValueChecks& checks) {
    const Vec3d &eye = camera.position_mm, &target = camera.target_mm, &up = camera.up;
    const Vec3d view{target[0] - eye[0], target[1] - eye[1], target[2] - eye[2]};
    const double distance = std::hypot(view[0], view[1], view[2]), up_length = std::hypot(up[0], up[1], up[2]);
    const double cross =
        std::hypot(view[1] * up[2] - view[2] * up[1], view[2] * up[0] - view[0] * up[2], view[0] * up[1] - view[1] * up[0]);
    if (eye[2] <= 0)
        checks.add("camera.position_mm", fmt::format("z = {} mm is {} the panel; the camera must be in front of it, at z > 0",
                                                     eye[2], eye[2] < 0 ? "behind" : "on"));
    if (distance < shortest_mm)
        checks.add("camera.target_mm", "is where the camera is; it must look somewhere");
    else if (up_length < shortest_mm)
        checks.add("camera.up", fmt::format("is no direction, its length is {}; take [0, 1, 0]", up_length));
    else if (cross <= 1e-6 * distance * up_length)
        checks.add("camera.up", "lies along the line of sight from camera.position_mm to camera.target_mm; take another direction");
}

void check_camera(const Camera& camera, ValueChecks& checks) {
    checks.table(camera_table, camera, "camera.");
    if (checks.sound("camera.")) check_view(camera, checks);
    checks.product("camera.resolution", camera.resolution);
    if (camera.frame_width_mm && camera.fov_deg)
        checks.add("camera.fov_deg", "both camera.fov_deg and camera.frame_width_mm given; leave one out");
    if (camera.focus_distance_mm && !camera.pupil_diameter_mm)
        checks.add("camera.focus_distance_mm", "a pinhole has no focus; give camera.pupil_diameter_mm too, or leave this out");
}

}  // namespace

void validate_values(const Display& d, std::vector<Problem>& problems) {
    ValueChecks checks(d, problems);
    checks.table(panel_table, d.panel, "panel.");
    checks.product("panel.pixels", d.panel.pixels);
    check_lens(d, checks);
    checks.table(array_table, d.array, "array.");
    checks.product("array.count", d.array.count);
    if (d.array.gap_mm && d.array.base_z_mm)
        checks.add("array.base_z_mm", "both array.gap_mm and array.base_z_mm given; leave one out");
    if (!d.array.gap_mm && !d.array.base_z_mm && checks.was_read("array.gap_mm") && checks.was_read("array.base_z_mm"))
        checks.add("array.gap_mm", "is missing; give array.gap_mm, or array.base_z_mm, to say where the lenses stand");
    if (d.diffuser) checks.table(diffuser_table, *d.diffuser, "diffuser.");
    check_camera(d.camera, checks);
    checks.table(content_table, d.content, "content.");
    checks.table(render_table, d.render, "render.");
}

std::vector<Problem> validate(const Display& d) {
    std::vector<Problem> problems;
    validate_values(d, problems);
    validate_layout(d, problems);
    return problems;
}

}  // namespace lfdsim
