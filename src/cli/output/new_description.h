// A description that a command writes for the user to go on with. Floor 5.
#pragma once
#include "cli/program/command.h"

#include <string>

namespace lfdsim::cli {

/// -o and --force.
class NewDescription {
  public:
    explicit NewDescription(Command command)
        : path_(command.option("-o,--output", "FILE", "Description to write: .toml").required()),
          force_(command.flag("--force", "Replace an existing file")) {}
    /// Checks the output; to be called before work. Throws InputError unless a description can be written there.
    void check() const;
    /// Writes the text, which has to read back as a description; the file is whole or not there.
    void write(const std::string& text) const;
    const std::string& path() const { return path_.text(); }
    /// The command line, for a comment: the program by its name, files that were given by absolute paths by theirs.
    static std::string made_by();

  private:
    Option path_;
    Flag force_;
};

}  // namespace lfdsim::cli
