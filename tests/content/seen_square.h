// What a camera sees of a square from -1 to 1 in the plane of the lenses, and PLY files of it.
#pragma once
#include "small_world.h"

namespace small_world {

inline Image photo(const fs::path& file, const LoadOptions& options = {}) {
    Display d = display();
    d.camera.target_mm = {0, 0, resolve(d).vertex_plane_mm};
    const Geometry g = resolve(d);
    Job job;
    return reference_photograph(d, g, ContentScene(load_model(file, options), d, g), 0, {}, job).image;
}

/// "red" and so on, of the place (x, y) of a square from -1 to 1 that is white where fully lit.
inline std::string colour_at(const Image& image, double x, double y) {
    const float* const c = image.at(int(120 + 50 * x), int(80 - 50 * y));
    const auto on = [&](int k) { return double(c[k]) / facing_light > 0.9; };
    const auto off = [&](int k) { return double(c[k]) / facing_light < 0.1; };
    if (on(0) && on(1) && on(2)) return "white";
    if (on(0) && off(1) && off(2)) return "red";
    if (off(0) && on(1) && off(2)) return "green";
    if (off(0) && off(1) && on(2)) return "blue";
    return off(0) && off(1) && off(2) ? "black" : "other";
}

inline constexpr const char* square = "-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n";
inline std::string ply(const std::string& header, const std::string& body) {
    return "ply\nformat ascii 1.0\n" + header + "end_header\n" + body;
}
inline const std::string xyz = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";

}  // namespace small_world
