#include "analysis/crosstalk.h"

#include "analysis/meant_light.h"
#include "analysis/meant_theory.h"
#include "analysis/parallel.h"
#include "analysis/pixel_views.h"
#include "analysis/rules.h"
#include "analysis/slope_spread.h"
#include "model/numbers.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

// What one eye sees of neighbouring views, and of what the other eye should see. docs/model.md, "Crosstalk".
namespace lfdsim {
namespace {

constexpr int lines_a_set = 512, fine_lines_a_set = 16384, lines_of_theory = 8192;  // and as many mirrored
constexpr int most_views = 61, places_of_curves = 97, heads = 61, halvings = 3;
constexpr double tolerable_percent = 10;  // of the head's range

constexpr const char* definitions[][2] = {
    {"woods_percent",
     "Woods 2012: 100 (leak - black) / (signal - black). Signal: the view that is meant is white, all others black; leak: the "
     "other way round."},
    {"iec_62629_22_1_percent",
     "IEC 62629-22-1: 100 times the sum over all other views i of (L_i - L_black), over L_meant - L_black; each view is white "
     "alone in turn."},
    {"idms_percent",
     "IDMS (SID), chapter 17: 100 (L_KW - L_KK) / (L_WK - L_KK), first letter the view that is meant, second the others; W white, "
     "K "
     "black."}};

const char* name_of(ContentSampling sampling) { return sampling == ContentSampling::subpixel ? "subpixel" : "pixel"; }
const char* made_for(ContentSampling sampling) {
    return sampling == ContentSampling::subpixel ? "content for each subpixel" : "content for whole pixels";
}

/// A view's light, or an eye's, and that which it should not see.
struct Leak {
    Sums signal, leak;
};

/// Whether many lines of sight end where it is dark, or where a colour shines that is dim.
bool structured(const Subject& s) { return !shines_all_over(s.display().panel); }

/// One eye level with the screen's middle, at the viewing distance.
class Eyes {
  public:
    Eyes(Subject& s, Job& job)
        : distance_(checked_viewing_distance_mm(s)),
          eye_mm(distance_ - s.geometry().rear_principal_mm),
          shown(s.display(), s.geometry(), s.display().content.sampling),
          pixels_(s.display(), s.geometry(), ContentSampling::pixel),
          views(s, pixels_),
          parts(job, s.threads(), most_views + 1 + places_of_curves + heads + 6, crosstalk_steps(s)),
          paths_(s.display(), s.geometry()),
          theory_(s, distance_),
          more_(paths_.more_for({0, 0, distance_})),
          lines_(lines_a_set * (structured(s) ? 2 : 1) * more_, s.display().render.seed),
          fine_(fine_lines_a_set * (structured(s) ? 4 : 1) * more_, s.display().render.seed),
          anew_(fine_lines_a_set * (structured(s) ? 4 : 1) * more_, s.display().render.seed, independent_sets),
          of_theory_(lines_of_theory, 0),
          of_theory_curve_(lines_of_theory / 16, 0) {
        if (s.display().panel.subpixels == SubpixelLayout::none) return;
        const bool by_subpixel = s.display().content.sampling == ContentSampling::subpixel;
        other_sampling = by_subpixel ? ContentSampling::pixel : ContentSampling::subpixel;
        other.emplace(s.display(), s.geometry(), *other_sampling);
    }

    enum class Lines { curve, fine, anew };  // anew: as fine, but with random numbers of their own
    MetPlaces at(double x, Lines lines = Lines::curve) const {
        return paths_.look({x, 0, distance_}, lines == Lines::curve ? lines_ : lines == Lines::fine ? fine_ : anew_);
    }
    MeantLight light(const MetPlaces& met, const MeantPanel& panel) const { return {met, paths_.weights(), panel}; }
    MetPlaces theory_at(double x, Lines lines) const {
        return theory_.look(x, lines == Lines::curve ? of_theory_curve_ : of_theory_);
    }
    MeantLight theory_light(const MetPlaces& met, const MeantPanel& panel) const { return {met, {luminance_weights}, panel}; }

