// The files of lfdsim eia --mapping: a lens's mapping of panel points to rays, for programs that drive a display. Floor 5.
#pragma once
#include "cli/program/command.h"
#include "cli/program/progress.h"
#include "display/display.h"
#include "geometry/geometry.h"

#include <string>

namespace lfdsim::cli {

/// The option --mapping: where the lens sends the light of the panel points under it. NAME.npy or NAME.exr has the table, NAME.json
/// its axes and units, NAME.svg shows the distortion.
class MappingOption {
  public:
    explicit MappingOption(Command command) : command_(command) {}
    bool given() const { return !mapping_.empty(); }
    /// Checks the three files before long work. Throws InputError unless all three can be written, and the named one is not
    /// `output`.
    void check(const std::string& output) const;
    /// Traces the lens and writes the three files.
    void write(const Display&, const Geometry&, int threads) const;

  private:
    const std::string& path() const { return mapping_.text(); }

    Command command_;
    Option mapping_ = command_.option("--mapping", "FILE",
                                      "Also writes the lens's mapping of panel points to rays: .npy or .exr, and beside it a .json "
                                      "that describes it and an .svg of the distortion");
    Flag replace_ = command_.flag("--replace", "Overwrite a .json and .svg of other origin beside the file of --mapping");
};

}  // namespace lfdsim::cli
