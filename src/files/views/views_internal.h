// The parts of find_views(), one for each form. Internal to src/files. Floor 2.
#pragma once
#include "files/views/views_source.h"

#include <map>
#include <string>
#include <string_view>

namespace lfdsim::detail {

/// Returns the files of a folder whose names are `pattern` with a number of up to nine digits in place of its one "*", by that
/// number. Throws InputError for two files of the same number.
std::map<std::int64_t, std::filesystem::path> numbered_files(const std::filesystem::path& folder, const std::string& pattern);

/// Returns the numbered files of a row, which must be `count` files without a gap, from any first number on. Throws InputError
/// that names the first number that is missing, or a wrong count; `counted_in` is the file that states the count.
std::vector<std::filesystem::path> numbered_row(const std::filesystem::path& folder, const std::string& pattern, std::size_t count,
                                                const std::string& counted_in);

/// Returns the files with two numbers in their names, for the two "*" of the pattern, by the first number and then the second:
/// `outer` x `inner` of them, from any first numbers on. `words` says what the numbers count. Throws InputError like
/// numbered_row().
std::vector<std::filesystem::path> numbered_grid(const std::filesystem::path& folder, const std::string& pattern, int outer,
                                                 int inner, std::array<const char*, 2> words, const std::string& counted_in);

/// Reads the grid that a folder's parameters.cfg describes. Throws InputError.
ViewsSource hci_views(const std::filesystem::path& folder);
/// Returns the grid of names "..._ROW_COLUMN_V_U_.png"; nothing if no file has such a name. Throws InputError for an incomplete
/// grid.
std::optional<ViewsSource> stanford_views(const std::filesystem::path& folder);
/// Returns the grid of names that differ by two numbers only, the row's and the column's: "000_000.png"; nothing if there are none.
/// Throws InputError for an incomplete grid, or for several.
std::optional<ViewsSource> row_column_views(const std::filesystem::path& folder);
/// Reads the grid that a views.toml describes. Throws InputError.
ViewsSource described_views(const std::filesystem::path& toml);
/// Adds to a quilt, whose picture and tiles are known by its name, what the TOML file beside it states. Throws InputError.
void describe_quilt(const std::filesystem::path& toml, ViewsSource&);

}  // namespace lfdsim::detail
