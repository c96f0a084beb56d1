// The order of the parts of advice(), advice on the power and the size of the lenses, and on keys without effect. docs/model.md,
// "Advice".

#include "checks/advice.h"

#include "checks/advice_parts.h"
#include "display/keys.h"
#include "geometry/resolve.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {

std::vector<std::string> advice(const Display& d, const Geometry& g, const Theory& t,
                                const std::optional<Vec3d>& model_half_size_mm) {
    Advised advised{d, g, t, model_half_size_mm};
    advise_on_lenses(advised);
    advise_on_layout(advised);
    advise_on_diffuser(advised);
    advise_on_eye(advised);
    advise_on_scene(advised);
    advise_on_idle_keys(advised);
    return std::move(advised.sentences);
}

namespace {

constexpr double common_index = 1.4918;  // of PMMA

/// Returns the remedy for lenses with almost no power, by the keys that lenses of their type have.
std::string power_remedy(const Display& d, const Geometry& g) {
    if (d.lens.type() == LensType::ideal)
        return fmt::format("Use a shorter focal length, such as the gap (--set lens.focal_length_mm={:.4g})", g.gap_mm);
    if (d.lens.type() != LensType::plano_convex)
        return "Use glass of an index well above 1 between the surfaces, or surfaces that are more curved";
    if (d.lens.as<PlanoConvex>().index.value_or(common_index) < 1.3)
        return fmt::format("Use glass of an index well above 1 (--set lens.index={:g})", common_index);
    return "Use a surface that is more curved (a smaller lens.sphere_radius_mm)";
}

}  // namespace

void advise_on_lenses(Advised& a) {
    const Display& d = a.display;
    const Geometry& g = a.geometry;
    const Theory& t = a.theory;

    // With f = 10 g the panel's image is at 1/L = 1/f - 1/g, L = -g/0.9: virtual, a tenth farther away than the panel itself and
    // hardly larger.
    const bool pinhole = d.lens.type() == LensType::pinhole;
    if (!pinhole && !(std::abs(g.focal_length_mm) < 10 * g.gap_mm))
        a.say(
            "the lenses have almost no power (focal length {:.5g} mm, the panel {:.5g} mm behind them): they form no views, and "
            "the panel itself is visible through them. {}",
            g.focal_length_mm, g.gap_mm, power_remedy(d, g));
    // Beyond a hundred panel heights an image plane is practically at infinity. That is intended where the scene is far away,
    // too, and with strips, which are focused on the panel so that an eye sees one view through each.
    else if (!pinhole && !is_strips(d.array) && !(std::abs(t.central_depth_mm) < 100 * g.panel_height_mm) &&
             !is_sharp(t, g.content_depth_mm + g.vertex_plane_mm - g.rear_principal_mm))
        a.say("the gap is about the focal length ({:.6g} and {:.6g} mm): the central depth plane is at infinity", g.gap_mm,
              g.focal_length_mm);
    if (g.focal_length_mm < 0) a.say("the lens diverges: it forms no real image of the panel at any gap");

    // Advice on the number of views is about the axis along which they are fewest.
    const bool strips = is_strips(d.array);
    const std::size_t few = strips || t.along[0].views <= t.along[1].views ? 0 : 1;
    // Lens k begins k N pixels from the first, and its elemental image k N' from that of the first, N' = p'/a: if neither N nor N'
    // is whole, the views of the last lens are shifted against those of the first by that number's distance from a whole one times
    // the number of lenses.
    const auto images = [&](std::size_t k) { return t.along[k].elemental_pitch_mm / d.panel.pixel_pitch_mm; };
    const auto drift = [&](std::size_t k) {
        const auto from_whole = [](double n) { return std::abs(n - std::round(n)); };
        return std::min(from_whole(t.along[k].views), from_whole(images(k))) * g.lattice.count[k];
    };
    const std::size_t drifts = strips || drift(0) >= drift(1) ? 0 : 1;
    if (t.along[few].views < (strips ? 1.9 : 2))  // a little less than two pixels of a barrier's two views are behind a slit
        a.say(
            "the lenses are {} ({:.4g} of {:.4g} mm): they can show only one view. Use wider lenses (--set array.pitch_mm), or a "
            "panel with smaller pixels (--set panel.pixel_pitch_mm)",
            t.along[few].views < 1 ? "smaller than a panel pixel" : "less than two panel pixels wide", lens_pitch_mm(g, few),
            d.panel.pixel_pitch_mm);
    else if (drift(drifts) > 0.5 && !strips)  // which lean so that their views are not whole numbers
        a.say(
            "a lens covers {:.4f} panel pixels, its elemental image {:.4f}, neither a whole number: across the array this adds "
            "up to {:.4g} pixels",
            t.along[drifts].views, images(drifts), drift(drifts));
}

void advise_on_idle_keys(Advised& a) {
    const Content& content = a.display.content;
    if (a.display.panel.primary_widths_nm && a.display.render.wavelength_samples == 1)
        a.say(
            "panel.primary_widths_nm has no effect: each colour is traced in light of a single wavelength. Trace more of them "
            "(--set render.wavelength_samples=7)");
    if (content.pickup != PickupKind::inverse && !(content.inverse == Inverse{}))
        a.say("[content.inverse] has no effect on the {} pick-up (--set content.pickup=inverse uses it)", word(content.pickup));
    if ((content.pickup == PickupKind::nodal || content.pickup == PickupKind::traced) &&
        content.pickup_rays != Content{}.pickup_rays)
        a.say("content.pickup_rays has no effect on the {} pick-up (--set content.pickup=integrated uses it)",
              word(content.pickup));
}

}  // namespace lfdsim
