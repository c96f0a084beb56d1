#include "report/folder/check.h"
#include "base/printable.h"
#include "cli/options/display_options.h"
#include "cli/output/output.h"
#include "cli/program/commands.h"
#include "report/folder/colours.h"
#include "report/folder/description.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

// lfdsim check: validates a description; prints warnings, the lengths and the theory that follow from it, and its keys.
namespace lfdsim::cli {
namespace {

struct CheckArguments {
    Command command;
    DisplayOptions display{command, {camera_options, sample_options, content_options}};
    Flag json = command.flag("--json", "Print results as JSON, with all keys");
    Flag all = command.flag("--all", "Print all keys, including those that have their defaults");
};

std::string text_of(const Json& value) {
    if (value.is_string()) return printable(value.get<std::string>());
    if (value.is_number_float()) return fmt::format("{:.10g}", value.get<double>());
    if (!value.is_array()) return value.dump();
    std::string text;
    for (const Json& element : value) text += (text.empty() ? "" : ", ") + text_of(element);
    return text;
}

std::string table_of(const Setting& s) {
    const bool absent = s.value.is_null() || s.value == "" || s.value == Json::array();
    std::string text = absent ? "-" : text_of(s.value);
    if (!absent && !unit_of(s.key).empty()) text += " " + unit_of(s.key);
    std::string note = s.is_default ? "default" : "";
    if (absent && !s.absent.empty()) note += ": " + s.absent;
    return fmt::format("  {:<22} {:<32}{}", s.key, text, note);
}

// Formats a figure in seven digits: more than any length is made to, fewer than double arithmetic carries.
std::string number_text(double x) {
    return std::isfinite(x) ? fmt::format("{:.7g}", x) : std::isnan(x) ? "none" : x > 0 ? "infinite" : "-infinite";
}

std::string table_of(const Figure& f) {
    std::vector<std::string> numbers;
    const bool interval = f.kind == Figure::Presentation::interval;
    for (const double x : f.values) numbers.push_back(interval && std::isfinite(x) ? fmt::format("{:.4g}", x) : number_text(x));
    if (interval && std::isnan(f.values[0])) numbers.resize(1);
    std::string value = fmt::format("{}", fmt::join(numbers, interval ? " to " : " x "));
    const auto number = [&](double x) { return std::isfinite(x) || (interval && !std::isnan(x)); };
    if (std::ranges::all_of(f.values, number)) value += " " + unit_of(f.name);
    return fmt::format("  {:<28} {:<22} {}", f.name, value, f.meaning);
}

// Adds a line without the trailing blanks of its columns.
void add_line(std::string& text, std::string line) {
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
}

/// A line for each figure, a column for each channel.
std::string table_of(const std::vector<ChannelTheory>& colours) {
    std::string text = "\nTheory by colour (dispersive glass); positions are those for green\n";
    const auto row = [&](const std::string& name, const char* meaning, const auto& value) {
        std::string line = fmt::format("  {:<28}", name);
        for (const ChannelTheory& c : colours) line += fmt::format(" {:<12}", value(c));
        add_line(text, line + " " + meaning);
    };
    const auto figure = [&](const char* name, const char* meaning, double ChannelTheory::*member) {
        row(name, meaning, [&](const ChannelTheory& c) { return number_text(c.*member); });
    };
    row("", "", [](const ChannelTheory& c) { return c.name; });
    figure("wavelength_nm", "wavelength of the channel", &ChannelTheory::wavelength_nm);
    for (std::size_t k = 0; k < colours.front().indices.size(); ++k)
        row(colours.front().indices[k].first, "n, index of the glass",
            [&](const ChannelTheory& c) { return number_text(c.indices[k].second); });
    figure("focal_length_mm", "f", &ChannelTheory::focal_length_mm);
    figure("gap_mm", "g", &ChannelTheory::gap_mm);
    figure("central_depth_mm", "L", &ChannelTheory::central_depth_mm);
    return text;
}

void run(const CheckArguments& args) {
    const Display display = args.display.read();
    const Geometry geometry = resolve(display);
    const Theory paraxial = theory(display, geometry);
    if (args.json) return print_json(check_json(display));
    const std::vector<Setting> keys = settings(display);
    const std::vector<ChannelTheory> colours = theory_by_colour(display);
    const std::vector<std::string> warnings = worth_knowing(display, geometry, paraxial);

    // Warnings come first, then what follows from the description, and last its keys.
    std::string text = printable(args.display.path()) + " is valid", table;
    text += warnings.empty() ? "; no advice on views, sharpness, colours, eye and scene.\n" : ", but worth knowing:\n";
    for (const std::string& warning : warnings) text += "  - " + warning + "\n";
    text += "\nPositions and sizes (z from the panel)\n";
    for (const Figure& f : figures(display, geometry)) add_line(text, table_of(f));
    text += "\nParaxial theory (depths from the lenses, negative behind them)\n";
    for (const Figure& f : figures(display, geometry, paraxial))
        if (f.kind != Figure::Presentation::for_scripts) add_line(text, table_of(f));
    if (!colours.empty()) text += table_of(colours);
    const std::vector<Figure> largest = largest_errors(display, geometry);
    if (!largest.empty()) text += "\nLargest errors of single lenses\n";
    for (const Figure& f : largest) add_line(text, table_of(f));
    text += args.all ? "\nKeys\n" : "\nKeys that differ from their defaults (--all: every key)\n";
    for (const Setting& s : keys) {
        if (s.is_default && !args.all) continue;
        if (!s.table.empty() && s.table != table) add_line(text, fmt::format("[{}]", s.table));
        table = s.table;
        add_line(text, table_of(s));
    }
    print(text);
}

}  // namespace

CommandSpec check_command() {
    return {
        .name = "check",
        .summary = "Validates a description; prints errors, warnings and remedies, derived lengths, paraxial theory, and the keys",
        .examples = "Example:\n  lfdsim check display.toml --set array.gap_mm=17",
        .run = with_options<CheckArguments>(run)};
}

}  // namespace lfdsim::cli
