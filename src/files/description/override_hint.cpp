#include "files/description/override_hint.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "base/text.h"
#include "display/keys.h"

namespace lfdsim {
namespace {

enum class ValueForm { number, list, other };

/// The form in which a value of a type is written; `other`: as a text or a word.
template <class Value>
constexpr ValueForm form = has_words<Value>              ? ValueForm::other
                           : std::is_arithmetic_v<Value> ? ValueForm::number
                                                         : ValueForm::list;
template <class T>
constexpr ValueForm form<std::optional<T>> = form<T>;
template <>
constexpr ValueForm form<Pitch> = ValueForm::number;
template <>
constexpr ValueForm form<std::string> = ValueForm::other;
template <>
constexpr ValueForm form<std::vector<std::string>> = ValueForm::other;
template <>
constexpr ValueForm form<Glass> = ValueForm::other;

ValueForm form_of(std::string_view path) {
    const FormatTable::Value* found = key_at(path);
    return found ? std::visit([]<class Value>(const Value*) { return form<Value>; }, found->fresh) : ValueForm::other;
}

/// Returns, in TOML's form, the decimal with which a text begins as people write it (".6", "6.", "+007"); the rest of the text goes
/// to `rest`. Nothing where the text begins with no finite number.
std::optional<std::string> decimal(std::string_view text, std::string_view& rest) {
    const bool plus = text.starts_with('+');
    if (plus) text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || !std::isfinite(value) || (plus && text.starts_with('-'))) return {};
    rest = text.substr(std::size_t(end - text.data()));
    return fmt::format("{}", value);
}

/// Returns the unit in a key's name, "mm" or "deg"; empty if the key has none.
std::string_view unit_of_key(std::string_view path) {
    if (path.ends_with("_per_mm")) return "1/mm";
    if (path.ends_with("_mm")) return "mm";
    if (path.ends_with("_nm")) return "nm";
    return path.ends_with("_deg") ? "deg" : "";
}

/// Returns the hint for a number that is followed by the unit `given`.
std::string with_unit(std::string_view path, const std::string& number, std::string_view given) {
    const std::string_view unit = unit_of_key(path);
    if (unit.empty()) return fmt::format("the value is a number without a unit; write {}", number);
    const bool same = given == unit || (unit == "deg" && (given == "degrees" || given == "\u00b0"));
    return fmt::format("numbers carry no unit, {} is in {}; write {}", path, unit, same ? number : "the number in it");
}

/// Returns the numbers of a text such as "1,5", "11 6" or "[96x60]"; nothing unless all of it is decimals and what may separate
/// them.
std::optional<std::vector<std::string>> decimals(std::string_view text) {
    if (text.starts_with('[')) text.remove_prefix(1);
    if (text.ends_with(']')) text.remove_suffix(1);
    constexpr std::string_view separators = ", ;x";
    std::vector<std::string> all;
    for (std::size_t start; (start = text.find_first_not_of(separators)) != text.npos;) {
        text.remove_prefix(start);
        const std::size_t end = std::min(text.find_first_of(separators), text.size());
        std::string_view rest;
        const auto one = decimal(text.substr(0, end), rest);
        if (!one || !rest.empty()) return {};
        all.push_back(*one);
        text.remove_prefix(end);
    }
    return all.empty() ? std::nullopt : std::optional(std::move(all));
}

/// Whether a decimal lacks digits beside its point or has leading zeros (".6", "6.", "007"), which TOML refuses. Other decimals
/// were refused for another reason, such as too many digits.
bool half_written(std::string_view number) {
    if (number.starts_with('+') || number.starts_with('-')) number.remove_prefix(1);
    const std::size_t point = number.find('.');
    const bool digit_after = point + 1 < number.size() && std::isdigit(static_cast<unsigned char>(number[point + 1]));
    return (point != number.npos && (point == 0 || !digit_after)) ||
           (number.size() > 1 && number[0] == '0' && std::isdigit(static_cast<unsigned char>(number[1])));
}

/// Returns the hint for the value of a key that takes one number.
std::string number_hint(std::string_view path, std::string_view value) {
    if (value.starts_with('"') || value.starts_with('\'')) {
        const std::string_view inside = trimmed(value.substr(1), " ");
        std::string_view rest;
        if (const auto number = decimal(inside, rest); number && rest.empty())
            return "numbers are written without quotes: " + *number;
    }
    std::string_view rest;
    if (const auto number = decimal(value, rest)) {
        const std::string_view unit = trimmed(rest, " ");
        if (unit.empty())
            return half_written(value) ? "numbers have digits on both sides of a point and no leading zeros; write " + *number : "";
        if ((unit[0] == 'e' || unit[0] == 'E') && unit.find_first_not_of("+-", 1) == unit.npos)
            return fmt::format("the exponent is missing; write a number such as {}e3", *number);
        const std::size_t comma = value.find(',');
        if (unit[0] == ',' && is_digits(unit.substr(1)))
            return fmt::format("the decimal sign is a point; write {}.{}", value.substr(0, comma), value.substr(comma + 1));
        if (std::isalpha(static_cast<unsigned char>(unit[0])) || unit[0] == '%' || static_cast<unsigned char>(unit[0]) >= 0x80)
            return with_unit(path, *number, unit);
    }
    return "give a number such as 12.5 or 1e3";
}

/// Returns the hint for the value of a key that takes a text or a word.
std::string text_hint(std::string_view value) {
    const bool word = std::isalpha(static_cast<unsigned char>(value[0])) && value != "true" && value != "false" &&
                      std::all_of(value.begin(), value.end(), [](char c) { return c >= ' ' && c <= '~' && c != '"'; });
    return word ? fmt::format("text is written in quotes: \"{}\"", value) : "";
}

/// Returns the hint for the value of a key that takes a list; none for one with brackets and commas, which was refused for another
/// reason, such as too many digits.
std::string list_hint(std::string_view value) {
    const std::optional<std::vector<std::string>> all = decimals(value);
    const auto commas = std::size_t(std::count(value.begin(), value.end(), ','));
    if (all && !(value.starts_with('[') && value.ends_with(']') && commas + 1 == all->size()))
        return fmt::format("a list is written in brackets, with commas: [{}]", fmt::join(*all, ", "));
    return "";
}

}  // namespace

std::string override_hint(std::string_view path, std::string_view value) {
    value = trimmed(value, " ");
    if (value.empty()) return "the value is missing";
    switch (form_of(path)) {
        case ValueForm::number:
            return number_hint(path, value);
        case ValueForm::list:
            return list_hint(value);
        case ValueForm::other:
            break;
    }
    return key_at(path) ? text_hint(value) : "";
}

}  // namespace lfdsim
