// Portable float maps: "PF" (colour) or "Pf" (grey), width, height, scale, and rows of float32 from the lowest row up; a negative
// scale says that they are little-endian. http://www.pauldebevec.com/Research/HDR/PFM/
#include "image/formats/file.h"
#include "image/formats/formats.h"

#include <fmt/format.h>
#include <bit>
#include <cctype>
#include <cstdlib>
#include <string>
#include <vector>

namespace lfdsim::detail {
namespace {

constexpr int longest_word = 32;

/// Reads the next word of the header, and the one white-space character after it.
std::string header_word(const InputFile& file) {
    std::string word;
    for (;;) {
        const int c = std::getc(file.stream());
        if (c == EOF || c == 0 || int(word.size()) > longest_word) file.refuse("is damaged: its header is not that of a PFM file");
        if (!std::isspace(c))
            word.push_back(char(c));
        else if (!word.empty())
            return word;
    }
}

std::int64_t header_size(const InputFile& file) {
    const std::string word = header_word(file);
    char* end = nullptr;
    const long long size = std::strtoll(word.c_str(), &end, 10);
    if (*end != '\0' || size < 1 || size > 1'000'000'000) file.refuse(fmt::format("is damaged: its size is \"{}\"", word));
    return size;
}

}  // namespace

void read_pfm(const InputFile& file, const Allocate& allocate) {
    const std::string kind = header_word(file);
    if (kind != "PF" && kind != "Pf") file.refuse("is not a PFM file, whatever its name says");
    const int channels = kind == "PF" ? 3 : 1;
    const std::int64_t columns = header_size(file), rows = header_size(file);
    const std::string scale = header_word(file);
    char* end = nullptr;
    const double factor = std::strtod(scale.c_str(), &end);
    if (*end != '\0' || !(factor < 0 || factor > 0)) file.refuse(fmt::format("is damaged: its scale is \"{}\"", scale));
    file.check_size(columns, rows, 1. / (4 * channels));
    const std::int64_t wanted = ftello(file.stream()) + columns * rows * channels * 4;
    if (wanted != file.size())
        file.refuse(fmt::format("is damaged: {} bytes for {} x {} pixels, it must be {}", file.size(), columns, rows, wanted));

    const Pixels pixels = allocate(columns, rows);
    std::vector<std::uint32_t> row(std::size_t(columns * channels));
    for (std::int64_t r = rows - 1; r >= 0; --r) {
        if (std::fread(row.data(), 4, row.size(), file.stream()) != row.size()) file.refuse("is damaged: it ends too early");
        float* const to = pixels.row(r);
        for (std::int64_t i = 0; i < columns; ++i)
            for (int c = 0; c < 3; ++c) {
                std::uint32_t bits = row[std::size_t(i * channels + (channels == 3 ? c : 0))];
                if (factor > 0) bits = __builtin_bswap32(bits);
                to[i * pixels.stride + c] = std::bit_cast<float>(bits);
            }
        pixels.job->advance(1);
    }
}

}  // namespace lfdsim::detail
