// A lens's mapping in files, for those who drive the hardware. Floor 5.
#pragma once
#include "cli/program/command.h"
#include "cli/program/progress.h"
#include "display/display.h"
#include "geometry/geometry.h"

#include <string>

namespace lfdsim::cli {

/// --mapping: where the lens sends the light of the panel points under it. NAME.npy or NAME.exr holds the table, NAME.json says
/// what its axes and units are, NAME.svg shows the distortion.
class MappingOption {
  public:
    explicit MappingOption(Command);
    bool given() const { return !path_.empty(); }
    /// To be called before long work. Throws InputError unless all three files can be written, and none is `output`.
    void check(const std::string& output) const;
    void write(const Display&, const Geometry&, int threads) const;

  private:
    std::string path_;
    bool replace_ = false;
};

}  // namespace lfdsim::cli
