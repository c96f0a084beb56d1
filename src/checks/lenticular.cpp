#include "checks/lenticular.h"

#include "base/constants.h"
#include "base/input_error.h"
#include "checks/first_order.h"
#include "display/keys.h"
#include "geometry/lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lfdsim {

std::optional<CylinderSheet> cylinder_sheet(double pitch_mm, double gap_mm, double index) {
    const double half = pitch_mm / 2, R = to_picometre(gap_mm * (index - 1));
    if (!(R >= half)) return {};
    // The caps' sag is R - sqrt(R^2 - (p/2)^2), and sag, wall h and layer together are n g. The wall is low, as the tracer
    // requires it (h <= 2 sqrt(R^2 - r^2)), and the rest of the sheet is a layer.
    const double wall = std::sqrt((R - half) * (R + half)), sag = R - wall;
    CylinderSheet sheet;
    sheet.lens.sphere_radius_mm = R;
    sheet.lens.cylinder_height_mm = to_nanometre(std::min(half / 2, wall));
    sheet.lens.index = index;
    sheet.layer_mm = to_picometre(index * gap_mm - sag - sheet.lens.cylinder_height_mm);
    return sheet;
}

namespace {

constexpr double usual_fov_deg = 30, one_in_three_deg = 18.434949;
constexpr Range inch_range{0.1, 2000}, distance_range{5, 1e5}, lenticular_fov_range{1, 120}, lenticular_views_range{2, 1000},
    lenticular_slant_range{-60, 60}, lenticular_pitch_range{1e-3, 1e4}, sheet_range{1e-3, 1e4}, eyes_range{1, 1000},
    lenticular_pixel_range{fewest_views * fewest_lenses, 1e5};

/// A lenticular display in the making. Each step uses what the earlier ones have determined, so their order matters.
class Design {
  public:
    explicit Design(const LenticularRequest& request) : r_(request) {}

    /// Runs all steps. Throws InputError where the request cannot be met.
    Lenticular make() {
        check();
        made_.request = r_;
        make_panel();
        choose_views();
        find_gap();
        make_lenses();
        place_camera_and_content();
        if (const std::vector<Problem> problems = validate(d_); !problems.empty())
            throw InputError("--distance-mm", fmt::format("is {:g}, which gives no valid display: {} {}", r_.distance_mm,
                                                          problems[0].where, problems[0].what));
        made_.display = std::move(d_);
        return std::move(made_);
    }

  private:
    /// Throws InputError for values out of range, and for options that determine the same quantity.
    void check() const {
        std::vector<Problem> all;
        const auto value = [&](const char* option, const std::optional<double>& x, const Range& range) {
            if (x && !range.contains(*x)) all.push_back({option, fmt::format("is {:g}; allowed is {}", *x, range.text())});
        };
        value("--panel-inch", r_.panel_inch, inch_range);
        value("--distance-mm", r_.distance_mm, distance_range);
        for (const std::int64_t n : r_.pixels)
            if (all.empty() || all.back().where != "--pixels") value("--pixels", double(n), lenticular_pixel_range);
        value("--views", r_.views, lenticular_views_range);
        value("--pitch-mm", r_.pitch_mm, lenticular_pitch_range);
        value("--slant-deg", r_.slant_deg, lenticular_slant_range);
        value("--fov-deg", r_.fov_deg, lenticular_fov_range);
        value("--sheet-mm", r_.sheet_mm, sheet_range);
        value("--eye-distance-mm", r_.eyes_mm, eyes_range);
        if (r_.views && r_.pitch_mm) all.push_back({"--views, --pitch-mm", "both determine the lenses' pitch; give one of them"});
        if (r_.fov_deg && r_.sheet_mm)
            all.push_back(
                {"--fov-deg, --sheet-mm", "both determine the gap, since the panel is in the lenses' focus; give one of them"});
        if (r_.eyes_mm && (r_.fov_deg || r_.sheet_mm || r_.views != 2.))
            all.push_back({"--eye-distance-mm",
                           "directs the two views of --views 2 to a viewer's two eyes, and takes the place of --fov-deg and "
                           "--sheet-mm; leave it out"});
        if (r_.sheet_mm && r_.lens == LensType::ideal)
            all.push_back(
                {"--sheet-mm", "is the thickness of glass, which ideal lenses do not have; leave it out, or --lens ideal"});
        if (!all.empty()) throw InputError(std::move(all));
    }

    void make_panel() {
        const auto [columns, rows] = r_.pixels;
        a_ = to_nanometre(25.4 * r_.panel_inch / std::hypot(double(columns), double(rows)));
        d_.panel.pixels = r_.pixels;
        d_.panel.pixel_pitch_mm = a_;
        made_.two_view = r_.views == 2. && !r_.fov_deg && !r_.sheet_mm;
        slant_deg_ = r_.slant_deg.value_or(r_.views == 2. ? 0 : one_in_three_deg);
        cos_ = std::cos(slant_deg_ * degree);
        // Under slanted lenses colours change from row to row, so that they mix; upright lenses would show each eye one of them.
        if (slant_deg_ != 0) d_.panel.subpixels = SubpixelLayout::rgb_stripe;
        n_ = r_.lens == LensType::ideal ? 1 : pmma_index;
    }

