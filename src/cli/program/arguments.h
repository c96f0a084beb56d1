// Option values, read strictly: the whole text must be the value, numbers finite. Floor 5.
#pragma once
#include "base/input_error.h"
#include "cli/program/command.h"
#include "image/image.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim::cli {

// All throw InputError that names the option, what was given and what is allowed. An Option reads itself; these are for parts of a
// value, and for values of a list.

/// "12", "-0.5", "1e3".
double number(std::string_view option, std::string_view text);

/// "100", "1e3"; low .. high, both allowed.
std::int64_t whole_number(std::string_view option, std::string_view text, std::int64_t low, std::int64_t high);

/// Parses as many numbers, separated by commas, as the example has: "0,-300,1800". `form` names them: "FROM,TO,STEP".
std::vector<double> numbers(std::string_view option, std::string_view text, std::string_view example, std::string_view form = {});

/// "3840x2160": columns and rows, each 1 or more.
std::array<std::int64_t, 2> size(std::string_view option, std::string_view text);

/// "X0,Y0,X1,Y1": columns X0 .. X1-1 and rows Y0 .. Y1-1 of a frame of width x height pixels; at least one pixel.
Rect rectangle(std::string_view option, std::string_view text, std::int64_t width, std::int64_t height);

/// Parses one of the words `allowed`.
std::string word(std::string_view option, std::string_view text, const std::vector<std::string>& allowed);

/// Runs the parts of reading a command line and gathers what is wrong with each, so that all of it is told at once.
class Faults {
  public:
    template <class Part>
    void of(Part part) {
        try {
            part();
        } catch (const InputError& e) {
            all_.insert(all_.end(), e.problems.begin(), e.problems.end());
        }
    }
    /// Runs the part of an option that was given.
    template <class Part>
    void of(const Option& option, Part part) {
        if (!option.empty()) of(part);
    }
    /// Throws InputError if anything was wrong.
    void report() const {
        if (!all_.empty()) throw InputError(all_);
    }

  private:
    std::vector<Problem> all_;
};

}  // namespace lfdsim::cli
