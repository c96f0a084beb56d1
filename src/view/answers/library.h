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

class Library {
  public:
    /// Throws InputError if it is not a folder.
    Library(Start, std::filesystem::path folder);

    const Start& start() const { return start_; }
    /// The model that is shown with a description unless a page names another: --model, or the description's, or scene_of_objects.
    std::string model(const Display&) const;

    enum class FileKind { display, model, picture };
    /// The file that a page names, inside the folder. Throws InputError if it is outside (.., absolute, links that lead out), is
    /// not a plain file, does not exist, or is of another kind, by its ending; of descriptions, if it is not meant as one. Errors
    /// tell nothing of what is in such a file.
    std::filesystem::path file(const std::string& name, FileKind) const;
    /// The file that a page names, to be made. Throws InputError for endings other than .toml.
    std::filesystem::path new_file(const std::string& name) const;

    /// Names of files that a page may name, '/' between folders, sorted: at most 1000, six folders deep, hidden ones left out.
    /// Descriptions that are not valid are left out, and pictures of other sizes than the panel of `display` has.
    struct Files {
        std::vector<std::string> displays, models, pictures;
        std::map<std::string, Vec3d> eyes_mm;  // of the displays: where their cameras stand
    };
    Files files(const Display& display) const;

    /// The description's file and the overrides for what is wanted: the command line's, the page's, the eye and the size. `eye`:
    /// -1, 0, 1 for the left one, the middle, the right one. lfdsim render with the same --set gives the same picture.
    struct Description {
        std::filesystem::path file;
        std::vector<std::string> set;
    };
    Description description(const Wanted&, int eye = 0) const;
    /// The description, read and validated, without its objects where a model is shown in their place. Throws InputError, which
    /// names keys where possible ("array.gap_mm").
    Display display(const Wanted&, int eye = 0) const;

  private:
    bool shows_another_model(const Shown&) const;

    Start start_;
    std::filesystem::path folder_;
};

}  // namespace lfdsim::view
