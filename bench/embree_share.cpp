// Embree's share of the time for elemental images and reference photographs; the rest is this program's: setting up rays, shading,
// writing pixels. Also the cost of elemental images at many depths compared with one.
//
// Usage: lfdsim-embree-share DISPLAY.toml MODEL [runs = 5]
//
// Prints JSON, medians: the shares are measured on one thread, the depth sweeps (three at most) on all.
#include "base/seconds.h"
#include "content/content.h"
#include "files/description/display_file.h"

#include <dlfcn.h>
#include <embree3/rtcore.h>
#include <x86intrin.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

namespace {

using Intersect = void(const int*, RTCScene, RTCIntersectContext*, RTCRayHit16*);
Intersect* embree = nullptr;
std::uint64_t ticks_inside = 0, calls = 0;

}  // namespace

/// Replaces Embree's own function, to which it passes every packet: only these calls are timed.
extern "C" void rtcIntersect16(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRayHit16* rays) {
    const std::uint64_t start = __rdtsc();
    embree(valid, scene, context, rays);
    ticks_inside += __rdtsc() - start;
    ++calls;
}

namespace {

using namespace lfdsim;

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// The time that reading the counter twice adds to a call.
double ticks_of_reading() {
    std::vector<double> between;
    for (int i = 0; i < 1001; ++i) {
        const std::uint64_t start = __rdtsc();
        between.push_back(double(__rdtsc() - start));
    }
    return median(between);
}

template <class Make>
void share(const char* name, int runs, Make make) {
    std::vector<double> shares, rates;
    for (int i = 0; i < runs; ++i) {
        ticks_inside = calls = 0;
        const std::uint64_t start = __rdtsc();
        const Picture picture = make();
        const double whole = double(__rdtsc() - start), reading = ticks_of_reading() * double(calls);
        shares.push_back((double(ticks_inside) - reading) / (whole - 2 * reading));
        rates.push_back(double(picture.rays) / picture.seconds / 1e6);
    }
    std::printf("  \"%s\": {\"share_of_embree\": %.3f, \"mrays_per_s\": %.1f, \"packets\": %llu},\n", name, median(shares),
                median(rates), static_cast<unsigned long long>(calls));
}

/// On all threads: reads the model and prepares its scene once, then makes its elemental images at depths a millimetre apart.
void sweep(const Display& display, const Geometry& geometry, const char* model, int runs, Job& job) {
    constexpr int depths = 31;
    std::vector<double> ready, one, all;
    for (int i = 0; i < runs; ++i) {
        const auto start = std::chrono::steady_clock::now();
        const ContentScene scene(load_model(model), display, geometry);
        ready.push_back(seconds_since(start));
        for (int k = 0; k < depths; ++k) {
            const double depth_mm = geometry.content_depth_mm + (k + 1) / 2 * (k % 2 ? 1 : -1);  // that of the display first
            elemental_images(display, geometry, scene.at_depth(depth_mm), 0, job);
            if (k == 0) one.push_back(seconds_since(start));
        }
        all.push_back(seconds_since(start));
    }
    std::printf("  \"ready_s\": %.3f, \"one_depth_s\": %.3f, \"%d_depths_s\": %.3f, \"over_%d_times_one\": %.3f\n", median(ready),
                median(one), depths, median(all), depths, median(all) / (depths * median(one)));
}

}  // namespace

int main(int count, char** words) try {
    if (count < 3) {
        std::fprintf(stderr, "Usage: %s DISPLAY.toml MODEL [runs = 5]\n", words[0]);
        return 2;
    }
    embree = reinterpret_cast<Intersect*>(dlsym(RTLD_NEXT, "rtcIntersect16"));
    if (!embree) throw std::runtime_error("Embree has no rtcIntersect16()");
    const int runs = count > 3 ? std::max(1, std::atoi(words[3])) : 5;
    const Display display = read_display(words[1]);
    const Geometry geometry = resolve(display);
    const ContentScene scene(load_model(words[2]), display, geometry);
    Job job;
    std::printf("{\n");
    share("elemental_images", runs, [&] { return elemental_images(display, geometry, scene, 1, job); });
    share("reference_photograph", runs, [&] { return reference_photograph(display, geometry, scene, 1, {}, job); });
    sweep(display, geometry, words[2], std::min(runs, 3), job);
    std::printf("}\n");
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
