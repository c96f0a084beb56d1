#include "cli/program/command.h"

#include "cli/program/usage.h"

#include <CLI/CLI.hpp>
#include <algorithm>

namespace lfdsim::cli {
namespace {

// Collects what usage_error() needs about a command line that CLI11 refused.
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

std::string is_empty(const std::string& form) { return "is empty; give " + (form.empty() ? "a name" : form); }

// The name of the rule that refuses an empty text, such as that of a shell's variable without a value.
constexpr const char* not_empty = "not empty";

void refuse_empty(CLI::Option* option) {
    const std::string words = is_empty(option->get_type_name());
    option->check([words](const std::string& text) { return text.empty() ? words : std::string(); }, "", not_empty);
}

// Refuses "--model=" and "--camera-mm 40 0 599" and "--set array.pitch_mm 8", which CLI11 would take for a value and more files.
// `words` are in reverse order.
void refuse_spaces(const CLI::App& program, std::vector<std::string> words) {
    std::reverse(words.begin(), words.end());
    const auto commands = [&](const std::string& word) {
        return program.get_subcommands([&](const CLI::App* each) { return each->get_name() == word; });
    };
    const auto name = std::find_if(words.begin(), words.end(), [&](const std::string& word) { return !commands(word).empty(); });
    if (name == words.end()) return;
    const CLI::App& command = *commands(*name).front();
    for (auto word = name + 1; word != words.end() && *word != "--"; ++word) {
        if (word->starts_with("--") && word->ends_with("="))
            if (const CLI::Option* empty = command.get_option_no_throw(word->substr(0, word->size() - 1)))
                throw InputError(word->substr(0, word->size() - 1), is_empty(empty->get_type_name()));
        const CLI::Option* option = word->starts_with("--") ? command.get_option_no_throw(*word) : nullptr;
        if (!option || word + 1 == words.end()) continue;
        const std::string form = option->get_type_name();
        if (form == "KEY=VALUE" && !word[1].empty() && !word[1].starts_with("-") && word[1].find('=') == std::string::npos)
            throw setting_error(*word, word[1]);
        if (option->get_expected_max() > 1) continue;
        if (const auto numbers = spaced_numbers(form, {word + 1, words.end()}); !numbers.empty())
            throw spaced_error(*word, form, numbers);
    }
}

}  // namespace

bool Given::given() const { return option_->count() > 0; }

Option Option::required() const {
    option_->required();
    return *this;
}
Option Option::initially(const std::string& text) const {
    *text_ = text;
    return *this;
}
Option Option::shown() const {
    option_->capture_default_str();
    return *this;
}

List List::required() const {
    option_->required();
    return *this;
}
List List::one_each() const {
    option_->allow_extra_args(false);
    return *this;
}
List List::may_be_empty() const {
    option_->get_validator(not_empty)->active(false);
    return *this;
}
List List::expected(int least, int most) const {
    option_->expected(least, most);
    return *this;
}

Option Command::option(const std::string& names, const std::string& form, const std::string& help) const {
    Option option;
    option.option_ = app_->add_option(names, *option.text_, help)->type_name(form);
    refuse_empty(option.option_);
    option.name_ = names.substr(names.find(',') + 1);
    option.form_ = form;
    return option;
}
List Command::list(const std::string& names, const std::string& form, const std::string& help) const {
    List list;
    list.option_ = app_->add_option(names, *list.texts_, help)->type_name(form);
    refuse_empty(list.option_);
    list.name_ = names.substr(names.find(',') + 1);
    return list;
}
Flag Command::flag(const std::string& names, const std::string& help) const {
    Flag flag;
    app_->add_flag(names, *flag.given_, help);
    return flag;
}
void Command::take_all_words() const { app_->prefix_command()->set_help_flag(); }
std::vector<std::string> Command::words() const { return app_->remaining(); }
std::string Command::name() const { return app_->get_name(); }
bool Command::knows(const std::string& option) const { return app_->get_option_no_throw(option) != nullptr; }
bool Command::given(const std::string& option) const { return knows(option) && app_->count(option) > 0; }
std::vector<std::string> Command::values(const std::string& option) const {
    return given(option) ? app_->get_option(option)->results() : std::vector<std::string>();
}

CommandLine::CommandLine(const std::string& description, const std::string& name, const std::string& version,
                         const std::string& footer)
    : app_(std::make_unique<CLI::App>(description, name)) {
    app_->set_version_flag("--version", version);
    app_->require_subcommand(1);
    app_->get_formatter()->column_width(34);
    app_->footer(footer);
}

CommandLine::~CommandLine() = default;

void CommandLine::add(const CommandSpec& spec) {
    CLI::App* const command = app_->add_subcommand(spec.name, spec.summary);
    command->callback(spec.run(Command(command)));
    command->footer(spec.examples);
}

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
