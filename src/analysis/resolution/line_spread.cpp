#include "analysis/resolution/line_spread.h"

#include "analysis/core/channel_pixels.h"
#include "analysis/core/eye_rays.h"
#include "base/constants.h"
#include "content/pickup/pickup.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <limits>

namespace lfdsim {
namespace {

constexpr int spread_lines_a_set = 4096;
// Steps of an additive recurrence that fills a square evenly
constexpr std::array plastic{0.7548776662466927, 0.5698402909980532};

}  // namespace

double LineSpread::width_mm(double share) const {
    std::vector<WeightedOffset> all;
    double light = 0;
    for (const std::vector<WeightedOffset>& lines : sets_)
        for (const WeightedOffset& line : lines) {
            all.push_back({std::abs(line.off_mm), line.light});
            light += line.light;
        }
    std::sort(all.begin(), all.end(), [](const WeightedOffset& a, const WeightedOffset& b) { return a.off_mm < b.off_mm; });
    double within = 0;
    for (const WeightedOffset& line : all)
        if ((within += line.light) >= share * light) return 2 * line.off_mm;
    return std::numeric_limits<double>::quiet_NaN();
}

Estimate LineSpread::middle_mm() const {
    return jackknife([&](int without) {
        double light = 0, sum = 0;
        for (std::size_t set = 0; set < sets_.size(); ++set) {
            if (int(set) == without) continue;
            for (const WeightedOffset& line : sets_[set]) {
                light += line.light;
                sum += line.light * line.off_mm;
            }
        }
        return sum / light;
    });
}

Modulation LineSpread::mtf(double step_per_mm, int count) const {
    std::array<std::vector<std::complex<double>>, independent_sets> sums;
    tbb::parallel_for(std::size_t(0), sums.size(), [&](std::size_t set) {
        sums[set].resize(std::size_t(count));
        for (const WeightedOffset& line : sets_[set]) {
            // exp(2 pi i k step off) by repeated multiplication
            const std::complex<double> turn = std::polar(1., 2 * pi * step_per_mm * line.off_mm);
            std::complex<double> wave = line.light;
            for (std::complex<double>& sum : sums[set]) {
                sum += wave;
                wave = {wave.real() * turn.real() - wave.imag() * turn.imag(),
                        wave.real() * turn.imag() + wave.imag() * turn.real()};
            }
        }
    });
    const auto of_all_but = [&](int left_out) {
        std::vector<double> modulation;
        for (std::size_t k = 0; k < std::size_t(count); ++k) {
            std::complex<double> sum = 0, light = 0;
            for (std::size_t set = 0; set < sums.size(); ++set) {
                if (int(set) == left_out) continue;
                sum += sums[set][k];
                light += sums[set][0];
            }
            modulation.push_back(std::abs(sum) / light.real());
        }
        return modulation;
    };
    Modulation m{of_all_but(-1), {}};
    for (int set = 0; set < independent_sets; ++set) m.without[std::size_t(set)] = of_all_but(set);
    return m;
}

template <class ShownAt>
void SeenThroughLenses::trace(const Subject& s, const Geometry& g, const Vec3d& eye, int lines, const ShownAt& shown) {
    const Display& d = s.display();
    const EyeRays rays(d, g);
    const Pickup pickup(d, s.geometry());
    const int count = lines * rays.more_for(eye);
    const double down = vertex_mm_ - eye[2];
    tbb::parallel_for(0, independent_sets, [&](int set) {
        std::array<double, 2> phase{};
        for (const Choice& choice : even_choices(count, set_number(d.render.seed, set))) {
            for (std::size_t k = 0; k < 2; ++k) phase[k] = std::fmod(phase[k] + plastic[k], 1);
            const Vec3d aimed = rays.aim(eye, choice);
            const Sight sight = rays.look_through(eye, aimed, choice[2], choice[3]);
            if (!(sight.light > 0)) continue;
            const auto place = pixel_place(d.panel, sight);
            // Adds the line for pixels that are shifted by `shift` of a pixel.
            const auto add = [&](Sets& to, const std::array<double, 2>& shift) {
                const std::optional<ShownPoint> seen = shown({place[0] + shift[0], place[1] + shift[1]});
                if (!seen) return;
                const NodalLine line = pickup.line(pickup.x_mm(seen->column - shift[0]), pickup.y_mm(seen->row - shift[1]));
                if (!line.owned) return;  // it is black, whatever is shown
                to[std::size_t(set)].push_back({{line.x, line.y},
                                                {line.mx, line.my},
                                                {aimed[0], aimed[1]},
                                                {(aimed[0] - eye[0]) / down, (aimed[1] - eye[1]) / down},
                                                sight.light * seen->light});
            };
            add(as_described_, {0, 0});
            add(anywhere_, phase);
        }
    });
}

SeenThroughLenses::SeenThroughLenses(const Subject& s, const Vec3d& eye, std::size_t channel)
    : principal_mm_(s.geometry().rear_principal_mm), vertex_mm_(s.geometry().vertex_plane_mm) {
    const Display& d = s.display();
    const ChannelPixels pixels(d, channel);
    // Most lines end where the channel does not emit, so that more are needed.
    const int more = std::min(8, int(std::bit_ceil(unsigned(std::ceil(std::min(pixels.gain(), 8.))))));
    for (const auto& [geometry, weight] : light_paths(d, s.geometry(), channel))
        trace(s, geometry, eye, more * spread_lines_a_set, [&, share = weight](const std::array<double, 2>& place) {
            const std::optional<ChannelPixels::Shining> found = pixels.at(place);
            return found ? std::optional(ShownPoint{found->shown[0] - 0.5, found->shown[1] - 0.5, share * found->brightness})
                         : std::nullopt;
        });
}

SeenThroughLenses::SeenThroughLenses(const std::array<SeenThroughLenses, 3>& channels)
    : principal_mm_(channels[0].principal_mm_), vertex_mm_(channels[0].vertex_mm_) {
    for (std::size_t c = 0; c < 3; ++c)
        for (auto [from, to] : {std::pair{&channels[c].as_described_, &as_described_}, {&channels[c].anywhere_, &anywhere_}})
            for (std::size_t set = 0; set < independent_sets; ++set)
                for (LinePair seen : (*from)[set]) {
                    seen.light *= luminance_weights[c];
                    (*to)[set].push_back(seen);
                }
}

LineSpread SeenThroughLenses::spread(double z_mm, const Direction& direction, PixelPositions pixels) const {
    const auto along = [&](const std::array<double, 2>& v) { return direction.x * v[0] + direction.y * v[1]; };
    const Sets& seen = pixels == PixelPositions::as_described ? as_described_ : anywhere_;
    LineSpread::Sets sets;
    for (std::size_t set = 0; set < seen.size(); ++set)
        for (const LinePair& s : seen[set]) {
            // Both lines at the plane, along the direction
            const double shown = along(s.at) + (z_mm - principal_mm_) * along(s.slope),
                         looked_at = along(s.aimed) + (z_mm - vertex_mm_) * along(s.straight);
            sets[set].push_back({shown - looked_at, s.light});
        }
    return LineSpread(std::move(sets));
}

}  // namespace lfdsim
