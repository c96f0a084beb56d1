// NumPy's format, read and written: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
#include "image/formats/encoding.h"
#include "image/formats/file.h"
#include "image/formats/formats.h"
#include "image/formats/image_file.h"

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

/// Reads the header, and returns its text, a Python dictionary.
std::string read_header(const InputFile& file) {
    unsigned char start[12] = {};
    if (std::fread(start, 1, 10, file.stream()) != 10 || std::string_view(reinterpret_cast<char*>(start), magic.size()) != magic)
        file.refuse("is not an NPY file, whatever its name says");
    std::size_t length = start[8] | std::size_t(start[9]) << 8;
    if (start[6] >= 2) {  // versions 2 and 3 count with four bytes
        if (std::fread(start + 10, 1, 2, file.stream()) != 2) file.refuse("is damaged: it ends too early");
        length |= std::size_t(start[10]) << 16 | std::size_t(start[11]) << 24;
    }
    constexpr std::size_t most = 1024;  // NumPy writes 118; std::regex takes some hundred bytes of stack for each byte
    if (length > most) file.refuse("is damaged: its header is too long for an image");
    std::string header(length, '\0');
    if (std::fread(header.data(), 1, length, file.stream()) != length) file.refuse("is damaged: it ends too early");
    return header;
}

/// Reads rows of three values a pixel; put(values, light) converts a row.
template <class Value, class Put>
void read_rows(const InputFile& file, std::int64_t rows, const Pixels& pixels, const Put& put) {
    std::vector<Value> row(std::size_t(pixels.columns) * 3);
    for (std::int64_t r = 0; r < rows; ++r) {
        if (std::fread(row.data(), sizeof(Value), row.size(), file.stream()) != row.size())
            file.refuse("is damaged: it ends too early");
        put(row.data(), pixels.row(r));
        pixels.job->advance(1);
    }
}

template <class Value>
void read_light(const InputFile& file, std::int64_t rows, const Pixels& pixels) {
    read_rows<Value>(file, rows, pixels, [&](const Value* row, float* to) {
        for (std::int64_t i = 0; i < pixels.columns; ++i)
            for (int c = 0; c < 3; ++c) to[i * pixels.stride + c] = float(row[i * 3 + c]);
    });
}

template <class Code>
void read_codes(const InputFile& file, std::int64_t rows, Encoding encoding, const Pixels& pixels) {
    const std::vector<float>& table = decode_table(encoding, 8 * int(sizeof(Code)));
    read_rows<Code>(file, rows, pixels,
                    [&](const Code* row, float* to) { decode_row(row, table, pixels.columns, pixels.stride, to); });
}

/// Returns the type of the values, as NumPy writes it: "f4", "f8", "u1", "u2"; empty for all others.
std::string type_of(const std::string& header) {
    const std::regex key("'descr': *'(?:<(f4|f8|u2)|[|<](u1))'");
    std::smatch type;
    if (!std::regex_search(header, type, key)) return {};
    return type[1].matched ? type[1] : type[2];
}

}  // namespace

void read_npy(const InputFile& file, Encoding encoding, const Allocate& allocate) {
    // Type, order and shape, and that the file has exactly the bytes for them.
    const std::string header = read_header(file), type = type_of(header);
    std::smatch order, shape;
    // A size has nine digits at most, so that no number overflows.
    const std::regex order_key("'fortran_order': *False"), shape_key("'shape': *\\( *(\\d{1,9}) *, *(\\d{1,9}) *, *3 *,? *\\)");
    if (type.empty() || !std::regex_search(header, order, order_key) || !std::regex_search(header, shape, shape_key))
        file.refuse(
            "must hold light, little-endian float32 or float64 where white is 1, or codes, uint8 or uint16, of shape (rows, "
            "columns, 3) in "
            "C order; save light with 'numpy.save(name, numpy.ascontiguousarray(light, numpy.float32))', codes of 0 to 255 with "
            "'numpy.save(name, numpy.ascontiguousarray(codes, numpy.uint8))'");
    const std::int64_t rows = std::stoll(shape[1]), columns = std::stoll(shape[2]);
    const std::int64_t value_bytes = type[1] - '0';
    file.check_size(columns, rows, 1.0 / double(3 * value_bytes));
    const std::int64_t wanted = ftello(file.stream()) + columns * rows * 3 * value_bytes;
    if (wanted != file.size())
        file.refuse(fmt::format("is damaged: {} bytes for {} x {} pixels, it must be {}", file.size(), columns, rows, wanted));

    const Pixels pixels = allocate(columns, rows);
    if (type == "f4") return read_light<float>(file, rows, pixels);
    if (type == "f8") return read_light<double>(file, rows, pixels);
    if (type == "u1") return read_codes<std::uint8_t>(file, rows, encoding, pixels);
    read_codes<std::uint16_t>(file, rows, encoding, pixels);
}

bool npy_holds_codes(const InputFile& file) { return type_of(read_header(file)).starts_with('u'); }

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
    OutputFile file(path);
    detail::write_npy_header(file, shape);
    file.write(values.data(), values.size_bytes());
    file.commit();
}

}  // namespace lfdsim
