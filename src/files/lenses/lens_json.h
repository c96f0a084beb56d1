// The base of the readers of lenses and calibrations in JSON: members that may be absent, and faults with their places. Floor 2.
#pragma once
#include "files/lenses/drawn_lens.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lfdsim {

using LensJson = nlohmann::json;

/// Parses JSON in which Python may have written Infinity and NaN, which JSON does not have: they become words that number()
/// understands. Throws InputError where the text is not JSON, or has more than 1 MiB.
LensJson parse_lens_json(std::string_view text, std::string_view name);

/// Returns a member of an object; null if it is absent, or if the value is not an object.
const LensJson& member(const LensJson&, std::string_view key);
/// Whether a value is a boolean and true.
bool is_true(const LensJson&);
/// Returns a text, or the JSON or type of any other value, shortened so that a message may quote it.
std::string word_of(const LensJson&);

/// Collects the faults of a file, and throws them as one InputError when there are 20.
class JsonReader {
  protected:
    explicit JsonReader(std::string_view file) : name(file) {}

    template <class... Values>
    void refuse(const std::string& place, fmt::format_string<Values...> what, Values&&... values) {
        problems.push_back({fmt::format("{}: {}", name, place), fmt::format(what, std::forward<Values>(values)...)});
        if (problems.size() >= 20) throw InputError(std::move(problems));
    }
    /// Returns the number; refuses other values and returns 0.
    double number(const LensJson&, const std::string& place, bool may_be_infinite = false);
    /// Returns the value, which must be a list of `least` to 1000 elements. Throws InputError otherwise.
    const LensJson& list(const LensJson&, const std::string& place, std::size_t least) const;
    /// Throws InputError with all faults, if there are any.
    void report() const;

    std::string name;

  private:
    std::vector<Problem> problems;
};

/// Collects a lens and its faults.
class LensJsonReader : protected JsonReader {
  protected:
    using JsonReader::JsonReader;
    /// Returns the lens, or throws like report().
    DrawnLens done();

    DrawnLens lens;
};

}  // namespace lfdsim
