#include "base/seconds.h"
#include "cli/bench/bench.h"
#include "cli/bench/bench_cases.h"
#include "cli/output/temporary_folder.h"
#include "content/content.h"
#include "image/compare/compare.h"
#include "image/formats/image_file.h"

#include <filesystem>

// Groups "content" and "pictures": making content for the panel; writing, reading and comparing finished pictures.
namespace lfdsim::cli {
namespace {

constexpr double pixels = 3840.0 * 2160;

/// A run of work on a picture of 3840 x 2160 pixels, which it counts.
template <class Work>
std::function<Run(Job&)> timed(Work work) {
    return [work](Job&) {
        const auto start = std::chrono::steady_clock::now();
        work();
        return Run{seconds_since(start), pixels};
    };
}

}  // namespace

void bench_content(Bench& bench) {
    bench.heading("Content: 3840 x 2160 rays at a model; relative to the first");
    const std::string& model = bench.settings.model;
    if (!std::filesystem::exists(model))
        return bench.not_measured("content", "elemental images", model + " does not exist; give --model");
    const Display display = bench_display();
    const Geometry geometry = resolve(display);
    const ContentScene scene(load_model(model), display, geometry);
    const int threads = bench.settings.threads;
    const auto run_of = [](const Picture& p) { return Run{p.seconds, double(p.rays)}; };
    bench.rates(
        "content", "rays",
        bench.measure("content", {{"elemental images",
                                   [&](Job& job) { return run_of(elemental_images(display, geometry, scene, threads, job)); }},
                                  {"reference photograph", [&](Job& job) {
                                       return run_of(reference_photograph(display, geometry, scene, threads, {}, job));
                                   }}}));
}

void bench_pictures(Bench& bench) {
    bench.heading("Pictures: 3840 x 2160 pixels");
    const Display display = bench_display();
    const Image image = pattern("address", display, resolve(display));
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "picture.png";
    const Encoding encoding = display.panel.encoding;
    Image read;
    bench.seconds("pictures", "pixels",
                  bench.measure("pictures", {{"write a PNG", timed([&] {
                                                  write_image(file, image, {8, encoding, {}});
                                              })},
                                             {"read a PNG", timed([&] { read = read_image(file, encoding); })},
                                             {"read a PNG into texels",
                                              timed([&] { read_panel_image(file, encoding, image.width, image.height); })},
                                             {"SSIM, PSNR, RMSE", timed([&] { compare(image, read); })}}));
}

}  // namespace lfdsim::cli
