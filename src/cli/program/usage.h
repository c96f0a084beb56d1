// Errors of a command line in words that help, in place of CLI11's. Floor 5.
#pragma once
#include "base/input_error.h"

#include <span>
#include <string>
#include <vector>

namespace lfdsim::cli {

/// Returns argv for CLI11's parser: reversed, without the program's name; "--set a=1 b=2" becomes "--set a=1 --set b=2" and "help
/// render" becomes "render --help".
std::vector<std::string> arguments(int argc, char** argv);

/// A command line that could not be read.
struct Misuse {
    std::string says;                                      // CLI11's words for the first rule that is broken
    bool number_of_values;                                 // whether that rule is the number of an option's values
    std::vector<std::string> unplaced;                     // words that are no option, value or argument
    std::string command = {};                              // the one that was chosen
    std::vector<std::string> commands = {}, options = {};  // all commands; the options of the chosen one, with their dashes
};

/// Returns the words after an option that are the numbers of its one value, which should have commas between them (or "x": "WxH");
/// none if there are fewer than two. `form` is the option's value in help, "X,Y,Z".
std::vector<std::string> spaced_numbers(const std::string& form, std::span<const std::string> after);

/// Returns the error of a value that was given as several words.
InputError spaced_error(const std::string& option, const std::string& form, const std::vector<std::string>& numbers);

/// Returns the error of a key that was given without "=" and a value in the same word.
InputError setting_error(const std::string& option, const std::string& key);

/// Returns the error of a command line: unknown commands and options with the nearest known one, values that are missing, and where
/// to find help.
InputError usage_error(const Misuse&);

}  // namespace lfdsim::cli
