#include "view/server/messages.h"

#include "base/input_error.h"
#include "base/printable.h"
#include "files/description/json_text.h"

#include <nlohmann/json.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lfdsim::view {
namespace {

using Parsed = nlohmann::json;

constexpr int deepest_message = 3;  // levels: an object, a list or an object in it, and one more within those
constexpr std::size_t longest_text = 1000, most_settings = 100;
constexpr double farthest_eye_mm = 1e6;
constexpr std::int64_t largest_id = std::int64_t(1) << 53;  // above this a browser's numbers are not exact
constexpr std::int64_t least_side = 16, largest_side = 4096;

/// Parses JSON. Depth and keys are checked while it is parsed, before the parser takes memory for more.
Parsed parse(std::string_view text) {
    if (text.size() > longest_message)
        throw InputError("message", fmt::format("has {} bytes, allowed are {}", text.size(), longest_message));
    UniqueKeys<Parsed> unique("");
    const auto check = [&](int depth, Parsed::parse_event_t event, Parsed& value) {
        using Event = Parsed::parse_event_t;
        if ((event == Event::object_start || event == Event::array_start) && depth >= deepest_message)
            throw InputError("message", fmt::format("is nested more than {} levels deep", deepest_message));
        return unique(depth, event, value);
    };
    try {
        return Parsed::parse(text, check);
    } catch (const Parsed::parse_error& error) {
        throw InputError("message", fmt::format("is not JSON in UTF-8: byte {} is the first invalid one", error.byte));
    } catch (const Parsed::exception&) {  // the parser's error for numbers that are too large
        throw InputError("message", "has a number that is not finite");
    }
}

[[noreturn]] void refuse(const std::string& where, const Parsed& given, const std::string& wanted) {
    throw InputError(where, fmt::format("is {}, expected is {}", shortened(given.dump()), wanted));
}

double number(const Parsed& json, const std::string& where, double low, double high) {
    if (json.is_number())
        if (const double value = json.get<double>(); value >= low && value <= high) return value;
    refuse(where, json, fmt::format("a number from {} to {}", low, high));
}

std::int64_t whole(const Parsed& json, const std::string& where, std::int64_t low, std::int64_t high) {
    // json.get() would wrap numbers of 2^63 and more.
    const bool fits = json.is_number_integer() && (!json.is_number_unsigned() || json.get<std::uint64_t>() <= std::uint64_t(high));
    if (fits)
        if (const auto value = json.get<std::int64_t>(); value >= low && value <= high) return value;
    refuse(where, json, fmt::format("a whole number from {} to {}", low, high));
}

bool flag(const Parsed& json, const std::string& where) {
    if (!json.is_boolean()) refuse(where, json, "true or false");
    return json.get<bool>();
}

std::string text(const Parsed& json, const std::string& where) {
    if (json.is_string()) {
        const auto& value = json.get_ref<const std::string&>();
        const bool plain = std::none_of(value.begin(), value.end(), [](char c) { return (unsigned char)(c) < 32 || c == 127; });
        if (plain && value.size() <= longest_text) return value;
    }
    refuse(where, json, fmt::format("a text of at most {} bytes without control characters", longest_text));
}

/// Returns the index of a text in a list of words.
template <std::size_t count>
std::size_t choice(const Parsed& json, const std::string& where, const std::string_view (&words)[count]) {
    if (json.is_string())
        for (std::size_t i = 0; i < count; ++i)
            if (json.get_ref<const std::string&>() == words[i]) return i;
    refuse(where, json, fmt::format("one of {}", fmt::join(words, ", ")));
}

const Parsed& list(const Parsed& json, const std::string& where, std::size_t least, std::size_t most) {
    if (!json.is_array() || json.size() < least || json.size() > most)
        refuse(where, json, least == most ? fmt::format("a list of {}", most) : fmt::format("a list of at most {}", most));
    return json;
}

/// An object whose keys are taken one by one; keys left over at the end are errors.
class Object {
  public:
    Object(const Parsed& json, std::string where) : json_(json), where_(std::move(where)) {
        if (!json.is_object()) refuse(where_, json, "an object");
    }
    const Parsed* find(const char* key) {
        const auto found = json_.find(key);
        if (found == json_.end()) return nullptr;
        taken_.insert(key);
        return &*found;
    }
    const Parsed& at(const char* key) {
        if (const Parsed* found = find(key)) return *found;
        throw InputError(key, "is missing in " + where_);
    }
    void finish() const {
        for (const auto& [key, value] : json_.items())
            if (!taken_.contains(key)) throw InputError(shortened(key), "is unknown in " + where_);
    }

