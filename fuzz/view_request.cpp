// Any bytes sent to the viewer as a request: an answer that says no, unless they name the server and know the token. Anything else
// is a crash.
#include "view/server/http.h"

#include <boost/beast/http/parser.hpp>
#include <cstdlib>
#include <string_view>

namespace http = boost::beast::http;

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    using namespace lfdsim::view;
    http::request_parser<http::empty_body> parser;
    parser.header_limit(8192);
    boost::beast::error_code error;
    parser.put(boost::asio::buffer(data, size), error);
    if (error || !parser.is_header_done()) return 0;
    static const std::string token(32, 'a'), page = "<html><script>1</script></html>";
    const Request& request = parser.get();
    const std::optional<Response> answer = respond(request, {"127.0.0.1", 8080, "name"}, token, page);
    const auto target = request.target();
    const bool knows = std::string_view(target.data(), target.size()).find(token) != std::string_view::npos;
    if (!knows && (!answer || answer->result() == http::status::ok)) std::abort();
    return 0;
}
