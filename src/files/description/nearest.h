// Search for the known word that was most likely meant by a wrong one. Floor 2.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim {

/// Returns the candidate that differs from the word by the fewest changes of letters; empty if none is near.
std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates);

/// Returns the near candidates, the nearest first, at most `count`. Near is one that differs by at most size/2 + 1 insertions,
/// deletions and replacements from a word of that size.
std::vector<std::string_view> nearest(std::string_view word, std::span<const std::string_view> candidates, std::size_t count);

}  // namespace lfdsim
