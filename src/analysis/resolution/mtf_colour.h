// How the measure of resolution tells its channels apart. Floor 3.
#pragma once
#include "analysis/core/result.h"
#include "analysis/resolution/mtf_curves.h"

#include <span>

namespace lfdsim {

inline constexpr std::array<const char*, 3> colour_of_channel{"red", "green", "blue"};

/// The figures of theory and colour fringes where channels differ; null where they do not.
Json colours_json(const MtfCurves&);

/// Findings of each channel for one direction, seen on axis, and plots of their curves there and from the side. All at one depth.
void tell_mtf_of_colours(std::span<const MtfCurves* const> at_depth, Result&);

/// Why the channels are alike, or what differs between them.
std::string remark_on_channels(std::span<const MtfCurves>);

}  // namespace lfdsim
