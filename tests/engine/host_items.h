// The kernels of a wide machine (engine/wide/items.h), each compiled for the host: once for all tests that run them there.
#pragma once
#include "engine/wide/frame.h"
#include "engine/wide/likeness_frame.h"
#include "optics/facts.h"

#include <cstdint>

namespace lfdsim {

/// The kernel of a frame.
struct HostKernel {
    optics::Facts facts;  // of the tracer's specialisation
    int row;              // of optics::Specialisations there
    bool sobol;           // the template argument of wide::point_item
    void (*item)(const wide::Frame&, std::int64_t i);
};

HostKernel host_kernel(const wide::Frame& frame);

using HostLikenessItem = void (*)(const wide::LikenessFrame&, std::int64_t i);
HostLikenessItem host_likeness_item(wide::LikenessStep step);

}  // namespace lfdsim
