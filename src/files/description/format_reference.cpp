#include <fmt/format.h>
#include <fmt/ranges.h>

#include "files/description/display_file.h"
#include "files/description/values.h"

namespace lfdsim {
namespace {

// Each type_text() says how a field is written in a file, by its type.
std::string_view type_text(const double&) { return "number"; }
std::string_view type_text(const std::optional<double>&) { return "number"; }
std::string_view type_text(const std::optional<std::int64_t>&) { return "integer"; }
std::string_view type_text(const std::int64_t&) { return "integer"; }
std::string_view type_text(const std::string&) { return "string"; }
std::string_view type_text(const std::vector<double>&) { return "list of numbers"; }
std::string_view type_text(const std::vector<std::string>&) { return "list of strings"; }
std::string_view type_text(const std::vector<Vec3d>&) { return "list of points"; }
std::string_view type_text(const std::optional<Glass>&) { return "string or table"; }
std::string_view type_text(const std::optional<Vec3d>&) { return "3 numbers"; }
std::string_view type_text(const Pitch&) { return "number or 2 numbers"; }
std::string_view type_text(const std::array<double, 2>&) { return "2 numbers"; }
std::string_view type_text(const std::array<double, 3>&) { return "3 numbers"; }
std::string_view type_text(const std::array<double, 4>&) { return "4 numbers"; }
std::string_view type_text(const std::array<std::int64_t, 2>&) { return "2 integers"; }
std::string_view type_text(const std::optional<std::array<std::int64_t, 2>>&) { return "2 integers"; }
template <class E>
requires has_words<E> std::string_view type_text(const E&) { return "string"; }

// Returns the column "allowed" of a key.
template <class Value>
std::string allowed_text(const Range& range, const Value&) {
    if constexpr (has_words<Value>)
        return fmt::format("`\"{}\"`", fmt::join(words<Value>(), "\"`, `\""));
    else if constexpr (std::is_same_v<Value, std::string> || std::is_same_v<Value, std::vector<std::string>>)
        return "any";
    else if constexpr (std::is_same_v<Value, std::optional<Glass>>)
        return "an index of 1 to 4";
    else
        return range.text();
}

// Returns the unit of a key, which is the end of its name.
std::string_view unit(std::string_view name) {
    if (name.ends_with("_per_mm")) return "1/mm";
    if (name.ends_with("_mm")) return "mm";
    if (name.ends_with("_nm")) return "nm";
    return name.ends_with("_deg") ? "degrees" : "";
}

// Appends a row for each key of a table that is a value.
void append_values(std::string& text, const FormatTable& table) {
    for (const auto& [key, fresh] : table.values)
        std::visit(
            [&, &key = key](const auto* value) {
                const std::string fallback = key.required          ? "required"
                                             : !key.absent.empty() ? std::string(key.absent)
                                                                   : fmt::format("`{}`", toml_text(*value));
                text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", key.name, type_text(*value), unit(key.name),
                                    allowed_text(key.range, *value), fallback, key.doc);
            },
            fresh);
}

}  // namespace

std::string format_reference_markdown() {
    std::string text =
        R"(<!-- Written by format_reference_markdown() from the keys in src/display/keys.cpp; the test FormatReference says how. -->
# The display description

A TOML file describes a display, the camera that looks at it and what it shows. Lengths are in millimetres and angles in degrees, as
the keys' names say. The panel lies in z = 0, centred on the origin; +x is the viewer's right, +y is up, +z is towards the viewer.
[model.md](model.md) describes the optics and which parts of [model files](model.md#scene) are shown. `displays/` contains ready-made
descriptions.

A key that is unknown, in the wrong table or without meaning for the lens's type is an error, as is a value of another type or
outside the allowed range; an integer is accepted where a number is expected. All errors are reported together, each with file,
line and column.

On the command line `--set key=value` changes one value: the key with its table before a dot, the value as in TOML. Words need no
quotes (`--set lens.facing=panel`), `none` removes a key or table (`--set diffuser=none`) unless it is one of the key's words
(`--set panel.subpixels=none`), and surfaces are counted from 0 (`--set lens.surface.1.conic=-0.4`), as are objects. A model, image or glass catalogue given in this way is relative to the working
directory, one named in the file to the file's folder. An option that sets a key, such as `--frame-width-mm`, overrides `--set` of that key and
of a key for the same property (`camera.fov_deg`). Files have at most 1 MiB and nest at most 16 levels.

## Glass

In place of `index`, which is the same for all colours, a medium may have `glass`, whose index depends on the wavelength. It is one of:

- a name: of a glass in the files that `glass_catalogues` lists, or of one that ships (`lfdsim glass` lists those: PMMA, PC, N-BK7 ...).
  Capitals do not matter.
- `{ nd = 1.4918, vd = 57.4 }`: the index at 587.5618 nm and the Abbe number (n_d - 1)/(n_F - n_C), F and C at 486.1327 and
  656.2725 nm; n = A + B/l^2 between and beyond.
- `{ cauchy = [A, B, C] }`: n = A + B/l^2 + C/l^4, the wavelength l in micrometres.
- `{ sellmeier = [B1, C1, B2, C2, B3, C3] }`: n^2 = 1 + the sum of B l^2/(l^2 - C), C in square micrometres; any number of pairs.
- `{ power_series = [c1, p1, c2, p2, ...] }`: n^2 = the sum of c l^p; Schott's older formula has p = 0, 2, -2, -4, -6, -8.
- `conrady`, `herzberger`, `resonances`, `sellmeier_2`, `handbook_1`, `handbook_2` in the same way: the coefficients of the formulas 5,
  3, 9, 4, 7 and 8 of AGF ([model.md](model.md#colour)).

A table may also have a `name`, and `range_nm = [400, 700]`, the wavelengths for which it holds. Pictures and results store the glasses
of `glass_catalogues` in this form, so that they can be read without the catalogue.

The index must be 1 to 4 at every wavelength that is used, and these must lie in the range of the glass. On the command line:
`--set lens.index=none lens.glass=PC`, or `--set lens.index=none "lens.glass={ nd = 1.4918, vd = 57.4 }"`.

## Top level

| key | type | unit | allowed | default | meaning |
|---|---|---|---|---|---|
| `schema` | integer |  | 1 | required | Version of this format. |
)";
    for (const FormatTable& table : format_tables()) {
        if (!table.path.empty()) {
            if (table.is == PartKind::kinds)
                text += fmt::format("\n### `[{}]` of `type = \"{}\"`\n\n{}\n", table.path, table.name, table.doc);
            else if (table.is == PartKind::list)
                text += fmt::format("\n### `[[{}]]`\n\n{}\n", table.path, table.doc);
            else
                text += fmt::format("\n## `[{}]`\n\n{}\n", table.path, table.doc);
            if (!table.values.empty()) text += "\n| key | type | unit | allowed | default | meaning |\n|---|---|---|---|---|---|\n";
        }
        append_values(text, table);
    }
    return text;
}

}  // namespace lfdsim
