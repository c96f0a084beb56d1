// Any bytes given as a table of lens errors: refused with an InputError, or lenses that the array has, each once, with finite
// numbers. Anything else is a crash.
#include "files/lenses/lens_table.h"

#include "file_of_bytes.h"
#include "files/description/display_file.h"
#include "geometry/geometry.h"

#include <cmath>
#include <cstdlib>
#include <set>

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    using namespace lfdsim;
    static const FuzzFolder folder;
    static const std::string start =
        "schema = 1\npanel.pixels = [64, 64]\npanel.pixel_pitch_mm = 0.1\nlens.type = \"ideal\"\nlens.focal_length_mm = 2\n"
        "lens.aperture_radius_mm = 0.4\narray.gap_mm = 2.1\narray.pitch_mm = 0.8\n";
    static const Display displays[] = {parse_display(start + "array.count = [8, 8]\n", "squares"),
                                       parse_display(start + "array.lattice = \"strips\"\n", "strips")};
    const std::filesystem::path file = folder.put("lenses.csv", {reinterpret_cast<const char*>(data), size});
    static const Lattice<double> lattices[] = {resolve(displays[0]).lattice, resolve(displays[1]).lattice};
    for (std::size_t k = 0; k < 2; ++k) try {
            const auto [columns, rows] = lattices[k].count;
            std::set<std::array<std::int64_t, 2>> seen;
            const auto lenses = read_lens_table(file, displays[k]);
            for (const GivenLensError& lens : *lenses) {
                const LensError& e = lens.error;
                if (lens.i < 0 || lens.j < 0 || lens.i >= columns || lens.j >= rows || !seen.insert({lens.i, lens.j}).second)
                    std::abort();
                for (const double x : {e.aside_mm[0], e.aside_mm[1], e.height_mm, e.tilt_deg[0], e.tilt_deg[1], e.curvature})
                    if (!std::isfinite(x)) std::abort();
            }
        } catch (const InputError& error) {
            if (error.problems.empty()) std::abort();
        }
    return 0;
}
