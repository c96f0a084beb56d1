#include "cli/program/arguments.h"

#include "base/printable.h"
#include "base/text.h"
#include "base/whole_text.h"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

namespace lfdsim::cli {
namespace {

[[noreturn]] void refuse(std::string_view option, std::string_view given, std::string_view allowed) {
    throw InputError(std::string(option), fmt::format("\"{}\" is not possible; {}", shortened(given), allowed));
}

std::optional<double> finite(std::string_view text) {
    const std::optional<double> value = whole_text<double>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

// Returns what to write in place of "20,5" and "20mm".
std::string number_hint(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const std::string_view number = text.substr(0, std::size_t(end - text.data())), rest = text.substr(number.size());
    if (error != std::errc() || rest.empty()) return "give a finite number such as 12.5";
    if (rest[0] == ',' && is_digits(rest.substr(1)))
        return fmt::format("the decimal sign is a point; give {}.{}", number, rest.substr(1));
    const std::string_view unit = rest.substr(std::min(rest.find_first_not_of(' '), rest.size()));
    if (!unit.empty() && (std::isalpha(static_cast<unsigned char>(unit[0])) || unit[0] == '%' || (unit[0] & 0x80)))
        return fmt::format("give the number without a unit: {}", number);
    return "give a finite number such as 12.5";
}

std::optional<std::int64_t> whole(std::string_view text) {
    if (const auto exact = whole_text<std::int64_t>(text)) return exact;
    const std::optional<double> value = finite(text);  // 1e3; doubles are whole numbers exactly below 2^53
    if (!value || std::trunc(*value) != *value || std::abs(*value) > 0x1p53) return {};
    return std::int64_t(*value);
}

}  // namespace

double number(std::string_view option, std::string_view text) {
    if (const auto value = finite(text)) return *value;
    refuse(option, text, number_hint(text));
}

std::int64_t whole_number(std::string_view option, std::string_view text, std::int64_t low, std::int64_t high) {
    const auto value = whole(text);
    if (value && *value >= low && *value <= high) return *value;
    if (high == std::numeric_limits<std::int64_t>::max()) refuse(option, text, fmt::format("give a whole number, {} or more", low));
    refuse(option, text, fmt::format("give a whole number from {} to {}", low, high));
}

std::vector<double> numbers(std::string_view option, std::string_view text, std::string_view example, std::string_view form) {
    const std::size_t count = split(example, ',').size();
    std::vector<double> values;
    for (std::string_view part : split(text, ','))
        if (const auto value = finite(part)) values.push_back(*value);
    if (values.size() != count || split(text, ',').size() != count)
        refuse(option, text,
               fmt::format("give {}{}, such as {}", form.empty() ? "" : fmt::format("{}: ", form),
                           count == 1 ? "a finite number" : fmt::format("{} finite numbers with commas between", count), example));
    return values;
}

std::array<std::int64_t, 2> size(std::string_view option, std::string_view text) {
    const auto parts = split(text, 'x');
    if (parts.size() == 2) {
        const auto columns = whole(parts[0]), rows = whole(parts[1]);
        if (columns && rows && *columns > 0 && *rows > 0) return {*columns, *rows};
    }
    // Upper limits are those of the description, whose keys these values override.
    refuse(option, text, fmt::format("give columns x rows, such as {}", option == "--grid" ? "9x9" : "1920x1080"));
}

Rect rectangle(std::string_view option, std::string_view text, std::int64_t width, std::int64_t height) {
    std::vector<std::int64_t> v;
    const auto parts = split(text, ',');
    for (std::string_view part : parts)
        if (const auto value = whole(part)) v.push_back(*value);
    if (parts.size() == 4 && v.size() == 4 && 0 <= v[0] && v[0] < v[2] && v[2] <= width && 0 <= v[1] && v[1] < v[3] &&
        v[3] <= height)
        return {int(v[0]), int(v[1]), int(v[2]), int(v[3])};
    refuse(option, text,
           fmt::format("give X0,Y0,X1,Y1 with 0 <= X0 < X1 <= {} and 0 <= Y0 < Y1 <= {}: the frame is {} x {} pixels", width,
                       height, width, height));
}

std::string word(std::string_view option, std::string_view text, const std::vector<std::string>& allowed) {
    if (std::find(allowed.begin(), allowed.end(), text) != allowed.end()) return std::string(text);
    refuse(option, text, fmt::format("give one of {}", fmt::join(allowed, ", ")));
}

double Option::number() const { return cli::number(name_, text()); }

std::int64_t Option::whole_number(std::int64_t low, std::int64_t high) const { return cli::whole_number(name_, text(), low, high); }

std::vector<double> Option::numbers(const std::string& example) const { return cli::numbers(name_, text(), example, form_); }

std::array<std::int64_t, 2> Option::size() const { return cli::size(name_, text()); }

std::string Option::word() const {
    const std::vector<std::string_view> words = split(form_, '|');
    return cli::word(name_, text(), {words.begin(), words.end()});
}

}  // namespace lfdsim::cli
