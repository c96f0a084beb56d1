// Views of a display from several directions, beside photographs of the scene that it shows. Floor 3.
#pragma once
#include "analysis/core/subject.h"
#include "engine/views/compare_view.h"

namespace lfdsim {

/// Returns the display with its camera at `eye`, mm, upright and directed at the panel's centre.
Display seen_by(const Display&, const Vec3d& eye);

/// Returns the display with its camera moved about the panel's centre at its distance |position|, from the axis first to the
/// right by `horizontal_deg`, then up by `vertical_deg`, and directed at the centre. Both angles within -80 to 80.
Display seen_from(const Display&, double horizontal_deg, double vertical_deg);

/// Returns the pixels of the display's camera that see the screen (engine/views/screen.h); empty if the camera is behind the
/// lenses.
Region seen_screen(const Display&, const Geometry&);
/// Returns the rectangle about a region. Throws InputError if it is empty.
Rect screen_box(const Region& screen);

/// Returns the pixels within the rectangle about the scene's box, as the camera sees it, that see the screen.
Region content_region(const Display&, const Geometry&, const ContentScene&);

/// Throws InputError for `where` if the scene's centre at this depth in front of the vertex plane would be inside the lenses.
void refuse_depth_in_lenses(const Geometry&, double depth_mm, const std::string& where);

/// Returns the factor that makes a white screen's light `white` (Subject::white_field()) 1.
float exposure(double white);
/// Multiplies a picture's light by exposure(white).
void expose(Image&, double white);

/// What a view should look like: the photograph of the scene, in the part of the camera's frame that contains the screen.
struct ExpectedView {
    Rect box;  // of the frame, pixels
    Expected expected;
};

/// Takes the photograph for a display's camera. Throws Stopped; InputError if no pixel sees the screen.
ExpectedView expected_view(const Display& seen, const Geometry&, const ContentScene&, int threads, const Job&);

/// Renders the view of a panel and compares it, light divided by `white`, with what is expected. Throws Stopped.
Likeness likeness(const ExpectedView&, const Display& seen, const Geometry&, const SummedPanel& panel, double white, RenderOptions,
                  const Job&);

/// Returns the standard deviation of each figure of a likeness by the rendering's noise. The view is rendered again, with other
/// random numbers or with more samples. Throws Stopped.
Likeness likeness_error(const Likeness& first, const ExpectedView&, const Display& seen, const Geometry&, const SummedPanel& panel,
                        double white, const RenderOptions&, const Job&);

}  // namespace lfdsim
