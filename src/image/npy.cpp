// NumPy's format: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
#include "image/file.h"
#include "image/formats.h"
#include "image/image_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <array>
#include <bit>
#include <regex>
#include <span>
#include <vector>

namespace lfdsim::detail {
namespace {

static_assert(std::endian::native == std::endian::little);
constexpr std::string_view magic = "\x93NUMPY";

/// The text of the header, a Python dictionary.
std::string read_header(const InputFile& file) {
    unsigned char start[12] = {};
    if (std::fread(start, 1, 10, file.stream()) != 10 || std::string_view(reinterpret_cast<char*>(start), magic.size()) != magic)
        file.refuse("is not an NPY file, whatever its name says");
    std::size_t length = start[8] | std::size_t(start[9]) << 8;
    if (start[6] >= 2) {  // versions 2 and 3 count with four bytes
        if (std::fread(start + 10, 1, 2, file.stream()) != 2) file.refuse("is damaged: it ends too early");
        length |= std::size_t(start[10]) << 16 | std::size_t(start[11]) << 24;
    }
    if (length > 4096) file.refuse("is damaged: its header is too long for an image");
    std::string header(length, '\0');
    if (std::fread(header.data(), 1, length, file.stream()) != length) file.refuse("is damaged: it ends too early");
    return header;
}

template <class Value>
void read_rows(const InputFile& file, std::int64_t rows, const Pixels& pixels) {
    std::vector<Value> row(std::size_t(pixels.columns) * 3);
    for (std::int64_t r = 0; r < rows; ++r) {
        if (std::fread(row.data(), sizeof(Value), row.size(), file.stream()) != row.size())
            file.refuse("is damaged: it ends too early");
        float* const to = pixels.row(r);
        for (std::int64_t i = 0; i < pixels.columns; ++i)
            for (int c = 0; c < 3; ++c) to[i * pixels.stride + c] = float(row[std::size_t(i * 3 + c)]);
        pixels.job->advance(1);
    }
}

}  // namespace

void read_npy(const InputFile& file, const Allocate& allocate) {
    const std::string header = read_header(file);
    std::smatch type, order, shape;
    // Nine digits at most: no overflow, and 2^31 pixels have fewer.
    const std::regex type_key("'descr': *'<f([48])'"), order_key("'fortran_order': *False"),
        shape_key("'shape': *\\( *(\\d{1,9}) *, *(\\d{1,9}) *, *3 *,? *\\)");
    if (!std::regex_search(header, type, type_key) || !std::regex_search(header, order, order_key) ||
        !std::regex_search(header, shape, shape_key))
        file.refuse(
            "must hold little-endian float32 or float64 of shape (rows, columns, 3) in C order; save it with "
            "'numpy.save(name, numpy.ascontiguousarray(image, numpy.float32))'");
    const std::int64_t rows = std::stoll(shape[1]), columns = std::stoll(shape[2]);
    const std::int64_t value_bytes = std::stoll(type[1]);
    file.check_size(columns, rows, 1.0 / double(3 * value_bytes));
    const std::int64_t wanted = ftello(file.stream()) + columns * rows * 3 * value_bytes;
    if (wanted != file.size())
        file.refuse(fmt::format("is damaged: {} bytes for {} x {} pixels, it must be {}", file.size(), columns, rows, wanted));

    const Pixels pixels = allocate(columns, rows);
    if (value_bytes == 4)
        read_rows<float>(file, rows, pixels);
    else
        read_rows<double>(file, rows, pixels);
}

void write_npy_header(Output& file, std::span<const std::int64_t> shape) {
    std::string header = fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}{}), }}", fmt::join(shape, ", "),
                                     shape.size() == 1 ? "," : "");
    // The data begin at a multiple of 64 bytes, after 10 bytes of preamble and the newline that ends the header.
    header.append(63 - (10 + header.size()) % 64, ' ');
    header += '\n';
    file.write("\x93NUMPY\x01\x00", 8);
    const std::uint16_t length = std::uint16_t(header.size());
    file.write(&length, 2);
    file.write(header.data(), header.size());
}

void write_npy(Output& file, const Image& image, Job& job) {
    write_npy_header(file, std::array<std::int64_t, 3>{image.height, image.width, 3});
    for (int row = 0; row < image.height; ++row) {
        file.write(image.at(0, row), std::size_t(image.width) * 3 * sizeof(float));
        job.advance(1);
    }
}

}  // namespace lfdsim::detail

namespace lfdsim {

void write_npy(const std::filesystem::path& path, std::span<const std::int64_t> shape, std::span<const float> values) {
    detail::OutputFile file(path);
    detail::write_npy_header(file, shape);
    file.write(values.data(), values.size_bytes());
    file.commit();
}

}  // namespace lfdsim
