#include "view/answers/command.h"

#include "files/description/shell.h"

namespace lfdsim::view {
namespace {

/// Returns the option for what the panel shows, " --model monkey.blend"; empty for the description's model.
std::string shown_option(const Library& library, const Shown& shown) {
    const Shown of = library.shown(shown);
    if (of.kind == Shown::Kind::pattern) return " --pattern " + shell_word(of.name);
    if (of.kind == Shown::Kind::panel_image) return " --panel-image " + shell_file(of.name);
    return of.name.empty() ? "" : " --model " + shell_file(of.name);
}

/// Returns the arguments that name a display: its file, and --set KEY=VALUE for each override.
std::string arguments_of(const Library::Description& description) {
    std::string text = shell_file(description.file.string());
    for (const std::string& one : description.set) text += " --set " + shell_word(one);
    return text;
}

}  // namespace

std::string command(const Library& library, const Wanted& wanted) {
    std::string text, shown = shown_option(library, wanted.shown);
    if (wanted.shown.hold && !shown.starts_with(" --panel-image")) {
        text = "lfdsim eia " + arguments_of(library.description(wanted.without_settings())) + shown + " -o eia.png && ";
        shown = " --panel-image eia.png";
    }
    const auto render = [&](int eye, const char* picture) {
        return "lfdsim render " + arguments_of(library.description(wanted, eye)) + shown + " -o " + picture;
    };
    if (wanted.layout == Layout::one) return text + render(0, "view.png");
    return text + render(-1, "left.png") + " && " + render(1, "right.png");
}

}  // namespace lfdsim::view
