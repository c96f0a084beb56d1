// Whether views are in the order that their pictures show. Floor 2.
#pragma once
#include "content/pictures/light_field.h"

namespace lfdsim {

/// What is certainly wrong with the order of views. If both are false, nothing is wrong, or it cannot be decided.
struct OrderDoubt {
    bool axes_disagree = false;  // what moves from column to column as if near moves from row to row as if far
    bool against_depth = false;  // what the depth map describes as near moves as if far
};

/// Measures how blocks of 16 x 16 pixels move from a view (the middle one, or one with a depth map) to its neighbours, along the
/// neighbours' axis, in pictures reduced to 512 columns. A block counts if its match is distinct and within 16 pixels. An answer
/// needs twelve blocks, moves of half a pixel or more in the mean, and a correlation of less than -0.8.
OrderDoubt order_doubt(const ViewGrid&, const std::vector<Image>& views, const std::vector<KappaMap>& maps);

}  // namespace lfdsim
