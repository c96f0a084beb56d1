// What the readers of lenses and calibrations in JSON share: members that may be absent, and faults with their places. Floor 2.
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

/// Python writes Infinity and NaN, which JSON has not; they become words. Throws InputError where the text is no JSON, or more than
/// 1 MiB.
LensJson parse_lens_json(std::string_view text, std::string_view name);

/// A member of an object; null if it is absent, or if that is no object.
const LensJson& member(const LensJson&, std::string_view key);
bool is_true(const LensJson&);
/// A word, or what stands in its place, as a message may quote it.
std::string word_of(const LensJson&);

/// Collects the faults of a file.
class JsonReader {
  protected:
    explicit JsonReader(std::string_view file) : name(file) {}

    template <class... Values>
    void refuse(const std::string& place, fmt::format_string<Values...> what, Values&&... values) {
        problems.push_back({fmt::format("{}: {}", name, place), fmt::format(what, std::forward<Values>(values)...)});
        if (problems.size() >= 20) throw InputError(std::move(problems));
    }
    /// 0 if there is none, which is then refused.
    double number(const LensJson&, const std::string& place, bool may_be_infinite = false);
    /// The list itself, of so many elements to 1000.
    const LensJson& list(const LensJson&, const std::string& place, std::size_t least) const;
    /// Throws InputError with all that is wrong, if anything is.
    void report() const;

    std::string name;

  private:
    std::vector<Problem> problems;
};

/// Collects a lens and its faults.
class LensJsonReader : protected JsonReader {
  protected:
    using JsonReader::JsonReader;
    /// The lens, or all that is wrong.
    DrawnLens done();

    DrawnLens lens;
};

}  // namespace lfdsim
