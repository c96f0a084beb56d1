// Calibrations as their files have them, for tests.
#pragma once
#include "files/calibration/calibration.h"
#include "geometry/geometry.h"

#include <nlohmann/json.hpp>
#include <string>

namespace lfdsim::calibrations {

using Json = nlohmann::json;

/// Without subpixelCells. Numbers are wrapped, as devices write them.
inline Json plain(double pitch, double slope, double center, double dpi, int width, int height, double cone = 40) {
    const auto value = [](double x) { return Json{{"value", x}}; };
    return {{"configVersion", "1.0"},  {"serial", "INVENTED-2"},  {"pitch", value(pitch)},    {"slope", value(slope)},
            {"center", value(center)}, {"viewCone", value(cone)}, {"invView", value(1)},      {"verticalAngle", value(0)},
            {"DPI", value(dpi)},       {"screenW", value(width)}, {"screenH", value(height)}, {"flipImageX", value(0)},
            {"flipImageY", value(0)},  {"flipSubp", value(0)}};
}

inline Json cell(double rx, double ry, double gx, double gy, double bx, double by) {
    return {{"ROffsetX", rx}, {"ROffsetY", ry}, {"GOffsetX", gx}, {"GOffsetY", gy}, {"BOffsetX", bx}, {"BOffsetY", by}};
}

inline Json with_cells(Json json, int mode, const Json& cells) {
    json["configVersion"] = "3.0";
    json["CellPatternMode"] = {{"value", mode}};
    json["subpixelCells"] = cells;
    return json;
}

/// Red and green side by side, blue above or below them in turn.
inline Json delta_cells() { return {cell(-0.31, 0.25, 0.28, 0.25, 0, -0.25), cell(-0.31, -0.25, 0.28, -0.25, 0, 0.25)}; }

/// A panel of 16 inches whose calibration has been published.
inline Json published_unit() {
    return with_cells(plain(44.75058319896644, -6.874565686767793, 0.16935753461833172, 283, 3840, 2160, 50), 2, delta_cells());
}

inline Imported imported(const Json& json, const CalibrationRequest& request = {}) {
    return import_calibration(parse_calibration(json.dump(), "visual.json"), request, "visual.json");
}

}  // namespace lfdsim::calibrations
