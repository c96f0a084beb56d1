// The base of the readers of lenses and calibrations in JSON: members that may be absent, and faults with their places. Floor 2.
#pragma once
#include "base/problems.h"
#include "files/lenses/drawn_lens.h"

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

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

/// Collects the faults of a file.
class JsonReader {
  protected:
    explicit JsonReader(std::string_view file) : name(file) {}

    template <class... Values>
    void refuse(const std::string& place, fmt::format_string<Values...> what, Values&&... values) {
        problems.add(fmt::format("{}: {}", name, place), what, std::forward<Values>(values)...);
    }
    /// Returns the number; refuses other values and returns 0.
    double number(const LensJson&, const std::string& place, bool may_be_infinite = false);
    /// Returns the value, which must be a list of `least` to 1000 elements. Throws InputError otherwise.
    const LensJson& list(const LensJson&, const std::string& place, std::size_t least) const;
    /// Throws InputError with all faults, if there are any.
    void report() const { problems.report(); }

    std::string name;

  private:
    Problems problems{Problems::most_of_a_file};
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
