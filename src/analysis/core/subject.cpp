#include "analysis/core/subject.h"

#include "analysis/core/elemental_panel.h"
#include "analysis/pictures/views.h"
#include "engine/render.h"

#include <cmath>

namespace lfdsim {

Image whole_picture(const Display& d, const Geometry& g, const SummedPanel& panel, const RenderOptions& how, const Job& job) {
    Quiet quiet(job);
    Rendering r = render(d, g, panel, how, quiet);
    if (!r.complete) throw Stopped{};
    return std::move(r.image);
}

Subject::Subject(Display display, std::optional<ContentScene> scene, AnalysisOptions options)
    : display_(std::move(display)),
      geometry_(resolve(display_)),
      theory_(lfdsim::theory(display_, geometry_)),
      scene_(std::move(scene)),
      options_(std::move(options)) {}

RenderOptions Subject::rendering() const {
    RenderOptions how;
    how.threads = threads();
    how.device = options_.device;
    return how;
}

double Subject::viewing_distance_mm() const { return options_.viewing_distance_mm.value_or(camera_distance_mm(display_)); }

const ContentScene& Subject::scene() const {
    if (!scene_) throw InputError("--model", "there is nothing to show; give a mesh file or built-in:spheres");
    return *scene_;
}

const SummedPanel& Subject::panel(const Job& job) {
    if (!shown_) shown_ = elemental_panel(display_, geometry_, scene(), threads(), job);
    return shown_->summed();
}

double Subject::white_field(const Job& job) {
    if (white_field_) return *white_field_;
    Texels white(display_.panel.pixels[0], display_.panel.pixels[1]);
    for (std::int64_t row = 0; row < white.rows(); ++row)
        for (std::int64_t k = 0; k < white.columns(); ++k)
            for (int c = 0; c < 3; ++c) white.row(row)[4 * k + c] = 1;
    // The view from the front, as far as it shows the screen
    const ShownPanel panel(std::move(white), threads());
    const Display seen = seen_from(display_, 0, 0);
    const Region screen = seen_screen(seen, geometry_);
    const Rect box = screen_box(screen);
    RenderOptions how = rendering();
    how.crop = box;
    const Image picture = whole_picture(seen, geometry_, panel.summed(), how, job);
    // The mean over the pixels that see the screen
    double sum = 0;
    const Region part = screen.shifted(-box.x0, -box.y0);
    for (std::size_t k = 0; k < part.rows.size(); ++k)
        for (int x = part.rows[k].from; x < part.rows[k].to; ++x)
            for (int c = 0; c < 3; ++c) sum += picture.at(x, part.top + int(k))[c];
    const double mean = sum / (3 * double(screen.pixels()));
    if (!(mean > 0))
        throw InputError("camera", "sees no light of a white panel from straight in front of it, so that nothing can be compared");
    white_field_ = mean;
    return mean;
}

}  // namespace lfdsim
