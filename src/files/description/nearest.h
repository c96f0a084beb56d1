// Search for the known word that was most likely meant by a wrong one. Floor 2.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim {

/// The candidate with the fewest letters to change; empty if that would be more than about half of the word.
std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates);

/// The candidates with the fewest letters to change, at most so many, the nearest first; those that are not near are left out.
std::vector<std::string_view> nearest(std::string_view word, std::span<const std::string_view> candidates, std::size_t count);

}  // namespace lfdsim
