// Limits of the reader, against hostile model files.
#pragma once
#include <cstdint>
#include <filesystem>

namespace lfdsim::reader {

/// Limits this process: address space and, at most to `seconds`, processor time; no core dump, no file written; it ends when its
/// parent does. Under AddressSanitizer the address space is not limited, since shadow memory takes terabytes of it.
void confine(std::int64_t bytes, double seconds);

/// Extends the time limit for a file that is to be read: a few seconds, and more for each byte of all files, so that a small file
/// that makes a loader loop is given up soon. It has no effect without confine() before it.
void allow_for(const std::filesystem::path&);

}  // namespace lfdsim::reader
