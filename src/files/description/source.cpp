#include "files/description/source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>

#include "base/printable.h"
#include "base/problems.h"
#include "base/text.h"
#include "base/whole_text.h"
#include "display/keys.h"
#include "files/description/override_hint.h"
#include "files/description/text_file.h"
#include "files/description/values.h"

namespace lfdsim {
namespace {

// Returns the index that a part of a path means in a list; none beyond its end, as an override changes elements and adds none.
std::optional<std::size_t> element(std::string_view part, const toml::array& array) {
    const std::optional<std::size_t> index = whole_text<std::size_t>(part);
    return index && *index < array.size() ? index : std::nullopt;
}

InputError no_element(std::string_view part) {
    return {"", fmt::format("there is no element {} to change; elements are counted from 0, and new ones are added by giving the "
                            "whole list, key=[...]",
                            part)};
}

// Returns the child of a table or list that a part of a path names; null if there is none.
template <class Node>  // toml::node or const toml::node
Node* child(Node& node, std::string_view part) {
    if (auto* table = node.as_table()) return table->get(part);
    if (auto* array = node.as_array())
        if (const auto index = element(part, *array)) return array->get(*index);
    return nullptr;
}

// Returns the value of an override as a separate tree, under the key "value". Throws toml::parse_error, or InputError for more than
// one value.
toml::table parse_value(std::string_view path, std::string_view value) {
    // Unquoted words save the user a second pair of quotes against the shell. The parser checks that they are UTF-8.
    // What is not a key, or is a table, is refused by its name, whatever its value is.
    const bool refused = !key_at(path) && !value.empty() && std::isalpha(static_cast<unsigned char>(value[0]));
    const bool word = takes_word(path) || (takes_glass(path) && !value.starts_with('{')) || refused;
    if (word && !value.starts_with('"') && !value.starts_with('\'')) return toml::parse("value = " + toml_text(std::string(value)));
    const std::string text = fmt::format("value = {}", value);
    check_text(text, "");  // nesting, as in a file
    toml::table holder = toml::parse(text);
    if (holder.size() != 1 || value.find('\n') != value.npos) throw InputError("", "is more than one value");
    return holder;
}

// Returns what to write in place of the value of a line that the parser refused, where that is known; else `says`, the parser's
// message. The lines before it are scanned for the last header, since the hint depends on the key's table.
std::string hint_in(std::string_view text, std::size_t line, std::string_view says) {
    std::string table;
    for (std::size_t n = 1; n <= line && !text.empty(); ++n) {
        std::string_view one = next_line(text);
        one = one.substr(0, one.find('\r'));
        one.remove_prefix(std::min(one.find_first_not_of(" \t"), one.size()));
        const std::size_t brackets = one.find_first_not_of('[');
        if (one.starts_with('[') && brackets <= 2)  // the keys of all elements of a list are those of the first
            table = std::string(one.substr(brackets, one.find(']') - brackets)) + (brackets == 2 ? ".0." : ".");
        const std::size_t equals = one.find('=');
        if (n < line) continue;
        if (equals == one.npos) {
            const std::string_view word = one.substr(0, one.find_first_of(" \t:"));
            return key_at(table + std::string(word)) ? fmt::format("\"{}\" is not of the form KEY = VALUE", shortened(one))
                                                     : std::string(says);
        }
        std::string_view value = one.substr(equals + 1);
        if (value.find_first_of("\"'") == value.npos) value = value.substr(0, value.find('#'));
        const std::string_view key = trimmed(one.substr(0, equals), " \t");
        if (const std::string hint = override_hint(table + std::string(key), value); !hint.empty())
            return fmt::format("{}: {}", key, hint);
    }
    return std::string(says);
}

// Whether "none" is one of the words that the key at a path accepts ("panel.subpixels").
bool takes_none(std::string_view path) {
    const FormatTable::Value* found = key_at(path);
    return found && std::visit(
                        []<class V>(const V*) {
                            if constexpr (has_words<V>) return std::ranges::count(words<V>(), "none") > 0;
                            return false;
                        },
                        found->fresh);
}

}  // namespace

bool takes_glass(std::string_view path) {
    const FormatTable::Value* found = key_at(path);
    return found && std::holds_alternative<const std::optional<Glass>*>(found->fresh);
}

bool takes_word(std::string_view path) {
    const FormatTable::Value* found = key_at(path);
    return found && std::visit([]<class V>(const V*) { return has_words<V> || std::is_same_v<V, std::string>; }, found->fresh);
}

Source::Source(std::string_view text, std::string_view name, const std::vector<std::string>& overrides) : name_(name) {
    try {
        root_ = toml::parse(text, name);
    } catch (const toml::parse_error& error) {
        throw InputError(at(error.source()).text, hint_in(text, error.source().begin.line, error.description()));
    }
    Problems problems;
    for (const std::string& text_of_one : overrides) {
        try {
            apply(text_of_one);
        } catch (const toml::parse_error& error) {
            const std::size_t equals = text_of_one.find('=');  // there is one: a value was parsed
            const std::string hint = override_hint(text_of_one.substr(0, equals), text_of_one.substr(equals + 1));
            problems.add("--set " + text_of_one, "the value is not TOML: {}", hint.empty() ? error.description() : hint);
        } catch (const InputError& error) {
            problems.add({"--set " + text_of_one, error.problems.front().what});
        }
    }
    problems.report();
}

void Source::apply(const std::string& override_text) {
    const std::size_t equals = override_text.find('=');
    const std::string_view path = std::string_view(override_text).substr(0, equals);
    if (equals == std::string::npos || path.empty()) throw InputError("", "is not of the form key=value, such as array.pitch_mm=8");
    const std::string_view value = std::string_view(override_text).substr(equals + 1);
    // No key has a dot in its name, nor is any a number: in a table that means an element of a list that does not exist.
    const std::vector<std::string_view> parts = split(path, '.');
    if (parts.size() > 4) throw InputError("", fmt::format("the key has {} parts, allowed are 4", parts.size()));

    // Down to the table or list that has the key. Missing tables on the way are created; values are not replaced by tables.
    toml::node* node = &root_;
    const bool removes = value == "none" && !takes_none(path);
    for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
        toml::node* next = child(*node, parts[i]);
        if (!next && removes) {
            set_[std::string(path)] = override_text;
            return;
        }
        if (!next && node->is_table() && !is_digits(parts[i]))
            next = &node->as_table()->insert(parts[i], toml::table{}).first->second;
        if (!next) throw no_element(parts[i]);
        if (!next->is_table() && !next->is_array()) throw InputError("", fmt::format("{} is a value, and has no parts", parts[i]));
        node = next;
    }
    if (removes) {
        if (toml::table* table = node->as_table())
            table->erase(parts.back());
        else
            throw InputError("", "an element of a list cannot be removed");
        set_[std::string(path)] = override_text;
        return;
    }
    // The new value takes the place of the old one.
    toml::table holder = parse_value(path, value);
    holder.get("value")->visit([&](auto& given) {
        if (toml::table* table = node->as_table(); table && !is_digits(parts.back()))
            table->insert_or_assign(parts.back(), std::move(given));
        else if (const auto index = table ? std::nullopt : element(parts.back(), *node->as_array()))
            node->as_array()->replace(node->as_array()->cbegin() + std::ptrdiff_t(*index), std::move(given));
        else
            throw no_element(parts.back());
    });
    set_[std::string(path)] = override_text;
}

