// A valid display for tests to change: plain spherical lenses with every length told by hand.
#pragma once
#include "display/display.h"

namespace lfdsim {

inline Display example() {
    Display d;
    d.panel.pixels = {3840, 2160};
    d.panel.pixel_pitch_mm = 0.13636;
    d.lens.kind = PlanoConvex{7.28, 6, 1, 1.4918, Facing::viewer};
    d.array.count = {43, 24};
    d.array.pitch_mm = 12;
    d.array.gap_mm = 16.485;
    return d;
}

/// The same with a prescription: flat towards the panel, an asphere towards the viewer.
inline Display example_surfaces() {
    Display d = example();
    d.lens = {SurfaceLens{{{0, 0, {}, 6, 3.49, 1.4918}, {-0.129517, -0.3635, {4.972e-5, 1.2486e-6}, 6, 0, 1}}}, {}};
    return d;
}

inline Display example_ideal() {
    Display d = example();
    d.lens = {IdealLens{6, 15.7}, {}};
    return d;
}

}  // namespace lfdsim
