// Any bytes given as a display's calibration: refused with an InputError, or a display that reads back as it was written. Anything
// else is a crash.
#include "files/calibration/calibration.h"
#include "files/description/display_file.h"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    using namespace lfdsim;
    try {
        const Calibration calibration = parse_calibration({reinterpret_cast<const char*>(data), size}, "fuzz");
        CalibrationRequest glass;
        glass.index = 1.8;
        glass.distance_mm = 500;
        for (const CalibrationRequest& request : {CalibrationRequest(), glass}) {
            const Imported made = import_calibration(calibration, request, "fuzz");
            if (parse_display(write_imported(made, {}, "fuzz"), "fuzz") != made.display) std::abort();
        }
    } catch (const InputError& error) {
        if (error.problems.empty()) std::abort();
    }
    return 0;
}
