// The parts of find_views(). Internal to src/files. Floor 2.
#pragma once
#include "files/views/views_source.h"

#include <map>
#include <string>
#include <string_view>

namespace lfdsim::detail {

/// Files of a folder whose names are `pattern` with a number in place of its one "*", by that number. Throws InputError for two
/// files of the same number.
std::map<std::int64_t, std::filesystem::path> numbered_files(const std::filesystem::path& folder, const std::string& pattern);

/// Returns the numbered files of a row, which must be `count` files without a gap, from any first number on. Throws InputError
/// that names the first file that is missing, or that is too many.
std::vector<std::filesystem::path> numbered_row(const std::filesystem::path& folder, const std::string& pattern, std::size_t count,
                                                const std::string& counted_in);

/// Files with two numbers in their names, for the two "*" of the pattern, by the first number and then the second: `outer` x
/// `inner` of them, each counted from 0 or 1 or any other number on. `words`: what the numbers count. Throws InputError like that.
std::vector<std::filesystem::path> numbered_grid(const std::filesystem::path& folder, const std::string& pattern, int outer,
                                                 int inner, std::array<const char*, 2> words, const std::string& counted_in);

ViewsSource hci_views(const std::filesystem::path& folder);
std::optional<ViewsSource> stanford_views(const std::filesystem::path& folder);
/// Names that are alike but for two numbers, the row's and the column's: "000_000.png".
std::optional<ViewsSource> row_column_views(const std::filesystem::path& folder);
ViewsSource described_views(const std::filesystem::path& toml);
/// Keys that a quilt's own file may have; the source has its pictures already.
void describe_quilt(const std::filesystem::path& toml, ViewsSource&);

}  // namespace lfdsim::detail
