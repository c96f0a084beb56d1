// Who may talk to the viewer: token, Host and Origin. Floor 5.
#pragma once
#include <string>
#include <string_view>

namespace lfdsim::view {

/// 128 random bits of the system, as 32 hexadecimal digits.
std::string make_token();

/// Takes as long wherever the two differ.
bool same_token(std::string_view given, std::string_view wanted);

/// What a request's headers are held against. A page of another site may send requests here, and by its own name for this address
/// (DNS rebinding) even read the answers: so the name that was asked for must be one that nobody else can own.
struct Gate {
    std::string host;      // that the server listens on: an address or a name
    int port = 0;          // that it listens on
    std::string own_name;  // of this machine: gethostname()

    /// Header Host: `localhost` and loopback addresses with any port, since an ssh tunnel may have another one at its end; else,
    /// with our port, the host that is listened on. Listening on all addresses (0.0.0.0, ::), any numeric address or the machine's
    /// name, whole, without its domain or with `.local`.
    bool lets_host(std::string_view host_header) const;
};

/// Header Origin of a page that came from the host of that header Host over plain HTTP.
bool same_origin(std::string_view origin, std::string_view host_header);

/// Value of `token` in a request's target, "/?token=..."; empty where there is none.
std::string_view token_of(std::string_view target);

}  // namespace lfdsim::view
