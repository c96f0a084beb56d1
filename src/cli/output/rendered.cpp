#include "cli/output/rendered.h"

#include "base/counted.h"
#include "display/keys.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace lfdsim::cli {

std::string how_made(const Rendering& r) {
    const std::string estimator(lfdsim::word(r.estimator));
    if (r.device != "cpu") return fmt::format("{}, {} ({:.1f} ms)", estimator, r.device, r.gpu_seconds * 1e3);
    std::string how = fmt::format("{}, {}, {}", estimator, r.kernel, counted(r.threads, "thread"));
    if (r.points_share > 0) how += fmt::format("; {:.0f} % of pixels by points", std::max(100 * r.points_share, 1.0));
    if (r.measured_error) how += fmt::format("; error {:.2g}", *r.measured_error);
    return how;
}

Json how_made_json(const Rendering& r) {
    Json all{
        {"device", r.device}, {"kernel", r.kernel}, {"threads", r.threads}, {"estimator", std::string(lfdsim::word(r.estimator))}};
    if (r.estimator == Estimator::filtered) all["points_share"] = r.points_share;
    if (r.measured_error) all["measured_error"] = *r.measured_error;
    if (r.device != "cpu") all["gpu_seconds"] = r.gpu_seconds;
    return all;
}

Rendered rendered(Rendering& r, std::optional<double> target_error, bool layers) {
    Rendered all{{{"device", r.device},
                  {"kernel", r.kernel},
                  {"threads", fmt::format("{}", r.threads)},
                  {"seconds", fmt::format("{:.3f}", r.seconds)}},
                 {},
                 how_made_json(r)};
    if (r.measured_error) {
        all.about["points_share"] = fmt::format("{:.3f}", r.points_share);
        all.about["measured_error"] = fmt::format("{:.2g}", *r.measured_error);
    }
    if (r.prepare_seconds > 0) all.more["prepare_seconds"] = r.prepare_seconds;
    if (!target_error) return all;
    double squares = 0;
    for (std::size_t i = 0; i < r.error.rgb.size(); i += 3) {
        double pixel = 0;
        for (std::size_t c = 0; c < 3; ++c) pixel += double(r.error.rgb[i + c]) * r.error.rgb[i + c];
        squares += pixel;
        all.pixels_above_target += std::sqrt(pixel / 3) > 1.0001 * *target_error;
    }
    all.more["pixels_above_target"] = all.pixels_above_target;
    all.more["error_rms"] = std::sqrt(squares / double(r.error.rgb.size()));
    all.more["samples_per_pixel"] = double(r.samples) / (double(r.image.width) * r.image.height);
    if (layers) all.layers.push_back({"error", std::move(r.error)});
    return all;
}

}  // namespace lfdsim::cli
