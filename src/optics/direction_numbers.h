// Direction numbers of the Sobol sequence (Joe and Kuo 2008, new-joe-kuo-6). Floor 1; for the host.
#pragma once
#include "optics/traced_display.h"

namespace lfdsim::optics {

/// Returns the direction numbers v_i, i = 0 .. 31, of all dimensions, as fractions of 2^32. Dimension 0 is van der Corput's
/// sequence. The others continue m_1 .. m_s by the recurrence of a primitive polynomial of degree s with the inner coefficients a:
/// v_i = a_1 v_(i-1) + ... + a_(s-1) v_(i-s+1) + v_(i-s) + v_(i-s) / 2^s, sums modulo 2 in each bit.
constexpr DirectionNumbers sobol_directions() {
    // s, a and m_1 .. m_s, which the paper's file lists as dimensions 2 .. 6
    struct Dimension {
        int s, a, m[4];
    };
    constexpr Dimension rows[sampler_dimensions - 1] = {
        {1, 0, {1}}, {2, 1, {1, 3}}, {3, 1, {1, 3, 1}}, {3, 2, {1, 1, 1}}, {4, 1, {1, 1, 3, 3}}};
    DirectionNumbers d{};
    for (int i = 0; i < 32; ++i) d.v[0][i] = 1u << (31 - i);
    for (int k = 1; k < sampler_dimensions; ++k) {
        const Dimension& row = rows[k - 1];
        std::uint32_t* const v = d.v[k];
        for (int i = 0; i < 32; ++i) {
            if (i < row.s) {
                v[i] = std::uint32_t(row.m[i]) << (31 - i);
                continue;
            }
            v[i] = v[i - row.s] ^ (v[i - row.s] >> row.s);
            for (int j = 1; j < row.s; ++j) v[i] ^= std::uint32_t(row.a >> (row.s - 1 - j) & 1) * v[i - j];
        }
    }
    return d;
}

}  // namespace lfdsim::optics
