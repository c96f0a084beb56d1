// Views of a display from around it, beside photographs of the scene that it shows. Floor 3.
#pragma once
#include "analysis/subject.h"
#include "image/ssim.h"

namespace lfdsim {

/// The display with its camera gone round the panel's centre at its distance |position|, from on axis: first to the right by
/// `horizontal_deg`, then up by `vertical_deg`; it looks at the centre. Both within -80 .. 80.
Display seen_from(const Display&, double horizontal_deg, double vertical_deg);

/// The pixels of the display's camera that see the array's rectangle, in the vertex plane. Empty if the camera is not before it.
Region screen_region(const Display&, const Geometry&);

/// The rectangle about the pixels that may show the scene's box, where they see the screen too.
Region content_region(const Display&, const Geometry&, const Scene&);

/// Throws InputError for `where` if the scene's centre at this depth before the vertex plane would be inside the lenses.
void refuse_depth_in_lenses(const Geometry&, double depth_mm, const std::string& where);

/// Light of the picture divided by `white`, so that a white screen has 1.
void expose(Image&, double white);

/// A view and its photograph: the part of the camera's frame that holds the screen. Regions count from that part's corner.
struct View {
    Image simulated, photograph;
    Region screen, content;
};

/// Throws Stopped; InputError if no pixel sees the screen.
View view_of(const Display& seen, const Geometry&, const Scene&, const Pyramid& panel, double white, int threads, const Job&);

struct Likeness {
    double screen, content;  // SSIM; content: NaN where too few pixels see it
    /// Over the screen, linear light: covariance of view and photograph over the photograph's variance. A view that blends a share
    /// s of the right picture with one unlike it has s; SSIM falls much faster. NaN where the photograph has one colour.
    double share;
};
Likeness likeness(const View&);

/// How far one rendering's noise carries SSIM off: renders again with other random numbers and more of them. Standard deviation, of
/// the screen and of the content.
Likeness likeness_error(const View&, const Display& seen, const Geometry&, const Pyramid& panel, double white, int threads,
                        const Job&);

}  // namespace lfdsim