    double view_mm() const { return views.step_slope() * eye_mm; }
    /// Light of the view whose middle, in steps, this is.
    Sums view(const MeantLight& light, double middle) const {
        return light.between((middle - 0.5) * views.step_slope(), (middle + 0.5) * views.step_slope());
    }
    Leak of_view(const MeantLight& light, double middle) const {
        Leak found{view(light, middle), light.all()};
        for (std::size_t k = 0; k < found.leak.size(); ++k) found.leak[k] -= found.signal[k];
        return found;
    }
    /// Of the left (0) or right eye (1).
    static Leak of_side(const MeantLight& light, std::size_t side) {
        const Sums left = light.between(-infinity, 0), right = light.between(0, infinity);
        return side == 0 ? Leak{left, right} : Leak{right, left};
    }

  private:
    double distance_;

  public:
    double eye_mm;
    MeantPanel shown;  // with the description's content
    std::optional<ContentSampling> other_sampling;
    std::optional<MeantPanel> other;

  private:
    MeantPanel pixels_;

  public:
    PixelViews views;
    Parts parts;

  private:
    EyePaths paths_;
    MeantTheory theory_;
    int more_;
    LineSets lines_, fine_, anew_, of_theory_, of_theory_curve_;
};

Estimate percent(const MeantLight& light, const Leak& found) { return light.crosstalk_percent(found.leak, found.signal); }

/// Crosstalk where the middle of the screen is looked at, and by theory.
struct Middle {
    Estimate measured;
    double theory = nan;
};

/// Of several views; undefined where there are none.
struct ViewsCrosstalk {
    std::vector<double> view{0};  // their middles, in steps
    std::vector<Estimate> all{Estimate()},
        next{Estimate()};  // percent of all other views together, and of one neighbour, their mean
    Estimate worst;
    std::size_t innermost = 0, worst_at = 0;
    Middle middle, middle_of_other;

