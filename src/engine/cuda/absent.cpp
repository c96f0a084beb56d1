// Built without a CUDA toolkit: there is no GPU to work on.
#include "engine/cuda/cuda.h"

namespace lfdsim::cuda {

GpuSearch find() {
    return {{}, "this lfdsim was built without a CUDA toolkit; install one (12.1 or newer), then build again", "", ""};
}

std::unique_ptr<wide::Queue> open(int) { throw wide::DeviceError(find().missing); }

}  // namespace lfdsim::cuda
