#include "files/description/path_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "base/printable.h"
#include "base/problems.h"
#include "files/description/json_text.h"
#include "files/description/nearest.h"
#include "files/description/text_file.h"

namespace lfdsim {
namespace {

using Json = nlohmann::json;

constexpr double most_frames_per_second = 1000;

/// Reads values and collects their faults. What is refused is read as 0, so that all faults are found.
class PathReader {
  public:
    explicit PathReader(std::string_view name) : name_(name) {}

    template <class... Values>
    void refuse(const std::string& place, fmt::format_string<Values...> what, Values&&... values) {
        problems_.add(fmt::format("{}: {}", name_, place), what, std::forward<Values>(values)...);
    }
    void report() const { problems_.report(); }

    /// Whether a value is an object with the first `required` of these keys; any key that is not among them is refused, too.
    bool object(const Json& json, const std::string& place, std::span<const std::string_view> keys, std::size_t required) {
        if (!json.is_object()) {
            refuse(place, "is {}; give an object with {}", kind_of_json(json), fmt::join(keys, ", "));
            return false;
        }
        bool complete = true;
        for (const std::string_view key : keys.first(required))
            if (!json.contains(key)) {
                refuse(place, "{} is missing", key);
                complete = false;
            }
        for (const auto& [key, value] : json.items())
            if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
                const std::string_view near = nearest(key, keys);
                refuse(place, "unknown key \"{}\"{}", shortened(key), near.empty() ? "" : fmt::format("; did you mean {}?", near));
            }
        return complete;
    }
    /// Returns the number, or nothing where the value is refused.
    std::optional<double> number(const Json& json, const std::string& place) {
        if (json.is_number()) return json.get<double>();  // the parser refuses infinite ones
        refuse(place, "is {}; give a number", kind_of_json(json));
        return {};
    }
    Vec3d point(const Json& json, const std::string& place) {
        Vec3d xyz{};
        if (!json.is_array() || json.size() != 3)
            refuse(place, "give three numbers: x, y, z in mm");
        else
            for (std::size_t i = 0; i < 3; ++i) xyz[i] = number(json[i], fmt::format("{}[{}]", place, i)).value_or(0);
        return xyz;
    }

  private:
    std::string name_;
    Problems problems_{Problems::most_of_a_file};
};

constexpr std::string_view path_keys[] = {"schema", "frames_per_second", "poses"};
constexpr std::string_view pose_keys[] = {"time_s", "position_mm", "target_mm"};

// Returns the path's length in frames. Times come from clocks and rounded decimals: a last pose up to a millionth of a frame before
// the time of a frame still counts as at that frame.
double frame_steps(const CameraPath& path) { return path.poses.back().time_s * path.frames_per_second + 1e-6; }

Vec3d between(const Vec3d& a, const Vec3d& b, double share) {
    Vec3d p{};
    for (std::size_t i = 0; i < 3; ++i) p[i] = a[i] + (b[i] - a[i]) * share;
    return p;
}

}  // namespace

std::int64_t CameraPath::frames() const { return std::int64_t(frame_steps(*this)) + 1; }

double CameraPath::time_s(std::int64_t frame) const { return std::min(double(frame) / frames_per_second, poses.back().time_s); }

Camera CameraPath::camera(std::int64_t frame, Camera described) const {
    const double time = time_s(frame);
    const auto after = std::upper_bound(poses.begin(), poses.end(), time,
                                        [](double seconds, const CameraPose& pose) { return seconds < pose.time_s; });
    const CameraPose &a = *(after - 1), &b = after == poses.end() ? a : *after;  // the first pose is at 0: there is one before
    const double share = b.time_s > a.time_s ? (time - a.time_s) / (b.time_s - a.time_s) : 0;
    described.position_mm = between(a.position_mm, b.position_mm, share);
    if (a.target_mm || b.target_mm)
        described.target_mm = between(a.target_mm.value_or(described.target_mm), b.target_mm.value_or(described.target_mm), share);
    return described;
}

CameraPath read_path(const std::filesystem::path& path) { return parse_path(read_text(path, "a camera path"), path.string()); }

CameraPath parse_path(std::string_view text, std::string_view name) {
    Json json = parse_json<Json>(text, name, "is not a camera path in JSON");
    // The head of the file.
    PathReader reader(name);
    CameraPath path;
    if (!reader.object(json, "the file", path_keys, 3)) reader.report();
    if (json["schema"] != 1) reader.refuse("schema", "only 1 is known");
    if (const std::optional<double> rate = reader.number(json["frames_per_second"], "frames_per_second")) {
        path.frames_per_second = *rate;
        if (!(*rate > 0 && *rate <= most_frames_per_second))
            reader.refuse("frames_per_second", "is {}; allowed is more than 0, up to {}", *rate, most_frames_per_second);
    }
    // The poses, whose times rise from 0.
    const Json& poses = json["poses"];
    if (!poses.is_array() || poses.empty()) reader.refuse("poses", "give a list of one pose or more");
    for (std::size_t i = 0; poses.is_array() && i < poses.size(); ++i) {
        const std::string place = fmt::format("poses[{}]", i);
        CameraPose pose;
        if (!reader.object(poses[i], place, pose_keys, 2)) continue;
        const std::optional<double> time = reader.number(poses[i]["time_s"], place + ".time_s");
        pose.position_mm = reader.point(poses[i]["position_mm"], place + ".position_mm");
        if (poses[i].contains("target_mm")) pose.target_mm = reader.point(poses[i]["target_mm"], place + ".target_mm");
        pose.time_s = time.value_or(path.poses.empty() ? 0 : path.poses.back().time_s);
        if (time && path.poses.empty() && *time != 0)
            reader.refuse(place + ".time_s", "is {}; the first pose is at 0", *time);
        else if (time && !path.poses.empty() && !(*time > path.poses.back().time_s))
            reader.refuse(place + ".time_s", "is {}, not later than the pose before, at {}", *time, path.poses.back().time_s);
        path.poses.push_back(pose);
    }
    reader.report();
    if (!(frame_steps(path) < double(most_path_frames)))
        reader.refuse("poses", "last {} s, which is more than the {} frames allowed", path.poses.back().time_s, most_path_frames);
    reader.report();
    return path;
}

}  // namespace lfdsim
