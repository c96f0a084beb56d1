#include "files/values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>

#include "files/nearest.h"

namespace lfdsim {
namespace {

std::string wrong_type(const toml::node& node, std::string_view wanted) {
    return fmt::format("is {}; give {}", kind_of(node), wanted);
}

}  // namespace

std::string_view kind_of(const toml::node& node) {
    // TOML's own words (floating_point, boolean) mean little to an optics designer
    switch (node.type()) {
        case toml::node_type::table:
            return "a table";
        case toml::node_type::array:
            return node.is_array_of_tables() ? "a list of tables" : "a list";
        case toml::node_type::string:
            return "a string";
        case toml::node_type::integer:
            return "an integer";
        case toml::node_type::floating_point:
            return "a number with a fraction";
        case toml::node_type::boolean:
            return "true or false";
        default:
            return "a date or time";
    }
}

std::string read_value(const toml::node& node, double& value) {
    if (!node.is_number()) return wrong_type(node, "a number");
    value = *node.value<double>();
    return {};
}

std::string read_value(const toml::node& node, std::int64_t& value) {
    // 3840.0 is refused too: a count with a fraction is probably a mistake
    if (!node.is_integer()) return wrong_type(node, "an integer");
    value = node.as_integer()->get();
    return {};
}

std::string read_value(const toml::node& node, std::string& value) {
    if (!node.is_string()) return wrong_type(node, "a string");
    value = node.as_string()->get();
    return {};
}

std::string read_value(const toml::node& node, std::vector<double>& values) {
    const toml::array* array = node.as_array();
    if (!array) return wrong_type(node, "a list of numbers");
    values.assign(array->size(), 0);
    for (std::size_t i = 0; i < values.size(); ++i)
        if (std::string fault = read_value((*array)[i], values[i]); !fault.empty()) return fmt::format("element {} {}", i, fault);
    return {};
}

std::string read_value(const toml::node& node, std::vector<std::string>& values) {
    const toml::array* array = node.as_array();
    if (!array) return wrong_type(node, "a list of strings");
    values.assign(array->size(), "");
    for (std::size_t i = 0; i < values.size(); ++i)
        if (std::string fault = read_value((*array)[i], values[i]); !fault.empty()) return fmt::format("element {} {}", i, fault);
    return {};
}

std::string read_value(const toml::node& node, Glass& glass) {
    constexpr const char* forms = "{ sellmeier = [B1, C1, B2, C2, B3, C3] }, { cauchy = [A, B, C] } or { nd = 1.4918, vd = 57.4 }";
    glass = {};
    if (node.is_string()) {
        glass.name = node.as_string()->get();
        return glass.name.empty() ? "is empty; give the name of a glass" : "";
    }
    const toml::table* table = node.as_table();
    if (!table) return wrong_type(node, fmt::format("the name of a glass, {}", forms));
    const auto has = [&](std::string_view key) { return table->contains(key); };
    for (const auto& [key, value] : *table)
        if (constexpr std::string_view keys[] = {"sellmeier", "cauchy", "nd", "vd"};
            std::find(std::begin(keys), std::end(keys), key.str()) == std::end(keys))
            return fmt::format("has the unknown key {}; give {}", shortened(key.str()), forms);
    if (int(has("sellmeier")) + int(has("cauchy")) + int(has("nd") || has("vd")) != 1)
        return fmt::format("{}; give {}", table->empty() ? "is an empty table" : "has more than one formula", forms);
    const auto read = [&](const char* key, auto& to) {
        const toml::node* value = table->get(key);
        const std::string fault = value ? read_value(*value, to) : "is missing";
        return fault.empty() ? fault : fmt::format("{} {}", key, fault);
    };
    const auto read_list = [&]<std::size_t n>(Formula formula, const char* key, std::array<double, n> numbers) {
        std::string fault = read(key, numbers);
        glass.formula = formula;
        glass.coefficients.assign(numbers.begin(), numbers.end());
        return fault;
    };
    if (has("sellmeier")) return read_list(Formula::sellmeier, "sellmeier", std::array<double, 6>());
    if (has("cauchy")) return read_list(Formula::cauchy, "cauchy", std::array<double, 3>());
    double nd = 0, vd = 0;
    std::string fault = read("nd", nd);
    if (fault.empty()) fault = read("vd", vd);
    glass.formula = Formula::nd_vd;
    glass.coefficients = {nd, vd};
    return fault;
}

std::string read_value(const toml::node& node, Pitch& value) {
    if (const toml::array* both = node.as_array(); both && both->size() == 2) {
        std::array<double, 2> two{};
        std::string fault = read_value(node, two);
        value = {two[0], two[1]};
        return fault;
    }
    if (!node.is_number()) return wrong_type(node, "a number, or a list of 2 numbers");
    value = *node.value<double>();
    return {};
}

std::string read_word(const toml::node& node, std::span<const std::string_view> words, std::size_t& index) {
    if (!node.is_string()) return wrong_type(node, fmt::format("one of \"{}\"", fmt::join(words, "\", \"")));
    const std::string& given = node.as_string()->get();
    for (index = 0; index < words.size(); ++index)
        if (words[index] == given) return {};
    const std::string_view meant = nearest(given, words);
    return fmt::format("is \"{}\", allowed are \"{}\"{}", shortened(given), fmt::join(words, "\", \""),
                       meant.empty() ? "" : fmt::format("; did you mean \"{}\"?", meant));
}

// The shortest decimal that reads back as the same bits. TOML has inf and nan; a whole number comes out as an integer, which
// is accepted for a number.
std::string toml_text(double value) { return fmt::format("{}", value); }
std::string toml_text(std::int64_t value) { return fmt::format("{}", value); }

std::string toml_text(const Pitch& value) {
    return value.is_one() ? toml_text(value[0]) : toml_text(static_cast<const std::array<double, 2>&>(value));
}

std::string toml_text(const std::vector<std::string>& values) {
    std::string text = "[";
    for (const std::string& value : values) text += (text.size() > 1 ? ", " : "") + toml_text(value);
    return text + "]";
}

std::string toml_text(const Glass& glass) {
    if (!glass.name.empty()) return toml_text(glass.name);
    const std::vector<double>& c = glass.coefficients;
    if (glass.formula == Formula::nd_vd) return fmt::format("{{ nd = {}, vd = {} }}", toml_text(c[0]), toml_text(c[1]));
    return fmt::format("{{ {} = {} }}", glass.formula == Formula::cauchy ? "cauchy" : "sellmeier", toml_text(c));
}

// A basic string. TOML allows any UTF-8 in it but quotes, backslashes and control characters.
std::string toml_text(const std::string& value) {
    std::string text = "\"";
    for (const char c : value) {
        if (c == '"' || c == '\\')
            text += '\\', text += c;
        else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            text += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
        else
            text += c;
    }
    return text + '"';
}

}  // namespace lfdsim
