#include "analysis/uniformity/luminance_theory.h"

#include "analysis/core/eye_rays.h"
#include "analysis/crosstalk/paraxial_lines.h"
#include "base/constants.h"
#include "engine/scene/traced_display.h"
#include "geometry/lens_misalignment.h"
#include "geometry/screen.h"
#include "optics/layers.h"
#include "optics/lens.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace lfdsim {
namespace {

/// Returns the transmittance of all surfaces at normal incidence, product of 4 n1 n2/(n1 + n2)^2: the lens's, and those of the
/// layers that no lens is glued onto.
double transmission(const Display& d, const Geometry& g) {
    if (d.render.fresnel == Fresnel::none) return 1;
    double t = 1;
    const auto cross = [&](double below, double above) { t *= 4 * below * above / ((below + above) * (below + above)); };
    for (const PlacedSurface& s : g.surfaces) cross(s.index_below, s.index_above);
    const std::vector<PlacedLayer>& layers = g.layers;
    for (std::size_t k = 0; k < layers.size(); ++k) {
        const bool top = k + 1 == layers.size();
        if (!(top && g.glued)) cross(layers[k].index, top ? 1 : layers[k + 1].index);
    }
    return t;
}

/// Returns the luminance, relative to the panel's, of a line of sight that passes beside the lens's aperture.
double beside(const Display& d, const Geometry& g) {
    if (d.lens.is_thin() || d.array.surround == Surround::opaque || d.lens.stop_radius_mm) return 0;
    return d.array.surround == Surround::plate ? transmission(d, g) : 1;
}

/// An isolated glass lens: lines are refracted at its surfaces by Snell's law, with Fresnel's transmittances. Occlusion by other
/// lenses, and light that continues through walls, are left out.
class RealLens {
  public:
    RealLens(const Display& d, const Geometry& g)
        : scene_(make_traced_display<double>(without_errors(d), g)), rear_principal_mm_(g.rear_principal_mm) {}

    /// The end of a line of sight on the panel.
    struct PanelEnd {
        optics::Vec2<double> place;  // from the array's centre, in its frame
        double weight;               // 0: the line ends on its way
    };
    /// Traces a line that comes down to the lenses as `line` does.
    PanelEnd look(const ParaxialLine& line) const {
        const Lattice<double>& l = scene_.lattice;
        const double length = std::sqrt(1 + line.slope.x * line.slope.x + line.slope.y * line.slope.y),
                     down = scene_.surface[0].z - rear_principal_mm_;
        const optics::Vec3<double> to{-line.slope.x / length, -line.slope.y / length, -1 / length};
        optics::Vec2<double> axis = line.axis;
        optics::Ray<double> entering{};
        optics::Hit<double> hit{};
        // A line may meet the surface of a lens beside the one over which it passes the plane of H': the lens is searched for
        // anew at each hit.
        constexpr int steps = 4;
        for (int step = 0; step < steps; ++step) {
            entering = {{line.at.x + down * line.slope.x - axis.x, line.at.y + down * line.slope.y - (l.strips ? 0 : axis.y), 0},
                        to};
            hit = optics::meet<optics::Facts{}>(scene_, 0, entering);
            const optics::Cell<double> lens = optics::lens_at(l, hit.at.x + axis.x, hit.at.y + axis.y);
            if (!optics::holds(l, lens)) return {{}, 0};
            const optics::Vec2<double> next = optics::axis_in_array(l, lens);
            if (next.x == axis.x && next.y == axis.y) break;
            axis = next;
        }
        optics::Passage<double> passage{entering, {0, 0}, 1, true};
        optics::pass_lens<optics::Facts{}>(scene_, Rules{{scene_}}, entering, hit, passage);
        if (!passage.alive) return {{}, 0};
        const double z = scene_.surface[scene_.surface_count - 1].z;
        const auto end = optics::down_to_panel(scene_, {passage.ray.at.x, passage.ray.at.y, passage.ray.at.z + z}, scene_.glued,
                                               passage.ray.to, passage.weight, passage.alive);
        return {{axis.x + end.x, (l.strips ? 0 : axis.y) + end.y}, passage.alive ? passage.weight : 0};
    }

