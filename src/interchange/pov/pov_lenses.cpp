#include "interchange/pov/pov_lenses.h"

#include "base/constants.h"
#include "engine/scene/misalignment.h"
#include "geometry/lens_misalignment.h"
#include "interchange/meshed/cell_sides.h"
#include "interchange/peers/cell.h"
#include "interchange/pov/pov_matter.h"
#include "optics/lattice.h"

#include <algorithm>
#include <cmath>

namespace lfdsim::peers {
namespace {

constexpr double seam_mm = 1e-6;   // by which neighbouring tiles overlap
constexpr double spare_mm = 1e-4;  // added to distances at which lenses count as near, and to boxes
constexpr double same_mm = 1e-9;   // of heights

/// Returns whether a lens is displaced aside or tilted.
bool moved(const LensError& e) { return e.aside_mm[0] != 0 || e.aside_mm[1] != 0 || e.tilt_deg[0] != 0 || e.tilt_deg[1] != 0; }

}  // namespace

PovLenses::PovLenses(const Display& d, const Geometry& g) : d_(d), g_(g), cell_(g), far_(100 * sheet_half(g)) {
    low_ = g.base_z_mm - 1, high_ = g.top_z_mm + 1;
    // A tilted column reaches as far aside as its width, its displacement and the tilt at its lowest and highest points make it.
    const std::vector<LensError> errors = lenses_as_built(d, g.lattice);
    const bool filled = d.array.aperture == Aperture::cell;
    const double half = filled ? (cell_.strips() ? cell_.half()[0] : cell_.outer_radius()) : rims(g.surfaces).radius;
    const double deep = std::max(g.vertex_plane_mm - g.base_z_mm, g.top_z_mm - g.vertex_plane_mm);
    const std::int64_t columns = cell_.last(0) + 1;
    for (std::size_t k = 0; k < errors.size(); ++k) {
        const std::int64_t i = std::int64_t(k) % columns, j = std::int64_t(k) / columns;
        const auto at = optics::axis_in_array(g.lattice, optics::Cell<double>{double(i), double(j)});
        const LensError& e = errors[k];
        low_ = std::min(low_, g.base_z_mm - 1 - std::abs(e.height_mm));
        high_ = std::max(high_, g.top_z_mm + 1 + std::abs(e.height_mm));
        const double upright = std::cos(e.tilt_deg[0] * degree) * std::cos(e.tilt_deg[1] * degree),
                     aslant = std::sqrt(std::max(0., 1 - upright * upright));
        lenses_.push_back({i,
                           j,
                           {at.x, at.y},
                           e,
                           raised_mm(d.errors, g.lattice, at.x, at.y),
                           upright,
                           aslant,
                           half / upright + std::hypot(e.aside_mm[0], e.aside_mm[1]) + (deep + half) * aslant});
    }
}

bool PovLenses::at_border(std::size_t k) const {
    const PovLens& s = lenses_[k];
    return s.i == 0 || s.j == 0 || s.i == cell_.last(0) || s.j == cell_.last(1);
}

std::size_t PovLenses::number(std::int64_t i, std::int64_t j) const { return std::size_t(j * (cell_.last(0) + 1) + i); }

std::vector<PlacedSurface> PovLenses::surfaces(std::size_t k) const {
    std::vector<PlacedSurface> own = g_.surfaces;
    for (PlacedSurface& s : own) s.curvature_per_mm *= 1 + lenses_[k].error.curvature;
    return own;
}

// A point q goes to v + Ry Rx (q - v) + errors, v the vertex on the lattice's axis (docs/model.md, "Errors"). POV-Ray's order of a
// matrix: images of the axes, then the shift.
std::string PovLenses::frame(std::size_t k) const {
    const auto& [i, j, at, e, raised, upright, aslant, reach] = lenses_[k];
    const double x = at[0] + e.aside_mm[0], y = at[1] + e.aside_mm[1], z = e.height_mm;
    if (e.tilt_deg[0] == 0 && e.tilt_deg[1] == 0) return "translate " + vector(x, y, z);
    const double cx = std::cos(e.tilt_deg[0] * degree), sx = std::sin(e.tilt_deg[0] * degree),
                 cy = std::cos(e.tilt_deg[1] * degree), sy = std::sin(e.tilt_deg[1] * degree), v = g_.vertex_plane_mm;
    std::string numbers;
    for (const double n : {cy, 0., -sy, sy * sx, cx, cy * sx, sy * cx, -sx, cy * cx}) numbers += text(n) + ",";
    return fmt::format("matrix <{}{},{},{}>", numbers, text(x - sy * cx * v), text(y + sx * v), text(z + v - cy * cx * v));
}

std::string PovLenses::column(double radius, double wider) const {
    const std::string round = cell_.column(radius + wider, low_, high_);
    if (d_.array.aperture == Aperture::circle) return round;
    const std::string prism = cell_.prism(low_, high_, wider);
    return radius < cell_.outer_radius() && !cell_.strips() ? "intersection { " + prism + " " + round + " }" : prism;
}

std::string PovLenses::placed(std::size_t k, const std::string& shape) const { return "object { " + shape + " " + frame(k) + " }"; }

std::vector<std::size_t> PovLenses::near(std::size_t k) const {
    const PovLens& own = lenses_[k];
    const auto [x0, y0, x1, y1] = tile(k);
    std::vector<std::size_t> all;
    const std::int64_t rows = cell_.strips() ? 0 : 1;
    for (std::int64_t j = std::max<std::int64_t>(own.j - rows, 0); j <= std::min(own.j + rows, cell_.last(1)); ++j)
        for (std::int64_t i = std::max<std::int64_t>(own.i - 1, 0); i <= std::min(own.i + 1, cell_.last(0)); ++i) {
            const PovLens& other = lenses_[number(i, j)];
            if (&other == &own) continue;
            const double dx = std::max({x0 - other.at[0], other.at[0] - x1, 0.}),
                         dy = cell_.strips() ? 0 : std::max({y0 - other.at[1], other.at[1] - y1, 0.});
            const double apart = std::hypot(other.at[0] - own.at[0], cell_.strips() ? 0 : other.at[1] - own.at[1]);
            if (std::hypot(dx, dy) < other.reach + spare_mm || apart < own.reach + other.reach + spare_mm)
                all.push_back(number(i, j));
        }
    return all;
}

bool PovLenses::overlap() const {
    if (d_.array.aperture == Aperture::cell)
        return std::any_of(lenses_.begin(), lenses_.end(), [](const PovLens& s) { return moved(s.error); });
    for (std::size_t k = 0; k < count(); ++k)
        for (const std::size_t m : near(k)) {
            const PovLens &a = lenses_[k], &b = lenses_[m];
            const double y = cell_.strips() ? 0 : b.at[1] - a.at[1];
            if (std::hypot(b.at[0] - a.at[0], y) < a.reach + b.reach) return true;
        }
    return false;
}

std::array<double, 4> PovLenses::tile(std::size_t k) const {
    const PovLens& s = lenses_[k];
    const double x = g_.lattice.pitch[0] / 2 + seam_mm, y = g_.lattice.pitch[1] / 2 + seam_mm;
    return {s.i == 0 ? -far_ : s.at[0] - x, s.j == 0 ? -far_ : s.at[1] - y, s.i == cell_.last(0) ? far_ : s.at[0] + x,
            s.j == cell_.last(1) ? far_ : s.at[1] + y};
}

std::string PovLenses::tile_box(std::size_t k, double low, double high) const {
    const auto [x0, y0, x1, y1] = tile(k);
    return fmt::format("box {{ {}, {} }}", vector(x0, y0, low), vector(x1, y1, high));
}

std::string PovLenses::flat(std::size_t k, double z, const std::vector<std::string>& holes) const {
    const auto [x0, y0, x1, y1] = tile(k);
    std::string clip = tile_box(k, z - 1, z + 1);
    for (const std::string& hole : holes) clip += " object { " + hole + " inverse }";
    return fmt::format("disc {{ {}, z, {} clipped_by {{ {} }} ", vector((x0 + x1) / 2, (y0 + y1) / 2, z),
                       text(std::hypot(x1 - x0, y1 - y0)), clip);
}

std::string PovLenses::box(std::size_t k) const {
    const PovLens& s = lenses_[k];
    const double x = std::max(s.reach, g_.lattice.pitch[0] / 2) + spare_mm,
                 y = cell_.strips() ? 1.1 * cell_.half_length() : std::max(s.reach, g_.lattice.pitch[1] / 2) + spare_mm;
    return fmt::format("box {{ {}, {} }}", vector(s.at[0] - x, s.at[1] - y, low_), vector(s.at[0] + x, s.at[1] + y, high_));
}

std::string PovLenses::row_box(std::size_t k) const {
    double x = 0, y = 0;
    for (std::size_t m = k; m < count() && lenses_[m].j == lenses_[k].j; ++m) {
        x = std::max(x, std::abs(lenses_[m].at[0]) + lenses_[m].reach);
        y = std::max(y, cell_.strips() ? 1.1 * cell_.half_length() : lenses_[m].reach);
    }
    x += g_.lattice.pitch[0], y += g_.lattice.pitch[1];
    return fmt::format("box {{ {}, {} }}", vector(-x, lenses_[k].at[1] - y, low_), vector(x, lenses_[k].at[1] + y, high_));
}

std::string PovLenses::hole(std::size_t k) const {
    const PovLens& s = lenses_[k];
    return fmt::format("object {{ {} translate {} }}", cell_.column(*d_.lens.stop_radius_mm, low_, high_),
                       vector(s.at[0] + s.error.aside_mm[0], s.at[1] + s.error.aside_mm[1], s.error.height_mm));
}

std::string PovLenses::stops() const {
    std::string all;
    for (std::size_t k = 0; d_.lens.stop_radius_mm && k < count(); ++k) {
        std::vector<std::string> holes{hole(k)};
        for (const std::size_t m : near(k)) holes.push_back(hole(m));
        all += flat(k, g_.stop_z_mm + lenses_[k].error.height_mm, holes) + black() + " transform { Place } }\n";
    }
    return all;
}

std::optional<std::array<double, 2>> PovLenses::walls() const {
    const bool filled = d_.array.aperture == Aperture::cell;
    double low = -INFINITY, high = INFINITY, step = 0;
    for (std::size_t k = 0; k < count(); ++k) {
        const PovLens& s = lenses_[k];
        auto [bottom, top, wide] = rims(surfaces(k));
        if (filled) wide = std::min(wide, cell_.strips() ? cell_.half()[0] : cell_.outer_radius());
        // The lowest point of the highest rim and the highest of the lowest, of a lens tilted about its vertex
        const double v = g_.vertex_plane_mm, own = v + s.error.height_mm - s.raised;
        high = std::min(high, own + (top - v) * s.upright - wide * s.aslant);
        low = std::max(low, own + (bottom - v) * s.upright + wide * s.aslant);
        if (d_.errors.bow_mm != 0)
            for (const std::size_t m : near(k)) step = std::max(step, std::abs(lenses_[m].raised - s.raised));
    }
    if (high - low < 4 * step - same_mm) return std::nullopt;
    return std::array{low, std::max(low, high)};
}

bool PovLenses::level() const {
    return std::all_of(lenses_.begin(), lenses_.end(),
                       [&](const PovLens& s) { return std::abs(s.error.height_mm - lenses_.front().error.height_mm) < same_mm; });
}

}  // namespace lfdsim::peers
