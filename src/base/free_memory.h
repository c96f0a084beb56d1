// Memory that this process can still allocate, and its text for messages. Floor 0.
#pragma once
#include <filesystem>
#include <string>

namespace lfdsim {

/// The memory that is left under the lowest of all limits.
struct FreeMemory {
    double bytes;
    std::string whose;  // subject and verb of that limit: "this machine has", "the control group /job of this process has"
};

/// Returns the least of what the machine has to spare (MemAvailable), what each control group above this process leaves of its
/// limit (versions 1 and 2; pages of files that the kernel can drop are not counted as used), and what RLIMIT_AS and RLIMIT_DATA
/// leave. `root` is the folder in which /proc and the groups' folders are found; tests give another one.
FreeMemory free_memory(const std::filesystem::path& root = "/");

/// Returns bytes in words, by powers of 1000: "3.1 GB", "12 MB", "40 kB".
std::string bytes_text(double bytes);

/// Returns a clause for messages: "this machine has 3.1 GB free".
std::string free_text(const FreeMemory&);

}  // namespace lfdsim
