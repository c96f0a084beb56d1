#include "cli/options/display_options.h"
#include "cli/options/panel_source.h"
#include "cli/options/work_options.h"
#include "cli/output/output.h"
#include "cli/program/arguments.h"
#include "cli/program/commands.h"
#include "cli/program/effects.h"
#include "cli/program/interrupt.h"
#include "view/answers/hidden_paths.h"
#include "view/painting/panels.h"
#include "view/server/page.h"
#include "view/server/server.h"
#include "view/server/visit.h"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <chrono>
#include <thread>

// lfdsim view: serves the display to browsers until it is stopped.
namespace lfdsim::cli {
namespace {

struct ViewArguments {
    explicit ViewArguments(Command of)
        : command(of), display(command, {sample_options, content_options}), panel_image(command), model(command), device(command) {
        pattern_option =
            command.add_option("--pattern", pattern, fmt::format("Test pattern to show: {}", fmt::join(pattern_names(), ", ")))
                .type_name("NAME");
        command.add_option("--port", port, "Port to listen on; default: a free one").type_name("P");
        command
            .add_option(
                "--host", host,
                "Address to listen on; default 127.0.0.1, this machine only. With another, anyone who knows the token can connect")
            .type_name("ADDRESS");
        command.add_option("--token", token, "Secret that a browser must give; default: 128 random bits").type_name("T");
        command.add_option("--folder", folder, "Displays, models and pictures that a browser may load; default: the description's")
            .type_name("DIR");
        command.add_option("--visitors", visitors, "Browsers at a time, 1 to 64; default 8").type_name("N");
        command.add_option("--threads", threads, "Default: all processors").type_name("N");
    }
    Command command;
    DisplayOptions display;
    PanelImageOption panel_image;
    ModelOption model;
    DeviceOption device;
    std::string pattern;
    Option pattern_option;
    std::string port, host = "127.0.0.1", token, folder, visitors, threads;
};

// A name that a browser elsewhere can use, if the program listens to more than one.
std::string address(const std::string& host) {
    if (host == "0.0.0.0" || host == "::") return "localhost";
    return host.find(':') == host.npos ? host : "[" + host + "]";
}

int port_of(const ViewArguments& args) { return args.port.empty() ? 0 : int(whole_number("--port", args.port, 1, 65535)); }

std::string token_of(const ViewArguments& args) {
    if (args.token.empty()) return view::make_token();
    const bool plain = std::all_of(args.token.begin(), args.token.end(), [](unsigned char c) { return std::isalnum(c); });
    if (args.token.size() < 16 || args.token.size() > 128 || !plain)
        throw InputError("--token", "is not 16 to 128 letters and digits");
    return args.token;
}

void run(const ViewArguments& args) {
    Faults faults;
    view::Start start;
    view::ServerOptions options;
    int threads = 0;
    Display display;
    faults.of([&] {
        display = args.display.read();
        start.display = args.display.path();
        start.set = args.display.overrides();
    });
    faults.of([&] { args.panel_image.check(); });
    faults.of([&] { args.model.apply(display); });
    faults.of([&] {
        if (args.pattern_option.count() > 0) word("--pattern", args.pattern, pattern_names());
    });
    faults.of([&] { options.port = port_of(args); });
    faults.of([&] { options.token = token_of(args); });
    faults.of([&] {
        if (!args.visitors.empty()) options.most_visitors = int(whole_number("--visitors", args.visitors, 1, 64));
    });
    faults.of([&] {
        if (!args.threads.empty()) threads = int(whole_number("--threads", args.threads, 1, 1024));
    });
    faults.of([&] { args.device.apply(); });
    faults.of([&] { check_effects(args.command); });
    faults.report();
    options.host = args.host;
    start.model = args.model.path();
    start.panel_image = args.panel_image.path();
    start.pattern = args.pattern;

    std::filesystem::path folder = args.folder.empty() ? start.display.parent_path() : std::filesystem::path(args.folder);
    if (folder.empty()) folder = ".";
    const view::Library library(start, folder);
    std::vector<std::filesystem::path> elsewhere{"."};
    for (const auto& file : {start.display, std::filesystem::path(start.model), start.panel_image})
        if (file.has_parent_path()) elsewhere.push_back(file.parent_path());
    options.as_told = [hidden = view::HiddenPaths(folder, elsewhere)](const std::string& text) { return hidden.without(text); };
    view::Panels panels;
    Job nobody;
    if (args.panel_image.given()) args.panel_image.warn(display);
    panels.prepare(view::source_of(library, {}, display), display, resolve(display), threads, nobody);
    view::Server server(options, view::page(), [&](view::Outbox& outbox) {
        return std::make_unique<view::Visit>(library, panels, outbox, threads, LFDSIM_VERSION);
    });
    const std::string host = address(options.host), path = fmt::format("/?token={}", options.token);
    print(fmt::format("http://{}:{}{}\n", host, server.port(), path));
    print(
        fmt::format("From another machine: ssh -L {0}:localhost:{0} USER@THIS_MACHINE, then http://localhost:{0}{1}\n"
                    "Ctrl-C ends it.\n",
                    server.port(), path));
    const HeedSignals heed;
    while (!interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
}

}  // namespace

void add_view(Command program) {
    Command command =
        program.add_subcommand("view", "Shows the display in a browser: eye and parameters move, the picture follows");
    const auto args = std::make_shared<ViewArguments>(command);
    command.footer(
        "Examples:\n  lfdsim view display.toml --model monkey.blend\n"
        "  lfdsim view display.toml --panel-image eia.png --port 8080\n"
        "It prints an address for a browser. docs/view.md describes the page.");
    command.callback([args] { run(*args); });
}

}  // namespace lfdsim::cli
