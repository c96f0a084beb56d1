#include "cli/program/commands.h"

#include <fmt/format.h>
#include <unistd.h>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <system_error>
#include <vector>

// lfdsim study and lfdsim tolerance: commands of the Python package. This process becomes the Python interpreter that runs them.
namespace lfdsim::cli {
namespace {

namespace fs = std::filesystem;

// The Python interpreter that the module was built for, if it still exists; else the first of PATH.
std::string interpreter() {
#ifdef LFDSIM_PYTHON_INTERPRETER
    if (access(LFDSIM_PYTHON_INTERPRETER, X_OK) == 0) return LFDSIM_PYTHON_INTERPRETER;
#endif
    return "python3";
}

// Adds the folder of the package to PYTHONPATH if it is beside the program, as in a build; an installed one is found by Python.
void show_package() {
    std::error_code error;
    const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path() / "python";
    if (error || !fs::exists(folder / "lfdsim" / "__init__.py", error)) return;
    const char* others = std::getenv("PYTHONPATH");
    setenv("PYTHONPATH", (others && *others ? folder.string() + ":" + others : folder.string()).c_str(), 1);
}

// The script does not import modules from the working directory: a random.py there is not Python's.
constexpr const char* script = R"python(import sys
sys.path = [folder for folder in sys.path if folder]
try:
    from lfdsim.study.__main__ import main
except ModuleNotFoundError as error:
    print(f"lfdsim: error: studies are run by lfdsim's Python package, and {sys.executable} has no {error.name}; "
          "in lfdsim's repository: pip install '.[study]' (docs/studies.md)", file=sys.stderr)
    sys.exit(1)
sys.exit(main(sys.argv[1:])))python";

void run(const Command& command) {
    show_package();
    const std::string python = interpreter();
    std::vector<std::string> words = command.words();
    if (command.name() != "study") words.insert(words.begin(), command.name());
    std::vector<const char*> argv{python.c_str(), "-c", script};
    for (const std::string& word : words) argv.push_back(word.c_str());
    argv.push_back(nullptr);
    execvp(python.c_str(), const_cast<char**>(argv.data()));
    throw std::runtime_error(fmt::format("{}: {}; studies are run by lfdsim's Python package (docs/studies.md)", python,
                                         std::generic_category().message(errno)));
}

std::function<void()> run_in_python(Command command) {
    command.take_all_words();
    return [command] { run(command); };
}

}  // namespace

CommandSpec study_command() {
    return {.name = "study",
            .summary = "Measures thousands of variants of a display, here or on a cluster (Python package)",
            .run = run_in_python};
}

CommandSpec tolerance_command() {
    return {.name = "tolerance",
            .summary = "Draws a display's errors at random: percentiles of measures and an error budget (Python package)",
            .run = run_in_python};
}

}  // namespace lfdsim::cli
