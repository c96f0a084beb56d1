// The measure of crosstalk, and crosstalk between views. docs/measures.md, "Crosstalk".

#include "analysis/crosstalk/crosstalk.h"

#include "analysis/crosstalk/crosstalk_eyes.h"
#include "analysis/crosstalk/slope_spread.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace lfdsim {
namespace crosstalk {
namespace {

constexpr const char* definitions[][2] = {
    {"woods_percent",
     "Woods 2012: 100 (leak - black) / (signal - black). Signal: the intended view is white, all others black; leak: the reverse."},
    {"iec_62629_22_1_percent",
     "IEC 62629-22-1: 100 times the sum over all other views i of (L_i - L_black), over L_intended - L_black; one view at a time "
     "is white."},
    {"idms_percent",
     "IDMS (SID), chapter 17: 100 (L_KW - L_KK) / (L_WK - L_KK), first letter the intended view, second the others; W white, K "
     "black."}};

/// The crosstalk of the innermost view, seen from its middle, measured and by theory.
struct Middle {
    Crosstalk measured, theory;
};

/// The crosstalk of several views, each seen from its middle; undefined if there are none.
struct ViewsCrosstalk {
    std::vector<double> view{0};               // the views' middles, in steps
    std::vector<Crosstalk> all{{}}, next{{}};  // by all other views together, and by one neighbour (the mean of both)
    Crosstalk worst;
    std::size_t innermost = 0, worst_at = 0;
    Middle middle, middle_of_other;