SourcePosition Source::at(const toml::source_region& region) const {
    return {fmt::format("{}:{}:{}", name_, region.begin.line, region.begin.column), region.begin.line, region.begin.column};
}

SourcePosition Source::place(std::string_view path) const {
    // Down the path as far as it exists. An override of any part of it has set everything below, too.
    const toml::node* node = &root_;
    std::string inside;
    for (const std::string_view part : split(path, '.')) {
        const toml::node* next = child(*node, part);
        if (!next) break;
        inside += inside.empty() ? "" : ".";
        inside += part;
        if (const auto set = set_.find(inside); set != set_.end()) return {"--set " + set->second};
        node = next;
    }
    if (node->source().begin.line) return at(node->source());
    // A table that is not in the file was created by an override of something in it.
    for (const auto& [key, text] : set_)
        if (key.starts_with(inside + ".")) return {"--set " + text};
    return {name_};
}

SourcePosition Source::place(const toml::key& key, std::string_view path) const {
    // Keys within a table that an override gave have places in the override's text, not in the file.
    for (std::size_t dot = path.find('.');; dot = path.find('.', dot + 1)) {
        if (is_set(path.substr(0, dot))) return place(path);
        if (dot == path.npos) return key.source().begin.line ? at(key.source()) : place(path);
    }
}

}  // namespace lfdsim
