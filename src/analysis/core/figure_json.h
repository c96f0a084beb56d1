// Figures as numbers for scripts. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "geometry/lattice.h"

#include <cmath>
#include <string>
#include <vector>

namespace lfdsim {

/// Returns a figure for scripts: null if it is undefined (NaN), "infinite" or "-infinite" if it has no finite value.
inline Json number_json(double x) {
    if (std::isinf(x)) return x > 0 ? "infinite" : "-infinite";
    return std::isnan(x) ? Json() : Json(x);
}
inline Json numbers_json(const std::vector<double>& all) {
    Json json = Json::array();
    for (const double x : all) json.push_back(number_json(x));
    return json;
}

/// Returns a figure along the array's x' and y': two numbers, or one if they do not differ by the lattice.
inline Json axes_json(const LensArray& array, double along_x, double along_y) {
    return differs_by_axis(array) ? numbers_json({along_x, along_y}) : number_json(along_x);
}

/// Writes object[name] and, if the value has errors, object[name + "_error"].
void write_value(Json& object, const std::string& name, const FigureValue&);

}  // namespace lfdsim