    /// Returns the number of the view below which a share of all views lies, in the order of their crosstalk: 0.5 the median, 1
    /// the worst. NaN, where there is no light, counts as the worst.
    std::size_t ranked(double share) const {
        std::vector<std::size_t> order(all.size());
        std::iota(order.begin(), order.end(), std::size_t(0));
        const auto rank = [&](std::size_t n) { return std::isnan(all[n].percent.value) ? infinity : all[n].percent.value; };
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
        return order[std::size_t(share * double(order.size() - 1))];
    }
};

/// Measures the worst view with other lines of sight: the worst of many noisy figures is too great by chance. The error includes
/// the excess of the choice over the new figure, since another view may be the worst.
Crosstalk measured_anew(const Eyes& eyes, double view, const Crosstalk& chosen) {
    const MeantLight light = eyes.light(eyes.at(view * eyes.view_mm(), Eyes::Lines::anew), eyes.shown);
    Crosstalk anew = crosstalk_of(light, eyes.of_view(light, view));
    anew.percent.error += std::max(chosen.percent.value - anew.percent.value, 0.);
    return anew;
}

/// Returns the innermost view's crosstalk, with content as on `panel`, for an eye that receives `light`, by theory `theory`.
Middle at_middle_view(const Eyes& eyes, const MeantPanel& panel, const MeantLight& light, const MetPlaces& theory) {
    const double view = eyes.views.innermost();
    const MeantLight by_theory = eyes.theory_light(theory, panel);
    return {crosstalk_of(light, eyes.of_view(light, view)), crosstalk_of(by_theory, eyes.of_view(by_theory, view))};
}

/// Measures the crosstalk of at most most_views views, evenly chosen, by an eye in the middle of each in turn; the innermost one
/// with the most lines, and by theory.
ViewsCrosstalk look_at_views(Eyes& eyes) {
    ViewsCrosstalk views;
    views.view = eyes.views.middles(most_views);
    views.all.resize(views.view.size());
    views.next.resize(views.view.size());
    views.innermost = std::size_t(std::find(views.view.begin(), views.view.end(), eyes.views.innermost()) - views.view.begin());
    eyes.parts.run(most_views, [&](int part) {
        const auto n = std::size_t(part);
        if (n >= views.view.size()) return;
        const double k = views.view[n];
        const MetPlaces met = eyes.at(k * eyes.view_mm(), n == views.innermost ? Eyes::Lines::fine : Eyes::Lines::curve);
        const MeantLight light = eyes.light(met, eyes.shown);
        const Leak found = eyes.of_view(light, k);
        const LightPart below = eyes.view(light, k - 1), above = eyes.view(light, k + 1);
        LightPart neighbours{{}, 0.5 * (below.open + above.open)};
        for (std::size_t m = 0; m < neighbours.light.size(); ++m) neighbours.light[m] = 0.5 * (below.light[m] + above.light[m]);
        views.all[n] = crosstalk_of(light, found);
        views.next[n] = crosstalk_of(neighbours, found.signal, light.missed());
        if (n != views.innermost) return;
        const MetPlaces theory = eyes.theory_at(k * eyes.view_mm(), Eyes::Lines::fine);
        views.middle = at_middle_view(eyes, eyes.shown, light, theory);
        if (eyes.other) views.middle_of_other = at_middle_view(eyes, *eyes.other, eyes.light(met, *eyes.other), theory);
    });
    views.worst_at = views.ranked(1);
    views.worst = views.all[views.worst_at];
    eyes.parts.run(1, [&](int) {
        if (views.view.size() > 1) views.worst = measured_anew(eyes, views.view[views.worst_at], views.worst);
    });
    return views;
}

/// Adds the figures of the innermost view, for content as described and for the other sampling. `none`: why figures are missing.
void add_middle(const Eyes& eyes, const ViewsCrosstalk& views, ContentSampling sampling, const char* none, Result& result) {
    const auto line = [&](const std::string& label, const Middle& found) {
        return FigureLine{.label = label,
                          .unit = "%",
                          .theory = theory_figure(found.theory, none),
                          .remark = "all other views together, relative to the intended one; the panel's black is 0"};
    };
    const Middle &middle = views.middle, &of_other = views.middle_of_other;
    for (const auto& [name, formula] : definitions)
        result.add(std::string("between_views.") + name, figure_of(middle.measured, none));
    result.add("between_views.theory_percent", theory_figure(middle.theory, none));
    const std::string of = eyes.other ? fmt::format("; {}", made_for(sampling)) : "";
    result.add_line(figure_of(middle.measured, none),
                    line("Crosstalk between views, for the innermost view: by Woods, IEC 62629-22-1 and IDMS alike" + of, middle));
    if (!eyes.other) return;
    result.figures["between_views"]["other_sampling"]["sampling"] = name_of(*eyes.other_sampling);
    result.add("between_views.other_sampling.woods_percent", figure_of(of_other.measured, none),
               line(fmt::format("The same; {}", made_for(*eyes.other_sampling)), of_other));
    result.add("between_views.other_sampling.theory_percent", theory_figure(of_other.theory, none));
}

/// Adds the crosstalk between views: figures, and a table of all views.
void between_views(const Subject& s, Eyes& eyes, Result& result) {
    Json& json = result.figures["between_views"];
    json["view_step_mm"] = eyes.view_mm();
    json["view_step_deg"] = s.theory(0).view_step_deg;
    json["whole_views"] = eyes.views.count();
    json["innermost_view"] = eyes.views.innermost();
    const bool any = eyes.views.count() > 0;
    const ViewsCrosstalk views = any ? look_at_views(eyes) : ViewsCrosstalk();
    const char* const none =
        any ? no_light : "a view is a strip one panel pixel wide, and elemental images are narrower than a pixel";
    const FigureValue middle = figure_of(views.middle.measured, none);
    if (!middle.missing.empty()) result.note("between_views", middle.missing);
    add_middle(eyes, views, s.display().content.sampling, none, result);
    result.add("between_views.next_view_alone_percent", figure_of(views.next[views.innermost], none));
    result.add("between_views.median_view_percent", figure_of(views.all[views.ranked(0.5)], none));
    json["worst_view"] = views.view[views.worst_at];
    result.add("between_views.worst_view_percent", figure_of(views.worst, none));
    DataTable table = DataTable::of_rows("crosstalk_views", {"view", "crosstalk_percent", "next_view_crosstalk_percent"});
    for (std::size_t n = 0; n < views.view.size(); ++n)
        table.add_row({views.view[n], views.all[n].percent.value, views.next[n].percent.value});
    result.tables.push_back(std::move(table));
}

/// Adds curves of the share of each of the innermost views in the light of an eye that moves past them. `spread`: the number of
/// views from which an eye receives light at once.
void curves_of_views(Eyes& eyes, double spread, Result& result) {
    constexpr int shown = 2;
    const double reach = shown + 1 + std::min(spread, 100.);  // in views
    // Eye positions reach one view beyond those shown, and as far as their light spreads.
    std::vector<double> places, theory(places_of_curves);
    for (int n = 0; n < places_of_curves; ++n) places.push_back(eyes.view_mm() * reach * (2. * n / (places_of_curves - 1) - 1));
    const double first = eyes.views.innermost() > 0 ? eyes.views.innermost() - shown : -shown;
    std::vector<std::vector<double>> shares(eyes.views.innermost() > 0 ? 2 * shown : 2 * shown + 1,
                                            std::vector<double>(places.size()));
    const auto share = [&](const MeantLight& light, double view) {
        return total(eyes.view(light, view).light) / total(light.all().light);
    };
    eyes.parts.run(places_of_curves, [&](int part) {
        const auto n = std::size_t(part);
        const MeantLight light = eyes.light(eyes.at(places[n]), eyes.shown);
        for (std::size_t k = 0; k < shares.size(); ++k) shares[k][n] = share(light, first + double(k));
        theory[n] = share(eyes.theory_light(eyes.theory_at(places[n], Eyes::Lines::curve), eyes.shown), eyes.views.innermost());
    });
    const std::string axis = eyes.line == 1 ? "y" : "x";
    Curves curves("crosstalk_views", "Views that an eye sees", "eye position " + axis + ", mm", "share of the light",
                  {axis + "_mm", places});
    curves.table.name = "crosstalk_curves";
    for (std::size_t k = 0; k < shares.size(); ++k)
        curves.add(fmt::format("view {:+g}", first + double(k)), fmt::format("view_{:+g}_share", first + double(k)), shares[k]);
    curves.add(fmt::format("view {:+g}, theory", eyes.views.innermost()),
               fmt::format("view_{:+g}_theory_share", eyes.views.innermost()), std::move(theory));
    result.add(std::move(curves));
}

}  // namespace
}  // namespace crosstalk