  private:
    const Parsed& json_;
    std::string where_;
    std::set<std::string, std::less<>> taken_;
};

Shown shown(const Parsed& json) {
    Object object(json, "shown");
    Shown shown;
    shown.kind = Shown::Kind(choice(object.at("kind"), "kind", {"start", "model", "panel_image", "pattern"}));
    if (const Parsed* name = object.find("name")) shown.name = text(*name, "name");
    if (const Parsed* hold = object.find("hold")) shown.hold = flag(*hold, "hold");
    if (shown.kind != Shown::Kind::start && shown.name.empty()) throw InputError("name", "is missing in shown");
    object.finish();
    return shown;
}

Wanted wanted(Object& object) {
    Wanted w;
    w.id = whole(object.at("id"), "id", 0, largest_id);
    w.display = text(object.at("display"), "display");
    for (const Parsed& one : list(object.at("set"), "set", 0, most_settings)) w.set.push_back(text(one, "set"));
    w.shown = shown(object.at("shown"));
    const Parsed& eye = list(object.at("eye_mm"), "eye_mm", 3, 3);
    for (std::size_t a = 0; a < 3; ++a) w.eye_mm[a] = number(eye[a], "eye_mm", -farthest_eye_mm, farthest_eye_mm);
    const Parsed& size = list(object.at("size"), "size", 2, 2);
    for (std::size_t a = 0; a < 2; ++a) w.size[a] = int(whole(size[a], "size", least_side, largest_side));
    if (w.size[0] * w.size[1] > most_pixels) refuse("size", size, fmt::format("{} pixels or fewer", most_pixels));
    w.layout = Layout(choice(object.at("layout"), "layout", {"one", "pair", "crossed"}));
    w.eye_distance_mm = number(object.at("eye_distance_mm"), "eye_distance_mm", 0, 1000);
    w.beside = Beside(choice(object.at("beside"), "beside", {"none", "photograph", "difference"}));
    w.moving = flag(object.at("moving"), "moving");
    return w;
}

Ask ask(Object& object) {
    Ask a;
    a.id = whole(object.at("id"), "id", 0, largest_id);
    a.what = Ask::What(choice(object.at("what"), "what", question_words));
    const auto name_of = [&]<std::size_t count>(const std::string_view(&names)[count]) {
        return std::string(names[choice(object.at("name"), "name", names)]);
    };
    if (a.what == Ask::What::probe) {
        const Parsed& at = list(object.at("at"), "at", 2, 2);
        for (std::size_t i = 0; i < 2; ++i) a.at[i] = number(at[i], "at", 0, 1);
    }
    if (a.what == Ask::What::side) a.name = name_of({"display", "lens"});
    if (a.what == Ask::What::plot) {
        a.name = name_of({"fov", "spot"});
        if (const Parsed* width = object.find("width")) a.width = number(*width, "width", least_plot_width, 2 * plot_width);
    }
    if (a.what == Ask::What::save) {
        a.name = text(object.at("name"), "name");
        if (const Parsed* overwrite = object.find("overwrite")) a.overwrite = flag(*overwrite, "overwrite");
    }
    return a;
}

}  // namespace

Message parse_message(std::string_view message) {
    const Parsed json = parse(message);
    Object object(json, "the message");
    const bool is_ask = choice(object.at("type"), "type", {"show", "ask"}) == 1;
    const Message parsed = is_ask ? Message(ask(object)) : Message(wanted(object));
    object.finish();
    return parsed;
}

}  // namespace lfdsim::view