    /// The one at a share of all, from the least to the worst. NaN, where there is no light, counts as the worst.
    std::size_t ranked(double share) const {
        std::vector<std::size_t> order(all.size());
        std::iota(order.begin(), order.end(), std::size_t(0));
        const auto rank = [&](std::size_t n) { return std::isnan(all[n].value) ? infinity : all[n].value; };
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
        return order[std::size_t(share * double(order.size() - 1))];
    }
};

/// The worst of many noisy figures is too great by chance. It says where to look, and other lines of sight how much is there; what
/// it exceeds those by is part of the error, as another may be the worst.
Estimate measured_anew(const Eyes& eyes, double view, const Estimate& chosen) {
    const MeantLight light = eyes.light(eyes.at(view * eyes.view_mm(), Eyes::Lines::anew), eyes.shown);
    Estimate anew = percent(light, eyes.of_view(light, view));
    if (chosen.value > anew.value) anew.error += chosen.value - anew.value;
    return anew;
}

Middle at_middle_view(const Eyes& eyes, const MeantPanel& panel, const MeantLight& light, const MetPlaces& theory) {
    const double view = eyes.views.innermost();
    const MeantLight by_theory = eyes.theory_light(theory, panel);
    return {percent(light, eyes.of_view(light, view)), percent(by_theory, eyes.of_view(by_theory, view)).value};
}

/// The eye in the middle of each whole view in turn, most_views of them at most, evenly; the innermost one the finest.
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
        const Sums below = eyes.view(light, k - 1), above = eyes.view(light, k + 1);
        Sums neighbours;
        for (std::size_t m = 0; m < neighbours.size(); ++m) neighbours[m] = 0.5 * (below[m] + above[m]);
        views.all[n] = percent(light, found);
        views.next[n] = light.crosstalk_percent(neighbours, found.signal);
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

constexpr const char* no_view = "a view is a strip one panel pixel wide, and elemental images are narrower than a pixel";
constexpr const char* no_light = "no light that is meant for any lens reaches an eye in front of the screen's middle";

void add_middle(const Eyes& eyes, const ViewsCrosstalk& views, ContentSampling sampling, Result& result) {
    Json& json = result.figures["between_views"];
    for (const auto& [name, formula] : definitions) add_figure(json, name, views.middle.measured);
    json["theory_percent"] = number_json(views.middle.theory);
    if (eyes.other) {
        Json other = {{"sampling", name_of(*eyes.other_sampling)}};
        add_figure(other, "woods_percent", views.middle_of_other.measured);
        other["theory_percent"] = number_json(views.middle_of_other.theory);
        json["other_sampling"] = std::move(other);
    }
    const auto add = [&](const std::string& what, const Middle& found) {
        result.findings.push_back({what,
                                   "%",
                                   {found.measured.value},
                                   {found.theory},
                                   "all other views together, over the one that is meant; the panel's black is 0",
                                   {found.measured.error}});
    };
    const std::string of = eyes.other ? fmt::format("; {}", made_for(sampling)) : "";
    add("Crosstalk between views, the innermost one: Woods, IEC 62629-22-1 and IDMS alike" + of, views.middle);
    if (eyes.other) add(fmt::format("The same; {}", made_for(*eyes.other_sampling)), views.middle_of_other);
}

void between_views(const Subject& s, Eyes& eyes, Result& result) {
    Json& json = result.figures["between_views"];
    json["view_step_mm"] = eyes.view_mm();
    json["view_step_deg"] = s.theory(0).view_step_deg;
    json["whole_views"] = eyes.views.count();
    json["innermost_view"] = eyes.views.innermost();
    const ViewsCrosstalk views = eyes.views.count() > 0 ? look_at_views(eyes) : ViewsCrosstalk();
    add_middle(eyes, views, s.display().content.sampling, result);
    add_figure(json, "next_view_alone_percent", views.next[views.innermost]);
    add_figure(json, "median_view_percent", views.all[views.ranked(0.5)]);
    json["worst_view"] = views.view[views.worst_at];
    add_figure(json, "worst_view_percent", views.worst);
    if (eyes.views.count() == 0)
        result.note("between_views", no_view);
    else if (std::isnan(views.middle.measured.value))
        result.note("between_views", no_light);
    std::vector<double> all, next;
    for (const Estimate& e : views.all) all.push_back(e.value);
    for (const Estimate& e : views.next) next.push_back(e.value);
    result.tables.push_back(
        {"crosstalk_views", {{"view", views.view}, {"crosstalk_percent", all}, {"next_view_crosstalk_percent", next}}});
}

/// The eye moving past the innermost views. `spread`: how many views it gathers at once.
void curves_of_views(Eyes& eyes, double spread, Result& result) {
    constexpr int shown = 2;
    const double reach = shown + 1 + std::min(spread, 100.);  // in views
    std::vector<double> places, theory(places_of_curves);
    for (int n = 0; n < places_of_curves; ++n) places.push_back(eyes.view_mm() * reach * (2. * n / (places_of_curves - 1) - 1));
    const double first = eyes.views.innermost() > 0 ? eyes.views.innermost() - shown : -shown;
    std::vector<std::vector<double>> shares(eyes.views.innermost() > 0 ? 2 * shown : 2 * shown + 1,
                                            std::vector<double>(places.size()));
    const auto share = [&](const MeantLight& light, double view) { return total(eyes.view(light, view)) / total(light.all()); };
    eyes.parts.run(places_of_curves, [&](int part) {
        const auto n = std::size_t(part);
        const MeantLight light = eyes.light(eyes.at(places[n]), eyes.shown);
        for (std::size_t k = 0; k < shares.size(); ++k) shares[k][n] = share(light, first + double(k));
        theory[n] = share(eyes.theory_light(eyes.theory_at(places[n], Eyes::Lines::curve), eyes.shown), eyes.views.innermost());
    });
    Plot plot{"crosstalk_views", "Views that an eye sees", "eye's place x, mm", "share of the light", {}};
    DataTable table{"crosstalk_curves", {{"x_mm", places}}};
    for (std::size_t k = 0; k < shares.size(); ++k) {
        plot.series.push_back({fmt::format("view {:+g}", first + double(k)), places, shares[k]});
        table.columns.push_back({fmt::format("view_{:+g}_share", first + double(k)), shares[k]});
    }
    table.columns.push_back({fmt::format("view_{:+g}_theory_share", eyes.views.innermost()), theory});
    plot.series.push_back({fmt::format("view {:+g}, theory", eyes.views.innermost()), places, std::move(theory)});
    result.plots.push_back(std::move(plot));
    result.tables.push_back(std::move(table));
}

/// Crosstalk of the left (0) and the right eye (1) of one head.
using BothEyes = std::array<Estimate, 2>;

/// Between the eyes of heads at several places.
struct Heads {
    double apart;
    std::vector<double> places;
    std::vector<BothEyes> found;
    BothEyes of_other;  // in the middle, with the other sampling
    double theory = nan, theory_of_other = nan;

