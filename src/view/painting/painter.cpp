#include "view/painting/painter.h"

#include "view/answers/answers.h"
#include "view/painting/drawing.h"
#include "view/painting/painter_job.h"

#include <tbb/task_arena.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <new>
#include <optional>
#include <thread>

namespace lfdsim::view {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto settling = 80ms;   // after a change another one is likely, so no long work is started
constexpr auto standing = 300ms;  // after which the sharp picture is made although the page still says `moving`
constexpr auto poll_outbox = 2ms;

std::vector<std::string> lanes(const Wanted& w) {
    std::vector<std::string> all{"one"};
    if (w.layout != Layout::one) all = {"left", "right"};
    if (w.beside == Beside::photograph) all.push_back("photograph");
    if (w.beside == Beside::difference) all.push_back("difference");
    return all;
}

}  // namespace

struct Painter::Impl {
    Impl(const Library& library, Panels& panels, Outbox& to, int threads)
        : outbox(to), arena(threads > 0 ? threads : tbb::task_arena::automatic), drawing(library, panels, threads) {
        thread = std::thread([this] { run(); });
    }
    ~Impl() {
        {
            const std::lock_guard lock(mutex);
            ended = true;
        }
        changed.notify_all();
        thread.join();
    }

    // Called only by the thread, except newer() and stopped().
    void run();
    std::optional<std::int64_t> asked() const;
    bool next();
    void paint();
    bool rests();
    void send(Drawing::Frames);
    void tell_problems(const std::vector<Problem>&);
    template <class Do>
    bool guarded(const Do&);

    bool newer() const {
        const std::lock_guard lock(mutex);
        return ended || (wanted && wanted->id != now.id);
    }
    /// Whether a different state is wanted, so that even a coarse picture of this one would be useless.
    bool other() const {
        const std::lock_guard lock(mutex);
        return ended || (wanted && (wanted->display != now.display || !(wanted->shown == now.shown)));
    }
    PainterJob work(bool (Impl::*cancelled)() const) {
        return PainterJob(
            [this, cancelled] { return (this->*cancelled)(); },
            [this](const std::string& what, double share) {
                outbox.text(nlohmann::ordered_json{{"type", "progress"}, {"id", now.id}, {"what", what}, {"share", share}}.dump());
            });
    }

    Outbox& outbox;
    tbb::task_arena arena;
    Drawing drawing;

    mutable std::mutex mutex;  // protects the members up to changed_at
    std::condition_variable changed;
    bool ended = false;
    std::optional<Wanted> wanted;
    std::optional<std::int64_t> exr;
    Clock::time_point changed_at;

    Wanted now;           // the state that the thread works on; written with the mutex held
    bool painted = true;  // its pictures are done
    bool shown = false;   // a picture of it has been sent
    std::thread thread;
};

Painter::Painter(const Library& library, Panels& panels, Outbox& outbox, int threads)
    : impl_(std::make_unique<Impl>(library, panels, outbox, threads)) {}

Painter::~Painter() = default;

void Painter::want(const Wanted& wanted) {
    {
        const std::lock_guard lock(impl_->mutex);
        if (impl_->wanted && wanted.id <= impl_->wanted->id) return;  // ids of frames must not fall
        if (!impl_->wanted || !same_state(*impl_->wanted, wanted)) impl_->changed_at = Clock::now();
        impl_->wanted = wanted;
    }
    impl_->changed.notify_all();
}

void Painter::want_exr(std::int64_t id) {
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->exr = id;
    }
    impl_->changed.notify_all();
}

/// Waits for something to do; returns false if the painter is to end. A new state is taken when the outbox has sent the pictures
/// before it.
bool Painter::Impl::next() {
    std::unique_lock lock(mutex);
    const auto todo = [&] { return ended || (wanted && (wanted->id != now.id || exr)); };
    changed.wait(lock, todo);
    // The outbox does not notify, so it is polled. The state that is wanted when it is free again counts.
    for (;;) {
        if (ended) return false;
        if (wanted->id == now.id) return true;
        const std::vector<std::string> names = lanes(*wanted);
        lock.unlock();
        const bool busy = std::any_of(names.begin(), names.end(), [&](const auto& lane) { return outbox.busy(lane); });
        lock.lock();
        if (!busy) break;
        changed.wait_for(lock, poll_outbox, [&] { return ended; });
    }
    if (ended) return false;
    shown = shown && same_state(now, *wanted);
    now = *wanted;
    painted = false;
    return true;
}

/// Does the work and sends errors as problems; returns false if it was stopped for something newer.
template <class Do>
bool Painter::Impl::guarded(const Do& what) {
    try {
        arena.execute(what);
    } catch (const Stopped&) {
        return false;
    } catch (const InputError& error) {
        tell_problems(error.problems);
    } catch (const std::bad_alloc&) {
        tell_problems({{"", "there is not enough memory for this"}});
    } catch (const std::exception& error) {
        tell_problems({{"", error.what()}});
    }
    return true;
}

void Painter::Impl::run() {
    while (next()) {
        if (!painted) painted = guarded([&] { paint(); });
        const std::optional<std::int64_t> file = asked();
        if (!file) continue;
        const bool done = guarded([&] {
            PainterJob job = work(&Impl::newer);
            Drawing::DrawnFrame frame = drawing.exr(*file, job);
            outbox.frame(frame.lane, std::move(frame.bytes));
        });
        const std::lock_guard lock(mutex);
        if (done && exr == file) exr.reset();
    }
}

/// Returns the id of the file that is wanted for the current state, if that is painted and still the newest.
std::optional<std::int64_t> Painter::Impl::asked() const {
    const std::lock_guard lock(mutex);
    return painted && wanted->id == now.id ? exr : std::nullopt;
}

void Painter::Impl::paint() {
    drawing.begin(now);
    if (const std::string why = drawing.beside_problem(); !why.empty()) tell_problems({{"beside", why}});
    if (!shown) {
        PainterJob job = work(&Impl::other);
        send(drawing.coarse(job));
    }
    if (!rests()) return;
    PainterJob job = work(&Impl::newer);
    if (drawing.wants_fine()) send(drawing.fine(job));
    send(drawing.final(job));
}

/// Waits until the state is likely to stay; returns false if another one was wanted in the meantime.
bool Painter::Impl::rests() {
    std::unique_lock lock(mutex);
    const auto at = changed_at + (now.moving ? Clock::duration(standing) : Clock::duration(settling));
    return !changed.wait_until(lock, at, [&] { return ended || wanted->id != now.id; });
}

void Painter::Impl::send(Drawing::Frames frames) {
    for (Drawing::DrawnFrame& frame : frames) outbox.frame(frame.lane, std::move(frame.bytes));
    shown = true;
}

void Painter::Impl::tell_problems(const std::vector<Problem>& problems) { outbox.text(problems_message(now.id, problems).dump()); }

}  // namespace lfdsim::view
