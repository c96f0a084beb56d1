#include "base/on_threads.h"
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
#include "view/server/access.h"
#include "view/server/page.h"
#include "view/server/server.h"
#include "view/server/visit.h"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <chrono>
#include <thread>

// lfdsim view: serves the display to browsers until a signal stops it (docs/view.md).
namespace lfdsim::cli {
namespace {

struct ViewArguments {
    Command command;
    DisplayOptions display{command, {sample_options, content_options}};
    PanelImageOption panel_image{command};
    ModelOption model{command};
    DeviceOption device{command};
    Option pattern = pattern_name(command);
    Option port = command.option("--port", "P", "Port to listen on; default: a free one");
    Option host =
        command
            .option(
                "--host", "ADDRESS",
                "Address to listen on; default 127.0.0.1, this machine only. With another, anyone who knows the token can connect")
            .initially("127.0.0.1");
    Option token = command.option("--token", "T", "Secret that a browser must give; default: 128 random bits");
    Option folder =
        command.option("--folder", "DIR", "Displays, models and pictures that a browser may load; default: the description's");
    Option visitors = command.option("--visitors", "N", "Browsers at a time, 1 to 64; default 8");
    Option threads = command.option("--threads", "N", "Default: all processors");
};

// The host of the address that is printed: "localhost" if the program listens on all addresses, an IPv6 address in brackets.
std::string address(const std::string& host) {
    if (host == "0.0.0.0" || host == "::") return "localhost";
    return host.find(':') == host.npos ? host : "[" + host + "]";
}

/// The secret that a browser must give: the option's, 16 to 128 letters and digits, or a random one. Throws InputError.
std::string token_of(const ViewArguments& args) {
    const std::string& token = args.token.text();
    if (token.empty()) return view::make_token();
    const bool plain = std::all_of(token.begin(), token.end(), [](unsigned char c) { return std::isalnum(c); });
    if (token.size() < 16 || token.size() > 128 || !plain) throw InputError("--token", "is not 16 to 128 letters and digits");
    return token;
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
    faults.of([&] { check_pattern(args.pattern); });
    faults.of(args.port, [&] { options.port = int(args.port.whole_number(1, 65535)); });
    faults.of([&] { options.token = token_of(args); });
    faults.of(args.visitors, [&] { options.most_visitors = int(args.visitors.whole_number(1, 64)); });
    faults.of(args.threads, [&] { threads = int(args.threads.whole_number(1, most_threads)); });
    faults.of([&] { start.device = args.device.read(); });
    faults.of([&] { check_effects(args.command); });
    faults.report();
    options.host = args.host.text();
    start.model = args.model.path();
    start.panel_image = args.panel_image.path();
    start.pattern = args.pattern.text();

    // The folder that browsers may load from. Messages to them are sent without the paths of other folders.
    std::filesystem::path folder = args.folder.empty() ? start.display.parent_path() : std::filesystem::path(args.folder.text());
    if (folder.empty()) folder = ".";
    const view::Library library(start, folder);
    std::vector<std::filesystem::path> elsewhere{"."};
    for (const auto& file : {start.display, std::filesystem::path(start.model), start.panel_image})
        if (file.has_parent_path()) elsewhere.push_back(file.parent_path());
    options.without_hidden = [hidden = view::HiddenPaths(folder, elsewhere)](const std::string& text) {
        return hidden.without(text);
    };
    // The panel is prepared before the address is printed: a description that cannot be shown ends the command here.
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

CommandSpec view_command() {
    return {.name = "view",
            .summary = "Shows the display in a browser, with interactive eye position and parameters",
            .examples =
                "Examples:\n  lfdsim view display.toml --model monkey.blend\n"
                "  lfdsim view display.toml --panel-image eia.png --port 8080\n"
                "It prints an address for a browser. docs/view.md describes the page.",
            .run = with_options<ViewArguments>(run)};
}

}  // namespace lfdsim::cli
