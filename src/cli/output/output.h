// Results: text on standard output, pictures with what made them. Floor 5.
#pragma once
#include "cli/program/command.h"
#include "cli/program/progress.h"
#include "display/display.h"
#include "image/formats/image_file.h"

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace lfdsim::cli {

using Json = nlohmann::ordered_json;

/// Writes to standard output: all text that a command prints goes through here, and nothing in it is obeyed by a terminal
/// (base/printable.h). JSON stays the same document. Throws std::runtime_error when it cannot be written (closed pipe, full disk).
void print(std::string_view text);
/// Prints a JSON document; numbers that are not finite become null.
void print_json(const Json&);

/// Writes a text file, which is whole or not there. Throws InputError if the command reads that very file.
void write_text(const std::filesystem::path&, std::string_view text);

/// The command line as it was given, the program first; and as a shell would need it, so that it can be copied and run again.
std::vector<std::string> command_words();
std::string command_line();

/// Name and version, as pictures carry them.
inline constexpr const char* software = "lfdsim " LFDSIM_VERSION;

/// The key of a picture's metadata that says that it is not complete.
inline constexpr const char* incomplete_mark = "incomplete";

/// Remembers the file that an argument names as one that no output may replace. Throws InputError that names the argument if no
/// file is named.
void check_input(const std::string& argument, const std::string& path);

/// Checks an output; to be called before long work, and after the inputs are known. From here on a signal removes what is partly
/// written. Throws InputError unless a picture can be written at `path`, which the option gave, without replacing an input.
void check_output(const std::string& path, const std::string& option = "--output");

/// -o and --bits.
class OutputOptions {
  public:
    OutputOptions(Command command, const std::string& kinds)
        : path_(command.option("-o,--output", "FILE", "Picture to write: " + kinds).required()),
          bits_(command.option("--bits", "8|16", "Bits per channel of a .png; default 8")) {}
    /// Checks the output; to be called before long work. Throws InputError unless the picture can be written there in that depth.
    void check() const;
    /// Throws InputError unless pictures of such a file name (".png" alone will do) can have that depth.
    void check_bits(const std::filesystem::path& name) const;
    /// Saves the picture with `about`, the command line, version and display; work before it has shown its progress. One that is
    /// not complete is marked so, and the program then ends as interrupted. Layers are for the formats that keep them.
    /// `content`: what one that is not complete contains, if not its completed part.
    void write(const Image&, Encoding, const Display&, Metadata about, bool complete, Progress&, std::vector<ImageLayer> = {},
               const std::string& content = {}) const;
    /// Saves a picture as write() does, at another path; a large one is a stage of the job.
    void save(const std::filesystem::path&, const Image&, Encoding, const Display&, Metadata about, std::vector<ImageLayer> = {},
              Job* = nullptr) const;
    const std::string& path() const { return path_.text(); }
    int bits() const { return bits_.text() == "16" ? 16 : 8; }

  private:
    Option path_, bits_;
};

/// Says that the work was stopped and nothing was saved. Throws Interrupted.
[[noreturn]] void end_interrupted();
/// Says that the work was stopped and what the saved picture contains: by default its completed part. Throws Interrupted.
[[noreturn]] void end_incomplete(const std::string& picture, const std::string& content = {});
/// Ends an interrupted run whose folder contains `finished`, "3 of 9 views"; states whether a run with --resume continues there.
[[noreturn]] void end_interrupted(const std::filesystem::path& folder, const std::string& finished, bool resumable = true);

}  // namespace lfdsim::cli
