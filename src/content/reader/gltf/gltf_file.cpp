#include "content/reader/gltf/gltf_file.h"

#include <algorithm>
#include <cstring>

namespace lfdsim::reader {
namespace {

template <class T>
T value_at(const char* bytes) {
    T x;
    std::memcpy(&x, bytes, sizeof x);
    return x;
}

std::size_t bytes_of_component(const Item& type) {
    switch (type.whole(0)) {
        case 5120:  // byte
        case 5121:  // unsigned
            return 1;
        case 5122:  // short
        case 5123:  // unsigned
            return 2;
        case 5125:  // unsigned int
        case 5126:  // float
            return 4;
        default:
            type.fail("is not a type of numbers");
    }
}

std::size_t width_of(const Item& type) {
    const std::string name = type.text();
    if (name == "SCALAR") return 1;
    if (name == "VEC2") return 2;
    if (name == "VEC3") return 3;
    if (name == "VEC4" || name == "MAT2") return 4;
    if (name == "MAT3") return 9;
    if (name == "MAT4") return 16;
    type.fail("is not a type of elements");
}

// Returns a number of a component type.
double component(std::size_t type, const char* bytes) {
    switch (type) {
        case 5120:
            return value_at<std::int8_t>(bytes);
        case 5121:
            return value_at<std::uint8_t>(bytes);
        case 5122:
            return value_at<std::int16_t>(bytes);
        case 5123:
            return value_at<std::uint16_t>(bytes);
        case 5125:
            return value_at<std::uint32_t>(bytes);
        default:
            return double(value_at<float>(bytes));
    }
}

// Returns the bytes of base64 text (RFC 4648); characters that are no digits are skipped, as browsers do with line breaks.
std::string from_base64(std::string_view text) {
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        int digit = 0;
        if (c >= 'A' && c <= 'Z') {
            digit = c - 'A';
        } else if (c >= 'a' && c <= 'z') {
            digit = c - 'a' + 26;
        } else if (c >= '0' && c <= '9') {
            digit = c - '0' + 52;
        } else if (c == '+' || c == '-') {
            digit = 62;
        } else if (c == '/' || c == '_') {
            digit = 63;
        } else {
            continue;
        }
        bits = bits << 6 | std::uint32_t(digit);
        count += 6;
        if (count >= 8) bytes += char(bits >> (count -= 8) & 255);
    }
    return bytes;
}

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return -1;
}

// The parts of a file; a text file is all description.
struct Chunks {
    std::string_view description, binary;
};

// A binary file has a header of 12 bytes ("glTF", version, length of the file), then chunks, each with its length and kind before
// it; the first is the description.
Chunks chunks_of(std::string_view file) {
    if (!file.starts_with("glTF")) return {file, {}};
    std::size_t at = 12;
    if (file.size() < at) throw std::runtime_error("the file ends before its data do: it is cut short");
    const auto version = value_at<std::uint32_t>(&file[4]), stated = value_at<std::uint32_t>(&file[8]);
    if (version != 2)
        throw std::runtime_error("its header states version " + std::to_string(version) +
                                 " of binary glTF, which is not read; export it as glTF 2.0");
    if (stated != file.size())
        throw std::runtime_error("its header states a length of " + std::to_string(stated) + " bytes, but it has " +
                                 std::to_string(file.size()) + ": it is damaged or cut short");
    Chunks found;
    while (at + 8 <= file.size()) {
        const auto length = value_at<std::uint32_t>(&file[at]), kind = value_at<std::uint32_t>(&file[at + 4]);
        at += 8;
        if (length > file.size() - at) throw std::runtime_error("the file ends before its data do: it is cut short");
        const std::string_view chunk = file.substr(at, length);
        if (kind == 0x4e4f534a && !found.description.data()) found.description = chunk;  // "JSON"
        if (kind == 0x004e4942 && !found.binary.data()) found.binary = chunk;            // "BIN"
        at += (std::size_t(length) + 3) / 4 * 4;
    }
    return found;
}

}  // namespace

/// The positions of an accessor's elements in the bytes of a view.
struct GltfFile::Layout {
    std::size_t type, component_bytes, width, offset, stride, count;
    const Item* accessor;
};

