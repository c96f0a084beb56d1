// How far the filtered estimator trusts its shortcuts. Floor 1. docs/design.md, "The filtered estimator", says what blocks, strata
// and bundles are.
#pragma once

namespace lfdsim {

/// Pixels of a block share the rays of a bundle as long as what these find holds for all of them. Where a limit is passed pixels
/// trace rays of their own: slower, and noisier, but never wrong. Wider limits share more.
struct FilteredLimits {
    // The size of a block (engine/scene.cpp): as a share of what is seen of a lens, or of what a diffused ray spans, which a block
    // of 16 x 16 pixels may be wide. In this order: a fine picture is asked for; strata move with the pixels; many strata; a coarse
    // picture; else.
    static constexpr double block_finest = 0.05, block_moving = 0.1, block_fine = 0.2, block_rough = 0.95, block_usual = 0.7;
    // The same for blocks of 8 x 8 pixels, twice the above at most.
    static constexpr double half_block_rough = 0.8, half_block_usual = 0.4;
    // Picture pixels: where a diffused ray spans fewer of them, strata move with the pixels.
    static constexpr double moving_span = 4;
    // So they do behind a weak diffuser, whose rays span fewer picture pixels along both axes, and less of a lens pitch, than this:
    // only blocks of 4 x 4 pixels could share rays through the same places of a lens.
    static constexpr double weak_span = 20, weak = 0.5;

    // A block as a whole (optics/bundle.h); where one of these is passed no pixel of it shares anything.
    // Lens pitches: how far the fourth ray of a block may be from where the other three have it.
    static constexpr double bend = 1e-3;
    // Cosine: how steeply the diffuser's utmost ray must still go down.
    static constexpr double steepest = 0.2;
    // Share of the light: by how much strata may misjudge it in taking the diffuser's two turns as independent; with few strata,
    // and with many, which are asked for where little noise is wanted.
    static constexpr double misjudged = 0.05, misjudged_fine = 0.002;

    // A stratum (kernels/filtered_axis.h). Half pitches: as far from a lens's axis it counts as that lens's alone.
    static constexpr double straddling = 1.02;

    // A bundle (optics/bundle.h, kernels/filtered_bundles.h).
    // Panel pixels: a wider footprint is the sum over its probes, not one box.
    static constexpr double soft = 1;
    // How far the fourth ray may be from where the other three have it: panel pixels, and a share of the footprint's width more.
    static constexpr double least_uneven = 0.02, uneven = 0.05;
    // Share of the footprint's width: one that moves less over the block, but for `least_uneven`, is taken to stand still.
    static constexpr double still = 0.1;
    // Panel pixels: a wider footprint stands still even where its rays are uneven.
    static constexpr double smeared = 16;
    // Share of an outermost stratum: where pixels see less of it, its footprint is not cut down to what they see.
    static constexpr double part_seen = 0.25;
    // Share of a probe's part: it counts so much for a pixel that sees nothing of it, so that there is a mean for all pixels.
    static constexpr double least_seen = 1e-3;
    // Panel pixels: a footprint so wide is traced in several parts along each axis, at most so many.
    static constexpr double pixels_a_part = 24;
    static constexpr int most_parts = 2;

    // A pixel's own rays (kernels/filtered_own.h).
    // Lens pitches on the panel: rays nearer to one another tell one footprint.
    static constexpr double together = 0.25;
    // A stratum lies on a hole's edge if the share of it that the hole covers is farther than this from 0 and from 1.
    static constexpr double hole_edge = 1e-3;
    // Tries to find a place beside a hole.
    static constexpr int attempts = 8;

    // Picture pixels from place to place at which light is told, and interpolated between: that of a block with few strata, and
    // that of one soft bundle.
    static constexpr int place_step = 4, node_step = 8;
};

}  // namespace lfdsim
