// Where the model reader program is.
#pragma once
#include <filesystem>

namespace lfdsim {

/// The first of: environment variable LFDSIM_MODEL_READER; beside the shared library that this code is part of, and in bin/ there;
/// beside the running program; ../libexec/lfdsim/ from there; where it was installed; where it was built. Throws std::runtime_error
/// that lists them if there is none.
std::filesystem::path reader_path();

}  // namespace lfdsim
