// What is wrong with a command line, in words. Floor 4.
#pragma once
#include "model/error.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace lfdsim::cli {

/// argv for CLI11's parser: reversed, without the program's name; "--set a=1 b=2" becomes "--set a=1 --set b=2" and "help render"
/// becomes "render --help".
std::vector<std::string> arguments(int argc, char** argv);

/// Unknown commands and options with the nearest known one, values that are missing, and where to find help.
InputError usage_error(const CLI::App& program, const CLI::ParseError&);

}  // namespace lfdsim::cli
