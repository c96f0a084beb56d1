// The limits of the filtered and of the lens-by-lens estimator's shortcuts, and of the choice between them and points. Floor 2.
// docs/design.md, "The filtered estimator", explains blocks, strata and shared footprints, and which tests keep these limits.
#pragma once
#include <cstdint>

namespace lfdsim {

/// The pixels of a block share footprints as long as the result holds for all of them. Where a limit is exceeded, smaller blocks
/// are tried, and the smallest are rendered lens by lens. Wider limits share more.
struct FilteredLimits {
    // Limits of a display (engine/scene/traced_display.cpp). Picture pixels that a diffused ray spans along each axis at least.
    static constexpr double least_span = 4;
    // A diffuser is weak where rays span less than this along both axes, in picture pixels and in lens pitches.
    static constexpr double weak_span = 20, weak = 0.5;
    // Panel pixels by which a ray moves from one picture pixel to the next at most.
    static constexpr double leaping = 1;
    // How wide a block of 16 x 16 pixels may be, as a share of the lens pitch or of what a diffused ray spans, whichever is less.
    // In this order: for a fine picture; for many strata; for a rough picture; otherwise.
    static constexpr double block_finest = 0.05, block_fine = 0.2, block_rough = 0.95, block_usual = 0.7;
    // The same share for blocks of 8 x 8 pixels, which is at most twice the one for 16 x 16: for a rough picture; otherwise.
    static constexpr double half_block_rough = 0.8, half_block_usual = 0.4;

    // Limits of a block (engine/estimator/shared_footprint.h). Lens pitches by which the fourth ray of a block may be off from
    // where the other three predict it.
    static constexpr double bend = 1e-3;
    // Least cosine of a ray to the normal after the diffuser's largest turn, over the cosine before it.
    static constexpr double steepest = 0.2;
    // Share of the light: by how much strata may misjudge it in taking the diffuser's two turns as independent; with few strata,
    // and with many, which are used where little noise is allowed.
    static constexpr double misjudged = 0.05, misjudged_fine = 0.002;

    // A limit of a stratum (kernels/filtered_axis.h). Half pitches from a lens's axis within which a stratum looks through one
    // lens.
    static constexpr double cell_margin = 1.02;

    // Limits of a shared footprint (engine/estimator/shared_footprint.h, kernels/filtered_footprints.h). Panel pixels: the light of
    // a wider footprint is the mean over boxes around its probes, not over one box.
    static constexpr double narrow = 1;
    // Panel pixels, where these have a black matrix or subpixels: the light of a narrower box changes from pixel to pixel of the
    // picture and is not interpolated.
    static constexpr double masked = 4;
    // Largest distance of the fourth ray from where the other three predict it: panel pixels, plus a share of the footprint's
    // width.
    static constexpr double least_uneven = 0.02, uneven = 0.05;
    // Share of the footprint's width, plus `least_uneven`: a footprint that moves less over the block is stationary.
    static constexpr double stationary = 0.1;
    // Panel pixels: a wider footprint is stationary even where its rays move non-linearly.
    static constexpr double always_stationary = 16;
    // Share of an outermost stratum: where pixels see less of it, its footprint is not narrowed to what they see.
    static constexpr double part_visible = 0.25;
    // Least weight of a probe, even for a pixel that sees nothing of its part, so that there is a mean for all pixels.
    static constexpr double least_visible = 1e-3;
    // Panel pixels: a footprint is traced in one part along each axis, and one more for each of these, up to most_parts.
    static constexpr double pixels_a_part = 24;
    static constexpr int most_parts = 2;
    // Picture pixels between the points at which light is computed, and interpolated in between: for a block with few strata
    // (places), and for one wide footprint (nodes).
    static constexpr int place_step = 4, node_step = 8;

    // Limits of lens by lens (kernels/lens_by_lens.h, visible_lenses.h). Share of a cell by which a lens's part of the domain may
    // be wider than a number of cells without one more.
    static constexpr double cell_to_spare = 0.3;
    // Weight of the widest spread among the coordinates that outlines do not cut: it is read as a box.
    static constexpr double boxed_spread = 0.3;
    // Share of the sides of a box, and panel pixels: a parallelogram that is more oblique is read as boxes side by side, most_boxes
    // at most.
    static constexpr double oblique_edge = 0.25;
    static constexpr int most_boxes = 8;
    // Share of the widest spread's box: other spreads that move light by less than this are left out.
    static constexpr double aside = 0.04;
    // Share of the sides of a box: where pixels have a black matrix or subpixels, light that spreads farther than this along an
    // oblique line is read along it, in most_pieces pieces at most.
    static constexpr double oblique_line = 0.125;
    static constexpr int most_pieces = 8;

    // Limits of the choice between filtered light and points (engine/estimator/choice.cpp). The frame's light is at least
    // `least_light` of the mean of a white panel's picture, which counts as `least_white` at least. Errors allowed: of the mean
    // over a neighbourhood of pixels, as a share of the frame's light (`mean_allowed`) or of the target error (`mean_of_target`);
    // of a pixel, as a share of the frame's light, by filtered light (`rms_allowed`) and by points (`points_rms`, with which the
    // mean over 500 pixels is right to 0.002).
    static constexpr double least_light = 0.05, least_white = 0.05, mean_allowed = 0.003, mean_of_target = 0.3, rms_allowed = 0.01,
                            points_rms = 0.04;
    // The error of a pixel by 36 Sobol points over that by 16. A pixel of filtered light may be as wrong as one of 36 points.
    static constexpr double of_36_points = 0.5;
    // The power of the number of points by which their error falls: on most displays, with which a number is chosen; and at least,
    // with which the error of more points than were compared is stated.
    static constexpr double falls_as = -0.62, falls_at_least_as = -0.5;
    // Numbers of points a pixel: with which a region's places are first and last measured, four times as many in each step; the
    // most that are chosen.
    static constexpr std::uint32_t first_points = 16, last_points = 256, most_chosen_points = 16384;
    // Pixels along a place's side: as many as share a list of lenses. Places along a region's side, along a neighbourhood's, and
    // along the frame's.
    static constexpr int place_side = 4, places_an_axis = 12, together = 3, frame_places_an_axis = 16;
};

}  // namespace lfdsim
