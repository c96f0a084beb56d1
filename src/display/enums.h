// The choices that a display description offers. Floor 0, public as a part of display.h; no library headers, so that every kernel
// may include it.
#pragma once

namespace lfdsim {

// Enough for any lens maker's prescription, and the most that the kernels hold.
inline constexpr decltype(sizeof 0) max_surfaces = 16, max_asphere_terms = 8, max_layers = 8;
// The most subpixels of a panel's cell, and the most parts of them: a rectangle that extends over the border of its cell is
// stored in parts.
inline constexpr int max_subpixels = 32, max_subpixel_parts = 64;

/// The most of render.wavelength_samples, and of the files that glass_catalogues may name.
inline constexpr decltype(sizeof 0) max_wavelength_samples = 32, max_catalogues = 8;
/// The most objects of content.object.
inline constexpr decltype(sizeof 0) max_objects = 64;

enum class Encoding { srgb, linear };  // of the panel image's code values
enum class SubpixelLayout { none, rgb_stripe, bgr_stripe, rgb_rows, pentile_rgbg, delta, custom };
enum class Channel { r, g, b };
enum class LensType { plano_convex, surfaces, ideal, pinhole };
enum class Facing { viewer, panel };                                   // which way the convex side of a plano-convex lens faces
enum class Surround { opaque, clear, plate };                          // what is between the lenses
enum class LatticeKind { square, rectangle, hexagon, brick, strips };  // arrangement of the cells, one lens in each
enum class Aperture { circle, cell };                                  // cell: the lens covers its cell up to the borders
enum class Profile { box, gaussian };                                  // of the diffuser's angles, per axis
enum class PickupKind { nodal, traced, integrated, inverse };  // how a panel pixel's lines are chosen; inverse: by all views
enum class ErrorOf { eye, light };                             // errors of a fit are of code values, or of linear light
enum class ContentSampling { subpixel, pixel };                // the point of the panel for which a channel is computed
enum class MadeFor { description, built };                     // built: elemental images take [errors] into account
enum class Shading { file, smooth, flat };                     // which normals a mesh is lit by
enum class PixelFilter { center, box };                        // rays through pixel centres, or spread over the pixel
enum class Estimator { filtered, point, lens_by_lens };        // docs/model.md, "Filtered estimator"
enum class Sampling { sobol, random };                         // of points; docs/model.md, "Sampling"
enum class Fresnel { exact, schlick, none };                   // docs/model.md, "Refraction"

}  // namespace lfdsim
