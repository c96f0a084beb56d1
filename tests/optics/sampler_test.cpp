// Sample points: nets where they are nets, uniform and independent where they are random, the same for ever.
#include <gtest/gtest.h>

#include <functional>

#include "example.h"

namespace lfdsim::optics {
namespace {

using Numbers = std::array<double, sampler_dimensions>;

/// Numbers of samples `from` .. `from + count - 1` of a pixel, in [0, 1].
std::vector<Numbers> points(Sampling kind, std::uint64_t seed, std::uint32_t pixel, std::uint32_t from, std::uint32_t count) {
    Sampler<double> sampler(kind, sampler_dimensions, seed, pixel);
    std::vector<Numbers> all;
    for (std::uint32_t n = 0; n < from + count; ++n, sampler.next(sobol_directions())) {
        if (n < from) continue;
        Numbers& numbers = all.emplace_back();
        for (int d = 0; d < sampler_dimensions; ++d) numbers[d] = (sampler(d) + 1) / 2;
    }
    return all;
}

// A block of 2^k points is a (t, k, 2)-net in base 2: each elementary interval of area 2^(t - k) holds 2^t of them. For Sobol
// points t is the sum of the degrees of the two primitive polynomials, less one each, van der Corput's dimension giving 0
// (Niederreiter 1992, theorem 4.49), and a digital shift changes nothing of that. Degrees: -, 1, 2, 3, 3, 4.
TEST(Sobol, PairsOfDimensionsAreNets) {
    struct Pair {
        int first, second, t;
    };
    for (const Pair pair : {Pair{0, 1, 0}, Pair{2, 3, 3}, Pair{4, 5, 5}}) {
        for (std::uint32_t pixel : {0u, 77u, 123456u}) {
            for (int k = pair.t; k <= 10; ++k) {
                for (std::uint32_t block : {0u, 3u}) {
                    const auto net = points(Sampling::sobol, 5, pixel, block << k, 1u << k);
                    for (int a = 0; a <= k - pair.t; ++a) {
                        const int rows = 1 << a, columns = 1 << (k - pair.t - a);
                        std::vector<int> counts(rows * columns);
                        for (const Numbers& p : net) {
                            ++counts[bin(p[pair.first], rows) * columns + bin(p[pair.second], columns)];
                        }
                        for (int n : counts) ASSERT_EQ(n, 1 << pair.t) << pair.first << " k " << k << " a " << a;
                    }
                }
            }
        }
    }
}

TEST(Sobol, EachDimensionIsStratified) {
    for (int k = 0; k <= 12; ++k) {
        const auto net = points(Sampling::sobol, 9, 4242, 1u << k, 1u << k);
        for (int d = 0; d < sampler_dimensions; ++d) {
            std::vector<int> counts(1u << k);
            for (const Numbers& p : net) ++counts[bin(p[d], 1 << k)];
            for (int n : counts) ASSERT_EQ(n, 1) << "dimension " << d << " k " << k;
        }
    }
}

constexpr int bins = 16, pairs = 100000;

/// Chi-square over pairs of numbers that should be independent and uniform.
double dependence(const std::function<std::array<double, 2>(std::uint32_t)>& pair) {
    std::vector<int> counts(bins * bins);
    for (std::uint32_t n = 0; n < pairs; ++n) {
        const auto [u, v] = pair(n);
        ++counts[bin(u, bins) * bins + bin(v, bins)];
    }
    return chi_square(counts);
}

double number(Sampling kind, std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample, int dimension) {
    Sampler<double> sampler(kind, sampler_dimensions, seed, pixel);
    if (kind == Sampling::random)
        sampler.sample = sample;
    else
        for (std::uint32_t n = 0; n < sample; ++n) sampler.next(sobol_directions());
    return (sampler(dimension) + 1) / 2;
}

class Independence : public testing::TestWithParam<Sampling> {};
INSTANTIATE_TEST_SUITE_P(Both, Independence, testing::Values(Sampling::sobol, Sampling::random));

TEST_P(Independence, OfPixelsDimensionsAndSeeds) {
    const Sampling kind = GetParam();
    for (int d = 0; d < sampler_dimensions; ++d) {
        for (std::uint32_t apart : {1u, 2u, 64u, 3840u}) {  // neighbours in a row, in a packet, in a column
            EXPECT_LT(dependence([&](std::uint32_t n) {
                          return std::array{number(kind, 0, n, 3, d), number(kind, 0, n + apart, 3, d)};
                      }),
                      unlikely)
                << "pixels " << apart << " apart, dimension " << d;
        }
        const int other = (d + 1) % sampler_dimensions;
        EXPECT_LT(dependence([&](std::uint32_t n) {
                      return std::array{number(kind, 1, n, 0, d), number(kind, 1, n, 0, other)};
                  }),
                  unlikely)
            << "dimensions " << d << ", " << other;
        EXPECT_LT(dependence([&](std::uint32_t n) {
                      return std::array{number(kind, 6, n, 1, d), number(kind, 7, n, 1, d)};
                  }),
                  unlikely)
            << "seeds, dimension " << d;
        EXPECT_LT(dependence([&](std::uint32_t n) {
                      return std::array{number(kind, n, 8, 1, d), number(kind, n + 1, 8, 1, d)};
                  }),
                  unlikely)
            << "one pixel, all seeds, dimension " << d;
    }
}

TEST(Random, SamplesAreIndependent) {
    for (int d = 0; d < sampler_dimensions; ++d) {
        for (std::uint32_t apart : {1u, 2u, 16u, 256u}) {
            for (std::uint32_t pixel : {0u, 1u, 999983u}) {
                EXPECT_LT(dependence([&](std::uint32_t n) {
                              return std::array{number(Sampling::random, 0, pixel, n, d),
                                                number(Sampling::random, 0, pixel, n + apart, d)};
                          }),
                          unlikely)
                    << "samples " << apart << " apart, pixel " << pixel << ", dimension " << d;
            }
        }
        EXPECT_LT(dependence([&](std::uint32_t n) {
                      return std::array{number(Sampling::random, 0, 5, n, d), number(Sampling::random, 0, 6, n, d)};
                  }),
                  unlikely)
            << "neighbours through all samples, dimension " << d;
    }
}

// The mean over n samples, averaged over many pixels, is the integral: within 6 standard errors, found from the pixels' own spread.
// exp(u) v^2 has the integral (e - 1)/3 over the unit square, a step over the triangle u + v < 2/3 has 2/9.
TEST_P(Independence, MeansAreUnbiased) {
    struct Case {
        std::function<double(double, double)> f;
        double integral;
    };
    const Case cases[] = {{[](double u, double v) { return std::exp(u) * v * v; }, (std::numbers::e - 1) / 3},
                          {[](double u, double v) { return u + v < 2.0 / 3 ? 1.0 : 0.0; }, 2.0 / 9}};
    for (const Case& c : cases) {
        for (int first : {0, 2, 4}) {
            for (std::uint32_t samples : {1u, 3u, 16u, 100u}) {
                constexpr int pixels = 4000;
                double sum = 0, squares = 0;
                for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
                    Sampler<double> sampler(GetParam(), sampler_dimensions, 3, pixel);
                    double mean = 0;
                    for (std::uint32_t n = 0; n < samples; ++n, sampler.next(sobol_directions())) {
                        mean += c.f((sampler(first) + 1) / 2, (sampler(first + 1) + 1) / 2) / samples;
                    }
                    sum += mean;
                    squares += mean * mean;
                }
                const double mean = sum / pixels, error = std::sqrt((squares / pixels - mean * mean) / pixels);
                EXPECT_NEAR(mean, c.integral, 6 * error) << "dimension " << first << ", " << samples << " samples";
            }
        }
    }
}

TEST(Sampler, LastNumbersAreStillInTheInterval) {
    Sampler<float> sampler(Sampling::sobol, 2, 0, 0);
    for (std::uint32_t bits : {0u, 0x7fffffffu, 0x80000000u, 0xffffffffu}) {
        sampler.key[0] = bits;
        EXPECT_GE(sampler(0), -1.0f);
        EXPECT_LE(sampler(0), 1.0f);
    }
}

// Pictures must stay the same from release to release: the numbers are a pure function of (seed, pixel, sample, dimension).
TEST(Sampler, NumbersNeverChange) {
    auto bits = [](Sampling kind, std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample, int dimension) {
        return std::int64_t((number(kind, seed, pixel, sample, dimension) * 2 - 1) * 0x1p31);
    };
    EXPECT_EQ(bits(Sampling::sobol, 0, 0, 0, 0), 2133699716);
    EXPECT_EQ(bits(Sampling::sobol, 1, 4147200, 99, 1), -670594950);
    EXPECT_EQ(bits(Sampling::sobol, 7, 1000, 1023, 5), -2031280740);
    EXPECT_EQ(bits(Sampling::random, 0, 0, 0, 0), 1558534369);
    EXPECT_EQ(bits(Sampling::random, 1, 4147200, 99, 1), 1652167721);
    EXPECT_EQ(bits(Sampling::random, 0x7fffffffffffffff, 1000, 16777215, 5), -1699265625);
}

}  // namespace
}  // namespace lfdsim::optics
