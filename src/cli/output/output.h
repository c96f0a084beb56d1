// The results of commands: text on standard output, and pictures with the settings that made them. Floor 5.
#pragma once
#include "cli/program/command.h"
#include "cli/program/progress.h"
#include "display/display.h"
#include "image/compare/above_white.h"
#include "image/formats/image_file.h"

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace lfdsim::cli {

using Json = nlohmann::ordered_json;

/// Writes to standard output. All text that a command prints goes through here, where characters that control a terminal are
/// escaped (base/printable.h); JSON remains the same document. Throws std::runtime_error when it cannot be written (closed pipe,
/// full disk).
void print(std::string_view text);
/// Prints a JSON document; numbers that are not finite become null.
void print_json(const Json&);

/// Writes a text file, completely or not at all. Throws InputError if the command reads that file.
void write_text(const std::filesystem::path&, std::string_view text);

/// Returns the words of the command line as they were given, the program first.
std::vector<std::string> command_words();
/// Returns the command line as a shell needs it, so that it can be copied and run again.
std::string command_line();

/// Name and version, as the metadata of pictures have them.
inline constexpr const char* software = "lfdsim " LFDSIM_VERSION;

/// The remedy for pictures whose light is cut off.
inline constexpr const char* keeps_light = "an .exr or .npy keeps their light";

/// Checks an output, before long work and after the inputs are known. From here on a signal removes its partial file. Throws
/// InputError unless a picture can be written at `path` without replacing an input.
void check_output(const std::string& path);

/// The options -o and --bits.
class OutputOptions {
  public:
    OutputOptions(Command command, const std::string& kinds)
        : command_(command),
          path_(command.option("-o,--output", "FILE", "Picture to write: " + kinds).required()),
          bits_(command.option("--bits", "8|16", "Bits per channel of a .png; default 8")) {}
    /// Checks the output, before long work. Throws InputError unless the picture can be written there in that depth.
    void check() const;
    /// Throws InputError unless pictures with this ending, that of a name such as "frame.png", can have that depth.
    void check_bits(const std::filesystem::path& name) const;
    /// Saves the picture with `about`, the command line, version and display, and ends the progress of the work before. A picture
    /// that is not complete is marked as such, and Interrupted is then thrown; `content` says what it contains, if not its
    /// completed part. It replaces no picture: beside an existing "out.png" its name is "out.incomplete.png". Layers are for the
    /// formats that keep them. Warns of light that is cut off; returns it as warn() does.
    Json write(const Image&, Encoding, const Display&, Metadata about, bool complete, Progress&, std::vector<ImageLayer> = {},
               const std::string& content = {}) const;
    /// Saves a picture as write() does, at another path; a large one is a stage of the job. Returns what its file cuts off, and
    /// does not warn of it.
    CutOff save(const std::filesystem::path&, const Image&, Encoding, const Display&, Metadata about, std::vector<ImageLayer> = {},
                Job* = nullptr) const;
    /// Warns of light that the saved pictures lack, as warn_of_cut_off() does; `file`: their name, by default that of the option.
    Json warn(const CutOff&, const std::string& file = {}) const;
    const std::string& path() const { return path_.text(); }
    int bits() const { return bits_.text() == "16" ? 16 : 8; }

  private:
    Command command_;
    Option path_, bits_;
};

/// Logs a warning of light that `what` lacks, with the remedy, if it is worth a word. Returns the key for --json, or no key.
Json warn_of_cut_off(const std::string& what, const CutOff&, const std::string& remedy);

/// Logs that the work was stopped and nothing was saved. Throws Interrupted.
[[noreturn]] void end_interrupted();
/// Logs that the work was stopped, what its folder contains ("3 of 9 views"), and whether a run with --resume continues it. Throws
/// Interrupted.
[[noreturn]] void end_interrupted(const std::filesystem::path& folder, const std::string& finished, bool resumable = true);

}  // namespace lfdsim::cli
