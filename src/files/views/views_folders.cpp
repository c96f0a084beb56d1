// Grids of views in folders: of the 4D Light Field Benchmark of HCI and Konstanz, of the Stanford Light Field Archive, and with
// rows and columns in names.
#include <fmt/format.h>

#include <cmath>
#include <regex>

#include "base/constants.h"
#include "base/counted.h"
#include "base/text.h"
#include "base/whole_text.h"
#include "files/description/text_file.h"
#include "files/views/views_internal.h"

namespace lfdsim::detail {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_files = 1 << 20;  // in a folder that is searched

/// Calls each(name) for the files of a folder. Throws InputError.
template <class Each>
void each_file(const fs::path& folder, const Each& each) {
    std::error_code error;
    std::size_t count = 0;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        if (++count > most_files) throw InputError(folder.string(), fmt::format("has more than {} files", most_files));
        each(at->path().filename().string());
    }
    if (error) throw InputError(folder.string(), fmt::format("cannot be read: {}", error.message()));
}

/// Returns the number that the whole text is; NaN if it is none.
double number_of(const std::string& text) { return whole_text<double>(text).value_or(nan); }

/// The values of an INI file by their keys, whatever section they are in. What it returns is checked, or InputError is thrown.
class Parameters {
  public:
    explicit Parameters(const fs::path& path) : name_(path.string()) {
        const std::string text = read_text(path, "the parameters of a light field");
        for (std::string_view rest = text; !rest.empty();) {
            const std::string_view line = next_line(rest);
            if (const std::size_t equals = line.find('='); equals != line.npos && !line.starts_with('#') && !line.starts_with(';'))
                values_[std::string(trimmed(line.substr(0, equals)))] = trimmed(line.substr(equals + 1));
        }
    }
    double positive(const std::string& key) const {
        const auto found = values_.find(key);
        if (found == values_.end()) throw InputError(name_, fmt::format("{} is missing", key));
        const double value = number_of(found->second);
        if (!(value > 0 && value < 1e9))
            throw InputError(name_,
                             fmt::format("{} is \"{}\"; give a number above 0, below 1e9", key, found->second.substr(0, 40)));
        return value;
    }
    int count(const std::string& key) const {
        const double value = positive(key);
        if (value > most_views_a_side || value != std::floor(value))
            throw InputError(name_, fmt::format("{} is {}; give a whole number, up to {}", key, value, most_views_a_side));
        return int(value);
    }

  private:
    std::string name_;
    std::map<std::string, std::string> values_;
};

bool is_number(std::string_view text) { return text.size() <= 9 && is_digits(text); }

}  // namespace

std::map<std::int64_t, fs::path> numbered_files(const fs::path& folder, const std::string& pattern) {
    const std::size_t star = pattern.find('*');
    const std::string before = pattern.substr(0, star), after = star == pattern.npos ? "" : pattern.substr(star + 1);
    std::map<std::int64_t, fs::path> files;
    each_file(folder, [&](const std::string& name) {
        if (name.size() < before.size() + after.size() || !name.starts_with(before) || !name.ends_with(after)) return;
        const std::string digits = name.substr(before.size(), name.size() - before.size() - after.size());
        if (!is_number(digits)) return;
        const auto [at, fresh] = files.emplace(std::stoll(digits), folder / name);
        if (!fresh)
            throw InputError((folder / name).string(), fmt::format("has the same number as {}", at->second.filename().string()));
    });
    return files;
}

std::vector<fs::path> numbered_row(const fs::path& folder, const std::string& pattern, std::size_t count,
                                   const std::string& counted_in) {
    const std::map<std::int64_t, fs::path> files = numbered_files(folder, pattern);
    if (files.empty())
        throw InputError(folder.string(), fmt::format("has no pictures {}, {} asks for {}", pattern, counted_in, count));
    std::vector<fs::path> row;
    std::int64_t next = files.begin()->first;
    for (const auto& [number, path] : files) {
        if (number != next)
            throw InputError(folder.string(), fmt::format("number {} of the pictures {} is missing; {} asks for {}", next, pattern,
                                                          counted_in, count));
        row.push_back(path);
        ++next;
    }
    if (row.size() != count)
        throw InputError(folder.string(),
                         fmt::format("has {} {}, {} asks for {}", counted(row.size(), "picture"), pattern, counted_in, count));
    return row;
}

