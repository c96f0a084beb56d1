// What crosstalk is measured with: eyes that look along lines of sight, and what theory says they see. Floor 3.
#pragma once
#include "analysis/core/parallel.h"
#include "analysis/crosstalk/crosstalk.h"
#include "analysis/crosstalk/intended_light.h"
#include "analysis/crosstalk/intended_theory.h"
#include "analysis/crosstalk/pixel_views.h"
#include "base/constants.h"

#include <optional>

namespace lfdsim {

namespace crosstalk {
inline constexpr int lines_a_set = 512, fine_lines_a_set = 16384, lines_of_theory = 8192;  // and as many mirrored
inline constexpr int most_views = 61, places_of_curves = 97, heads = 61, halvings = 3, limits = 6;

inline const char* name_of(ContentSampling sampling) { return sampling == ContentSampling::subpixel ? "subpixel" : "pixel"; }
inline const char* made_for(ContentSampling sampling) {
    return sampling == ContentSampling::subpixel ? "content for each subpixel" : "content for whole pixels";
}

/// A view's light, or an eye's, and that which it should not see.
struct Leak {
    LightPart signal, leak;
};

inline constexpr const char* left_to_rounding =
    "centres of pixels lie on the border of two lenses' elemental images: rounding decides to which lens, and so to which eye, "
    "they are assigned; lfdsim check states the remedy";

inline FigureValue figure_of(const Crosstalk& found) {
    return {std::vector{found.percent.value}, std::vector{found.percent.error}, found.left_to_rounding ? left_to_rounding : ""};
}
inline FigureValue theory_figure(const Crosstalk& c) { return {c.percent.value, c.left_to_rounding ? left_to_rounding : ""}; }

/// Whether many lines of sight end where it is dark, or where a colour shines that is dim.
inline bool structured(const Subject& s) { return !shines_all_over(s.display().panel); }

/// An eye level with the screen's middle, at the viewing distance, and the light of each view that reaches it.
class Eyes {
  public:
    Eyes(Subject& s, Job& job)
        : distance_(checked_viewing_distance_mm(s)),
          eye_mm(distance_ - s.geometry().rear_principal_mm),
          shown(s.display(), s.geometry(), s.display().content.sampling),
          pixels_(s.display(), s.geometry(), ContentSampling::pixel),
          views(s, pixels_),
          parts(job, s.threads(), most_views + 1 + places_of_curves + heads + limits, crosstalk_steps(s)),
          paths_(s.display(), s.geometry()),
          theory_(s, distance_),
          more_(paths_.more_for({0, 0, distance_})),
          lines_(lines_a_set * (structured(s) ? 2 : 1) * more_, s.display().render.seed),
          fine_(fine_lines_a_set * (structured(s) ? 4 : 1) * more_, s.display().render.seed),
          anew_(fine_lines_a_set * (structured(s) ? 4 : 1) * more_, s.display().render.seed, independent_sets),
          of_theory_(lines_of_theory, 0),
          of_theory_curve_(lines_of_theory / 16, 0) {
        if (s.display().panel.subpixels == SubpixelLayout::none) return;
        const bool by_subpixel = s.display().content.sampling == ContentSampling::subpixel;
        other_sampling = by_subpixel ? ContentSampling::pixel : ContentSampling::subpixel;
        other.emplace(s.display(), s.geometry(), *other_sampling);
    }

    enum class Lines { curve, fine, anew };  // anew: as fine, but with random numbers of their own
    MetPlaces at(double x, Lines lines = Lines::curve) const {
        return paths_.look({x, 0, distance_}, lines == Lines::curve ? lines_ : lines == Lines::fine ? fine_ : anew_);
    }
    MeantLight light(const MetPlaces& met, const MeantPanel& panel) const { return {met, paths_.weights(), panel}; }
    MetPlaces theory_at(double x, Lines lines) const {
        return theory_.look(x, lines == Lines::curve ? of_theory_curve_ : of_theory_);
    }
    MeantLight theory_light(const MetPlaces& met, const MeantPanel& panel) const { return {met, {luminance_weights}, panel}; }

    double view_mm() const { return views.step_slope() * eye_mm; }
    /// Light of the view whose middle, in steps, this is.
    LightPart view(const MeantLight& light, double middle) const {
        return light.between((middle - 0.5) * views.step_slope(), (middle + 0.5) * views.step_slope());
    }
    Leak of_view(const MeantLight& light, double middle) const {
        Leak found{view(light, middle), light.all()};
        for (std::size_t k = 0; k < found.leak.light.size(); ++k) found.leak.light[k] -= found.signal.light[k];
        found.leak.open += found.signal.open;
        return found;
    }
    /// The leak of the left (0) or right eye (1).
    static Leak of_side(const MeantLight& light, std::size_t side) {
        const LightPart left = light.between(-infinity, 0), right = light.between(0, infinity);
        return side == 0 ? Leak{left, right} : Leak{right, left};
    }

  private:
    double distance_;

  public:
    double eye_mm;
    MeantPanel shown;  // with the description's content
    std::optional<ContentSampling> other_sampling;
    std::optional<MeantPanel> other;

  private:
    MeantPanel pixels_;

  public:
    PixelViews views;
    Parts parts;

  private:
    EyePaths paths_;
    MeantTheory theory_;
    int more_;
    LineSets lines_, fine_, anew_, of_theory_, of_theory_curve_;
};

inline Crosstalk crosstalk_of(const MeantLight& light, const Leak& found) {
    return crosstalk_of(found.leak, found.signal, light.missed());
}

/// Two eyes whose head moves, while the right half of what the panel shows stays meant for the right eye.
void between_eyes(const Subject&, Eyes&, Result&);

}  // namespace crosstalk
}  // namespace lfdsim
