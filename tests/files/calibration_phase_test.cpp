// Descriptions of calibrated displays against the published interlacing formula, written here once more: at each subpixel both must
// be at the same place of an elemental image.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "calibrations.h"
#include "content/pickup/pickup.h"
#include "geometry/subpixels.h"

namespace lfdsim {
namespace {

using namespace calibrations;

/// The formula. Lens cycles from the left border of the panel, of a pixel counted from the lower left corner.
struct Interlacing {
    explicit Interlacing(const Json& json) : all(json) {
        const double s = at("slope"), flip = at("flipImageX") >= 0.5 ? -1 : 1;
        width = at("screenW");
        height = at("screenH");
        cycles = at("pitch") * width / at("DPI") * std::cos(std::atan(1 / s));
        tilt = height / (width * s) * flip;
        subpixel = flip / (3 * width);
    }
    double at(const char* key) const { return all[key]["value"].get<double>(); }

    /// Of red, green, blue = 0, 1, 2.
    double phase(int channel, int column, int row) const {
        double u = (column + 0.5) / width, v = (row + 0.5) / height;
        if (const Json& cells = all.contains("subpixelCells") ? all["subpixelCells"] : Json(); !cells.empty()) {
            const int mode = int(at("CellPatternMode"));
            const int number = mode == 1   ? (column + row) % 2
                               : mode == 2 ? column % 2
                               : mode == 3 ? (row + 2 * (column % 2)) % 4
                               : mode == 4 ? row % 2
                                           : 0;
            const std::string colour(1, "RGB"[channel]);
            u += cells[std::size_t(number)][colour + "OffsetX"].get<double>() / width;
            v += cells[std::size_t(number)][colour + "OffsetY"].get<double>() / height;
        } else {
            u += subpixel * (at("flipSubp") >= 0.5 ? 2 - channel : channel);
        }
        return (u + v * tilt) * cycles - at("center");
    }

