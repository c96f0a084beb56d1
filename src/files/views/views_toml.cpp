// views.toml, read and written: docs/views.md.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/counted.h"
#include "base/problems.h"
#include "display/keys.h"
#include "files/description/nearest.h"
#include "files/description/source.h"
#include "files/description/text_file.h"
#include "files/description/values.h"
#include "files/views/views_internal.h"

namespace lfdsim::detail {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view known_keys[] = {"schema",       "columns",        "rows",         "pictures",    "first",
                                           "along",        "baseline_mm",    "camera_x_mm",  "camera_y_mm", "view_cone_deg",
                                           "cone",         "distance_mm",    "width_mm",     "height_mm",   "depth_mm",
                                           "pseudoscopic", "depth_pictures", "depth_unit_mm"};
constexpr std::string_view picture_keys[] = {"columns", "rows", "pictures", "first", "along"};
constexpr std::string_view corners[] = {"top_left", "top_right", "bottom_left", "bottom_right"};
constexpr std::string_view ways[] = {"rows", "columns"};

/// The values of a views file and their faults. Functions that read a key return false, 0 or nothing where it is absent or refused.
class ViewsReader {
  public:
    explicit ViewsReader(const fs::path& path)
        : text_(read_text(path, "a description of views")), source_(checked(path), path.string(), {}) {
        for (const auto& [key, value] : source_.root())
            if (std::find(std::begin(known_keys), std::end(known_keys), key.str()) == std::end(known_keys)) {
                const std::string_view near = nearest(key.str(), known_keys);
                problems_.add(source_.place(key, key.str()).text, "unknown key \"{}\"{}", key.str().substr(0, 40),
                              near.empty() ? "" : fmt::format("; did you mean {}?", near));
            }
        std::int64_t schema = 0;
        if (!has("schema"))
            refuse("schema", "is missing; a description of views starts with schema = 1");
        else if (read("schema", schema) && schema != 1)
            refuse("schema", "is {}; only 1 is known", schema);
    }

    bool has(std::string_view key) const { return source_.root().contains(key); }
    template <class... Values>
    void refuse(std::string_view key, fmt::format_string<Values...> what, Values&&... values) {
        problems_.add(has(key) ? source_.place(key).text : source_.place("").text, "{} {}", key,
                      fmt::format(what, std::forward<Values>(values)...));
    }
    /// Returns a key of the file with its place, "views.toml:4:15: baseline_mm".
    std::string placed(std::string_view key) const { return fmt::format("{}: {}", source_.place(key).text, key); }
    template <class Value>
    bool read(std::string_view key, Value& value) {
        if (!has(key)) return false;
        const std::string fault = read_value(*source_.root().get(key), value);
        if (!fault.empty()) refuse(key, "{}", fault);
        return fault.empty();
    }
    bool flag(std::string_view key) {
        if (!has(key)) return false;
        const auto* const value = source_.root().get(key)->as_boolean();
        if (!value) refuse(key, "is {}; give true or false", kind_of(*source_.root().get(key)));
        return value && value->get();
    }
    std::size_t word(std::string_view key, std::span<const std::string_view> words) {
        std::size_t index = 0;
        if (has(key))
            if (const std::string fault = read_word(*source_.root().get(key), words, index); !fault.empty())
                refuse(key, "{}", fault);
        return index;
    }
    std::optional<double> number(std::string_view key, const Range& range) {
        double value = 0;
        if (!read(key, value)) return {};
        if (!range.contains(value)) refuse(key, "is {}, allowed is {}", value, range.text());
        return value;
    }
    /// Returns a number of columns or rows; refuses it where it is absent or out of range, and returns 0.
    int count(std::string_view key) {
        std::int64_t value = 0;
        if (!has(key)) refuse(key, "is missing; give the number of views");
        if (!read(key, value)) return 0;
        if (value >= 1 && value <= most_views_a_side) return int(value);
        refuse(key, "is {}, allowed is 1 to {}", value, most_views_a_side);
        return 0;
    }
    /// Returns the name of numbered files, with one or two "*" and without a folder; `otherwise` where the key is absent.
    std::string pattern(std::string_view key, const std::string& otherwise) {
        std::string name = otherwise;
        read(key, name);
        const auto stars = std::count(name.begin(), name.end(), '*');
        if (!name.empty() && (stars < 1 || stars > 2 || name.find("**") != name.npos || name.find('/') != name.npos))
            refuse(
                key,
                "is \"{}\"; give a name in the same folder, with one * for the number, or two for row and column as in \"*_*.png\"",
                name.substr(0, 80));
        return name;
    }
    void report() const { problems_.report(); }

