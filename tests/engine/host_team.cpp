#include "host_team.h"

#include <ucontext.h>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>

thread_local ThreadIndex threadIdx{};

namespace lfdsim::host_team {
namespace {

constexpr std::size_t stack_bytes = 512 << 10;

struct Shown {
    const char* what;
    std::uint32_t bits;
};

/// Fibers run in turn, each until it shows something or ends: when the first runs on, all have shown theirs. What it shows then
/// goes to the other half of `shown`, as the others have still to look at the first.
struct Team {
    ucontext_t caller;
    std::array<ucontext_t, threads> fiber;
    std::array<std::unique_ptr<char[]>, threads> stack;
    std::array<int, threads> count{};  // of what each has shown
    std::array<std::array<Shown, threads>, 2> shown{};
    int running = 0;
    unsigned first = 0;
    void (*work)(const void*, int) = nullptr;
    const void* with = nullptr;

    void pass_on(ucontext_t& from, bool ended) {
        const int me = running;
        running = (me + 1) % threads;
        threadIdx.x = first + unsigned(running);
        swapcontext(&from, ended && me + 1 == threads ? &caller : &fiber[std::size_t(running)]);
        running = me;
        threadIdx.x = first + unsigned(me);
    }
};
thread_local std::unique_ptr<Team> team;

void fiber_main() {
    team->work(team->with, team->running);
    team->pass_on(team->fiber[std::size_t(team->running)], true);
}

}  // namespace

void run(unsigned first, void (*work)(const void*, int), const void* with) {
    if (!team) {
        team = std::make_unique<Team>();
        for (auto& stack : team->stack) stack = std::make_unique<char[]>(stack_bytes);
    }
    team->first = first;
    team->work = work;
    team->with = with;
    team->count.fill(0);
    for (std::size_t k = 0; k < threads; ++k) {
        ucontext_t& fiber = team->fiber[k];
        getcontext(&fiber);
        fiber.uc_stack.ss_sp = team->stack[k].get();
        fiber.uc_stack.ss_size = stack_bytes;
        fiber.uc_link = nullptr;
        makecontext(&fiber, fiber_main, 0);
    }
    team->running = 0;
    threadIdx.x = first;
    swapcontext(&team->caller, &team->fiber[0]);
    for (const int count : team->count) {
        if (count == team->count[0]) continue;
        std::fprintf(stderr, "a team's threads exchanged %d and %d numbers\n", team->count[0], count);
        std::abort();
    }
}

void show(const char* what, std::uint32_t bits) {
    const auto me = std::size_t(team->running);
    team->shown[std::size_t(team->count[me]++ % 2)][me] = {what, bits};
    team->pass_on(team->fiber[me], false);
    const auto& all = team->shown[std::size_t((team->count[me] - 1) % 2)];
    for (const Shown& other : all) {
        if (std::strcmp(other.what, what) == 0) continue;
        std::fprintf(stderr, "a team's threads parted: %s and %s\n", what, other.what);
        std::abort();
    }
}

std::uint32_t shown_by(int thread) {
    const auto me = std::size_t(team->running);
    return team->shown[std::size_t((team->count[me] - 1) % 2)][std::size_t(thread)].bits;
}

int own_number() { return team->running; }

}  // namespace lfdsim::host_team
