// What this machine is, and how this program was built: what any measured figure has to come with. Floor 5.
#pragma once
#include <string>

namespace lfdsim::cli {

/// The processor's name as the system gives it; "unknown" where it gives none.
std::string processor();

/// Name and version; the build type; the options for all code, and those that the named kernel gets on top.
std::string compiler();
std::string build_type();
std::string flags();
std::string kernel_flags(const std::string& kernel);

}  // namespace lfdsim::cli
