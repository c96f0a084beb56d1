// A yardstick for this machine: one fixed case of rendering, written flat: camera, box diffuser, spherical cap, flat back,
// Lambertian panel, Schlick weights, one texel read. It takes shortcuts that a simulator cannot take: it tests only the cell under
// the ray, has only one kind of lens, checks nothing, lets the compiler reorder and contract (-ffast-math), reads packed texels.
// The display is bench/yardstick.toml. Usage: yardstick [samples = 100] [threads = all] [width = 3840] [height = 2160]
// Prints JSON with msamples_per_s.
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <thread>
#include <vector>
#ifdef __AVX512F__
#include <immintrin.h>
#endif

namespace {

constexpr int N = 16;
typedef float F __attribute__((vector_size(4 * N)));
typedef std::int32_t I __attribute__((vector_size(4 * N)));

#ifdef __AVX512F__
F root(F a) { return (F)_mm512_sqrt_ps((__m512)a); }
I fetch(const std::uint32_t* from, I index, I valid) {
    return (I)_mm512_mask_i32gather_epi32(_mm512_setzero_si512(), _mm512_movepi32_mask((__m512i)valid), (__m512i)index, from, 4);
}
#else
F root(F a) {
    for (int k = 0; k < N; ++k) a[k] = std::sqrt(a[k]);
    return a;
}
I fetch(const std::uint32_t* from, I index, I valid) {
    I texel{};
    for (int k = 0; k < N; ++k) texel[k] = std::int32_t(from[index[k] & valid[k]]);
    return texel;
}
#endif
F whole(F a) {
    const F t = __builtin_convertvector(__builtin_convertvector(a, I), F);
    return t - (t > a ? F{} + 1.0f : F{});
}
float sum(F a) {
    float s = 0;
    for (int k = 0; k < N; ++k) s += a[k];
    return s;
}

// mm: a 384 x 216 panel under 8.8 lenses, seen from 2 m through a diffuser of 0.05 rad
constexpr int columns = 3840, rows = 2160;
constexpr float panel_w = 384, panel_h = 216, pitch = 8.8f, radius = 4.4f, sphere = 9, n = 1.49f, base_z = 12;
constexpr float diffuser_z = 60, omega = 0.05f, eye_z = 2000, r0 = (n - 1) * (n - 1) / ((n + 1) * (n + 1));

struct Points {  // a rank-1 lattice, shifted in each pixel
    std::vector<float> a, b;
    explicit Points(int samples) {
        for (int i = 0; i < (samples + N - 1) / N * N; ++i) {
            a.push_back(float(std::fmod((i + 0.5) * 0.7548776662466927, 1.0)));
            b.push_back(float(std::fmod((i + 0.5) * 0.5698402909980532, 1.0)));
        }
    }
};

void pixel(int x, int y, int width, int height, int samples, const Points& points, const std::uint32_t* texels, float* out) {
    const float apex_z = base_z + 1 + (sphere - std::sqrt(sphere * sphere - radius * radius)), centre_z = apex_z - sphere;
    const F one = F{} + 1.0f;
    I lanes;
    for (int k = 0; k < N; ++k) lanes[k] = k;
    float dx = ((x + .5f) / width - .5f) * panel_w, dy = ((y + .5f) / height - .5f) * panel_h, dz = -eye_z;
    const float inverse = 1 / std::sqrt(dx * dx + dy * dy + dz * dz);
    dx *= inverse, dy *= inverse, dz *= inverse;
    const float reach = (diffuser_z - eye_z) / dz, ox = dx * reach, oy = dy * reach;
    std::uint32_t h = (std::uint32_t(x) * 73856093u) ^ (std::uint32_t(y) * 19349663u);
    h ^= h >> 16, h *= 0x7feb352du, h ^= h >> 15, h *= 0x846ca68bu, h ^= h >> 16;
    const float shift_a = float(h & 0xffff) / 65536.f, shift_b = float(h >> 16) / 65536.f;
    F red{}, green{}, blue{};
    for (int s = 0; s < samples; s += N) {
        F a, b;
        std::memcpy(&a, &points.a[s], sizeof a);
        std::memcpy(&b, &points.b[s], sizeof b);
        a += shift_a, b += shift_b;
        a -= a >= 1 ? one : F{}, b -= b >= 1 ? one : F{};
        a = (a - .5f) * omega, b = (b - .5f) * omega;
        const F a2 = a * a, b2 = b * b;
        const F sa = a * (1 - a2 * (1 / 6.f)), ca = 1 + a2 * (a2 * (1 / 24.f) - .5f);
        const F sb = b * (1 - b2 * (1 / 6.f)), cb = 1 + b2 * (b2 * (1 / 24.f) - .5f);
        const F ix = ca * dx + sa * dz, tz = ca * dz - sa * dx, iy = cb * dy - sb * tz, iz = sb * dy + cb * tz;
        F t = (apex_z - diffuser_z) / iz;
        const F px = ox + ix * t, py = oy + iy * t;
        const F cx = (whole(px * (1 / pitch)) + .5f) * pitch, cy = (whole(py * (1 / pitch)) + .5f) * pitch;
        F lx = px - cx, ly = py - cy;
        const F half_b = lx * ix + ly * iy + sphere * iz, disc = half_b * half_b - (lx * lx + ly * ly);
        I ok = disc > 0;
        t = -half_b - root(disc > 0 ? disc : F{});
        lx += ix * t, ly += iy * t;
        const F lz = sphere + iz * t;
        ok &= lx * lx + ly * ly <= radius * radius;
        const F nx = lx * (1 / sphere), ny = ly * (1 / sphere), nz = lz * (1 / sphere);
        const F ci = -(nx * ix + ny * iy + nz * iz), eta = one / n, m = eta * ci - root(1 - eta * eta * (1 - ci * ci));
        const F ux = eta * ix + m * nx, uy = eta * iy + m * ny, uz = eta * iz + m * nz;
        F q = 1 - ci, weight = 1 - (r0 + (1 - r0) * q * q * q * q * q);
        t = (base_z - centre_z - lz) / uz;
        const F fx = lx + ux * t, fy = ly + uy * t;
        ok &= fx * fx + fy * fy <= radius * radius;
        const F k = 1 - n * n * (1 - uz * uz);
        ok &= k > 0;
        const F co = root(k > 0 ? k : one);
        q = 1 - co, weight *= 1 - (r0 + (1 - r0) * q * q * q * q * q);
        t = base_z / co;
        const F u = (fx + n * ux * t + cx) * (columns / panel_w) + columns / 2.f;
        const F v = (fy + n * uy * t + cy) * (rows / panel_h) + rows / 2.f;
        ok &= (u >= 0) & (u < columns) & (v >= 0) & (v < rows);
        ok &= lanes + s < samples;
        const I texel = fetch(texels, __builtin_convertvector(v, I) * columns + __builtin_convertvector(u, I), ok);
        weight = ok ? weight : F{};
        red += weight * __builtin_convertvector(texel & 0x7ff, F);
        green += weight * __builtin_convertvector((texel >> 11) & 0x7ff, F);
        blue += weight * __builtin_convertvector((texel >> 22) & 0x3ff, F);
    }
    out[0] = sum(red) / float(samples), out[1] = sum(green) / float(samples), out[2] = sum(blue) / float(samples);
}

}  // namespace

