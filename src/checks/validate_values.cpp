// Checks of values by themselves: ranges, counts, and keys that exclude or need one another.

#include <cmath>

#include "checks/findings.h"
#include "display/keys.h"
#include "geometry/geometry.h"
#include "geometry/lattice.h"
#include "geometry/vec.h"

namespace lfdsim {
namespace {

// Checks values against the ranges of their keys; of lists each element, under its index. visit_all() calls it with each type of
// value.
class RangeCheck {
  public:
    explicit RangeCheck(Findings& findings) : findings_(findings) {}

    template <class Value>
    void operator()(const std::string& where, const Range& range, const Value& value) {
        if constexpr (std::is_arithmetic_v<Value>)  // words and names have no range
            if (!range.contains(double(value)))
                findings_.add(where, "is {}, allowed is {}", std::isnan(double(value)) ? "nan" : fmt::to_string(value),
                              range.text());
    }
    template <class Value>
    void operator()(const std::string& where, const Range& range, const std::optional<Value>& value) {
        if (value) (*this)(where, range, *value);
    }
    template <class Value, std::size_t n>
    void operator()(const std::string& where, const Range& range, const std::array<Value, n>& values) {
        for (std::size_t i = 0; i < n; ++i) (*this)(fmt::format("{}[{}]", where, i), range, values[i]);
    }
    void operator()(const std::string& where, const Range& range, const Pitch& pitch) {
        if (pitch.is_one()) return (*this)(where, range, pitch[0]);
        (*this)(where, range, static_cast<const std::array<double, 2>&>(pitch));
    }
    void operator()(const std::string& where, const Range& range, const std::vector<double>& values) {
        if (values.size() > max_asphere_terms)
            return findings_.add(where, "has {} coefficients, allowed are {}", values.size(), max_asphere_terms);
        for (std::size_t i = 0; i < values.size(); ++i) (*this)(fmt::format("{}[{}]", where, i), range, values[i]);
    }
    void operator()(const std::string& where, const Range& range, const std::vector<Vec3d>& points) {
        for (std::size_t i = 0; i < points.size(); ++i) (*this)(fmt::format("{}[{}]", where, i), range, points[i]);
    }

