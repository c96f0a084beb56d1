#include "analysis/verdicts/verdicts.h"

#include "analysis/verdicts/quick_look.h"
#include "analysis/verdicts/verdict_parts.h"
#include "base/bisection.h"
#include "base/constants.h"
#include "checks/first_order.h"
#include "geometry/lens_misalignment.h"
#include "geometry/resolve.h"
#include "geometry/seen_width.h"
#include "geometry/sharp_range.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <optional>

namespace lfdsim {
namespace {

constexpr double most_mixed_percent = 50;  // between the eyes: a third of the light is wrong
// Between the eyes, and how much of it at least is due to a fault that can be mended: aberration, or errors of assembly
constexpr double most_mended_percent = 15, most_more_percent = 10;
constexpr double most_blur_pixels = 1.5;

/// Returns a depth, mm from the lenses, as text: "12 mm in front of the lenses", or "at infinity".
std::string place(double z) {
    return std::isinf(z) ? "at infinity"
                         : fmt::format("{} mm {} the lenses", digits(std::abs(z)), z < 0 ? "behind" : "in front of");
}

/// The radius of a stop, and the light that it leaves.
struct Stop {
    double radius_mm, light_share;
};

/// Returns the widest stop, down to a fifth of the aperture, with which good(display, radius) holds, to 1/64 of that range; nothing
/// if it does not hold even with the narrowest. The light that a stop leaves is its area's, of strips its width's, share.
template <class Good>
std::optional<Stop> widest_stop(Display d, const Geometry& g, Good good) {
    const auto holds = [&](double radius) {
        d.lens.stop_radius_mm = radius;
        return is_valid(d) && good(d, radius);
    };
    const double all = 0.5 * widest_aperture_mm(g);
    if (!holds(0.2 * all)) return {};
    const double least = bisected(0.2 * all, all, 6, holds).in;
    const double share = least / all;
    return Stop{least, g.lattice.strips ? share : share * share};
}

/// Returns the widest stop with which the light of a point is no wider than the image of a pixel.
std::optional<Stop> stop_against_blur(const Display& d, const Geometry& g) {
    return widest_stop(d, g, [&](const Display&, double radius) {
        const std::optional<LensBlur> b = blur(d, g, radius);
        return b && b->pixels <= 1;
    });
}

/// Returns whether crosstalk is due to aberration, and too much.
bool by_aberration(const TracedAndTheory& percent) {
    return percent.traced > most_mended_percent && percent.traced - percent.theory > most_more_percent;
}

/// Returns the widest stop with which aberration no longer mixes what the eyes see.
std::optional<Stop> stop_against_mixing(const Display& d, const Geometry& g) {
    return widest_stop(d, g, [](const Display& stopped, double) {
        const std::optional<TracedAndTheory> mixed = between_eyes_percent(stopped, resolve(stopped));
        return mixed && !by_aberration(*mixed);
    });
}

std::string stop_remedy(const Display& d, const std::optional<Stop>& stop) {
    // Below thin lenses without aberration it is that of the layers.
    const std::string asphere = d.lens.type() == LensType::plano_convex
                                    ? "a lens with an aspheric surface (lens.type = \"surfaces\")"
                                : d.lens.is_thin() ? "thinner layers on the panel (panel.layer)"
                                                   : "other surfaces";
    if (!stop) return fmt::format("Use weaker or smaller lenses, or {}", asphere);
    return fmt::format(
        "Use {}, or a stop of {:.3g} mm radius (--set lens.stop_radius_mm={:.3g}), which leaves {:.0f} % of the light", asphere,
        stop->radius_mm, stop->radius_mm, 100 * stop->light_share);
}

/// Returns what is wrong with the focus of lenses, and the remedy that focuses them on the panel, f = g: another lens, or another
/// gap if that is possible. So near an eye that it would still see more than `most_mm` of the panel through them, D g/E, they are
/// to image the panel to the eye, 1/f = 1/g + 1/E.
std::string focus_remedy(Display d, const Geometry& g, const Theory& t, double most_mm) {
    const double away = camera_distance_mm(d) - g.rear_principal_mm;
    const bool to_eye = g.clear_aperture_mm[axis_of_eyes(g)] * g.gap_mm / away > most_mm;
    const auto wanted = [&](const Geometry& of) { return to_eye ? 1 / (1 / of.gap_mm + 1 / away) : of.gap_mm; };
    double focal = wanted(g);
    Display other = d;
    auto* const ball = g.focal_length_mm > 0 ? std::get_if<PlanoConvex>(&other.lens.kind) : nullptr;
    if (ball) {
        // f is proportional to the radius; the gap, where it follows from array.base_z_mm, changes with it, but less.
        for (int step = 0; step < 30 && is_valid(other); ++step) {
            const Geometry now = resolve(other);
            focal = wanted(now);
            ball->sphere_radius_mm = to_nanometre(ball->sphere_radius_mm * focal / now.focal_length_mm);
        }
    }
    std::string remedy = fmt::format(
        "They are focused {} (focal length {:.4g} mm, gap {:.4g} mm), not {}. Lenses of a focal length of {:.4g} mm{} would be "
        "focused {}",
        place(t.central_depth_mm), g.focal_length_mm, g.gap_mm, to_eye ? "at the eye" : "on the panel", focal,
        to_eye ? "" : ", the gap,", to_eye ? "there" : "on the panel");
    std::string too_strong;
    if (ball && is_valid(other))
        remedy += fmt::format(": with this glass a radius of {0} mm (lens.sphere_radius_mm = {0})", ball->sphere_radius_mm);
    else if (ball)
        too_strong =
            fmt::format(". Such a focal length takes a radius of {} mm, too small for these lenses", ball->sphere_radius_mm);
    if (d.lens.type() == LensType::ideal) remedy += fmt::format(" (--set lens.focal_length_mm={:.4g})", focal);
    const char* const only = d.array.base_z_mm ? "array.base_z_mm=none " : "";  // either key, not both
    d.array.base_z_mm.reset();
    d.array.gap_mm = g.focal_length_mm;
    if (!to_eye && g.focal_length_mm > 0 && !g.glued && is_valid(d))
        remedy += fmt::format(", as would these at a gap of {0:.4g} mm (--set {1}array.gap_mm={0:.4g})", g.focal_length_mm, only);
    return remedy + too_strong;
}

/// Returns whether an eye sees at most half of an elemental image at once.
bool separates(const SeenAtOnce& seen) { return seen.width_mm.traced <= most_seen_share * seen.image_mm; }
bool separates(const Display& d, const Geometry& g) {
    const std::optional<SeenAtOnce> seen = seen_at_once(d, g);
    return seen && separates(*seen);
}

/// Returns the widest stop with which views separate.
std::optional<Stop> stop_against_overlap(const Display& d, const Geometry& g) {
    return widest_stop(d, g, [](const Display& stopped, double) { return separates(stopped, resolve(stopped)); });
}

/// Returns the remedy for views that a diffuser mixes: an angle smaller by `factor` along the line of the eyes, or by more where
/// part of the light misses the array. In a rotated array both angles mix views, so both are reduced where one is not enough.
std::string weaker_diffuser(Display d, const Geometry& g, double factor) {
    const double cosine = std::abs(g.lattice.cos_turn), sine = std::abs(g.lattice.sin_turn);
    const std::size_t main = g.lattice.strips && cosine < sine ? 1 : 0;
    const std::array<double, 2> given = d.diffuser->angle_deg;
    std::array<double, 2>& angle = d.diffuser->angle_deg;
    angle[main] *= factor;
    const bool both = std::min(cosine, sine) > 1e-9;
    if (both && !separates(d, g)) angle[1 - main] *= factor;
    for (int k = 0; k < 16 && !separates(d, g); ++k) angle[main] *= 0.8, angle[1 - main] *= both ? 0.8 : 1;
    return fmt::format(
        "The diffuser mixes them ({:.4g} x {:.4g} degrees); use a weaker one (--set 'diffuser.angle_deg=[{:.3g}, {:.3g}]')",
        given[0], given[1], angle[0], angle[1]);
}

/// Returns the remedy for views that do not separate, by the first cause that applies: errors of assembly, holes too wide, lenses
/// out of focus, the diffuser, aberration.
std::string separation_remedy(const Display& d, const Geometry& g, const Theory& t, const SeenAtOnce& seen) {
    const double most = most_seen_share * seen.image_mm;
    if (has_errors(d.errors)) {
        const Display meant = without_errors(d);
        if (const std::optional<SeenAtOnce> without = seen_at_once(meant, resolve(meant)); without && separates(*without))
            return fmt::format(
                "Errors of assembly ([errors]) are the cause: without them it sees {:.3g} mm. Align the array better",
                without->width_mm.traced);
    }
    if (d.lens.type() == LensType::pinhole && seen.through_apertures_mm > most) {
        const double e = 1 + g.gap_mm / (camera_distance_mm(d) - g.rear_principal_mm),
                     view = std::min(d.panel.pixel_pitch_mm, most);
        return fmt::format(
            "The holes are too wide. Through holes of {0:.3g} mm radius (--set lens.aperture_radius_mm={0:.3g}) it would see one "
            "panel pixel",
            0.5 * view / e);
    }
    if (seen.through_apertures_mm > most) return focus_remedy(d, g, t, most);
    if (d.diffuser && seen.width_mm.theory > most) {
        const double of_apertures = seen.through_apertures_mm, of_diffuser = seen.width_mm.theory - of_apertures;
        return weaker_diffuser(d, g, std::clamp((0.9 * most - of_apertures) / of_diffuser, 0.05, 1.));
    }
    return "The lenses' aberration is the cause. " + stop_remedy(d, stop_against_overlap(d, g));
}

/// Judges whether views separate at all: an eye must see at most half of an elemental image at once.
std::optional<std::string> on_separation(const Display& d, const Geometry& g, const Theory& t, const SeenAtOnce& seen) {
    if (separates(seen)) return {};
    const bool differ = std::abs(seen.width_mm.traced - seen.width_mm.theory) > 0.05 * seen.image_mm;
    return fmt::format("views do not separate: one eye sees {} of the {:.3g} mm under each lens at once{}. {}",
                       seen.width_mm.theory < seen.image_mm ? fmt::format("{:.3g}", seen.width_mm.theory) : "all", seen.image_mm,
                       differ ? fmt::format(" by paraxial theory, {:.3g} mm as traced", seen.width_mm.traced) : "",
                       separation_remedy(d, g, t, seen));
}

/// Returns crosstalk as text.
std::string percent_text(double percent) {
    return std::isinf(percent) ? "infinite (one eye sees only what the other should see)" : fmt::format("{} %", digits(percent));
}

/// Returns the text on errors of assembly that mix what two eyes should see; nothing if they are not the cause.
std::optional<std::string> on_errors(const Display& d, const TracedAndTheory& mixed, const std::string& eyes) {
    const auto mended = [&](const Display& changed) -> std::optional<double> {
        const std::optional<TracedAndTheory> left =
            is_valid(changed) ? between_eyes_percent(changed, resolve(changed)) : std::nullopt;
        if (!left || mixed.traced - left->traced <= most_more_percent) return {};
        return left->traced;
    };
    const std::optional<double> without = has_errors(d.errors) ? mended(without_errors(d)) : std::nullopt;
    if (!without) return {};
    Display known = d;
    known.content.made_for = MadeFor::built;
    const std::optional<double> if_known = mended(known);
    return fmt::format(
        "errors of assembly ([errors]) mix what {} should see: crosstalk is {}, and {} without them. Align the array "
        "better{}",
        eyes, percent_text(mixed.traced), percent_text(*without),
        if_known ? fmt::format(", or make content for the array as built (--set 'content.made_for=\"built\"'), which "
                               "leaves {}",
                               percent_text(*if_known))
                 : "");
}

/// Judges whether a viewer's eyes see different views.
std::optional<std::string> on_eyes(const Display& d, const Geometry& g, const SeenAtOnce& seen) {
    const double eye = camera_distance_mm(d), apart = usual_eye_separation_mm, zone = zone_before_camera_mm(d, g);
    const std::string eyes = fmt::format("two eyes {:g} mm apart, {:.4g} mm from the panel,", apart, eye);
    const std::string best = fmt::format(
        "only {} mm wide there, and beyond it the lenses show their neighbours' images. Twice the eyes' distance would be best, as "
        "from {} mm on",
        digits(zone), digits(eye * 2 * apart / zone));
    if (zone < apart && eye >= nearest_sight_mm) return fmt::format("{} do not fit into the viewing zone: it is {}", eyes, best);
    const std::optional<TracedAndTheory> mixed = between_eyes_percent(d, g);
    if (!mixed || !(mixed->traced > most_mended_percent)) return {};
    const auto [traced, in_theory] = *mixed;
    if (std::optional<std::string> errors = on_errors(d, *mixed, eyes)) return errors;
    if (by_aberration(*mixed) && in_theory <= most_mixed_percent)
        return fmt::format(
            "the lenses' aberration mixes what {} should see: crosstalk is {}, and {} in theory without aberration. {}", eyes,
            percent_text(traced), percent_text(in_theory), stop_remedy(d, stop_against_mixing(d, g)));
    if (!(traced > most_mixed_percent)) return {};
    const std::string fault = fmt::format("{} see nearly the same: crosstalk is {}, as ", eyes, percent_text(traced));
    // In the middle of the halves of a viewing zone an eye is farthest from what is intended for the other one.
    if (zone < 2 * apart) return fmt::format("{}the viewing zone is {}", fault, best);
    // What an eye sees of the panel at once, in whole pixels, projected through the lens to the eye's distance
    const double to_eye = (eye - g.rear_principal_mm) / g.gap_mm, pixel = d.panel.pixel_pitch_mm * to_eye,
                 wide = seen.width_mm.traced * to_eye + pixel;
    const double nearer = g.rear_principal_mm + (eye - g.rear_principal_mm) * apart / wide;  // there it spreads less
    const std::string remedy = pixel < 0.8 * apart ? fmt::format("lenses and a diffuser that spread light by {:.2g} of the rest",
                                                                 (apart - pixel) / (wide - pixel))
                                                   : "smaller pixels, or a larger gap";
    return fmt::format(
        "{}each lens spreads what one eye should see over {} mm there, {} mm of which are the width of a pixel. Views would "
        "separate {}with {}",
        fault, digits(wide), digits(pixel), nearer >= nearest_sight_mm ? fmt::format("nearer than {} mm, or ", digits(nearer)) : "",
        remedy);
}

/// Judges whether the lenses are nearly as sharp as without aberration.
std::optional<std::string> on_blur(const Display& d, const Geometry& g, const Theory& t) {
    const std::optional<LensBlur> b = blur(d, g);
    if (!b || !(b->pixels > most_blur_pixels)) return {};
    const double eye = camera_distance_mm(d);
    // From a thousand viewing distances on L is practically infinite: the lenses are focused on the panel.
    const double L = std::abs(t.central_depth_mm) > 1000 * eye ? infinity : t.central_depth_mm;
    const auto wide = [&](double pixels) {
        const double slope = pixels * d.panel.pixel_pitch_mm / g.gap_mm;
        return std::isinf(L) ? fmt::format("{:.3g} degrees", std::atan(slope) / degree)
                             : fmt::format("{} mm", digits(slope * std::abs(L)));
    };
    const auto in_words = [&](const SharpRange& range, const char* depths_are, const char* none_is) {
        const bool none = range.behind.empty() && range.in_front.empty();
        return fmt::format("{}{} {}", none ? "" : "depths ", depths_in_words(g, range, eye), none ? none_is : depths_are);
    };
    const std::string sharp =
        std::isnan(b->sharp.near_per_mm)
            ? fmt::format("no depth is sharp (the spot comes nearest to a pixel's image {})", place(depth_mm(b->sharp.best_per_mm)))
            : in_words(range_of_inverse(g, b->sharp.near_per_mm, b->sharp.far_per_mm, eye), "are sharp", "is sharp");
    return fmt::format(
        "spherical aberration blurs the lenses: in the central depth plane, {}, a point of the panel becomes a spot {} wide, most "
        "of its "
        "light {}, where the image of a pixel is {}: {}; without aberration {}. {}",
        place(L), wide(b->full_pixels), wide(b->pixels), wide(1), sharp,
        in_words(sharp_by_pixel(g, t, eye), "would be", "would be"), stop_remedy(d, stop_against_blur(d, g)));
}

}  // namespace

std::vector<std::string> verdicts(const Display& d, const Geometry& g, const Theory& t) {
    std::vector<std::string> all;
    const auto add = [&](std::optional<std::string> verdict) {
        if (verdict) all.push_back(std::move(*verdict));
        return verdict.has_value();
    };
    add(on_borders(d, g));
    const std::optional<SeenAtOnce> seen = seen_at_once(d, g);
    const bool mixed = seen && add(on_separation(d, g, t, *seen));
    if (!mixed) {  // if views do not separate, the faults of eyes and blur follow from that
        if (seen) add(on_eyes(d, g, *seen));
        add(on_blur(d, g, t));
    }
    add(on_colours(d, g, t));
    return all;
}

}  // namespace lfdsim
