#include "cli/commands/render_path.h"

#include "base/counted.h"
#include "cli/output/numbered_pictures.h"
#include "cli/output/rendered.h"
#include "cli/program/arguments.h"
#include "cli/program/input_files.h"
#include "cli/program/interrupt.h"
#include "display/keys.h"
#include "engine/scene/traced_display.h"
#include "engine/views/pipelined.h"
#include "files/description/display_file.h"
#include "geometry/geometry.h"
#include "report/folder/folder_lock.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <algorithm>
#include <cmath>
#include <optional>

namespace lfdsim::cli {
namespace {

namespace fs = std::filesystem;

// The job of one frame: reports its pixels to the job of all frames, but not its stages, so that one bar shows the whole path.
class FrameJob : public Job {
  public:
    explicit FrameJob(Job& whole) : whole_(whole) {}
    void advance(std::int64_t units) override { whole_.advance(units); }
    bool cancelled() const override { return whole_.cancelled(); }

  private:
    Job& whole_;
};

Display at_frame(const CameraPath& path, std::int64_t frame, Display display) {
    display.camera = path.camera(frame, display.camera);
    return display;
}

bool named_as_frame(const fs::path& file) {
    const std::string name = file.stem(), kind = file.extension();
    const bool number = name.size() >= 4 && name.find_first_not_of("0123456789") == name.npos;
    return number && (kind == ".png" || kind == ".exr" || kind == ".npy");
}

}  // namespace

void PathOptions::check(const OutputOptions& output) const {
    Faults faults;
    if (given()) {
        faults.of([&] { kind_.word(); });
        faults.of([&] { output.check_bits("frame." + kind_.text()); });
        faults.of([&] {
            std::error_code error;
            if (fs::exists(output.path(), error) && !fs::is_directory(output.path(), error))
                throw InputError(output.path(), "is not a folder; give one for the frames of --path");
        });
        faults.of([&] { check_resume(resume_, kind_.text()); });
    }
    faults.report();
}

CameraPath PathOptions::read() const {
    remember_input("the camera path", path_.text());
    return read_path(path_.text());
}

void PathOptions::check(const CameraPath& path, const Display& display) const {
    const auto judge = [&](const Camera& camera, const std::string& place) {
        Display there = display;
        there.camera = camera;
        std::vector<Problem> problems = validate(there);
        for (Problem& p : problems) p.where = fmt::format("{}: {}: {}", path_.text(), place, p.where);
        if (!problems.empty()) throw InputError(std::move(problems));
    };
    for (std::size_t i = 0; i < path.poses.size(); ++i) {
        Camera camera = display.camera;
        camera.position_mm = path.poses[i].position_mm;
        camera.target_mm = path.poses[i].target_mm.value_or(camera.target_mm);
        judge(camera, fmt::format("poses[{}]", i));
    }
    // Between two valid poses a frame may be invalid: its camera may look along its "up" direction.
    for (std::int64_t k = 0; k < path.frames(); ++k)
        judge(path.camera(k, display.camera), fmt::format("frame {} at {:.6g} s", k, path.time_s(k)));
}

fs::path PathOptions::file(const OutputOptions& output, std::int64_t frame, std::int64_t frames) const {
    const std::size_t digits = std::max<std::size_t>(4, fmt::formatted_size("{}", frames - 1));
    return fs::path(output.path()) / fmt::format("{:0{}}.{}", frame, digits, kind_.text());
}

PathMade render_path(const PathWork& w, const std::function<const PanelTexels&()>& panel, Progress& progress) {
    // The frames that are left. Whether they can be written is checked before the panel's light is made.
    PathMade made;
    made.frames = w.path.frames();
    const FolderLock lock(w.output.path());
    check_output(w.options.file(w.output, 0, made.frames));
    for (std::int64_t k = 0; k < made.frames; ++k) refuse_input(w.options.file(w.output, k, made.frames));
    const NumberedPictures frames{w.output.path(),
                                  made.frames,
                                  [&](std::int64_t k) { return w.options.file(w.output, k, made.frames).filename().string(); },
                                  [&](std::int64_t k) { return write_display(at_frame(w.path, k, w.display)); },
                                  w.shown,
                                  named_as_frame,
                                  "frame",
                                  w.options.resume(),
                                  w.options.replace()};
    frames.keep_apart();
    const std::vector<std::int64_t> left = frames.left();
    if (left.empty()) return made;

    // The frames, each written as soon as it is rendered.
    const PanelTexels& light = panel();
    const SummedPanel summed(light.texels, w.rendering.threads);
    const std::string shown = frames.shown_with(light.files);
    const auto [columns, rows] = w.display.camera.resolution;
    const std::optional<Rect>& crop = w.rendering.crop;
    progress.stage("rendering",
                   std::int64_t(left.size()) * (crop ? std::int64_t(crop->x1 - crop->x0) * (crop->y1 - crop->y0) : columns * rows));
    std::size_t above_target = 0;
    double largest_error = 0;
    CutOff cut;
    FrameJob frame(progress);
    const auto make = [&](std::size_t i) {
        const Display display = at_frame(w.path, left[i], w.display);
        return render(display, resolve(display), summed, w.rendering, frame);
    };
    const auto keep = [&](std::size_t i, Rendering r) {
        if (!r.complete) return false;
        const fs::path file = w.options.file(w.output, left[i], made.frames);
        Rendered facts = rendered(r, w.rendering.target_error, keeps_layers(file));
        facts.about["shown"] = shown;
        cut += w.output.save(file, r.image, Encoding::srgb, at_frame(w.path, left[i], w.display), std::move(facts.about),
                             std::move(facts.layers));
        ++made.rendered;
        made.samples += r.samples;
        made.seconds += r.seconds;
        above_target += facts.pixels_above_target;
        if (r.measured_error.value_or(0) >= largest_error) {  // the frame with the largest error is the one that is reported
            largest_error = r.measured_error.value_or(0);
            made.how = how_made(r);
            made.more = how_made_json(r);
            if (r.measured_error) made.more["frame"] = left[i];
        }
        return true;
    };
    make_ahead(left.size(), renders_on_gpu(w.rendering), make, keep);
    progress.end();
    if (above_target > 0)
        spdlog::warn("{} did not reach the target error with the maximum number of samples", counted(above_target, "pixel"));
    made.more.update(w.output.warn(cut));
    if (w.rendering.target_error) made.more["pixels_above_target"] = above_target;
    if (const std::int64_t missing = std::int64_t(left.size()) - made.rendered; missing > 0)
        end_interrupted(w.output.path(), fmt::format("{} of {}", made.frames - missing, counted(made.frames, "frame")),
                        keeps_metadata(w.options.file(w.output, 0, 1)));
    return made;
}

}  // namespace lfdsim::cli
