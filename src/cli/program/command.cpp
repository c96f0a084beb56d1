#include "cli/program/command.h"

#include "cli/program/usage.h"

#include <CLI/CLI.hpp>
#include <algorithm>

namespace lfdsim::cli {
namespace {

Misuse misuse(const CLI::App& program, const CLI::ParseError& error) {
    const std::vector<CLI::App*> chosen = program.get_subcommands();
    const CLI::App& command = chosen.empty() ? program : *chosen.front();
    Misuse all{error.what(), dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr, program.remaining(true)};
    if (!chosen.empty()) all.command = command.get_name();
    for (const CLI::App* each : program.get_subcommands([](const CLI::App*) { return true; }))
        all.commands.push_back(each->get_name());
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) all.options.push_back("--" + name);
        for (const std::string& name : option->get_snames()) all.options.push_back("-" + name);
    }
    return all;
}

// "--camera-mm 40 0 599", which CLI11 would take for a value and two more files. `words`: last one first.
void refuse_spaces(const CLI::App& program, std::vector<std::string> words) {
    std::reverse(words.begin(), words.end());
    const auto commands = [&](const std::string& word) {
        return program.get_subcommands([&](const CLI::App* each) { return each->get_name() == word; });
    };
    const auto name = std::find_if(words.begin(), words.end(), [&](const std::string& word) { return !commands(word).empty(); });
    if (name == words.end()) return;
    const CLI::App& command = *commands(*name).front();
    for (auto word = name + 1; word != words.end() && *word != "--"; ++word) {
        const CLI::Option* option = word->starts_with("--") ? command.get_option_no_throw(*word) : nullptr;
        if (!option || option->get_expected_max() > 1) continue;
        const std::string form = option->get_type_name();
        if (const auto numbers = spaced_numbers(form, {word + 1, words.end()}); !numbers.empty())
            throw spaced_error(*word, form, numbers);
    }
}

}  // namespace

Option Option::type_name(const std::string& text) { return Option(option_->type_name(text)); }
Option Option::required() { return Option(option_->required()); }
Option Option::expected(int least, int most) { return Option(option_->expected(least, most)); }
Option Option::allow_extra_args(bool allowed) { return Option(option_->allow_extra_args(allowed)); }
Option Option::capture_default_str() { return Option(option_->capture_default_str()); }
std::size_t Option::count() const { return option_->count(); }
const std::vector<std::string>& Option::results() const { return option_->results(); }

Command Command::add_subcommand(const std::string& name, const std::string& description) {
    return Command(app_->add_subcommand(name, description));
}
Option Command::add_option(const std::string& names, const std::string& description) {
    return Option(app_->add_option(names, description));
}
Option Command::add_option(const std::string& names, std::string& variable, const std::string& description) {
    return Option(app_->add_option(names, variable, description));
}
Option Command::add_option(const std::string& names, std::vector<std::string>& variable, const std::string& description) {
    return Option(app_->add_option(names, variable, description));
}
Option Command::add_flag(const std::string& names, bool& variable, const std::string& description) {
    return Option(app_->add_flag(names, variable, description));
}
void Command::take_all_words() { app_->prefix_command()->set_help_flag(); }
std::vector<std::string> Command::words() const { return app_->remaining(); }
std::string Command::name() const { return app_->get_name(); }
bool Command::knows(const std::string& option) const { return app_->get_option_no_throw(option) != nullptr; }
bool Command::given(const std::string& option) const { return knows(option) && app_->count(option) > 0; }
std::vector<std::string> Command::values(const std::string& option) const {
    return given(option) ? app_->get_option(option)->results() : std::vector<std::string>();
}
void Command::footer(const std::string& text) { app_->footer(text); }
void Command::callback(std::function<void()> function) { app_->callback(std::move(function)); }

CommandLine::CommandLine(const std::string& description, const std::string& name, const std::string& version,
                         const std::string& footer)
    : app_(std::make_unique<CLI::App>(description, name)) {
    app_->set_version_flag("--version", version);
    app_->require_subcommand(1);
    app_->get_formatter()->column_width(34);
    app_->footer(footer);
}

CommandLine::~CommandLine() = default;

Command CommandLine::program() const { return Command(app_.get()); }

std::string CommandLine::parse(std::vector<std::string> arguments) {
    refuse_spaces(*app_, arguments);
    try {
        app_->parse(std::move(arguments));
    } catch (const CLI::CallForHelp&) {
        return app_->help();
    } catch (const CLI::CallForVersion& version) {
        return std::string(version.what()) + "\n";
    } catch (const CLI::ParseError& error) {
        throw usage_error(misuse(*app_, error));
    }
    return {};
}

}  // namespace lfdsim::cli
