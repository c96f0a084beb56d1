// lfdsim compare with --corners: a photograph of a real display laid over a simulated view. Floor 5.
#pragma once
#include "cli/program/command.h"

#include <string>
#include <vector>

namespace lfdsim::cli {

/// The options that `compare` has for photographs alone.
class PhotoOptions {
  public:
    explicit PhotoOptions(Command command);

    bool given() const { return corners_option_.count() > 0; }

    /// Compares and prints. `encoding`, of the photograph, and `crop`, of the view, are what the command's other options say.
    void run(const std::string& view, const std::string& photograph, const std::string& encoding, const std::string& crop,
             bool json) const;

  private:
    std::vector<std::string> corners_, view_corners_;
    std::string overlay_, difference_;
    bool fit_blur_ = false, fit_corners_ = false;
    Option corners_option_, overlay_option_, difference_option_;
};

}  // namespace lfdsim::cli
