// Crosstalk against closed forms: boxes convolved.
#include "analysis/crosstalk/crosstalk.h"

#include <gtest/gtest.h>

#include <functional>

#include "../engine/pictures.h"
#include "analysis/crosstalk/intended_light.h"
#include "analysis/crosstalk/slope_spread.h"

namespace lfdsim {
namespace {

constexpr double eye_mm = 600, gap = 8, pitch = 4, pixel = 0.2;

/// 61 x 31 ideal square lenses of 20 views, seen from the distance that their elemental images are made for; the panel is imaged to
/// L from the lenses.
Display display(double central_depth_mm) {
    Display d;
    d.panel.pixels = {1301, 700};
    d.panel.pixel_pitch_mm = pixel;
    d.lens.kind = IdealLens{{}, 1 / (1 / gap + 1 / central_depth_mm)};
    d.array.count = {61, 31};
    d.array.pitch_mm = pitch;
    d.array.gap_mm = gap;
    d.array.aperture = Aperture::cell;
    d.camera.position_mm = {0, 0, eye_mm + gap};
    d.content.viewing_distance_mm = eye_mm + gap;
    return d;
}

Result measured(const Display& d, double eyes_apart = 65) {
    AnalysisOptions options;
    options.eye_distance_mm = eyes_apart;
    Subject subject(d, {}, options);
    Job job;
    return measure_crosstalk(subject, job);
}

/// Share of the sum of two even spreads of full widths a and b about 0 that is less than x: the integral of their trapezium.
double below(double x, double a, double b) {
    const auto ramp = [](double t) { return t > 0 ? 0.5 * t * t : 0; };
    if (b < a) std::swap(a, b);
    if (a == 0) return std::clamp(x / b + 0.5, 0., 1.);
    return (ramp(x + (a + b) / 2) - ramp(x + (b - a) / 2) - ramp(x + (a - b) / 2) + ramp(x - (a + b) / 2)) / (a * b);
}

/// Share of the light of an eye at x that pixels shine which are meant for slopes from low to high: through each lens it sees
/// slopes about x/E, the sum of two even spreads, and a pixel is meant for the slope of its centre.
double meant(double x, double low, double high, double aperture, double diffuser) {
    constexpr double scale = 1 + gap / eye_mm;
    double sum = 0;
    for (int lens = -30; lens <= 30; ++lens) {
        const double centre = scale * pitch * lens;                                               // of its elemental image
        const auto border = [&](int column) { return (centre - pixel * (column - 0.5)) / gap; };  // as a slope
        for (int column = -650; column <= 650; ++column) {
            const double slope = 0.5 * (border(column) + border(column + 1));
            const double inside = std::min(slope - low, high - slope);
            if (std::abs(slope) > 0.5 * scale * pitch / gap || inside < -1e-9) continue;
            sum += (inside < 1e-9 ? 0.5 : 1) *  // half of what lies on the border of two views
                   (below(border(column) - x / eye_mm, aperture, diffuser) -
                    below(border(column + 1) - x / eye_mm, aperture, diffuser));
        }
    }
    return sum / 61;
}

TEST(Crosstalk, NoneWhereTheLensIsSharpAtTheEye) {
    const Json figures = measured(display(eye_mm)).figures, views = figures.at("between_views"), eyes = figures.at("between_eyes");
    for (const char* name :
         {"woods_percent", "iec_62629_22_1_percent", "idms_percent", "median_view_percent", "worst_view_percent"})
        EXPECT_EQ(views.at(name), 0) << name;
    EXPECT_GT(views.at("woods_percent_error"), 0);  // a few lines of sight more might have told otherwise
    EXPECT_LT(views.at("woods_percent_error"), 0.01);
    EXPECT_LT(views.at("theory_percent"), 1e-9);
    EXPECT_EQ(views.at("whole_views"), 19);  // of 20.07 the outermost are half views
    EXPECT_EQ(eyes.at("left_eye_percent"), 0);
    EXPECT_EQ(eyes.at("right_eye_percent"), 0);
    EXPECT_EQ(figures.at("definitions").size(), 3u);
}

TEST(Crosstalk, OfApertureAndBoxDiffuserIsTheirConvolution) {
    for (const double central : {300., 1e9}) {
        for (const double angle : {0., 1., 4.}) {
            for (const double apart : {central < 1e6 ? 20. : 65.}) {
                Display d = display(central);
                constexpr double above = 100;
                if (angle > 0) d.diffuser = Diffuser{above, {angle, 2}, Profile::box};
                const double aperture = pitch * std::abs(1 / eye_mm - 1 / central),
                             diffuser = 2 * std::tan(angle / 2 * degree) * (1 - above / eye_mm), view = pixel / gap;
                const double signal = meant(0, -view / 2, view / 2, aperture, diffuser);
                const double leak = meant(-apart / 2, 0, 1, aperture, diffuser);
                const Json figures = measured(d, apart).figures;
                const Json views = figures.at("between_views"), eyes = figures.at("between_eyes");
                const auto near = [&](const Json& json, const std::string& name, double share, double tolerance) {
                    const double percent = 100 * (1 - share) / share, found = json.at(name + "_percent");
                    const double error = json.at(name + "_percent_error"), theory = json.at("theory_percent");
                    EXPECT_NEAR(found, percent, tolerance * percent + 0.1)
                        << name << " " << central << " " << angle << " " << apart;
                    EXPECT_NEAR(found, theory, error + 0.005 * theory) << name << " " << central << " " << angle << " " << apart;
                    EXPECT_LT(error, 0.03 * percent + 0.03) << name;
                };
                near(views, "woods", signal, 0.03);
                near(eyes, "left_eye", 1 - leak, 0.04);
                EXPECT_EQ(eyes.at("left_eye_percent"), eyes.at("right_eye_percent"));
                EXPECT_LT(views.at("worst_view_percent"), 3 * double(views.at("woods_percent")) + 1);
            }
        }
    }
}

/// Upright lenses `images` pixels wide for eyes at 600 mm, in focus on stripes of red, green and blue.
Display aligned(int images) {
    Display d;
    d.panel.pixels = {240, 20};
    d.panel.pixel_pitch_mm = 0.155658;
    d.panel.subpixels = SubpixelLayout::rgb_stripe;
    d.lens.kind = IdealLens{{}, 1.4368};
    d.array.lattice = LatticeKind::strips;
    d.array.pitch_mm = std::round(1e6 * images * 0.155658 * (1 - 1.4368 / 600)) * 1e-6;
    d.array.gap_mm = 1.4368;
    d.array.aperture = Aperture::cell;
    d.camera.position_mm = {0, 0, 600};
    d.content.viewing_distance_mm = 600;
    return d;
}

// Lenses that are aligned with pixels: views are where pixels are, and not where the rounding of a pitch puts halves of them.
TEST(Crosstalk, OfAlignedLensesIsNone) {
    for (const int images : {2, 3, 8}) {
        const Result result = measured(aligned(images));
        const Json& views = result.figures.at("between_views");
        for (const Json& found : {views, views.at("other_sampling")}) {
            EXPECT_LT(found.at("woods_percent"), 0.5) << images;
            EXPECT_LT(found.at("theory_percent"), 0.5) << images;
        }
        EXPECT_LT(views.at("worst_view_percent"), 1.5) << images;
        EXPECT_GE(views.at("whole_views"), images - 1) << images;
    }
}

// A figure of pixels that rounding gives to one of two lenses covers what it is with either, or it is null. Lenses an odd number of
// pixels wide, in odd numbers, have their borders on pixels' centres where columns are even.
TEST(Crosstalk, ErrorsCoverBothLensesOfPixelsOnABorder) {
    int known = 0, unknown = 0;
    for (const LatticeKind lattice : {LatticeKind::strips, LatticeKind::square, LatticeKind::hexagon, LatticeKind::brick})
        for (const SubpixelLayout subpixels : {SubpixelLayout::none, SubpixelLayout::rgb_rows})
            for (const int images : {3, 9}) {
                Display d = aligned(images);
                d.panel.subpixels = subpixels;
                d.array.lattice = lattice;
                d.array.count = {lattice == LatticeKind::strips || lattice == LatticeKind::square ? 21 : 20, 15};
                if (lattice == LatticeKind::strips) d.array.count = {21, 1};
                d.array.pitch_mm = images * d.panel.pixel_pitch_mm * (1 - 1.4368 / 600);
                const MetPlaces lit(LineSets(512, 0), 1, [&](const Choice& c, std::size_t) {
                    return MetPlaces::Met{8 * d.panel.pixel_pitch_mm * images * c[0], 9 * d.panel.pixel_pitch_mm * c[1], 1};
                });
                const double step = d.panel.pixel_pitch_mm / 1.4368;
                const auto percents = [&](double moved) {
                    d.array.offset_mm[0] = moved;
                    const MeantLight light(lit, {luminance_weights}, MeantPanel(d, resolve(d), ContentSampling::subpixel));
                    std::vector<Crosstalk> found;
                    for (const double from : {-100., -0.4 * images, -2., 0.2, 0.3 * images})
                        found.push_back(
                            crosstalk_of(light.between(-1, from * step), light.between(from * step, 1), light.missed()));
                    return found;
                };
                const std::vector<Crosstalk> border = percents(0), left = percents(-1e-5), right = percents(1e-5);
                for (std::size_t k = 0; k < border.size(); ++k) {
                    (border[k].left_to_rounding ? unknown : known)++;
                    if (border[k].left_to_rounding) continue;
                    for (const Crosstalk& beside : {left[k], right[k]}) {
                        EXPECT_FALSE(beside.left_to_rounding);
                        EXPECT_NEAR(border[k].percent.value, beside.percent.value, border[k].percent.error + 1e-9)
                            << int(lattice) << " " << images << " " << k;
                    }
                }
            }
    EXPECT_GT(known, 40);
    EXPECT_GT(unknown, 10);
}

// Two views: each pixel but the middle one of its image stands on a border.
TEST(Crosstalk, OfTwoViewsOnOddColumnsIsLeftToRounding) {
    Display d = aligned(2);
    d.panel.pixels[0] = 241;  // and a pitch to the nanometre
    d.panel.subpixels = SubpixelLayout::none;
    const Result result = measured(d);
    const Json& eyes = result.figures.at("between_eyes");
    for (const char* name : {"left_eye_percent", "right_eye_percent", "theory_percent"}) {
        EXPECT_TRUE(eyes.at(name).is_null()) << name << eyes.at(name);
        EXPECT_NE(result.notes.at(std::string("between_eyes.") + name).get<std::string>().find("border"), std::string::npos);
    }
    EXPECT_NE(result.notes.at("between_eyes.head_within_10_percent_mm").get<std::string>().find("border"), std::string::npos);
    d.array.offset_mm[0] = 0.5 * d.panel.pixel_pitch_mm;
    EXPECT_LT(measured(d).figures.at("between_eyes").at("left_eye_percent"), 0.5);
}

// Half of E p'/g = 129.69 mm less half of the eyes' distance; what one lens spreads over is 0.3 mm of that.
TEST(Crosstalk, HeadOfTwoViewsMovesToTheViewsBorder) {
    const Json eyes = measured(aligned(2)).figures.at("between_eyes"), range = eyes.at("head_within_10_percent_mm"),
               error = eyes.at("head_within_10_percent_mm_error");
    for (const std::size_t side : {0u, 1u}) {
        EXPECT_NEAR(std::abs(range[side].get<double>()), 32.35, error[side].get<double>() + 0.1);
        EXPECT_LT(error[side], 0.5);
    }
}

// On the axis each of these lenses shows red beside blue.
TEST(Crosstalk, WhiteIsMeasuredInAllColours) {
    Display d = aligned(2);
    d.panel.pixels[0] = 40;
    d.camera.resolution = {80, 45};
    Subject subject(d, {}, {});
    EXPECT_NEAR(subject.white_field(Job()), 1, 0.05);
}

// A pinhole of the radius r before the panel spreads an eye's light evenly over 2 r (1/E + 1/g).
TEST(Crosstalk, OfABarrierIsItsSlitsWidth) {
    Display d = aligned(9);
    d.panel.subpixels = SubpixelLayout::none;
    d.lens.kind = Pinhole{0.25};
    d.array.aperture = Aperture::circle;
    const double width = 2 * 0.25 * (1 / (600 - 1.4368) + 1 / 1.4368), share = d.panel.pixel_pitch_mm / 1.4368 / width;
    const Json views = measured(d).figures.at("between_views");
    EXPECT_NEAR(views.at("theory_percent"), 100 * (1 - share) / share, 2);
    EXPECT_NEAR(views.at("woods_percent"), 100 * (1 - share) / share, 2 + double(views.at("woods_percent_error")));
}

// Where crosstalk is just below what is tolerable, the head's range is as short as the step of its search.
TEST(Crosstalk, ARangeAsShortAsItsErrorIsNone) {
    Display d = aligned(9);
    d.panel.subpixels = SubpixelLayout::none;
    d.lens.kind = Pinhole{0.094};
    d.array.aperture = Aperture::circle;
    const Result result = measured(d);
    EXPECT_NEAR(result.figures.at("between_eyes").at("left_eye_percent"), 9.4, 0.3);
    for (const Json& end : result.figures.at("between_eyes").at("head_within_10_percent_mm")) EXPECT_TRUE(end.is_null()) << end;
    EXPECT_NE(result.notes.at("between_eyes.head_within_10_percent_mm").get<std::string>().find("than its error"),
              std::string::npos);
}

// The worst of many views that are alike is as bad as each of them.
TEST(Crosstalk, OfTheWorstViewIsNotThatOfTheNoise) {
    Display d = display(20);
    d.panel.pixels = {1237, 700};
    const double spread = pitch * (1 / 20. - 1 / eye_mm), view = pixel / gap, share = view / spread;
    for (std::int64_t seed = 0; seed < 3; ++seed) {
        d.render.seed = seed;
        const Json views = measured(d).figures.at("between_views");
        const double worst = views.at("worst_view_percent"), error = views.at("worst_view_percent_error");
        EXPECT_NEAR(worst, 100 * (1 - share) / share, error + 0.01 * worst) << seed;
        EXPECT_LT(error, 0.1 * worst) << seed;
    }
}

// A head that has moved by half the eyes' distance has one eye before the middle, where both sides are seen alike.
TEST(Crosstalk, FollowsTheHead) {
    Display d = display(300);
    d.diffuser = Diffuser{100, {4, 2}, Profile::box};
    const Result result = measured(d, 60);
    const auto table =
        std::find_if(result.tables.begin(), result.tables.end(), [](const DataTable& t) { return t.name == "crosstalk_eyes"; });
    ASSERT_NE(table, result.tables.end());
    const std::vector<double>&head = table->columns[0].values, &left = table->columns[1].values, &right = table->columns[2].values;
    const double aperture = pitch * (1 / 300. - 1 / eye_mm), diffuser = 2 * std::tan(2 * degree) * (1 - 100 / eye_mm);
    int compared = 0;
    for (std::size_t n = 0; n < head.size(); ++n) {
        const double wrong_left = meant(head[n] - 30, 0, 1, aperture, diffuser),
                     wrong_right = meant(head[n] + 30, -1, 0, aperture, diffuser);
        if (wrong_left > 0.9 || wrong_right > 0.9) continue;
        EXPECT_NEAR(left[n] / (100 + left[n]), wrong_left, 0.01) << head[n];
        EXPECT_NEAR(right[n] / (100 + right[n]), wrong_right, 0.01) << head[n];
        ++compared;
    }
    EXPECT_GT(compared, 20);
}

TEST(Crosstalk, TheSeedChoosesTheLines) {
    Display d = display(300);
    d.diffuser = Diffuser{100, {4, 2}, Profile::box};
    const auto middle = [&](std::int64_t seed) {
        d.render.seed = seed;
        const Json views = measured(d).figures.at("between_views");
        return std::array<double, 2>{views.at("woods_percent"), views.at("woods_percent_error")};
    };
    const auto a = middle(1), b = middle(2), again = middle(1);
    EXPECT_EQ(a, again);
    EXPECT_NE(a[0], b[0]);
    EXPECT_NEAR(a[0], b[0], 1.5 * std::hypot(a[1], b[1]));
}

// Thick glass below fast lenses bends steep lines less than in proportion: paraxially the middle view would have all the light.
TEST(Crosstalk, BelowThinLensesTheoryKnowsLayers) {
    Display d = display(eye_mm);
    d.panel.layers = {{9, 1.5}};
    d.content.viewing_distance_mm = d.camera.position_mm[2] = eye_mm + 9 + (gap - 6);
    const auto share = [](const Json& percent) { return 100 / (100 + double(percent)); };
    for (const LatticeKind kind : {LatticeKind::square, LatticeKind::hexagon, LatticeKind::strips}) {
        d.array.lattice = kind;
        d.array.count = {61, kind == LatticeKind::strips ? 1 : 35};
        d.array.rotation_deg = kind == LatticeKind::strips ? -12 : 0;
        const Json views = measured(d).figures.at("between_views");
        EXPECT_NEAR(share(views.at("woods_percent")), share(views.at("theory_percent")), 0.005) << int(kind);
        EXPECT_LT(share(views.at("theory_percent")), 0.99) << int(kind);
    }
}

// Theory is each eye's own: a shift takes content from one eye to the other, not back.
TEST(Crosstalk, TheoryIsOfEachEye) {
    Display d = display(1e9);
    d.errors.shift_mm = {0.1, 0};
    const Json eyes = measured(d, 20).figures.at("between_eyes");
    for (const std::string name : {"left_eye_", "right_eye_"}) {
        const double percent = eyes.at(name + "percent");
        EXPECT_NEAR(percent, eyes.at(name + "theory_percent"), 0.01 * percent + double(eyes.at(name + "percent_error"))) << name;
    }
    EXPECT_GT(eyes.at("right_eye_theory_percent"), 1.5 * double(eyes.at("left_eye_theory_percent")));
    EXPECT_EQ(eyes.at("theory_percent"), eyes.at("right_eye_theory_percent"));
}

// What is infinite has no error, and says so; so does what no light decides, for its error, too.
TEST(Crosstalk, NoNullWithoutAReason) {
    Display d = display(eye_mm);
    d.errors.shift_mm = {0.5 * pitch, 0};
    const Result result = measured(d);
    const std::function<void(const Json&, const std::string&)> look = [&](const Json& json, const std::string& path) {
        for (const auto& [key, value] : json.items()) {
            const std::string at = path.empty() ? key : path + "." + key;
            if (value.is_object()) look(value, at);
            if (value.is_null()) {
                EXPECT_TRUE(result.notes.contains(at) || result.notes.contains(at.substr(0, at.rfind("_error")))) << at;
            }
        }
    };
    look(result.figures, "");
    EXPECT_EQ(result.figures.at("between_eyes").at("left_eye_percent"), "infinite");
    EXPECT_EQ(result.figures.at("between_views").at("woods_percent"), "infinite");
}

// A near eye's zone is narrower than the eyes are apart.
TEST(Crosstalk, OfEyesThatDoNotShareAZoneIsUndefined) {
    Display d = display(eye_mm);
    d.content.viewing_distance_mm = d.camera.position_mm[2] = gap + 18;
    const Result result = measured(d);
    const Json& figures = result.figures;
    EXPECT_TRUE(figures.at("between_eyes").at("left_eye_percent").is_null());
    EXPECT_TRUE(figures.at("between_eyes").at("theory_percent").is_null());
    EXPECT_NE(result.notes.at("between_eyes").get<std::string>().find("own display"), std::string::npos);
    EXPECT_TRUE(figures.at("between_views").at("woods_percent").is_number());
}

// Random lines of sight of an eye aside, turned by their angles themselves, dark where they come down beside the array.
TEST(SlopeSpread, IsThatOfRandomLines) {
    Display d = display(200);
    d.array.aperture = Aperture::circle;
    d.lens.as<IdealLens>().aperture_radius_mm = 1.8;
    d.content.viewing_distance_mm = 900;
    for (const Profile profile : {Profile::box, Profile::gaussian}) {
        d.diffuser = Diffuser{90, {6, 1}, profile};
        const Subject subject(d, {}, {});
        const SlopeSpread spread(subject, eye_mm);
        constexpr double x = 40, made_for = 892, half_array = 122;
        std::mt19937_64 engine(4);
        std::normal_distribution<double> normal(0, 3 * degree / std::sqrt(2 * std::log(2.)));
        Random random(5);
        int in = 0, above = 0, all = 0;
        for (int n = 0; n < 1000000; ++n) {
            double q, other;
            do q = random(-1.8, 1.8), other = random(-1.8, 1.8);
            while (q * q + other * other > 1.8 * 1.8);
            const double aimed = random(-half_array, half_array), slope = (aimed - x) / eye_mm,
                         turned = std::tan(std::atan(slope) + (profile == Profile::box ? random(-3, 3) * degree : normal(engine)));
            const double down = aimed + 90 * (turned - slope);
            if (std::abs(down) > half_array) continue;
            const double seen = q * (1 / eye_mm - 1 / 200.) + down / made_for - turned;
            ++all;
            in += std::abs(seen - x / eye_mm) < 0.02;
            above += seen > 0.1;
        }
        EXPECT_NEAR(spread.within(x, x / eye_mm - 0.02, x / eye_mm + 0.02), double(in) / all, 0.002);
        EXPECT_NEAR(spread.within(x, 0.1, INFINITY), double(above) / all, 0.002);
        EXPECT_NEAR(spread.within(x, -INFINITY, INFINITY), 1, 1e-9);
    }
}

// What has no light has no crosstalk either: null in JSON, and nothing fails.
TEST(Crosstalk, OfADarkDisplayIsNone) {
    Display d = display(300);
    d.array.offset_mm = {600, 0};  // beside the panel
    const Result result = measured(d);
    const Json& figures = result.figures;
    EXPECT_TRUE(figures.at("between_views").at("woods_percent").is_null());
    EXPECT_TRUE(figures.at("between_eyes").at("left_eye_percent").is_null());
    EXPECT_TRUE(result.notes.contains("between_views"));
}

}  // namespace
}  // namespace lfdsim
