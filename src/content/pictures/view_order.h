// Whether views stand in the order that their pictures say. Floor 2.
#pragma once
#include "content/pictures/light_field.h"

namespace lfdsim {

/// What is sure to be wrong with the order of views. Both false: nothing is wrong, or it cannot be told.
struct OrderDoubt {
    bool axes_disagree = false;  // what moves as if near from column to column moves as if far from row to row
    bool against_depth = false;  // what the depth map calls near moves as if far
};

/// Measures how blocks of 16 x 16 pixels move from a view (the middle one, or one with a depth map) to its neighbours, along
/// their axis, in pictures reduced to 512 columns. A block counts where its match is distinct, within 16 pixels; an answer is given
/// where twelve blocks agree on it: a correlation of less than -0.8 of moves that are half a pixel or more in the mean.
OrderDoubt order_doubt(const ViewGrid&, const std::vector<Image>& views, const std::vector<KappaMap>& maps);

}  // namespace lfdsim
