// The renderer's parts under Google Benchmark: a tile of each kernel and kind of lens, the elementary functions. Built with
// -D LFDSIM_BENCHMARKS=ON; usage: lfdsim-parts [--benchmark_filter=REGEX]. items/s: samples, or function values, a second.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <vector>

#include "cli/bench/bench_cases.h"
#include "engine/render.h"
#include "simd/elementary.h"
#include "simd/simd.h"

namespace lfdsim {
namespace {

// One tile of the renderer on one thread, including the start of a render, some per cent of the time.
void tile(benchmark::State& state, const std::string& kernel, void (*change)(Display&)) {
    Display display = cli::bench_display();
    change(display);
    static const Texels panel = cli::noise_panel(display);
    const Geometry geometry = resolve(display);
    Job job;
    std::int64_t samples = 0;
    for (auto _ : state) {
        const Rendering r = render(display, geometry, panel, {1, kernel, Rect{1920, 1072, 1984, 1088}}, job);
        benchmark::DoNotOptimize(r.image.rgb.data());
        samples += r.samples;
    }
    state.SetItemsProcessed(samples);
}

using F = optics::Lane<4>;  // this file is compiled for the baseline instruction set

template <class Function>
void values(benchmark::State& state, float low, float high, Function function) {
    std::vector<float> numbers(1024);  // fits into the first-level cache
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = low + (high - low) * float(i) / float(numbers.size() - 1);
    for (auto _ : state)
        for (std::size_t i = 0; i < numbers.size(); i += 4) {
            F result = function(optics::load<F>(&numbers[i]));
            benchmark::DoNotOptimize(result.v);
        }
    state.SetItemsProcessed(state.iterations() * std::int64_t(numbers.size()));
}

template <bool small>
F sine_and_cosine(F a) {
    F sine, cosine;
    optics::sincos(a, small, sine, cosine);
    return sine + cosine;
}

[[maybe_unused]] const bool registered = [] {
    for (const KernelInfo& kernel : kernels())
        if (kernel.available)
            for (const cli::Duty& glass : cli::glasses)
                benchmark::RegisterBenchmark(fmt::format("tile/{}/{}", kernel.name, glass.name).c_str(), tile, kernel.name,
                                             glass.change)
                    ->Unit(benchmark::kMillisecond);
    const auto add = [](const char* name, float low, float high, F (*function)(F)) {
        benchmark::RegisterBenchmark(name, values<F (*)(F)>, low, high, function);
    };
    add("values/sincos, small", -0.05f, 0.05f, sine_and_cosine<true>);
    add("values/sincos", -1.5f, 1.5f, sine_and_cosine<false>);
    add("values/log2", 0.01f, 100, [](F a) { return optics::log2(a); });
    add("values/exp2", -20, 20, [](F a) { return optics::exp2(a); });
    add("values/power", 0.01f, 1, [](F a) { return optics::power(a, 2.5f); });
    add("values/erfinv", -0.999f, 0.999f, [](F a) { return optics::erfinv(a); });
    add("values/sqrt", 0.01f, 100, [](F a) { return optics::sqrt(a); });
    return true;
}();

}  // namespace
}  // namespace lfdsim

BENCHMARK_MAIN();
