#include "files/calibration/calibration.h"

#include "base/constants.h"
#include "checks/first_order.h"
#include "checks/lenticular.h"
#include "display/keys.h"
#include "geometry/geometry.h"
#include "geometry/lattice.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace lfdsim {
namespace {

constexpr double inch_mm = 25.4, panel_height_deg = 14;
constexpr double least_share = 0.01;        // of a pixel's width or height that a subpixel can be
constexpr double fewest_pixels_behind = 1;  // panel pixels per lens; with fewer there are no views

/// Returns the width and height, in pixels, of the largest rectangle that all subpixels can have without two of them overlapping,
/// at most a pixel each.
std::array<double, 2> largest_rect(const Calibration& c) {
    // The distances of all pairs of subpixels that are nearer than a pixel along both axes: others cannot overlap.
    const CellPattern& pattern = cell_patterns[c.cell_pattern];
    std::vector<std::array<double, 2>> apart;  // neighbours, by their distance along x and y
    constexpr std::int64_t reach = 3;          // pixels: places differ by two at most, and a rectangle is one wide
    const std::int64_t far = 4 * reach;        // a whole number of cells, added so that no row or column is negative
    const auto place = [&](std::int64_t column, std::int64_t row, std::size_t channel) {
        const auto& [x, y] = c.cells[std::size_t(cell_of(c.cell_pattern, column + far, row + far))][channel];
        return std::array{double(column) + x, double(row) + y};
    };
    for (std::int64_t column = 0; column < pattern.columns; ++column)
        for (std::int64_t row = 0; row < pattern.rows; ++row)
            for (std::int64_t i = -reach; i <= reach; ++i)
                for (std::int64_t j = -reach; j <= reach; ++j)
                    for (std::size_t first = 0; first < 3; ++first)
                        for (std::size_t second = 0; second < 3; ++second) {
                            if (i == 0 && j == 0 && first == second) continue;
                            const auto a = place(column, row, first), b = place(column + i, row + j, second);
                            const double x = std::abs(a[0] - b[0]), y = std::abs(a[1] - b[1]);
                            if (x < 1 && y < 1) apart.push_back({x, y});
                        }
    // Rectangles of some height overlap only with neighbours whose distance along y is less: these limit the width. The best height
    // is one of the distances, or 1.
    std::vector<double> heights{1};
    for (const auto& [x, y] : apart) heights.push_back(y);
    std::array<double, 2> best{};
    for (const double height : heights) {
        double width = 1;
        for (const auto& [x, y] : apart)
            if (y < height - 1e-9) width = std::min(width, x);
        if (width * height > best[0] * best[1]) best = {width, height};
    }
    return best;
}

// Makes the display step by step, by the equations of docs/model.md, "Calibrations", in its symbols: turn() is alpha, sign() sigma,
// elemental_pitch_mm() p'.
class CalibrationImport {
  public:
    CalibrationImport(const Calibration& calibration, const CalibrationRequest& r, const std::string& file)
        : c(calibration), request(r), name(file) {}

    Imported import() {
        made.what = "A lenticular display from its calibration";
        made.notes = {fmt::format("Calibration of {}: the positions of each lens's views on the panel.",
                                  c.serial.empty() ? "a unit without a serial" : c.serial)};
        d.name = c.serial;
        make_panel();
        find_gap();
        make_lenses();
        place_array();
        place_camera_and_content();
        made.notes.insert(made.notes.end(), c.notes.begin(), c.notes.end());
        judge();
        made.display = std::move(d);
        return std::move(made);
    }

  private:
    [[noreturn]] void refuse(const std::string& key, const std::string& what) const {
        throw InputError(key.starts_with("--") ? key : name + ": " + key, what);
    }
    template <class... Values>
    void note(fmt::format_string<Values...> words, Values&&... values) {
        made.notes.push_back(fmt::format(words, std::forward<Values>(values)...));
    }
    double sign() const { return c.flip_image_x ? -1 : 1; }
    double turn() const { return std::atan(sign() / c.slope); }  // of the array, counter-clockwise
    double elemental_pitch_mm() const { return inch_mm / c.pitch_per_inch; }

