// The channels of the measure of resolution. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "analysis/resolution/mtf_curves.h"

#include <span>

namespace lfdsim {

/// Returns the figures of theory and colour fringes if channels differ; null if they do not.
Json colours_json(const MtfCurves&);

/// Adds lines of each channel for one direction on axis, and plots of their curves there and from the farthest angle. All curves
/// are those of one depth.
void tell_mtf_of_colours(std::span<const MtfCurves* const> at_depth, Result&);

/// Returns a remark on why the channels are alike, or on what differs between them.
std::string remark_on_channels(std::span<const MtfCurves>);

}  // namespace lfdsim
