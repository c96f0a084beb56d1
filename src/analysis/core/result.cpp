#include "analysis/core/result.h"

#include "analysis/core/estimate.h"
#include "analysis/core/figure_json.h"

#include <cmath>

namespace lfdsim {

FigureValue::FigureValue(const Estimate& e, const std::string& why_missing)
    : FigureValue(std::vector{e.value}, std::vector{e.error}, std::isnan(e.value) ? why_missing : std::string()) {}

FigureValue::FigureValue(const Estimate& low, const Estimate& high, std::string why_missing)
    : FigureValue(std::vector{low.value, high.value}, std::vector{low.error, high.error}, std::move(why_missing)) {}

void write_value(Json& object, const std::string& name, const FigureValue& value) {
    const auto json = [](const std::vector<double>& x) {
        return x.empty() ? Json() : x.size() == 1 ? number_json(x.front()) : numbers_json(x);
    };
    object[name] = json(value.numbers);
    if (!value.errors.empty()) object[name + "_error"] = json(value.errors);
}

DataTable DataTable::of_rows(std::string name, const std::vector<std::string>& columns) {
    DataTable table{std::move(name), {}};
    for (const std::string& column : columns) table.columns.push_back({column, {}});
    return table;
}

void DataTable::add_row(std::span<const double> row) {
    for (std::size_t k = 0; k < row.size(); ++k) columns[k].values.push_back(row[k]);
}

Curves::Curves(const std::string& name, std::string title, std::string x_label, std::string y_label, Column x)
    : plot{name, std::move(title), std::move(x_label), std::move(y_label), {}}, table{name, {std::move(x)}} {}

void Curves::add(std::string label, std::string column, std::vector<double> y) {
    plot.series.push_back({std::move(label), table.columns.front().values, y});
    table.columns.push_back({std::move(column), std::move(y)});
}

void Result::add(const std::string& path, const FigureValue& value) {
    // Objects along the path are made as needed.
    Json* object = &figures;
    std::size_t start = 0;
    for (std::size_t dot; (dot = path.find('.', start)) != std::string::npos; start = dot + 1)
        object = &(*object)[path.substr(start, dot - start)];
    write_value(*object, path.substr(start), value);
    if (!value.missing.empty()) note(path, value.missing);
    for (std::size_t k = 0; k < value.errors.size(); ++k)
        if (std::isnan(value.errors[k]) && std::isinf(value.numbers[k])) note(path + "_error", "an infinite figure has no error");
}

void Result::add(const std::string& path, const FigureValue& value, const FigureLine& line) {
    add(path, value);
    if (!line.theory_path.empty()) add(line.theory_path, line.theory);
    add_line(value, line);
}

void Result::add_line(const FigureValue& value, const FigureLine& line) {
    const std::string& remark = !value.missing.empty()         ? value.missing
                                : !line.theory.missing.empty() ? line.theory.missing
                                                               : line.remark;
    findings.push_back({line.label, line.unit, value.numbers, line.theory.numbers, remark, value.errors});
}

void Result::add(Curves curves) {
    plots.push_back(std::move(curves.plot));
    tables.push_back(std::move(curves.table));
}

}  // namespace lfdsim