namespace {

/// Pictures by the two numbers in their names.
using ByNumbers = std::map<std::pair<int, int>, fs::path>;

/// A grid of pictures by the two numbers in their names.
struct GridOfNames {
    int first[2], count[2];  // of the first number (0) and the second (1)
};
/// Returns the grid from the least to the greatest of both numbers, with none missing. Throws InputError.
GridOfNames whole_grid(const fs::path& folder, const ByNumbers& files, std::array<const char*, 2> words) {
    GridOfNames grid{{files.begin()->first.first, files.begin()->first.second}, {1, 1}};
    int last[2] = {0, 0};
    for (const auto& [at, path] : files)
        for (const auto& [k, number] : {std::pair{0, at.first}, {1, at.second}})
            grid.first[k] = std::min(grid.first[k], number), last[k] = std::max(last[k], number);
    for (const int k : {0, 1}) grid.count[k] = last[k] - grid.first[k] + 1;
    if (grid.count[0] > most_views_a_side || grid.count[1] > most_views_a_side || grid.count[0] * grid.count[1] > most_views)
        throw InputError(folder.string(),
                         fmt::format("has a grid of {} x {} views by its names; allowed are {} along each side and {} in all",
                                     grid.count[0], grid.count[1], most_views_a_side, most_views));
    for (int a = grid.first[0]; a <= last[0]; ++a)
        for (int b = grid.first[1]; b <= last[1]; ++b)
            if (!files.contains({a, b}))
                throw InputError(
                    folder.string(),
                    fmt::format("the picture of {} {}, {} {} is missing; names like {} go from {} {}, {} {} to {} {}, {} {}",
                                words[0], a, words[1], b, files.begin()->second.filename().string(), words[0], grid.first[0],
                                words[1], grid.first[1], words[0], last[0], words[1], last[1]));
    return grid;
}

std::vector<fs::path> in_order(const ByNumbers& files) {
    std::vector<fs::path> row;
    for (const auto& [at, path] : files) row.push_back(path);
    return row;
}

void add(ByNumbers& files, int a, int b, fs::path path) {
    const auto [at, fresh] = files.emplace(std::pair(a, b), path);
    if (!fresh)
        throw InputError(path.string(), fmt::format("has the same position in the grid as {}", at->second.filename().string()));
}

}  // namespace

std::vector<fs::path> numbered_grid(const fs::path& folder, const std::string& pattern, int outer, int inner,
                                    std::array<const char*, 2> words, const std::string& counted_in) {
    // The files whose names match the pattern.
    const std::size_t star = pattern.find('*'), other = pattern.find('*', star + 1);
    const std::string before = pattern.substr(0, star), between = pattern.substr(star + 1, other - star - 1),
                      after = pattern.substr(other + 1);
    ByNumbers files;
    each_file(folder, [&](const std::string& name) {
        if (name.size() < before.size() + between.size() + after.size() || !name.starts_with(before) || !name.ends_with(after))
            return;
        const std::string inside = name.substr(before.size(), name.size() - before.size() - after.size());
        const std::size_t middle = inside.find(between);
        if (middle == inside.npos) return;
        const std::string a = inside.substr(0, middle), b = inside.substr(middle + between.size());
        if (is_number(a) && is_number(b)) add(files, std::stoi(a), std::stoi(b), folder / name);
    });
    if (files.empty())
        throw InputError(folder.string(),
                         fmt::format("has no pictures {}, {} asks for {} x {}", pattern, counted_in, outer, inner));
    const GridOfNames grid = whole_grid(folder, files, words);
    if (grid.count[0] != outer || grid.count[1] != inner)
        throw InputError(folder.string(),
                         fmt::format("has pictures {} of {} and {}, {} asks for {} and {}", pattern,
                                     counted(std::size_t(grid.count[0]), words[0]), counted(std::size_t(grid.count[1]), words[1]),
                                     counted_in, counted(std::size_t(outer), words[0]), counted(std::size_t(inner), words[1])));
    return in_order(files);
}

std::optional<ViewsSource> row_column_views(const fs::path& folder) {
    // Pictures are grouped by the rest of their names, since a folder may also have other numbered files.
    static const std::regex form(R"((|.*[^0-9])(\d{1,6})_(\d{1,6})(\.(?:png|jpg|jpeg|exr|npy)))");
    std::map<std::pair<std::string, std::string>, ByNumbers> groups;  // by the text before and after the numbers
    each_file(folder, [&](const std::string& name) {
        std::smatch part;
        if (name.size() <= 200 && std::regex_match(name, part, form))
            add(groups[{part[1], part[4]}], std::stoi(part[2]), std::stoi(part[3]), folder / name);
    });
    std::erase_if(groups, [](const auto& group) { return group.second.size() < 2; });  // one picture is no grid
    if (groups.empty()) return {};
    if (groups.size() > 1)
        throw InputError(folder.string(), fmt::format("has pictures of more than one name: {} and {}; state in a views.toml which "
                                                      "of them are the views, as in pictures = \"{}*_*{}\"",
                                                      groups.begin()->second.begin()->second.filename().string(),
                                                      groups.rbegin()->second.begin()->second.filename().string(),
                                                      groups.begin()->first.first, groups.begin()->first.second));
    const ByNumbers& files = groups.begin()->second;
    const GridOfNames grid = whole_grid(folder, files, {"row", "column"});
    ViewsSource source;
    source.form = ViewsForm::row_column;
    source.name = folder.string();
    source.rows = grid.count[0];
    source.columns = grid.count[1];
    source.pictures = in_order(files);
    return source;
}

