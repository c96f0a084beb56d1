// Crosstalk between the eyes of a head that moves to the sides. docs/measures.md, "Crosstalk".

#include "analysis/core/figure_json.h"
#include "analysis/crosstalk/crosstalk_eyes.h"
#include "analysis/fov/thresholds.h"
#include "base/bisection.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

namespace lfdsim::crosstalk {
namespace {

constexpr double tolerable_percent = 10;  // crosstalk up to which a head position counts

/// Crosstalk of the left (0) and the right eye (1) of one head.
using BothEyes = std::array<Crosstalk, 2>;

/// The crosstalk between the eyes of heads at several positions.
struct Heads {
    double apart;                // distance between the eyes, mm
    std::vector<double> places;  // of the heads, mm to the right of the screen's middle, ascending and symmetric
    std::vector<BothEyes> found;
    BothEyes of_other = {}, theory = {}, theory_of_other = {};  // of the head in the middle; of_other: with the other sampling

    std::size_t middle() const { return places.size() / 2; }
};

/// Returns the position of the left (0) or right eye (1) of a head, mm.
double eye_of_head(double head, std::size_t side, double apart) { return head + (double(side) - 0.5) * apart; }

/// Returns the crosstalk of both eyes of a head, by few lines.
BothEyes look_with_both(const Eyes& eyes, double head, double apart) {
    BothEyes found;
    for (const std::size_t side : {0u, 1u}) {
        const MeantLight light = eyes.light(eyes.at(eye_of_head(head, side, apart)), eyes.shown);
        found[side] = crosstalk_of(light, leak_of_side(light, side));
    }
    return found;
}

/// Measures heads at 61 positions to 1.5 eye distances on either side; the one in the middle with the most lines, with both
/// samplings, and by theory.
Heads look_with_heads(Eyes& eyes, double apart) {
    Heads all{apart, {}, std::vector<BothEyes>(heads)};
    for (int n = 0; n < heads; ++n) all.places.push_back(1.5 * apart * (2. * n / (heads - 1) - 1));
    eyes.parts.run(heads, [&](int part) {
        const auto n = std::size_t(part);
        if (n != all.middle()) {
            all.found[n] = look_with_both(eyes, all.places[n], apart);
            return;
        }
        for (const std::size_t side : {0u, 1u}) {
            const double x = eye_of_head(0, side, apart);
            const MetPlaces met = eyes.at(x, Eyes::Lines::fine), theory = eyes.theory_at(x, Eyes::Lines::fine);
            const auto of = [&](const MeantLight& light) { return crosstalk_of(light, leak_of_side(light, side)); };
            all.found[n][side] = of(eyes.light(met, eyes.shown));
            all.theory[side] = of(eyes.theory_light(theory, eyes.shown));
            if (!eyes.other) continue;
            all.of_other[side] = of(eyes.light(met, *eyes.other));
            all.theory_of_other[side] = of(eyes.theory_light(theory, *eyes.other));
        }
    });
    return all;
}

/// Returns the crosstalk of the worse eye; no light counts as the worst.
Crosstalk worse(const BothEyes& both) {
    const auto rank = [](const Crosstalk& c) { return std::isnan(c.percent.value) ? infinity : c.percent.value; };
    return rank(both[0]) > rank(both[1]) ? both[0] : both[1];
}

/// Returns how far the head may move to one side, -1 or 1, until the worse eye has more than 10 %: the first step at which it
/// does is halved three times. Each figure counts with `errors` times its error added.
Limit head_limit(const Eyes& eyes, const Heads& all, int side, double errors) {
    const auto allowed = [&](const BothEyes& both) {
        const Crosstalk found = worse(both);
        if (found.left_to_rounding) return errors < 0;
        const Estimate& e = found.percent;
        return e.value + errors * (std::isfinite(e.error) ? e.error : 0) <= tolerable_percent;  // false if it is NaN
    };
    std::size_t n = all.middle();
    if (!allowed(all.found[n])) {
        const bool rounding = worse(all.found[n]).left_to_rounding;
        return Limit::none(rounding ? left_to_rounding : "the criterion is not met even in the middle");
    }
    const std::size_t last = side < 0 ? 0 : all.places.size() - 1;
    while (n != last && allowed(all.found[n + std::size_t(side)])) n += std::size_t(side);
    if (n == last) return Limit::none(fmt::format("the criterion is still met at {:.4g}, where the search ended", all.places[n]));
    const Bisected end = bisected(all.places[n], all.places[n + std::size_t(side)], halvings,
                                  [&](double place) { return allowed(look_with_both(eyes, place, all.apart)); });
    return {end.middle(), 0.5 * std::abs(end.out - end.in), {}};
}

/// Returns the interval of head positions in which both eyes have tolerable crosstalk. Its error is half the last step and the
/// shift of the limits when each figure is less or greater by its error.
Interval head_range(Eyes& eyes, const Heads& all) {
    // Limits 0 to 2 are the left ones with -1, 0 and 1 times the errors, 3 to 5 the right ones.
    std::array<Limit, limits> found;
    eyes.parts.run(limits, [&](int n) { found[std::size_t(n)] = head_limit(eyes, all, n < 3 ? -1 : 1, n % 3 - 1); });
    std::array<Limit, 2> ends;
    for (const std::size_t side : {0u, 1u}) {
        const Limit &early = found[3 * side + 2], &late = found[3 * side];
        Limit& end = ends[side] = found[3 * side + 1];
        if (!std::isfinite(end.at)) continue;
        const double nearest = std::isfinite(early.at) ? early.at : 0, farthest = std::isfinite(late.at) ? late.at
                                                                                  : side == 0            ? all.places.front()
                                                                                                         : all.places.back();
        end.error += std::max(std::abs(nearest - end.at), std::abs(farthest - end.at));
    }
    return known({ends[0], ends[1]}, 0);
}

/// Adds that crosstalk between the eyes is undefined, and why.
void leave_out(const std::string& why, Eyes& eyes, Result& result) {
    eyes.parts.run(heads + limits, [](int) {});  // progress for the work that is left out
    Json& json = result.figures["between_eyes"];
    for (const char* name : {"left_eye_percent", "left_eye_percent_error", "left_eye_theory_percent", "right_eye_percent",
                             "right_eye_percent_error", "right_eye_theory_percent", "theory_percent", "head_within_10_percent_mm"})
        json[name] = Json();
    result.note("between_eyes", why);
    result.add_line({nan, why}, {.label = "Crosstalk between the eyes", .unit = "%"});
}

/// Adds the figures of both eyes of the head in the middle with content of a sampling, under a path that ends in a dot.
void add_eyes(const BothEyes& found, const BothEyes& theory, const std::string& path, const std::string& content, Result& result) {
    for (const std::size_t side : {0u, 1u}) {
        const std::string name = side == 0 ? "left" : "right", eye = path + name + "_eye_";
        result.add(eye + "percent", figure_of(found[side]),
                   {.label = fmt::format("Crosstalk between the eyes, {} eye, head in the middle{}", name, content),
                    .unit = "%",
                    .theory = theory_figure(theory[side]),
                    .theory_path = eye + "theory_percent",
                    .remark = "light intended for the other eye, relative to light intended for this one"});
    }
    result.add(path + "theory_percent", theory_figure(worse(theory)));
}

}  // namespace

void between_eyes(const Subject& s, Eyes& eyes, Result& result) {
    const double apart = s.options().eye_distance_mm, zone_mm = viewing_zone_mm(s.display(), s.geometry(), eyes.eye_mm);
    if (eyes.line == 1)
        return leave_out(fmt::format("{}: both eyes see the same", same_from_both_sides(s.geometry().lattice)), eyes, result);
    if (apart > zone_mm)
        return leave_out(
            fmt::format("the viewing zone is {:.4g} mm wide at the eyes' distance, and the eyes are {:.4g} mm apart: each "
                        "eye would need its own display",
                        zone_mm, apart),
            eyes, result);
    const Heads all = look_with_heads(eyes, apart);
    add_eyes(all.found[all.middle()], all.theory, "between_eyes.",
             eyes.other ? fmt::format("; {}", made_for(s.display().content.sampling)) : "", result);
    if (eyes.other) {
        result.figures["between_eyes"]["other_sampling"]["sampling"] = name_of(*eyes.other_sampling);
        add_eyes(all.of_other, all.theory_of_other, "between_eyes.other_sampling.",
                 fmt::format("; {}", made_for(*eyes.other_sampling)), result);
    }
    Curves curves("crosstalk_eyes", "Crosstalk between the two eyes", "head position x, mm", "leak / signal, %",
                  {"head_mm", all.places});
    for (const std::size_t side : {0u, 1u}) {
        const std::string name = side == 0 ? "left" : "right";
        std::vector<double> percents;
        for (const BothEyes& both : all.found) percents.push_back(both[side].percent.value);
        curves.add(name + " eye", name + "_eye_crosstalk_percent", std::move(percents));
        for (double& y : curves.plot.series.back().y)
            if (!(y <= 100)) y = nan;
    }
    const Interval range = head_range(eyes, all);
    curves.plot.marks.push_back({"10 %", tolerable_percent, false});
    if (const double theory = worse(all.theory).percent.value; theory <= 100)
        curves.plot.marks.push_back({"theory, head in the middle", theory, false});
    result.add("between_eyes.head_within_10_percent_mm", figure_of(range),
               {.label = "Head positions at which both eyes have at most 10 % crosstalk",
                .unit = "mm",
                .remark = "with an unchanged panel picture; searched to 1.5 eye distances"});
    result.add(std::move(curves));
}

}  // namespace lfdsim::crosstalk
