#include "view/server/access.h"

#include "base/text.h"
#include "base/whole_text.h"

#include <fmt/format.h>
#include <algorithm>
#include <boost/asio/ip/address.hpp>
#include <optional>
#include <random>

namespace lfdsim::view {
namespace {

using boost::asio::ip::address;

std::optional<address> numeric(std::string_view name) {
    boost::system::error_code error;
    const address found = boost::asio::ip::make_address(std::string(name), error);
    return error ? std::nullopt : std::optional(found);
}

struct HostAndPort {
    std::string_view name;
    int port;
};

/// Returns the parts of "name", "name:port" or "[IPv6]:port"; the port is 80 where none is given. Nothing for other texts.
std::optional<HostAndPort> split(std::string_view header) {
    HostAndPort parts{header, 80};
    const bool bracket = header.starts_with('[');
    const std::size_t end = bracket ? header.find(']') : header.find(':');
    if (bracket && end == header.npos) return std::nullopt;
    if (end != header.npos) {
        parts.name = bracket ? header.substr(1, end - 1) : header.substr(0, end);
        std::string_view port = header.substr(bracket ? end + 1 : end);
        if (!port.empty()) {
            if (port.front() != ':') return std::nullopt;
            port.remove_prefix(1);
            parts.port = whole_text<int>(port).value_or(0);
        }
    }
    if (parts.name.empty() || parts.port < 1 || parts.port > 65535) return std::nullopt;
    return parts;
}

}  // namespace

std::string make_token() {
    std::random_device random;  // the system's random numbers, with libstdc++ on Linux
    std::string token;
    for (int k = 0; k < 4; ++k) token += fmt::format("{:08x}", random());
    return token;
}

bool same_token(std::string_view given, std::string_view wanted) {
    if (given.size() != wanted.size()) return false;
    unsigned difference = 0;
    for (std::size_t k = 0; k < given.size(); ++k) difference |= unsigned(given[k] ^ wanted[k]);
    return difference == 0;
}

bool Gate::lets_host(std::string_view host_header) const {
    const auto asked = split(host_header);
    if (!asked) return false;
    const auto number = numeric(asked->name);
    if (same_without_case(asked->name, "localhost") || (number && number->is_loopback())) return true;
    if (asked->port != port) return false;
    const auto own = numeric(host);
    if (number ? number == own : same_without_case(asked->name, host)) return true;
    if (!own || !own->is_unspecified()) return false;
    const std::string first = own_name.substr(0, own_name.find('.'));
    return number || (!first.empty() && (same_without_case(asked->name, own_name) || same_without_case(asked->name, first) ||
                                         same_without_case(asked->name, first + ".local")));
}

bool same_origin(std::string_view origin, std::string_view host_header) {
    constexpr std::string_view scheme = "http://";
    return origin.starts_with(scheme) && same_without_case(origin.substr(scheme.size()), host_header);
}

std::string_view token_of(std::string_view target) {
    std::string_view rest = target.substr(std::min(target.find('?'), target.size()));
    while (!rest.empty()) {
        rest.remove_prefix(1);  // '?' or '&'
        const std::string_view part = rest.substr(0, rest.find('&'));
        constexpr std::string_view key = "token=";
        if (part.starts_with(key)) return part.substr(key.size());
        rest.remove_prefix(part.size());
    }
    return {};
}

}  // namespace lfdsim::view
