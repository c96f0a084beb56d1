// The folder in which lfdsim views writes a grid of views. Floor 5.
#pragma once
#include "cli/output/numbered_pictures.h"
#include "display/view_grid.h"

namespace lfdsim::cli {

/// A folder of views: view_0000.png ..., a depth_0000.exr with each if there are depth maps, and views.toml, which is written last,
/// so that a folder that has it is complete.
class ViewsFolder {
  public:
    /// `kind` is "png", "exr" or "npy", `how` that of views_toml(); `description` and `shown` are those of NumberedPictures.
    ViewsFolder(std::filesystem::path folder, const std::string& kind, bool depth, const ViewGrid&, const std::string& how,
                std::string description, Json shown, bool resume, bool replace);
    ViewsFolder(const ViewsFolder&) = delete;

    /// Throws InputError if the folder has files that would be mixed with these views, or lost.
    void check() const;
    const NumberedPictures& pictures() const { return pictures_; }
    std::filesystem::path toml_file() const { return pictures_.folder / "views.toml"; }
    const std::string& toml() const { return toml_; }
    /// Logs how many of the views exist after the work was stopped. Throws Interrupted.
    [[noreturn]] void stop() const;

  private:
    std::string toml_;
    NumberedPictures pictures_;
};

}  // namespace lfdsim::cli
