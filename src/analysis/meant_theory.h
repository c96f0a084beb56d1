// For which viewers the light is meant that an eye gathers, by theory: thin lenses without aberration. Floor 3.
#pragma once
#include "analysis/paraxial_lines.h"
#include "analysis/slope_spread.h"
#include "content/pickup.h"

namespace lfdsim {

/// The closed form of SlopeSpread. Layers below thin lenses bend steep lines less than in proportion, which it does not know: there
/// a sum over lines that obey Snell's law takes its place, good to 0.004.
class MeantTheory {
  public:
    /// The eye's distance from the panel, mm.
    MeantTheory(const Subject&, double distance_mm);

    /// Share of the light with slopes from low to high for an eye at x, by the lens that owns what it sees.
    double meant(double x_mm, double low, double high) const;

    double width() const { return spread_.width(); }

  private:
    double sum(double x_mm, double low, double high) const;

    const Subject& subject_;
    double distance_mm_;
    SlopeSpread spread_;
    Pickup pickup_;
    std::vector<Choice> choices_;  // of the lines that are summed; none where the closed form holds
};

}  // namespace lfdsim
