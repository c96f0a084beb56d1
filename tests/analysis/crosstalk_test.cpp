// Crosstalk against closed forms: boxes convolved.
#include "analysis/crosstalk.h"

#include <gtest/gtest.h>

#include "../engine/pictures.h"
#include "analysis/slope_spread.h"

namespace lfdsim {
namespace {

constexpr double eye_mm = 600, gap = 8, pitch = 4, pixel = 0.2;

/// 61 x 31 ideal square lenses of 20 views, seen from the distance that their elemental images are made for; the panel is imaged to
/// L from the lenses.
Display display(double central_depth_mm) {
    Display d;
    d.panel.pixels = {1300, 700};
    d.panel.pixel_pitch_mm = pixel;
    d.lens.type = LensType::ideal;
    d.lens.focal_length_mm = 1 / (1 / gap + 1 / central_depth_mm);
    d.array.count = {61, 31};
    d.array.pitch_mm = pitch;
    d.array.gap_mm = gap;
    d.array.aperture = Aperture::square;
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

TEST(Crosstalk, NoneWhereTheLensIsSharpAtTheEye) {
    const Json figures = measured(display(eye_mm)).figures;
    EXPECT_EQ(figures.at("between_views").at("middle_view"), 0);
    EXPECT_EQ(figures.at("between_views").at("median_view"), 0);
    EXPECT_LT(figures.at("between_views").at("theory"), 1e-9);
    EXPECT_EQ(figures.at("between_eyes").at("left_eye"), 0);
    EXPECT_EQ(figures.at("between_eyes").at("right_eye"), 0);
    EXPECT_NE(figures.at("definition").get<std::string>().find("(leak - black) / (signal - black)"), std::string::npos);
}

TEST(Crosstalk, OfApertureAndBoxDiffuserIsTheirConvolution) {
    for (const double central : {300., 1e9}) {
        for (const double angle : {0., 1., 4.}) {
            for (const double apart : {20., 65.}) {
                Display d = display(central);
                constexpr double above = 100;
                if (angle > 0) d.diffuser = Diffuser{above, {angle, 2}, Profile::box};
                const double aperture = pitch * std::abs(1 / eye_mm - 1 / central),
                             diffuser = 2 * std::tan(angle / 2 * degree) * (1 - above / eye_mm), view = pixel / gap;
                const double signal = below(view / 2, aperture, diffuser) - below(-view / 2, aperture, diffuser);
                const double leak = 1 - below(apart / 2 / eye_mm, aperture, diffuser);
                const Json figures = measured(d, apart).figures;
                const double views = figures.at("between_views").at("middle_view"),
                             eyes = figures.at("between_eyes").at("left_eye");
                EXPECT_NEAR(views, (1 - signal) / signal, 0.02 * (1 - signal) / signal + 0.002) << central << " " << angle;
                EXPECT_NEAR(eyes, leak / (1 - leak), 0.03 * leak / (1 - leak) + 0.001) << central << " " << angle << " " << apart;
                EXPECT_NEAR(double(figures.at("between_views").at("theory")), (1 - signal) / signal,
                            0.01 * (1 - signal) / signal + 1e-9);
                EXPECT_NEAR(double(figures.at("between_eyes").at("theory")), leak / (1 - leak), 0.01 * leak / (1 - leak) + 1e-9);
            }
        }
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
        const double wrong_left = 1 - below((30 - head[n]) / eye_mm, aperture, diffuser),
                     wrong_right = below((-30 - head[n]) / eye_mm, aperture, diffuser);
        if (wrong_left > 0.9 || wrong_right > 0.9) continue;
        EXPECT_NEAR(left[n] / (1 + left[n]), wrong_left, 0.01) << head[n];
        EXPECT_NEAR(right[n] / (1 + right[n]), wrong_right, 0.01) << head[n];
        ++compared;
    }
    EXPECT_GT(compared, 20);
}

// Sums of random numbers of the three spreads.
TEST(SlopeSpread, IsThatOfRandomSlopes) {
    Display d = display(200);
    d.array.aperture = Aperture::circle;
    d.lens.aperture_radius_mm = 1.8;
    d.diffuser = Diffuser{90, {2.5, 1}, Profile::gaussian};
    d.content.viewing_distance_mm = 900;
    const Subject subject(d, {}, {});
    const SlopeSpread spread(subject, eye_mm);
    std::mt19937_64 engine(4);
    std::normal_distribution<double> normal(0, 2 * std::tan(1.25 * degree) / std::sqrt(8 * std::log(2.)));
    Random random(5);
    int in = 0, above = 0;
    constexpr int all = 1000000;
    for (int n = 0; n < all; ++n) {
        double q, other;
        do q = random(-1.8, 1.8), other = random(-1.8, 1.8);
        while (q * q + other * other > 1.8 * 1.8);
        const double slope =
            q * (1 / 200. - 1 / eye_mm) + normal(engine) * (1 - 90 / eye_mm) + random(-122, 122) * (1 / eye_mm - 1 / 892.);
        in += std::abs(slope) < 0.02;
        above += slope > 0.03;
    }
    EXPECT_NEAR(spread.within(-0.02, 0.02), double(in) / all, 0.003);
    EXPECT_NEAR(spread.within(0.03, INFINITY), double(above) / all, 0.003);
    EXPECT_NEAR(spread.within(-INFINITY, INFINITY), 1, 1e-9);
}

// What has no light has no crosstalk either: null in JSON, and nothing fails.
TEST(Crosstalk, OfADarkDisplayIsNone) {
    Display d = display(300);
    d.array.offset_mm = {600, 0};  // beside the panel
    const Json figures = measured(d).figures;
    EXPECT_TRUE(figures.at("between_views").at("middle_view").is_null());
    EXPECT_TRUE(figures.at("between_eyes").at("left_eye").is_null());
}

}  // namespace
}  // namespace lfdsim
