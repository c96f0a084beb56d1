#include "content/texture.h"

#include "image/encoding.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

int wrapped(int i, int size, Wrap how) {
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

// Folded into a few periods first, so that huge coordinates of strange files stay exact enough and fit an int.
float folded(float x, Wrap how) { return how == Wrap::clamp ? std::clamp(x, -1.f, 2.f) : x - 2 * std::floor(x / 2); }

Rgb mix(const Rgb& a, const Rgb& b, float t) { return {a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t}; }

}  // namespace

Pyramid::Pyramid(const Texture& t) : light_(decode_table(Encoding::srgb, 8).data()) {
    Level base{t.width, t.height, {}};
    base.codes.resize(std::size_t(t.width) * t.height);
    for (std::size_t i = 0; i < base.codes.size(); ++i)
        base.codes[i] = t.rgba[4 * i] | std::uint32_t(t.rgba[4 * i + 1]) << 8 | std::uint32_t(t.rgba[4 * i + 2]) << 16;
    levels_.push_back(std::move(base));
    while (levels_.back().width > 1 || levels_.back().height > 1) {
        const Level& fine = levels_.back();
        Level coarse{std::max(1, fine.width / 2), std::max(1, fine.height / 2), {}};
        coarse.codes.resize(std::size_t(coarse.width) * coarse.height);
        for (int y = 0; y < coarse.height; ++y) {
            Image mean(coarse.width, 1);
            for (int x = 0; x < coarse.width; ++x) {
                for (int k = 0; k < 4; ++k) {
                    const int fx = std::min(2 * x + (k & 1), fine.width - 1), fy = std::min(2 * y + (k >> 1), fine.height - 1);
                    const std::uint32_t code = fine.codes[std::size_t(fy) * fine.width + fx];
                    for (int c = 0; c < 3; ++c) mean.at(x, 0)[c] += 0.25f * light_[code >> (8 * c) & 255];
                }
            }
            const std::vector<std::uint8_t> codes = encode8(mean, Encoding::srgb);
            for (std::size_t x = 0; x < std::size_t(coarse.width); ++x)
                coarse.codes[std::size_t(y) * coarse.width + x] =
                    codes[3 * x] | std::uint32_t(codes[3 * x + 1]) << 8 | std::uint32_t(codes[3 * x + 2]) << 16;
        }
        levels_.push_back(std::move(coarse));
    }
}

Rgb Pyramid::bilinear(const Level& l, float u, float v, Wrap wrap_u, Wrap wrap_v) const {
    // Texel centres lie at half integers, row 0 at the top where v = 1.
    const float x = folded(u, wrap_u) * float(l.width) - 0.5f, y = folded(1 - v, wrap_v) * float(l.height) - 0.5f;
    const float left = std::floor(x), top = std::floor(y);
    const int x0 = wrapped(int(left), l.width, wrap_u), x1 = wrapped(int(left) + 1, l.width, wrap_u);
    const int y0 = wrapped(int(top), l.height, wrap_v), y1 = wrapped(int(top) + 1, l.height, wrap_v);
    const auto texel = [&](int i, int j) {
        const std::uint32_t code = l.codes[std::size_t(j) * l.width + i];
        return Rgb{light_[code & 255], light_[code >> 8 & 255], light_[code >> 16 & 255]};
    };
    return mix(mix(texel(x0, y0), texel(x1, y0), x - left), mix(texel(x0, y1), texel(x1, y1), x - left), y - top);
}

Rgb Pyramid::sample(float u, float v, float level, Wrap wrap_u, Wrap wrap_v) const {
    const float l = std::clamp(level, 0.f, float(levels_.size() - 1)), below = std::floor(l);
    const Rgb fine = bilinear(levels_[std::size_t(below)], u, v, wrap_u, wrap_v);
    if (l == below) return fine;
    return mix(fine, bilinear(levels_[std::size_t(below) + 1], u, v, wrap_u, wrap_v), l - below);
}

}  // namespace lfdsim
