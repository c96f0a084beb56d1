// A description that a command writes, as a starting point for the user. Floor 5.
#pragma once
#include "cli/program/command.h"

#include <string>

namespace lfdsim::cli {

/// The options -o and --force.
class NewDescription {
  public:
    explicit NewDescription(Command command)
        : path_(command.option("-o,--output", "FILE", "Description to write: .toml").required()),
          force_(command.flag("--force", "Replace an existing file")) {}
    /// Checks the output, before work. Throws InputError unless a description can be written there.
    void check() const;
    /// Writes the text, which must read back as a description, completely or not at all. Throws InputError.
    void write(const std::string& text) const;
    const std::string& path() const { return path_.text(); }
    /// Returns the command line, for a comment, with the program's name and the names of files that were given by absolute paths in
    /// place of their paths.
    static std::string made_by();

  private:
    Option path_;
    Flag force_;
};

}  // namespace lfdsim::cli