    // Panel and subpixels: stripes, or rectangles about the centres that the cells state.
    void make_panel() {
        d.panel.pixels = c.pixels;
        d.panel.pixel_pitch_mm = inch_mm / c.dpi;
        if (const double behind = c.dpi / c.pitch_per_inch; behind < fewest_pixels_behind)
            refuse("pitch",
                   fmt::format("is {} lenses per inch, with {:.3g} of the panel's pixels behind each; at least {}, so at most DPI",
                               c.pitch_per_inch, behind, fewest_pixels_behind));
        // Without cells there are stripes, whose order each of the two flips reverses.
        if (c.cells.empty()) {
            d.panel.subpixels = c.flip_image_x != c.flip_subpixels ? SubpixelLayout::bgr_stripe : SubpixelLayout::rgb_stripe;
            return note("No subpixelCells: stripes of a third of a pixel, {} from left to right, without black between them.",
                        d.panel.subpixels == SubpixelLayout::rgb_stripe ? "red, green, blue" : "blue, green, red");
        }
        // With cells each subpixel is a rectangle about its centre, all of the same size. y is upwards in a cell, and downwards in
        // a description.
        const CellPattern& pattern = cell_patterns[c.cell_pattern];
        const auto [width, height] = largest_rect(c);
        if (!(width >= least_share && height >= least_share))
            refuse("subpixelCells", "have two subpixels at the same position, or nearly so; the positions must differ");
        d.panel.subpixels = SubpixelLayout::custom;
        d.panel.subpixel_cell = {pattern.columns, pattern.rows};
        for (int row = 0; row < pattern.rows; ++row)
            for (int column = 0; column < pattern.columns; ++column)
                for (std::size_t channel = 0; channel < 3; ++channel) {
                    const auto& [right, up] =
                        c.cells[std::size_t(cell_of(c.cell_pattern, column, row_from_bottom(row, pattern)))][channel];
                    const double x = column + 0.5 + right, y = row + 0.5 - up;
                    d.panel.custom.push_back(
                        {Channel(channel), {column, row}, {x - width / 2, y - height / 2, x + width / 2, y + height / 2}});
                }
        note(
            "The positions of subpixels are those of subpixelCells (mode {}); their sizes, which it does not contain, are the "
            "largest that all can have: {:.3g} x {:.3g} of a pixel.",
            c.cell_pattern, width, height);
        if (c.flip_subpixels) note("flipSubp is not read: subpixelCells give the position of each colour.");
    }
    /// Returns the number, from the bottom of the panel, of a row of the cell at the panel's top left corner.
    std::int64_t row_from_bottom(int row, const CellPattern& pattern) const {
        return c.pixels[1] - 1 - row + pattern.rows;  // one cell further up: not negative, on a panel of fewer rows than the cell
    }

    // The gap: as requested, or g = p' / (2 tan(cone/2) cos(alpha)).
    void find_gap() {
        const double across = elemental_pitch_mm() / std::cos(turn());
        if (request.gap_mm) {
            gap_mm = *request.gap_mm;
            const double cone = 2 * std::atan(across / (2 * gap_mm)) / degree;
            return note("The gap is that of --gap-mm; a lens then sends light into {:.4g} degrees{}.", cone,
                        c.view_cone_deg ? fmt::format(" (viewCone: {:g})", *c.view_cone_deg) : "");
        }
        if (!c.view_cone_deg) refuse("viewCone", "is missing, which determines the gap; give --gap-mm");
        gap_mm = to_nanometre(across / (2 * std::tan(*c.view_cone_deg * degree / 2)));
        note(
            "Gap, in air: {:g} mm, so that a lens sends the light of its elemental image into the viewCone of {:g} degrees, along "
            "the panel's rows (--gap-mm gives another).",
            gap_mm, *c.view_cone_deg);
    }

    // Strips of the pitch p = p' / (1 + g/(D' - z_H')), ideal lenses in air or cylinders of glass.
    void make_lenses() {
        d.array.lattice = LatticeKind::strips;
        d.array.aperture = Aperture::cell;
        const double height_mm = double(c.pixels[1]) * d.panel.pixel_pitch_mm;
        distance_mm = request.distance_mm.value_or(rounded(height_mm / (2 * std::tan(panel_height_deg * degree / 2))));
        // In glass of index n the lens's vertex, the only place where light is refracted, is at n g above the panel.
        const double vertex_mm = gap_mm * request.index.value_or(1), to_eye_mm = distance_mm - vertex_mm;
        if (!(to_eye_mm > 0))
            refuse("--distance-mm",
                   fmt::format("the eye is {:g} mm from the panel, but the lenses are at {:.4g} mm; give a larger distance",
                               distance_mm, vertex_mm));
        const double pitch_mm = elemental_pitch_mm() / (1 + gap_mm / to_eye_mm);
        d.array.pitch_mm = pitch_mm;
        if (request.distance_mm)
            note("The calibration holds for an eye at {:g} mm from the panel, by --distance-mm.", distance_mm);
        else
            note(
                "Assumed: the calibration holds for an eye at {:g} mm, from where the panel is {:g} degrees high (--distance-mm "
                "gives another).",
                distance_mm, panel_height_deg);
        note(
            "Lens pitch: the elemental images' pitch on the panel, 25.4 mm / {:.7g}, over 1 + {:.6g} / {:.6g}, gap over the "
            "distance from the lenses to the eye: {:.7g} mm.",
            c.pitch_per_inch, gap_mm, to_eye_mm, pitch_mm);
        if (!request.index) {
            d.lens.kind = IdealLens{{}, gap_mm};
            d.array.gap_mm = gap_mm;
            return note(
                "Assumed: cylindrical lenses without aberrations, focused on the panel; a calibration does not contain their shape "
                "and glass (--index makes real cylinders).");
        }
        make_sheet(pitch_mm);
    }

