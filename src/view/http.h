// What the server answers to one HTTP request. Floor 5.
#pragma once
#include "view/access.h"

#include <boost/beast/http.hpp>
#include <optional>
#include <string>

namespace lfdsim::view {

using Request = boost::beast::http::request<boost::beast::http::empty_body>;
using Response = boost::beast::http::response<boost::beast::http::string_body>;

/// A sentence; the connection ends with it.
Response sentence(boost::beast::http::status, const std::string& text);

/// Nothing: a WebSocket that is let in. Of the page, elements script and style are
/// given the nonce that its policy asks for; no attribute of an element can run anything.
std::optional<Response> respond(const Request&, const Gate&, const std::string& token, const std::string& page);

}  // namespace lfdsim::view
