// What the inverse pick-up found, in words and as JSON. Floor 5.
#pragma once
#include "cli/output/output.h"
#include "inverse/inverse.h"

#include <string>

namespace lfdsim::cli {

/// Logs the warnings of the inverse pick-up.
void warn_of_inverse(const InverseReport&);
/// Returns the result in words: "at eyes that were not fitted: 31.10 dB, SSIM 0.830 (traced content: 27.40 dB, SSIM 0.760;
/// integrated: ...); ...".
std::string inverse_text(const InverseReport&);
/// Returns all figures of the result, for --json.
Json inverse_json(const InverseReport&);

}  // namespace lfdsim::cli
