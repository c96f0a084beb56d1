#include "report/pages/report.h"

#include "base/counted.h"
#include "geometry/geometry.h"
#include "report/folder/check.h"
#include "report/pages/report_parts.h"
#include "report/pages/report_style.h"
#include "report/plots/svg_drawing.h"

#include <fmt/format.h>
#include <algorithm>

namespace lfdsim {
namespace {

/// A measure that the report shows.
struct ReportedFigure {
    const Measure* measure;
    Json measured;  // the content of its NAME.json
};

std::vector<ReportedFigure> results_of(const ResultFolder& folder) {
    std::vector<ReportedFigure> all;
    for (const Measure& m : measures())
        if (folder.has(m)) all.push_back({&m, folder.read(m)});
    return all;
}

bool holds(const std::vector<ReportedFigure>& shown, const Measure* m) {
    return std::any_of(shown.begin(), shown.end(), [&](const ReportedFigure& s) { return s.measure == m; });
}

std::string name_of(const Measure* m) { return fmt::format("{} ({})", escaped(m->title), escaped(m->name)); }

/// Returns a box that names the wanted measures that are missing, with the reasons; empty if none are and the run was not
/// interrupted.
std::string missing_measures(const std::vector<ReportedFigure>& shown, const ReportAbout& about) {
    std::string why, names;
    for (const auto& [m, what] : about.failed)
        why += fmt::format("<p>{} could not be measured: {}</p>\n", name_of(m), escaped(what));
    for (const Measure* m : about.wanted) {
        const bool failed = std::any_of(about.failed.begin(), about.failed.end(), [&](const auto& f) { return f.first == m; });
        if (!failed && !holds(shown, m)) names += (names.empty() ? "" : ", ") + name_of(m);
    }
    if (why.empty() && names.empty() && !about.interrupted) return "";
    std::string html = "<div class=\"incomplete\" role=\"alert\">\n<p><strong>This report is incomplete.</strong>";
    if (about.interrupted) html += " The run was interrupted.";
    if (!names.empty()) html += fmt::format(" Missing: {}. The same command with --resume continues.", names);
    return html + "</p>\n" + why + "</div>\n";
}

constexpr const char* contents =
    "<nav aria-label=\"Contents\"><ul>\n<li><a href=\"#verdict\">In short</a></li>\n<li><a href=\"#summary\">All figures</a></li>\n"
    "<li><a href=\"#display\">The display</a></li>\n<li><a href=\"#settings\">Settings</a></li>\n</ul></nav>\n";

/// Returns the part before all tables and plots: warnings about the design, the first finding of each measure, and small pictures.
std::string verdict(const Subject& subject, const ResultFolder& folder, const std::vector<ReportedFigure>& shown) {
    std::string found, doubts, pictures;
    for (const ReportedFigure& s : shown) {
        const std::string seen = glance(folder, s.measured);
        pictures += seen;
        if (seen.empty() || !s.measured.at("report").at("findings").empty()) found += headline_row(s.measured.at("report"));
    }
    const Display& display = subject.display();
    const Geometry geometry = resolve(display);
    for (const std::string& doubt : worth_knowing(display, geometry, theory(display, geometry)))
        doubts += fmt::format("<li>{}</li>\n", escaped(doubt));
    std::string html = "<section id=\"verdict\">\n<h2>In short</h2>\n";
    html += doubts.empty() ? "<p>The description raises no warnings.</p>\n"
                           : "<p class=\"warning\">Warnings about this design:</p>\n<ul>\n" + doubts + "</ul>\n";
    if (!found.empty())
        html +=
            "<div class=\"wide\"><table class=\"findings\">\n<thead><tr><th scope=\"col\">Measure</th><th scope=\"col\">Figure</th>"
            "<th scope=\"col\">Measured</th><th scope=\"col\">Theory</th></tr></thead>\n<tbody>" +
            found + "</tbody></table></div>\n";
    if (!pictures.empty()) html += "<div class=\"glance\">\n" + pictures + "</div>\n";
    return html + "</section>\n";
}

/// Returns the table of all findings, by measure.
std::string summary(const std::vector<ReportedFigure>& shown) {
    std::string html = findings_table;
    std::size_t figures = 0;
    for (const ReportedFigure& s : shown) {
        const std::string rows = finding_rows(s.measured.at("report"));
        if (rows.empty()) continue;
        figures += s.measured.at("report").at("findings").size();
        html += fmt::format("<tbody><tr class=\"group\"><th colspan=\"4\"><a href=\"#{}\">{}</a></th></tr>\n{}</tbody>\n",
                            s.measure->name, escaped(s.measure->title), rows);
    }
    return "<section id=\"summary\">\n<h2>Theory and measurement</h2>\n" +
           folded(fmt::format("{} side by side", counted(figures, "figure")), html + "</table></div>\n") + "</section>\n";
}

/// Returns the part with everything that the results depend on; the description comes last, as text.
std::string settings(const ResultFolder& folder, const ReportAbout& about) {
    std::string html = "<p>The command:</p>\n<pre>" + escaped(about.command) + "</pre>\n<div class=\"wide\"><table>\n";
    for (const auto& [key, value] : folder.settings().items()) {
        if (key == "display" || value.is_null() || value == Json::array()) continue;
        std::string text = value.is_string() ? value.get<std::string>() : value.is_object() ? "" : value.dump();
        if (value.is_object())
            for (const auto& [name, part] : value.items())
                text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name,
                                    part.is_string() ? part.get<std::string>() : part.dump());
        html += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", escaped(key), escaped(text));
    }
    html += "</table></div>\n<p>The display's description, including changes by options:</p>\n<pre>" + escaped(about.description) +
            "</pre>\n";
    return "<section id=\"settings\">\n<h2>Settings</h2>\n" +
           folded("The command, and everything that the results depend on", html) + "</section>\n";
}

}  // namespace

bool has_results(const ResultFolder& folder) {
    const auto all = measures();
    return std::any_of(all.begin(), all.end(), [&](const Measure& m) { return folder.has(m); });
}

std::string report_html(const Subject& subject, const ResultFolder& folder, const ReportAbout& about) {
    const std::vector<ReportedFigure> shown = results_of(folder);
    const std::string& given = subject.display().name;
    const std::string name = given.empty() ? "A display without a name" : escaped(given);
    std::string html = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n{3}\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<title>{0}: measurements</title>\n<style>{1}</style>\n</head>\n<body>\n<header>\n<h1>{0}</h1>\n"
        "<p class=\"about\">A light field display, simulated and measured by lfdsim {2}.</p>\n</header>\n",
        name, report_style, escaped(folder.settings().value("lfdsim", std::string())), ResultFolder::report_mark);
    html += missing_measures(shown, about) + "<main>\n" + contents + verdict(subject, folder, shown) + summary(shown) +
            display_section(subject);
    for (const ReportedFigure& s : shown) html += measure_section(folder, s.measured);
    return html + settings(folder, about) + "</main>\n</body>\n</html>\n";
}

}  // namespace lfdsim
