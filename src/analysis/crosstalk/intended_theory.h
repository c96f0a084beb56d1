// Viewers for whom the light that an eye receives is intended, by theory: thin lenses without aberration. Floor 3.
#pragma once
#include "analysis/core/met_places.h"
#include "analysis/crosstalk/paraxial_lines.h"

namespace lfdsim {

/// Lines of sight through paraxial lenses, which meet the same pixels as those of the display itself, with all colours in green
/// light. Sums over 2^17 of them are accurate to 0.002 of the light.
class MeantTheory {
  public:
    MeantTheory(const Display&, const Geometry&);

    /// Returns the points of the panel that the lines of sight of an eye meet.
    MetPlaces look(const Vec3d& eye, const LineSets&) const;

  private:
    const Display& display_;
    const Geometry& geometry_;
    ApertureShape aperture_;
};

}  // namespace lfdsim