    /// Returns tan(FOV/2).
    double slope() const { return std::tan(r_.fov_deg.value_or(usual_fov_deg) * degree / 2); }

    /// Chooses N where neither views nor pitch are given: two views from eye to eye over the field of view at the viewing
    /// distance, fewer if lenses would be wider than lens_arc_minutes there. The field of view of a given sheet is not known yet:
    /// D'/2 is taken for its width.
    void choose_views() {
        made_.views_rule = ViewsRule::asked;
        if (r_.views || r_.pitch_mm) return;
        const double D = r_.distance_mm, zone = 2 * D * (r_.sheet_mm ? 0.25 : slope());
        const double wanted = std::ceil(2 * zone / usual_eye_separation_mm),
                     most = std::floor(D * lens_arc_minutes * degree / 60 / a_);
        made_.views_rule = wanted <= most ? ViewsRule::eyes : ViewsRule::lenses;
        r_.views = std::clamp(std::min(wanted, most), 3., lenticular_views_range.high);
    }

    /// Finds g, E and the elemental pitch along the rows from the field of view, the sheet, or the eyes of two views. Strips are
    /// focused on the panel through their own glass, so that z_H' = n g and E = D' - n g.
    void find_gap() {
        const double D = r_.distance_mm;
        const auto eye = [&](double gap) { return D - n_ * gap; };
        if (r_.sheet_mm) {
            gap_ = *r_.sheet_mm / n_;
        } else if (made_.two_view) {
            // Neighbouring pixels are seen an eye's distance b apart, a E/g = b, so g = a D'/(b + n a).
            const double b = r_.eyes_mm.value_or(usual_eye_separation_mm);
            gap_ = a_ * D / (b + n_ * a_);
        } else {
            // tan(FOV/2) = p'/(2 g) along the rows, with p' = N a, or p (1 + g/E)/cos(slant) of a given pitch, by iteration.
            gap_ = r_.views ? *r_.views * a_ / (2 * slope()) : *r_.pitch_mm / (2 * slope() * cos_);
            for (int round = 0; round < 60 && r_.pitch_mm; ++round)
                gap_ = *r_.pitch_mm * (1 + gap_ / std::max(eye(gap_), D / 4)) / (2 * slope() * cos_);
        }
        gap_ = to_nanometre(gap_);
        if (!(n_ * gap_ <= D / 4))
            throw InputError(
                r_.sheet_mm   ? "--sheet-mm"
                : r_.pitch_mm ? "--pitch-mm"
                              : "--views",
                fmt::format("puts the lenses {:.4g} mm in front of the panel, more than a quarter of the way to the eye at {:g} mm",
                            n_ * gap_, D));
        eye_ = eye(gap_);
        pitch_ = to_nanometre(r_.pitch_mm ? *r_.pitch_mm : *r_.views * a_ * cos_ / (1 + gap_ / eye_));
        elemental_ = pitch_ * (1 + gap_ / eye_) / cos_;
        made_.gap_mm = gap_;
        made_.sheet_mm = n_ * gap_;
        made_.eye_mm = eye_;
        made_.views = r_.views ? *r_.views : elemental_ / a_;
        made_.view_step_mm = a_ * eye_ / gap_;
        made_.fov_deg = 2 * std::atan(elemental_ / (2 * gap_)) / degree;
        if (made_.views < lenticular_views_range.low * 0.999)
            throw InputError("--pitch-mm",
                             fmt::format("is {:g}, {:.3g} of the panel's pixels along a row; at least 2, which is {:.4g} mm",
                                         pitch_, made_.views, 2 * a_ * cos_));
    }

    /// Returns which option makes lenses less curved, and its limit: R = (n - 1) g >= p/2 needs g >= p/(2 (n - 1)).
    std::string least_curved() const {
        const double least = pitch_ / (2 * (n_ - 1));
        if (r_.sheet_mm) return fmt::format("--sheet-mm of at least {:.4g}", std::ceil(1000 * n_ * least) / 1000);
        if (made_.two_view) return fmt::format("--distance-mm of at least {:.4g}", std::ceil(least / gap_ * r_.distance_mm));
        return fmt::format("--fov-deg of at most {:.3g}", std::floor(20 * std::atan(elemental_ / (2 * least)) / degree) / 10);
    }

