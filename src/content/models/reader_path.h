// The path of the model reader program.
#pragma once
#include <filesystem>

namespace lfdsim {

/// Returns the first that is executable of: environment variable LFDSIM_MODEL_READER, which excludes the others; beside the
/// shared library that contains this code, and in bin/ there; beside the running program; ../libexec/lfdsim/ from there; where it
/// was installed; where it was built. Throws std::runtime_error, which lists them, if there is none.
std::filesystem::path reader_path();

}  // namespace lfdsim