GltfFile::GltfFile(std::string bytes, Open open) : bytes_(std::move(bytes)), open_(std::move(open)), root_(description_) {
    const Chunks chunks = chunks_of(bytes_);
    binary_ = chunks.binary;
    try {
        description_ = nlohmann::json::parse(chunks.description.begin(), chunks.description.end());
    } catch (const nlohmann::json::exception& error) {
        const std::string what = error.what();  // "[json.exception.parse_error.101] parse error at line 3, column 7: ..."
        const std::size_t start = what.find("at line"), end = what.find(':', start);
        throw std::runtime_error("its JSON is damaged" +
                                 (start < end && end < what.size() ? " " + what.substr(start, end - start) : ""));
    }
    if (!description_.is_object()) throw std::runtime_error("its JSON is not an object");
    buffers_.resize(root_.at("buffers").size());
}

std::optional<Item> GltfFile::named(const Item& number, const char* list) const {
    if (!number.is_there()) return {};
    const Item all = root_.at(list);
    const std::size_t i = number.whole(0), size = all.size();
    if (i >= size) number.fail("is " + std::to_string(i) + ", but there are only " + std::to_string(size) + " " + list);
    return all[i];
}

std::optional<std::string> GltfFile::data_of(const std::string& uri) {
    const std::size_t comma = uri.find(',');
    if (!uri.starts_with("data:") || comma == std::string::npos) return {};
    if (uri.substr(0, comma).ends_with(";base64")) return from_base64(std::string_view(uri).substr(comma + 1));
    return file_name(uri.substr(comma + 1));
}

std::string GltfFile::file_name(const std::string& uri) {
    std::string name;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const int high = uri[i] == '%' && i + 2 < uri.size() ? hex_digit(uri[i + 1]) : -1,
                  low = high < 0 ? -1 : hex_digit(uri[i + 2]);
        name += low < 0 ? uri[i] : char(16 * high + low);
        if (low >= 0) i += 2;
    }
    return name;
}

const std::string& GltfFile::buffer(std::size_t number, const Item& wanted_by) {
    std::optional<std::string>& bytes = buffers_[number];
    if (bytes) return *bytes;
    const Item item = root_.at("buffers")[number];
    const std::string uri = item.at("uri").text();
    if (const auto data = data_of(uri)) {
        bytes = data;
    } else if (!uri.empty()) {
        bytes = open_(file_name(uri));
        if (!bytes) throw std::runtime_error(item.where() + ": \"" + file_name(uri) + "\" is not in the model's folder");
    } else if (number == 0 && binary_.data()) {
        bytes = std::string(binary_);
    } else {
        wanted_by.fail("has no bytes: " + item.where() + " names no file");
    }
    if (const std::size_t wanted = item.at("byteLength").whole(0); bytes->size() < wanted)
        item.fail("has " + std::to_string(bytes->size()) + " of " + std::to_string(wanted) + " bytes: it is cut short");
    return *bytes;
}

std::string_view GltfFile::view(const Item& buffer_view) {
    const auto from = named(buffer_view.at("buffer"), "buffers");
    if (!from) buffer_view.fail("names no buffer");
    const std::size_t number = buffer_view.at("buffer").whole(0);
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
        if (buffer_view.at("extensions").has(name) && !from->has("uri") && (number > 0 || !binary_.data()))
            throw std::runtime_error("is compressed by " + std::string(name) +
                                     ", which is not read; export it without compression");
    const std::string& all = buffer(number, buffer_view);
    const std::size_t offset = buffer_view.at("byteOffset").whole(0), length = buffer_view.at("byteLength").whole(0);
    if (offset > all.size() || length > all.size() - offset)
        buffer_view.fail("ends at byte " + std::to_string(offset + length) + " of a buffer of " + std::to_string(all.size()));
    return std::string_view(all).substr(offset, length);
}

void GltfFile::read(const Layout& at, std::string_view from, double* to) const {
    const std::size_t element = at.component_bytes * at.width;
    if (at.offset > from.size() ||
        (at.count > 0 && (from.size() - at.offset < element || (at.count - 1) > (from.size() - at.offset - element) / at.stride)))
        at.accessor->fail("has " + std::to_string(at.count) + " elements, which do not fit into the bytes that it names");
    for (std::size_t i = 0; i < at.count; ++i) {
        const char* bytes = from.data() + at.offset + i * at.stride;
        for (std::size_t c = 0; c < at.width; ++c, bytes += at.component_bytes) *to++ = component(at.type, bytes);
    }
}

