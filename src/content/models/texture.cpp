#include "content/models/texture.h"

#include "image/formats/encoding.h"
#include "simd/simd.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

using Four = optics::Lane<4>;

Texel mix(Texel a, Texel b, float t) { return a + (b - a) * t; }

float alpha_of(std::uint32_t code) { return float(code >> 24) / 255; }

// Returns the texel index that an index beyond the border means.
int wrapped(int i, int size, Wrap how) {
    if (unsigned(i) < unsigned(size)) return i;
    switch (how) {
        case Wrap::clamp:
            return std::clamp(i, 0, size - 1);
        case Wrap::mirror: {
            const int twice = ((i % (2 * size)) + 2 * size) % (2 * size);
            return twice < size ? twice : 2 * size - 1 - twice;
        }
        default:
            return ((i % size) + size) % size;
    }
}

// Folds a coordinate into a few periods, so that huge coordinates stay precise enough and fit an int.
float folded(float x, Wrap how) {
    if (x >= 0 && x < 1) return x;
    if (how == Wrap::clamp) return std::max(-1.f, std::min(2.f, x));
    const float rest = x - 2 * std::floor(x / 2);
    return rest >= 0 ? rest : 0;  // interpolated between the largest floats, x may be infinite, and its rest not a number
}

// The texels of a finer level along one axis that a texel of the coarser one covers.
struct Covered {
    int first, end;
    float share[3];  // of each in the coarser texel's width; an odd size is halved to texels of more than two
};
Covered covered(int i, int coarse, int fine) {
    // In units of 1/coarse of a finer texel, texel i is from i fine to (i + 1) fine.
    const auto from = std::int64_t(i) * fine, to = from + fine;
    Covered all{int(from / coarse), int((to + coarse - 1) / coarse), {}};
    for (std::int64_t j = all.first; j < all.end; ++j)
        all.share[j - all.first] = float(std::min(to, (j + 1) * coarse) - std::max(from, j * coarse)) / float(fine);
    return all;
}

}  // namespace

double MipMap::bytes() const {
    double bytes = 4. * double(codes_.size());
    for (const Level& level : levels_) bytes += double(sizeof(Mean)) * double(level.means.size());
    return bytes;
}

MipMap::MipMap(const Texture& t, bool with_alpha) : with_alpha_(with_alpha), light_(decode_table(Encoding::srgb, 8).data()) {
    codes_.resize(std::size_t(t.width) * t.height);
    for (std::size_t i = 0; i < codes_.size(); ++i)
        codes_[i] = t.rgba[4 * i] | std::uint32_t(t.rgba[4 * i + 1]) << 8 | std::uint32_t(t.rgba[4 * i + 2]) << 16 |
                    (with_alpha ? std::uint32_t(t.rgba[4 * i + 3]) << 24 : 0xff000000u);
    levels_.push_back({t.width, t.height, {}});
    while (levels_.back().width > 1 || levels_.back().height > 1) levels_.push_back(halved(levels_.size() - 1));
    for (const Level& l : levels_) sizes_.insert(sizes_.end(), {float(l.width), float(l.height)});
    sizes_.insert(sizes_.end(), {1, 1});  // sample() reads the next level's size, too
}

MipMap::Level MipMap::halved(std::size_t level) const {
    const Level& fine = levels_[level];
    Level coarse{std::max(1, fine.width / 2), std::max(1, fine.height / 2), {}};
    coarse.means.reserve(std::size_t(coarse.width) * coarse.height);
    for (int y = 0; y < coarse.height; ++y) {
        const Covered rows = covered(y, coarse.height, fine.height);
        for (int x = 0; x < coarse.width; ++x) {
            const Covered columns = covered(x, coarse.width, fine.width);
            Texel mean{};
            for (int j = rows.first; j < rows.end; ++j)
                for (int i = columns.first; i < columns.end; ++i)
                    mean += texel(level, std::size_t(j) * fine.width + i) *
                            (rows.share[j - rows.first] * columns.share[i - columns.first]);
            coarse.means.push_back(__builtin_convertvector(mean * 65535.f + 0.5f, Mean));
        }
    }
    return coarse;
}

inline Texel MipMap::texel(std::size_t level, std::size_t i) const {
    if (level > 0) return __builtin_convertvector(levels_[level].means[i], Texel) * (1 / 65535.f);
    const std::uint32_t code = codes_[i];
    const Texel light{light_[code & 255], light_[code >> 8 & 255], light_[code >> 16 & 255], with_alpha_ ? 1.f : 0.f};
    return with_alpha_ ? light * alpha_of(code) : light;
}

Texel MipMap::bilinear(std::size_t level, int x0, int y0, int x1, int y1, float right, float down) const {
    const auto at = [&](int i, int j) { return texel(level, std::size_t(j) * std::size_t(levels_[level].width) + std::size_t(i)); };
    return mix(mix(at(x0, y0), at(x1, y0), right), mix(at(x0, y1), at(x1, y1), right), down);
}

Texel MipMap::sample(float u, float v, float level, Wrap wrap_u, Wrap wrap_v) const {
    const float l = std::clamp(level, 0.f, float(levels_.size() - 1));
    const auto below = std::size_t(l);
    // Four positions are computed at once: across and down in the finer level, across and down in the coarser one. Texel centres
    // lie at half integers, and row 0 is at the top, where v = 1.
    const float x = folded(u, wrap_u), y = folded(1 - v, wrap_v);
    const Four size = optics::load<Four>(&sizes_[2 * below]), place = Four(Texel{x, y, x, y}) * size - Four(0.5f);
    const Four first = optics::floor(place), between = place - first;
    const auto a = optics::to_int(first).v, b = a + 1;
    int low[4], high[4];
    for (int k = 0; k < 4; ++k) {
        low[k] = int(a[k]);
        high[k] = int(b[k]);
    }
    // Only positions at the border need wrapping.
    if (optics::any(!(first >= Four(0.f) && first + Four(1.f) < size))) {
        for (int k = 0; k < 4; ++k) {
            const Wrap how = k % 2 ? wrap_v : wrap_u;
            low[k] = wrapped(low[k], int(size.v[k]), how);
            high[k] = wrapped(high[k], int(size.v[k]), how);
        }
    }
    const Texel fine = bilinear(below, low[0], low[1], high[0], high[1], between.v[0], between.v[1]);
    if (l == float(below)) return fine;
    const Texel coarse = bilinear(below + 1, low[2], low[3], high[2], high[3], between.v[2], between.v[3]);
    return mix(fine, coarse, l - float(below));
}

}  // namespace lfdsim
