// Serves echoes until its standard input ends; says its port and token, and at the end what it counted. For attacks.py.
#include "echo.h"
#include "view/server/access.h"

#include <fmt/format.h>
#include <cstdio>

int main() {
    using namespace lfdsim::view;
    Guests guests;
    const std::string token = make_token();
    ServerOptions options;
    options.token = token;
    ServerCounts counts;
    {
        const Server server(options, "<!doctype html><script>1</script>",
                            [&](Outbox& o) { return std::make_unique<Echo>(o, guests); });
        fmt::print("{} {}\n", server.port(), token);
        std::fflush(stdout);
        while (std::getchar() != EOF) {
        }
        counts = server.counts();
    }
    fmt::print("visitors {} destroyed {} malformed {} messages {}\n", counts.visitors, guests.destroyed, counts.malformed,
               counts.messages);
    return guests.made == guests.destroyed && guests.destroyed_at_work == 0 ? 0 : 1;
}
