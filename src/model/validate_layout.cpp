#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/keys.h"
#include "model/prescription.h"
#include "model/validate.h"

namespace lfdsim {
namespace {

constexpr double rounding_mm = 1e-9;  // of sums of lengths up to a metre

class Layout {
  public:
    Layout(const Display& display, std::vector<Problem>& found) : d(display), problems(found) {
        for (const std::string_view part : {"panel.", "lens.", "array.", "diffuser.", "camera.", "content."})
            if (std::none_of(found.begin(), found.end(), [&](const Problem& p) { return p.where.starts_with(part); }))
                sound.push_back(part);
    }

    void check() {
        if (!is_sound("lens.") || !is_sound("array.")) return;
        const std::size_t before = problems.size();
        if (d.lens.type == LensType::plano_convex) check_plano_convex();
        check_cell();
        if (problems.size() != before) return;  // a lens that cannot be made has no place
        if (d.lens.type == LensType::surfaces) check_surfaces();
        if (problems.size() != before) return;
        g = resolve_unchecked(d);
        check_heights();
        if (is_sound("panel.")) check_sizes();
        if (d.diffuser && is_sound("diffuser.")) check_diffuser();
        if (is_sound("camera.")) check_camera();
        if (is_sound("content.")) check_content();
    }

  private:
    template <class... Args>
    void add(const char* where, fmt::format_string<Args...> what, Args&&... args) {
        problems.push_back({where, fmt::format(what, std::forward<Args>(args)...)});
    }
    bool is_sound(std::string_view part) const { return std::find(sound.begin(), sound.end(), part) != sound.end(); }

    void check_plano_convex() {
        const double R = d.lens.sphere_radius_mm, r = glass_radius_mm(d.lens, d.array), h = d.lens.cylinder_height_mm;
        const bool corner = d.array.aperture == Aperture::square && r > d.lens.aperture_radius_mm.value_or(0);
        if (R < r)
            add("lens.sphere_radius_mm",
                "R = {} mm is smaller than {} {} mm; the ball must cover the aperture: R of at least {} mm", R,
                corner ? "half the cell's diagonal, pitch/sqrt(2) =" : "the aperture radius r =", r, r);
        else if (const double allowed = 2 * std::sqrt((R - r) * (R + r)); h > allowed)
            add("lens.cylinder_height_mm",
                "h = {} mm, but the ball of R = {} mm would cut the flat face: h of at most 2 sqrt(R^2 - r^2) = {} mm", h, R,
                allowed);
    }

    // Round lenses must not overlap, nor a stop's holes.
    void check_cell() {
        const double p = d.array.pitch_mm, half = p / 2;
        const bool round = d.array.aperture == Aperture::circle;
        double narrowest = round ? half : std::max(half, glass_radius_mm(d.lens, d.array));
        if (d.lens.type == LensType::surfaces) {
            for (std::size_t i = 0; i < d.lens.surfaces.size(); ++i) {
                const double semi = d.lens.surfaces[i].semi_aperture_mm;
                narrowest = std::min(narrowest, semi);
                if (round && semi > half)
                    add(fmt::format("lens.surface.{}.semi_aperture_mm", i).c_str(),
                        "{} mm makes the lens wider than the array's pitch of {} mm; at most {} mm", semi, p, half);
            }
        } else if (round) {
            narrowest = std::min(half, *d.lens.aperture_radius_mm);
            if (*d.lens.aperture_radius_mm > half)
                add("lens.aperture_radius_mm",
                    "r = {} mm makes the lens wider than the array's pitch of {} mm; at most {} mm, or a larger array.pitch_mm",
                    *d.lens.aperture_radius_mm, p, half);
        }
        narrowest = std::min(narrowest, half);
        if (d.lens.stop_radius_mm && *d.lens.stop_radius_mm > narrowest)
            add("lens.stop_radius_mm", "{} mm is wider than the lens, which has a radius of {} mm; make it smaller or leave it out",
                *d.lens.stop_radius_mm, narrowest);
    }

