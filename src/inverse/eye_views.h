// The views of eyes: what they should see, what they see of a white panel, and which of their elements count. Floor 3.
#pragma once
#include "content/content.h"
#include "content/pictures/light_field.h"
#include "engine/estimator/summed_panel.h"
#include "inverse/fitted_views.h"
#include "inverse/plan.h"

#include <atomic>
#include <optional>
#include <span>
#include <vector>

namespace lfdsim {

/// Returns a function that photographs a scene, which must outlive it.
ContentOf photographs_of(const ContentScene&, int threads);

/// Rays from eyes in the boxes through a grid of views, and those that pass beside its cameras.
struct FieldRays {
    std::atomic<std::int64_t> all{0}, unseen{0};
};
/// Returns a function that computes what a camera sees of a grid of views, whose focus is in the plane z = focus_z_mm: the mean of
/// lines through each pixel. A pixel of which some lines are not shown by any view is NaN, and does not count. Field, boxes and
/// rays, which are counted, must outlive it.
ContentOf pictures_of(const LightField&, double focus_z_mm, std::span<const EyeBox>, FieldRays&);

/// Returns the views of eyes as a display shows them, of which no element counts yet; nothing if the job is cancelled. `rays`: of
/// an element's row; `white_points`: by which its light of a white panel, `white`, is computed; `samples`: of a pixel of the
/// content.
std::optional<std::vector<View>> views_of(const Request&, const Display&, std::span<const Eye>, std::int64_t rays,
                                          std::int64_t white_points, std::int64_t samples, const SummedPanel& white,
                                          const char* stage);

/// Returns G, the median light of a white panel over the elements of eyes in the boxes, without those that are dim, or partly
/// between lenses. Throws InputError if there is none.
double gain_of(const Request&, std::span<const View>);

/// Sets View::expected, q of docs/inverse.md: which elements count, and the share of the gain that each can show, what it sees of a
/// white panel over the most that an element within a lens pitch of it does. Where this is much less than 1, or the most much less
/// than the gain, or the content is unknown (NaN, which becomes 0), the element does not count.
void expect_light(std::vector<View>&, double gain);

}  // namespace lfdsim
