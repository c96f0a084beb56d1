#include "files/description/nearest.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace lfdsim {
namespace {

// Returns Levenshtein's distance: the least number of insertions, deletions and replacements of letters from a to b. `row` has the
// distances of the first i letters of a to all beginnings of b.
std::size_t edits(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replace = diagonal + (a[i] != b[j]);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replace, row[j] + 1, diagonal + 1});
        }
    }
    return row.back();
}

}  // namespace

std::vector<std::string_view> nearest(std::string_view word, std::span<const std::string_view> candidates, std::size_t count) {
    std::vector<std::pair<std::size_t, std::string_view>> near;
    if (word.size() > 64) return {};  // no key is half as long
    for (const std::string_view candidate : candidates) {
        // A missing unit is the usual slip, sphere_radius for sphere_radius_mm, and counts as one change.
        const std::size_t changes = candidate.starts_with(word) && word.size() > 2 ? 1 : edits(word, candidate);
        if (changes < word.size() / 2 + 2) near.emplace_back(changes, candidate);
    }
    std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::string_view> best;
    for (std::size_t k = 0; k < std::min(near.size(), count); ++k) best.push_back(near[k].second);
    return best;
}

std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates) {
    const std::vector<std::string_view> best = nearest(word, candidates, 1);
    return best.empty() ? std::string_view() : best.front();
}

}  // namespace lfdsim