ViewsSource hci_views(const fs::path& folder) {
    const fs::path file = folder / "parameters.cfg";
    const Parameters parameters(file);
    ViewsSource source;
    source.form = ViewsForm::hci;
    source.name = folder.string();
    source.read = {file};
    source.columns = parameters.count("num_cams_x");
    source.rows = parameters.count("num_cams_y");
    const double baseline_mm = parameters.positive("baseline_mm");
    source.distance_mm = 1000 * parameters.positive("focus_distance_m");
    // The sensor's size is that of its longer side. The focus is what a camera sees at its distance B: width = sensor/f B.
    const double columns = parameters.positive("image_resolution_x_px"), rows = parameters.positive("image_resolution_y_px");
    source.width_mm = parameters.positive("sensor_size_mm") / parameters.positive("focal_length_mm") * *source.distance_mm *
                      columns / std::max(columns, rows);
    source.aspect = columns / rows;
    source.cameras = camera_places(even_places(source.columns, baseline_mm), even_places(source.rows, -baseline_mm));
    source.pictures = numbered_row(folder, "input_Cam*.png", source.views(), file.string());

    // Depth maps: of all views, or of the middle one alone, which has no number in its name. Distances are in metres.
    const auto exists = [&](const std::string& name) {
        std::error_code none;
        return fs::exists(folder / name, none);
    };
    for (const auto& [stem, value] :
         {std::pair("gt_depth_lowres", DepthValue::distance), {"gt_disp_lowres", DepthValue::disparity}}) {
        std::vector<fs::path> maps(source.views());
        bool any = false;
        for (std::size_t k = 0; k < maps.size(); ++k) {
            const std::string own = fmt::format("{}_Cam{:03}.pfm", stem, k), middle = fmt::format("{}.pfm", stem);
            if (exists(own))
                maps[k] = folder / own;
            else if (k == maps.size() / 2 && maps.size() % 2 == 1 && exists(middle))
                maps[k] = folder / middle;
            any |= !maps[k].empty();
        }
        if (!any) continue;
        source.depths = std::move(maps);
        source.depth_value = value;
        source.depth_unit_mm = 1000;
        break;
    }
    return source;
}

std::optional<ViewsSource> stanford_views(const fs::path& folder) {
    // Names end in _ROW_COLUMN_V_U, v and u being the camera's position in an unknown unit.
    static const std::regex form(
        R"(.*_(\d{1,4})_(\d{1,4})_(-?\d{1,9}(?:\.\d{1,12})?)_(-?\d{1,9}(?:\.\d{1,12})?)_?\.(?:png|jpg|jpeg))");
    struct NamedView {
        fs::path path;
        double u, v;
    };
    std::map<std::pair<int, int>, NamedView> views;  // by row and column
    each_file(folder, [&](const std::string& name) {
        std::smatch part;
        if (name.size() > 200 || !std::regex_match(name, part, form)) return;
        const auto [at, fresh] = views.emplace(std::pair(std::stoi(part[1]), std::stoi(part[2])),
                                               NamedView{folder / name, number_of(part[4]), number_of(part[3])});
        if (!fresh)
            throw InputError((folder / name).string(),
                             fmt::format("has the same position in the grid as {}", at->second.path.filename().string()));
    });
    if (views.empty()) return {};
    ViewsSource source;
    source.form = ViewsForm::stanford;
    source.name = folder.string();
    source.in_mm = false;
    for (const auto& [at, view] : views) {
        source.rows = std::max(source.rows, at.first + 1);
        source.columns = std::max(source.columns, at.second + 1);
    }
    if (source.rows > most_views_a_side || source.columns > most_views_a_side)
        throw InputError(folder.string(), fmt::format("has a grid of {} x {} views by its names; allowed are {} along each side",
                                                      source.columns, source.rows, most_views_a_side));
    // The pictures row by row, and the sum of their cameras' positions.
    double u = 0, v = 0;
    for (int row = 0; row < source.rows; ++row)
        for (int column = 0; column < source.columns; ++column) {
            const auto found = views.find({row, column});
            if (found == views.end())
                throw InputError(
                    folder.string(),
                    fmt::format("the picture of row {}, column {} is missing (..._{:02}_{:02}_V_U.png); names go up to "
                                "row {}, column {}",
                                row, column, row, column, source.rows - 1, source.columns - 1));
            source.pictures.push_back(found->second.path);
            source.cameras.push_back({found->second.u, found->second.v});
            u += found->second.u;
            v += found->second.v;
        }
    // The sign of u and v differs from scene to scene; rows and columns are counted from the upper left, which decides it.
    // Positions are then from the mean of all.
    const double sign_u = source.cameras.front()[0] <= source.cameras.back()[0] ? 1 : -1,
                 sign_v = source.cameras.front()[1] >= source.cameras.back()[1] ? 1 : -1, n = double(views.size());
    for (auto& at : source.cameras) at = {sign_u * (at[0] - u / n), sign_v * (at[1] - v / n)};
    return source;
}

}  // namespace lfdsim::detail
