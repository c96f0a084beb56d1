// docs/format.md says what the code does. With LFDSIM_WRITE_FORMAT set in the environment the file is written anew first.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "files/description/display_file.h"

namespace lfdsim {
namespace {

TEST(FormatReference, IsTheFileInDocs) {
    const std::string path = LFDSIM_SOURCE_DIR "/docs/format.md";
    if (std::getenv("LFDSIM_WRITE_FORMAT")) std::ofstream(path) << format_reference_markdown();
    std::ifstream file(path);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    EXPECT_EQ(text, format_reference_markdown()) << "to write it anew: LFDSIM_WRITE_FORMAT=1 build/dev/files_tests";
}

}  // namespace
}  // namespace lfdsim
