// The options of every command that makes a picture, and what it tells when it is done. Floor 5.
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

/// --threads, --progress, --json.
class WorkOptions {
  public:
    explicit WorkOptions(Command command) : command_(command) {}
    /// Throws InputError with all that is wrong. To be called before the others.
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
    /// The part of the camera's frame that is wanted. Throws InputError if it is not in the frame, or if its picture, beside
    /// the panel image's bytes, is more than memory holds.
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
    /// The device as RenderOptions has it; empty where none is given. Throws InputError that says what is missing.
    std::string read() const;

  private:
    Option device_;
};

/// What a command has made.
struct PictureMade {
    std::string path;
    int width, height;
    const char* unit;  // what was traced: "rays", "samples"
    std::int64_t count;
    double seconds;
};

/// Prints it as one line, with `more` behind it, or as JSON with the keys of `more` behind it.
void print_made(const PictureMade&, bool json, const std::string& more_text = {}, const Json& more = Json::object());

}  // namespace lfdsim::cli
