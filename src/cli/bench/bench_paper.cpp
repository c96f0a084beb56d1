#include "base/seconds.h"
#include "cli/bench/bench.h"
#include "cli/bench/bench_cases.h"
#include "cli/output/temporary_folder.h"
#include "content/content.h"
#include "files/description/display_file.h"
#include "image/formats/image_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <system_error>

// Group "paper": the experiment of the 2019 paper as its user meets it, from the start of the program to the picture's file.
namespace lfdsim::cli {
namespace {

// The figures that the paper gives.
constexpr double paper_seconds = 1, paper_msamples = 829.44, paper_frames_per_s = 20;
constexpr const char* paper_gpu = "GeForce GTX 980";

// A second lfdsim, run as a child process that ends with this one; its standard output is read through a pipe.
class Child {
  public:
    explicit Child(std::vector<std::string> arguments) {
        std::vector<char*> argv{const_cast<char*>("lfdsim")};
        for (std::string& a : arguments) argv.push_back(a.data());
        argv.push_back(nullptr);
        int ends[2];
        if (pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
        output_ = ends[0];
        const pid_t parent = getpid();
        child_ = fork();
        if (child_ == 0) {  // only calls that are safe in a signal handler
            prctl(PR_SET_PDEATHSIG, SIGKILL);
            if (getppid() != parent) _exit(1);  // the parent ended before prctl()
            dup2(ends[1], STDOUT_FILENO);
            execv("/proc/self/exe", argv.data());
            _exit(127);
        }
        close(ends[1]);
        if (child_ < 0) {
            close(output_);
            throw std::system_error(errno, std::generic_category(), "cannot start a second lfdsim");
        }
    }
    ~Child() {
        close(output_);
        if (child_ > 0) {
            kill(child_, SIGKILL);
            wait();
        }
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    /// Waits for the program and returns its output, or "" as soon as the job is cancelled. Throws std::runtime_error if the
    /// program fails.
    std::string finish(const Job& job) {
        std::string text;
        for (char part[4096]; !job.cancelled();) {
            pollfd ready{output_, POLLIN, 0};
            if (poll(&ready, 1, 100) <= 0) continue;  // 100 ms: how long a signal may wait
            const ssize_t got = read(output_, part, sizeof part);
            if (got < 0 && errno == EINTR) continue;
            if (got <= 0) break;
            text.append(part, std::size_t(got));
        }
        if (job.cancelled()) return {};
        const int status = wait();
        child_ = -1;
        if (status != 0 && !job.cancelled()) throw std::runtime_error("the second lfdsim failed, see above");
        return text;
    }

  private:
    int wait() const {
        int status = -1;
        while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
        }
        return status;
    }
    int output_ = -1;
    pid_t child_ = -1;
};

}  // namespace

void bench_paper(Bench& bench) {
    bench.heading(fmt::format("The 2019 paper's case, 3840 x 2160 x 100: {:g} s on a {}, {:g} frames/s interactively",
                              paper_seconds, paper_gpu, paper_frames_per_s));
    // The files of the command, made before anything is timed.
    const TemporaryFolder folder;
    const std::string description = folder.path() / "display.toml", panel = folder.path() / "panel.png";
    const Display display = bench_display();
    std::ofstream(description) << write_display(display);
    write_image(panel, pattern("address", display, resolve(display)), {8, display.panel.encoding, {}});

    std::vector<std::string> render{"render",
                                    description,
                                    "--panel-image",
                                    panel,
                                    "-o",
                                    folder.path() / "view.png",
                                    "--json",
                                    "--progress",
                                    "none",
                                    "--threads",
                                    std::to_string(bench.settings.threads),
                                    "--kernel",
                                    bench.settings.kernel};
    if (bench.settings.quick) render.insert(render.end(), {"--samples", "10"});
    // The start of the program alone, and the whole command.
    double samples = 0;
    std::vector<double> traced;  // seconds of tracing in each run, as the program reports them
    const auto timed = [](const std::vector<std::string>& arguments, Job& job) {
        const auto start = std::chrono::steady_clock::now();
        const std::string text = Child(arguments).finish(job);
        return std::pair(seconds_since(start), text);
    };
    const std::vector<Timing> all = bench.measure("paper", {{"start of the program",
                                                             [&](Job& job) {
                                                                 return Run{timed({"--version"}, job).first, 0};
                                                             }},
                                                            {"start to picture", [&](Job& job) {
                                                                 const auto [seconds, text] = timed(render, job);
                                                                 if (job.cancelled()) return Run{};
                                                                 const Json made = Json::parse(text);
                                                                 samples = made.at("samples");
                                                                 traced.push_back(made.at("seconds"));
                                                                 return Run{seconds, samples};
                                                             }}});
    bench.seconds("paper", "samples", all);
    if (all.size() < 2) return;
    std::sort(traced.begin(), traced.end());
    bench.seconds("paper", "samples", {{"of this, tracing", traced, {}, samples}});
    // The paper's figures, for comparison; the factor only where the work is the same.
    Json paper{{"name", "the 2019 paper"},
               {"gpu", paper_gpu},
               {"seconds", paper_seconds},
               {"msamples_per_s", paper_msamples},
               {"frames_per_s", paper_frames_per_s}};
    std::string text = fmt::format("{:<32} {:8.4f} s on a {}", "the 2019 paper", paper_seconds, paper_gpu);
    if (!bench.settings.quick) {
        paper["start_to_picture_over_it"] = all[1].median() / paper_seconds;
        text += fmt::format("; start to picture takes {:.2f} times that", all[1].median() / paper_seconds);
    }
    bench.row("paper", std::move(paper), text);
}

}  // namespace lfdsim::cli
