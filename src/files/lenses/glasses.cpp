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

/// Returns why a catalogue lacks a glass that it names; null otherwise.
const Problem* left_out(std::string_view name, const GlassCatalogue& catalogue) {
    const auto& glasses = catalogue.glasses;
    if (std::any_of(glasses.begin(), glasses.end(), [&](const Glass& glass) { return same_name(glass.name, name); }))
        return nullptr;
    for (const auto& [glass, problem] : catalogue.doubts)
        if (same_name(glass, name)) return &problem;
    return nullptr;
}

}  // namespace

const Glass* find_glass(std::string_view name, std::span<const GlassCatalogue> catalogues) {
    for (const GlassCatalogue& catalogue : catalogues) {
        for (const Glass& glass : catalogue.glasses)
            if (same_name(glass.name, name)) return &glass;
        if (left_out(name, catalogue)) return nullptr;
    }
    for (const ShippedGlass& shipped : shipped_glasses())
        if (same_name(shipped.glass.name, name)) return &shipped.glass;
    return nullptr;
}

std::string unknown_glass(std::string_view name, std::span<const GlassCatalogue> catalogues) {
    for (const GlassCatalogue& catalogue : catalogues)
        if (const Problem* const why = left_out(name, catalogue))
            return fmt::format("{}: {}; mend the catalogue, or name another one before it", why->where, why->what);
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
                if (medium.glass && same_name(medium.glass->name, glass)) {
                    all.push_back(problem);
                    break;
                }
    return all;
}

}  // namespace lfdsim
