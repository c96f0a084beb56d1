// Limits of the reader, against hostile model files.
#pragma once
#include <cstdint>
#include <filesystem>

namespace lfdsim::reader {

/// Limits this process: address space and, to what may be, processor time; no core dump, no file written; ends when its parent
/// does. Under AddressSanitizer the address space is not limited, as its shadow memory takes terabytes of it.
void confine(std::int64_t bytes, double seconds);

/// To be called for each file that is read: a few seconds, and more for each byte of all files, are what reading may take, so that
/// a small file that makes a loader run in circles is given up soon. Without confine() before it, nothing is limited.
void allow_for(const std::filesystem::path&);

}  // namespace lfdsim::reader
