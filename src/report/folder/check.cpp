#include "report/folder/check.h"

#include "analysis/verdicts/verdicts.h"
#include "checks/advice.h"
#include "content/content.h"
#include "files/lenses/glasses.h"
#include "report/folder/colours.h"
#include "report/folder/description.h"

#include <fmt/format.h>

namespace lfdsim {

std::vector<std::string> verdicts_and_advice(const Display& display, const Geometry& geometry, const Theory& paraxial,
                                             const std::optional<Vec3d>& model_half_size_mm) {
    std::vector<std::string> all = verdicts(display, geometry, paraxial);
    for (std::string& sentence : advice(display, geometry, paraxial, model_half_size_mm)) all.push_back(std::move(sentence));
    return all;
}

std::vector<std::string> worth_knowing(const Display& display, const Geometry& geometry, const Theory& paraxial) {
    std::vector<std::string> all;
    try {
        const ContentParts parts = load_parts(content_files(display));
        all = verdicts_and_advice(display, geometry, paraxial, half_size_mm(parts, display, geometry));
    } catch (const InputError& error) {
        all = verdicts_and_advice(display, geometry, paraxial);
        all.push_back(fmt::format("{} cannot be shown: {}", display.content.objects.empty() ? "content.model" : "content.object",
                                  error.what()));
    }
    for (const Problem& doubt : doubts_of_glasses(display)) all.push_back(fmt::format("{}: {}", doubt.where, doubt.what));
    return all;
}

Json check_json(const Display& display, bool warnings) {
    const Geometry geometry = resolve(display);
    const Theory paraxial = theory(display, geometry);
    Json notes = Json::object();
    add_notes(figures(display, geometry), "geometry", notes);
    add_notes(figures(display, geometry, paraxial), "theory", notes);
    Json theory = to_json(figures(display, geometry, paraxial));
    if (const std::vector<ChannelTheory> colours = theory_by_colour(display); !colours.empty()) theory["colour"] = to_json(colours);
    Json errors = to_json(largest_errors(display, geometry));
    return {{"display", to_json(settings(display))},
            {"geometry", to_json(figures(display, geometry))},
            {"theory", theory},
            {"largest_errors", errors.empty() ? Json() : std::move(errors)},
            {"notes", notes},
            {"warnings", warnings ? Json(worth_knowing(display, geometry, paraxial)) : Json()}};
}

}  // namespace lfdsim
