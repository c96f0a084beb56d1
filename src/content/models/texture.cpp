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

}  // namespace

double MipMap::bytes() const {
    double bytes = 0;
    for (const Level& level : levels_) bytes += 4. * double(level.codes.size());
    return bytes;
}

MipMap::MipMap(const Texture& t, bool with_alpha) : with_alpha_(with_alpha), light_(decode_table(Encoding::srgb, 8).data()) {
    Level base{t.width, t.height, {}};
    base.codes.resize(std::size_t(t.width) * t.height);
    for (std::size_t i = 0; i < base.codes.size(); ++i)
        base.codes[i] = t.rgba[4 * i] | std::uint32_t(t.rgba[4 * i + 1]) << 8 | std::uint32_t(t.rgba[4 * i + 2]) << 16 |
                        (with_alpha ? std::uint32_t(t.rgba[4 * i + 3]) << 24 : 0xff000000u);
    levels_.push_back(std::move(base));
    while (levels_.back().width > 1 || levels_.back().height > 1) {
        const Level& fine = levels_.back();
        Level coarse{std::max(1, fine.width / 2), std::max(1, fine.height / 2), {}};
        coarse.codes.resize(std::size_t(coarse.width) * coarse.height);
        for (int y = 0; y < coarse.height; ++y) {
            // The mean of the light is weighted by alpha, since transparent texels have no colour.
            Image mean(coarse.width, 1);
            std::vector<float> alpha(std::size_t(coarse.width));
            for (int x = 0; x < coarse.width; ++x) {
                float& whole = alpha[std::size_t(x)];
                for (int k = 0; k < 4; ++k) {
                    const int fx = std::min(2 * x + (k & 1), fine.width - 1), fy = std::min(2 * y + (k >> 1), fine.height - 1);
                    const std::uint32_t code = fine.codes[std::size_t(fy) * fine.width + fx];
                    const float share = 0.25f * alpha_of(code);
                    whole += share;
                    for (int c = 0; c < 3; ++c) mean.at(x, 0)[c] += share * light_[code >> (8 * c) & 255];
                }
                for (int c = 0; c < 3 && whole > 0; ++c) mean.at(x, 0)[c] /= whole;
            }
            const std::vector<std::uint8_t> codes = encode8(mean, Encoding::srgb);
            for (std::size_t x = 0; x < std::size_t(coarse.width); ++x)
                coarse.codes[std::size_t(y) * coarse.width + x] = codes[3 * x] | std::uint32_t(codes[3 * x + 1]) << 8 |
                                                                  std::uint32_t(codes[3 * x + 2]) << 16 |
                                                                  std::uint32_t(255 * alpha[x] + 0.5f) << 24;
        }
        levels_.push_back(std::move(coarse));
    }
    for (const Level& l : levels_) sizes_.insert(sizes_.end(), {float(l.width), float(l.height)});
    sizes_.insert(sizes_.end(), {1, 1});  // sample() reads the next level's size, too
}

Texel MipMap::bilinear(const Level& l, int x0, int y0, int x1, int y1, float right, float down) const {
    const auto texel = [&](int i, int j) {
        const std::uint32_t code = l.codes[std::size_t(j) * std::size_t(l.width) + std::size_t(i)];
        const Texel light{light_[code & 255], light_[code >> 8 & 255], light_[code >> 16 & 255], with_alpha_ ? 1.f : 0.f};
        return with_alpha_ ? light * alpha_of(code) : light;
    };
    return mix(mix(texel(x0, y0), texel(x1, y0), right), mix(texel(x0, y1), texel(x1, y1), right), down);
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
    const Texel fine = bilinear(levels_[below], low[0], low[1], high[0], high[1], between.v[0], between.v[1]);
    if (l == float(below)) return fine;
    const Texel coarse = bilinear(levels_[below + 1], low[2], low[3], high[2], high[3], between.v[2], between.v[3]);
    return mix(fine, coarse, l - float(below));
}

}  // namespace lfdsim
