#include "view/answers/answers.h"

#include "analysis/core/figure_json.h"
#include "base/json_utf8.h"
#include "content/content.h"
#include "display/keys.h"
#include "files/description/display_file.h"
#include "image/formats/image_file.h"
#include "report/drawings/side_view.h"
#include "report/folder/check.h"
#include "report/folder/description.h"
#include "report/plots/svg.h"
#include "view/answers/command.h"
#include "view/answers/controls.h"
#include "view/answers/plots.h"
#include "view/answers/probe.h"
#include "view/answers/save.h"

#include <fmt/format.h>

#include <cmath>
#include <new>
#include <stdexcept>

namespace lfdsim::view {
namespace {

Json json_of(const std::vector<Figure>& figures) {
    Json all = Json::array();
    for (const Figure& f : figures) {
        if (f.kind == Figure::Presentation::for_scripts) continue;
        const bool one = f.values.size() == 1 || std::isnan(f.values[0]);
        all.push_back({{"name", f.name},
                       {"label", f.meaning},
                       {"unit", unit_of(f.name)},
                       {"value", one ? number_json(f.values[0]) : numbers_json(f.values)},
                       {"doc", f.formula}});
        if (f.kind == Figure::Presentation::interval) all.back()["interval"] = true;
    }
    return all;
}

Json json_of(const std::vector<Problem>& problems) {
    Json all = Json::array();
    for (const Problem& p : problems) all.push_back({{"key", p.where}, {"what", p.what}});
    return all;
}

/// Returns the display as described, without the page's settings; `display` where that is not valid with this eye.
Display described(const Library& library, const Wanted& wanted, const Display& display) {
    try {
        return library.display(wanted.without_settings());
    } catch (const InputError&) {
        return display;
    }
}

/// Returns the display that is wanted; where it is not valid, the one that the program was started with.
Display wanted_or_started(const Library& library, const Wanted& wanted) {
    try {
        return library.display(wanted);
    } catch (const InputError&) {
        return read_display(library.start().display, library.start().set);
    }
}

// Returns a message that is valid UTF-8, as JSON must be: names of files may have any bytes.
Json in_utf8(Json json) {
    try {
        json.dump();
        return json;
    } catch (const Json::type_error&) {
        return Json::parse(json_utf8(json));
    }
}

template <class T>
Json json_of(const std::optional<T>& value) {
    return value ? Json(*value) : Json();
}

Json json_of(const Probe& probe) {
    return {{"lens", json_of(probe.lens)},
            {"panel_pixel", json_of(probe.panel_pixel)},
            {"panel_mm", json_of(probe.panel_mm)},
            {"says", probe.says},
            {"fan", probe.fan}};
}

Json side(const Display& display, const std::string& name) {
    const Subject subject(display, std::nullopt, {});
    SideFrame f{};
    const std::string svg = name == "lens" ? lens_view_svg(subject, &f) : side_view_svg(subject, &f);
    return {{"svg", svg},
            {"frame",
             {{"y_low", f.y_low},
              {"y_high", f.y_high},
              {"z_low", f.z_low},
              {"z_high", f.z_high},
              {"box", {f.left, f.top, f.width, f.height}}}}};
}

/// Returns the file of the model that is shown, or that would be shown without a picture or pattern; or built-in:spheres, or
/// scene_of_objects.
std::string model_file(const Library& library, const Wanted& wanted, const Display& display) {
    return wanted.shown.kind == Shown::Kind::model ? library.shown(wanted.shown).name : library.model(display);
}

class Cancellable : public Job {
  public:
    explicit Cancellable(const std::function<bool()>& cancelled) : cancelled_(cancelled) {}
    bool cancelled() const override { return cancelled_ && cancelled_(); }

