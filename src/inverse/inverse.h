// Content by inversion: the panel picture whose views are best, by the display's own tracer. Floor 3, public.
#pragma once
#include "content/content.h"
#include "inverse/eye_places.h"
#include "inverse/nearness.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lfdsim {

class LightField;  // content/pictures/light_field.h

/// Given pictures in place of a scene: what the display's camera, moved to each of these eyes, should see.
struct EyePictures {
    std::vector<Vec3d> eyes_mm;   // in the display's frame
    std::vector<Image> pictures;  // one for each eye, linear light, of any size with the proportions of the camera's
};

/// What a fit was made of, and how good it is.
struct InverseReport {
    std::vector<EyeBox> boxes;                // of the eyes that are served
    std::int64_t places = 0, rim_places = 0;  // eyes fitted in the boxes and around them
    std::int64_t rays = 0;                    // of all elements of all fitted views
    std::int64_t rays_per_element = 0;
    double rows_per_unknown = 0, rays_per_unknown = 0;  // elements of views, and their rays with light, for each panel pixel met
    int iterations = 0;
    double seconds = 0;                                                     // of the whole fit, whose steps use the same rays
    double gain = 0;                                                        // G, the light of a white panel at these eyes
    double black = 0, white = 1, prior = 0;                                 // the levels B and W; the prior
    Nearness fitted, held_out;                                              // means over eyes
    Nearness held_out_traced, held_out_integrated;                          // of simple content, at held-out eyes
    double at_black_percent = 0, at_white_percent = 0, unseen_percent = 0;  // of the panel's subpixels
    /// Of two boxes of eyes: the share of one's light that the other sees if each subpixel shows the picture of those that get most
    /// of its light; levels crosstalk/(1 + crosstalk) and 1/(1 + crosstalk) leave room to subtract all of it.
    std::optional<double> crosstalk;
    PickupKind result = PickupKind::inverse;  // traced or integrated: content that serves held-out eyes better
    std::vector<std::string> warnings;
};

/// A panel picture by the inverse pick-up.
struct InvertedPanel {
    Picture picture;
    InverseReport report;
};

/// Returns the panel picture of a scene by the inverse pick-up: least squares over the panel's light, between 0 and 1, of what eyes
/// in the boxes see (docs/inverse.md has the equations). If the job is cancelled after the first step, this is the best panel so
/// far, before that traced content, and the picture is not complete. It has the same bits for any number of threads and kernel.
/// Throws InputError for eyes that cannot see the display, and where there is too little memory.
InvertedPanel invert(const Display&, const Geometry&, const ContentScene&, std::span<const EyeBox>, int threads, Job&);

/// Solves for the panel picture of a grid of views in place of a scene.
InvertedPanel invert(const Display&, const Geometry&, const LightField&, std::span<const EyeBox>, int threads, Job&);

/// Solves for the panel picture of given pictures; there are no held-out eyes, and the panel of the last step is taken. Throws
/// InputError, too, unless there is one picture for each eye.
InvertedPanel invert(const Display&, const Geometry&, const EyePictures&, int threads, Job&);

}  // namespace lfdsim
