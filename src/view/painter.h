// Pictures for one visitor: coarse at once, sharp at rest. Floor 5.
#pragma once
#include "view/library.h"
#include "view/messages.h"
#include "view/outbox.h"

#include <memory>

namespace lfdsim::view {

class Panels;  // light of panels, shared by all visitors: panels.h

/// Works on a thread of its own. Of what it is told only the newest counts.
class Painter {
  public:
    Painter(const Library&, Panels&, Outbox&, int threads);
    ~Painter();  // stops at once

    /// Draws what is wanted until something else is: frames to the outbox, one lane for each of "one", "left", "right",
    /// "photograph", "difference". What is wrong is told as the text message "problems".
    void want(const Wanted&);
    /// The picture at rest as an OpenEXR file, in the lane "file".
    void want_exr(std::int64_t id);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace lfdsim::view
