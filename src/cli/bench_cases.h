// What `lfdsim bench` renders: one display, and what each duty of the renderer changes in it. Floor 4.
#pragma once
#include "model/display.h"

#include <span>

namespace lfdsim::cli {

/// A 384 x 216 mm panel of 4K under 8.8 mm plano-convex lenses, seen from 2 m through a box diffuser at 4K with 100 samples a
/// pixel: the size of the experiment in the 2019 paper (Guan, Sang et al., Opt. Express 27(20) 29309), which took a GPU one second.
Display bench_display();

struct Duty {
    const char* name;
    void (*change)(Display&);
};
extern const std::span<const Duty> duties;

}  // namespace lfdsim::cli
