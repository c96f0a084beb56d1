// Counts in messages. Floor 0.
#pragma once
#include <concepts>
#include <string>
#include <string_view>

namespace lfdsim {

/// Returns a count with its noun: "1 row", "2 rows". `many` is the plural where that is not `one` with an s.
std::string counted(std::integral auto count, std::string_view one, std::string_view many = {}) {
    std::string text = std::to_string(count) + " ";
    text += count == 1 || many.empty() ? one : many;
    if (count != 1 && many.empty()) text += "s";
    return text;
}

}  // namespace lfdsim
