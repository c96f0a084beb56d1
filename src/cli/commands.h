// The commands of lfdsim. Floor 4.
#pragma once
#include <CLI/CLI.hpp>

namespace lfdsim::cli {

// Each adds its command, which runs when the command line has been parsed. What a command throws becomes the exit code: see
// main.cpp.
void add_check(CLI::App& program);
void add_eia(CLI::App& program);
void add_photo(CLI::App& program);
void add_render(CLI::App& program);
void add_compare(CLI::App& program);
void add_analyze(CLI::App& program);
void add_sheet(CLI::App& program);
void add_bench(CLI::App& program);
void add_doctor(CLI::App& program);

}  // namespace lfdsim::cli