    const Json& all;
    double width, height, cycles, tilt, subpixel;
};

/// The greatest distance between the formula's place in an elemental image and ours, of 400 pixels and the corners; in elemental
/// images. Also whether views with higher numbers are seen from further right.
double greatest_distance(const Json& json, const CalibrationRequest& request) {
    const Interlacing formula(json);
    const Display d = imported(json, request).display;
    const Geometry g = resolve(d);
    const Pickup pickup(d, g);
    const int width = int(d.panel.pixels[0]), height = int(d.panel.pixels[1]);
    std::mt19937 random(19);
    double greatest = 0;
    for (int n = 0; n < 400; ++n) {
        const int column = n < 4 ? n % 2 * (width - 1) : int(random() % unsigned(width)),
                  row = n < 4 ? n / 2 * (height - 1) : int(random() % unsigned(height));
        for (int channel = 0; channel < 3; ++channel) {
            const auto shines = centroid(d.panel, channel, column, row);
            if (!shines) return 1;
            const double x = pickup.x_mm(column + (*shines)[0]), y = pickup.y_mm(row + (*shines)[1]);
            const Pickup::ElementalPosition place = pickup.place(x, y);
            const double phase = formula.phase(channel, column, height - 1 - row), apart = phase - (place.u + 0.5);
            greatest = std::max(greatest, place.owned ? std::abs(apart - std::round(apart)) : 1);

            const double view = 1 - (phase - std::floor(phase));
            const NodalLine line = pickup.line(x, y);
            const double eye_x = line.x + line.mx * (d.content.viewing_distance_mm - g.rear_principal_mm);
            if (std::abs(view - 0.5) > 0.05) {
                EXPECT_GT((view - 0.5) * eye_x, 0) << "pixel " << column << ", " << row;
            }
        }
    }
    return greatest;
}

// Half a view of 48 is 0.0104 of an elemental image.
constexpr double same_place = 1e-6;

TEST(CalibrationPhase, HasThePublishedFiguresOfAUnit) {
    const Json json = published_unit();
    const Interlacing formula(json);
    EXPECT_NEAR(formula.cycles, 600.892, 1e-3);
    EXPECT_NEAR(formula.tilt, -0.0818233, 1e-7);
    EXPECT_LT(greatest_distance(json, {}), same_place);
    // Without its cells the formula is wrong for it, by more than a view of 48: the comparison can tell.
    Json stripes = json;
    stripes.erase("subpixelCells");
    const Interlacing plain_formula(stripes);
    double apart = 0;
    for (int column = 0; column < 20; ++column)
        apart = std::max(apart, std::abs(plain_formula.phase(2, column, 0) - formula.phase(2, column, 0)));
    EXPECT_GT(apart, 1. / 48);
}

// Products as makers' templates have them, with the figures that follow: elemental pitch in mm, turn of the array in degrees,
// subpixels behind a lens along a row.
TEST(CalibrationPhase, HoldsForAllProducts) {
    const struct {
        double pitch, slope, cone, dpi;
        int width, height;
        double pitch_mm, turn_deg, subpixels;
    } products[] = {
        {49.800, 5.48, 40, 338, 2560, 1600, 0.5100, 10.34, 20.70}, {50.071, -7.7, 40, 283, 3840, 2160, 0.5073, -7.40, 17.10},
        {38.055, -7.7, 40, 280, 7680, 4320, 0.6675, -7.40, 22.26}, {52, -7, 40, 324, 1536, 2048, 0.4885, -8.13, 18.88},
        {50, -7, 40, 283, 3840, 2160, 0.5080, -8.13, 17.15},       {42, -6, 40, 280, 7680, 4320, 0.6048, -9.46, 20.28},
        {80.7, -6.3, 54, 491, 1440, 2560, 0.3147, -9.02, 18.48},   {44.72, -7.45, 50, 283, 2160, 3840, 0.5680, -7.65, 19.16},
        {44.72, -6.9, 50, 283, 3840, 2160, 0.5680, -8.25, 19.18},  {75, -7.2, 50, 280, 7680, 4320, 0.3387, -7.91, 11.31},
    };
    for (const auto& p : products) {
        SCOPED_TRACE(p.slope);
        const Json json = plain(p.pitch, p.slope, 0.41, p.dpi, p.width, p.height, p.cone);
        EXPECT_LT(greatest_distance(json, {}), same_place);
        const Display d = imported(json).display;
        const Geometry g = resolve(d);
        const Theory t = theory(d, g);
        EXPECT_NEAR(t.along[0].elemental_pitch_mm, p.pitch_mm, 6e-5);
        EXPECT_NEAR(*d.array.slant_deg, -p.turn_deg, 6e-3);
        EXPECT_NEAR(3 * t.along[0].views * t.along[0].elemental_pitch_mm / d.array.pitch_mm[0], p.subpixels, 6e-3);
        EXPECT_NEAR(2 *
                        std::atan(std::tan(t.fov_of_eyes_deg * std::acos(-1.) / 360) * t.along[0].elemental_pitch_mm /
                                  d.array.pitch_mm[0]) *
                        180 / std::acos(-1.),
                    p.cone, 1e-4);
    }
}

// Whatever a file may say: signs, flips, centres, cells in all modes, odd sizes, and lenses of glass for any eye.
TEST(CalibrationPhase, HoldsForAllFlagsCellsAndRequests) {
    const Json four = {cell(-0.33, 0.01, 0, 0, 0.33, -0.01), cell(-0.31, -0.02, 0.02, 0, 0.34, 0), cell(-0.35, 0, 0, 0.02, 0.31, 0),
                       cell(-0.3, 0.03, 0.03, -0.01, 0.36, 0.02)};
    const Json two = {four[0], four[3]}, one = Json::array({cell(-0.2, 0.25, 0.25, 0.25, 0.05, -0.25)});
    const Json cells_of_mode[] = {one, two, delta_cells(), four, two};
    std::mt19937 random(5);
    std::uniform_real_distribution<double> even(0, 1);
    for (const int mode : {-1, -1, -1, 0, 1, 2, 3, 4})  // -1: without cells
        for (int flags = 0; flags < 8; ++flags) {
            const double slope = (even(random) < 0.5 ? -1 : 1) * (2 + 9 * even(random));
            Json json = plain(40 + 40 * even(random), slope, 4 * even(random) - 2, 280 + 60 * even(random),
                              600 + int(random() % 40), 400 + int(random() % 40), 40);
            json["flipImageX"]["value"] = flags & 1;
            json["flipSubp"]["value"] = flags >> 1 & 1;
            json["invView"]["value"] = flags >> 2 & 1;
            if (mode >= 0) json = with_cells(json, mode, cells_of_mode[mode]);
            SCOPED_TRACE(json.dump());
            EXPECT_LT(greatest_distance(json, {}), same_place);
            CalibrationRequest request;
            request.gap_mm = 0.5 + even(random);
            request.distance_mm = 200 + 700 * even(random);
            EXPECT_LT(greatest_distance(json, request), same_place);
            request.index = 1.9;
            EXPECT_LT(greatest_distance(json, request), 10 * same_place);  // its lengths are rounded to nanometres
        }
}

}  // namespace
}  // namespace lfdsim
