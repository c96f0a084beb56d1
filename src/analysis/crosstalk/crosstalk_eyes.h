// The eyes with which crosstalk is measured: what they see along lines of sight, and by theory. Floor 3.
#pragma once
#include "analysis/core/parallel.h"
#include "analysis/crosstalk/crosstalk.h"
#include "analysis/crosstalk/intended_light.h"
#include "analysis/crosstalk/intended_theory.h"
#include "analysis/crosstalk/pixel_views.h"
#include "base/constants.h"

#include <cmath>
#include <optional>
#include <string>

namespace lfdsim {

namespace crosstalk {
inline constexpr int lines_a_set = 512, fine_lines_a_set = 16384, lines_of_theory = 8192;  // in each set, and as many mirrored
inline constexpr int most_views = 61, places_of_curves = 97, heads = 61, halvings = 3, limits = 6;

inline const char* name_of(ContentSampling sampling) { return sampling == ContentSampling::subpixel ? "subpixel" : "pixel"; }
inline const char* made_for(ContentSampling sampling) {
    return sampling == ContentSampling::subpixel ? "content for each subpixel" : "content for whole pixels";
}

inline constexpr const char* left_to_rounding =
    "centres of pixels lie on the border of two lenses' elemental images: rounding decides to which lens, and so to which eye, "
    "they are assigned; lfdsim check states the remedy";

inline constexpr const char* no_light = "neither this light nor that which the eye should see reaches it";

/// Returns the reason why crosstalk has no value; empty if it has one. `none`: the reason if rounding is not.
inline std::string missing_of(const Crosstalk& found, const char* none) {
    return found.left_to_rounding ? left_to_rounding : std::isnan(found.percent.value) ? none : "";
}
/// Returns crosstalk, per cent, with its error as a figure, or with the reason why it has none.
inline FigureValue figure_of(const Crosstalk& found, const char* none = no_light) {
    return {std::vector{found.percent.value}, std::vector{found.percent.error}, missing_of(found, none)};
}
inline FigureValue theory_figure(const Crosstalk& found, const char* none = no_light) {
    return {found.percent.value, missing_of(found, none)};
}

/// Returns whether many lines of sight end on a dark part of the panel, or on a dim channel: means then need more lines.
inline bool structured(const Subject& s) { return !lights_whole_pixels(s.display().panel); }

/// Eyes level with the screen's middle, at the viewing distance, and the light of each view that reaches them.
class Eyes {
  public:
    Eyes(Subject& s, Job& job)
        : distance_(checked_viewing_distance_mm(s)),
          line(line_of_eyes(s.geometry().lattice)),
          eye_mm(distance_ - s.geometry().rear_principal_mm),
          shown(s.display(), s.geometry(), s.display().content.sampling),
          pixels_(s.display(), s.geometry(), ContentSampling::pixel),
          views(s, pixels_),
          parts(job, s.threads(), most_views + 1 + places_of_curves + heads + limits, crosstalk_steps(s)),
          paths_(s.display(), s.geometry()),
          theory_(s.display(), s.geometry()),
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

    /// The lines of sight of a figure: few for curves, many for single figures (fine), and as many with other random numbers
    /// (anew).
    enum class Lines { curve, fine, anew };
    /// Returns the position of an eye at `aside` mm from the display's axis on the line of eyes, to the right or up.
    Vec3d place(double aside) const { return line == 1 ? Vec3d{0, aside, distance_} : Vec3d{aside, 0, distance_}; }
    /// Returns the points of the panel that this eye sees.
    MetPlaces at(double aside, Lines lines = Lines::curve) const {
        return paths_.look(place(aside), lines == Lines::curve ? lines_ : lines == Lines::fine ? fine_ : anew_);
    }
    /// Returns the light of these points by the slopes for which it is intended.
    MeantLight light(const MetPlaces& met, const MeantPanel& panel) const { return {met, paths_.weights(), panel}; }
    /// Returns at() by theory, with paraxial lenses and light of all channels together.
    MetPlaces theory_at(double aside, Lines lines) const {
        return theory_.look(place(aside), lines == Lines::curve ? of_theory_curve_ : of_theory_);
    }
    MeantLight theory_light(const MetPlaces& met, const MeantPanel& panel) const { return {met, {luminance_weights}, panel}; }

    /// Returns the distance between neighbouring views at the eye: (a/g) E, mm.
    double view_mm() const { return views.step_slope() * eye_mm; }
    /// Returns the light of the view whose middle is at `middle` steps.
    LightPart view(const MeantLight& light, double middle) const {
        return light.between((middle - 0.5) * views.step_slope(), (middle + 0.5) * views.step_slope());
    }
    /// Returns the light of a view, and that of all other views as its leak.
    Leak of_view(const MeantLight& light, double middle) const {
        Leak found{view(light, middle), light.all()};
        for (std::size_t k = 0; k < found.leak.light.size(); ++k) found.leak.light[k] -= found.signal.light[k];
        found.leak.open += found.signal.open;
        return found;
    }

  private:
    double distance_;

  public:
    std::size_t line;                               // of eyes: 0 side by side, 1 one above the other, where strips lie flat
    double eye_mm;                                  // E, of the eye from H'
    MeantPanel shown;                               // the panel with content as described
    std::optional<ContentSampling> other_sampling;  // the sampling that is not described, on panels with subpixels
    std::optional<MeantPanel> other;                // the panel with content made by that

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

/// Adds the crosstalk between two eyes whose head moves to the sides. The panel's picture does not change: content for slopes
/// above 0 remains intended for the right eye.
void between_eyes(const Subject&, Eyes&, Result&);

}  // namespace crosstalk
}  // namespace lfdsim
