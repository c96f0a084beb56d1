// Errors that a user can fix. Floor 0, public.
#pragma once
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace lfdsim {

/// A problem of the input: where (file:line:column, a TOML key, an option, a file), what is wrong, what was given and what is
/// allowed.
struct Problem {
    std::string where;
    std::string what;
};

/// Bad usage or bad input; the program ends with exit code 2. All problems found are reported together.
/// Anything else that goes wrong while running (disk full, out of memory) is a std::runtime_error and exit code 1.
class InputError : public std::runtime_error {
  public:
    explicit InputError(std::vector<Problem> all) : std::runtime_error(join(all)), problems(std::move(all)) {}
    InputError(std::string where, std::string what) : InputError(std::vector<Problem>{{std::move(where), std::move(what)}}) {}

    std::vector<Problem> problems;

  private:
    static std::string join(const std::vector<Problem>& all) {
        std::string text;
        for (const Problem& p : all) {
            if (!text.empty()) text += '\n';
            text += p.where.empty() ? p.what : p.where + ": " + p.what;
        }
        return text;
    }
};

}  // namespace lfdsim
