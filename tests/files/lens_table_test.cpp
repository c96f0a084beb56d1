// Errors of single lenses: what is drawn, and tables of them.
#include "files/lenses/lens_table.h"

#include "files/description/display_file.h"
#include "geometry/geometry.h"
#include "geometry/lens_misalignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace lfdsim {
namespace {

constexpr const char* description = R"(schema = 1
[panel]
pixels = [480, 270]
pixel_pitch_mm = 0.1
[lens]
type = "ideal"
aperture_radius_mm = 0.45
focal_length_mm = 3.0
[array]
count = [48, 27]
pitch_mm = 1.0
gap_mm = 3.2
)";

class LensTable : public testing::Test {
  protected:
    LensTable() { std::filesystem::create_directories(folder_); }
    ~LensTable() override { std::filesystem::remove_all(folder_); }

    Display with(const std::string& errors) const { return parse_display(description + errors, "test", {}, folder_); }
    void write(const std::string& text) const { std::ofstream(folder_ / "lenses.csv") << text; }
    /// What reading a table of this text says, or nothing.
    std::string said(const std::string& text) const {
        write(text);
        try {
            with("[errors]\ntable = \"lenses.csv\"\n");
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }

    // Tests run beside each other, each in a process of its own.
    const std::filesystem::path folder_ =
        std::filesystem::path(testing::TempDir()) /
        (std::string("lfdsim_lens_table_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

constexpr const char* header = "i,j,dx_mm,dy_mm,dz_mm,tilt_x_deg,tilt_y_deg,curvature\n";

TEST_F(LensTable, ReadBackHasTheSameBits) {
    const Display drawn =
        with("[errors]\ndecenter_sd_mm = 0.004\nheight_sd_mm = 0.003\ntilt_sd_deg = 0.1\ncurvature_sd = 0.01\nseed = 5\n");
    write(write_lens_table(drawn));
    const Display read = with("[errors]\ntable = \"lenses.csv\"\n");
    const Lattice<double> lattice = resolve(drawn).lattice;
    EXPECT_EQ(lens_errors(drawn, lattice), lens_errors(read, lattice));
}

TEST_F(LensTable, AddsToWhatIsDrawn) {
    write(std::string(header) + "3,2,0.001,-0.002,0.003,0.1,-0.2,0.01\n");
    const Display both = with("[errors]\ndecenter_sd_mm = 0.004\nseed = 5\ntable = \"lenses.csv\"\n"),
                  drawn = with("[errors]\ndecenter_sd_mm = 0.004\nseed = 5\n");
    const Lattice<double> lattice = resolve(drawn).lattice;
    std::vector<LensError> expected = lens_errors(drawn, lattice);
    LensError& lens = expected[2 * 48 + 3];
    lens = {{lens.aside_mm[0] + 0.001, lens.aside_mm[1] - 0.002}, 0.003, {0.1, -0.2}, 0.01};
    EXPECT_EQ(lens_errors(both, lattice), expected);
}

TEST_F(LensTable, DrawsTruncatedNormalNumbers) {
    // Of a normal distribution cut at three standard deviations: variance 1 - 6 phi(3) / (2 Phi(3) - 1) = 0.97333.
    Display d = with("[errors]\ndecenter_sd_mm = 0.01\n");
    double sum = 0, squares = 0, most = 0;
    std::int64_t count = 0, within = 0;
    for (d.errors.seed = 0; d.errors.seed < 40; ++d.errors.seed)
        for (const LensError& e : lens_errors(d, resolve(d).lattice))
            for (const double x : e.aside_mm) {
                sum += x / 0.01;
                squares += x / 0.01 * x / 0.01;
                most = std::max(most, std::abs(x) / 0.01);
                within += std::abs(x) < 0.01;
                ++count;
            }
    const double n = double(count), four_sigma = 4 / std::sqrt(n);
    EXPECT_NEAR(sum / n, 0, four_sigma);
    EXPECT_NEAR(squares / n, 0.97333, 1.4 * four_sigma);
    EXPECT_NEAR(double(within) / n, 0.682689 / 0.997300, 0.5 * four_sigma);
    EXPECT_LE(most, 3);
    EXPECT_GT(most, 2.9);
}

TEST_F(LensTable, RefusesWithTheLine) {
    EXPECT_EQ(said(std::string(header) + "3,2,0.001,0,0,0,0,0\n"), "");
    EXPECT_EQ(said("\xef\xbb\xbf"
                   "curvature,j,i,dx_mm,dy_mm,dz_mm,tilt_x_deg,tilt_y_deg\r\n0,2,3,+0.001,0,0,0,0\r\n\r\n"),
              "");
    const auto expect = [&](const std::string& text, const std::string& part) {
        const std::string found = said(text);
        EXPECT_NE(found.find(part), std::string::npos) << found;
    };
    expect("", "lenses.csv");
    expect("i,j,dx_mm,dy_mm,dz_mm,tilt_x_deg,tilt_y_deg\n", "lenses.csv:1: the column curvature is missing");
    expect("i,j,dx_mm,dy_mm,dz_mm,tilt_x_deg,tilt_y_deg,curvatur\n", "did you mean curvature?");
    EXPECT_EQ(said("i;j;dx_mm;dy_mm\n1;2;0;0\n").find('\n'), std::string::npos);  // one fault, not one for each column, too
    expect(std::string(header) + "48,2,0,0,0,0,0,0\n", "lenses.csv:2: there is no lens i = 48");
    expect(std::string(header) + "-1,2,0,0,0,0,0,0\n", "lenses.csv:2: there is no lens i = -1");
    expect(std::string(header) + "1.5,2,0,0,0,0,0,0\n", "whole numbers");
    expect(std::string(header) + "1,2,0,0,0,0,0,0\n2,2,0,0,0,0,0,0\n1,2,0,0,0,0,0,0\n",
           "lenses.csv:4: lens (1, 2) is also in line 2");
    expect(std::string(header) + "1,2,nan,0,0,0,0,0\n", "dx_mm is \"nan\"");
    expect(std::string(header) + "1,2,x,0,0,0,0,0\n", "dx_mm is \"x\"");
    expect(std::string(header) + "1,2,0,0,0,0,0\n", "has 7 values");
    expect(std::string(header) + "1,2,1e99,0,0,0,0,0\n", "at most 1e6");
    expect(std::string(header) + "1,2,0.06,0,0,0,0,0\n", "lenses move by up to 0.06 mm");
    expect(std::string(header) + "1,2,0,0,0,40,0,0\n", "at most 30");
    expect(std::string(header) + "1,2,0,0,0,0,0,-0.95\n", "less than a tenth");
    expect(std::string(header) + "1,2,0,0,-4,0,0,0\n", "into the panel");
}

}  // namespace
}  // namespace lfdsim
