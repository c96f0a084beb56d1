// A valid display for tests to change: plain spherical lenses with every length told by hand.
#pragma once
#include "model/display.h"

namespace lfdsim {

inline Display example() {
    Display d;
    d.panel.pixels = {3840, 2160};
    d.panel.pixel_pitch_mm = 0.13636;
    d.lens.sphere_radius_mm = 7.28;
    d.lens.aperture_radius_mm = 6;
    d.lens.cylinder_height_mm = 1;
    d.lens.index = 1.4918;
    d.array.count = {43, 24};
    d.array.pitch_mm = 12;
    d.array.gap_mm = 16.485;
    return d;
}

/// The same with a prescription: flat towards the panel, an asphere towards the viewer.
inline Display example_surfaces() {
    Display d = example();
    d.lens = {};
    d.lens.type = LensType::surfaces;
    d.lens.surfaces = {{0, 0, {}, 6, 3.49, 1.4918}, {-0.129517, -0.3635, {4.972e-5, 1.2486e-6}, 6, 0, 1}};
    return d;
}

inline Display example_ideal() {
    Display d = example();
    d.lens = {};
    d.lens.type = LensType::ideal;
    d.lens.focal_length_mm = 15.7;
    d.lens.aperture_radius_mm = 6;
    return d;
}

}  // namespace lfdsim
