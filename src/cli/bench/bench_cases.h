// The display that `lfdsim bench` renders, and the changes by which it measures each feature of the renderer. Floor 5.
#pragma once
#include "display/display.h"
#include "image/image.h"
#include "image/texels.h"

#include <span>

namespace lfdsim::cli {

/// Returns a 384 x 216 mm panel of 4K under 8.8 mm plano-convex lenses, whose camera at 2 m looks through a box diffuser, at 4K
/// with 100 samples a pixel: the size of the experiment in the 2019 paper (Guan, Sang et al., Opt. Express 27(20) 29309).
Display bench_display();

/// A change of a display that gives the renderer one more duty, and its name in the tables.
struct Duty {
    const char* name;
    void (*change)(Display&);
};
extern const std::span<const Duty> duties;   // the first changes nothing
extern const std::span<const Duty> glasses;  // every type of lens in every surround that it can have; the first changes nothing

/// Replaces the lens by a plano-convex one of two surfaces whose cap is an asphere: R = 9 mm, conic -0.36, n = 1.49.
void make_asphere(Display&);
/// Replaces the round lenses by cylindrical ones, enough of them to cover the panel.
void make_strips(Display&);

/// A panel image of pseudo-random linear light in 0 .. 1, in which neighbours are unrelated: the worst case for caches, and the
/// usual one under a diffuser.
Texels noise_panel(const Display&);

/// The rectangle of the `rows` middle rows of the frame, at full width; all rows if it has fewer.
Rect band(const Display&, int rows);

}  // namespace lfdsim::cli
