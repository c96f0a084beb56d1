// A folder of numbered pictures, which one command makes one after the other and can continue after an interruption. Floor 5.
#pragma once
#include "report/folder/run_settings.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace lfdsim::cli {

/// Numbered pictures of one command, which can be distinguished from those of any other: the metadata of each have the program's
/// version, the command, the description, and "shown", the stamps of the files that it was made of.
struct NumberedPictures {
    std::filesystem::path folder;
    std::int64_t count = 0;
    std::function<std::string(std::int64_t)> name;            // of a picture's file, with its ending
    std::function<std::string(std::int64_t)> display;         // the description of which a picture is made
    Json shown;                                               // stamps of the files of which they are known to be made
    std::function<bool(const std::filesystem::path&)> alike;  // whether a file is named like these pictures
    std::string of_what;                                      // a picture in messages: "frame"
    bool resume = false, replace = false;                     // --resume, --replace

    std::filesystem::path file(std::int64_t n) const { return folder / name(n); }
    /// Returns "shown" of a picture, with the stamps of files that were found only when the content was read.
    std::string shown_with(const std::vector<std::string>& files) const;
    /// Whether a picture exists that the same command has made of the same display and content.
    bool finished(std::int64_t n) const;
    std::int64_t count_finished() const;
    /// Throws InputError for finished pictures, without `resume` and `replace`. Removes files with names like these that are not
    /// finished pictures, with `replace`; else throws InputError if there are any.
    /// Pictures that lfdsim has not made are never removed. With `resume`, files that are not pictures any more do not count: they
    /// are made again.
    void keep_apart() const;
    /// Returns the pictures that remain to be made: with `resume` those that are not finished, else all.
    std::vector<std::int64_t> left() const;
};

/// Throws InputError if numbered pictures of a kind ("npy") that has no metadata are to be resumed.
void check_resume(bool resume, const std::string& kind);

}  // namespace lfdsim::cli
