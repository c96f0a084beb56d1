#include "view/server/http.h"

#include <fmt/format.h>
#include <algorithm>
#include <boost/beast/websocket/rfc6455.hpp>
#include <string_view>

namespace lfdsim::view {

namespace http = boost::beast::http;

namespace {

std::string_view view(boost::beast::string_view text) { return {text.data(), text.size()}; }

/// Returns the page with a nonce in each element script and style; their contents are not changed.
std::string with_nonce(std::string_view page, const std::string& nonce) {
    std::string text;
    while (true) {
        const std::size_t script = page.find("<script"), style = page.find("<style");
        if (script == page.npos && style == page.npos) return text.append(page);
        const std::string_view name = script < style ? "script" : "style";
        const std::size_t inside = std::min(script, style) + 1 + name.size();
        text.append(page.substr(0, inside)).append(fmt::format(" nonce=\"{}\"", nonce));
        page.remove_prefix(inside);
        const std::size_t end = std::min(page.find(fmt::format("</{}", name)), page.size());
        text.append(page.substr(0, end));
        page.remove_prefix(end);
    }
}

Response page_response(const std::string& page) {
    const std::string nonce = make_token();
    Response r(http::status::ok, 11, with_nonce(page, nonce));
    r.set(http::field::content_type, "text/html; charset=utf-8");
    // Drawings in the page have style attributes, which cannot have a nonce.
    r.set("Content-Security-Policy",
          fmt::format("default-src 'none'; script-src 'nonce-{0}'; style-src 'nonce-{0}'; style-src-attr 'unsafe-inline'; "
                      "img-src blob: data:; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
                      nonce));
    return r;
}

/// Returns a response with the headers that all responses have.
Response finished(Response r) {
    r.set(http::field::cache_control, "no-store");
    r.set("X-Content-Type-Options", "nosniff");
    r.set("Referrer-Policy", "no-referrer");  // the page's address has the token
    r.set("Cross-Origin-Resource-Policy", "same-origin");
    r.keep_alive(false);
    r.prepare_payload();
    return r;
}

}  // namespace

Response sentence(http::status status, const std::string& text) {
    Response r(status, 11, text + "\n");
    r.set(http::field::content_type, "text/plain; charset=utf-8");
    return finished(std::move(r));
}

std::optional<Response> respond(const Request& request, const Gate& gate, const std::string& token, const std::string& page) {
    const std::string_view host = view(request[http::field::host]), target = view(request.target());
    const std::string_view path = target.substr(0, target.find('?'));
    if (request.count(http::field::host) != 1 || !gate.lets_host(host))
        return sentence(http::status::forbidden, "The viewer cannot be reached under this name. Open the address that it printed.");
    if (path != "/" && path != "/socket") return sentence(http::status::not_found, "There is nothing at this address.");
    if (request.method() != http::verb::get) {
        Response r = sentence(http::status::method_not_allowed, "Only GET is allowed here.");
        r.set(http::field::allow, "GET");
        return r;
    }
    if (!same_token(token_of(target), token))
        return sentence(http::status::forbidden, "The address needs the token. Open the whole address that the viewer printed.");
    const std::size_t origins = request.count(http::field::origin);
    if (origins > 1 || (origins == 1 && !same_origin(view(request[http::field::origin]), host)))
        return sentence(http::status::forbidden, "Pages of other sites may not connect to the viewer.");
    if (path == "/") return finished(page_response(page));
    if (!boost::beast::websocket::is_upgrade(request))
        return sentence(http::status::upgrade_required, "Only a WebSocket is served here.");
    return std::nullopt;
}

}  // namespace lfdsim::view
