// Commands and their options: the part of CLI11 that is used here, behind handles, since its headers take seconds to compile.
// Floor 5.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace lfdsim::cli {

/// The words of an option or a positional argument on the command line. Copies refer to the same words.
class Given {
  public:
    bool given() const;                                // also with an empty text
    const std::string& name() const { return name_; }  // as messages have it: "--output"

  protected:
    CLI::Option* option_ = nullptr;
    std::string name_, form_;
};

/// An option with one value. The functions that read it as a number, a size or a word accept nothing but the whole text, and throw
/// InputError that names the option, what was given and what is allowed (arguments.cpp).
class Option : public Given {
  public:
    Option required() const;
    Option initially(const std::string& text) const;  // sets the value where none is given
    Option shown() const;                             // makes help show that value

    const std::string& text() const { return *text_; }
    bool empty() const { return text_->empty(); }

    double number() const;
    std::int64_t whole_number(std::int64_t low, std::int64_t high) const;
    std::vector<double> numbers(const std::string& example) const;  // the same number of them as the example has
    std::array<std::int64_t, 2> size() const;
    std::string word() const;  // one of the words that help shows: "flat|smooth"

  private:
    friend class Command;
    std::shared_ptr<std::string> text_ = std::make_shared<std::string>();
};

/// An option with any number of values, or which may be repeated.
class List : public Given {
  public:
    List required() const;
    List one_each() const;                     // each value has the option's name before it
    List may_be_empty() const;                 // a value may be an empty text
    List expected(int least, int most) const;  // values
    const std::vector<std::string>& texts() const { return *texts_; }

  private:
    friend class Command;
    std::shared_ptr<std::vector<std::string>> texts_ = std::make_shared<std::vector<std::string>>();
};

/// An option without a value.
class Flag {
  public:
    operator bool() const { return *given_; }

  private:
    friend class Command;
    std::shared_ptr<bool> given_ = std::make_shared<bool>(false);
};

/// A handle of a command, whose copies refer to the same command.
class Command {
  public:
    explicit Command(CLI::App* app) : app_(app) {}

    // These add an option, in the order of help. A name without dashes is that of a positional argument. `form` is what help shows
    // as the value: "X,Y", "flat|smooth"; "" for nothing.
    Option option(const std::string& names, const std::string& form, const std::string& help) const;
    List list(const std::string& names, const std::string& form, const std::string& help) const;
    Flag flag(const std::string& names, const std::string& help) const;
    /// Makes the command one without options, even --help: words() has all words that follow it when it runs.
    void take_all_words() const;
    std::vector<std::string> words() const;

    std::string name() const;
    // These query an option by its name with dashes: whether the command has it, whether it was given, and with which words.
    bool knows(const std::string& option) const;
    bool given(const std::string& option) const;
    std::vector<std::string> values(const std::string& option) const;

  private:
    CLI::App* app_;
};

/// A command as commands.h lists it.
struct CommandSpec {
    const char *name, *summary;
    std::string examples = {};  // the end of its help
    /// Adds the options to the command, and returns the function that is called once they have been read.
    std::function<std::function<void()>(Command)> run;
};

/// Returns a CommandSpec::run that makes a struct of options, whose members add themselves to the command, and runs a function with
/// it.
template <class Arguments>
std::function<std::function<void()>(Command)> with_options(void (*run)(const Arguments&)) {
    return [run](Command command) { return [run, args = Arguments{command}] { run(args); }; };
}

/// The commands and options of the program's command line.
class CommandLine {
  public:
    CommandLine(const std::string& description, const std::string& name, const std::string& version, const std::string& footer);
    ~CommandLine();
    void add(const CommandSpec&);
    /// Runs the command that was chosen. Returns the text to print if help or the version was asked for instead. `arguments`:
    /// without the program's name, last one first. Throws InputError, and what the command throws.
    std::string parse(std::vector<std::string> arguments);

  private:
    std::unique_ptr<CLI::App> app_;
};

}  // namespace lfdsim::cli
