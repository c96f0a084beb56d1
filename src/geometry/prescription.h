// A lens as a list of surfaces, and its first-order properties. Floor 0.
#pragma once
#include "geometry/geometry.h"

#include <array>
#include <vector>

namespace lfdsim {

/// Principal planes and focal length of surfaces with air on both sides, where principal and nodal points coincide, from the
/// paraxial matrix. An afocal lens has infinite focal length; its points are then a pair of nodal points, the first in the first
/// vertex.
struct Cardinal {
    double focal_length_mm;
    double front_principal_mm, rear_principal_mm;  // z of H and H', in the frame of the surfaces
};
/// Returns the cardinal points of surfaces, panel side first.
Cardinal cardinal_points(const std::vector<PlacedSurface>&);

/// Returns the radius r of a plano-convex or ideal lens, mm: as given; of lenses that fill their cells at least the distance to
/// the corners.
double glass_radius_mm(const std::optional<double>& aperture_radius_mm, const LensArray&);

/// Returns the lens's surfaces for light of a wavelength, panel side first, with the first vertex in z = 0.
std::vector<PlacedSurface> prescription(const Lens&, const LensArray&, double wavelength_nm);

/// Returns whether a surface has aspheric terms that are not 0.
bool has_aspheric_terms(const PlacedSurface&);
/// Returns whether a surface has neither curvature nor aspheric terms.
bool is_plane(const PlacedSurface&);

/// Returns the sag of a surface at a distance from its axis, mm.
double sag_mm(const PlacedSurface&, double distance_mm);
/// Returns the height of a surface at its semi-aperture, mm, in the frame of the surfaces.
double rim_z_mm(const PlacedSurface&);
/// Returns the lowest and highest sag within the semi-aperture, mm; NaN where the sag is not real.
std::array<double, 2> sag_range_mm(const PlacedSurface&);

/// Returns the least axial distance from one surface up to another within both semi-apertures, mm; negative where they cross.
double clearance_mm(const PlacedSurface& lower, const PlacedSurface& upper);

/// Returns the lens mirrored in the plane of the panel, for tracing light from the panel: its first surface, from the panel, is
/// then the highest, and all its z are negative.
Geometry turned_over(Geometry);

/// Resolves a description without validate(): for an invalid description some figures are NaN or wrong.
Geometry resolve_unchecked(const Display&);

}  // namespace lfdsim