  private:
    const std::string& checked(const fs::path& path) const {
        check_text(text_, path.string());
        return text_;
    }
    std::string text_;
    Source source_;
    Problems problems_;
};

/// Returns the position, row by row from the upper left, of a picture by its number in an order that begins at a corner (an index
/// of `corners`) and goes along rows (0) or columns (1).
std::size_t place_of(std::size_t number, int columns, int rows, std::size_t first, std::size_t along) {
    const auto wide = std::size_t(columns), high = std::size_t(rows);
    std::size_t column = along == 0 ? number % wide : number / high, row = along == 0 ? number / wide : number % high;
    if (first % 2 == 1) column = wide - 1 - column;
    if (first / 2 == 1) row = high - 1 - row;
    return row * wide + column;
}

/// Returns the files of a pattern, row by row from the upper left. Of two numbers in their names the first one counts rows where
/// the order goes along rows, else columns.
std::vector<fs::path> in_place(const fs::path& folder, const std::string& pattern, const fs::path& toml, const ViewsSource& source,
                               std::size_t first, std::size_t along) {
    std::vector<fs::path> files =
        std::count(pattern.begin(), pattern.end(), '*') == 2
            ? numbered_grid(folder, pattern, along == 0 ? source.rows : source.columns, along == 0 ? source.columns : source.rows,
                            along == 0 ? std::array{"row", "column"} : std::array{"column", "row"}, toml.string())
            : numbered_row(folder, pattern, source.views(), toml.string());
    std::vector<fs::path> placed(files.size());
    for (std::size_t n = 0; n < files.size(); ++n)
        placed[place_of(n, source.columns, source.rows, first, along)] = std::move(files[n]);
    return placed;
}

/// Refuses positions of cameras along an axis that are no lengths, or that do not rise (direction 1) or fall (-1).
void check_positions(ViewsReader& reader, std::string_view key, const std::vector<double>& places, int direction) {
    for (std::size_t k = 0; k < places.size(); ++k) {
        if (!std::isfinite(places[k])) return reader.refuse(key, "element {} is not finite", k);
        if (!any_length.contains(places[k]))
            return reader.refuse(key, "element {} is {}, allowed is {}", k, places[k], any_length.text());
        if (k > 0 && !(direction * (places[k] - places[k - 1]) >= shortest_mm))
            return reader.refuse(key, "element {} is {}, after {}; positions go {}", k, places[k], places[k - 1],
                                 direction > 0 ? "from left to right, so they rise" : "from top to bottom, so they fall");
    }
}

/// Returns the greatest distance from the middle.
double reach_of(const std::vector<double>& places) {
    double reach = 0;
    for (const double place : places) reach = std::max(reach, std::abs(place));
    return reach;
}

/// Reads the cameras' positions, in one of three ways: a step, the x and y of all, or a view cone.
void read_cameras(ViewsReader& reader, ViewsSource& source) {
    const bool places = reader.has("camera_x_mm") || reader.has("camera_y_mm");
    if (int(reader.has("baseline_mm")) + int(places) + int(reader.has("view_cone_deg")) > 1)
        reader.refuse(reader.has("baseline_mm") ? "baseline_mm" : "view_cone_deg",
                      "is one of three ways to state the cameras' positions (baseline_mm, camera_x_mm with camera_y_mm, and "
                      "view_cone_deg); give one of them");
    std::array<double, 2> baseline{};
    if (reader.read("baseline_mm", baseline)) {
        for (const double step : baseline)
            if (!positive_length.contains(step)) reader.refuse("baseline_mm", "is {}, allowed is {}", step, positive_length.text());
        source.cameras = camera_places(even_places(source.columns, baseline[0]), even_places(source.rows, -baseline[1]));
        source.cameras_key = reader.placed("baseline_mm");
    }
    if (places) {
        std::vector<double> x, y;
        reader.read("camera_x_mm", x);
        reader.read("camera_y_mm", y);
        if (source.columns > 0 && int(x.size()) != source.columns)
            reader.refuse("camera_x_mm", "has {} for {} of views", counted(x.size(), "place"), counted(source.columns, "column"));
        if (source.rows > 0 && int(y.size()) != source.rows)
            reader.refuse("camera_y_mm", "has {} for {} of views", counted(y.size(), "place"), counted(source.rows, "row"));
        check_positions(reader, "camera_x_mm", x, 1);
        check_positions(reader, "camera_y_mm", y, -1);
        source.cameras = camera_places(x, y);
        source.cameras_key = reader.placed(reach_of(x) < reach_of(y) ? "camera_y_mm" : "camera_x_mm");
    }
    source.cone_deg = reader.number("view_cone_deg", {0, 180, true, true});
    if (reader.has("cone")) {
        source.cone = ConeCameras(reader.word("cone", cone_camera_words));
        if (places || reader.has("baseline_mm"))
            reader.refuse("cone",
                          "places the cameras in a view cone, but their positions are given; leave it out, or give view_cone_deg");
    }
}

/// Reads cameras and focus. A cone and a distance together give the cameras' positions.
void read_geometry(ViewsReader& reader, ViewsSource& source) {
    read_cameras(reader, source);
    source.distance_mm = reader.number("distance_mm", positive_length);
    source.width_mm = reader.number("width_mm", positive_length);
    source.depth_mm = reader.number("depth_mm", any_length);
    source.for_display = true;
    const std::optional<double> height = reader.number("height_mm", positive_length);
    if (height && !source.width_mm) reader.refuse("height_mm", "needs width_mm as well");
    if (height && source.width_mm) source.aspect = *source.width_mm / *height;
    if (source.cone_deg && source.distance_mm && source.cameras.empty() && source.columns > 0 && source.rows > 0)
        source.cameras =
            cone_cameras(source.columns, source.rows, *source.cone_deg, *source.distance_mm,
                         source.cone.value_or(source.form == ViewsForm::quilt ? ConeCameras::ends : ConeCameras::bins));
}

}  // namespace

