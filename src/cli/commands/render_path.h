// lfdsim render --path: one picture for each frame of a camera path. Floor 5.
#pragma once
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
    /// Throws InputError if there is a path and the pictures cannot be made so.
    void check(const OutputOptions&) const;
    /// Throws InputError if the file cannot be read.
    CameraPath read() const;
    /// Throws InputError with the file and the pose, or the frame, unless the camera can stand wherever the path leads.
    void check(const CameraPath&, const Display&) const;
    /// The file of one of `frames` frames: 0000.png.
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
    std::string shown;  // what tells that what the panel shows has changed
};

struct PathMade {
    std::int64_t frames = 0, rendered = 0, samples = 0;  // rendered: by this run
    double seconds = 0;
    std::string how;             // "filtered, avx2, 2 threads"; empty if nothing was left to render
    Json more = Json::object();  // for --json
};

/// Writes the frames, in order; those that are finished stay, whatever becomes of the rest. `panel` gives the panel's light, which
/// is asked for once it is sure that frames can be written and are left to be made. Throws InputError, Interrupted.
PathMade render_path(const PathWork&, const std::function<const Texels&()>& panel, Progress&);

}  // namespace lfdsim::cli
