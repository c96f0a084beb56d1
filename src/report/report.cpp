#include "report/report.h"

#include "model/geometry.h"
#include "report/check.h"
#include "report/report_parts.h"
#include "report/report_style.h"
#include "report/svg_drawing.h"

#include <fmt/format.h>
#include <algorithm>

namespace lfdsim {
namespace {

struct Shown {
    const Measure* measure;
    Json measured;
};

std::vector<Shown> results_of(const ResultFolder& folder) {
    std::vector<Shown> all;
    for (const Measure& m : measures())
        if (folder.has(m)) all.push_back({&m, folder.read(m)});
    return all;
}

bool holds(const std::vector<Shown>& shown, const Measure* m) {
    return std::any_of(shown.begin(), shown.end(), [&](const Shown& s) { return s.measure == m; });
}

std::string name_of(const Measure* m) { return fmt::format("{} ({})", escaped(m->title), escaped(m->name)); }

/// Which of the wanted measures are missing, and why; empty: none.
std::string missing_measures(const std::vector<Shown>& shown, const ReportAbout& about) {
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

std::string contents(const std::vector<Shown>& shown) {
    std::string html =
        "<nav aria-label=\"Contents\"><ul>\n<li><a href=\"#verdict\">In short</a></li>\n<li><a href=\"#summary\">Theory and "
        "measurement</a></li>\n"
        "<li><a href=\"#display\">The display</a></li>\n";
    for (const Shown& s : shown)
        html += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", s.measure->name, escaped(s.measure->title));
    return html + "<li><a href=\"#settings\">Settings</a></li>\n</ul></nav>\n";
}

/// What each measure found first, and what is worth knowing of the design: on a page of its own, before all tables and plots.
std::string verdict(const Subject& subject, const std::vector<Shown>& shown) {
    std::string found, doubts;
    for (const Shown& s : shown)
        if (const std::string line = headline(s.measured.at("report")); !line.empty())
            found += fmt::format("<li><a href=\"#{}\">{}</a>: {}</li>\n", s.measure->name, escaped(s.measure->title), line);
    const Display& display = subject.display();
    const Geometry geometry = resolve(display);
    for (const std::string& doubt : worth_knowing(display, geometry, theory(display, geometry)))
        doubts += fmt::format("<li>{}</li>\n", escaped(doubt));
    std::string html = "<section id=\"verdict\">\n<h2>In short</h2>\n";
    if (!found.empty()) html += "<ul>\n" + found + "</ul>\n";
    html += doubts.empty() ? "<p>The description gives no cause for doubt.</p>\n"
                           : "<p class=\"warning\">Doubts about this design:</p>\n<ul>\n" + doubts + "</ul>\n";
    return html + "</section>\n";
}

std::string summary(const std::vector<Shown>& shown) {
    std::string html = "<section id=\"summary\">\n<h2>Theory and measurement</h2>\n";
    html += findings_table;
    for (const Shown& s : shown) {
        const std::string rows = finding_rows(s.measured.at("report"));
        if (rows.empty()) continue;
        html += fmt::format("<tbody><tr class=\"group\"><th colspan=\"4\"><a href=\"#{}\">{}</a></th></tr>\n{}</tbody>\n",
                            s.measure->name, escaped(s.measure->title), rows);
    }
    return html + "</table></div>\n</section>\n";
}

/// Everything the results depend on; the description comes last, as text.
std::string settings(const ResultFolder& folder, const ReportAbout& about) {
    std::string html = "<section id=\"settings\">\n<h2>Settings</h2>\n<p>The command:</p>\n<pre>" + escaped(about.command) +
                       "</pre>\n<div class=\"wide\"><table>\n";
    for (const auto& [key, value] : folder.settings().items()) {
        if (key == "display" || value.is_null()) continue;
        std::string text = value.is_string() ? value.get<std::string>() : value.is_object() ? "" : value.dump();
        if (value.is_object())
            for (const auto& [name, part] : value.items())
                text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name,
                                    part.is_string() ? part.get<std::string>() : part.dump());
        html += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", escaped(key), escaped(text));
    }
    return html + "</table></div>\n<p>The display's description, with all that options changed:</p>\n<pre>" +
           escaped(about.description) + "</pre>\n</section>\n";
}

}  // namespace

bool has_results(const ResultFolder& folder) {
    const auto all = measures();
    return std::any_of(all.begin(), all.end(), [&](const Measure& m) { return folder.has(m); });
}

std::string report_html(const Subject& subject, const ResultFolder& folder, const ReportAbout& about) {
    const std::vector<Shown> shown = results_of(folder);
    const std::string& given = subject.display().name;
    const std::string name = given.empty() ? "A display without a name" : escaped(given);
    std::string html = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n{3}\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<title>{0}: measurements</title>\n<style>{1}</style>\n</head>\n<body>\n<header>\n<h1>{0}</h1>\n"
        "<p class=\"about\">A light field display, simulated and measured by lfdsim {2}.</p>\n</header>\n",
        name, report_style, escaped(folder.settings().value("lfdsim", std::string())), ResultFolder::report_mark);
    html += missing_measures(shown, about) + "<main>\n" + contents(shown) + verdict(subject, shown) + summary(shown) +
            display_section(subject);
    for (const Shown& s : shown) html += measure_section(folder, s.measured);
    return html + settings(folder, about) + "</main>\n</body>\n</html>\n";
}

}  // namespace lfdsim
