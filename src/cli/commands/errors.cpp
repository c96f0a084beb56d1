#include "base/counted.h"
#include "base/output_file.h"
#include "cli/options/display_options.h"
#include "cli/output/output.h"
#include "cli/program/commands.h"
#include "cli/program/interrupt.h"
#include "files/lenses/lens_table.h"
#include "geometry/geometry.h"
#include "report/folder/description.h"

#include <fmt/format.h>

// lfdsim errors: writes a table of the errors of every lens of an array: the random ones that errors.seed gives plus errors.table.
namespace lfdsim::cli {
namespace {

struct ErrorsArguments {
    Command command;
    DisplayOptions display{command};
    Option output = command.option("-o,--output", "OUT.csv", "Table of all lenses, which errors.table reads").required();
    Flag json = command.flag("--json", "Print results as JSON");
};

void run(const ErrorsArguments& args) {
    const Display display = args.display.read();
    const std::string& output = args.output.text();
    if (std::filesystem::path(output).extension() != ".csv")
        throw InputError("--output", fmt::format("{}: a table's name ends in .csv", output));
    guard_output(output);
    check_replaceable(output);
    const Geometry geometry = resolve(display);
    write_text(output, write_lens_table(display));
    const auto lenses = std::int64_t(geometry.lattice.count[0] * geometry.lattice.count[1]);
    const std::vector<Figure> largest = largest_errors(display, geometry);
    if (args.json) {
        Json all = to_json(largest);
        if (largest.empty()) all = Json::object();
        all["output"] = output;
        all["lenses"] = lenses;
        return print_json(all);
    }
    std::string text = fmt::format("{}: {}", output, counted(lenses, "lens", "lenses"));
    if (largest.empty()) text += ", none of which has errors: give errors.decenter_sd_mm and the like";
    for (const Figure& f : largest) text += fmt::format("\n  {:<26} {:.6g} {}", f.name, f.values[0], f.meaning);
    print(text + "\n");
}

}  // namespace

CommandSpec errors_command() {
    return {.name = "errors",
            .summary = "Writes a table of the errors of all lenses: the random ones plus those of errors.table",
            .examples = "Example:\n  lfdsim errors display.toml --set errors.decenter_sd_mm=0.005 errors.seed=7 -o lenses.csv",
            .run = with_options<ErrorsArguments>(run)};
}

}  // namespace lfdsim::cli
