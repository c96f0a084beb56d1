// Views of a display from several directions, beside photographs of the scene that it shows. Floor 3.
#pragma once
#include "analysis/core/subject.h"
#include "engine/views/compare_view.h"

namespace lfdsim {

/// The display with its camera at `eye`, upright, looking at the panel's centre.
Display seen_by(const Display&, const Vec3d& eye);

/// The display with its camera moved about the panel's centre at its distance |position|, from on axis: first to the right by
/// `horizontal_deg`, then up by `vertical_deg`; it looks at the centre. Both within -80 .. 80.
Display seen_from(const Display&, double horizontal_deg, double vertical_deg);

/// The pixels of the display's camera that see the screen (engine/views/screen.h). Empty if the camera is not in front.
Region seen_screen(const Display&, const Geometry&);
/// The rectangle about it. InputError where no pixel sees the screen.
Rect screen_box(const Region& screen);

/// The rectangle about the pixels that may show the scene's box, where they see the screen too.
Region content_region(const Display&, const Geometry&, const ContentScene&);

/// Throws InputError for `where` if the scene's centre at this depth in front of the vertex plane would be inside the lenses.
void refuse_depth_in_lenses(const Geometry&, double depth_mm, const std::string& where);

/// The factor that brings a white screen's light from `white` to 1.
float exposure(double white);
void expose(Image&, double white);

/// What a view should look like: the photograph of the scene, of the part of the camera's frame that holds the screen.
struct ExpectedView {
    Rect box;  // of the frame
    Expected expected;
};

/// Throws Stopped; InputError if no pixel sees the screen.
ExpectedView expected_view(const Display& seen, const Geometry&, const ContentScene&, int threads, const Job&);

/// Renders the view and compares it. Throws Stopped.
Likeness likeness(const ExpectedView&, const Display& seen, const Geometry&, const SummedPanel& panel, double white, RenderOptions,
                  const Job&);

/// The error of `first`, a likeness, by the rendering's noise: renders again with other random numbers or more of them. Standard
/// deviation of each figure. Throws Stopped.
Likeness likeness_error(const Likeness& first, const ExpectedView&, const Display& seen, const Geometry&, const SummedPanel& panel,
                        double white, const RenderOptions&, const Job&);

}  // namespace lfdsim
