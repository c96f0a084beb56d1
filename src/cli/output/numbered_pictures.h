// A folder of pictures with numbers for names, which one command makes one after the other and can go on with. Floor 5.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace lfdsim::cli {

/// Numbered pictures of one command, which can be distinguished from those of any other: each carries the program's version, the
/// command, the description, and "shown", that of what is in it.
struct NumberedPictures {
    std::filesystem::path folder;
    std::int64_t count = 0;
    std::function<std::string(std::int64_t)> name;            // of a picture's file, ending and all
    std::function<std::string(std::int64_t)> display;         // the description that it is made of
    std::string shown;                                        // changes with the files that the pictures are made of
    std::function<bool(const std::filesystem::path&)> alike;  // whether a file is named as such pictures are
    std::string of_what;                                      // "frame"
    bool resume = false, replace = false;

    std::filesystem::path file(std::int64_t n) const { return folder / name(n); }
    /// Whether the same command has made that picture of the same things.
    bool finished(std::int64_t n) const;
    std::int64_t count_finished() const;
    /// Removes files there, named alike, that this command would not make so if they are to be replaced, else throws InputError.
    /// Pictures that lfdsim has not made are never removed, and a file that is no picture any more is made again where the command
    /// goes on.
    void keep_apart() const;
    /// The pictures that are not finished, or all of them where the command does not go on.
    std::vector<std::int64_t> left() const;
};

}  // namespace lfdsim::cli
