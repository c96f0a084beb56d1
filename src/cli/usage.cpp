#include "cli/usage.h"

#include "files/nearest.h"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>

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

std::string suggestion(const std::string& given, const std::vector<std::string>& known) {
    const std::vector<std::string_view> candidates(known.begin(), known.end());
    const std::string_view near = nearest(given, candidates);
    return near.empty() ? "" : fmt::format("; did you mean {}?", near);
}

// Dashes are left out of the comparison, as all options have them.
std::string option_suggestion(const std::string& given, const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back(name);
    const std::size_t letters = given.find_first_not_of('-');
    if (letters == given.npos) return "";
    const std::string near = suggestion(given.substr(letters), names);
    const std::size_t name = near.rfind(' ') + 1;
    return near.empty() ? "" : near.substr(0, name) + "--" + near.substr(name);
}

std::vector<std::string> command_names(const CLI::App& program) {
    std::vector<std::string> names;
    for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    return names;
}

// CLI11's own words, where they can be understood.
std::string reworded(const CLI::ParseError& error) {
    const std::string text = error.what();
    if (!dynamic_cast<const CLI::ArgumentMismatch*>(&error)) return text;
    const bool many = text.find("At Most") != text.npos;
    return text.substr(0, text.find(": ")) + (many ? " is given more than once" : " needs a value");
}

}  // namespace

std::vector<std::string> arguments(int argc, char** argv) {
    std::vector<std::string> all;
    bool setting = false;  // the words after --set, as long as they look like key=value
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (setting && all.back() != "--set") {
            setting = is_setting(word);
            if (setting) all.push_back("--set");
        }
        setting |= word == "--set";
        all.push_back(word);
    }
    if (!all.empty() && all.front() == "help")
        all = all.size() > 1 ? std::vector{all[1], std::string("--help")} : std::vector{std::string("--help")};
    std::reverse(all.begin(), all.end());
    return all;
}

// CLI11 stops at the first rule that is broken, often "something is required" where a name was mistyped. What it could not place
// says more, so that comes first.
InputError usage_error(const CLI::App& program, const CLI::ParseError& error) {
    const std::vector<CLI::App*> chosen = program.get_subcommands();
    const CLI::App& command = chosen.empty() ? program : *chosen.front();
    std::vector<Problem> unknown, superfluous;
    for (const std::string& word : program.remaining(true)) {
        const std::string name = word.substr(0, word.find('='));
        if (word == "--") continue;  // takes no place itself; CLI11 keeps it with what it could not place
        if (is_option(word) && command.get_option_no_throw(name))
            unknown.push_back({name, "is in the wrong place; options come after the command and before any --"});
        else if (is_option(word))
            unknown.push_back({name, "unknown option" + option_suggestion(name, command)});
        else
            superfluous.push_back({word, "one argument too many"});
    }
    std::vector<Problem> problems = unknown;
    if (problems.empty() && chosen.empty()) {
        const std::vector<std::string> names = command_names(program);
        if (superfluous.empty())
            problems.push_back({"", fmt::format("a command is missing; there are {}", fmt::join(names, ", "))});
        else
            problems.push_back(
                {superfluous.front().where, fmt::format("unknown command{}; there are {}",
                                                        suggestion(superfluous.front().where, names), fmt::join(names, ", "))});
    }
    // Values of unknown options are left over too, so superfluous words are told only where no unknown option explains them.
    if (problems.empty()) problems = superfluous;
    if (problems.empty()) problems.push_back({"", reworded(error)});
    problems.back().what +=
        fmt::format(" (help: lfdsim{}{} --help)", chosen.empty() ? "" : " ", chosen.empty() ? "" : command.get_name());
    return InputError(std::move(problems));
}

}  // namespace lfdsim::cli
