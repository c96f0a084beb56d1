// What both formats of lens design programs have to stand.
#pragma once
#include "files/description/display_file.h"
#include "files/lenses/import_lens.h"

#include <cstdlib>

namespace lfdsim {

inline int fuzz_import(DrawnLens (*parse)(std::string_view, std::string_view), std::string_view bytes) {
    try {
        const DrawnLens lens = parse(bytes, "fuzz");
        if (lens.surfaces.size() < 3) std::abort();
        for (const bool flip : {false, true}) {
            ImportRequest request;
            request.flip = flip;
            request.scale = 0.1;
            const Imported made = import_lens(lens, request);
            if (parse_display(write_imported(made, {}, "fuzz"), "fuzz") != made.display) std::abort();
        }
    } catch (const InputError& error) {
        if (error.problems.empty()) std::abort();
    }
    return 0;
}

}  // namespace lfdsim
