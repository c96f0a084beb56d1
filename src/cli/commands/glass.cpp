#include "analysis/core/figure_json.h"
#include "base/constants.h"
#include "base/counted.h"
#include "base/output_file.h"
#include "cli/output/output.h"
#include "cli/program/commands.h"
#include "cli/program/input_files.h"
#include "cli/program/interrupt.h"
#include "display/display.h"
#include "files/lenses/glasses.h"
#include "report/plots/svg.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <algorithm>
#include <cmath>

// lfdsim glass: prints or plots the indices of a glass, or lists all glasses.
namespace lfdsim::cli {
namespace {

struct GlassArguments {
    Command command;
    Option name = command.option("NAME", "", "Glass, such as N-BK7 or PMMA; without it all are listed");
    Option catalogue = command.option("--catalogue", "FILE.agf", "AGF catalogue to search first; its glasses are listed");
    Option plot = command.option("--plot", "OUT.svg", "Plot of the index in visible light");
    Flag json = command.flag("--json", "Print results as JSON");
};

/// A glass and the source of its coefficients.
struct Sourced {
    Glass glass;
    std::string source;
};

Sourced sourced(const ShippedGlass& s) {
    return {s.glass, s.successor.empty() ? std::string(s.source)
                                         : fmt::format("{}, its successor of the same glass code: {}", s.successor, s.source)};
}

/// The glass with its indices in air; null at wavelengths that its coefficients do not cover.
Json to_json(const Sourced& s) {
    const Glass& glass = s.glass;
    const auto index = [&](double nm) { return glass.covers(nm) ? number_json(index_of(glass, nm)) : Json(); };
    const auto number = [&](double x) { return glass.covers(F_line_nm) && glass.covers(C_line_nm) ? number_json(x) : Json(); };
    Json lines = Json::object(), panel = Json::object();
    for (const auto& [name, nm] : spectral_lines()) lines[std::string(name)] = {{"wavelength_nm", nm}, {"index", index(nm)}};
    for (std::size_t k = 0; k < 3; ++k) {
        const double nm = Panel().wavelengths_nm[k];
        panel[colour_of_channel[k]] = {{"wavelength_nm", nm}, {"index", index(nm)}};
    }
    return {{"name", glass.name},
            {"source", s.source},
            {"range_nm", glass.range_nm},
            {"nd", index(d_line_nm)},
            {"vd", number(abbe_number(glass))},
            {"lines", lines},
            {"panel", panel}};
}

std::string text_of(const Json& value, int decimals) {
    return value.is_number() ? fmt::format("{:.{}f}", value.get<double>(), decimals) : "-";
}

std::string text_of(const Sourced& s) {
    const Json json = to_json(s);
    std::string text = fmt::format("{}\n  from   {}\n  holds  from {:.6g} to {:.6g} nm; V_d {}\n\nn at spectral lines, in air\n",
                                   s.glass.name, s.source, s.glass.range_nm[0], s.glass.range_nm[1], text_of(json["vd"], 2));
    const auto row = [&](const std::string& name, const Json& at) {
        text += fmt::format("  {:<6} {:>9.4f} nm  {}\n", name, at["wavelength_nm"].get<double>(), text_of(at["index"], 6));
    };
    for (const auto& [name, at] : json["lines"].items()) row(name, at);
    text += "\nn at the default wavelengths of a panel's primaries (panel.wavelengths_nm)\n";
    for (const auto& [name, at] : json["panel"].items()) row(name, at);
    return text;
}

/// The glasses of the user's catalogue, or those that ship.
std::vector<Sourced> all_glasses(const std::vector<GlassCatalogue>& catalogues) {
    std::vector<Sourced> all;
    for (const GlassCatalogue& catalogue : catalogues)
        for (const Glass& glass : catalogue.glasses) all.push_back({glass, catalogue.file});
    if (catalogues.empty())
        for (const ShippedGlass& shipped : shipped_glasses()) all.push_back(sourced(shipped));
    return all;
}

void list(const std::vector<Sourced>& all, bool as_json) {
    Json json = Json::array();
    std::string text = fmt::format("{:<16} {:<9} {:<7} {:<15} {}\n", "name", "n_d", "V_d", "range, nm", "from");
    for (const Sourced& s : all) {
        const Json one = to_json(s);
        json.push_back({{"name", one["name"]},
                        {"nd", one["nd"]},
                        {"vd", one["vd"]},
                        {"range_nm", one["range_nm"]},
                        {"source", one["source"]}});
        text += fmt::format("{:<16} {:<9} {:<7} {:<15} {}\n", s.glass.name, text_of(one["nd"], 6), text_of(one["vd"], 2),
                            fmt::format("{:.6g}-{:.6g}", s.glass.range_nm[0], s.glass.range_nm[1]), s.source);
    }
    as_json ? print_json(json) : print(text);
}

/// The plot of n over the wavelength: the part of 380 to 780 nm that the glass's coefficients cover, or their whole range if they
/// cover none of it.
std::string plot(const Glass& glass) {
    constexpr double violet_nm = 380, red_nm = 780;
    const bool visible = glass.range_nm[0] < red_nm && glass.range_nm[1] > violet_nm;
    const double from = visible ? std::max(glass.range_nm[0], violet_nm) : glass.range_nm[0];
    const double to = visible ? std::min(glass.range_nm[1], red_nm) : glass.range_nm[1];
    constexpr int points = 200;
    Series curve{glass.name, {}, {}};
    for (int k = 0; k <= points; ++k) {
        curve.x.push_back(from + (to - from) * k / points);
        curve.y.push_back(index_of(glass, curve.x.back()));
    }
    Plot plot{"glass", "Refractive index of " + glass.name, "wavelength, nm", "n", {std::move(curve)}};
    for (std::size_t k = 0; k < 3; ++k)
        if (const double nm = Panel().wavelengths_nm[k]; nm >= from && nm <= to) plot.marks.push_back({colour_of_channel[k], nm});
    return svg(plot);
}

void check_plot(const GlassArguments& args) {
    if (args.plot.empty()) return;
    if (args.name.empty()) throw InputError("--plot", "is of one glass; give its name");
    const std::filesystem::path path = args.plot.text();
    if (path.extension() != ".svg") throw InputError("--plot", fmt::format("{}: a plot's name ends in .svg", args.plot.text()));
    guard_output(path);
    check_replaceable(path);
}

/// Prints the warnings of the named glass; without a name those of all glasses, at most `most_listed` of them.
void warn_of(const GlassCatalogue& catalogue, const std::string& name) {
    constexpr std::size_t most_listed = 10;
    std::size_t count = 0;
    for (const auto& [glass, doubt] : catalogue.doubts)
        if ((name.empty() || same_name(glass, name)) && ++count <= most_listed) spdlog::warn("{}: {}", doubt.where, doubt.what);
    if (count > most_listed)
        spdlog::warn("{}: and {}", catalogue.file, counted(count - most_listed, "more such glass", "more such glasses"));
}

void run(const GlassArguments& args) {
    const std::string& name = args.name.text();
    std::vector<GlassCatalogue> catalogues;
    if (!args.catalogue.empty()) {
        remember_input("the catalogue", args.catalogue.text());
        catalogues.push_back(read_agf(args.catalogue.text()));
        warn_of(catalogues.back(), name);
    }
    check_plot(args);
    if (name.empty()) return list(all_glasses(catalogues), args.json);
    const Glass* found = find_glass(name, catalogues);
    if (!found) throw InputError("NAME", unknown_glass(name, catalogues));
    const ShippedGlass* shipped = shipped_glass(found->name);
    const Sourced glass = shipped && found == &shipped->glass ? sourced(*shipped) : Sourced{*found, args.catalogue.text()};
    if (!args.plot.empty()) write_text(args.plot.text(), plot(glass.glass));
    args.json ? print_json(to_json(glass)) : print(text_of(glass));
}

}  // namespace

CommandSpec glass_command() {
    return {.name = "glass",
            .summary = "Prints the refractive indices of a glass or plastic, or lists all",
            .examples =
                "Examples:\n  lfdsim glass PMMA\n  lfdsim glass S-TIH11 --plot s-tih11.svg\n  lfdsim glass --catalogue maker.agf",
            .run = with_options<GlassArguments>(run)};
}

}  // namespace lfdsim::cli
