// Option values, read strictly: the whole text must be the value, numbers finite. Floor 5.
#pragma once
#include "base/problems.h"
#include "cli/program/command.h"
#include "image/image.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim::cli {

// All functions throw InputError that names the option, what was given and what is allowed. An Option reads its value with them;
// calls elsewhere are for parts of a value, and for values of a list.

/// Parses a finite number: "12", "-0.5", "1e3".
double number(std::string_view option, std::string_view text);

/// Parses a whole number from low to high, both allowed: "100", "1e3".
std::int64_t whole_number(std::string_view option, std::string_view text, std::int64_t low, std::int64_t high);

/// Parses numbers separated by commas, the same number of them as the example has: "0,-300,1800". `form` names them:
/// "FROM,TO,STEP".
std::vector<double> numbers(std::string_view option, std::string_view text, std::string_view example, std::string_view form = {});

/// Parses columns and rows, each 1 or more: "3840x2160".
std::array<std::int64_t, 2> size(std::string_view option, std::string_view text);

/// Parses "X0,Y0,X1,Y1", columns X0 to X1-1 and rows Y0 to Y1-1 of a frame of width x height pixels; at least one pixel.
Rect rectangle(std::string_view option, std::string_view text, std::int64_t width, std::int64_t height);

/// Parses one of the words `allowed`.
std::string word(std::string_view option, std::string_view text, const std::vector<std::string>& allowed);

/// Runs the parts of reading a command line and collects the faults of each, so that all are reported at once.
class Faults : public Problems {
  public:
    template <class Part>
    void of(Part part) {
        try {
            part();
        } catch (const InputError& e) {
            for (const Problem& p : e.problems) add(p);
        }
    }
    /// Runs the part of an option that was given.
    template <class Part>
    void of(const Option& option, Part part) {
        if (!option.empty()) of(part);
    }
};

}  // namespace lfdsim::cli
