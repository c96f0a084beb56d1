// lfdsim: what a viewer sees of a lens-array light field display. Exit codes: 0 done, 1 failed while running, 2 bad usage or input,
// 130 interrupted.
#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/output.h"
#include "cli/usage.h"
#include "engine/gpu.h"
#include "model/error.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <new>

namespace {

using namespace lfdsim;

// File names and keys come from others: no control character of theirs reaches a terminal.
std::string printable(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    return text;
}

void run(int argc, char** argv) {
    cli::CommandLine line(
        "Simulates lens-array light field displays: what a viewer sees of panel, lenses and diffuser.", "lfdsim",
        "lfdsim " LFDSIM_VERSION,
        "First steps:\n  lfdsim check displays/desktop-asphere.toml\n  lfdsim render displays/desktop-asphere.toml --model "
        "monkey.blend "
        "-o view.png\nHelp for a command: lfdsim COMMAND --help");
    const cli::Command program = line.program();
    cli::add_new(program);
    cli::add_import(program);
    cli::add_check(program);
    cli::add_eia(program);
    cli::add_views(program);
    cli::add_photo(program);
    cli::add_render(program);
    cli::add_compare(program);
    cli::add_analyze(program);
    cli::add_sheet(program);
    cli::add_view(program);
    cli::add_export(program);
    cli::add_bench(program);
    cli::add_glass(program);
    cli::add_errors(program);
    cli::add_study(program);
    cli::add_doctor(program);
    const std::string asked = line.parse(cli::arguments(argc, argv));
    if (!asked.empty()) cli::print(asked);
    for (const std::string& reason : gpus_given_up()) spdlog::warn("{}; the CPU went on", printable(reason));
}

}  // namespace

int main(int argc, char** argv) {
    spdlog::set_default_logger(spdlog::stderr_logger_st("lfdsim"));
    spdlog::set_pattern("lfdsim: %l: %v");
    cli::catch_signals();
    try {
        run(argc, argv);
        return 0;
    } catch (const cli::Interrupted&) {
        return cli::interrupted_exit;
    } catch (const InputError& error) {
        if (cli::interrupted()) return cli::interrupted_exit;  // a reader that the signal stopped, too
        for (const Problem& p : error.problems) spdlog::error("{}", printable(p.where.empty() ? p.what : p.where + ": " + p.what));
        return 2;
    } catch (const std::bad_alloc&) {
        spdlog::error("out of memory; make the picture or the panel smaller, or use fewer threads");
    } catch (const std::exception& error) {
        spdlog::error("{}", printable(error.what()));
    }
    return 1;
}
