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
    bool scene = false;          // a scene that the display shows
    bool panel_picture = false;  // the picture of the whole panel in memory
    bool point_images = false;   // images of points by each lens, which all but pinholes form
};

/// A measure of `lfdsim analyze`.
struct Measure {
    std::string_view name;    // on the command line and of its files
    std::string_view title;   // "Field of view"
    std::string_view says;    // its meaning, in a sentence
    std::string_view source;  // the origin of its definition
    /// Returns about how long it takes, in pictures of the camera's size; the job's advance() adds up to about as many.
    std::int64_t (*steps)(const Subject&);
    /// Measures. Throws InputError for options that do not suit the display, and Stopped if the job is cancelled.
    Result (*run)(Subject&, Job&);
    MeasureNeeds needs = {};
};

/// Throws InputError unless the display, and the free memory, have what the measure needs.
void require_needs(const Measure&, const Display&);

/// Returns all measures, in the order of the report.
std::span<const Measure> measures();

/// Returns a measure by its name. Throws InputError, which lists the names, if there is none.
const Measure& measure_named(std::string_view name);

}  // namespace lfdsim
