// What the inverse pick-up found, in words and as JSON. Floor 5.
#pragma once
#include "cli/output/output.h"
#include "inverse/inverse.h"

#include <string>

namespace lfdsim::cli {

/// Writes its warnings.
void warn_of_inverse(const InverseReport&);
/// "at 8 eyes that were not fitted: 31.1 dB, SSIM 0.83 (traced content: 27.4 dB, 0.76)".
std::string inverse_text(const InverseReport&);
Json inverse_json(const InverseReport&);

}  // namespace lfdsim::cli
