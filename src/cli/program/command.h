// Commands and their options: the part of CLI11 that is used here, behind handles, since its headers take seconds to compile.
// Floor 5.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace lfdsim::cli {

/// An option of a command; a handle, valid as long as the program's command line. Methods are those of CLI::Option.
class Option {
  public:
    Option() = default;
    explicit Option(CLI::Option* option) : option_(option) {}
    Option type_name(const std::string&);  // what help shows as its value; "" for nothing
    Option required();
    Option expected(int least, int most);  // values
    Option allow_extra_args(bool);         // whether it takes all values that follow
    Option capture_default_str();          // help shows the variable's present value
    std::size_t count() const;             // values given
    const std::vector<std::string>& results() const;

  private:
    CLI::Option* option_ = nullptr;
};

/// A command; a handle as above. Variables have to live until the command has run. Methods are those of CLI::App.
class Command {
  public:
    explicit Command(CLI::App* app) : app_(app) {}
    Command add_subcommand(const std::string& name, const std::string& description);
    /// A name without dashes is that of an argument that is told by its place.
    Option add_option(const std::string& names, const std::string& description);
    Option add_option(const std::string& names, std::string& variable, const std::string& description);
    Option add_option(const std::string& names, std::vector<std::string>& variable, const std::string& description);
    Option add_flag(const std::string& names, bool& variable, const std::string& description);
    /// The command gets no options, not even --help: all words that follow it are its own, and words() has them when it runs.
    void take_all_words();
    std::vector<std::string> words() const;
    std::string name() const;
    /// Of an option by its name with dashes: whether the command has it, whether it was given, and with which words.
    bool knows(const std::string& option) const;
    bool given(const std::string& option) const;
    std::vector<std::string> values(const std::string& option) const;
    void footer(const std::string&);
    void callback(std::function<void()>);

  private:
    CLI::App* app_;
};

/// What the command line of the program can be.
class CommandLine {
  public:
    CommandLine(const std::string& description, const std::string& name, const std::string& version, const std::string& footer);
    ~CommandLine();
    Command program() const;
    /// Runs the command that was chosen. Returns the text to print if help or the version was asked for instead. `arguments`:
    /// without the program's name, last one first. Throws InputError, and what the command throws.
    std::string parse(std::vector<std::string> arguments);

  private:
    std::unique_ptr<CLI::App> app_;
};

}  // namespace lfdsim::cli