    /// Makes ideal lenses at the gap, or cylinders of glass on a sheet.
    void make_lenses() {
        d_.array.lattice = LatticeKind::strips;
        d_.array.aperture = Aperture::cell;
        d_.array.pitch_mm = pitch_;
        if (slant_deg_ != 0) d_.array.slant_deg = slant_deg_;
        if (r_.lens == LensType::ideal) {
            d_.lens.kind = IdealLens{{}, gap_};
            d_.array.gap_mm = gap_;
        } else {
            const std::optional<CylinderSheet> sheet = cylinder_sheet(pitch_, gap_, n_);
            if (!sheet)
                throw InputError(
                    r_.sheet_mm      ? "--sheet-mm"
                    : made_.two_view ? "--distance-mm"
                                     : "--fov-deg",
                    fmt::format("needs cylinders of a radius of {:.4g} mm, less than half the pitch of {:.4g} mm; possible is {}, "
                                "or --lens ideal",
                                (n_ - 1) * gap_, pitch_, least_curved()));
            d_.panel.layers = {{sheet->layer_mm, n_, {}}};
            d_.lens.kind = sheet->lens;
            d_.array.base_z_mm = sheet->layer_mm;
            d_.array.surround = Surround::plate;
        }
        place_lenses_on_pixels();
    }

    /// Chooses number and offset of upright lenses whose views are whole pixels such that the borders of elemental images fall
    /// between pixels. The border in the panel's middle is one of an even number of lenses; with an odd number, borders are half
    /// an elemental image beside the middle.
    void place_lenses_on_pixels() {
        d_.array.count = lens_count(d_.panel, d_.array);
        if (slant_deg_ != 0) return place_lenses_on_subpixels();
        const double N = std::round(made_.views);
        if (std::abs(made_.views - N) > 1e-3) return;
        std::int64_t& count = d_.array.count->at(0);
        const bool odd_panel = r_.pixels[0] % 2 == 1, odd_views = std::int64_t(N) % 2 == 1, odd_count = count % 2 == 1;
        if (odd_count != (odd_panel && odd_views)) ++count;
        if (odd_panel && !odd_views) d_.array.offset_mm = {to_nanometre(a_ / 2 / (1 + gap_ / eye_)), 0};
    }

    /// Moves slanted lenses whose elemental images' borders would fall on centres of subpixels. If from row to row lenses move by
    /// a multiple of 1/k of a subpixel, k at most 4, and elemental images are such a multiple wide, all centres lie at multiples
    /// of 1/k subpixel in their images: an offset of half of that keeps the borders clear of all of them.
    void place_lenses_on_subpixels() {
        const double lean = 3 * std::tan(slant_deg_ * degree), N = 3 * elemental_ / a_;  // in subpixels
        const auto [columns, rows] = r_.pixels;
        const auto count = double(d_.array.count->at(0));
        for (const int parts : {1, 2, 3, 4}) {
            // The distance of x from a multiple of 1/k, in units of 1/k; it adds up over rows and lenses.
            const auto off = [&](double x) { return std::abs(x * parts - std::round(x * parts)); };
            if (off(lean) * double(rows) > 0.2 || off(N) * count > 0.2) continue;
            const double first_row = rows % 2 == 0 ? 0.5 : 0, border = d_.array.count->at(0) % 2 == 0 ? 0 : N / 2;
            if (off(0.5 - 1.5 * double(columns) - lean * first_row - border) < 0.1)
                d_.array.offset_mm = {to_nanometre(a_ / 6 / parts / (1 + gap_ / eye_)), 0};
            return;
        }
    }

    /// Places camera and content. The box filter and the pupil replace the diffuser, which strips do not have.
    void place_camera_and_content() {
        const double width = double(r_.pixels[0]) * a_, height = double(r_.pixels[1]) * a_;
        // The camera is in the middle of a view; half-way between two views an eye would see both.
        d_.camera.position_mm = {made_.two_view ? rounded(made_.view_step_mm / 2) : 0, 0, r_.distance_mm};
        d_.camera.frame_width_mm = rounded(1.05 * std::max(width, height * 16 / 9));
        d_.camera.resolution = {1280, 720};
        d_.camera.pixel_filter = PixelFilter::box;
        d_.camera.pupil_diameter_mm = usual_pupil_mm;
        d_.content.depth_mm = 0;
        d_.content.height_mm = rounded(height / 2);
        d_.content.viewing_distance_mm = r_.distance_mm;
    }

    LenticularRequest r_;
    Lenticular made_{};
    Display d_;
    // a_: pixel pitch; n_: index of the sheet (1 for ideal lenses); gap_: g; eye_: E; pitch_: p; elemental_: p' along the rows;
    // all in mm
    double a_ = 0, slant_deg_ = 0, cos_ = 1, n_ = 1, gap_ = 0, eye_ = 0, pitch_ = 0, elemental_ = 0;
};

}  // namespace

Lenticular lenticular(const LenticularRequest& request) { return Design(request).make(); }

}  // namespace lfdsim
