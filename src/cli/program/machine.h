// The machine and the build of this program, without which a measured time means nothing. Floor 5.
#pragma once
#include <string>

namespace lfdsim::cli {

/// Returns the processor's name as the system gives it; "unknown" where it gives none.
std::string processor();

std::string compiler();                               // name and version
std::string build_type();                             // CMake's
std::string flags();                                  // the compiler's options for all code
std::string kernel_flags(const std::string& kernel);  // further options for the code of a kernel

}  // namespace lfdsim::cli
