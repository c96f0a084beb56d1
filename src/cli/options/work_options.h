// The options of every command that makes a picture, and what it prints when it is done. Floor 5.
#pragma once
#include "cli/output/output.h"
#include "cli/program/command.h"
#include "cli/program/progress.h"
#include "display/display.h"
#include "image/image.h"

#include <cstdint>
#include <optional>
#include <string>

namespace lfdsim::cli {

/// The options --threads, --progress and --json.
class WorkOptions {
  public:
    explicit WorkOptions(Command command) : command_(command) {}
    /// Throws InputError with all faults. It must be called before the functions below.
    void check() const;
    int threads() const;  // 0: all
    const std::string& progress() const { return progress_.text(); }
    bool json() const { return json_; }

  private:
    Command command_;
    Option threads_ = command_.option("--threads", "N", "Threads to use; default: one per processor");
    Option progress_ =
        command_
            .option("--progress", "auto|bar|lines|json|none", "Progress on standard error; auto: a bar on a terminal, else lines")
            .initially("auto");
    Flag json_ = command_.flag("--json", "Print results as JSON");
};

/// The option --crop.
class CropOption {
  public:
    explicit CropOption(Command command)
        : crop_(command.option("--crop", "X0,Y0,X1,Y1", "Only this part of the frame: columns X0 to X1-1, rows Y0 to Y1-1")) {}
    /// Returns the part of the camera's frame that is wanted; nothing without the option. Throws InputError if it is not in the
    /// frame, or if memory does not suffice for its picture in addition to `panel_bytes`.
    std::optional<Rect> read(const Camera&, double panel_bytes) const;

  private:
    Option crop_;
};

/// The option --device.
class DeviceOption {
  public:
    explicit DeviceOption(Command command)
        : device_(command.option(
              "--device", "auto|cpu|cuda|cuda:N",
              "Device that renders: auto uses a GPU where one works; default: environment variable LFDSIM_DEVICE, else auto")) {}
    /// Returns the device as RenderOptions has it; empty where none is given. Throws InputError that says what is missing.
    std::string read() const;

  private:
    Option device_;
};

/// The picture that a command has made.
struct PictureMade {
    std::string path;
    int width, height;   // pixels
    const char* unit;    // what was traced: "rays", "samples"
    std::int64_t count;  // of them; 0: nothing was traced
    double seconds;      // of tracing alone
};

/// Prints the picture as one line with `more_text` after it, or as JSON with the keys of `more` after its keys.
void print_made(const PictureMade&, bool json, const std::string& more_text = {}, const Json& more = Json::object());

}  // namespace lfdsim::cli
