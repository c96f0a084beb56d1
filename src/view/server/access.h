// Who may access the viewer: token, Host and Origin. Floor 5.
#pragma once
#include <string>
#include <string_view>

namespace lfdsim::view {

/// Returns 128 random bits from the system, as 32 hexadecimal digits.
std::string make_token();

/// Whether two tokens are equal. It takes the same time wherever they differ, so that the time does not betray how much is right.
bool same_token(std::string_view given, std::string_view wanted);

/// The check of a request's Host header. A page of another site may send requests here and, under that site's name for this address
/// (DNS rebinding), even read the answers: so the requested name must be one that no other site can have.
struct Gate {
    std::string host;      // that the server listens on: an address or a name
    int port = 0;          // that it listens on
    std::string own_name;  // of this machine: gethostname()

    /// Whether a request with this header Host is allowed. Names may be `localhost` and loopback addresses with any port, since an
    /// ssh tunnel may end at another one; otherwise, with the server's port, the host that it listens on. If it listens on all
    /// addresses (0.0.0.0, ::), any numeric address, or the machine's name in full, without its domain or with `.local`.
    bool lets_host(std::string_view host_header) const;
};

/// Whether the header Origin is that of a page from the host in the header Host, over plain HTTP.
bool same_origin(std::string_view origin, std::string_view host_header);

/// Returns the value of `token` in a request's target, "/?token=..."; empty where there is none.
std::string_view token_of(std::string_view target);

}  // namespace lfdsim::view
