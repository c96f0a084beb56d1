// JSON that users give: parsing, with keys that may be given once, and kinds of values in words. Floor 2.
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/input_error.h"
#include "base/printable.h"
#include "files/description/text_file.h"

namespace lfdsim {

/// Returns what a value is, in words: "a text".
template <class Json>
std::string_view kind_of_json(const Json& json) {
    return json.is_number()    ? "a number"
           : json.is_string()  ? "a text"
           : json.is_boolean() ? "true or false"
           : json.is_array()   ? "a list"
           : json.is_object()  ? "an object"
                               : "null";
}

/// A callback of the parser. Throws InputError for a key that an object has twice, of which the parser would keep the last.
template <class Json>
class UniqueKeys {
  public:
    /// Places in errors begin with `before`, such as "file.json: ".
    explicit UniqueKeys(std::string before) : before_(std::move(before)) {}

    bool operator()(int /*depth*/, typename Json::parse_event_t event, Json& value) {
        using Event = typename Json::parse_event_t;
        if (event == Event::object_end || event == Event::array_end) {
            open_.pop_back();
        } else if (event == Event::key) {
            open_.back().key = value.template get<std::string>();
            if (!open_.back().keys.insert(open_.back().key).second) throw InputError(before_ + place(), "is given twice");
        } else {  // an element begins
            if (!open_.empty()) ++open_.back().count;
            if (event != Event::value) open_.push_back({event == Event::array_start});
        }
        return true;
    }

  private:
    /// A list or object that is open.
    struct Open {
        bool list;
        std::size_t count = 0;  // of its elements so far
        std::string key = {};   // the last one
        std::set<std::string> keys = {};
    };

    std::string place() const {
        std::string all;
        for (const Open& one : open_) {
            if (one.list)
                all += fmt::format("[{}]", one.count - 1);
            else
                all += (all.empty() ? "" : ".") + shortened(one.key);
        }
        return all;
    }

    std::string before_;
    std::vector<Open> open_;
};

/// Parses the JSON of a file. Throws InputError with the file's name for more than 1 MiB, for a key that is given twice, and, with
/// the words `is_not` ("is not JSON") and the parser's, for what is not JSON.
template <class Json>
Json parse_json(std::string_view text, std::string_view name, std::string_view is_not) {
    if (text.size() > largest_text_bytes)
        throw InputError(std::string(name), fmt::format("has {} bytes, allowed are {}", text.size(), largest_text_bytes));
    try {
        return Json::parse(text, UniqueKeys<Json>(fmt::format("{}: ", name)));
    } catch (const typename Json::exception& error) {
        const std::string says = error.what();  // "[json.exception.parse_error.101] parse error at line 1, column 1: ..."
        const std::size_t begin = says.find("] ") + 2, end = std::min(says.find("; last read"), begin + 160);
        throw InputError(std::string(name), fmt::format("{}: {}", is_not, says.substr(begin, end - begin)));
    }
}

}  // namespace lfdsim
