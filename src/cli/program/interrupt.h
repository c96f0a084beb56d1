// The signals that end the program: Ctrl-C, SIGTERM and SIGHUP. Floor 5.
#pragma once
#include <filesystem>

namespace lfdsim::cli {

inline constexpr int interrupted_exit = 130;

/// The exception of work that a signal stopped, thrown when the completed part has been saved or dropped; exit code 130.
struct Interrupted {};

/// Makes signals end the program at once with exit code 130; it then says so, and removes its partial file.
void catch_signals();

/// Guards a file that will be written: a signal that ends the program removes its partial file. One file is guarded at a time, the
/// last one. Throws InputError if the command reads that file.
void guard_output(const std::filesystem::path&);

/// While an object of this class exists, the first signal only makes interrupted() true, so that the work can end in order; the
/// second ends the program.
class HeedSignals {
  public:
    HeedSignals();
    ~HeedSignals();
    HeedSignals(const HeedSignals&) = delete;
    HeedSignals& operator=(const HeedSignals&) = delete;
};

/// Whether a signal has been received.
bool interrupted();

}  // namespace lfdsim::cli
