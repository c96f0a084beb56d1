#include "files/lenses/glasses.h"

#include "base/printable.h"
#include "display/colour.h"
#include "files/description/nearest.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cctype>
#include <set>

namespace lfdsim {
namespace {

constexpr std::size_t most_offered = 3;

std::string in_capitals(std::string_view name) {
    std::string text(name);
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::toupper(c)); });
    return text;
}

/// Calls visit for each glass, those of the user's catalogues first.
template <class Visit>
void visit_glasses(std::span<const GlassCatalogue> catalogues, const Visit& visit) {
    for (const GlassCatalogue& catalogue : catalogues)
        for (const Glass& glass : catalogue.glasses) visit(glass);
    for (const ShippedGlass& shipped : shipped_glasses()) visit(shipped.glass);
}

}  // namespace

const Glass* find_glass(std::string_view name, std::span<const GlassCatalogue> catalogues) {
    const Glass* found = nullptr;
    visit_glasses(catalogues, [&](const Glass& glass) {
        if (!found && same_name(glass.name, name)) found = &glass;
    });
    return found;
}

std::string unknown_glass(std::string_view name, std::span<const GlassCatalogue> catalogues) {
    std::set<std::string> capitals;  // each name once: a glass may be in several catalogues
    visit_glasses(catalogues, [&](const Glass& glass) { capitals.insert(in_capitals(glass.name)); });
    const std::vector<std::string_view> near =
        nearest(in_capitals(name), std::vector<std::string_view>(capitals.begin(), capitals.end()), most_offered);
    return fmt::format(
        "no catalogue has a glass \"{}\"; {}", shortened(name),
        near.empty() ? "`lfdsim glass` lists those that ship" : fmt::format("did you mean {}?", fmt::join(near, " or ")));
}

std::vector<Problem> doubts_of_glasses(const Display& d) {
    std::vector<Problem> all;
    for (const std::string& file : d.glass_catalogues)
        for (const auto& [glass, problem] : read_agf(file).doubts)
            for (const Medium& medium : media_of(d))
                if (medium.glass && medium.glass->name == glass) {
                    all.push_back(problem);
                    break;
                }
    return all;
}

}  // namespace lfdsim
