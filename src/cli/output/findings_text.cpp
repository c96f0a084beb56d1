#include "cli/output/findings_text.h"

#include "analysis/core/measure.h"
#include "report/pages/report_parts.h"

#include <fmt/format.h>
#include <algorithm>

namespace lfdsim::cli {
namespace {

std::string value_text(const Json& values, const std::string& unit) {
    if (values.empty()) return "";
    if (std::all_of(values.begin(), values.end(), [](const Json& x) { return x.is_null(); })) return "not found";
    std::string text;
    for (const Json& x : values)
        text += (text.empty() ? "" : " .. ") + (x.is_null()     ? "not found"
                                                : x.is_number() ? digits_of(x.get<double>())
                                                                : x.get<std::string>());
    return text + (unit.empty() ? "" : " " + unit);
}

}  // namespace

std::string table_of(const Json& measured) {
    const Json& report = measured.at("report");
    std::string text = fmt::format("\n{}\n", report.at("title").get<std::string>());
    for (const Json& f : report.at("findings")) {
        const std::string unit = f.at("unit"), theory = value_text(f.at("theory"), unit);
        const Json& values = f.at("measured");
        text +=
            fmt::format("  {:<58} {:<26}{}\n", f.at("what").get<std::string>(),
                        value_text(values, unit) + error_text(f.at("error"), values), theory.empty() ? "" : "  theory " + theory);
        if (std::any_of(values.begin(), values.end(), [](const Json& x) { return x.is_null(); }))
            text += fmt::format("      {}\n", f.at("remark").get<std::string>());
    }
    return text;
}

std::string table_of_differences(const Json& all) {
    std::string text, measure;
    for (const Json& row : all["findings"]) {
        if (row["measure"] != measure)
            text += "\n" + std::string(measure_named(measure = row["measure"].get<std::string>()).title) + "\n";
        const std::string unit = row["unit"];
        std::string line = fmt::format("  {:<58}", row["what"].get<std::string>());
        for (std::size_t n = 0; n < row["measured"].size(); ++n) {
            const Json& measured = row["measured"][n];
            line += fmt::format(" {:<26}",
                                measured.is_null() ? "-" : value_text(measured, unit) + error_text(row["error"][n], measured));
        }
        for (const Json& more : row["more_than_errors"])
            line += more.is_null() ? "" : more.get<bool>() ? " differ" : " within the errors";
        text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
}

}  // namespace lfdsim::cli
