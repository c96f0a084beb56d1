#include "cli/program/effects.h"

#include "cli/program/arguments.h"

#include <fmt/format.h>
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim::cli {
namespace {

/// A rule for options, or for values of options ("--device cuda": all values that begin with "cuda"). It applies to the commands
/// that have both options.
struct Rule {
    std::vector<std::string_view> idle;  // options that have no effect ...
    std::string_view beside;             // ... with this one (contradictions), or without it (belongings)
    std::string_view why;
    std::string_view but_for = {};  // a command to which it does not apply
};

constexpr std::string_view
    one_thing = "the panel can show only one of these; give one of them",
    one_way = "lenses of triangles are rendered with point samples on the CPU, a single picture at a time; give one of them";

const std::vector<Rule>& contradictions() {
    static const std::vector<Rule> all{
        {{"--model", "--pattern"}, "--panel-image", one_thing},
        {{"--model"}, "--pattern", one_thing},
        {{"--model", "--pattern"}, "--views", one_thing},
        {{"--depth-mm", "--height-mm", "--tilt-deg", "--yaw-deg"},
         "--views",
         "views are placed by --focus-depth-mm and --focus-width-mm, and cannot be rotated; give those"},
        // The rule does not apply to the viewer, which can photograph the model beside such a panel, or show it in place of it.
        {{"--depth-mm", "--height-mm", "--tilt-deg", "--yaw-deg", "--pickup"},
         "--panel-image",
         "a panel image is shown unchanged; give the first to lfdsim eia, which makes panel images of a model",
         "view"},
        {{"--depth-mm", "--height-mm", "--tilt-deg", "--yaw-deg", "--pickup"},
         "--pattern",
         "a test pattern shows no model; give one of them",
         "view"},
        {{"--exposure"}, "--path", "frames of a path are written without exposure; give one of them"},
        {{"--camera-mm"}, "--path", "the camera is in one place or on a path; give one of them"},
        {{"--target-error", "--path", "--device cuda", "--kernel", "--estimator filtered"}, "--lens-mesh", one_way},
        {{"--samples"}, "--target-error", "the error determines the number of samples; give one of them"},
        {{"--kernel"}, "--device cuda", "kernels are those of the CPU; give one of them"},
    };
    return all;
}

const std::vector<Rule>& belongings() {
    static const std::vector<Rule> all{
        {{"--flip-views", "--focus-width-mm", "--focus-depth-mm", "--camera-distance-mm", "--baseline-mm", "--view-cone-deg",
          "--cone"},
         "--views",
         "is only for --views"},
        {{"--cell-pixels"}, "--pattern checkerboard", "is only for --pattern checkerboard"},
        {{"--view"}, "--pattern view", "is only for --pattern view"},
        {{"--edge-deg", "--edge-depth-mm"}, "--pattern edge", "is only for --pattern edge"},
        {{"--frames-as", "--resume", "--replace"}, "--path", "is only for frames of a --path"},
        {{"--replace"}, "--mapping", "applies to the files beside that of --mapping"},
        {{"--lens-normals"}, "--lens-mesh", "are those of --lens-mesh, which is not given"},
        {{"--view-corners", "--fit-corners", "--fit-blur", "--overlay", "--difference"},
         "--corners",
         "is for a photograph of a display; give the corners of the screen in it: --corners"},
    };
    return all;
}

std::string_view name_of(std::string_view option) { return option.substr(0, option.find(' ')); }

bool given(const Command& command, std::string_view option) {
    const std::string_view name = name_of(option);
    const std::vector<std::string> values = command.values(std::string(name));
    return name == option ? command.given(std::string(name))
                          : !values.empty() && values.front().starts_with(option.substr(name.size() + 1));
}

}  // namespace

void check_effects(const Command& command) {
    Faults faults;
    const auto both_known = [&](std::string_view option, const Rule& rule) {
        return command.name() != rule.but_for && command.knows(std::string(name_of(option))) &&
               command.knows(std::string(name_of(rule.beside)));
    };
    for (const Rule& rule : contradictions())
        for (const std::string_view option : rule.idle)
            if (both_known(option, rule) && given(command, option) && given(command, rule.beside))
                faults.of([&] { throw InputError(fmt::format("{}, {}", option, rule.beside), std::string(rule.why)); });
    for (const Rule& rule : belongings())
        for (const std::string_view option : rule.idle)
            if (both_known(option, rule) && given(command, option) && !given(command, rule.beside))
                faults.of([&] { throw InputError(std::string(option), std::string(rule.why)); });
    faults.report();
}

}  // namespace lfdsim::cli