std::int64_t crosstalk_steps(const Subject& s) {
    using namespace crosstalk;
    return pictures_worth(
        s, std::int64_t(most_views + places_of_curves + 2 * heads + 2 * limits * halvings) * 2 * lines_a_set * independent_sets);
}

Result measure_crosstalk(Subject& s, Job& job) {
    using namespace crosstalk;
    Eyes eyes(s, job);
    Result result;
    for (const auto& [name, formula] : definitions) result.figures["definitions"][name] = formula;
    result.figures["viewing_distance_mm"] = s.viewing_distance_mm();
    result.figures["eye_distance_mm"] = s.options().eye_distance_mm;
    result.figures["content_sampling"] = name_of(eyes.other ? s.display().content.sampling : ContentSampling::pixel);
    const double spread = SlopeSpread(s, eyes.eye_mm).width() / eyes.views.step_slope();
    between_views(s, eyes, result);
    curves_of_views(eyes, spread, result);
    between_eyes(s, eyes, result);
    result.remarks.push_back(
        "Crosstalk is 100 (leak - black) / (signal - black) as defined by Woods 2012; with the panel's black at 0 and additive "
        "light the definitions of IEC 62629-22-1 and IDMS give the same value. Luminance is averaged over the screen. A view is a "
        "strip, one panel pixel wide, of every elemental image. It consists of the whole pixels, or subpixels where content is "
        "made for each, whose centres lie in the strip. Only whole views count; the leak is the light of all other views. " +
        std::string(
            eyes.line == 1
                ? "Views lie one above the other, as the strips lie flat, and the eye moves up and down."
                : "For two eyes, the left and right halves of every elemental image are intended for the two eyes of a head in "
                  "front of the screen's middle. Views lie side by side along the panel's rows, as the eyes do, also where "
                  "lenses are rotated or strips slanted."));
    result.remarks.push_back(
        fmt::format("Paraxially an eye receives light of {:.3g} views at once: lens apertures and the diffuser mix neighbouring "
                    "views wherever the central depth plane is not at the eye. A light field display shows depth in this way; a "
                    "display of two views must avoid it. Theory leaves out aberration.",
                    spread));
    return result;
}

}  // namespace lfdsim
