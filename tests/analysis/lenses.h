// Displays with one kind of lens each, for the tests of what single lenses do.
#pragma once
#include "files/description/display_file.h"
#include "geometry/geometry.h"

#include <string>
#include <utility>
#include <vector>

namespace lfdsim::lens_examples {

inline Display shipped(const std::string& name) { return read_display(LFDSIM_SOURCE_DIR "/displays/" + name + ".toml"); }

/// Thin lenses that fill square cells: pitch, gap, focal length in mm, and panel pixels across a lens.
inline Display ideal(double pitch, double gap, double focal_length, double views) {
    Display d = shipped("desktop-ideal");
    d.diffuser.reset();
    d.array.pitch_mm = pitch;
    d.array.gap_mm = gap;
    d.lens.as<IdealLens>().focal_length_mm = focal_length;
    d.panel.pixel_pitch_mm = pitch / views;
    return d;
}

/// desktop-asphere with another prescription, without its diffuser.
inline Display with_lens(std::vector<Surface> surfaces, double base_z) {
    Display d = shipped("desktop-asphere");
    d.diffuser.reset();
    d.lens.as<SurfaceLens>().surfaces = std::move(surfaces);
    d.array.gap_mm.reset();
    d.array.base_z_mm = base_z;
    return d;
}

/// Lenses of every kind: a name and the display, without diffuser and turn.
inline std::vector<std::pair<std::string, Display>> all_lenses() {
    std::vector<std::pair<std::string, Display>> all;
    for (const char* name :
         {"desktop-stopped", "desktop-asphere", "desktop-spherical", "desktop-ideal", "desktop-clear", "desktop-plate"}) {
        all.emplace_back(name, shipped(name));
        all.back().second.diffuser.reset();
    }
    Display d = shipped("desktop-stopped");
    d.diffuser.reset();
    d.lens.as<PlanoConvex>().facing = Facing::panel;
    all.emplace_back("facing the panel", d);
    d.lens.stop_radius_mm.reset();
    d.lens.as<PlanoConvex>().sphere_radius_mm = 12;
    d.array.aperture = Aperture::cell;
    all.emplace_back("square", d);
    all.emplace_back("hollow to the panel", with_lens({{-0.02, 0, {}, 5.5, 4, 1.6}, {-0.12, -0.5, {}, 5.5, 0, 1}}, 10));
    all.emplace_back("hollow to the viewer", with_lens({{0.12, -0.5, {}, 5.5, 4, 1.6}, {0.02, 0, {}, 5.5, 0, 1}}, 10));
    all.emplace_back("two glasses",
                     with_lens({{0.05, 0, {}, 5.8, 4, 1.6}, {-0.05, -0.5, {}, 5, 2, 1.8}, {-0.06, 0, {1e-5}, 5, 0, 1}}, 12));
    Display stopped = all.back().second;
    stopped.lens.stop_radius_mm = 1.5;
    all.emplace_back("two glasses and a stop", stopped);
    Display thin = ideal(8, 14, 13, 60);
    thin.array.aperture = Aperture::circle;
    thin.lens.as<IdealLens>().aperture_radius_mm = 3;
    thin.lens.stop_radius_mm = 2;
    all.emplace_back("ideal with a stop", thin);
    return all;
}

}  // namespace lfdsim::lens_examples
