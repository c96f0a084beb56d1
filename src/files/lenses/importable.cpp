#include "files/lenses/importable.h"

#include <fmt/format.h>

#include "base/text.h"
#include "files/description/text_file.h"

namespace lfdsim {

std::variant<DrawnLens, Calibration> read_importable(const std::filesystem::path& path) {
    const std::string kind = lower_case(path.extension().string()), name = path.string();
    if (kind == ".zmx") return parse_zmx(read_text(path, "a lens in Zemax's format"), name);
    if (kind == ".roa") return parse_rayoptics(read_text(path, "a lens in ray-optics's format"), name);
    if (kind == ".json") {
        const std::string text = read_text(path, "a lens in Optiland's format, or a calibration");
        if (is_calibration(text, name)) return parse_calibration(text, name);
        return parse_optiland(text, name);
    }
    throw InputError(name, fmt::format("is of kind \"{}\"; .zmx (Zemax), .json (Optiland, or a Looking Glass calibration) and .roa "
                                       "(ray-optics) can be read",
                                       kind));
}

}  // namespace lfdsim
