#include "cli/output/output.h"

#include "base/json_utf8.h"
#include "base/output_file.h"
#include "base/printable.h"
#include "cli/program/arguments.h"
#include "cli/program/input_files.h"
#include "cli/program/interrupt.h"
#include "files/description/display_file.h"
#include "files/description/shell.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

namespace lfdsim::cli {

// The words are those that the system keeps of the program's start.
std::vector<std::string> command_words() {
    std::ifstream file("/proc/self/cmdline", std::ios::binary);
    const std::string all{std::istreambuf_iterator<char>(file), {}};
    std::vector<std::string> words;
    for (std::size_t start = 0; start < all.size(); start += words.back().size() + 1) words.emplace_back(all.c_str() + start);
    return words;
}

std::string command_line() {
    std::string line;
    for (const std::string& word : command_words()) line += (line.empty() ? "" : " ") + shell_word(word);
    return line;
}

void print(std::string_view words) {
    const std::string harmless = printable_lines(words);
    std::string_view text = harmless;
    while (!text.empty()) {
        const ssize_t written = ::write(STDOUT_FILENO, text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0)
            throw std::runtime_error(fmt::format("standard output: cannot be written: {}", std::generic_category().message(errno)));
        text.remove_prefix(std::size_t(written));
    }
}

void print_json(const Json& json) { print(json_utf8(json, 2) + "\n"); }

void write_text(const std::filesystem::path& path, std::string_view text) {
    guard_output(path);
    write_file(path, text);
}

void check_output(const std::string& path) {
    guard_output(path);
    check_writable(path);
}

void OutputOptions::check() const {
    Faults faults;
    faults.of([&] { check_output(path()); });
    faults.of([&] { check_bits(path()); });
    faults.report();
}

void OutputOptions::check_bits(const std::filesystem::path& name) const {
    if (bits_.empty()) return;
    Faults faults;
    faults.of([&] { bits_.word(); });
    if (const std::string kind = name.extension(); kind == ".exr" || kind == ".npy")
        faults.of([&] { throw InputError("--bits", fmt::format("is only for .png; {} stores 32-bit floats", kind)); });
    faults.report();
}

Json OutputOptions::write(const Image& image, Encoding encoding, const Display& display, Metadata about, bool complete,
                          Progress& progress, std::vector<ImageLayer> layers, const std::string& content) const {
    progress.end();
    std::filesystem::path file = path();
    if (!complete) {
        about[incomplete_mark] = "true";
        std::error_code unknown;
        for (int n = 1; std::filesystem::exists(file, unknown); ++n)  // the picture that is there may be complete: it stays
            file = std::filesystem::path(path()).replace_extension((n == 1 ? ".incomplete" : fmt::format(".incomplete-{}", n)) +
                                                                   file.extension().string());
    }
    const CutOff cut = save(file, image, encoding, display, std::move(about), std::move(layers), &progress);
    progress.end();
    Json more = warn(cut, file.string());
    if (complete) return more;
    spdlog::warn("interrupted; {} contains {}{}", file.string(),
                 content.empty() ? "the completed part, the rest is black" : content,
                 keeps_metadata(file) ? ", and is marked incomplete" : "; a file of this kind cannot say that it is incomplete");
    throw Interrupted{};
}

CutOff OutputOptions::save(const std::filesystem::path& path, const Image& image, Encoding encoding, const Display& display,
                           Metadata about, std::vector<ImageLayer> layers, Job* job) const {
    guard_output(path);
    about["Software"] = software;
    about["command"] = command_line();
    about["display"] = write_display(display);
    write_image(path, image, {bits(), encoding, std::move(about), std::move(layers)}, job);
    CutOff cut;
    if (holds_codes(path)) cut.add(image);
    return cut;
}

Json OutputOptions::warn(const CutOff& cut, const std::string& file) const {
    std::string darker;  // auto is about the mean, and may cut off more
    if (command_.knows("--exposure") && !command_.given("--path"))
        darker = command_.given("--exposure") ? fmt::format("an --exposure {:.4g} times smaller, or ", cut.greatest)
                                              : fmt::format("--exposure {:.4g}, or ", 1 / cut.greatest);
    return warn_of_cut_off(file.empty() ? path() : file, cut, darker + keeps_light);
}

Json warn_of_cut_off(const std::string& what, const CutOff& cut, const std::string& remedy) {
    const std::string text = cut.text();
    if (text.empty()) return Json::object();
    spdlog::warn("{}: {}; {}", what, text, remedy);
    return {{"cut_off", {{"pixels_share", cut.pixels_share()}, {"light_share", cut.light_share()}, {"greatest", cut.greatest}}}};
}

void end_interrupted() {
    spdlog::warn("interrupted; nothing was complete, so nothing was written");
    throw Interrupted{};
}

void end_interrupted(const std::filesystem::path& folder, const std::string& finished, bool resumable) {
    spdlog::warn("interrupted; {} contains {}{}", folder.string(), finished,
                 resumable ? "; the same command with --resume continues it" : "");
    throw Interrupted{};
}

}  // namespace lfdsim::cli
