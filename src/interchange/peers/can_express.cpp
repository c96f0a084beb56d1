#include "interchange/peers/peers.h"

#include "display/colour.h"
#include "geometry/lens_misalignment.h"
#include "interchange/meshed/lens_mesh.h"
#include "interchange/pov/pov_lenses.h"

#include <fmt/format.h>

namespace lfdsim {

using namespace peers;

namespace {

constexpr std::int64_t least_triangles = 100;  // so that the outline of a lens has some points on each side of its cell

/// Collects what cannot be expressed.
class Refusals {
  public:
    Refusals(Peer peer, const Display& d, const Geometry& g, const PeerOptions& o) : peer_(peer), d_(d), g_(g), options_(o) {}

    std::vector<Problem> all() {
        if (d_.lens.type() == LensType::ideal || (d_.lens.is_thin() && meshed())) {
            add("lens.type", d_.lens.type() == LensType::ideal
                                 ? "an ideal lens cannot be made of surfaces and glass; give the display a real lens"
                                 : "a pinhole has no surfaces to make triangles of; export pov without --triangles");
            return std::move(problems_);
        }
        if (lenses_differ(d_.errors)) differing();
        array();
        if (disperses(d_)) colour();
        if (d_.camera.pupil_diameter_mm.value_or(0) > 0)
            add("camera.pupil_diameter_mm", "the scene's camera is a pinhole; add --set camera.pupil_diameter_mm=none");
        if (peer_ == Peer::pov) pov();
        if (peer_ == Peer::cycles && d_.diffuser && d_.diffuser->profile != Profile::box)
            add("diffuser.profile", "Cycles' nodes can only draw box angles; add --set 'diffuser.profile=\"box\"'");
        triangles();
        return std::move(problems_);
    }

  private:
    void add(std::string where, std::string what) { problems_.push_back({std::move(where), std::move(what)}); }
    bool meshed() const { return peer_ != Peer::pov || options_.triangles; }

    /// Refuses what cannot be expressed where lenses differ: errors of single lenses, and a bow.
    void differing() {
        if (peer_ != Peer::pov)
            return add("errors",
                       "make lenses differ, and this scene has one mesh for all lenses and one for the space between them; give "
                       "shift_mm, gap_mm, rotation_deg, wedge_deg and pitch_ppm only, or export pov");
        if (options_.triangles)
            return add("--triangles", "are those of one lens, and [errors] make lenses differ; leave it out for true surfaces");
        const double lenses = g_.lattice.count[0] * g_.lattice.count[1];
        if (lenses > most_pov_lenses)
            return add("errors",
                       fmt::format("make {:.0f} lenses differ, each with separate shapes in the scene; at most {:.0f} may: give a "
                                   "smaller array.count, or give shift_mm, gap_mm, rotation_deg, wedge_deg and pitch_ppm only",
                                   lenses, most_pov_lenses));
        const PovLenses pov(d_, g_);
        if (d_.array.surround == Surround::opaque && !pov.walls())
            add("errors",
                "move or tilt lenses so far that their walls have no height in common for the scene's black sheet; give smaller "
                "bow_mm, height_sd_mm, tilt_sd_deg and table, or thicker lenses");
        if (d_.lens.stop_radius_mm && !pov.level())
            add("lens.stop_radius_mm",
                "is that of holes in one sheet, but [errors] put lenses at different heights; leave out bow_mm, height_sd_mm and "
                "heights in the table, or the stop");
    }

    void array() {
        const bool filled = d_.array.aperture == Aperture::cell;
        if (filled && d_.array.surround == Surround::plate && meshed())
            add("array.aperture",
                "a plate with lenses that fill their cells cannot be exported as triangles; give circle, another array.surround, "
                "or export true "
                "surfaces for pov");
        if (filled && d_.array.surround == Surround::clear && meshed())
            add("array.aperture",
                "bodies of glass that fill their cells touch, and coinciding triangles have no defined order; give circle, another "
                "array.surround, or export true surfaces for pov");
        if (d_.array.surround == Surround::clear && g_.surfaces.front().semi_aperture_mm != g_.surfaces.back().semi_aperture_mm)
            add("lens.surface.0.semi_aperture_mm",
                fmt::format("differs from the other surface's, so that the wall of the glass would be a cone; make both {} mm",
                            g_.surfaces.back().semi_aperture_mm));
    }

    void colour() {
        if (!options_.channel)
            add("panel.wavelengths_nm",
                "differ, and the scene's glass has one index; give --channel r, g or b for that colour alone");
        else if (wavelengths_of(d_, *options_.channel).size() > 1)
            add("render.wavelength_samples",
                "are more than one for each colour, and the scene's glass has one index; add --set render.wavelength_samples=1");
    }

    void pov() {
        if (d_.diffuser) add("diffuser", "POV-Ray cannot scatter rays as a diffuser does; add --set diffuser=none");
        if (d_.camera.pixel_filter != PixelFilter::center)
            add("camera.pixel_filter", "POV-Ray traces pixel centres; add --set 'camera.pixel_filter=\"center\"'");
        if (d_.panel.emission_exponent != 0)
            add("panel.emission_exponent", "POV-Ray's emission is Lambertian; add --set panel.emission_exponent=0");
    }

    void triangles() {
        if (!options_.triangles) return;
        const std::int64_t most = peer_ == Peer::pov ? most_pov_triangles : most_lens_triangles;
        if (*options_.triangles < least_triangles || *options_.triangles > most)
            add("--triangles", fmt::format("is {}, allowed is {} to {}", *options_.triangles, least_triangles, most));
    }

    const Peer peer_;
    const Display& d_;
    const Geometry& g_;
    const PeerOptions& options_;
    std::vector<Problem> problems_;
};

}  // namespace

std::vector<Problem> not_expressed(Peer peer, const Display& display, const Geometry& geometry, const PeerOptions& options) {
    return Refusals(peer, display, geometry, options).all();
}

}  // namespace lfdsim
