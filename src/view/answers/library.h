// Displays, models and pictures of the served folder, by name. Floor 5. Shared by all visitors; all calls from any thread.
#pragma once
#include "display/display.h"
#include "view/server/messages.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lfdsim::view {

/// The arguments that the program was started with; paths as on the command line, not restricted to the folder.
struct Start {
    std::filesystem::path display;
    std::vector<std::string> set;  // --set of the command line, before those of a page
    std::string model;             // --model; empty: the description's
    std::filesystem::path panel_image;
    std::string pattern;
    std::string device = {};  // --device, as RenderOptions has it
};

/// The served folder. Pages name files by paths relative to it, with '/' between folders.
class Library {
  public:
    /// Throws InputError if `folder` is not a folder.
    Library(Start, std::filesystem::path folder);

    const Start& start() const { return start_; }
    /// Returns the model that is shown with a description unless a page names another: --model, the description's, or
    /// scene_of_objects.
    std::string model(const Display&) const;

    enum class FileKind { display, model, picture };
    /// Returns the file that a page names. Throws InputError if it is outside the folder (.., absolute, links that lead out), is
    /// not a plain file, does not exist, or is of another kind, by its ending; of descriptions, if it is not meant as one. Errors
    /// say nothing about the content of such a file.
    std::filesystem::path file(const std::string& name, FileKind) const;
    /// Returns what the panel shows, never Kind::start: the name of a pattern, "built-in:spheres", or a file's path; no name for
    /// the description's model. Throws InputError as file() does.
    Shown shown(const Shown& wanted) const;
    /// Returns the path of a file that a page wants to write. Throws InputError for endings other than .toml, and as file() does.
    std::filesystem::path new_file(const std::string& name) const;

    /// The files that a page may name, sorted: at most 1000, six folders deep.
    struct Files {
        std::vector<std::string> displays, models, pictures;
        std::map<std::string, Vec3d> eyes_mm;  // of the displays: the positions of their cameras
    };
    /// Returns the files. Hidden ones are left out, as are descriptions that are not valid, and pictures whose size is not that of
    /// display's panel.
    Files files(const Display& display) const;

    /// A description's file and the overrides with which it is the display that a page wants: the command line's, the page's, the
    /// eye's position and the picture's size. lfdsim render with the same --set makes the same picture.
    struct Description {
        std::filesystem::path file;
        std::vector<std::string> set;
    };
    /// Returns the description for an eye: -1 the left one, 0 midway, 1 the right one. Throws InputError.
    Description description(const Wanted&, int eye = 0) const;
    /// Returns that description, read and validated, without its objects where a model is shown in their place. Throws InputError,
    /// which names keys where possible ("array.gap_mm").
    Display display(const Wanted&, int eye = 0) const;

  private:
    bool shows_another_model(const Shown&) const;

    Start start_;
    std::filesystem::path folder_;
};

}  // namespace lfdsim::view
