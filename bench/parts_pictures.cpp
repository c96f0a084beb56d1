// Files, codes, texels and measures of pictures under Google Benchmark. items/s: pixels a second of wall time, since some use
// all processors.
#include <benchmark/benchmark.h>

#include "cli/bench/bench_cases.h"
#include "cli/output/temporary_folder.h"
#include "content/content.h"
#include "image/compare/compare.h"
#include "image/formats/encoding.h"
#include "image/formats/image_file.h"

namespace lfdsim {
namespace {

const Image& picture() {  // 1920 x 1080, no two neighbours alike
    static const Image image = [] {
        Display display = cli::bench_display();
        display.panel.pixels = {1920, 1080};
        display.panel.pixel_pitch_mm = 0.2;
        return pattern("address", display, resolve(display));
    }();
    return image;
}

template <class Work>
void pixels(benchmark::State& state, Work work) {
    for (auto _ : state) work();
    state.SetItemsProcessed(state.iterations() * picture().width * picture().height);
}

void read_file(benchmark::State& state, const char* name, int bits) {
    const cli::TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / name;
    write_image(file, picture(), {bits, Encoding::srgb, {}});
    pixels(state, [&] { benchmark::DoNotOptimize(read_image(file, Encoding::srgb).rgb.data()); });
}
void write_file(benchmark::State& state, const char* name, int bits) {
    const cli::TemporaryFolder folder;
    pixels(state, [&] { write_image(folder.path() / name, picture(), {bits, Encoding::srgb, {}}); });
}
void encode(benchmark::State& state, Encoding encoding) {
    pixels(state, [&] { benchmark::DoNotOptimize(encode8(picture(), encoding).data()); });
}
void texels(benchmark::State& state) {
    pixels(state, [] { benchmark::DoNotOptimize(make_texels(picture()).data()); });
}
void measures(benchmark::State& state) {
    Image other = picture();
    for (float& light : other.rgb) light *= 0.9f;
    pixels(state, [&] { benchmark::DoNotOptimize(compare(picture(), other).ssim); });
}

#define PICTURES(function, ...) BENCHMARK_CAPTURE(function, __VA_ARGS__)->UseRealTime()->Unit(benchmark::kMillisecond)
PICTURES(read_file, png, "p.png", 8);
PICTURES(read_file, png16, "p.png", 16);
PICTURES(read_file, exr, "p.exr", 8);
PICTURES(read_file, npy, "p.npy", 8);
PICTURES(write_file, png, "p.png", 8);
PICTURES(write_file, exr, "p.exr", 8);
PICTURES(encode, srgb, Encoding::srgb);
PICTURES(encode, linear, Encoding::linear);
BENCHMARK(texels)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(measures)->Name("ssim, psnr, rmse")->UseRealTime()->Unit(benchmark::kMillisecond);
#undef PICTURES

}  // namespace
}  // namespace lfdsim
