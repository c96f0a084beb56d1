#include "view/painting/drawing.h"

#include "analysis/core/elemental_panel.h"
#include "base/seconds.h"
#include "engine/devices/devices.h"
#include "engine/devices/memory.h"
#include "engine/render.h"
#include "engine/scene/traced_display.h"
#include "view/painting/painter_job.h"

#include <fmt/format.h>
#include <array>
#include <chrono>
#include <limits>

namespace lfdsim::view {
namespace {

using Clock = std::chrono::steady_clock;

// A final picture that takes longer than long_seconds is preceded by a fine one.
constexpr double coarse_seconds = 0.022, stand_in_seconds = 0.012, long_seconds = 0.15;
constexpr int picture_copies = 3;                                           // as rendered, encoded, and waiting to be sent
constexpr std::array coarse_scales{1., 0.75, 0.6, 0.5, 0.4, 1. / 3, 0.25};  // of columns and rows of the picture
constexpr std::array panel_divisors{1, 2, 3, 4};                            // of columns and rows of the panel
constexpr double jpeg_cost = 6e-9, png_cost = 25e-9, panel_cost = 30e-9;    // seconds of one core for a pixel; see render_cost()

}  // namespace

void Drawing::begin(const Wanted& wanted) {
    eyes_.clear();
    wanted_ = wanted;
    on_gpu_ = choose_device(library_.start().device, "").gpu.has_value();
    coarse_is_full_ = false;
    pictures_ = {};
    eyes_ = seen(library_, wanted);
    for (const EyeDisplay& eye : eyes_) panels_.require(eye.key, eye.made_for);
    const double count = double(eyes_.size()) + (wanted.beside == Beside::none ? 0 : 2);
    pictures_ = panels_.budget().claim("size", fmt::format("pictures of {} x {} pixels", wanted.size[0], wanted.size[1]),
                                       count * picture_copies * picture_bytes(wanted.size[0], wanted.size[1]));
}

std::string Drawing::beside_problem() const {
    const bool can = wanted_.beside == Beside::none || eyes_.empty() || !eyes_[0].model.name.empty();
    return can ? "" : "has nothing to photograph: the content shown was not made from a known model";
}

// Returns the cost of all eyes; photographs beside them add a similar cost, which the pace learns.
double Drawing::coarse_cost(const EyeDisplay& eye, double scale) const {
    const Display d = coarse_view(eye.display, eye.geometry, scale, on_gpu_);
    return double(eyes_.size()) *
           (render_cost(d, resolve(d), true) + jpeg_cost * double(d.camera.resolution[0]) * double(d.camera.resolution[1]));
}

double Drawing::final_cost() const {
    const EyeDisplay& eye = eyes_.front();
    return double(eyes_.size()) * (render_cost(eye.display, eye.geometry) + png_cost * wanted_.size[0] * wanted_.size[1]);
}

Drawing::LitDisplay Drawing::true_light(const EyeDisplay& eye, Job& job) {
    return {eye, panels_.get(eye.key, eye.made_for, eye.made_for_geometry, threads_, job)};
}

// Returns the true light where it exists or a coarse panel would not do; else that of a panel with larger pixels.
Drawing::LitDisplay Drawing::quick_light(const EyeDisplay& eye, Job& job) {
    if (auto light = panels_.find(eye.key)) return {eye, light};
    // An image, or a pattern that does not depend on lenses, would not be resembled by one with fewer pixels.
    if (eye.key.lengths.empty()) return true_light(eye, job);
    if (eye.source.kind == Shown::Kind::model) panels_.scene(eye.source, eye.made_for, eye.made_for_geometry, job);
    const double count = double(eye.display.panel.pixels[0]) * double(eye.display.panel.pixels[1]);
    const auto cost = [&](int k) {
        return count / double(panel_divisors[std::size_t(k)] * panel_divisors[std::size_t(k)]) * panel_cost;
    };
    coarse_panel_ = best_in_time(int(panel_divisors.size()), coarse_panel_, stand_in_seconds,
                                 [&](int k) { return panel_pace_.seconds(cost(k)); });
    const int divisor = panel_divisors[std::size_t(coarse_panel_)];
    const std::optional<EyeDisplay> coarse = divisor > 1 ? with_coarse_panel(eye, divisor) : std::nullopt;
    if (!coarse) return true_light(eye, job);
    if (!stand_in_ || !(stand_in_key_ == coarse->key)) {
        stand_in_.reset();
        const auto start = Clock::now();
        stand_in_ = panels_.make(coarse->source, coarse->made_for, coarse->made_for_geometry, threads_, job);
        stand_in_key_ = coarse->key;
        panel_pace_.learn(cost(coarse_panel_), seconds_since(start));
    }
    return {*coarse, stand_in_};
}

// Adds the photograph or difference beside the left eye's picture, and the likeness to both headers. `view` is divided by the white
// field.
void Drawing::beside(const LitDisplay& lit, const Display& display, const Geometry& geometry, FrameHeader header, Image& view,
                     Frames& frames, FrameHeader& of_view, Job& job) {
    const auto start = Clock::now();
    const Quiet quiet(job);
    const bool rest = header.quality == Quality::final;
    double white = 1;
    bool comparable = true;
    const auto claim = panels_.budget().claim("panel.pixels", "a white panel to compare with", texel_bytes(display));
    try {
        white = (rest ? white_ : quick_white_).of(display, geometry, !rest, threads_, library_.start().device, quiet);
    } catch (const InputError&) {  // the camera sees no light of a white panel: there is no likeness
        comparable = false;
    }
    const ContentScene scene = panels_.scene(lit.seen.model, lit.seen.made_for, lit.seen.made_for_geometry, job);
    const Compared both = compared(view, white, display, geometry, scene, threads_, quiet);
    header.ssim = of_view.ssim = comparable ? both.ssim : std::numeric_limits<double>::quiet_NaN();
    header.samples = 1;
    header.render_ms = 1000 * seconds_since(start);
    Writing writing(job);
    const bool difference = wanted_.beside == Beside::difference;
    header.lane = difference ? "difference" : "photograph";
    frames.push_back({header.lane, difference ? codes_frame(header, difference_codes(view, both.photograph), writing)
                                              : picture_frame(header, both.photograph, writing)});
}

Drawing::Frames Drawing::pictures(const std::vector<LitDisplay>& all, Quality quality, double scale, Job& job) {
    Frames frames;
    Writing writing(job);
    for (const LitDisplay& lit : all) {
        const bool rest = quality == Quality::final;
        const Display display = rest ? lit.seen.display : coarse_view(lit.seen.display, lit.seen.geometry, scale, on_gpu_);
        const Geometry geometry = rest ? lit.seen.geometry : resolve(display);
        RenderOptions options;
        options.threads = threads_;
        options.device = library_.start().device;
        options.rough = quality == Quality::coarse;
        Rendering r = render(display, geometry, lit.light->summed(), options, job);
        if (!r.complete) throw Stopped{};
        FrameHeader header{wanted_.id,     lit.seen.lane,       quality,         r.image.width,
                           r.image.height, samples_of(display), 1000 * r.seconds};
        Frames more;
        const bool compare = &lit == &all.front() && wanted_.beside != Beside::none && beside_problem().empty();
        if (!compare) {
            frames.push_back({header.lane, picture_frame(header, r.image, writing)});
            continue;
        }
        Image exposed = r.image;
        beside(lit, display, geometry, header, exposed, more, header, job);
        frames.push_back({header.lane, picture_frame(header, r.image, writing)});
        frames.push_back(std::move(more.front()));
    }
    return frames;
}

Drawing::Frames Drawing::coarse(Job& job) {
    std::vector<LitDisplay> all;
    bool stand_in = false;
    for (const EyeDisplay& eye : eyes_) {
        all.push_back(quick_light(eye, job));
        stand_in = stand_in || !(all.back().seen.key == eye.key);
    }
    const auto start = Clock::now();
    const auto cost = [&](int k) { return coarse_cost(all.front().seen, coarse_scales[std::size_t(k)]); };
    coarse_scale_ = best_in_time(int(coarse_scales.size()), coarse_scale_, coarse_seconds,
                                 [&](int k) { return coarse_pace_.seconds(cost(k)); });
    Frames frames = pictures(all, Quality::coarse, coarse_scales[std::size_t(coarse_scale_)], job);
    coarse_pace_.learn(cost(coarse_scale_), seconds_since(start));
    coarse_is_full_ = coarse_scale_ == 0 && !stand_in;
    return frames;
}

bool Drawing::wants_fine() const {
    const double guess = final_pace_.seconds(final_cost());
    return !coarse_is_full_ && guess > long_seconds && coarse_pace_.seconds(coarse_cost(eyes_.front(), 1)) < guess / 2;
}

Drawing::Frames Drawing::fine(Job& job) {
    std::vector<LitDisplay> all;
    for (const EyeDisplay& eye : eyes_) all.push_back(true_light(eye, job));
    return pictures(all, Quality::fine, 1, job);
}

Drawing::Frames Drawing::final(Job& job) {
    std::vector<LitDisplay> all;
    for (const EyeDisplay& eye : eyes_) all.push_back(true_light(eye, job));
    stand_in_.reset();
    const auto start = Clock::now();
    Frames frames = pictures(all, Quality::final, 1, job);
    final_pace_.learn(final_cost(), seconds_since(start));
    return frames;
}

Drawing::DrawnFrame Drawing::exr(std::int64_t id, Job& job) {
    std::vector<Image> images;
    FrameHeader header{id, "file", Quality::final};
    for (const EyeDisplay& eye : eyes_) {
        const LitDisplay lit = true_light(eye, job);
        Rendering r = render(eye.display, eye.geometry, lit.light->summed(), {threads_, "", {}, {}, library_.start().device}, job);
        if (!r.complete) throw Stopped{};
        header.width = r.image.width;
        header.height = r.image.height;
        header.samples = samples_of(eye.display);
        header.render_ms += 1000 * r.seconds;
        images.push_back(std::move(r.image));
    }
    Writing writing(job);
    return {header.lane, exr_frame(header, images[0], images.size() > 1 ? &images[1] : nullptr, writing)};
}

}  // namespace lfdsim::view
