// What `lfdsim bench` renders: one display, and what each duty of the renderer changes in it. Floor 5.
#pragma once
#include "display/display.h"
#include "image/image.h"
#include "image/texels.h"

#include <span>

namespace lfdsim::cli {

/// A 384 x 216 mm panel of 4K under 8.8 mm plano-convex lenses, seen from 2 m through a box diffuser at 4K with 100 samples a
/// pixel: the size of the experiment in the 2019 paper (Guan, Sang et al., Opt. Express 27(20) 29309).
Display bench_display();

/// A changed display and its name in the tables.
struct Duty {
    const char* name;
    void (*change)(Display&);
};
extern const std::span<const Duty> duties;   // the first changes nothing
extern const std::span<const Duty> glasses;  // every type of lens in every surround it can have; the first changes nothing

/// Replaces the lens by a prescription whose cap is an asphere.
void make_asphere(Display&);
/// Cylindrical lenses in place of the round ones, as many as cover the panel.
void make_strips(Display&);

/// A panel image of which no pixel says anything about its neighbours: the worst case for caches, and the usual one under a
/// diffuser.
Texels noise_panel(const Display&);

/// `rows` full rows in the middle of the frame, for what need not take seconds.
Rect band(const Display&, int rows);

}  // namespace lfdsim::cli