void describe_quilt(const fs::path& toml, ViewsSource& source) {
    ViewsReader reader(toml);
    source.read.push_back(toml);
    for (const std::string_view key : picture_keys)
        if (reader.has(key)) reader.refuse(key, "is not for a quilt, whose name states it");
    if (reader.has("depth_pictures")) reader.refuse("depth_pictures", "is not for a quilt");
    const std::optional<double> aspect = source.aspect;
    read_geometry(reader, source);
    const bool reversed = reader.flag("pseudoscopic");
    reader.report();
    if (std::abs(source.aspect.value_or(*aspect) / *aspect - 1) > 0.01)
        throw InputError(
            toml.string(),
            fmt::format("says that views are {:.4g} times as wide as high, the quilt's name says {:.4g}", *source.aspect, *aspect));
    if (reversed) flip(source);
}

ViewsSource described_views(const fs::path& toml) {
    ViewsReader reader(toml);
    ViewsSource source;
    const fs::path folder = toml.has_parent_path() ? toml.parent_path() : fs::path(".");
    source.name = toml.string();
    source.read = {toml};
    source.columns = reader.count("columns");
    source.rows = reader.count("rows");
    const std::size_t first = reader.word("first", corners), along = reader.word("along", ways);
    const std::string pictures = reader.pattern("pictures", "view_*.png"), depths = reader.pattern("depth_pictures", "");
    read_geometry(reader, source);
    source.depth_unit_mm = reader.number("depth_unit_mm", positive_length).value_or(1);
    if (source.views() > 0 && !depths.empty() && !(source.distance_mm && source.width_mm && !source.cameras.empty()))
        reader.refuse("depth_pictures", "need the cameras' positions, distance_mm and width_mm as well");
    const bool reversed = reader.flag("pseudoscopic");
    reader.report();
    if (source.views() > std::size_t(most_views))
        throw InputError(source.name,
                         fmt::format("has {} x {} views; allowed are {} in all", source.columns, source.rows, most_views));
    source.pictures = in_place(folder, pictures, toml, source, first, along);
    if (!depths.empty()) source.depths = in_place(folder, depths, toml, source, first, along);
    if (reversed) flip(source);
    return source;
}

}  // namespace lfdsim::detail

namespace lfdsim {

std::string views_toml(const ViewGrid& grid, const std::string& pictures, const std::string& depth_pictures,
                       const std::string& how) {
    std::vector<double> x, y;
    for (int i = 0; i < grid.columns; ++i) x.push_back(grid.camera(i, 0)[0]);
    for (int j = 0; j < grid.rows; ++j) y.push_back(grid.camera(0, j)[1]);
    std::string text = "schema = 1\n";
    if (!pictures.empty())
        text += fmt::format("columns = {}\nrows = {}\npictures = {}  # row by row from the upper left\n", grid.columns, grid.rows,
                            toml_text(pictures));
    if (!how.empty()) text += fmt::format("# {}\n", how);
    text += fmt::format(
        "camera_x_mm = {}  # left to right, from the middle of the focus\ncamera_y_mm = {}  # top to bottom\n"
        "distance_mm = {}  # from the cameras to the focus\nwidth_mm = {}  # of the focus\nheight_mm = {}\n"
        "depth_mm = {}  # of the focus before the lenses' vertex plane\n",
        toml_text(x), toml_text(y), toml_text(grid.distance_mm), toml_text(grid.width_mm), toml_text(grid.height_mm),
        toml_text(grid.depth_mm));
    if (!depth_pictures.empty())
        text += fmt::format("depth_pictures = {}  # mm from the cameras' plane, 0 where nothing is\n", toml_text(depth_pictures));
    return text;
}

}  // namespace lfdsim
