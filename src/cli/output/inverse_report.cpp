#include "cli/output/inverse_report.h"

#include "display/keys.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <algorithm>
#include <cmath>

namespace lfdsim::cli {
namespace {

Json nearness_json(const Nearness& n) { return {{"psnr_db", n.psnr_db}, {"ssim", n.ssim}}; }

}  // namespace

void warn_of_inverse(const InverseReport& report) {
    for (const std::string& warning : report.warnings) spdlog::warn("--pickup inverse: {}", warning);
}

std::string inverse_text(const InverseReport& report) {
    std::string crosstalk;
    if (report.crosstalk) {
        const double c = *report.crosstalk, black = c / (1 + c);
        crosstalk = fmt::format("; crosstalk {:.1f} %", 100 * c);
        if (black >= 0.005) crosstalk += fmt::format(", which --levels {:.2f},{:.2f} would allow to cancel", black, 1 - black);
    }
    const auto nearness = [](const Nearness& n) -> std::string {
        if (std::isnan(n.psnr_db)) return "not compared";
        return std::isnan(n.ssim) ? fmt::format("{:.2f} dB, no SSIM because of dark gaps", n.psnr_db)
                                  : fmt::format("{:.2f} dB, SSIM {:.3f}", n.psnr_db, n.ssim);
    };
    const bool points = std::ranges::all_of(report.boxes, [](const EyeBox& box) { return box.low == box.high; });
    return fmt::format("at {}: {} (traced content: {}; integrated: {}); {} eyes{}, {} steps{}",
                       points ? "the fitted eyes, by other rays" : "eyes that were not fitted", nearness(report.held_out),
                       nearness(report.held_out_traced), nearness(report.held_out_integrated), report.places,
                       report.rim_places > 0 ? fmt::format(" and {} around them", report.rim_places) : "", report.iterations,
                       crosstalk);
}

Json inverse_json(const InverseReport& r) {
    Json boxes = Json::array();
    for (const EyeBox& box : r.boxes) boxes.push_back({{"low_mm", box.low}, {"high_mm", box.high}});
    return {{"eyes", std::move(boxes)},
            {"places", r.places},
            {"rim_places", r.rim_places},
            {"rays", r.rays},
            {"rays_per_element", r.rays_per_element},
            {"rows_per_unknown", r.rows_per_unknown},
            {"rays_per_unknown", r.rays_per_unknown},
            {"iterations", r.iterations},
            {"seconds", r.seconds},
            {"white_light", r.gain},
            {"black", r.black},
            {"white", r.white},
            {"prior", r.prior},
            {"fitted", nearness_json(r.fitted)},
            {"held_out", nearness_json(r.held_out)},
            {"held_out_traced", nearness_json(r.held_out_traced)},
            {"held_out_integrated", nearness_json(r.held_out_integrated)},
            {"crosstalk", r.crosstalk ? Json(*r.crosstalk) : Json()},
            {"result", words<PickupKind>()[std::size_t(r.result)]},
            {"at_black_percent", r.at_black_percent},
            {"at_white_percent", r.at_white_percent},
            {"unseen_percent", r.unseen_percent}};
}

}  // namespace lfdsim::cli
