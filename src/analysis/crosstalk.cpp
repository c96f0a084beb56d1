#include "analysis/crosstalk.h"

#include "analysis/meant_light.h"
#include "analysis/meant_theory.h"
#include "analysis/parallel.h"
#include "analysis/rules.h"
#include "model/numbers.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

// What one eye sees of neighbouring views, and of what the other eye should see. docs/model.md, "Crosstalk".
namespace lfdsim {
namespace {

constexpr int lines_a_set = 512, fine_lines_a_set = 16384;  // and as many mirrored
constexpr int most_views = 61, places_of_curves = 97, heads = 61;
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

double percent(double share) { return 100 * std::max(1 - share, 0.) / share; }

/// One eye level with the screen's middle, at the viewing distance.
class Eyes {
  public:
    Eyes(Subject& s, Job& job)
        : distance_(checked_viewing_distance_mm(s)),
          eye_mm(distance_ - s.geometry().rear_principal_mm),
          view_slope(s.display().panel.pixel_pitch_mm / s.geometry().gap_mm),
          theory(s, distance_),
          parts(job, s.threads(), most_views + places_of_curves + heads, crosstalk_steps(s)),
          geometry_(s.geometry()),
          rays_(s.display(), s.geometry()),
          pickup_(s.display(), s.geometry()),
          more_(rays_.more_for({0, 0, distance_})),
          lines_(lines_a_set * more_, s.display().render.seed),
          fine_(fine_lines_a_set * more_, s.display().render.seed) {}

    /// At x; `fine`: for the figures, else for curves.
    MeantLight at(double x, bool fine = false) const {
        return {rays_, pickup_, geometry_, {x, 0, distance_}, fine ? fine_ : lines_};
    }
    /// Light of view k: half a view's step to either side of its middle.
    Sums view(const MeantLight& light, int k) const { return light.between((k - 0.5) * view_slope, (k + 0.5) * view_slope); }
    double view_theory(double x, int k) const { return theory.meant(x, (k - 0.5) * view_slope, (k + 0.5) * view_slope); }

  private:
    double distance_;

  public:
    double eye_mm, view_slope;
    MeantTheory theory;
    Parts parts;

