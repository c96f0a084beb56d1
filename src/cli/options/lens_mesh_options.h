// The options of lfdsim render for lenses of triangles in place of surfaces (docs/meshed.md). Floor 5.
#pragma once
#include "cli/output/output.h"
#include "cli/program/command.h"
#include "interchange/meshed/render_meshed.h"

#include <optional>
#include <string>

namespace lfdsim::cli {

/// The options --lens-mesh and --lens-normals.
class LensMeshOptions {
  public:
    explicit LensMeshOptions(Command command) : command_(command) {}
    bool given() const { return triangles_.given(); }
    /// Throws InputError with all faults of the values.
    void check() const;
    /// Returns the display's lens in triangles; nothing without --lens-mesh. Throws InputError if it cannot be made.
    std::optional<MeshedLens> lens(const Display&, const Geometry&) const;
    /// Returns the description of a meshed lens in a rendering's output, in words or as JSON.
    std::string text(const MeshedLens&) const;
    Json json(const MeshedLens&) const;

  private:
    std::int64_t triangles() const;

    Command command_;
    Option triangles_ = command_.option("--lens-mesh", "TRIANGLES",
                                        "Replace each lens by about this number of triangles, as other renderers do "
                                        "(docs/meshed.md); only with point samples and an opaque surround");
    Option normals_ = command_
                          .option("--lens-normals", "flat|smooth",
                                  "Normals: those of the triangles, or the true surface's, interpolated; default flat")
                          .initially("flat");
};

}  // namespace lfdsim::cli
