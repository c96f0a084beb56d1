// The filtered estimator: the grids into which a block of pixels cuts what it sees, and how many of them there may be.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
#pragma once
#include "engine/kernel.h"
#include "engine/kernels/filtered_axis.h"

namespace lfdsim {

namespace {

/// The grids of a block, and the memory for their parts.
struct Grids {
    Grid* grid;
    Cut* cut;
    Stratum* stratum;
    int count, strata;  // in all
    bool clear;         // what the borders of lenses hide is not in their outlines
    // By how much the light of all pixels moves in the plane of the holes, mm along x and y, and how the square's numbers change
    // for a place that stays: with a ray from the pupil's right edge and from its upper one, and per tangent of the diffuser's
    // turns, where those are divided into cells of which each has its own cuts.
    S aside[4][2], moved[4][2];
    S pixel[2][2];  // mm, half a pixel to the right and upwards
};

constexpr int most_grids = 64;
/// A grid of n strata has at most n + 3 cuts.
constexpr int most_cuts = max_strata * max_strata + 3 * most_grids;

/// How many of each a block of a tile may have, if its square is cut into `across` columns and rows.
struct Room {
    int grids, strata, cuts, an_axis;

    LFDSIM_BOTH Room(int across, bool by_lens) {
        const int more = by_lens ? few_strata : more_strata;
        an_axis = optics::min(across + more_strata, max_strata);
        strata = optics::min((across + more) * (across + more), max_strata * max_strata);
        grids = by_lens ? optics::min(strata, most_grids) : 1;
        cuts = by_lens ? strata + 3 * grids : 2 * (an_axis + 1);
    }
};

}  // namespace

}  // namespace lfdsim
