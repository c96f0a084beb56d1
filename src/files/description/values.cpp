#include "files/description/values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>

#include "base/counted.h"
#include "base/printable.h"
#include "files/description/nearest.h"

namespace lfdsim {
namespace {

std::string wrong_type(const toml::node& node, std::string_view wanted) {
    return fmt::format("is {}; give {}", kind_of(node), wanted);
}

template <class T>
std::string read_list(const toml::node& node, std::vector<T>& values, std::string_view wanted) {
    const toml::array* array = node.as_array();
    if (!array) return wrong_type(node, wanted);
    values.assign(array->size(), T{});
    for (std::size_t i = 0; i < values.size(); ++i)
        if (std::string fault = read_value((*array)[i], values[i]); !fault.empty()) return fmt::format("element {} {}", i, fault);
    return {};
}

/// A formula of a glass, and the numbers that it takes, in words. nd and vd are two keys and no row here.
struct GlassForm {
    Formula formula;
    std::string_view wanted;
    std::string_view key() const { return key_of(formula); }
};
constexpr std::size_t most_coefficients = 64, longest_name = 64;
constexpr GlassForm glass_forms[] = {
    {Formula::sellmeier, "pairs B, C, as a list of 6 numbers"},
    {Formula::cauchy, "a list of 3 numbers"},
    {Formula::conrady, "a list of 3 numbers"},
    {Formula::herzberger, "a list of 6 numbers"},
    {Formula::resonances, "a number and pairs B, C, as a list of 5 numbers"},
    {Formula::sellmeier_2, "a list of 5 numbers"},
    {Formula::handbook_1, "a list of 4 numbers"},
    {Formula::handbook_2, "a list of 4 numbers"},
    {Formula::power_series, "pairs of a coefficient and a power, as a list of 12 numbers"},
};

}  // namespace

std::string_view kind_of(const toml::node& node) {
    // TOML's words (floating_point, boolean) mean little to an optics designer.
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

std::string read_value(const toml::node& node, std::vector<double>& values) { return read_list(node, values, "a list of numbers"); }
std::string read_value(const toml::node& node, std::vector<std::string>& values) {
    return read_list(node, values, "a list of strings");
}
std::string read_value(const toml::node& node, std::vector<Vec3d>& points) {
    return read_list(node, points, "a list of points, [[x, y, z], [x, y, z]]");
}

std::string read_value(const toml::node& node, Glass& glass) {
    constexpr const char* forms =
        "{ sellmeier = [B1, C1, B2, C2, B3, C3] }, { cauchy = [A, B, C] }, { nd = 1.4918, vd = 57.4 } or another formula of "
        "docs/format.md";
    // A name alone is looked up later, when all catalogues are known.
    glass = {};
    if (node.is_string()) {
        glass.name = node.as_string()->get();
        return glass.name.empty() ? "is empty; give the name of a glass" : "";
    }
    const toml::table* table = node.as_table();
    if (!table) return wrong_type(node, fmt::format("the name of a glass, {}", forms));
    const auto read = [&](const char* key, auto& to) {
        const toml::node* value = table->get(key);
        const std::string fault = value ? read_value(*value, to) : "is missing";
        return fault.empty() ? fault : fmt::format("{} {}", key, fault);
    };
    // The keys: exactly one formula, and a name and a range at most.
    const auto has = [&](std::string_view key) { return table->contains(key); };
    std::size_t formulas = has("nd") || has("vd");
    for (const auto& entry : *table) {
        const std::string_view key = entry.first.str();
        const auto of_key = [&](const GlassForm& form) { return form.key() == key; };
        formulas += std::ranges::any_of(glass_forms, of_key);
        if (std::ranges::none_of(std::array{"nd", "vd", "name", "range_nm"}, [&](auto* k) { return key == k; }) &&
            std::ranges::none_of(glass_forms, of_key))
            return fmt::format("has the unknown key {}; give {}", shortened(key), forms);
    }
    if (formulas != 1)
        return fmt::format("{}; give {}",
                           table->empty()  ? "is an empty table"
                           : formulas == 0 ? "has no formula"
                                           : "has more than one formula",
                           forms);
    // Name and range.
    std::string fault;
    if (has("name") && (fault = read("name", glass.name)).empty() && glass.name.size() > longest_name)
        fault = fmt::format("name has {} bytes, allowed are {}", glass.name.size(), longest_name);
    if (fault.empty() && has("range_nm") && (fault = read("range_nm", glass.range_nm)).empty() &&
        !(0 < glass.range_nm[0] && glass.range_nm[0] < glass.range_nm[1]))
        fault = "range_nm is not two wavelengths, the shorter first";
    if (!fault.empty()) return fault;
    // The formula's coefficients.
    if (has("nd") || has("vd")) {
        glass.formula = Formula::nd_vd;
        glass.coefficients.assign(2, 0);
        fault = read("nd", glass.coefficients[0]);
        return fault.empty() ? read("vd", glass.coefficients[1]) : fault;
    }
    const GlassForm& form = *std::ranges::find_if(glass_forms, [&](const GlassForm& f) { return has(f.key()); });
    glass.formula = form.formula;
    fault = read(form.key().data(), glass.coefficients);
    const std::size_t count = glass.coefficients.size();
    if (fault.empty() && (!takes(form.formula, count) || count > most_coefficients))
        fault = fmt::format("{} has {}; give {}", form.key(), counted(count, "element"), form.wanted);
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

// A number is written as the shortest decimal that reads back as the same bits. TOML has inf and nan; a whole number becomes an
// integer, which is accepted for a number.
std::string toml_text(double value) { return fmt::format("{}", value); }
std::string toml_text(std::int64_t value) { return fmt::format("{}", value); }

std::string toml_text(const Pitch& value) {
    return value.is_one() ? toml_text(value[0]) : toml_text(static_cast<const std::array<double, 2>&>(value));
}

// A glass that ships, and one that has not been looked up, are written by name; others by their coefficients, so that the text can
// be read without the catalogue.
std::string toml_text(const Glass& glass) {
    const ShippedGlass* shipped = shipped_glass(glass.name);
    if (glass.formula == Formula::unknown || (shipped && shipped->glass == glass)) return toml_text(glass.name);
    const std::vector<double>& c = glass.coefficients;
    std::string text = glass.name.empty() ? "{ " : fmt::format("{{ name = {}, ", toml_text(glass.name));
    if (glass.formula == Formula::nd_vd) {
        text += fmt::format("nd = {}, vd = {}", toml_text(c[0]), toml_text(c[1]));
    } else {
        text += fmt::format("{} = {}", key_of(glass.formula), toml_text(c));
    }
    if (glass.range_nm != Glass().range_nm) text += fmt::format(", range_nm = {}", toml_text(glass.range_nm));
    return text + " }";
}

// The text is a basic string of TOML, in which any UTF-8 is allowed except quotes, backslashes and control characters.
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
