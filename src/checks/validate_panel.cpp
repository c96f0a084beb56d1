// Checks of the panel's subpixels: layout, cell and rectangles must go together. docs/model.md, "Subpixels".

#include "checks/findings.h"
#include "display/keys.h"
#include "geometry/subpixels.h"

namespace lfdsim {
namespace {

// Checks a custom layout: rectangles within limits, of pixels of the cell, with an area, for each channel, and without overlaps.
void check_custom(const Panel& panel, Findings& findings) {
    const auto where = [](std::size_t k) { return fmt::format("panel.subpixel.{}", k); };
    if (panel.custom.size() > max_subpixels)
        return findings.add("panel.subpixel", "has {}, allowed are {}", panel.custom.size(), max_subpixels);
    const std::array<std::int64_t, 2> cell = *panel.subpixel_cell;
    for (std::size_t k = 0; k < panel.custom.size(); ++k) {
        const Subpixel& s = panel.custom[k];
        if (s.pixel[0] >= cell[0] || s.pixel[1] >= cell[1])
            findings.add(where(k) + ".pixel", "is [{}, {}], outside of the cell of {} x {} pixels; count from 0", s.pixel[0],
                         s.pixel[1], cell[0], cell[1]);
        if (s.rect[0] >= s.rect[2] || s.rect[1] >= s.rect[3])
            findings.add(where(k) + ".rect", "is [{}, {}, {}, {}] and has no area; give left, top, right, bottom", s.rect[0],
                         s.rect[1], s.rect[2], s.rect[3]);
    }
    for (const Channel channel : {Channel::r, Channel::g, Channel::b})
        if (std::none_of(panel.custom.begin(), panel.custom.end(), [&](const Subpixel& s) { return s.channel == channel; }))
            findings.add("panel.subpixel", "no rectangle emits \"{}\"; give at least one for each of r, g, b", word(channel));
    if (!findings.sound("panel.subpixel")) return;
    if (const auto two = overlapping(panel); two && two->first == two->second)
        findings.add(where(two->first) + ".rect", "overlaps itself: the cell of {} x {} pixels repeats", cell[0], cell[1]);
    else if (two)
        findings.add(where(two->second) + ".rect", "overlaps panel.subpixel.{}", two->first);
    else if (const std::size_t parts = bounded_parts(panel).size(); parts > max_subpixel_parts)
        findings.add("panel.subpixel",
                     "give {} parts, since rectangles that extend over the cell's border are divided there; allowed are {}", parts,
                     max_subpixel_parts);
}

}  // namespace

void validate_panel(const Display& d, Findings& findings) {
    const Panel& panel = d.panel;
    if (!findings.sound("panel.")) return;
    const bool custom = panel.subpixels == SubpixelLayout::custom;
    const std::string_view layout = word(panel.subpixels);
    if (!custom && panel.subpixel_cell)
        findings.add("panel.subpixel_cell", "is given, but panel.subpixels is \"{}\"; take \"custom\", or leave it out", layout);
    if (!custom && !panel.custom.empty())
        findings.add("panel.subpixel", "is given, but panel.subpixels is \"{}\"; take \"custom\", or leave it out", layout);
    if (custom && !panel.subpixel_cell)
        findings.add("panel.subpixel_cell", "is missing; give the columns and rows of pixels after which the subpixels repeat");
    if (custom && panel.custom.empty())
        findings.add("panel.subpixel", "is missing; give [[panel.subpixel]] with channel, pixel and rect for each of r, g, b");
    if (custom && findings.sound("panel.subpixel")) check_custom(panel, findings);
    // The tracer counts four times as many positions on such a panel, and its limit is 2^31.
    constexpr double most = two_to_31 / 4;
    const double pixels = double(panel.pixels[0]) * double(panel.pixels[1]);
    if (!lights_whole_pixels(panel) && pixels >= most && findings.sound("panel.pixels"))
        findings.add("panel.pixels", "{} x {} = {:.0f}; allowed is a product below 2^29 = {:.0f} with subpixels or a black matrix",
                     panel.pixels[0], panel.pixels[1], pixels, most);
}

}  // namespace lfdsim
