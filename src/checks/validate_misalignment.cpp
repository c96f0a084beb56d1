// Checks of errors of the array: they are refused where parts would collide, or where the rays of such a display are not defined.
// docs/model.md, "Errors".
#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "checks/findings.h"
#include "display/colour.h"
#include "geometry/lens_misalignment.h"
#include "geometry/prescription.h"

namespace lfdsim {
namespace {

/// The errors of a display that is valid without them. g_ is the geometry without them, too.
class ErrorsCheck {
  public:
    ErrorsCheck(const Display& d, Findings& f) : d_(d), e_(d.errors), g_(resolve_unchecked(without_errors(d))), findings_(f) {}

    void check() {
        if (d_.array.surround == Surround::clear) refuse_all("array.surround = \"clear\" has no sheet that holds its lenses", true);
        if (g_.glued) refuse_all("the lens is glued to the layers or the panel", false);
        if (d_.array.surround == Surround::plate)
            refuse_each("tilt_sd_deg", e_.tilt_sd_deg != 0, "tilts", has(&LensErrorBounds::tilt_deg),
                        "a moulded plate's lenses are parts of one sheet, which do not turn");
        if (d_.array.surround == Surround::plate && is_irregular(e_) && hollow())
            findings_.add("errors", "{}",
                          "would move or deform concave lenses in a moulded plate, in which they cannot move; leave them out");
        if (d_.content.made_for == MadeFor::built && is_strips(d_.array) && is_wedged(e_))
            findings_.add("content.made_for", "{}",
                          "is \"built\", but elemental images cannot be calibrated for the wedge of strips; take \"description\"");
        if (d_.lens.type() == LensType::pinhole)
            refuse_each("curvature_sd", e_.curvature_sd != 0, "curvatures", has(&LensErrorBounds::curvature),
                        "a pinhole has no curvature");
        if (lenses_differ(e_)) check_lenses();
        check_heights();
    }

  private:
    /// Refuses the errors that lenses cannot have, for the reason `why`. With `sideways` these are all errors (no tracer for them
    /// in that surround), else those that lift or tilt lenses: a glued lens may still be shifted and rotated.
    void refuse_all(std::string_view why, bool sideways) {
        const std::string what = fmt::format("is given, but {}; leave it out", why);
        const auto one = [&](const char* key, bool given) { refuse(key, given, what); };
        one("gap_mm", e_.gap_mm != 0);
        one("wedge_deg", e_.wedge_deg[0] != 0 || e_.wedge_deg[1] != 0);
        one("bow_mm", e_.bow_mm != 0);
        one("height_sd_mm", e_.height_sd_mm != 0);
        one("tilt_sd_deg", e_.tilt_sd_deg != 0);
        const bool lifts = has(&LensErrorBounds::height_mm) || has(&LensErrorBounds::tilt_deg);
        one("table", sideways ? e_.given != nullptr : lifts);
        if (!sideways) return;
        one("shift_mm", e_.shift_mm[0] != 0 || e_.shift_mm[1] != 0);
        one("rotation_deg", e_.rotation_deg != 0);
        one("pitch_ppm", e_.pitch_ppm != 0);
        one("decenter_sd_mm", e_.decenter_sd_mm != 0);
        one("curvature_sd", e_.curvature_sd != 0);
    }
    /// Refuses an error of single lenses where it is drawn (`key`) and where the table gives it (`column`).
    void refuse_each(const char* key, bool drawn, const char* column, bool in_table, std::string_view why) {
        refuse(key, drawn, fmt::format("is given, but {}; leave it out", why));
        refuse("table", in_table, fmt::format("gives {}, but {}; make them 0", column, why));
    }
    /// Adds a problem with errors.`key` if it is given and has none yet.
    void refuse(const char* key, bool given, std::string_view what) {
        const std::string path = fmt::format("errors.{}", key);
        if (given && findings_.sound(path)) findings_.add(path, "{}", what);
    }

    /// Returns whether a face of the lens is concave to the outside: somewhere it lies lower than its rim.
    bool hollow() const {
        const auto rim = [](const PlacedSurface& s) { return sag_mm(s, s.semi_aperture_mm); };
        return sag_range_mm(g_.surfaces.back())[0] < rim(g_.surfaces.back()) - rounding_mm ||
               sag_range_mm(g_.surfaces.front())[1] > rim(g_.surfaces.front()) + rounding_mm;
    }

    /// Returns whether the table alone gives errors of a kind, a member of LensErrorBounds.
    template <class Member>
    bool has(Member member) const {
        Errors table;
        table.given = e_.given;
        const LensErrorBounds b = bounds(d_.array, table);
        return std::ranges::any_of(b.*member, [](double x) { return x != 0; });
    }
    /// Returns the key that is responsible for a bound: the standard deviation's, or the table if there is none.
    const char* of(const char* key, double sd) const { return sd != 0 || !e_.given ? key : "errors.table"; }

