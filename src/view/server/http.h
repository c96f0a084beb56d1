// The server's answer to one HTTP request, as a pure function of the request. Floor 5.
#pragma once
#include "view/server/access.h"

#include <boost/beast/http.hpp>
#include <optional>
#include <string>

namespace lfdsim::view {

using Request = boost::beast::http::request<boost::beast::http::empty_body>;
using Response = boost::beast::http::response<boost::beast::http::string_body>;

/// Returns a response of one sentence, which ends the connection.
Response sentence(boost::beast::http::status, const std::string& text);

/// Returns the response to a request; nothing for a WebSocket that is accepted. Requests are refused by their Host, path, method,
/// token and Origin, in this order. In the page, the elements script and style get the nonce that its Content-Security-Policy
/// requires; no attribute of an element can run anything.
std::optional<Response> respond(const Request&, const Gate&, const std::string& token, const std::string& page);

}  // namespace lfdsim::view
