#include "analysis/crosstalk.h"

#include "analysis/parallel.h"
#include "analysis/rules.h"
#include "analysis/slope_spread.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

// What one eye sees of neighbouring views, and of what the other eye should see. docs/model.md, "Crosstalk".
namespace lfdsim {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int rays_an_eye = 16384, most_views = 61, places_of_curves = 97, heads = 61;
constexpr double tolerable = 0.1;  // of the head's range

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(); }

/// One eye on a level with the screen's middle, at the viewing distance.
class Eyes {
  public:
    Eyes(Subject& s, Job& job)
        : distance_(checked_viewing_distance_mm(s)),
          eye_mm(distance_ - s.geometry().rear_principal_mm),
          view_slope(s.display().panel.pixel_pitch_mm / s.geometry().gap_mm),
          theory(s, eye_mm),
          parts(job, s.threads(), most_views + places_of_curves + heads, crosstalk_steps(s)),
          geometry_(s.geometry()),
          rays_(s.display(), s.geometry()),
          pickup_(s.display(), s.geometry()),
          choices_(even_choices(rays_an_eye * rays_.more_for({0, 0, distance_}))) {}

    MeantLight at(double x) const { return {rays_, pickup_, geometry_, {x, 0, distance_}, choices_}; }
    /// Light of view k: half a view's step to either side of its middle.
    double view(const MeantLight& light, int k) const { return light.between((k - 0.5) * view_slope, (k + 0.5) * view_slope); }

  private:
    double distance_;

  public:
    double eye_mm, view_slope;
    SlopeSpread theory;
    Parts parts;

  private:
    const Geometry& geometry_;
    EyeRays rays_;
    Pickup pickup_;
    std::vector<Choice> choices_;
};

/// The eye in the middle of each view in turn, most_views of them at most, evenly.
void between_views(const Subject& s, Eyes& eyes, Result& result) {
    const int last = int(std::min(0.5 * s.theory().elemental_pitch_mm / s.display().panel.pixel_pitch_mm, 1e6));
    const int stride = 2 * last / most_views + 1, side = last / stride, count = 2 * side + 1;
    std::vector<double> views, crosstalk = std::vector<double>(std::size_t(count)), next = crosstalk;
    for (int n = 0; n < count; ++n) views.push_back((n - side) * stride);
    eyes.parts.run(most_views, [&](int n) {
        if (n >= count) return;
        const int k = (n - side) * stride;
        const MeantLight light = eyes.at(k * eyes.view_slope * eyes.eye_mm);
        const double signal = eyes.view(light, k);
        crosstalk[std::size_t(n)] = crosstalk_of(std::max(light.all() - signal, 0.), signal);
        next[std::size_t(n)] = crosstalk_of(0.5 * (eyes.view(light, k - 1) + eyes.view(light, k + 1)), signal);
    });
    const double share = eyes.theory.within(-0.5 * eyes.view_slope, 0.5 * eyes.view_slope), theory = crosstalk_of(1 - share, share);
    const double middle = crosstalk[std::size_t(side)];
    std::vector<double> sorted = crosstalk;
    for (double& x : sorted)
        if (std::isnan(x)) x = infinity;
    std::sort(sorted.begin(), sorted.end());
    result.figures["between_views"] = {{"view_step_mm", eyes.view_slope * eyes.eye_mm},
                                       {"view_step_deg", s.theory().view_step_deg},
                                       {"middle_view", number(middle)},
                                       {"next_view_alone", number(next[std::size_t(side)])},
                                       {"median_view", number(sorted[std::size_t(side)])},
                                       {"worst_view", number(sorted.back())},
                                       {"theory", number(theory)}};
    result.findings.push_back({"Crosstalk between views, the middle one",
                               "",
                               {middle},
                               {theory},
                               "all other views together, over the one that is meant"});
    result.tables.push_back({"crosstalk_views", {{"view", views}, {"crosstalk", crosstalk}, {"next_view_crosstalk", next}}});
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
        for (int k = -shown; k <= shown; ++k) shares[std::size_t(k + shown)][std::size_t(n)] = eyes.view(light, k) / light.all();
    });
    Plot plot{"crosstalk_views", "Views that an eye sees", "eye's place x, mm", "share of the light", {}};
    DataTable table{"crosstalk_curves", {{"x_mm", places}}};
    for (int k = -shown; k <= shown; ++k) {
        plot.series.push_back({fmt::format("view {:+}", k), places, shares[std::size_t(k + shown)]});
        table.columns.push_back({fmt::format("view_{:+}_share", k), shares[std::size_t(k + shown)]});
    }
    std::vector<double> theory;
    for (const double x : places)
        theory.push_back(eyes.theory.within(-x / eyes.eye_mm - 0.5 * eyes.view_slope, -x / eyes.eye_mm + 0.5 * eyes.view_slope));
    table.columns.push_back({"view_+0_theory_share", theory});
    plot.series.push_back({"view +0, theory", places, std::move(theory)});
    result.plots.push_back(std::move(plot));
    result.tables.push_back(std::move(table));
}

