#include "cli/output/new_description.h"

#include "base/output_file.h"
#include "cli/output/output.h"
#include "cli/program/interrupt.h"
#include "files/description/display_file.h"
#include "files/description/shell.h"

#include <fmt/format.h>
#include <filesystem>

namespace lfdsim::cli {

void NewDescription::check() const {
    const std::filesystem::path file = path();
    guard_output(file);
    check_replaceable(file);
    if (file.extension() != ".toml") throw InputError("--output", fmt::format("{}: a description's name ends in .toml", path()));
    std::error_code error;
    if (!force_ && std::filesystem::exists(std::filesystem::symlink_status(file, error)))
        throw InputError("--output", fmt::format("{} already exists; --force replaces it", path()));
}

std::string NewDescription::made_by() {
    std::string line;
    for (const std::string& word : command_words()) {
        // The word, or an option's value after its "=", may be a path.
        const std::size_t equals = word.starts_with("--") ? word.find('=') : word.npos,
                          start = equals == word.npos ? 0 : equals + 1;
        const std::filesystem::path value = word.substr(start);
        const bool shortened = line.empty() || value.is_absolute();
        line += (line.empty() ? "" : " ") + shell_word(shortened ? word.substr(0, start) + value.filename().string() : word);
    }
    return line;
}

void NewDescription::write(const std::string& text) const {
    try {
        parse_display(text, path(), {}, std::filesystem::path(path()).parent_path());
    } catch (const InputError& error) {  // everything else in the text has been checked
        throw InputError("--output", fmt::format("the description could not be read ({}); is a file's name not UTF-8?",
                                                 error.problems.front().what));
    }
    write_text(path(), text);
}

}  // namespace lfdsim::cli
