#include "base/json_utf8.h"
#include "files/description/display_file.h"

#include "base/printable.h"
#include "display/keys.h"
#include "files/description/nearest.h"
#include "python/parts.h"
#include "python/work.h"
#include "report/drawings/side_view.h"
#include "report/folder/check.h"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cctype>
#include <optional>

namespace lfdsim::python {
namespace {

namespace nb = nanobind;
namespace fs = std::filesystem;

/// The display with absolute paths of all its files: the working directory may be another one later, or in another process.
Display placed(Display display) {
    visit_files(display, [](const std::string&, std::string& file) {
        if (!file.empty() && !file.starts_with("built-in:")) file = fs::absolute(file).lexically_normal().string();
    });
    return display;
}

/// The display that display() reads, as of placed(). Throws DisplayFault with the problems of an InputError.
template <class Read>
Display read(const Read& display) {
    try {
        return placed(display());
    } catch (const InputError& error) {
        throw DisplayFault(error.problems);
    }
}

// A key's value as a Python object: lists become tuples, words become strings, and an absent value None.
template <class T>
nb::object object_of(const T& value) {
    if constexpr (has_words<T>)
        return nb::cast(std::string(word(value)));
    else
        return nb::cast(value);
}
template <class List>
nb::object tuple_of(const List& values) {
    nb::list all;
    for (const auto& value : values) all.append(value);
    return nb::tuple(all);
}
template <class T, std::size_t n>
nb::object object_of(const std::array<T, n>& values) {
    return tuple_of(values);
}
template <class T>
nb::object object_of(const std::vector<T>& values) {
    return tuple_of(values);
}
nb::object object_of(const Pitch& pitch) { return pitch.is_one() ? nb::cast(pitch[0]) : tuple_of(pitch); }
nb::object object_of(const Glass& glass) {
    if (!glass.name.empty()) return nb::cast(glass.name);
    nb::dict table;
    if (glass.formula == Formula::nd_vd) {
        table["nd"] = glass.coefficients[0];
        table["vd"] = glass.coefficients[1];
    } else {
        table[key_of(glass.formula).data()] = tuple_of(glass.coefficients);
    }
    return table;
}
template <class T>
nb::object object_of(const std::optional<T>& value) {
    return value ? object_of(*value) : nb::none();
}

/// The values of all keys, {"panel.pixels": (3840, 2160), ...}, in the order of a description.
nb::typed<nb::dict, std::string, nb::any> values(const Display& display) {
    nb::dict all;
    visit_all(display, [&](const std::string& path, const KeyInfo&, ConstValueRef value, ConstValueRef) {
        all[path.c_str()] = std::visit([](const auto* v) { return object_of(*v); }, value);
    });
    return all;
}

/// The path of a table, without the numbers of elements: "lens.surface" of "lens.surface.0".
std::string without_numbers(std::string_view path) {
    std::string all;
    for (std::size_t start = 0; start <= path.size();) {
        const std::size_t end = std::min(path.find('.', start), path.size());
        const std::string_view part = path.substr(start, end - start);
        if (part.empty() || !std::isdigit(static_cast<unsigned char>(part[0]))) all += (all.empty() ? "" : ".") + std::string(part);
        start = end + 1;
    }
    return all;
}

/// Whether a description may have a key or table of this path.
bool known(std::string_view path) {
    if (key_at(path)) return true;
    const std::string table = without_numbers(path);
    return std::ranges::any_of(format_tables(), [&](const FormatTable& t) { return !t.path.empty() && t.path == table; });
}

/// The known key or table whose path is most similar; empty if none is near.
std::string meant(std::string_view path) {
    std::vector<std::string> all;
    for (const FormatTable& table : format_tables()) {
        if (!table.path.empty()) all.push_back(table.path);
        for (const FormatTable::Value& value : table.values)
            all.push_back((table.path.empty() ? "" : table.path + ".") + std::string(value.key.name));
    }
    const std::vector<std::string_view> candidates(all.begin(), all.end());
    return std::string(nearest(path, candidates));
}

/// The default of a key whose values are words, one of which may be "none": an override KEY=DEFAULT resets it. None for all other
/// keys, which KEY=none resets, and for required and unknown ones.
nb::object default_word(std::string_view path) {
    const FormatTable::Value* const found = key_at(path);
    if (!found || found->key.required) return nb::none();
    return std::visit(
        []<class V>(const V* fresh) -> nb::object {
            if constexpr (has_words<V>)
                return nb::cast(std::string(word(*fresh)));
            else
                return nb::none();
        },
        found->fresh);
}

/// What pickle stores of a display: its description, and the depth that its model would have without depth_mm.
using State = std::tuple<std::string, std::optional<double>>;
State state(const Display& display) {
    Display keys = display;
    keys.content.written_depth_mm.reset();
    return {write_display(keys), display.content.written_depth_mm};
}
Display restored(const State& of) {
    Display display = read([&] { return parse_display(std::get<0>(of), "display"); });
    display.content.written_depth_mm = std::get<1>(of);
    return display;
}

/// The display with a model in place of its content. Throws InputError if the name is empty.
Display with_model(Display display, const std::string& model) {
    if (model.empty()) throw InputError("model", "the name is empty; give a mesh file or built-in:spheres");
    display.content.model = model;
    display.content.objects.clear();
    return placed(std::move(display));
}

/// Drawings to scale, as SVG: the display from the side, and a few of its lenses.
std::pair<std::string, std::string> drawings(const Display& display) {
    const Subject subject(display, {}, {});
    return {side_view_svg(subject), lens_view_svg(subject)};
}

/// The JSON that `lfdsim check --json` prints; without `warnings`, for which rays are traced and content is read, it is fast.
std::string check(const Display& display, const nb::object& progress, bool warnings) {
    Json json;
    run(progress, [&](Job&) { json = check_json(display, warnings); });
    return json_utf8(json);
}

}  // namespace

void add_display(nb::module_& m) {
    nb::class_<Display>(m, "Display")
        .def_static(
            "load",
            [](const std::string& path, const std::vector<std::string>& overrides) {
                return read([&] { return read_display(path, overrides); });
            },
            nb::arg("path"), nb::arg("overrides"))
        .def_static(
            "parse",
            [](const std::string& text, const std::string& folder, const std::vector<std::string>& overrides) {
                return read([&] { return parse_display(text, "text", overrides, folder); });
            },
            nb::arg("text"), nb::arg("folder"), nb::arg("overrides"))
        .def(
            "changed",
            [](const Display& display, const std::vector<std::string>& overrides) {
                return read([&] { return changed(display, overrides); });
            },
            nb::arg("overrides"))
        .def("__getstate__", state)
        .def("__setstate__", [](Display& display, const State& of) { new (&display) Display(restored(of)); })
        .def("with_model", with_model, nb::arg("model"))
        .def("text", [](const Display& display) { return printable_lines(write_display(display)); })
        .def("values", values)
        .def("drawings", drawings);
    m.def("known", known, nb::arg("path"));
    m.def("meant", meant, nb::arg("path"));
    m.def("default_word", default_word, nb::arg("path"));
    m.def("check", check, nb::arg("display"), nb::arg("progress").none(), nb::arg("warnings"));
}

}  // namespace lfdsim::python
