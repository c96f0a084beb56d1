#include "files/lenses/lens_json.h"

#include <limits>

#include "base/printable.h"
#include "files/description/json_text.h"
#include "files/description/nearest.h"

namespace lfdsim {
namespace {

// Python's words, each with a JSON text of the same length, so that the parser's places in messages stay right.
constexpr std::pair<std::string_view, std::string_view> bare_words[] = {
    {"-Infinity", "\"-Infin.\""}, {"Infinity", "\"Infin.\""}, {"NaN", "\"N\""}};

// Replaces Python's words outside of strings.
std::string without_bare_words(std::string text) {
    bool inside = false;  // a string
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (inside && text[i] == '\\')
            ++i;
        else if (text[i] == '"')
            inside = !inside;
        else if (!inside)
            for (const auto& [word, replacement] : bare_words)
                if (text.compare(i, word.size(), word) == 0) {
                    text.replace(i, word.size(), replacement);
                    i += word.size() - 1;
                    break;
                }
    }
    return text;
}

}  // namespace

LensJson parse_lens_json(std::string_view text, std::string_view name) {
    return parse_json<LensJson>(without_bare_words(std::string(text)), name, "is not JSON");
}

const LensJson& member(const LensJson& json, std::string_view key) {
    static const LensJson nothing;
    if (!json.is_object()) return nothing;
    const auto found = json.find(key);
    return found == json.end() ? nothing : *found;
}

bool is_true(const LensJson& json) { return json.is_boolean() && json.get<bool>(); }

std::string word_of(const LensJson& json) {
    return shortened(json.is_string() ? json.get<std::string>() : json.is_structured() ? json.type_name() : json.dump());
}

double JsonReader::number(const LensJson& json, const std::string& place, bool may_be_infinite) {
    if (json.is_number()) return json.get<double>();  // the parser refuses infinite ones
    if (may_be_infinite && json == "Infin.") return std::numeric_limits<double>::infinity();
    if (may_be_infinite && json == "-Infin.") return -std::numeric_limits<double>::infinity();
    if (json.is_null())
        refuse(place, "is missing");
    else if (json == "N" || json == "Infin." || json == "-Infin.")
        refuse(place, "is {}; give a finite number", json == "N" ? "NaN" : "infinite");
    else
        refuse(place, "is {}; give a number", kind_of_json(json));
    return 0;
}

const LensJson& JsonReader::list(const LensJson& json, const std::string& place, std::size_t least) const {
    constexpr std::size_t most = 1000;
    if (json.is_array() && json.size() >= least && json.size() <= most) return json;
    throw InputError(name, fmt::format("{} is not a list of {} to {}: is this a saved lens?", place, least, most));
}

DrawnLens LensJsonReader::done() {
    report();
    return std::move(lens);
}

}  // namespace lfdsim
