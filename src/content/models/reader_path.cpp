#include "content/models/reader_path.h"

#include <dlfcn.h>
#include <unistd.h>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

namespace lfdsim {
namespace fs = std::filesystem;
namespace {

/// Returns the folder of the shared library or program that contains this function; empty if it is known by a relative name,
/// which may mean any folder.
fs::path own_folder() {
    Dl_info own{};
    if (dladdr(reinterpret_cast<void*>(&reader_path), &own) == 0 || !own.dli_fname) return {};
    const fs::path file = own.dli_fname;
    return file.is_absolute() ? file.parent_path() : fs::path();
}

}  // namespace

fs::path reader_path() {
    const fs::path name = "lfdsim-model-reader";
    std::vector<fs::path> places;
    if (const char* forced = std::getenv("LFDSIM_MODEL_READER"); forced && *forced) {
        places.push_back(forced);
    } else {
        if (const fs::path own = own_folder(); !own.empty()) places = {own / name, own / "bin" / name};
        std::error_code error;
        const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
        if (!error) places.insert(places.end(), {here / name, here.parent_path() / "libexec/lfdsim" / name});
        places.push_back(fs::path(LFDSIM_INSTALLED_READER));
        places.push_back(fs::path(LFDSIM_BUILT_READER));
    }
    std::string tried;
    for (const fs::path& place : places) {
        if (access(place.c_str(), X_OK) == 0) return place;
        tried += "\n  " + place.string();
    }
    throw std::runtime_error("the program that reads models, lfdsim-model-reader, is not at" + tried);
}

}  // namespace lfdsim
