#include "cli/output/views_folder.h"

#include "base/counted.h"
#include "base/output_file.h"
#include "cli/output/companion.h"
#include "cli/output/output.h"
#include "cli/program/input_files.h"
#include "cli/program/interrupt.h"
#include "files/views/views_source.h"

#include <fmt/format.h>
#include <algorithm>

namespace lfdsim::cli {
namespace {

namespace fs = std::filesystem;

bool named_as_view(const fs::path& file) {
    const std::string name = file.stem(), kind = file.extension(), number = name.substr(std::min(name.find('_') + 1, name.size()));
    const bool numbered = number.size() >= 4 && number.find_first_not_of("0123456789") == number.npos;
    return numbered && (name == "view_" + number || name == "depth_" + number) &&
           (kind == ".png" || kind == ".exr" || kind == ".npy");
}

}  // namespace

ViewsFolder::ViewsFolder(fs::path folder, const std::string& kind, bool depth, const ViewGrid& grid, const std::string& how,
                         std::string description, Json shown, bool resume, bool replace) {
    const std::string depth_kind = kind == "npy" ? "npy" : "exr";
    const std::int64_t of_each = depth ? 2 : 1;
    toml_ = views_toml(grid, "view_*." + kind, depth ? fmt::format("depth_*.{}", depth_kind) : "", how);
    pictures_ = {std::move(folder),
                 std::int64_t(grid.views()) * of_each,
                 [=](std::int64_t n) {
                     return n % of_each == 0 ? fmt::format("view_{:04}.{}", n / of_each, kind)
                                             : fmt::format("depth_{:04}.{}", n / of_each, depth_kind);
                 },
                 [description = std::move(description)](std::int64_t) { return description; },
                 std::move(shown),
                 named_as_view,
                 "view",
                 resume,
                 replace};
}

void ViewsFolder::check() const {
    const fs::path& folder = pictures_.folder;
    std::error_code none;
    remove_abandoned(folder, {});
    if (!fs::is_directory(folder, none)) return;
    std::error_code unreadable;
    if (fs::is_empty(folder, unreadable)) return;
    if (unreadable) throw InputError(folder.string(), fmt::format("cannot be read: {}", unreadable.message()));
    if (!pictures_.resume && !pictures_.replace) {
        pictures_.keep_apart();
        throw InputError(folder.string(),
                         "contains other files; give an empty folder for the views, or --replace to write beside them");
    }
    if (const fs::path toml = toml_file(); !pictures_.replace && fs::exists(fs::symlink_status(toml, none)) && !holds(toml, toml_))
        throw InputError(toml.string(), "is of other views; give another folder, or --replace to write over it");
    pictures_.keep_apart();
    for (std::int64_t n = 0; n < pictures_.count; ++n) refuse_input(pictures_.file(n));
}

void ViewsFolder::stop() const {
    const std::int64_t made = pictures_.count_finished();
    if (made == 0) end_interrupted();
    end_interrupted(pictures_.folder, fmt::format("{} of {}", made, counted(pictures_.count, "picture")),
                    keeps_metadata(pictures_.file(0)));
}

}  // namespace lfdsim::cli
