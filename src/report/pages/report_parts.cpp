#include "report/pages/report_parts.h"

#include "base/json_utf8.h"
#include "geometry/sharp_range.h"
#include "image/formats/encoding.h"
#include "image/formats/image_file.h"
#include "image/formats/png_memory.h"
#include "image/scaled.h"
#include "report/drawings/side_view.h"
#include "report/pages/base64.h"
#include "report/plots/svg_drawing.h"

#include <fmt/format.h>
#include <cmath>
#include <fstream>
#include <iterator>

namespace lfdsim {
namespace {

constexpr int most_columns = 1000, glance_columns = 240;  // of a picture in its section, and in the first part
constexpr std::ptrdiff_t most_glances = 3;                // pictures of a measure in the first part

std::string text_of(const Json& json, const char* key) { return escaped(json.at(key).get<std::string>()); }

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    if (!file) throw InputError(path.string(), "cannot be read");
    return bytes;
}

/// Returns the columns of a PNG, from its header; 0 for other bytes.
int columns_of(const std::string& png) {
    if (png.size() < 24 || png.compare(1, 3, "PNG") != 0) return 0;
    int columns = 0;
    for (std::size_t k = 16; k < 20; ++k) columns = columns << 8 | std::uint8_t(png[k]);
    return columns;
}

std::string figure(const std::string& inside, const std::string& caption) {
    return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", inside, caption);
}

std::string inline_svg(const std::string& svg) { return fmt::format("<div class=\"drawing\">{}</div>", svg); }

/// Returns the result of `make` for the file that an entry names; a message for a file that cannot be shown.
template <class Make>
std::string shown(const ResultFolder& folder, const Json& entry, Make make) {
    const std::string name = entry.at("file");
    try {
        return make(folder.path() / name);
    } catch (const InputError& e) {
        return fmt::format("<p class=\"warning\">{} cannot be shown: {}</p>\n", escaped(name), escaped(e.what()));
    }
}

std::string plots(const ResultFolder& folder, const Json& list) {
    std::string html;
    for (const Json& entry : list)
        html += shown(folder, entry, [&](const auto& path) {
            const std::string svg = bytes_of(path);
            if (svg.rfind("<svg ", 0) != 0) throw InputError(path.string(), "is not an SVG of a measure");
            return fmt::format("<figure>{}</figure>\n", inline_svg(svg));
        });
    return html;
}

/// Returns the pictures of a list, reduced to at most `most` columns; 0: unchanged.
std::string pictures(const ResultFolder& folder, const Json& list, int most) {
    std::string html;
    for (const Json& entry : list)
        html += shown(folder, entry, [&](const auto& path) {
            std::string png = bytes_of(path);
            if (columns_of(png) == 0) throw InputError(path.string(), "is not a PNG");
            if (most > 0 && columns_of(png) > most) {
                const Image small = reduced(read_image(path, Encoding::srgb), most);
                png = png_bytes(small.width, small.height, 3, encode8(small, Encoding::srgb));
            }
            const std::string caption = text_of(entry, "caption");
            return figure(fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">", caption, base64(png)), caption);
        });
    return html;
}

