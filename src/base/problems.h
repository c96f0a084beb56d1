// The problems of an input, collected. Floor 0.
#pragma once
#include "base/input_error.h"

#include <fmt/format.h>

#include <limits>

namespace lfdsim {

/// Collects the problems of an input, so that all are reported together: report() throws them as one InputError, and so does add()
/// when there are `most`.
class Problems {
  public:
    static constexpr std::size_t most_of_a_file = 20;  // of a file whose lines may all be wrong

    explicit Problems(std::size_t most = std::numeric_limits<std::size_t>::max()) : most_(most) {}

    void add(Problem problem) {
        all_.push_back(std::move(problem));
        if (all_.size() >= most_) report();
    }
    /// Adds a problem: where it is, and what is wrong there, formatted as by fmt::format().
    template <class... Values>
    void add(std::string where, fmt::format_string<Values...> what, Values&&... values) {
        add({std::move(where), fmt::format(what, std::forward<Values>(values)...)});
    }
    bool empty() const { return all_.empty(); }
    /// Throws InputError with all problems, if there are any.
    void report() const {
        if (!all_.empty()) throw InputError(all_);
    }

  private:
    std::size_t most_;
    std::vector<Problem> all_;
};

}  // namespace lfdsim
