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

std::vector<std::string> option_names(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
        for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    }
    return names;
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
    std::reverse(all.begin(), all.end());
    return all;
}

InputError usage_error(const CLI::App& program, const CLI::ParseError& error) {
    const std::vector<CLI::App*> chosen = program.get_subcommands();
    const CLI::App& command = chosen.empty() ? program : *chosen.front();
    const std::vector<std::string> left = program.remaining(true);
    std::vector<Problem> problems;
    if (chosen.empty() && !left.empty() && !is_option(left.front())) {
        std::vector<std::string> names;
        for (const CLI::App* c : program.get_subcommands([](const CLI::App*) { return true; })) names.push_back(c->get_name());
        problems.push_back({left.front(), fmt::format("unknown command{}; there are {}", suggestion(left.front(), names),
                                                      fmt::join(names, ", "))});
    } else {
        for (const std::string& word : left) {
            const std::string name = word.substr(0, word.find('='));
            if (is_option(word)) problems.push_back({name, "unknown option" + suggestion(name, option_names(command))});
        }
        // Values of unknown options are left over too, so words are told only where no unknown option explains them.
        if (problems.empty())
            for (const std::string& word : left) problems.push_back({word, "one argument too many"});
    }
    if (problems.empty()) problems.push_back({"", error.what()});
    const std::string name = chosen.empty() ? "lfdsim" : "lfdsim " + command.get_name();
    problems.back().what += fmt::format(" (all options: {} --help)", name);
    return InputError(std::move(problems));
}

}  // namespace lfdsim::cli
