#include "files/lenses/lens_table.h"

#include "base/constants.h"
#include "base/counted.h"
#include "base/printable.h"
#include "base/problems.h"
#include "base/text.h"
#include "base/whole_text.h"
#include "files/description/nearest.h"
#include "files/description/text_file.h"
#include "geometry/geometry.h"
#include "geometry/lens_misalignment.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <optional>

namespace lfdsim {
namespace {

constexpr std::size_t most_table_bytes = std::size_t(1) << 30;

constexpr std::string_view table_columns[] = {"i", "j", "dx_mm", "dy_mm", "dz_mm", "tilt_x_deg", "tilt_y_deg", "curvature"};
constexpr std::size_t column_count = std::size(table_columns);

std::vector<std::string_view> cells_of(std::string_view line) {
    std::vector<std::string_view> cells = split(line, ',');
    for (std::string_view& cell : cells) cell = trimmed(cell);
    return cells;
}

// Reads lines and collects their faults, with the number of the line.
class TableReader {
  public:
    TableReader(std::string_view text, std::string name, const Display& d)
        : text_(text), name_(std::move(name)), strips_(is_strips(d.array)), count_(lens_count(d.panel, d.array)) {}

    std::vector<GivenLensError> read() {
        std::string_view line;
        if (!next(line))
            throw InputError(name_, fmt::format("is empty; its first line names the columns: {}", fmt::join(table_columns, ",")));
        if (!read_header(line)) problems_.report();
        while (next(line))
            if (!line.empty()) read_lens(line);
        refuse_doubles();
        problems_.report();
        std::vector<GivenLensError> lenses;
        lenses.reserve(rows_.size());
        for (const TableRow& row : rows_) lenses.push_back(row.lens);
        return lenses;
    }

  private:
    struct TableRow {
        GivenLensError lens;
        std::size_t line;
    };

    bool next(std::string_view& line) {
        if (text_.empty()) return false;
        line = trimmed(next_line(text_));
        ++line_;
        return true;
    }

    template <class... Args>
    void refuse(fmt::format_string<Args...> what, Args&&... args) {
        problems_.add(place(line_), what, std::forward<Args>(args)...);
    }
    std::string place(std::size_t line) const { return fmt::format("{}:{}", name_, line); }

    bool read_header(std::string_view line) {
        if (line.starts_with("\xef\xbb\xbf")) line.remove_prefix(3);  // spreadsheets begin with a byte order mark
        for (const std::string_view word : cells_of(line)) {
            const auto at = std::size_t(std::ranges::find(table_columns, word) - std::begin(table_columns));
            if (at == column_count) {
                const std::string_view near = nearest(word, table_columns);
                refuse("the column \"{}\" is unknown; {}", shortened(word),
                       near.empty() ? fmt::format("known are {}", fmt::join(table_columns, ", "))
                                    : fmt::format("did you mean {}?", near));
            } else if (std::ranges::find(order_, at) != order_.end())
                refuse("the column {} occurs twice", word);
            order_.push_back(at);
        }
        for (std::size_t k = 0; k < column_count && problems_.empty(); ++k)
            if (std::ranges::find(order_, k) == order_.end())
                refuse("the column {} is missing; the header is {}", table_columns[k], fmt::join(table_columns, ","));
        return problems_.empty();
    }

    // Reads the line of one lens; of a line with a fault, only the first one is reported.
    void read_lens(std::string_view line) {
        const std::vector<std::string_view> words = cells_of(line);
        if (words.size() != column_count) return refuse("has {}, the header {}", counted(words.size(), "value"), column_count);
        double values[column_count];
        for (std::size_t k = 0; k < column_count; ++k) {
            double& value = values[order_[k]];
            value = whole_text<double>(words[k].starts_with('+') ? words[k].substr(1) : words[k]).value_or(nan);
            if (!std::isfinite(value))
                return refuse("{} is \"{}\"; give a finite number", table_columns[order_[k]], shortened(words[k]));
            if (std::abs(value) > 1e6) return refuse("{} is {}; at most 1e6", table_columns[order_[k]], value);
        }
        // The lens must be one of the array, and strips have no error along their axes.
        for (std::size_t k = 0; k < 2; ++k) {
            if (values[k] != std::floor(values[k]))
                return refuse("{} is {}; lenses are counted in whole numbers", table_columns[k], values[k]);
            if (!(values[k] >= 0 && values[k] < double(count_[k])))
                return refuse("there is no lens {} = {}; the array has {} x {}, counted from 0", table_columns[k], values[k],
                              count_[0], count_[1]);
        }
        if (strips_ && (values[3] != 0 || values[5] != 0))
            return refuse("dy_mm is {} and tilt_x_deg {}, but strips move across themselves and turn about their axes only; give 0",
                          values[3], values[5]);
        rows_.push_back({{std::int64_t(values[0]),
                          std::int64_t(values[1]),
                          {{values[2], values[3]}, values[4], {values[5], values[6]}, values[7]}},
                         line_});
    }

    void refuse_doubles() {
        std::ranges::stable_sort(rows_, [](const TableRow& a, const TableRow& b) {
            return std::pair(a.lens.j, a.lens.i) < std::pair(b.lens.j, b.lens.i);
        });
        for (std::size_t k = 1; k < rows_.size(); ++k)
            if (rows_[k].lens.i == rows_[k - 1].lens.i && rows_[k].lens.j == rows_[k - 1].lens.j)
                problems_.add(place(rows_[k].line), "lens ({}, {}) is also in line {}", rows_[k].lens.i, rows_[k].lens.j,
                              rows_[k - 1].line);
    }

    std::string_view text_;  // the part that has not been read
    std::string name_;
    bool strips_;
    std::array<std::int64_t, 2> count_;
    std::size_t line_ = 0;
    std::vector<std::size_t> order_;  // for each column of the file, its index in table_columns
    std::vector<TableRow> rows_;
    Problems problems_{Problems::most_of_a_file};
};

}  // namespace

std::shared_ptr<const std::vector<GivenLensError>> read_lens_table(const std::filesystem::path& file, const Display& display) {
    const std::string text = read_text(file, "a table of lens errors", most_table_bytes);
    return std::make_shared<const std::vector<GivenLensError>>(TableReader(text, file.string(), display).read());
}

std::string write_lens_table(const Display& display) {
    const Geometry geometry = resolve(display);
    const auto columns_of_lenses = std::size_t(geometry.lattice.count[0]);
    std::string text = fmt::format("{}\n", fmt::join(table_columns, ","));
    const std::vector<LensError> all = lens_errors(display, geometry.lattice);
    for (std::size_t k = 0; k < all.size(); ++k) {
        const LensError& e = all[k];
        fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{}\n", k % columns_of_lenses, k / columns_of_lenses,
                       e.aside_mm[0], e.aside_mm[1], e.height_mm, e.tilt_deg[0], e.tilt_deg[1], e.curvature);
    }
    return text;
}

}  // namespace lfdsim