    // Cylinders R = (n - 1) g in one sheet with the layer on the panel, focused on the panel.
    void make_sheet(double pitch_mm) {
        const double n = *request.index, half = pitch_mm / 2;
        const std::optional<CylinderSheet> sheet = cylinder_sheet(pitch_mm, gap_mm, n);
        if (!sheet)
            refuse("--index",
                   fmt::format("is {:g}: cylinders that focus {:.4g} mm away would have a radius of {:.4g} mm, less than half "
                               "the pitch of {:.4g} mm; at least {:.4g}, or a larger --gap-mm",
                               n, gap_mm, gap_mm * (n - 1), pitch_mm, std::ceil((1 + half / gap_mm) * 1000 + 0.5) / 1000));
        d.panel.layers = {{sheet->layer_mm, n, {}}};
        d.lens.kind = sheet->lens;
        d.array.base_z_mm = sheet->layer_mm;
        d.array.surround = Surround::plate;
        note("Cylinders of index {:g} (--index) in a sheet of {:.4g} mm on the panel, which is in their focus: R = (n - 1) g.", n,
             n * gap_mm);
    }

    // Slant, count and offset of the strips. The panel's middle has the phase P (1 + tilt)/2 - center; whole phases are borders of
    // elemental images, so with n strips the offset across them is o/p = n/2 - P (1 + tilt)/2 + center, less whole numbers.
    void place_array() {
        const double W = double(c.pixels[0]), H = double(c.pixels[1]), slope = sign() * c.slope;
        const double per_width = c.pitch_per_inch * W / c.dpi * std::cos(turn());  // P, lenses across the panel's width
        // Without cells the formula takes the first subpixel to be at its pixel's centre; it is a third of a pixel beside it.
        const double moved = c.cells.empty() ? sign() * per_width / (3 * W) : 0;
        const double middle = per_width * (1 + H / (W * slope)) / 2 - (c.center - moved);
        d.array.slant_deg = -turn() / degree;
        // One strip more than covers the panel, so that the array may be half a lens aside. The number is written, since the offset
        // depends on it: an even one has a border of lenses in its middle.
        d.array.count = lens_count(d.panel, d.array);
        const double count = double(++d.array.count->at(0));
        double aside = count / 2 - middle;
        aside -= std::round(aside);
        d.array.offset_mm = {aside * d.array.pitch_mm[0] / std::cos(turn()), 0};
        note("Slant: -atan(1/slope) = {:.6g} degrees, positive to the viewer's right{}. Offset: by center{}, at most half a lens.",
             *d.array.slant_deg, c.flip_image_x ? " (flipImageX changes the sign of slope)" : "",
             c.cells.empty() ? ", and a third of a pixel from where the published formula has the first subpixel to where it is"
                             : "");
        if (count < 1 + fewest_lenses) note("Only {:.0f} lenses cover the panel.", count - 1);
    }

    // Places the camera, an eye at the distance D' that sees the whole panel, and the content, spheres in the plane of the
    // vertices.
    void place_camera_and_content() {
        const double W = double(c.pixels[0]), H = double(c.pixels[1]), longest = std::max(W, H);
        d.camera.position_mm = {0, 0, distance_mm};
        d.camera.frame_width_mm = to_nanometre(1.03 * W * d.panel.pixel_pitch_mm);
        for (std::size_t k = 0; k < 2; ++k)
            d.camera.resolution[k] = std::max(std::int64_t(std::round(1280 * double(c.pixels[k]) / longest)), std::int64_t(1));
        d.camera.pixel_filter = PixelFilter::box;
        d.camera.pupil_diameter_mm = usual_pupil_mm;
        d.content.model = "built-in:spheres";
        d.content.depth_mm = 0;
        d.content.viewing_distance_mm = distance_mm;
        d.content.view_cone_deg = c.view_cone_deg;
    }

    // Throws what the checks of a description find, with the keys or options that it comes from.
    void judge() const {
        std::vector<Problem> problems = validate(d);
        for (Problem& p : problems) {
            const bool of_panel = p.where.starts_with("panel."),
                       of_eye = p.where.starts_with("camera.") || p.where.starts_with("content.");
            p.what += of_panel ? "; by screenW, screenH, DPI and subpixelCells"
                      : of_eye ? "; --distance-mm changes that"
                               : "; pitch, slope and viewCone, or --gap-mm, determine that";
            p.where = fmt::format("{}: {}", name, p.where);
        }
        if (!problems.empty()) throw InputError(std::move(problems));
    }

    const Calibration& c;
    const CalibrationRequest& request;
    const std::string& name;
    Imported made;
    Display d;
    double gap_mm = 0, distance_mm = 0;
};

}  // namespace

Imported import_calibration(const Calibration& calibration, const CalibrationRequest& request, const std::string& name) {
    return CalibrationImport(calibration, request, name).import();
}

}  // namespace lfdsim
