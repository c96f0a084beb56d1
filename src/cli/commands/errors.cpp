#include "base/counted.h"
#include "cli/options/display_options.h"
#include "cli/output/output.h"
#include "cli/program/commands.h"
#include "cli/program/interrupt.h"
#include "files/lenses/lens_table.h"
#include "geometry/geometry.h"
#include "image/formats/file.h"
#include "report/folder/description.h"

#include <fmt/format.h>

// lfdsim errors: what is drawn for each lens of an array.
namespace lfdsim::cli {
namespace {

struct ErrorsArguments {
    explicit ErrorsArguments(Command command) : display(command) {
        command.add_option("-o,--output", output, "Table of all lenses, which errors.table reads").type_name("OUT.csv").required();
        command.add_flag("--json", json, "Print results as JSON");
    }
    DisplayOptions display;
    std::string output;
    bool json = false;
};

void run(const ErrorsArguments& args) {
    const Display display = args.display.read();
    if (args.output.empty()) throw InputError("--output", "the name is empty; give the file to write");
    if (std::filesystem::path(args.output).extension() != ".csv")
        throw InputError("--output", fmt::format("{}: a table's name ends in .csv", args.output));
    guard_output(args.output);
    detail::check_replaceable(args.output);
    const Geometry geometry = resolve(display);
    const std::string table = write_lens_table(display);
    detail::OutputFile file(args.output);
    file.write(table.data(), table.size());
    file.commit();
    const auto lenses = std::int64_t(geometry.lattice.count[0] * geometry.lattice.count[1]);
    const std::vector<Figure> largest = largest_errors(display, geometry);
    if (args.json) {
        Json all = to_json(largest);
        if (largest.empty()) all = Json::object();
        all["output"] = args.output;
        all["lenses"] = lenses;
        return print_json(all);
    }
    std::string text = fmt::format("{}: {}", args.output, counted(lenses, "lens", "lenses"));
    if (largest.empty()) text += ", none of which has errors: give errors.decenter_sd_mm and the like";
    for (const Figure& f : largest) text += fmt::format("\n  {:<26} {:.6g} {}", f.name, f.values[0], f.meaning);
    print(text + "\n");
}

}  // namespace

void add_errors(Command program) {
    Command command =
        program.add_subcommand("errors", "Writes the errors of all lenses, drawn and of errors.table together, as a table");
    const auto args = std::make_shared<ErrorsArguments>(command);
    command.footer("Example:\n  lfdsim errors display.toml --set errors.decenter_sd_mm=0.005 errors.seed=7 -o lenses.csv");
    command.callback([args] { run(*args); });
}

}  // namespace lfdsim::cli
