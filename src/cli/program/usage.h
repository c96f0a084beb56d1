// What is wrong with a command line, in words. Floor 5.
#pragma once
#include "base/input_error.h"

#include <span>
#include <string>
#include <vector>

namespace lfdsim::cli {

/// argv for CLI11's parser: reversed, without the program's name; "--set a=1 b=2" becomes "--set a=1 --set b=2" and "help render"
/// becomes "render --help".
std::vector<std::string> arguments(int argc, char** argv);

/// A command line that could not be read.
struct Misuse {
    std::string says;                                      // CLI11's words for the first rule that is broken
    bool number_of_values;                                 // whether that is how many values an option has
    std::vector<std::string> unplaced;                     // the words that no option or place was found for
    std::string command = {};                              // the one that was chosen
    std::vector<std::string> commands = {}, options = {};  // all there are, and that the command has, with their dashes
};

/// The words after an option that are the numbers of its one value, which has commas between them (or "x": "WxH"): none if the
/// first is not such a number, or the only one. `form`: what the option's value is in help, "X,Y,Z".
std::vector<std::string> spaced_numbers(const std::string& form, std::span<const std::string> after);

/// The error of a value that was given as several words.
InputError spaced_error(const std::string& option, const std::string& form, const std::vector<std::string>& numbers);

/// Unknown commands and options with the nearest known one, values that are missing, and where to find help.
InputError usage_error(const Misuse&);

}  // namespace lfdsim::cli
