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

/// The words of an option or a positional argument on the command line. Copies refer to the same ones.
class Given {
  public:
    bool given() const;                                // even if its text is empty
    const std::string& name() const { return name_; }  // as messages have it: "--output"

  protected:
    CLI::Option* option_ = nullptr;
    std::string name_, form_;
};

/// An option with one value. What reads it as a number, a size or a word takes nothing but the whole text, and throws InputError
/// that names the option, what was given and what is allowed (arguments.cpp).
class Option : public Given {
  public:
    Option required() const;
    Option initially(const std::string& text) const;  // the value where none is given
    Option shown() const;                             // help shows that value

    const std::string& text() const { return *text_; }
    bool empty() const { return text_->empty(); }

    double number() const;
    std::int64_t whole_number(std::int64_t low, std::int64_t high) const;
    std::vector<double> numbers(const std::string& example) const;  // as many as the example has
    std::array<std::int64_t, 2> size() const;
    std::string word() const;  // one of those that help shows: "flat|smooth"

  private:
    friend class Command;
    std::shared_ptr<std::string> text_ = std::make_shared<std::string>();
};

/// An option with any number of values, or which may be repeated.
class List : public Given {
  public:
    List required() const;
    List one_each() const;                     // each value has the option's name before it
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

/// A command; a handle as above.
class Command {
  public:
    explicit Command(CLI::App* app) : app_(app) {}

    // A new option, in the order of help. A name without dashes is that of a positional argument. `form` is what help shows as the
    // value: "X,Y", "flat|smooth"; "" for nothing.
    Option option(const std::string& names, const std::string& form, const std::string& help) const;
    List list(const std::string& names, const std::string& form, const std::string& help) const;
    Flag flag(const std::string& names, const std::string& help) const;
    /// The command gets no options, not even --help: all words that follow it are its own, and words() has them when it runs.
    void take_all_words() const;
    std::vector<std::string> words() const;

    std::string name() const;
    /// Queries of an option by its name with dashes: whether the command has it, whether it was given, and with which words.
    bool knows(const std::string& option) const;
    bool given(const std::string& option) const;
    std::vector<std::string> values(const std::string& option) const;

  private:
    CLI::App* app_;
};

/// A command, as help and the command line know it.
struct CommandSpec {
    const char *name, *summary;
    std::string examples = {};  // the end of its help
    /// Adds the options to the command, and returns what is done once they have been read.
    std::function<std::function<void()>(Command)> run;
};

/// Makes a CommandSpec::run of a struct of options, which is made of the command, and a function that uses it.
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
