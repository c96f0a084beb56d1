#include "view/server/visit.h"

#include "content/content.h"
#include "files/description/display_file.h"
#include "view/answers/answers.h"

#include <utility>

namespace lfdsim::view {
namespace {

// Whether two states have the same controls and figures: everything else (eye, size, layout) affects only the command.
bool same_controls(const Wanted& a, const Wanted& b) { return a.display == b.display && a.set == b.set && a.shown == b.shown; }

Json hello(const Library& library, const std::string& version) {
    const Start& start = library.start();
    const Display display = read_display(start.display, start.set);
    const Shown shown = library.shown({});
    const char* const kind = shown.kind == Shown::Kind::pattern       ? "pattern"
                             : shown.kind == Shown::Kind::panel_image ? "panel_image"
                                                                      : "model";
    const std::filesystem::path file = shown.kind == Shown::Kind::model ? library.model(display) : shown.name;
    return {{"type", "hello"},
            {"version", version},
            {"display", start.display.filename().string()},
            {"eye_mm", display.camera.position_mm},
            {"shown", {{"kind", "start"}, {"name", file.filename().string()}, {"of", kind}}},
            {"patterns", pattern_names()},
            {"most_pixels", most_pixels}};
}

}  // namespace

Answerer::Answerer(const Library& library, Panels& panels, Outbox& outbox)
    : library_(library), panels_(panels), outbox_(outbox), thread_([this] { work(); }) {}

Answerer::~Answerer() {
    {
        const std::lock_guard lock(mutex_);
        end_ = true;
    }
    changed_.notify_one();
    thread_.join();
}

void Answerer::ask(const Wanted& wanted, const Ask& question) {
    {
        const std::lock_guard lock(mutex_);
        next_.emplace(wanted, question);
    }
    changed_.notify_one();
}

void Answerer::work() {
    for (std::unique_lock lock(mutex_);;) {
        changed_.wait(lock, [&] { return end_ || next_; });
        if (end_) return;
        const auto [wanted, question] = *std::exchange(next_, std::nullopt);
        lock.unlock();
        const Json reply = answer(library_, panels_, wanted, question, [this] {
            const std::lock_guard here(mutex_);
            return end_ || next_.has_value();
        });
        lock.lock();
        outbox_.text(reply.dump());
    }
}

Visit::Visit(const Library& library, Panels& panels, Outbox& outbox, int threads, const std::string& version)
    : library_(library),
      panels_(panels),
      outbox_(outbox),
      painter_(library, panels, outbox, threads),
      plots_(library, panels, outbox) {
    outbox.text(hello(library, version).dump());
}

void Visit::message(std::string_view text) {
    const Message message = parse_message(text);
    if (const Wanted* wanted = std::get_if<Wanted>(&message)) return want(*wanted);
    const Ask& question = std::get<Ask>(message);
    if (!wanted_ && question.what != Ask::What::files) throw InputError("ask", "needs a \"show\" before it");
    if (question.what == Ask::What::exr)
        painter_.want_exr(question.id);
    else if (question.what == Ask::What::plot)
        plots_.ask(*wanted_, question);
    else
        outbox_.text(answer(library_, panels_, wanted_.value_or(Wanted{}), question, [] { return false; }).dump());
}

void Visit::want(const Wanted& wanted) {
    wanted_ = wanted;
    painter_.want(wanted);
    // The message "resolved" takes milliseconds that a picture could use: while the eye moves, the command is not updated.
    if (sent_ && (wanted.moving ? same_controls(*sent_, wanted) : same_state(*sent_, wanted))) return;
    sent_ = wanted;
    outbox_.text(resolved(library_, wanted).dump());
}

}  // namespace lfdsim::view
