// lfdsim: what a viewer sees of a lens-array light field display. Exit codes: 0 done, 1 failed while running, 2 bad usage or input,
// 130 interrupted.
#include "base/input_error.h"
#include "base/large_stack.h"
#include "base/printable.h"
#include "cli/output/output.h"
#include "cli/program/commands.h"
#include "cli/program/interrupt.h"
#include "cli/program/usage.h"
#include "engine/devices/gpu.h"
#include "engine/devices/threads.h"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <functional>
#include <memory>
#include <new>
#include <string>
#include <system_error>

namespace {

using namespace lfdsim;

/// A message of the log. It may quote names and contents of files, so characters that control a terminal are escaped, and its
/// length is bounded.
class LogMessage : public spdlog::custom_flag_formatter {
  public:
    void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& to) override {
        const std::string text = bounded(printable({message.payload.data(), message.payload.size()}));
        to.append(text.data(), text.data() + text.size());
    }
    std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<LogMessage>(); }
};

void start_log() {
    spdlog::set_default_logger(spdlog::stderr_logger_st("lfdsim"));
    auto formatter = std::make_unique<spdlog::pattern_formatter>();
    formatter->add_flag<LogMessage>('*').set_pattern("lfdsim: %l: %*");
    spdlog::set_formatter(std::move(formatter));
}

void run(int argc, char** argv) {
    cli::CommandLine line(
        "Simulates lens-array light field displays: what a viewer sees of panel, lenses and diffuser.", "lfdsim",
        "lfdsim " LFDSIM_VERSION,
        "First steps:\n  lfdsim check displays/desktop-asphere.toml\n  lfdsim render displays/desktop-asphere.toml --model "
        "monkey.blend "
        "-o view.png\nHelp for a command: lfdsim COMMAND --help");
#define LFDSIM_ADD_COMMAND(NAME) line.add(cli::NAME##_command());
    LFDSIM_COMMANDS(LFDSIM_ADD_COMMAND)
    const std::string asked = line.parse(cli::arguments(argc, argv));
    if (!asked.empty()) cli::print(asked);
    for (const std::string& reason : gpus_given_up()) spdlog::warn("{}; the CPU continued", reason);
}

/// Returns the exit code of the work, and logs its errors.
int run_and_tell(const std::function<int()>& work) {
    try {
        return work();
    } catch (const cli::Interrupted&) {
        return cli::interrupted_exit;
    } catch (const InputError& error) {
        if (cli::interrupted()) {  // the signal has also stopped a process that reads a model
            spdlog::warn("interrupted");
            return cli::interrupted_exit;
        }
        for (const Problem& p : error.problems) spdlog::error("{}", p.where.empty() ? p.what : p.where + ": " + p.what);
        return 2;
    } catch (const std::bad_alloc&) {
        spdlog::error("out of memory; make the picture or the panel smaller, or use fewer threads");
    } catch (const std::system_error& error) {
        const bool threads = error.code() == std::errc::resource_unavailable_try_again;
        spdlog::error("{}{}", error.what(),
                      threads ? ": no more threads or processes can be started here; raise the limit on them (ulimit -u)" : "");
    } catch (const std::exception& error) {
        spdlog::error("{}", error.what());
    }
    return 1;
}

}  // namespace

int main(int argc, char** argv) {
    start_log();
    cli::catch_signals();
    const auto work = [&] {
        return run_and_tell([&] {
            use_only_threads_to_be_had();
            run(argc, argv);
            return 0;
        });
    };
    return run_and_tell([&] { return on_enough_stack(work); });
}
