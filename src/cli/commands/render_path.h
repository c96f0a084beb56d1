// lfdsim render --path: one picture for each frame of a camera path. Floor 5.
#pragma once
#include "cli/options/shown_panel.h"
#include "cli/output/output.h"
#include "cli/program/command.h"
#include "display/display.h"
#include "engine/render.h"
#include "files/description/path_file.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace lfdsim::cli {

/// --path, --frames-as, --resume, --replace. With --path, --output names a folder.
class PathOptions {
  public:
    explicit PathOptions(Command command) : command_(command) {}
    bool given() const { return path_.given(); }
    /// Throws InputError if there is a path and its frames cannot be written as the options ask for.
    void check(const OutputOptions&) const;
    /// Throws InputError if the file cannot be read.
    CameraPath read() const;
    /// Throws InputError, which names the file and the pose or frame, unless the display is valid with the camera of every pose and
    /// frame of the path.
    void check(const CameraPath&, const Display&) const;
    /// The file of frame `frame` of `frames`: its number, from 0, in at least four digits, as in 0000.png.
    std::filesystem::path file(const OutputOptions&, std::int64_t frame, std::int64_t frames) const;
    bool resume() const { return resume_; }
    bool replace() const { return replace_; }

  private:
    Command command_;
    Option path_ =
        command_.option("--path", "FILE", "Camera path (docs/path.md): a picture for each of its frames, in the folder -o");
    Option kind_ = command_.option("--frames-as", "png|exr|npy", "File type of the frames; default png").initially("png");
    Flag resume_ = command_.flag("--resume", "Skip frames that the same command has already made there from the same files");
    Flag replace_ = command_.flag("--replace", "Remove frames there that were made by another command or from other files");
};

/// The input that all frames share.
struct PathWork {
    const PathOptions& options;
    const OutputOptions& output;
    const CameraPath& path;
    const Display& display;
    const RenderOptions& rendering;
    Json shown;  // NumberedPictures::shown
};

/// The outcome of a path.
struct PathMade {
    std::int64_t frames = 0, rendered = 0, samples = 0;  // frames: of the path; rendered, samples: by this run
    double seconds = 0;                                  // of rendering
    std::string how;                                     // "filtered, avx2, 2 threads"; empty if no frame was rendered
    Json more = Json::object();                          // for --json
};

/// Writes the frames, in order; finished ones stay, whatever happens to the rest. Calls `panel`, which gives the panel's light,
/// only after it is certain that frames can be written and are left to be made. Throws InputError, and Interrupted after a signal.
PathMade render_path(const PathWork&, const std::function<const PanelTexels&()>& panel, Progress&);

}  // namespace lfdsim::cli
