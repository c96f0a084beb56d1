#include "report/pages/side_by_side.h"

#include "report/folder/description.h"
#include "report/pages/report_parts.h"
#include "report/pages/report_style.h"
#include "report/plots/svg_drawing.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr const char* style = R"css(
mark { background: none; color: var(--warn); font-weight: 600; }
.beside { display: grid; grid-template-columns: repeat(var(--columns), minmax(0, 1fr)); gap: 0 1.5rem; }
body { max-width: 90rem; }
)css";

std::vector<std::string> keys_of(std::span<const MeasuredDisplay> displays) {
    std::vector<std::string> keys;
    for (const MeasuredDisplay& d : displays)
        for (const Setting& s : settings(d.display))
            if (const std::string key = (s.table.empty() ? "" : s.table + ".") + s.key;
                std::find(keys.begin(), keys.end(), key) == keys.end())
                keys.push_back(key);
    return keys;
}

Json value_of(const Display& display, const std::string& key) {
    for (const Setting& s : settings(display))
        if ((s.table.empty() ? "" : s.table + ".") + s.key == key) return s.value;
    return {};
}

Json settings_that_differ(std::span<const MeasuredDisplay> displays) {
    Json all = Json::array();
    for (const std::string& key : keys_of(displays)) {
        Json values = Json::array();
        for (const MeasuredDisplay& d : displays) values.push_back(value_of(d.display, key));
        if (std::any_of(values.begin(), values.end(), [&](const Json& v) { return v != values.front(); }))
            all.push_back({{"key", key}, {"values", values}});
    }
    return all;
}

bool are_numbers(const Json& list, std::size_t count) {
    return list.is_array() && list.size() == count &&
           std::all_of(list.begin(), list.end(), [](const Json& x) { return x.is_number(); });
}

/// Returns the difference of two figures, each a list of one number or of an interval's two; null unless both have the same number.
Json difference(const Json& from, const Json& to) {
    if (from.is_null() || from.empty() || !are_numbers(from, from.size()) || !are_numbers(to, from.size())) return {};
    Json all = Json::array();
    for (std::size_t k = 0; k < from.size(); ++k) all.push_back(to[k].get<double>() - from[k].get<double>());
    return all;
}

/// Returns whether any number of a difference exceeds the sum of both errors; null where the difference or an error is missing.
Json more_than_errors(const Json& difference, const Json& one, const Json& other) {
    if (difference.is_null() || !are_numbers(one, difference.size()) || !are_numbers(other, difference.size())) return {};
    for (std::size_t k = 0; k < difference.size(); ++k)
        if (std::abs(difference[k].get<double>()) > one[k].get<double>() + other[k].get<double>()) return true;
    return false;
}

/// Returns the findings of one measure, one entry for each quantity, in the order of first occurrence.
Json findings_of(const Measure& m, std::span<const MeasuredDisplay> displays) {
    Json all = Json::array();
    for (std::size_t n = 0; n < displays.size(); ++n) {
        if (!displays[n].folder.has(m)) continue;
        const Json found = displays[n].folder.read(m);
        for (const Json& f : found.at("report").at("findings")) {
            auto row = std::find_if(all.begin(), all.end(),
                                    [&](const Json& r) { return r["what"] == f["what"] && r["unit"] == f["unit"]; });
            if (row == all.end()) {
                const Json none = std::vector<Json>(displays.size());
                all.push_back({{"measure", m.name}, {"what", f["what"]}, {"unit", f["unit"]}, {"measured", none}, {"error", none}});
                row = std::prev(all.end());
            }
            (*row)["measured"][n] = f["measured"];
            (*row)["error"][n] = f.value("error", Json());
        }
    }
    for (Json& row : all) {
        Json to_first = Json::array(), more = Json::array();
        for (std::size_t n = 1; n < displays.size(); ++n) {
            to_first.push_back(difference(row["measured"][0], row["measured"][n]));
            more.push_back(more_than_errors(to_first.back(), row["error"][0], row["error"][n]));
        }
        row["difference"] = to_first;
        row["more_than_errors"] = more;
    }
    return all;
}

std::string text_of(const Json& value) {
    if (value.is_null() || value == "" || value == Json::array()) return "–";
    return escaped(value.is_string() ? value.get<std::string>() : value.dump());
}

std::string header(const Json& names, const char* first, const std::string& last) {
    std::string html = fmt::format("<div class=\"wide\"><table class=\"findings\">\n<thead><tr><th scope=\"col\">{}</th>", first);
    for (const Json& name : names) html += fmt::format("<th scope=\"col\">{}</th>", escaped(name.get<std::string>()));
    return html + last + "</tr></thead>\n";
}

std::string settings_section(const Json& all) {
    std::string html = "<section id=\"settings\">\n<h2>Settings that differ</h2>\n" + header(all["displays"], "Key", "");
    for (const Json& row : all["settings"]) {
        html += fmt::format("<tr><th scope=\"row\">{}</th>", escaped(row["key"].get<std::string>()));
        for (const Json& value : row["values"])
            html += "<td>" + (value == row["values"][0] ? text_of(value) : "<mark>" + text_of(value) + "</mark>") + "</td>";
        html += "</tr>\n";
    }
    return html + "</table></div>\n<p>All other keys of the descriptions are the same.</p>\n</section>\n";
}