/// Returns the rows of the table of sizes and theory.
std::string theory_rows(const Subject& s) {
    const Display& d = s.display();
    const Geometry& g = s.geometry();
    const Theory& t = s.theory();
    const auto number = [](double x, const char* unit) {
        return std::isfinite(x) ? fmt::format("{}{:.4g}{}", x < 0 ? "−" : "", std::abs(x), unit) : std::string("infinite");
    };
    const double eye = camera_distance_mm(d);
    const bool by_axis = differs_by_axis(d.array);
    const auto along = [&](double x, double y, const char* unit) {
        return by_axis ? number(x, unit) + " × " + number(y, unit) : number(x, unit);
    };
    const auto theory = [&](double AxisTheory::*figure, const char* unit) {
        return along(t.along[0].*figure, t.along[1].*figure, unit);
    };
    const std::pair<const char*, std::string> rows[] = {
        {"Panel", fmt::format("{} × {} pixels of {:.4g} mm, {:.4g} × {:.4g} mm", d.panel.pixels[0], d.panel.pixels[1],
                              d.panel.pixel_pitch_mm, g.panel_width_mm, g.panel_height_mm)},
        {"Lenses", fmt::format("{} × {}, pitch p {}, aperture D {}", g.lattice.count[0], g.lattice.count[1],
                               along(d.array.pitch_mm[0], d.array.pitch_mm[1], " mm"),
                               along(g.clear_aperture_mm[0], g.clear_aperture_mm[1], " mm"))},
        {"Gap g, focal length f", fmt::format("{}, {}", number(g.gap_mm, " mm"), number(g.focal_length_mm, " mm"))},
        {"Diffuser", d.diffuser ? fmt::format("{:.4g}° × {:.4g}°, {:.4g} mm in front of the lenses", d.diffuser->angle_deg[0],
                                              d.diffuser->angle_deg[1], d.diffuser->distance_mm)
                                : std::string("none")},
        {"Field of view, 2 atan(p / 2g)", theory(&AxisTheory::fov_deg, "°")},
        {"Field of view of whole elemental images, 2 atan(p′ / 2g)", theory(&AxisTheory::fov_elemental_deg, "°")},
        {"Views across, and the angle between them",
         fmt::format("{}, {}", theory(&AxisTheory::views, ""), theory(&AxisTheory::view_step_deg, "°"))},
        {"Central depth plane L, from the lenses", number(t.central_depth_mm, " mm")},
        {"Depth of field by the lens", depths_in_words(g, sharp_by_lens(g, t, eye), eye)},
        {"Depth of field by the pixel", depths_in_words(g, sharp_by_pixel(g, t, eye), eye)},
        {"Image of a pixel at L", number(t.pixel_image_mm, " mm")},
        {"Whole screen visible within", theory(&AxisTheory::viewing_zone_deg, "°")},
        {"Sampling by lenses, by pixels", fmt::format("{}, {}", theory(&AxisTheory::lens_sampling_limit_per_mm, "/mm"),
                                                      number(t.pixel_image_limit_per_mm, "/mm at L"))},
    };
    std::string html;
    for (const auto& [name, value] : rows) html += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", name, value);
    return html;
}

}  // namespace

const char* const findings_table =
    "<div class=\"wide\"><table class=\"findings\">\n<thead><tr><th scope=\"col\">Figure</th><th scope=\"col\">Measured</th>"
    "<th scope=\"col\">Theory</th><th scope=\"col\">Remark</th></tr></thead>\n";

std::string value_html(const Json& values, const std::string& unit) {
    if (values.empty()) return "–";
    std::string text;
    bool number = false;
    for (const Json& x : values) {
        number = number || x.is_number();
        text += text.empty() ? "" : " to ";
        text += x.is_number() ? digits_of(x.get<double>()) : x.is_string() ? x.get<std::string>() : "not found";
    }
    if (!number) return values.front().is_string() ? text : "not found";
    for (std::size_t at = text.find('-'); at != text.npos; at = text.find('-', at + 1))
        if (at == 0 || text[at - 1] == ' ') text.replace(at, 1, "−");
    return text + (unit == "deg" ? "°" : unit.empty() ? "" : " " + escaped(unit));
}

std::string digits_of(double value) { return fmt::format("{:.4g}", std::abs(value) < 1e-12 ? 0. : value); }

std::string error_text(const Json& errors, const Json& values) {
    const auto number = [](const Json& list, std::size_t k) {
        const Json& x = list.is_array() ? list[k] : list;
        return x.is_number() ? std::abs(x.get<double>()) : 0;
    };
    double most = 0;
    for (std::size_t k = 0; k < errors.size(); ++k)
        if (const double error = number(errors, k); error > std::max(1e-12, 1e-5 * (k < values.size() ? number(values, k) : 0)))
            most = std::max(most, error);
    return most > 0 ? fmt::format(" ± {:.2g}", most) : "";
}

std::string finding_rows(const Json& report) {
    std::string html;
    for (const Json& f : report.at("findings")) {
        const std::string unit = f.at("unit");
        html += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td class=\"remark\">{}</td></tr>\n",
                            text_of(f, "what"), value_html(f.at("measured"), unit) + error_text(f.at("error"), f.at("measured")),
                            value_html(f.at("theory"), unit), text_of(f, "remark"));
    }
    return html;
}

