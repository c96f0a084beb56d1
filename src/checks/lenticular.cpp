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
    const double half = pitch_mm / 2, R = to_nanometre(gap_mm * (index - 1));
    if (!(R >= half)) return {};
    // The wall under the caps is low, as the tracer wants it, and the rest of the sheet is a layer.
    const double wall = std::sqrt((R - half) * (R + half)), sag = R - wall;
    CylinderSheet sheet;
    sheet.lens.sphere_radius_mm = R;
    sheet.lens.cylinder_height_mm = to_nanometre(std::min(half / 2, wall));
    sheet.lens.index = index;
    sheet.layer_mm = to_nanometre(index * gap_mm - sag - sheet.lens.cylinder_height_mm);
    return sheet;
}

namespace {

constexpr double usual_fov_deg = 30, one_in_three_deg = 18.434949;
constexpr Range inch_range{0.1, 2000}, distance_range{5, 1e5}, lenticular_fov_range{1, 120}, lenticular_views_range{2, 1000},
    lenticular_slant_range{-60, 60}, lenticular_pitch_range{1e-3, 1e4}, sheet_range{1e-3, 1e4}, eyes_range{1, 1000},
    lenticular_pixel_range{fewest_views * fewest_lenses, 1e5};

class Design {
  public:
    explicit Design(const LenticularRequest& request) : r_(request) {}

    Lenticular make() {
        check();
        made_.request = r_;
        make_panel();
        choose_views();
        find_gap();
        make_lenses();
        make_ray_origin();
        if (const std::vector<Problem> problems = validate(d_); !problems.empty())
            throw InputError("--distance-mm", fmt::format("is {:g}, which gives no valid display: {} {}", r_.distance_mm,
                                                          problems[0].where, problems[0].what));
        made_.display = std::move(d_);
        return std::move(made_);
    }

  private:
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
        // Under lenses that lean each row shows other colours, so that they mix; upright lenses would show each eye one of them.
        if (slant_deg_ != 0) d_.panel.subpixels = SubpixelLayout::rgb_stripe;
        n_ = r_.lens == LensType::ideal ? 1 : pmma_index;
    }

    double slope() const { return std::tan(r_.fov_deg.value_or(usual_fov_deg) * degree / 2); }

    void choose_views() {
        made_.views_rule = ViewsRule::asked;
        if (r_.views || r_.pitch_mm) return;
        const double D = r_.distance_mm, zone = 2 * D * (r_.sheet_mm ? 0.25 : slope());
        const double wanted = std::ceil(2 * zone / usual_eyes_mm), most = std::floor(D * lens_arc_minutes * degree / 60 / a_);
        made_.views_rule = wanted <= most ? ViewsRule::eyes : ViewsRule::lenses;
        r_.views = std::clamp(std::min(wanted, most), 3., lenticular_views_range.high);
    }

    /// g, E and the pitch of the elemental images along the rows, which the field of view, the sheet or the eyes decide.
    void find_gap() {
        const double D = r_.distance_mm;
        const auto eye = [&](double gap) { return D - n_ * gap; };
        if (r_.sheet_mm) {
            gap_ = *r_.sheet_mm / n_;
        } else if (made_.two_view) {
            // Neighbouring pixels are seen an eye's distance b apart, a E/g = b.
            const double b = r_.eyes_mm.value_or(usual_eyes_mm);
            gap_ = a_ * D / (b + n_ * a_);
        } else {
            // tan(FOV/2) = p'/(2 g), along the rows; p' = N a, or p (1 + g/E)/cos(slant) of a given pitch.
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

    /// Which option makes lenses less curved, and its limit: g = p/(2 (n - 1)) is the least that cylinders can focus to.
    std::string least_curved() const {
        const double least = pitch_ / (2 * (n_ - 1));
        if (r_.sheet_mm) return fmt::format("--sheet-mm of at least {:.4g}", std::ceil(1000 * n_ * least) / 1000);
        if (made_.two_view) return fmt::format("--distance-mm of at least {:.4g}", std::ceil(least / gap_ * r_.distance_mm));
        return fmt::format("--fov-deg of at most {:.3g}", std::floor(20 * std::atan(elemental_ / (2 * least)) / degree) / 10);
    }

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

    /// Upright lenses over whole pixels: the borders of elemental images must fall between pixels. That in the panel's middle is
    /// one of an even number of lenses; with an odd one they are half an elemental image beside it.
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

    /// Lenses that lean: where from row to row they move by a simple part of a subpixel, and their elemental images are as many
    /// parts wide, the places of subpixels' centres in them are multiples of that part. Those on a border move half of it away.
    void place_lenses_on_subpixels() {
        const double lean = 3 * std::tan(slant_deg_ * degree), N = 3 * elemental_ / a_;  // in subpixels
        const auto [columns, rows] = r_.pixels;
        const auto count = double(d_.array.count->at(0));
        for (const int parts : {1, 2, 3, 4}) {
            const auto off = [&](double x) { return std::abs(x * parts - std::round(x * parts)); };
            if (off(lean) * double(rows) > 0.2 || off(N) * count > 0.2) continue;
            const double first_row = rows % 2 == 0 ? 0.5 : 0, border = d_.array.count->at(0) % 2 == 0 ? 0 : N / 2;
            if (off(0.5 - 1.5 * double(columns) - lean * first_row - border) < 0.1)
                d_.array.offset_mm = {to_nanometre(a_ / 6 / parts / (1 + gap_ / eye_)), 0};
            return;
        }
    }

    void make_ray_origin() {
        const double width = double(r_.pixels[0]) * a_, height = double(r_.pixels[1]) * a_;
        // Between two views an eye would see both.
        d_.camera.position_mm = {made_.two_view ? rounded(made_.view_step_mm / 2) : 0, 0, r_.distance_mm};
        d_.camera.frame_width_mm = rounded(1.05 * std::max(width, height * 16 / 9));
        d_.camera.resolution = {1280, 720};
        d_.camera.pixel_filter = PixelFilter::box;
        d_.camera.pupil_diameter_mm = pupil_mm;
        d_.content.depth_mm = 0;
        d_.content.height_mm = rounded(height / 2);
        d_.content.viewing_distance_mm = r_.distance_mm;
    }

    LenticularRequest r_;
    Lenticular made_{};
    Display d_;
    double a_ = 0, slant_deg_ = 0, cos_ = 1, n_ = 1, gap_ = 0, eye_ = 0, pitch_ = 0, elemental_ = 0;
};

}  // namespace

Lenticular lenticular(const LenticularRequest& request) { return Design(request).make(); }

}  // namespace lfdsim
