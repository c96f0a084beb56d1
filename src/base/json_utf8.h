// JSON as text, whatever bytes its names have. Floor 0; what includes it links JSON for Modern C++.
#pragma once
#include "base/printable.h"

#include <nlohmann/json.hpp>

#include <string>

namespace lfdsim {

/// Returns JSON as text, on one line or indented by this number of blanks. Bytes that are not UTF-8, as names of files may have
/// them, are replaced; numbers that are not finite become null.
template <class Json>
std::string json_utf8(const Json& json, int indent = -1) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

/// Returns the content of a .json file, in which characters that control a terminal are escaped.
template <class Json>
std::string json_file(const Json& json) {
    return printable_lines(json_utf8(json, 2)) + "\n";
}

}  // namespace lfdsim