/// Two eyes whose head moves, while the right half of what the panel shows stays meant for the right eye.
void between_eyes(const Subject& s, Eyes& eyes, Result& result) {
    const double apart = s.options().eye_distance_mm;
    std::vector<double> places;
    for (int n = 0; n < heads; ++n) places.push_back(1.5 * apart * (2. * n / (heads - 1) - 1));
    std::array<std::vector<double>, 2> found{std::vector<double>(places.size()), std::vector<double>(places.size())};
    eyes.parts.run(heads, [&](int n) {
        for (const int side : {0, 1}) {
            const MeantLight light = eyes.at(places[std::size_t(n)] + (side - 0.5) * apart);
            const double left = light.between(-infinity, 0), right = light.between(0, infinity);
            found[std::size_t(side)][std::size_t(n)] = side == 0 ? crosstalk_of(right, left) : crosstalk_of(left, right);
        }
    });
    const double wrong = eyes.theory.within(0.5 * apart / eyes.eye_mm, infinity), theory = crosstalk_of(wrong, 1 - wrong);
    Json json;
    Plot plot{"crosstalk_eyes", "Crosstalk between the two eyes", "head's place x, mm", "leak / signal", {}};
    DataTable table{"crosstalk_eyes", {{"head_mm", places}}};
    Curve worse{places, std::vector<double>(places.size()), 0};
    for (const std::size_t side : {0u, 1u}) {
        const std::string name = side == 0 ? "left" : "right";
        const double middle = found[side][heads / 2];
        json[name + "_eye"] = number(middle);
        result.findings.push_back({fmt::format("Crosstalk between the eyes, {} eye, head in the middle", name),
                                   "",
                                   {middle},
                                   {theory},
                                   "what is meant for the other side of the head, over what is meant for its own"});
        table.columns.push_back({name + "_eye_crosstalk", found[side]});
        Series drawn{name + " eye", places, found[side]};
        for (double& y : drawn.y)
            if (!(y <= 1)) y = std::numeric_limits<double>::quiet_NaN();
        plot.series.push_back(std::move(drawn));
        for (std::size_t n = 0; n < places.size(); ++n)
            worse.value[n] = std::min(worse.value[n], std::isnan(found[side][n]) ? -1e3 : std::max(-found[side][n], -1e3));
    }
    const Interval range = where_at_least(worse, 0, -tolerable);
    plot.marks.push_back({"10 %", tolerable, false});
    if (theory <= 1) plot.marks.push_back({"theory, head in the middle", theory, false});
    json["theory"] = number(theory);
    json["head_within_10_percent_mm"] = limits_json(range);
    result.findings.push_back(
        {"Head's places where both eyes have at most 10 % crosstalk",
         "mm",
         bounds(range),
         {},
         range.empty ? "more in the middle already" : "what the panel shows stays; no bound: as far as 1.5 eye distances"});
    result.figures["between_eyes"] = std::move(json);
    result.plots.push_back(std::move(plot));
    result.tables.push_back(std::move(table));
}

}  // namespace

MeantLight::MeantLight(const EyeRays& rays, const Pickup& pickup, const Geometry& g, const Vec3d& eye,
                       std::span<const Choice> choices) {
    rays_.reserve(choices.size());
    for (const Choice& choice : choices) {
        const Sight s = rays.look(eye, choice);
        if (!(s.light > 0)) continue;
        const NodalLine line = pickup.line(s.x, s.y);
        if (line.owned) rays_.push_back({(line.x * pickup.scale - s.x) / g.gap_mm, s.light});
    }
}

double MeantLight::between(double low, double high) const {
    double sum = 0;
    for (const Ray& ray : rays_)
        if (ray.slope >= low && ray.slope < high) sum += ray.light;
    return sum;
}

double crosstalk_of(double leak, double signal) { return leak / signal; }

std::int64_t crosstalk_steps(const Subject& s) {
    return pictures_worth(s, std::int64_t(most_views + places_of_curves + 2 * heads) * rays_an_eye);
}

Result measure_crosstalk(Subject& s, Job& job) {
    Eyes eyes(s, job);
    Result result;
    result.figures["definition"] =
        "(leak - black) / (signal - black), black = 0; both as luminance averaged over the screen; 1 means as much leak as signal";
    result.figures["viewing_distance_mm"] = s.viewing_distance_mm();
    result.figures["eye_distance_mm"] = s.options().eye_distance_mm;
    between_views(s, eyes, result);
    curves_of_views(eyes, result);
    between_eyes(s, eyes, result);
    result.remarks.push_back(
        "Crosstalk is (leak - black) / (signal - black) (Woods 2012); the panel's black is 0, and luminance is averaged over the "
        "screen. A view is a strip of every elemental image one panel pixel wide; the leak is the light of all other views. For "
        "two eyes, left and right of the middle of every elemental image are meant for the eyes on either side of a head before "
        "the screen's middle.");
    result.remarks.push_back(fmt::format(
        "Paraxially an eye gathers {:.3g} views at once: lens apertures and the diffuser mix neighbouring views wherever the "
        "central depth plane is not at the eye. That is how a light field display shows depth, and what a display of two views "
        "must avoid. Theory knows neither aberration nor light that reaches another lens's elemental image.",
        eyes.theory.width() / eyes.view_slope));
    return result;
}

}  // namespace lfdsim