std::string figure_html(const Json& measured, const Json& error, const std::string& unit) {
    if (measured.is_null()) return "–";
    return value_html(measured, unit) + error_text(error, measured);
}

std::string difference_html(const Json& difference, const Json& more) {
    if (difference.is_null()) return "–";
    std::string text;
    for (const Json& x : difference) {
        const double number = x.get<double>();
        text += fmt::format("{}{}{:.3g}", text.empty() ? "" : ", ", number < 0 ? "−" : "+", std::abs(number));
    }
    if (more.is_null()) return text;
    return more.get<bool>() ? "<mark>" + text + ", more than the errors</mark>" : text + ", within the errors";
}

std::string findings_section(const Json& all) {
    std::string last;
    for (std::size_t n = 1; n < all["displays"].size(); ++n)
        last += fmt::format("<th scope=\"col\">{} minus {}</th>", escaped(all["displays"][n].get<std::string>()),
                            escaped(all["displays"][0].get<std::string>()));
    std::string html = "<section id=\"findings\">\n<h2>Findings</h2>\n" + header(all["displays"], "Figure", last), measure;
    for (const Json& row : all["findings"]) {
        if (row["measure"] != measure) {
            measure = row["measure"].get<std::string>();
            html += fmt::format("<tr class=\"group\"><th colspan=\"{}\"><a href=\"#{}\">{}</a></th></tr>\n",
                                2 * all["displays"].size(), measure, escaped(measure_named(measure).title));
        }
        html += fmt::format("<tr><th scope=\"row\">{}</th>", escaped(row["what"].get<std::string>()));
        for (std::size_t n = 0; n < row["measured"].size(); ++n)
            html += fmt::format("<td>{}</td>", figure_html(row["measured"][n], row["error"][n], row["unit"].get<std::string>()));
        for (std::size_t n = 0; n < row["difference"].size(); ++n)
            html += fmt::format("<td>{}</td>", difference_html(row["difference"][n], row["more_than_errors"][n]));
        html += "</tr>\n";
    }
    return html +
           "</table></div>\n<p>\"More than the errors\": the difference is larger than the sum of the errors stated for both "
           "figures. Where there is no remark, at least one figure has no stated error.</p>\n</section>\n";
}

/// Returns the plots and pictures of a measure: those at the same position in each display's list next to each other.
std::string measure_section(const Measure& m, std::span<const MeasuredDisplay> displays) {
    std::vector<std::vector<std::string>> columns;
    std::size_t rows = 0;
    for (const MeasuredDisplay& d : displays) {
        columns.push_back(d.folder.has(m) ? figures_of(d.folder, d.folder.read(m)) : std::vector<std::string>{});
        rows = std::max(rows, columns.back().size());
    }
    if (rows == 0) return "";
    std::string html =
        fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n<p class=\"says\">{}</p>\n<div class=\"beside\" style=\"--columns: {}\">\n",
                    m.name, escaped(m.title), escaped(m.says), displays.size());
    for (const MeasuredDisplay& d : displays)
        html += fmt::format("<p><a href=\"{0}/report.html#{1}\">{0}</a></p>\n", escaped(d.name), m.name);
    for (std::size_t r = 0; r < rows; ++r)
        for (const auto& column : columns) html += "<div>" + (r < column.size() ? column[r] : "") + "</div>\n";
    return html + "</div>\n</section>\n";
}

}  // namespace

Json differences(std::span<const MeasuredDisplay> displays) {
    Json names = Json::array(), findings = Json::array();
    for (const MeasuredDisplay& d : displays) names.push_back(d.name);
    for (const Measure& m : measures())
        for (Json& row : findings_of(m, displays)) findings.push_back(std::move(row));
    return {{"displays", names}, {"settings", settings_that_differ(displays)}, {"findings", findings}};
}

std::string side_by_side_html(std::span<const MeasuredDisplay> displays, const Json& all, const std::string& command,
                              const std::string& missing) {
    std::string title, links;
    for (const MeasuredDisplay& d : displays) {
        title += (title.empty() ? "" : " beside ") + escaped(d.name);
        links += fmt::format("<li><a href=\"{0}/report.html\">{0}</a></li>\n", escaped(d.name));
    }
    std::string html = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n{5}\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<title>{0}</title>\n<style>{1}{2}</style>\n</head>\n<body>\n<header>\n<h1>{0}</h1>\n"
        "<p class=\"about\">Light field displays, simulated and measured in the same way by lfdsim {3}. The report of each:</p>\n"
        "<nav aria-label=\"Reports\"><ul>\n{4}</ul></nav>\n</header>\n",
        title, report_style, style, escaped(displays.front().folder.settings().value("lfdsim", std::string())), links,
        ResultFolder::report_mark);
    if (!missing.empty())
        html += fmt::format(
            "<div class=\"incomplete\" role=\"alert\">\n<p><strong>This report is incomplete.</strong> {}</p>\n</div>\n",
            escaped(missing));
    html += "<main>\n" + settings_section(all) + findings_section(all);
    for (const Measure& m : measures()) html += measure_section(m, displays);
    return html + "<section>\n<h2>The command</h2>\n<pre>" + escaped(command) + "</pre>\n</section>\n</main>\n</body>\n</html>\n";
}

}  // namespace lfdsim