  private:
    const std::function<bool()>& cancelled_;
};

/// Returns a file's name as a description beside `other` has it: relative to that folder where the file is below it, else absolute.
std::string name_beside(const std::filesystem::path& other, const std::string& file) {
    namespace fs = std::filesystem;
    const fs::path full = fs::absolute(file).lexically_normal(),
                   relative = full.lexically_relative(fs::absolute(other).lexically_normal().parent_path());
    const bool below = !relative.empty() && *relative.begin() != "..";
    return below ? relative.string() : full.string();
}

/// Returns the current description as it is saved in the file `to`.
std::string toml(const Library& library, const Wanted& wanted, const std::filesystem::path& to) {
    Display display = library.display(wanted);
    const std::string model = model_file(library, wanted, display);
    const bool by_default = model == built_in_spheres && model == model_of(display);
    if (model != scene_of_objects && !by_default) display.content.model = model;
    visit_files(display, [&](const std::string&, std::string& file) {
        if (!file.empty() && file != built_in_spheres) file = name_beside(to, file);
    });
    return write_display(display);
}

Json answer_to(const Library& library, Panels& panels, const Wanted& wanted, const Ask& ask,
               const std::function<bool()>& cancelled) {
    switch (ask.what) {
        case Ask::What::probe:
            return json_of(probe(library.display(wanted), ask.at));
        case Ask::What::side:
            return side(library.display(wanted), ask.name);
        case Ask::What::plot: {
            const Display display = library.display(wanted);
            if (ask.name == "spot") return {{"svg", svg(spot_plot(display), ask.width)}};
            Cancellable job(cancelled);
            const ContentScene scene =
                panels.scene(model_source(model_file(library, wanted, display), display), display, resolve(display), job);
            const auto claim = panels.budget().claim("panel.pixels", making_panel_text(display), 2 * making_panel_bytes(display));
            return {{"svg", svg(fov_plot(display, scene, library.start().device, job), ask.width)}};
        }
        case Ask::What::files: {
            const Library::Files files = library.files(wanted_or_started(library, wanted));
            return {
                {"displays", files.displays}, {"eyes_mm", files.eyes_mm}, {"models", files.models}, {"pictures", files.pictures}};
        }
        case Ask::What::toml:
            return {{"text", toml(library, wanted, library.description(wanted).file)}};
        case Ask::What::save: {
            const std::filesystem::path path = library.new_file(ask.name);
            save_text(path, toml(library, wanted, path), ask.overwrite);
            return {{"name", ask.name}};
        }
        case Ask::What::exr:
            break;
    }
    throw InputError("exr", "has no answer: the picture is sent as a frame of the lane \"file\"");
}

/// Returns what to warn of in the picture that the panel shows; nothing where it has none, or cannot be read, which its frame says.
std::vector<std::string> warnings_of_picture(const Library& library, const Wanted& wanted, const Display& display) {
    try {
        const Shown shown = library.shown(wanted.shown);
        if (shown.kind != Shown::Kind::panel_image) return {};
        const std::string colours = other_colours(shown.name, display.panel.encoding);
        if (!colours.empty()) return {fmt::format("{}: {}", shown.name, colours)};
    } catch (const InputError&) {
    }
    return {};
}

}  // namespace

Json problems_message(std::int64_t id, const std::vector<Problem>& problems) {
    return in_utf8({{"type", "problems"}, {"id", id}, {"problems", json_of(problems)}});
}

Json resolved(const Library& library, const Wanted& wanted) {
    try {
        const Display display = library.display(wanted);
        const Geometry geometry = resolve(display);
        const Theory paraxial = theory(display, geometry);
        std::vector<std::string> warnings = warnings_of_picture(library, wanted, display);
        for (std::string& of_display : verdicts_and_advice(display, geometry, paraxial)) warnings.push_back(std::move(of_display));
        return in_utf8({{"type", "resolved"},
                        {"id", wanted.id},
                        {"name", display.name.empty() ? library.description(wanted).file.stem().string() : display.name},
                        {"controls", controls(display, described(library, wanted, display))},
                        {"theory", json_of(figures(display, geometry, paraxial))},
                        {"geometry", json_of(figures(display, geometry))},
                        {"warnings", warnings},
                        {"command", command(library, wanted)}});
    } catch (const InputError& error) {
        return problems_message(wanted.id, error.problems);
    }
}

Json answer(const Library& library, Panels& panels, const Wanted& wanted, const Ask& ask, const std::function<bool()>& cancelled) {
    const std::string what(question_words[std::size_t(ask.what)]);
    Json answer{{"type", "answer"}, {"id", ask.id}, {"what", what}, {"problems", Json::array()}};
    const auto problem = [&](const std::string& where, const std::string& wrong) {
        answer["problems"] = json_of({{where, wrong}});
    };
    try {
        answer.update(answer_to(library, panels, wanted, ask, cancelled));
    } catch (const InputError& error) {
        answer["problems"] = json_of(error.problems);
    } catch (const Stopped&) {
        problem(what, "was stopped");
    } catch (const std::bad_alloc&) {
        problem(what, "needs more memory than is available");
    } catch (const std::runtime_error& error) {  // disk full, no program to read models
        problem(what, error.what());
    }
    return in_utf8(std::move(answer));
}

}  // namespace lfdsim::view