AccessorValues GltfFile::numbers(const Item& accessor) {
    Layout at{};
    at.accessor = &accessor;
    at.type = accessor.at("componentType").whole(0);
    at.component_bytes = bytes_of_component(accessor.at("componentType"));
    at.width = width_of(accessor.at("type"));
    at.count = accessor.at("count").whole(0);
    at.offset = accessor.at("byteOffset").whole(0);
    if (at.count >= std::size_t(1) << 32) accessor.fail("has more than 2^32 elements");
    const auto from = named(accessor.at("bufferView"), "bufferViews");
    const Item sparse = accessor.at("sparse");
    if (!from && !sparse.is_there()) accessor.fail("has no data");
    // Sizes that a file claims are checked before memory is allocated for them.
    constexpr std::size_t most_zeros = std::size_t(1) << 26;
    if (!from && at.count > most_zeros) accessor.fail("has more than 2^26 elements and no bytes");
    std::string_view bytes;
    if (from) {
        bytes = view(*from);
        const std::size_t element = at.component_bytes * at.width;
        at.stride = from->at("byteStride").whole(element);
        if (at.stride < element || at.stride > 65535)
            from->at("byteStride")
                .fail("is " + std::to_string(at.stride) + ", but elements of " + accessor.where() + " have " +
                      std::to_string(element) + " bytes");
    }
    if (from && at.count > 0 && at.count - 1 > bytes.size() / at.stride) accessor.fail("has more elements than bytes");
    AccessorValues out{at.width, at.count, std::vector<double>(at.width * at.count)};
    if (from) read(at, bytes, out.all.data());
    if (sparse.is_there()) replace(out, at, sparse);
    out.normalize(accessor);
    return out;
}

void GltfFile::check_index_type(const Item& accessor) {
    const std::size_t type = accessor.at("componentType").whole(0);
    if (type != 5121 && type != 5123 && type != 5125)
        accessor.at("componentType")
            .fail("is " + std::to_string(type) + ", but indices are unsigned integers (5121, 5123 or 5125)");
}

// Replaces some of an accessor's elements by its sparse ones.
void GltfFile::replace(AccessorValues& out, const Layout& at, const Item& sparse) {
    Layout indices = at, values = at;
    indices.count = values.count = sparse.at("count").whole(0);
    if (values.count > at.count) sparse.fail("has more elements than its accessor");
    const Item number = sparse.at("indices"), value = sparse.at("values");
    indices.type = number.at("componentType").whole(0);
    indices.component_bytes = bytes_of_component(number.at("componentType"));
    check_index_type(number);
    indices.width = 1;
    indices.stride = indices.component_bytes;
    values.stride = at.component_bytes * at.width;
    indices.offset = number.at("byteOffset").whole(0);
    values.offset = value.at("byteOffset").whole(0);
    const auto number_view = named(number.at("bufferView"), "bufferViews"),
               value_view = named(value.at("bufferView"), "bufferViews");
    if (!number_view || !value_view) sparse.fail("has no data");
    std::vector<double> places(indices.count), elements(values.count * at.width);
    read(indices, view(*number_view), places.data());
    read(values, view(*value_view), elements.data());
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (!(places[i] >= 0 && places[i] < double(at.count))) sparse.fail("refers to an element that does not exist");
        std::copy_n(&elements[i * at.width], at.width, &out.all[std::size_t(places[i]) * at.width]);
    }
}

// glTF 2.0, 3.6.2.2.
void AccessorValues::normalize(const Item& accessor) {
    if (!accessor.at("normalized").truth(false)) return;
    double most = 1;
    switch (accessor.at("componentType").whole(0)) {
        case 5120:
            most = 127;
            break;
        case 5121:
            most = 255;
            break;
        case 5122:
            most = 32767;
            break;
        case 5123:
            most = 65535;
            break;
    }
    if (most > 1)
        for (double& x : all) x = std::max(x / most, -1.);
}

}  // namespace lfdsim::reader
