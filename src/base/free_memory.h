// How much memory this process can still take. Floor 0.
#pragma once
#include <filesystem>
#include <string>

namespace lfdsim {

struct FreeMemory {
    double bytes;
    std::string whose;  // "this machine has", "the control group /job of this process has": of the limit that is the nearest
};

/// The least of what the machine has to spare (MemAvailable), what each control group above this process leaves of its limit
/// (versions 1 and 2; pages of files that the kernel can drop are not counted as used), and what RLIMIT_AS and RLIMIT_DATA leave.
/// `root`: where /proc and the groups' folders are found.
FreeMemory free_memory(const std::filesystem::path& root = "/");

/// "3.1 GB", "12 MB", "40 kB".
std::string bytes_text(double bytes);

/// "this machine has 3.1 GB free".
std::string free_text(const FreeMemory&);

}  // namespace lfdsim
