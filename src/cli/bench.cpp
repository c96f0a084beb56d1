#include "cli/arguments.h"
#include "cli/bench_cases.h"
#include "cli/commands.h"
#include "cli/memory.h"
#include "cli/output.h"
#include "content/content.h"
#include "engine/devices.h"
#include "engine/render.h"
#include "image/image_file.h"

#include <fmt/format.h>
#include <tbb/info.h>
#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <filesystem>

// lfdsim bench: one display, one change at a time. Rates count samples as traced, so "no diffuser", one ray a pixel, shows what a
// pixel costs beside its samples. Relative figures come from the same band of rows in the same run, as machines differ and drift.
namespace lfdsim::cli {
namespace {

struct Arguments {
    bool json = false, quick = false, model_given = false;
    std::string threads, kernel, model = "/usr/share/assimp/models/BLEND/Suzanne_248.blend";
};

template <class Work>
double seconds_of(Work work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

class Bench {
  public:
    explicit Bench(const Arguments& args) : json_(args.json), repeats_(args.quick ? 1 : 3) {}

    // The best of some runs: what other programs take from the machine is not the renderer's cost.
    double render_rate(const Display& d, const RenderOptions& options, int repeats) {
        if (panel_.columns() == 0) panel_ = noise(d.panel.pixels[0], d.panel.pixels[1]);
        const Geometry geometry = resolve(d);
        double best = 0;
        for (int i = 0; i < repeats; ++i) {
            const Rendering r = render(d, geometry, panel_, options, job_);
            best = std::max(best, double(r.samples) / r.seconds / 1e6);
        }
        return best;
    }
    double render_rate(const Display& d, const RenderOptions& options) { return render_rate(d, options, repeats_); }

    void heading(const char* text) {
        if (!json_) print(fmt::format("\n{}\n", text));
    }
    void row(const char* group, Json values, const std::string& text) {
        all_[group].push_back(std::move(values));
        if (!json_) print("  " + text + "\n");
    }
    void rate_row(const char* group, const std::string& name, const char* unit, double rate, double relative) {
        row(group, {{"name", name}, {fmt::format("m{}_per_s", unit), rate}, {"relative", relative}},
            fmt::format("{:<28} {:8.1f} million {}/s {:8.2f}", name, rate, unit, relative));
    }
    void seconds_row(const std::string& name, double seconds) {
        row("seconds", {{"name", name}, {"seconds", seconds}}, fmt::format("{:<28} {:8.3f} s", name, seconds));
    }
    void note_row(const char* group, const std::string& name, const std::string& why) {
        row(group, {{"name", name}, {"not_measured", why}}, fmt::format("{:<28} not measured: {}", name, why));
    }
    void finish() const {
        if (json_) print_json(all_);
    }
    int repeats() const { return repeats_; }

  private:
    // The worst case for caches and the usual one under a diffuser: no pixel says anything about its neighbours.
    static Texels noise(std::int64_t columns, std::int64_t rows) {
        Texels texels(columns, rows);
        for (std::int64_t i = 0; i < columns * rows * 4; ++i)
            texels.data()[i] = i % 4 == 3 ? 0.0f : float(std::uint32_t(i) * 2654435761u >> 8) * 0x1p-24f;
        return texels;
    }

    bool json_;
    int repeats_;
    Texels panel_;
    Job job_;
    Json all_ = Json::object();
};

// A band of full rows, for what need not take seconds.
Rect band(const Display& d) {
    const auto [width, height] = d.camera.resolution;
    return {0, int(height * 9 / 20), int(width), int(height * 11 / 20)};
}

void bench_rendering(const Arguments& args, int threads, Bench& bench) {
    const Display display = bench_display();
    const RenderOptions all{threads, args.kernel, {}}, part{threads, args.kernel, band(display)};
    bench.heading("Rendering: plano-convex lenses, opaque, Schlick, diffuser, 3840 x 2160 x 100; relative to its middle rows");
    const double paper = bench.render_rate(display, part);
    if (!args.quick) {
        const double rate = bench.render_rate(display, all, 2);
        bench.rate_row("rendering", "whole picture", "samples", rate, rate / paper);
    }
    for (const Duty& duty : duties) {
        Display changed = display;
        duty.change(changed);
        const double rate = bench.render_rate(changed, part);
        bench.rate_row("rendering", duty.name, "samples", rate, rate / paper);
    }

    bench.heading("Kernels and threads: the middle rows; relative to the first");
    double first = 0;
    for (const KernelInfo& kernel : kernels()) {
        if (!kernel.available) continue;
        for (const int n : {threads, 1}) {
            const double rate = bench.render_rate(display, {n, kernel.name, band(display)}, 1);
            if (first == 0) first = rate;
            bench.rate_row("kernels", fmt::format("{}, {} thread{}", kernel.name, n, n == 1 ? "" : "s"), "samples", rate,
                           rate / first);
            if (threads == 1) break;
        }
    }
}

void bench_content(const Arguments& args, int threads, Bench& bench) {
    bench.heading("Content: 3840 x 2160 rays at a model");
    if (!std::filesystem::exists(args.model))
        return bench.note_row("content", "elemental images", args.model + " does not exist; give --model");
    const Display display = bench_display();
    const Geometry geometry = resolve(display);
    const Scene scene(load_model(args.model), display, geometry);
    Job job;
    double images = 0, photos = 0;
    for (int i = 0; i < bench.repeats(); ++i) {
        const Picture image = elemental_images(display, geometry, scene, threads, job);
        const Picture photo = reference_photograph(display, geometry, scene, threads, {}, job);
        images = std::max(images, double(image.rays) / image.seconds / 1e6);
        photos = std::max(photos, double(photo.rays) / photo.seconds / 1e6);
    }
    bench.rate_row("content", "elemental images", "rays", images, 1);
    bench.rate_row("content", "reference photograph", "rays", photos, photos / images);
}

void bench_start(const RenderOptions& options, Bench& bench) {
    bench.heading("Files and measures: 3840 x 2160 pixels");
    const Display display = bench_display();
    const Geometry geometry = resolve(display);
    const Image image = pattern("address", display, geometry);
    const std::filesystem::path file = std::filesystem::temp_directory_path() / fmt::format("lfdsim-bench-{}.png", getpid());
    Job job;
    bench.seconds_row("write a PNG", seconds_of([&] { write_image(file, image, {8, display.panel.encoding, {}}); }));
    Image read;
    double start = 0;
    try {
        bench.seconds_row("read a PNG", seconds_of([&] { read = read_image(file, display.panel.encoding); }));
        start = seconds_of([&] {
            const Texels panel = read_panel_image(file, display.panel.encoding, display.panel.pixels[0], display.panel.pixels[1]);
            RenderOptions corner = options;
            corner.crop = Rect{0, 0, 16, 16};
            render(display, geometry, panel, corner, job);
        });
    } catch (...) {
        std::filesystem::remove(file);
        throw;
    }
    std::filesystem::remove(file);
    bench.seconds_row("panel image to first samples", start);
    bench.seconds_row("SSIM, PSNR, RMSE", seconds_of([&] { compare(image, read); }));
}

void run(const Arguments& args) {
    const int threads =
        args.threads.empty() ? tbb::info::default_concurrency() : int(whole_number("--threads", args.threads, 1, 1024));
    const std::string kernel = choose_kernel(args.kernel).name;
    if (std::error_code error; args.model_given && !std::filesystem::exists(args.model, error))
        throw InputError("--model", args.model + " does not exist");
    const Display display = bench_display();
    require_picture_memory(display.camera.resolution[0], display.camera.resolution[1], texel_bytes(display));
    if (!args.json) print(fmt::format("kernel {}, {} threads, best of {}\n", kernel, threads, args.quick ? 1 : 3));
    Bench bench(args);
    bench_rendering(args, threads, bench);
    bench_content(args, threads, bench);
    bench_start({threads, args.kernel, {}}, bench);
    bench.finish();
}

}  // namespace

void add_bench(CLI::App& program) {
    const auto args = std::make_shared<Arguments>();
    CLI::App& command = *program.add_subcommand("bench", "How fast this machine renders, and what each duty costs");
    command.add_flag("--quick", args->quick, "One run of each, without the whole picture");
    command.add_option("--threads", args->threads, "Threads to use; default: one per processor")->type_name("N");
    command
        .add_option("--kernel", args->kernel,
                    "Instruction set; default: environment variable LFDSIM_KERNEL, else the best there is")
        ->type_name("scalar|baseline|avx2|avx512");
    const CLI::Option* model =
        command.add_option("--model", args->model, "Mesh file for the content's part")->type_name("FILE")->capture_default_str();
    command.add_flag("--json", args->json, "Print results as JSON");
    command.footer("Example:\n  lfdsim bench --quick --threads 1");
    command.callback([args, model] {
        args->model_given = model->count() > 0;
        run(*args);
    });
}

}  // namespace lfdsim::cli
