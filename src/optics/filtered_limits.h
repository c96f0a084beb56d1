// How far the filtered estimator trusts its shortcuts. Floor 1. docs/design.md, "The filtered estimator", explains blocks, strata
// and bundles.
#pragma once

namespace lfdsim {

/// The pixels of a block share the rays of a bundle as long as the result holds for all of them. Where a limit is exceeded, pixels
/// trace rays of their own: slower and noisier, but never wrong. Wider limits share more.
struct FilteredLimits {
    // The size of a block (engine/scene.cpp): how wide one of 16 x 16 pixels may be, as a share of the lens pitch or of what a
    // diffused ray spans, whichever is less. In this order: for a fine picture; where strata move with the pixels; for many strata;
    // for a rough picture; otherwise.
    static constexpr double block_finest = 0.05, block_moving = 0.1, block_fine = 0.2, block_rough = 0.95, block_usual = 0.7;
    // The same for blocks of 8 x 8 pixels, twice the above at most.
    static constexpr double half_block_rough = 0.8, half_block_usual = 0.4;
    // Picture pixels: where a diffused ray spans fewer of them, strata move with the pixels.
    static constexpr double moving_span = 4;
    // They also do behind a weak diffuser, whose rays span less than this along both axes, in picture pixels and in lens pitches:
    // only blocks of 4 x 4 pixels could share rays through the same points of a lens.
    static constexpr double weak_span = 20, weak = 0.5;
    // Panel pixels from one picture pixel to the next: beyond it lenses are told apart, and footprints followed one by one.
    static constexpr double leaping = 1;

    // A block as a whole (optics/bundle.h); where one of these is exceeded no pixel of it shares anything.
    // Lens pitches: how far the fourth ray of a block may be from where the other three predict it.
    static constexpr double bend = 1e-3;
    // Cosine: how steeply a ray must still go down after the diffuser's largest turn (relative to the cosine before it).
    static constexpr double steepest = 0.2;
    // Share of the light: by how much strata may misjudge it in taking the diffuser's two turns as independent; with few strata,
    // and with many, which are used where little noise is allowed.
    static constexpr double misjudged = 0.05, misjudged_fine = 0.002;

    // A stratum (kernels/filtered_axis.h). Half pitches from a lens's axis up to which it counts as that lens's alone.
    static constexpr double straddling = 1.02;

    // A block that cuts what it sees lens by lens (kernels/filtered_lens.h).
    // Share of a stratum: where pixels see less of it along an axis, a footprint wider than `soft` is not shared.
    static constexpr double narrow = 0.5;
    // Radians: a weak diffuser's half angles, up to which both turns are taken to move light linearly.
    static constexpr double small_turn = 0.1;
    // Widths of a part of the square on the lenses: how far the middle of a lens's border may be off its mean, where the outline is
    // to leave out what it hides.
    static constexpr double bent = 0.1;
    // Picture pixels: a diffuser that turns rays along an axis by less is taken to turn them by as much. The first where a pixel's
    // area counts.
    static constexpr double least_span = 0.25, least_span_sharp = 0.015;
    // Radii of a round hole: up to this half width of a picture pixel its edge counts as straight.
    static constexpr double straight = 0.5;
    // Half widths of a hole: by how much the pupil may move rays there and yet be left undivided, in the width of boxes alone,
    // however many samples there are.
    static constexpr double aside = 0.05;
    // The same, from where on other lenses are seen from the pupil's edge than from its middle.
    static constexpr double far_aside = 0.5;
    // Widths of the box by which the diffuser and the pupil widen a ray: one ray serves for four where the pixel's area adds less.
    static constexpr double beside = 0.25;
    // Radii of a lens, or half widths of a strip: rays up to here from its axis tell how the camera's pupil spreads all of them.
    static constexpr double well_inside = 0.7;

    // A bundle (optics/bundle.h, kernels/filtered_bundles.h).
    // Panel pixels: a wider footprint is the mean over boxes around its probes, not one box.
    static constexpr double soft = 1;
    // Panel pixels, where they do not shine all over: of narrower boxes the light changes from pixel to pixel of the picture, and
    // is not interpolated.
    static constexpr double masked = 4;
    // How far the fourth ray may be from where the other three predict it: panel pixels, plus a share of the footprint's width.
    static constexpr double least_uneven = 0.02, uneven = 0.05;
    // Share of the footprint's width, plus `least_uneven`: one that moves less over the block is treated as still.
    static constexpr double still = 0.1;
    // Panel pixels: a wider footprint is treated as still even where its rays move unevenly.
    static constexpr double smeared = 16;
    // Share of an outermost stratum: where pixels see less of it, its footprint is not narrowed to what they see.
    static constexpr double part_seen = 0.25;
    // Least weight of a probe, even for a pixel that sees nothing of its part, so that there is a mean for all pixels.
    static constexpr double least_seen = 1e-3;
    // A footprint is traced in one part along each axis, and one more for each of so many panel pixels, up to most_parts.
    static constexpr double pixels_a_part = 24;
    static constexpr int most_parts = 2;

    // A pixel's own rays (kernels/filtered_own.h).
    // Lens pitches on the panel: rays that end closer together than this define one footprint.
    static constexpr double together = 0.25;
    // A stratum lies on a hole's edge if the share that the hole covers differs from 0 and from 1 by more than this.
    static constexpr double hole_edge = 1e-3;
    // Share of the sides of a box: where pixels do not shine all over, light that spreads farther than this along a leaning line is
    // read along it, in at most so many pieces; where it lies in a wide box, as so many boxes.
    static constexpr double upright = 0.125;
    static constexpr int most_pieces = 8, in_line = 3;
    // Attempts to find a point beside a hole.
    static constexpr int attempts = 8;

    // Picture pixels between the points at which light is computed, and interpolated in between: for a block with few strata
    // (places), and for one soft bundle (nodes).
    static constexpr int place_step = 4, node_step = 8;
};

}  // namespace lfdsim
