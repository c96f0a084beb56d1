// The measures, by name. Floor 3, public.
#pragma once
#include "analysis/core/result.h"
#include "analysis/core/subject.h"

#include <optional>
#include <span>
#include <string_view>

namespace lfdsim {

/// The requirements of a measure.
struct MeasureNeeds {
    bool scene = false;         // that the display shows
    bool point_images = false;  // made by each lens, as by all but pinholes
};

struct Measure {
    std::string_view name;    // of the command line and of the files
    std::string_view title;   // "Field of view"
    std::string_view says;    // what it means, in a sentence
    std::string_view source;  // where its definition comes from
    /// About how long it takes, in pictures of the camera's size; the job's advance() adds up to as many.
    std::int64_t (*steps)(const Subject&);
    /// Throws InputError for options that do not suit the display, Stopped where the job is cancelled.
    Result (*run)(Subject&, Job&);
    MeasureNeeds needs = {};
};

/// Why a display lacks what a measure needs, if it does.
std::optional<Problem> refusal(const Measure&, const Display&);

/// All measures, in the order of the report.
std::span<const Measure> measures();

/// Throws InputError that lists the names.
const Measure& measure_named(std::string_view name);

}  // namespace lfdsim
