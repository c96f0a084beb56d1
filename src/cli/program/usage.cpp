#include "cli/program/usage.h"

#include "files/description/nearest.h"
#include "files/description/shell.h"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <charconv>

namespace lfdsim::cli {
namespace {

bool is_setting(const std::string& text) {
    const std::size_t equals = text.find('=');
    return equals != text.npos && equals > 0 &&
           std::all_of(text.begin(), text.begin() + std::ptrdiff_t(equals),
                       [](unsigned char c) { return std::islower(c) || std::isdigit(c) || c == '_' || c == '.'; });
}

bool is_option(const std::string& text) {
    return text.size() > 1 && text[0] == '-' && !std::isdigit(static_cast<unsigned char>(text[1]));
}

// An option that may be repeated, and after whose value further words may be values, without the option's name before them.
struct Repeated {
    std::string_view option;
    bool (*takes)(const std::string&);  // whether a word is such a value
};
constexpr Repeated repeated[] = {
    {"--set", is_setting},
    {"--glass", [](const std::string& text) { return !is_option(text) && text.find('=') != text.npos; }},
    {"--catalogue", [](const std::string& text) { return text.ends_with(".agf") || text.ends_with(".AGF"); }},
};

std::string suggestion(const std::string& given, const std::vector<std::string>& known) {
    const std::vector<std::string_view> candidates(known.begin(), known.end());
    const std::string_view near = nearest(given, candidates);
    return near.empty() ? "" : fmt::format("; did you mean {}?", near);
}

std::string is_display(const std::string& word) {
    return word.ends_with(".toml") ? fmt::format("; a command comes before the display, as in lfdsim check {}", shell_file(word))
                                   : "";
}

// Returns the option that was probably meant. Dashes are left out of the comparison, as all options have them.
std::string option_suggestion(const std::string& given, const std::vector<std::string>& options) {
    std::vector<std::string> names;
    for (const std::string& name : options)
        if (name.starts_with("--")) names.push_back(name.substr(2));
    const std::size_t letters = given.find_first_not_of('-');
    if (letters == given.npos) return "";
    const std::string near = suggestion(given.substr(letters), names);
    const std::size_t name = near.rfind(' ') + 1;
    return near.empty() ? "" : near.substr(0, name) + "--" + near.substr(name);
}

// Returns what separates the numbers in a value that help calls "X,Y,Z" or "WxH".
char separator(const std::string& form) { return form == "WxH" || form == "CxR" ? 'x' : ','; }

// Returns CLI11's message, in other words where it is about the number of values.
std::string reworded(const Misuse& misuse) {
    if (!misuse.number_of_values) return misuse.says;
    const bool many = misuse.says.find("At Most") != misuse.says.npos;
    return misuse.says.substr(0, misuse.says.find(": ")) + (many ? " is given more than once" : " needs a value");
}

}  // namespace

std::vector<std::string> arguments(int argc, char** argv) {
    std::vector<std::string> all;
    const Repeated* open = nullptr;  // the option whose values the words are
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (open && all.back() != open->option) {
            if (open->takes(word))
                all.emplace_back(open->option);
            else
                open = nullptr;
        }
        if (const auto* named = std::ranges::find(repeated, word, &Repeated::option); named != std::end(repeated)) open = named;
        all.push_back(word);
    }
    if (!all.empty() && all.front() == "help")
        all = all.size() > 1 ? std::vector{all[1], std::string("--help")} : std::vector{std::string("--help")};
    std::reverse(all.begin(), all.end());
    return all;
}

std::vector<std::string> spaced_numbers(const std::string& form, std::span<const std::string> after) {
    const char between = separator(form);
    const std::string last = form.substr(form.rfind('|') + 1);  // "B|BX,BY"
    const auto most = std::size_t(1 + std::count(last.begin(), last.end(), between));
    std::vector<std::string> numbers;
    if (form.find(' ') != form.npos || most < 2) return {};
    for (const std::string& word : after) {
        const std::size_t begin = word.starts_with(between), end = word.size() - (word.size() > begin && word.ends_with(between));
        if (begin == end && !numbers.empty()) continue;
        double value;
        const auto [stop, error] = std::from_chars(word.data() + begin, word.data() + end, value);
        if (numbers.size() == most || begin == end || error != std::errc{} || stop != word.data() + end) break;
        numbers.push_back(word.substr(begin, end - begin));
    }
    return numbers.size() > 1 ? numbers : std::vector<std::string>();
}

InputError spaced_error(const std::string& option, const std::string& form, const std::vector<std::string>& numbers) {
    const std::string between(1, separator(form));
    const bool comma = between == ",";
    const std::string wanted = form.substr(form.rfind('|') + 1);
    const bool complete = numbers.size() == std::size_t(1 + std::count(wanted.begin(), wanted.end(), between[0]));
    return {option,
            fmt::format("the numbers of its value, {}, are separated by {} without spaces: {} {}", wanted,
                        comma ? "commas" : "an x", option, complete ? fmt::to_string(fmt::join(numbers, between)) : wanted)};
}

InputError setting_error(const std::string& option, const std::string& key) {
    return {fmt::format("{} {}", option, key), fmt::format("a key and its value are one word: {} {}=VALUE", option, key)};
}

// CLI11 stops at the first rule that is broken, often "something is required" where a name was mistyped. What it could not place
// says more, so that comes first.
InputError usage_error(const Misuse& misuse) {
    const bool chosen = !misuse.command.empty();
    std::vector<Problem> unknown, superfluous;
    for (const std::string& word : misuse.unplaced) {
        const std::string name = word.substr(0, word.find('='));
        if (!chosen && !superfluous.empty()) break;  // the words after an unknown command belong to it
        if (word == "--") continue;                  // CLI11 counts it among the words that it could not place
        if (is_option(word) && std::find(misuse.options.begin(), misuse.options.end(), name) != misuse.options.end())
            unknown.push_back({name, "is in the wrong place; options come after the command and before any --"});
        else if (is_option(word))
            unknown.push_back({name, "unknown option" + option_suggestion(name, misuse.options)});
        else
            superfluous.push_back({word, "one argument too many"});
    }
    std::vector<Problem> problems = unknown;
    if (!chosen && (problems.empty() || !superfluous.empty())) {
        if (superfluous.empty())
            problems.push_back({"", fmt::format("a command is missing; commands are {}", fmt::join(misuse.commands, ", "))});
        else
            problems.push_back(
                {superfluous.front().where,
                 fmt::format("unknown command{}{}; commands are {}", is_display(superfluous.front().where),
                             suggestion(superfluous.front().where, misuse.commands), fmt::join(misuse.commands, ", "))});
    }
    // Values of unknown options are left over, too, so superfluous words are reported only where no unknown option explains them.
    if (problems.empty()) problems = superfluous;
    if (problems.empty()) problems.push_back({"", reworded(misuse)});
    problems.back().what += fmt::format(" (help: lfdsim{}{} --help)", chosen ? " " : "", misuse.command);
    return InputError(std::move(problems));
}

}  // namespace lfdsim::cli