    /// Checks the errors of single lenses by their bounds: three standard deviations and the table. Displacements are limited to
    /// the larger of half the clearance between lenses and a twentieth of the pitch, since rays are tested only against lenses
    /// near their lattice positions.
    void check_lenses() {
        const double lenses = g_.lattice.count[0] * g_.lattice.count[1];
        if (lenses > most_different_lenses)
            findings_.add("errors", "the {:.0f} lenses of the array would differ from each other; at most {:.0f} may", lenses,
                          most_different_lenses);
        const LensErrorBounds b = bounds(d_.array, e_);
        const double clearance = d_.array.aperture == Aperture::cell ? 0 : 2 * (inner_radius_mm(d_.array) - g_.glass_radius_mm);
        const double aside = std::max(b.aside_mm[0], b.aside_mm[1]),
                     most = std::max(clearance / 2, 0.05 * d_.array.pitch_mm.least());
        if (aside > most + rounding_mm)
            findings_.add(of("errors.decenter_sd_mm", e_.decenter_sd_mm),
                          "lenses move by up to {:.6g} mm (three standard deviations and the table); at most {:.6g} mm, the "
                          "greater of half the clearance and a twentieth of the pitch, as rays are traced only to lenses near "
                          "their lattice positions: a decenter_sd_mm of up to {:.4g} without a table",
                          aside, most, std::floor(1e4 * most / 3 + 1e-9) / 1e4);
        if (std::max(b.tilt_deg[0], b.tilt_deg[1]) > 30)
            findings_.add(of("errors.tilt_sd_deg", e_.tilt_sd_deg), "lenses turn by up to {:.6g} degrees; at most 30",
                          std::max(b.tilt_deg[0], b.tilt_deg[1]));
        for (const double e : b.curvature)
            if (const std::string wrong = curved(e); e != 0 && !wrong.empty()) {
                findings_.add(of("errors.curvature_sd", e_.curvature_sd),
                              "a lens's curvatures are up to {:.6g} times the nominal ones: {}", 1 + e, wrong);
                break;
            }
    }

    /// Returns what is wrong with a lens whose curvatures are 1 + e times the nominal ones; empty if nothing.
    std::string curved(double e) const {
        if (e <= -0.9) return "less than a tenth";
        if (d_.lens.is_thin()) return {};
        std::vector<PlacedSurface> surfaces = g_.surfaces;
        for (PlacedSurface& s : surfaces) {
            s.curvature_per_mm *= 1 + e;
            const auto [low, high] = sag_range_mm(s);
            if (!std::isfinite(low) || !std::isfinite(high)) return "its surface would not reach the rim";
        }
        return {};
    }

    /// Checks the lowest and the highest z that lenses reach with all errors together: they must stay above the layers and below
    /// diffuser, camera and viewer.
    void check_heights() {
        const LensErrorBounds b = bounds(d_.array, e_);
        const double tilt = std::max(b.tilt_deg[0], b.tilt_deg[1]) * degree,
                     // of a rim; a lens below its vertex by t swings aside, not down
            swing = g_.glass_radius_mm * std::sin(tilt),
                     wedge = (std::abs(std::sin(e_.wedge_deg[0] * degree)) * g_.array_height_mm +
                              std::abs(std::sin(e_.wedge_deg[1] * degree)) * g_.array_width_mm) /
                             2;
        const double down = e_.gap_mm + b.height_mm[0] + std::min(e_.bow_mm, 0.) - swing - wedge,
                     up = e_.gap_mm + b.height_mm[1] + std::max(e_.bow_mm, 0.) + swing + wedge;
        const double into = g_.layers_top_mm - (g_.base_z_mm + down), top = g_.top_z_mm + up;
        if (!g_.glued && !(into <= rounding_mm) && down < 0)
            findings_.add(culprit(),
                          "moves lenses by up to {:.6g} mm towards the panel, {:.6g} mm into the {}; give less, or a larger gap",
                          -down, into, d_.panel.layers.empty() ? "panel" : "panel's layers");
        else if (up > 0 && g_.diffuser_z_mm && !(*g_.diffuser_z_mm > top))
            findings_.add(culprit(), "moves lenses by up to {:.6g} mm towards the viewer, into the diffuser at {:.6g} mm", up,
                          *g_.diffuser_z_mm);
        else if (up > 0 && !(d_.camera.position_mm[2] > top && d_.content.viewing_distance_mm > top))
            findings_.add(culprit(), "moves lenses by up to {:.6g} mm towards the viewer, as far as the camera or the viewer", up);
    }
    /// Returns the key that moves lenses up or down: the first that is given.
    const char* culprit() const {
        return e_.gap_mm != 0                                 ? "errors.gap_mm"
               : e_.wedge_deg[0] != 0 || e_.wedge_deg[1] != 0 ? "errors.wedge_deg"
               : e_.bow_mm != 0                               ? "errors.bow_mm"
               : e_.height_sd_mm != 0                         ? "errors.height_sd_mm"
               : e_.tilt_sd_deg != 0                          ? "errors.tilt_sd_deg"
                                                              : "errors.table";
    }

    const Display& d_;
    const Errors& e_;
    const Geometry g_;
    Findings& findings_;
};

}  // namespace

void validate_errors(const Display& d, Findings& findings) {
    if (!has_errors(d.errors)) return;
    for (const char* needed : {"lens.", "array.", "errors.", "panel.", "diffuser.", "camera.", "content."})
        if (!findings.sound(needed)) return;
    ErrorsCheck(d, findings).check();
}

}  // namespace lfdsim
