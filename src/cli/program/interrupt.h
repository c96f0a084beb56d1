// Ctrl-C, SIGTERM and SIGHUP. Floor 5.
#pragma once
#include <filesystem>

namespace lfdsim::cli {

inline constexpr int interrupted_exit = 130;

/// The work was stopped by the user and what is complete has been dealt with; exit code 130.
struct Interrupted {};

/// Makes signals end the program at once with exit code 130, its partial file removed.
void catch_signals();

/// Guards a file that will be written: a signal that ends the program removes what is partly written beside it. Throws InputError
/// if the command reads that very file.
void guard_output(const std::filesystem::path&);

/// While one of these lives, the first signal only makes interrupted() true, so that the work can end in order; the second ends
/// the program.
class HeedSignals {
  public:
    HeedSignals();
    ~HeedSignals();
    HeedSignals(const HeedSignals&) = delete;
    HeedSignals& operator=(const HeedSignals&) = delete;
};

bool interrupted();

}  // namespace lfdsim::cli