  private:
    Findings& findings_;
};

void check_surface_count(const SurfaceLens& lens, Findings& findings) {
    if (lens.surfaces.empty() && findings.sound("lens.surface"))
        findings.add("lens.surface", "a lens of type \"surfaces\" needs at least one [[lens.surface]]");
    if (lens.surfaces.size() > max_surfaces) findings.add("lens.surface", "has more than the {} surfaces allowed", max_surfaces);
}

// Refuses products of 2^31 and more, the tracer's limit. The product of two int64 may overflow; in double it does not, and its 53
// bits are exact up to there.
void check_product(const std::string& where, const std::array<std::int64_t, 2>& n, Findings& findings) {
    const double product = double(n[0]) * double(n[1]);
    if (findings.sound(where) && product >= two_to_31)
        findings.add(where, "{} x {} = {:.0f}, allowed is a product below 2^31 = {:.0f}", n[0], n[1], product, two_to_31);
}

// Rays between lenses need one glass body with two surfaces per lens: a thin lens has no body, and the tracer does not follow
// rays between compound ones.
void check_surround(const Display& d, Findings& findings) {
    if (d.array.surround == Surround::opaque || !findings.sound("array.surround")) return;
    const std::string_view surround = word(d.array.surround);
    if (d.lens.is_thin())
        findings.add("array.surround", "is \"{}\", but a lens of type \"{}\" has no glass; take \"opaque\"", surround,
                     word(d.lens.kind));
    const auto* lens = std::get_if<SurfaceLens>(&d.lens.kind);
    if (!lens) return;
    const std::vector<Surface>& surfaces = lens->surfaces;
    if (surfaces.size() != 2)
        findings.add("array.surround",
                     "is \"{}\", which takes one glass body of two surfaces, but the lens has {}; take \"opaque\"", surround,
                     surfaces.size());
    else if (d.array.surround == Surround::clear && d.array.aperture == Aperture::circle &&
             surfaces[0].semi_aperture_mm != surfaces[1].semi_aperture_mm)
        findings.add("array.surround",
                     "is \"clear\", which needs lens bodies with a cylindrical wall, but the semi-apertures are {} and {} mm; make "
                     "them equal",
                     surfaces[0].semi_aperture_mm, surfaces[1].semi_aperture_mm);
}

// The camera's position and direction, as far as they can be checked without the display's geometry.
void check_view(const Camera& camera, Findings& findings) {
    const Vec3d &eye = camera.position_mm, &target = camera.target_mm, &up = camera.up;
    const Vec3d view = minus(target, eye);
    const double distance = length(view), up_length = length(up);
    if (eye[2] <= 0)
        findings.add("camera.position_mm", "z = {} mm is {} the panel; the camera must be in front of it, at z > 0", eye[2],
                     eye[2] < 0 ? "behind" : "on");
    if (distance < shortest_mm)
        findings.add("camera.target_mm", "is the position of the camera; give another point to look at");
    else if (up_length < shortest_mm)
        findings.add("camera.up", "has the length {} and so no direction; take [0, 1, 0]", up_length);
    // It holds |view x up| = |view| |up| sin(angle): below a microradian single precision cannot resolve the picture's up.
    else if (length(cross(view, up)) <= 1e-6 * distance * up_length)
        findings.add("camera.up",
                     "lies along the line of sight from camera.position_mm to camera.target_mm; take another direction");
}

// Checks the keys of the array that depend on the lattice.
void check_lattice(const LensArray& array, Findings& findings) {
    if (!findings.sound("array.lattice")) return;
    const std::string_view lattice = word(array.lattice);
    if (const Pitch& p = array.pitch_mm; !differs_by_axis(array) && !p.is_one() && findings.sound("array.pitch_mm"))
        findings.add("array.pitch_mm", "is [{}, {}], but array.lattice is \"{}\"; take \"{}\", or give one number", p[0], p[1],
                     lattice, is_staggered(array) ? "brick" : "rectangle");
    if (is_strips(array) && array.count && (*array.count)[1] != 1 && findings.sound("array.count"))
        findings.add("array.count", "is [{}, {}], but strips are one row; give [{}, 1]", (*array.count)[0], (*array.count)[1],
                     (*array.count)[0]);
    if (!array.slant_deg || !findings.sound("array.slant_deg")) return;
    if (!is_strips(array))
        findings.add("array.slant_deg", "is given, but array.lattice is \"{}\"; rotate that lattice by array.rotation_deg",
                     lattice);
    else if (array.rotation_deg != 0 && findings.sound("array.rotation_deg"))
        findings.add("array.slant_deg", "both array.slant_deg and array.rotation_deg given; leave one out");
}

// Checks keys that exclude one another or need one another.
void check_choices(const Display& d, Findings& findings) {
    if (d.array.gap_mm && d.array.base_z_mm && findings.sound("array.base_z_mm"))
        findings.add("array.base_z_mm", "both array.gap_mm and array.base_z_mm given; leave one out");
    if (!d.array.gap_mm && !d.array.base_z_mm && findings.sound("array.gap_mm") && findings.sound("array.base_z_mm"))
        findings.add("array.gap_mm", "is missing; give array.gap_mm, or array.base_z_mm, for the distance of the lenses");
    if (d.camera.frame_width_mm && d.camera.fov_deg && findings.sound("camera.fov_deg"))
        findings.add("camera.fov_deg", "both camera.fov_deg and camera.frame_width_mm given; leave one out");
    if (d.camera.focus_distance_mm && !d.camera.pupil_diameter_mm && findings.sound("camera.focus_distance_mm") &&
        findings.sound("camera.pupil_diameter_mm"))
        findings.add("camera.focus_distance_mm", "a pinhole has no focus; give camera.pupil_diameter_mm too, or leave this out");
}

}  // namespace

void validate_values(const Display& d, Findings& findings) {
    const bool type_known = findings.sound("lens.type");
    RangeCheck check(findings);
    if (const auto* lens = std::get_if<SurfaceLens>(&d.lens.kind); lens && type_known) check_surface_count(*lens, findings);
    visit_all(d, [&](const std::string& where, const KeyInfo& key, ConstValueRef value, ConstValueRef) {
        if (findings.sound(where) && (type_known || !where.starts_with("lens.")))
            std::visit([&](const auto* v) { check(where, key.range, *v); }, value);
    });
    check_product("panel.pixels", d.panel.pixels, findings);
    if (d.array.count || (findings.sound("panel.") && findings.sound("array.")))
        check_product("array.count", lens_count(d.panel, d.array), findings);
    check_product("camera.resolution", d.camera.resolution, findings);
    if (d.panel.layers.size() > max_layers) findings.add("panel.layer", "has more than the {} layers allowed", max_layers);
    check_lattice(d.array, findings);
    check_choices(d, findings);
    if (type_known) check_surround(d, findings);
    if (findings.sound("camera.position_mm") && findings.sound("camera.target_mm") && findings.sound("camera.up"))
        check_view(d.camera, findings);
}

}  // namespace lfdsim
