#include "cli/options/variants.h"

#include "base/input_error.h"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <string_view>

namespace lfdsim::cli {

std::vector<Variant> variants_of(const std::string& text) {
    const std::string wanted = text == "pickup" ? "content.pickup=nodal,traced,inverse" : text;
    const std::size_t equals = std::min(wanted.find('='), wanted.size());
    const std::string key = wanted.substr(0, equals);
    std::vector<std::string> values{""};
    int depth = 0;   // of brackets and braces
    char quote = 0;  // the quote that is open; 0: none
    for (const char c : std::string_view(wanted).substr(std::min(equals + 1, wanted.size()))) {
        if (quote == 0 && depth == 0 && c == ',') {
            values.emplace_back();
            continue;
        }
        if (quote != 0)
            quote = c == quote ? char(0) : quote;
        else if (c == '"' || c == '\'')
            quote = c;
        else
            depth += int(c == '[' || c == '{') - int(c == ']' || c == '}');
        values.back() += c;
    }
    constexpr std::size_t most = 16;
    if (key.empty() || values.size() < 2 || values.size() > most || std::count(values.begin(), values.end(), "") > 0)
        throw InputError(
            "--compare",
            fmt::format("is {}; give pickup, or KEY=VALUE,VALUE with 2 to {} values of a key of the description, such as "
                        "array.gap_mm=3.2,3.3",
                        text, most));
    std::vector<Variant> all;
    for (std::string& value : values) {
        const bool word = std::all_of(value.begin(), value.end(), [](unsigned char c) { return std::isalpha(c) || c == '_'; });
        const bool bare = word && value != "none" && value != "true" && value != "false" && value != "inf" && value != "nan";
        all.push_back({bare ? fmt::format("{}=\"{}\"", key, value) : fmt::format("{}={}", key, value),
                       fmt::format("{}-{}", key.substr(key.rfind('.') + 1), value)});
    }
    return all;
}

}  // namespace lfdsim::cli