    void check_surfaces() {
        const std::vector<PlacedSurface> surfaces = prescription(d.lens, d.array);
        bool real = true;
        for (std::size_t i = 0; i < surfaces.size(); ++i) {
            const auto [low, high] = sag_range_mm(surfaces[i]);
            if (low >= -longest_mm && high <= longest_mm) continue;
            real = false;
            const double c = surfaces[i].curvature_per_mm, k = surfaces[i].conic;
            const double edge =
                (1 + k) * c * c > 0 ? 1 / (std::sqrt(1 + k) * std::abs(c)) : std::numeric_limits<double>::infinity();
            const std::string where = fmt::format("lens.surface.{}.semi_aperture_mm", i);
            if (surfaces[i].semi_aperture_mm > edge)
                add(where.c_str(), "{} mm, but a curvature of {} per mm and a conic of {} end at {} mm from the axis",
                    surfaces[i].semi_aperture_mm, c, k, edge);
            else
                add(where.c_str(), "the surface leaves all bounds within {} mm of the axis: sag from {} to {} mm",
                    surfaces[i].semi_aperture_mm, low, high);
        }
        for (std::size_t i = 0; real && i + 1 < surfaces.size(); ++i)
            if (const double clear = clearance_mm(surfaces[i], surfaces[i + 1]); !(clear >= -rounding_mm))
                add(fmt::format("lens.surface.{}.distance_mm", i).c_str(),
                    "{} mm lets surfaces {} and {} cross within the aperture; at least {:.6g} mm", d.lens.surfaces[i].distance_mm,
                    i, i + 1, d.lens.surfaces[i].distance_mm - clear);
    }

    void check_heights() {
        if (!(g.gap_mm >= shortest_mm && g.gap_mm <= longest_mm && std::isfinite(g.rear_principal_mm)))
            add("array.base_z_mm", "puts the lens's panel-side principal plane {} mm from the panel; it must be in front of it",
                g.gap_mm);
        else if (!(g.base_z_mm >= -rounding_mm))
            add("array.gap_mm", "{} mm puts the lens's lowest point {:.6g} mm into the panel; at least {:.6g} mm", g.gap_mm,
                -g.base_z_mm, g.gap_mm - g.base_z_mm);
        else if (!(g.top_z_mm <= longest_mm))
            add("lens", "reaches {} mm from the panel, allowed is {} mm", g.top_z_mm, longest_mm);
    }

    void check_sizes() {
        const auto check_size = [&](const char* where, const char* what, double width, double height) {
            if (!(std::max(width, height) <= longest_mm))
                add(where, "make {} of {} x {} mm, allowed is {} mm", what, width, height, longest_mm);
        };
        check_size("panel.pixels", "a panel", g.panel_width_mm, g.panel_height_mm);
        check_size("array.count", "an array", g.array_width_mm, g.array_height_mm);
    }

    void check_diffuser() {
        if (!(*g.diffuser_z_mm > g.top_z_mm))
            add("diffuser.distance_mm",
                "{} mm puts the diffuser inside the lenses, which reach {:.6g} mm above the vertex plane; more than that",
                d.diffuser->distance_mm, g.top_z_mm - g.vertex_plane_mm);
    }

    void check_camera() {
        const Vec3d &eye = d.camera.position_mm, &target = d.camera.target_mm;
        const double across = std::hypot(target[0] - eye[0], target[1] - eye[1]), distance = std::hypot(across, target[2] - eye[2]);
        const double top = std::max(g.top_z_mm, g.diffuser_z_mm.value_or(0));
        // A lens camera's pupil lies across the line of sight: its rim reaches lower than its centre when the camera looks
        // sideways.
        const double rim = d.camera.pupil_diameter_mm.value_or(0) / 2 * across / distance;
        if (!(eye[2] > top))
            add("camera.position_mm", "z = {} mm is inside the display, whose {} {:.6g} mm from the panel; z must be more", eye[2],
                g.diffuser_z_mm ? "diffuser stands" : "lenses end", top);
        else if (!(eye[2] - rim > top))
            add("camera.pupil_diameter_mm",
                "{} mm dips the pupil's rim to z = {:.6g} mm, into the display, which ends {:.6g} mm from the panel; a smaller "
                "pupil, or a "
                "camera further away",
                *d.camera.pupil_diameter_mm, eye[2] - rim, top);
        if (is_sound("panel.") && !positive_length.contains(g.frame_width_mm))
            add("camera.fov_deg", "{} degrees at {} mm from the target make a frame {:.6g} mm wide, allowed is {}",
                d.camera.fov_deg.value_or(0), distance, g.frame_width_mm, positive_length.text());
    }

    void check_content() {
        if (!(d.content.viewing_distance_mm > g.top_z_mm))
            add("content.viewing_distance_mm",
                "{} mm is inside the display, whose lenses end {:.6g} mm from the panel; more than that, or inf",
                d.content.viewing_distance_mm, g.top_z_mm);
    }

    const Display& d;
    std::vector<Problem>& problems;
    std::vector<std::string_view> sound;
    Geometry g{};
};

}  // namespace

void validate_layout(const Display& d, std::vector<Problem>& problems) { Layout(d, problems).check(); }

}  // namespace lfdsim
