#include "analysis/core/met_places.h"

namespace lfdsim {

LineSets::LineSets(int count, std::int64_t seed, int first) {
    for (int k = 0; k < independent_sets; ++k) sets_[std::size_t(k)] = even_choices(count, set_number(seed, first + k));
}

MetPlaces::MetPlaces(const LineSets& lines, std::size_t paths, const Look& look) {
    for (std::size_t k = 0; k < met_.size(); ++k) {
        const std::vector<Choice>& choices = lines.sets()[k];
        met_[k].reserve(2 * choices.size());
        for (std::size_t path = 0; path < paths; ++path) {
            // Each path takes consecutive lines of the set. If their number is not divisible by that of the paths, some paths
            // have a line more, which then counts for less.
            const std::size_t from = choices.size() * path / paths, to = choices.size() * (path + 1) / paths;
            const double each = double(choices.size()) / double(paths * (to - from));
            for (std::size_t n = from; n < to; ++n)
                for (const Choice& c : {choices[n], LineSets::mirrored(choices[n])})
                    if (auto met = look(c, path)) {
                        met->light *= each;
                        met->path = path;
                        met_[k].push_back(*met);
                    }
        }
    }
}

EyePaths::EyePaths(const Display& d, const Geometry& g) {
    if (!disperses(d)) {
        rays_.emplace_back(d, g);
        weights_.push_back(luminance_weights);
        return;
    }
    for (std::size_t channel = 0; channel < 3; ++channel)
        for (const LightPath& path : light_paths(d, g, channel)) {
            rays_.emplace_back(d, path.geometry);
            weights_.push_back(only(channel));
            weights_.back()[channel] *= path.weight * luminance_weights[channel];
        }
}

MetPlaces EyePaths::look(const Vec3d& eye, const LineSets& lines, Counting counting) const {
    return {lines, rays_.size(), [&](const Choice& c, std::size_t path) -> std::optional<MetPlaces::Met> {
                const Sight sight = rays_[path].look(eye, c);
                if (!(sight.light > 0) || (counting == Counting::by_lens && !sight.by_lens)) return {};
                return MetPlaces::Met{sight.x, sight.y, sight.light};
            }};
}

}  // namespace lfdsim