  private:
    const Geometry& geometry_;
    EyeRays rays_;
    Pickup pickup_;
    int more_;
    LineSets lines_, fine_;
};

/// Width of an elemental image along a row of the panel; strips lean against it.
double image_along_row_mm(const Subject& s) {
    const Lattice<double>& lattice = s.geometry().lattice;
    return s.theory(0).elemental_pitch_mm / (lattice.strips ? lattice.cos_turn : 1);
}

Sums less(Sums a, const Sums& b) {
    for (std::size_t k = 0; k < a.size(); ++k) a[k] -= b[k];
    return a;
}

struct ViewsCrosstalk {
    std::vector<double> view;                     // numbers of the views
    std::vector<Estimate> all, next;              // percent of all other views together, and of one neighbour, their mean
    const Estimate& ranked(double share) const {  // NaN, where there is no light, counts as the worst
        std::vector<std::size_t> order(all.size());
        std::iota(order.begin(), order.end(), std::size_t(0));
        const auto rank = [&](std::size_t n) { return std::isnan(all[n].value) ? infinity : all[n].value; };
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
        return all[order[std::size_t(share * double(order.size() - 1))]];
    }
};

/// The eye in the middle of each whole view in turn, most_views of them at most, evenly; the middle one the finest.
ViewsCrosstalk look_at_views(Eyes& eyes, int last) {
    const int stride = 2 * last / most_views + 1, side = last / stride, count = 2 * side + 1;
    ViewsCrosstalk views{{}, std::vector<Estimate>(std::size_t(count)), std::vector<Estimate>(std::size_t(count))};
    for (int n = 0; n < count; ++n) views.view.push_back((n - side) * stride);
    eyes.parts.run(most_views, [&](int n) {
        if (n >= count) return;
        const int k = (n - side) * stride;
        const MeantLight light = eyes.at(k * eyes.view_slope * eyes.eye_mm, k == 0);
        const Sums signal = eyes.view(light, k), below = eyes.view(light, k - 1), above = eyes.view(light, k + 1);
        Sums neighbours;
        for (std::size_t m = 0; m < neighbours.size(); ++m) neighbours[m] = 0.5 * (below[m] + above[m]);
        views.all[std::size_t(n)] = light.crosstalk_percent(less(light.all(), signal), signal);
        views.next[std::size_t(n)] = light.crosstalk_percent(neighbours, signal);
    });
    return views;
}

void between_views(const Subject& s, Eyes& eyes, Result& result) {
    Json& json = result.figures["between_views"];
    json["view_step_mm"] = eyes.view_slope * eyes.eye_mm;
    json["view_step_deg"] = s.theory(0).view_step_deg;
    // A view is whole where its strip, a wide, lies in the elemental image: (|k| + 1/2) a <= p'/2, along the row.
    const double across = image_along_row_mm(s) / s.display().panel.pixel_pitch_mm, last = std::floor(0.5 * (across - 1) + 1e-9);
    json["whole_views"] = last < 0 ? 0 : 2 * std::int64_t(std::min(last, 1e6)) + 1;
    const ViewsCrosstalk views =
        last < 0 ? ViewsCrosstalk{{0}, {{nan, nan}}, {{nan, nan}}} : look_at_views(eyes, int(std::min(last, 1e6)));
    const std::size_t middle_view = views.view.size() / 2;
    const Estimate middle = views.all[middle_view];
    const double theory = last < 0 ? nan : percent(eyes.view_theory(0, 0));
    for (const auto& [name, formula] : definitions) add_figure(json, name, middle);
    add_figure(json, "next_view_alone_percent", views.next[middle_view]);
    add_figure(json, "median_view_percent", views.ranked(0.5));
    add_figure(json, "worst_view_percent", views.ranked(1));
    json["theory_percent"] = number_json(theory);
    if (last < 0)
        result.note("between_views", "a view is a strip one panel pixel wide, and elemental images are narrower than a pixel");
    else if (std::isnan(middle.value))
        result.note("between_views", "no light that is meant for any lens reaches an eye in front of the screen's middle");
    result.findings.push_back({"Crosstalk between views, the middle one: Woods, IEC 62629-22-1 and IDMS alike",
                               "%",
                               {middle.value},
                               {theory},
                               "all other views together, over the one that is meant; the panel's black is 0",
                               {middle.error}});
    std::vector<double> all, next;
    for (const Estimate& e : views.all) all.push_back(e.value);
    for (const Estimate& e : views.next) next.push_back(e.value);
    result.tables.push_back(
        {"crosstalk_views", {{"view", views.view}, {"crosstalk_percent", all}, {"next_view_crosstalk_percent", next}}});
}

/// The eye moving past the middle views.
void curves_of_views(Eyes& eyes, Result& result) {
    constexpr int shown = 2;
    const double step = eyes.view_slope * eyes.eye_mm,
                 reach = shown + 1 + std::min(eyes.theory.width() / eyes.view_slope, 100.);  // in views
    std::vector<double> places;
    for (int n = 0; n < places_of_curves; ++n) places.push_back(step * reach * (2. * n / (places_of_curves - 1) - 1));
    std::array<std::vector<double>, 2 * shown + 1> shares;
    for (auto& share : shares) share.resize(places.size());
    eyes.parts.run(places_of_curves, [&](int n) {
        const MeantLight light = eyes.at(places[std::size_t(n)]);
        for (int k = -shown; k <= shown; ++k)
            shares[std::size_t(k + shown)][std::size_t(n)] = total(eyes.view(light, k)) / total(light.all());
    });
    Plot plot{"crosstalk_views", "Views that an eye sees", "eye's place x, mm", "share of the light", {}};
    DataTable table{"crosstalk_curves", {{"x_mm", places}}};
    for (int k = -shown; k <= shown; ++k) {
        plot.series.push_back({fmt::format("view {:+}", k), places, shares[std::size_t(k + shown)]});
        table.columns.push_back({fmt::format("view_{:+}_share", k), shares[std::size_t(k + shown)]});
    }
    std::vector<double> theory;
    for (const double x : places) theory.push_back(eyes.view_theory(x, 0));
    table.columns.push_back({"view_+0_theory_share", theory});
    plot.series.push_back({"view +0, theory", places, std::move(theory)});
    result.plots.push_back(std::move(plot));
    result.tables.push_back(std::move(table));
}

/// Crosstalk of the left (0) and the right eye (1) of heads at these places.
std::array<std::vector<Estimate>, 2> look_with_both_eyes(Eyes& eyes, const std::vector<double>& places, double apart) {
    std::array<std::vector<Estimate>, 2> found{std::vector<Estimate>(places.size()), std::vector<Estimate>(places.size())};
    eyes.parts.run(heads, [&](int n) {
        for (const std::size_t side : {0u, 1u}) {
            const MeantLight light = eyes.at(places[std::size_t(n)] + (double(side) - 0.5) * apart, n == heads / 2);
            const Sums left = light.between(-infinity, 0), right = light.between(0, infinity);
            found[side][std::size_t(n)] = side == 0 ? light.crosstalk_percent(right, left) : light.crosstalk_percent(left, right);
        }
    });
    return found;
}

/// The eyes are not both in the one viewing zone, so that crosstalk between them is undefined.
void tell_apart(const Subject& s, Eyes& eyes, double zone_mm, Result& result) {
    eyes.parts.run(heads, [](int) {});
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

/// Two eyes whose head moves, while the right half of what the panel shows stays meant for the right eye.
void between_eyes(const Subject& s, Eyes& eyes, Result& result) {
    const double apart = s.options().eye_distance_mm, zone_mm = eyes.eye_mm * image_along_row_mm(s) / s.geometry().gap_mm;
    if (apart > zone_mm) return tell_apart(s, eyes, zone_mm, result);
    std::vector<double> places;
    for (int n = 0; n < heads; ++n) places.push_back(1.5 * apart * (2. * n / (heads - 1) - 1));
    const auto found = look_with_both_eyes(eyes, places, apart);
    const double theory = percent(eyes.theory.meant(-0.5 * apart, -infinity, 0));
    Json& json = result.figures["between_eyes"];
    Plot plot{"crosstalk_eyes", "Crosstalk between the two eyes", "head's place x, mm", "leak / signal, %", {}};
    DataTable table{"crosstalk_eyes", {{"head_mm", places}}};
    Curve worse{places, std::vector<double>(places.size(), infinity), 0};
    for (const std::size_t side : {0u, 1u}) {
        const std::string name = side == 0 ? "left" : "right";
        const Estimate middle = found[side][heads / 2];
        add_figure(json, name + "_eye_percent", middle);
        if (std::isnan(middle.value)) result.note("between_eyes." + name + "_eye_percent", "no light reaches the eye");
        result.findings.push_back({fmt::format("Crosstalk between the eyes, {} eye, head in the middle", name),
                                   "%",
                                   {middle.value},
                                   {theory},
                                   "what is meant for the other side of the head, over what is meant for its own",
                                   {middle.error}});
        std::vector<double> all;
        for (const Estimate& e : found[side]) all.push_back(e.value);
        Series drawn{name + " eye", places, all};
        for (double& y : drawn.y)
            if (!(y <= 100)) y = std::numeric_limits<double>::quiet_NaN();
        plot.series.push_back(std::move(drawn));
        for (std::size_t n = 0; n < places.size(); ++n)
            worse.value[n] = std::min(worse.value[n], std::isnan(all[n]) ? -1e5 : std::max(-all[n], -1e5));
        table.columns.push_back({name + "_eye_crosstalk_percent", std::move(all)});
    }
    const Interval range = where_at_least(worse, 0, -tolerable_percent);
    plot.marks.push_back({"10 %", tolerable_percent, false});
    if (theory <= 100) plot.marks.push_back({"theory, head in the middle", theory, false});
    json["theory_percent"] = number_json(theory);
    add_limits(result, json, "between_eyes.", "head_within_10_percent_mm", range);
    result.findings.push_back(finding("Head's places where both eyes have at most 10 % crosstalk", "mm", range, {},
                                      "the panel's picture stays; searched to 1.5 eye distances"));
    result.plots.push_back(std::move(plot));
    result.tables.push_back(std::move(table));
}

}  // namespace

std::int64_t crosstalk_steps(const Subject& s) {
    return pictures_worth(s, std::int64_t(most_views + places_of_curves + 2 * heads) * 2 * lines_a_set * independent_sets);
}

Result measure_crosstalk(Subject& s, Job& job) {
    Eyes eyes(s, job);
    Result result;
    for (const auto& [name, formula] : definitions) result.figures["definitions"][name] = formula;
    result.figures["viewing_distance_mm"] = s.viewing_distance_mm();
    result.figures["eye_distance_mm"] = s.options().eye_distance_mm;
    between_views(s, eyes, result);
    curves_of_views(eyes, result);
    between_eyes(s, eyes, result);
    result.remarks.push_back(
        "Crosstalk is 100 (leak - black) / (signal - black) by Woods 2012, and with the panel's black at 0 and light that adds, by "
        "IEC 62629-22-1 and by IDMS too; luminance is averaged over the screen. A view is a strip of every elemental image one "
        "panel "
        "pixel wide, and only whole views count; the leak is the light of all other views. For "
        "two eyes, left and right of the middle of every elemental image are meant for the eyes on either side of a head in front "
        "of the screen's middle.");
    result.remarks.push_back(fmt::format(
        "Paraxially an eye gathers {:.3g} views at once: lens apertures and the diffuser mix neighbouring views wherever the "
        "central depth plane is not at the eye. That is how a light field display shows depth, and what a display of two views "
        "must avoid. Theory leaves out aberration.",
        eyes.theory.width() / eyes.view_slope));
    return result;
}

}  // namespace lfdsim