std::string headline_row(const Json& report) {
    const std::string link =
        fmt::format("<tr><th scope=\"row\"><a href=\"#{}\">{}</a></th>", text_of(report, "measure"), text_of(report, "title"));
    if (report.at("findings").empty())
        return link + fmt::format("<td class=\"remark\" colspan=\"3\">{}</td></tr>\n", text_of(report, "says"));
    const Json& f = report.at("findings").front();
    const std::string unit = f.at("unit");
    return link + fmt::format("<td class=\"remark\">{}</td><td>{}</td><td>{}</td></tr>\n", text_of(f, "what"),
                              value_html(f.at("measured"), unit) + error_text(f.at("error"), f.at("measured")),
                              value_html(f.at("theory"), unit));
}

std::string glance(const ResultFolder& folder, const Json& measured) {
    const Json& report = measured.at("report");
    std::string html;
    for (const Json& entry : report.at("pictures"))
        if (&entry - &report.at("pictures").front() < most_glances)
            html += fmt::format("<a href=\"#{}\">{}</a>\n", text_of(report, "measure"),
                                pictures(folder, Json::array({entry}), glance_columns));
    return html;
}

std::string folded(const std::string& summary, const std::string& html) {
    return fmt::format("<details class=\"fold\"><summary>{}</summary></details>\n<div class=\"folded\">\n{}</div>\n", summary,
                       html);
}

std::vector<std::string> figures_of(const ResultFolder& folder, const Json& measured) {
    const Json& report = measured.at("report");
    std::vector<std::string> all;
    for (const char* list : {"plots", "maps", "pictures", "animations"})
        for (const Json& entry : report.at(list)) {
            const bool drawn = entry.at("file").get<std::string>().ends_with(".svg");
            const Json one = Json::array({entry});
            all.push_back(drawn ? plots(folder, one)
                                : pictures(folder, one, list == std::string_view("animations") ? 0 : most_columns));
        }
    return all;
}

std::string measure_section(const ResultFolder& folder, const Json& measured) {
    const Json& report = measured.at("report");
    std::string html = fmt::format("<p class=\"source\">Source: {}</p>\n", text_of(report, "source"));
    if (!report.at("findings").empty()) html += "<p>Its figures are in <a href=\"#summary\">theory and measurement</a>.</p>\n";
    for (const Json& remark : report.at("remarks")) html += fmt::format("<p>{}</p>\n", escaped(remark.get<std::string>()));
    html += plots(folder, report.at("plots")) + plots(folder, report.at("maps"));
    html += pictures(folder, report.at("pictures"), most_columns) + pictures(folder, report.at("animations"), 0);
    std::string files;
    for (const Json& file : report.at("files")) files += ", " + escaped(file.get<std::string>());
    Json figures = measured;
    figures.erase("report");
    figures.erase("settings");
    html += fmt::format(
        "<details><summary>All figures, as in {0}.json</summary>\n<pre>{1}</pre>\n</details>\n"
        "<p class=\"files\">Files: {0}.json{2}; measured in {3:.1f} s</p>\n",
        text_of(report, "measure"), escaped(json_utf8(figures, 2)), files, report.at("seconds").get<double>());
    return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n<p class=\"says\">{}</p>\n{}</section>\n", text_of(report, "measure"),
                       text_of(report, "title"), text_of(report, "says"), folded("Plots, pictures and remarks", html));
}

std::string display_section(const Subject& s) {
    const std::string html = figure(inline_svg(side_view_svg(s)),
                                    "From the panel to the eye. Orange: rays from the eye, through the diffuser's middle and "
                                    "edges, back to the panel. Blue: the light of one pixel.") +
                             figure(inline_svg(lens_view_svg(s)),
                                    "Lenses near the middle, with rays traced through their surfaces; a faint ray ends at "
                                    "a rim or a stop.") +
                             "<div class=\"wide\"><table>\n<caption>Sizes and paraxial theory, from the description</caption>\n" +
                             theory_rows(s) + "</table></div>\n";
    return "<section id=\"display\">\n<h2>The display</h2>\n" + folded("Drawings to scale, sizes and theory", html) +
           "</section>\n";
}

}  // namespace lfdsim
