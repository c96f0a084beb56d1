// Conversion of a TOML value to a field of a display, and vice versa. Floor 2.
#pragma once
#include "base/counted.h"
#include "display/keys.h"

#include <optional>
#include <string>

#include <toml++/toml.h>

namespace lfdsim {

/// Returns what a value is, in words: "a string", "an integer".
std::string_view kind_of(const toml::node&);

// Each read_value() stores a value of the right type and returns an empty string, or else a text, what was given and what to give,
// that continues a sentence about the key: "is a string; give a number". Ranges are checked by validate(). Integers are accepted
// for real numbers, real numbers never for integers.
std::string read_value(const toml::node&, double&);
std::string read_value(const toml::node&, std::int64_t&);
std::string read_value(const toml::node&, std::string&);
std::string read_value(const toml::node&, std::vector<double>&);
std::string read_value(const toml::node&, std::vector<std::string>&);
std::string read_value(const toml::node&, std::vector<Vec3d>&);
std::string read_value(const toml::node&, Glass&);  // a name is not looked up
std::string read_value(const toml::node&, Pitch&);
/// Reads one of the words and stores its index; returns a text as read_value() does.
std::string read_word(const toml::node&, std::span<const std::string_view> words, std::size_t& index);

template <class E>
requires has_words<E> std::string read_value(const toml::node& node, E& value) {
    std::size_t index = 0;
    std::string fault = read_word(node, words<E>(), index);
    if (fault.empty()) set_word(value, index);
    return fault;
}

template <class T, std::size_t n>
std::string read_value(const toml::node& node, std::array<T, n>& values) {
    const toml::array* array = node.as_array();
    const std::string wanted = "a list of " + std::to_string(n) + (std::is_integral_v<T> ? " integers" : " numbers");
    if (!array) return "is " + std::string(kind_of(node)) + "; give " + wanted;
    if (array->size() != n) return "has " + counted(array->size(), "element") + "; give " + wanted;
    for (std::size_t i = 0; i < n; ++i)
        if (std::string fault = read_value((*array)[i], values[i]); !fault.empty())
            return "element " + std::to_string(i) + " " + fault;
    return {};
}

template <class T>
std::string read_value(const toml::node& node, std::optional<T>& value) {
    return read_value(node, value.emplace());
}

// Each toml_text() returns a field in TOML syntax that reads back as the same bits; empty for an absent optional.
std::string toml_text(double);
std::string toml_text(std::int64_t);
std::string toml_text(const std::string&);
std::string toml_text(const Pitch&);
std::string toml_text(const Glass&);

template <class E>
requires has_words<E> std::string toml_text(const E& value) { return toml_text(std::string(word(value))); }
template <class List>
requires requires { typename List::value_type; }
std::string toml_text(const List& values) {
    std::string text = "[";
    for (const auto& value : values) text += (text.size() > 1 ? ", " : "") + toml_text(value);
    return text + "]";
}
template <class T>
std::string toml_text(const std::optional<T>& value) {
    return value ? toml_text(*value) : std::string();
}

}  // namespace lfdsim