int main(int argc, char** argv) {
    const int samples = argc > 1 ? std::atoi(argv[1]) : 100;
    const int threads = argc > 2 ? std::atoi(argv[2]) : int(std::thread::hardware_concurrency());
    const int width = argc > 3 ? std::atoi(argv[3]) : 3840, height = argc > 4 ? std::atoi(argv[4]) : 2160;
    std::vector<std::uint32_t> texels(std::size_t(columns) * rows);
    for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = std::uint32_t(i) * 2654435761u;
    const Points points(samples);
    std::vector<float> image(std::size_t(width) * height * 3);
    std::atomic<int> next_row{0};
    const auto start = std::chrono::steady_clock::now();
    std::vector<std::thread> pool;
    for (int i = 0; i < threads; ++i) {
        pool.emplace_back([&] {
            for (int y; (y = next_row++) < height;)
                for (int x = 0; x < width; ++x)
                    pixel(x, y, width, height, samples, points, texels.data(), &image[(std::size_t(y) * width + x) * 3]);
        });
    }
    for (auto& thread : pool) thread.join();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    double mean = 0;  // keeps the compiler from removing the work
    for (const float f : image) mean += f;
    std::printf("{\"threads\": %d, \"seconds\": %.4f, \"msamples_per_s\": %.1f, \"mean\": %.4f}\n", threads, seconds,
                double(width) * height * samples / seconds / 1e6, mean / double(image.size()));
}