    std::size_t middle() const { return places.size() / 2; }
};

double eye_of_head(double head, std::size_t side, double apart) { return head + (double(side) - 0.5) * apart; }

BothEyes look_with_both(const Eyes& eyes, double head, double apart) {
    BothEyes found;
    for (const std::size_t side : {0u, 1u}) {
        const MeantLight light = eyes.light(eyes.at(eye_of_head(head, side, apart)), eyes.shown);
        found[side] = percent(light, Eyes::of_side(light, side));
    }
    return found;
}

/// Theory of a head in the middle: both eyes together.
double theory_of_eyes(const Eyes& eyes, const std::array<MetPlaces, 2>& met, const MeantPanel& panel) {
    double signal = 0, leak = 0;
    for (const std::size_t side : {0u, 1u}) {
        const Leak found = Eyes::of_side(eyes.theory_light(met[side], panel), side);
        signal += total(found.signal);
        leak += total(found.leak);
    }
    return 100 * leak / signal;
}

Heads look_with_heads(Eyes& eyes, double apart) {
    Heads all{apart, {}, std::vector<BothEyes>(heads), {}};
    for (int n = 0; n < heads; ++n) all.places.push_back(1.5 * apart * (2. * n / (heads - 1) - 1));
    eyes.parts.run(heads, [&](int part) {
        const auto n = std::size_t(part);
        if (n != all.middle()) {
            all.found[n] = look_with_both(eyes, all.places[n], apart);
            return;
        }
        for (const std::size_t side : {0u, 1u}) {
            const MetPlaces met = eyes.at(eye_of_head(0, side, apart), Eyes::Lines::fine);
            const auto of = [&](const MeantPanel& panel) {
                const MeantLight light = eyes.light(met, panel);
                return percent(light, Eyes::of_side(light, side));
            };
            all.found[n][side] = of(eyes.shown);
            if (eyes.other) all.of_other[side] = of(*eyes.other);
        }
        const std::array theory{eyes.theory_at(eye_of_head(0, 0, apart), Eyes::Lines::fine),
                                eyes.theory_at(eye_of_head(0, 1, apart), Eyes::Lines::fine)};
        all.theory = theory_of_eyes(eyes, theory, eyes.shown);
        if (eyes.other) all.theory_of_other = theory_of_eyes(eyes, theory, *eyes.other);
    });
    return all;
}

/// Of the eye that sees worse. No light counts as the worst.
Estimate worse(const BothEyes& both) {
    const auto rank = [](const Estimate& e) { return std::isnan(e.value) ? infinity : e.value; };
    return rank(both[0]) > rank(both[1]) ? both[0] : both[1];
}

/// How far the head may go to one side, -1 or 1: at the first place that is too bad the last step is halved again and again. With
/// `errors` times its error added to each figure.
Limit head_limit(const Eyes& eyes, const Heads& all, int side, double errors) {
    const auto allowed = [&](const BothEyes& both) {
        const Estimate e = worse(both);
        return e.value + errors * (std::isfinite(e.error) ? e.error : 0) <= tolerable_percent;  // not where it is NaN
    };
    Limit found;
    std::size_t n = all.middle();
    if (!allowed(all.found[n])) {
        found.missing = "the rule does not hold even in the middle";
        return found;
    }
    const std::size_t last = side < 0 ? 0 : all.places.size() - 1;
    while (n != last && allowed(all.found[n + std::size_t(side)])) n += std::size_t(side);
    if (n == last) {
        found.missing = fmt::format("the rule still holds at {:.4g}, where the search ended", all.places[n]);
        return found;
    }
    double good = all.places[n], bad = all.places[n + std::size_t(side)];
    for (int k = 0; k < halvings; ++k) {
        const double between = 0.5 * (good + bad);
        (allowed(look_with_both(eyes, between, all.apart)) ? good : bad) = between;
    }
    return {0.5 * (good + bad), 0.5 * std::abs(bad - good), {}};
}

/// Where both eyes have at most what is tolerable; the error is as far as the limits move with the figures' errors.
Interval head_range(Eyes& eyes, const Heads& all) {
    std::array<Limit, 6> limits;
    eyes.parts.run(int(limits.size()), [&](int n) { limits[std::size_t(n)] = head_limit(eyes, all, n < 3 ? -1 : 1, n % 3 - 1); });
    std::array<Limit, 2> ends;
    for (const std::size_t side : {0u, 1u}) {
        const Limit &early = limits[3 * side + 2], &late = limits[3 * side];
        Limit& end = ends[side] = limits[3 * side + 1];
        if (!std::isfinite(end.at)) continue;
        const double nearest = std::isfinite(early.at) ? early.at : 0, farthest = std::isfinite(late.at) ? late.at
                                                                                  : side == 0            ? all.places.front()
                                                                                                         : all.places.back();
        end.error += std::max(std::abs(nearest - end.at), std::abs(farthest - end.at));
    }
    return {ends[0], ends[1]};
}

/// The eyes are not both in the one viewing zone, so that crosstalk between them is undefined.
void tell_apart(const Subject& s, Eyes& eyes, double zone_mm, Result& result) {
    eyes.parts.run(heads + 6, [](int) {});
    Json& json = result.figures["between_eyes"];
    for (const char* name : {"left_eye_percent", "left_eye_percent_error", "right_eye_percent", "right_eye_percent_error",
                             "theory_percent", "head_within_10_percent_mm"})
        json[name] = Json();
    const std::string why = fmt::format(
        "the viewing zone is {:.4g} mm wide at the eyes' distance, and the eyes are {:.4g} mm apart: each eye would need "
        "its own display",
        zone_mm, s.options().eye_distance_mm);
    result.note("between_eyes", why);
    result.findings.push_back({"Crosstalk between the eyes", "%", {std::numeric_limits<double>::quiet_NaN()}, {}, why});
}

void add_eyes(const Eyes& eyes, const Heads& all, ContentSampling sampling, Result& result) {
    Json& json = result.figures["between_eyes"];
    Json other;
    if (eyes.other) other["sampling"] = name_of(*eyes.other_sampling);
    for (const std::size_t side : {0u, 1u}) {
        const std::string name = side == 0 ? "left" : "right";
        const auto add = [&](Json& to, const std::string& of, const Estimate& found, double theory) {
            add_figure(to, name + "_eye_percent", found);
            result.findings.push_back({fmt::format("Crosstalk between the eyes, {} eye, head in the middle{}", name, of),
                                       "%",
                                       {found.value},
                                       {theory},
                                       "what is meant for the other side of the head, over what is meant for its own",
                                       {found.error}});
        };
        const Estimate& middle = all.found[all.middle()][side];
        add(json, eyes.other ? fmt::format("; {}", made_for(sampling)) : "", middle, all.theory);
        if (eyes.other) add(other, fmt::format("; {}", made_for(*eyes.other_sampling)), all.of_other[side], all.theory_of_other);
        if (std::isnan(middle.value)) result.note("between_eyes." + name + "_eye_percent", "no light reaches the eye");
    }
    json["theory_percent"] = number_json(all.theory);
    if (!eyes.other) return;
    other["theory_percent"] = number_json(all.theory_of_other);
    json["other_sampling"] = std::move(other);
}

/// Two eyes whose head moves, while the right half of what the panel shows stays meant for the right eye.
void between_eyes(const Subject& s, Eyes& eyes, Result& result) {
    const double apart = s.options().eye_distance_mm, zone_mm = eyes.eye_mm * image_along_row_mm(s) / s.geometry().gap_mm;
    if (apart > zone_mm) return tell_apart(s, eyes, zone_mm, result);
    const Heads all = look_with_heads(eyes, apart);
    add_eyes(eyes, all, s.display().content.sampling, result);
    Plot plot{"crosstalk_eyes", "Crosstalk between the two eyes", "head's place x, mm", "leak / signal, %", {}};
    DataTable table{"crosstalk_eyes", {{"head_mm", all.places}}};
    for (const std::size_t side : {0u, 1u}) {
        const std::string name = side == 0 ? "left" : "right";
        std::vector<double> percents;
        for (const BothEyes& both : all.found) percents.push_back(both[side].value);
        Series drawn{name + " eye", all.places, percents};
        for (double& y : drawn.y)
            if (!(y <= 100)) y = std::numeric_limits<double>::quiet_NaN();
        plot.series.push_back(std::move(drawn));
        table.columns.push_back({name + "_eye_crosstalk_percent", std::move(percents)});
    }
    const Interval range = head_range(eyes, all);
    plot.marks.push_back({"10 %", tolerable_percent, false});
    if (all.theory <= 100) plot.marks.push_back({"theory, head in the middle", all.theory, false});
    add_limits(result, result.figures["between_eyes"], "between_eyes.", "head_within_10_percent_mm", range);
    result.findings.push_back(finding("Head's places where both eyes have at most 10 % crosstalk", "mm", range, {},
                                      "the panel's picture stays; searched to 1.5 eye distances"));
    result.plots.push_back(std::move(plot));
    result.tables.push_back(std::move(table));
}

}  // namespace

std::int64_t crosstalk_steps(const Subject& s) {
    return pictures_worth(
        s, std::int64_t(most_views + places_of_curves + 2 * heads + 12 * halvings) * 2 * lines_a_set * independent_sets);
}

Result measure_crosstalk(Subject& s, Job& job) {
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
        "Crosstalk is 100 (leak - black) / (signal - black) by Woods 2012, and with the panel's black at 0 and light that adds, by "
        "IEC 62629-22-1 and by IDMS too; luminance is averaged over the screen. A view is a strip of every elemental image one "
        "panel pixel wide. It lights up those pixels, or subpixels where content is made for each, whose centres lie in it, and "
        "these as a whole. Only whole views count; the leak is the light of all other views. For two eyes, left and right of the "
        "middle of every elemental image are meant for the eyes on either side of a head in front of the screen's middle. Views "
        "lie side by side along the panel's rows, as the eyes do, also where lenses are turned or strips lean.");
    result.remarks.push_back(fmt::format(
        "Paraxially an eye gathers {:.3g} views at once: lens apertures and the diffuser mix neighbouring views wherever the "
        "central depth plane is not at the eye. That is how a light field display shows depth, and what a display of two views "
        "must avoid. Theory leaves out aberration.",
        spread));
    return result;
}

}  // namespace lfdsim