  private:
    /// The rules of pass_lens() for one lens: apertures, and the borders of its cell.
    struct Rules : optics::SingleLens<double> {
        bool within(double x, double y, bool ok) const {
            return ok && (display.aperture == Aperture::circle || optics::in_cell(display.lattice, x, y));
        }
        void meets(int, const optics::Ray<double>&, const optics::Hit<double>& hit, double from_z, double z,
                   optics::Passage<double>& passage) const {
            passage.alive = passage.alive && within(hit.at.x, hit.at.y, hit.ok) && z <= from_z;
        }
        void leaves(const optics::Passage<double>&) const {}
        bool passes_back(double x, double y) const {
            const double r = display.surface[display.surface_count - 1].semi_aperture, up = optics::across(display.lattice, y);
            return within(x, y, x * x + up * up <= r * r);
        }
        bool over(bool alive) const { return !alive; }
    };

    optics::TracedDisplay<double> scene_;
    double rear_principal_mm_;
};

/// Mean luminance over lines of sight that aim at the screen in the vertex plane: evenly chosen lenses, positions in their cells
/// and angles of the diffuser.
struct Means {
    double paraxial;  // of lenses without aberration
    double real;      // of the real lenses; of thin ones the same
};
Means seen_means(const Display& d, const Geometry& g, double eye_mm) {
    const int count = d.lens.is_thin() ? 1 << 19 : 1 << 18;
    const ParaxialLines lines(d, g, {0, 0, eye_mm});
    std::optional<RealLens> lens;
    if (!d.lens.is_thin()) lens.emplace(d, g);
    const Lattice<double>& l = g.lattice;
    const double through = transmission(d, g), past = beside(d, g);
    // The scale from the aim in the vertex plane to the plane of H', as the eye projects it
    const double on_to_principal = (eye_mm - g.rear_principal_mm) / (eye_mm - g.vertex_plane_mm);
    const PanelBehind panel(g);
    Means seen{0, 0};
    double all = 0;
    for (const Choice& c : even_choices(count)) {
        const auto axis = chosen_axis(l, c);
        const optics::Vec2<double> in{l.half_pitch[0] * c[0], 0.5 * l.pitch[1] * c[1]};
        // A position p by p_y about the axis but outside of the cell is taken relative to the neighbour in whose cell it lies.
        const auto centre = optics::axis_of(l, optics::cell_at(l, in.x, in.y));
        const auto aimed = optics::in_display(l, optics::Vec2<double>{axis.x + (in.x - centre.x), axis.y + (in.y - centre.y)});
        if (!panel.meets({0, 0, eye_mm}, aimed.x, aimed.y)) continue;
        ++all;
        const auto line = lines.look(on_to_principal * aimed.x, on_to_principal * aimed.y, c[2], c[3]);
        if (!line) continue;
        const double by_theory = lines.on_panel(line->seen) ? line->through ? through : past : 0;
        seen.paraxial += by_theory;
        if (!lens || (!line->through && past > 0)) {
            seen.real += by_theory;
        } else {
            const RealLens::PanelEnd found = lens->look(*line);
            if (found.weight > 0 && lines.on_panel(found.place)) seen.real += found.weight;
        }
    }
    return all > 0 ? Means{seen.paraxial / all, seen.real / all} : Means{nan, nan};
}

}  // namespace

TheoryFigure luminance_over_panel(const Display& d, const Geometry& g, double eye_mm) {
    if (d.panel.emission_exponent != 0) return {nan, "theory holds for a panel that is equally bright from all directions"};
    const Means seen = seen_means(d, g, eye_mm);
    // Between lenses of glass light that one lens loses may find another path to the panel.
    constexpr double alike = 0.003;
    if (d.array.surround != Surround::opaque && std::abs(seen.real - seen.paraxial) > alike * seen.paraxial)
        return {nan,
                "the lenses are so steep that part of the light leaves through their walls, for which there is no simple theory"};
    return {seen.real, ""};
}

}  // namespace lfdsim
