#include "view/answers/likeness.h"

#include "analysis/core/subject.h"
#include "analysis/pictures/views.h"
#include "geometry/vec.h"
#include "image/compare/ssim.h"
#include "image/formats/encoding.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lfdsim::view {

double WhiteField::of(const Display& seen, const Geometry& geometry, bool quick, int threads, const std::string& device,
                      const Job& job) {
    // A white panel with fewer and larger pixels is as white, and made more quickly. Keys on which the white field does not depend
    // get one value, so that a change of them does not count as one of `d`.
    Display d = seen;
    d.name.clear();
    d.content.model.clear();
    d.content.objects.clear();
    d.camera.fov_deg.reset();
    d.camera.frame_width_mm = geometry.frame_width_mm;
    d.camera.position_mm = {0, 0, length(d.camera.position_mm)};
    d.camera.target_mm = {0, 0, 0};
    while (d.panel.pixels[0] % 2 == 0 && d.panel.pixels[1] % 2 == 0) {
        for (std::int64_t& n : d.panel.pixels) n /= 2;
        d.panel.pixel_pitch_mm *= 2;
    }
    if (quick) {
        const double share = std::min(1., 320. / double(d.camera.resolution[0]));
        for (std::int64_t& n : d.camera.resolution) n = std::max<std::int64_t>(16, std::llround(share * double(n)));
    }
    if (of_ != d) {
        AnalysisOptions options;
        options.threads = threads;
        options.device = device;
        light_ = Subject(d, {}, options).white_field(job);
        of_ = d;
    }
    return light_;
}

Compared compared(Image& view, double white, const Display& display, const Geometry& geometry, const ContentScene& scene,
                  int threads, const Job& job) {
    expose(view, white);
    Quiet quiet(job);
    Picture photograph = reference_photograph(display, geometry, scene, threads, {}, quiet);
    if (!photograph.complete) throw Stopped{};
    const double likeness = ssim(view, photograph.image, std::array{content_region(display, geometry, scene)}).front();
    return {std::move(photograph.image), likeness};
}

std::vector<std::uint8_t> difference_codes(const Image& view, const Image& photograph) {
    std::vector<std::uint8_t> codes = encode8(view, Encoding::srgb);
    const std::vector<std::uint8_t> other = encode8(photograph, Encoding::srgb);
    for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = std::uint8_t(std::clamp(128 + int(codes[i]) - int(other[i]), 0, 255));
    return codes;
}

}  // namespace lfdsim::view
