// The thread that makes the pictures for one visitor: coarse at once, sharp at rest. Floor 5.
#pragma once
#include "view/answers/library.h"
#include "view/server/messages.h"
#include "view/server/outbox.h"

#include <memory>

namespace lfdsim::view {

class Panels;  // light of panels, shared by all visitors: panels.h

/// Works on a separate thread. Only the newest request counts.
class Painter {
  public:
    Painter(const Library&, Panels&, Outbox&, int threads);
    ~Painter();  // stops at once

    /// Renders a state until another one is wanted, and sends frames to the outbox, in the lanes "one", "left", "right",
    /// "photograph", "difference". Errors are sent as the text message "problems". A state whose id does not rise is ignored.
    void want(const Wanted&);
    /// Sends the final picture as an OpenEXR file, in the lane "file".
    void want_exr(std::int64_t id);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace lfdsim::view
