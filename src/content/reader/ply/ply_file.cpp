#include "content/reader/ply/ply_file.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <stdexcept>

namespace lfdsim::reader {
PlyFile::Type PlyFile::type_of(const std::string& name) {
    constexpr std::pair<const char*, Type> names[] = {
        {"char", Type::int8},     {"int8", Type::int8},       {"uchar", Type::uint8},    {"uint8", Type::uint8},
        {"short", Type::int16},   {"int16", Type::int16},     {"ushort", Type::uint16},  {"uint16", Type::uint16},
        {"int", Type::int32},     {"int32", Type::int32},     {"uint", Type::uint32},    {"uint32", Type::uint32},
        {"float", Type::float32}, {"float32", Type::float32}, {"double", Type::float64}, {"float64", Type::float64}};
    for (const auto& [known, type] : names)
        if (name == known) return type;
    throw std::runtime_error("its header has a property of an unknown type");
}

double PlyFile::unit_of(Type type) {
    switch (type) {
        case Type::float32:
        case Type::float64:
            return 1;
        case Type::int16:
        case Type::uint16:
            return 65535;
        default:
            return 255;
    }
}

/// The numbers after the header.
class PlyFile::Body {
  public:
    Body(std::string_view bytes, PlyEncoding form) : rest_(bytes), form_(form) {}

    /// Reads the next number.
    double number(Type type) {
        if (form_ == PlyEncoding::text) return word();
        switch (type) {
            case Type::int8:
                return take<std::int8_t>();
            case Type::uint8:
                return take<std::uint8_t>();
            case Type::int16:
                return take<std::int16_t>();
            case Type::uint16:
                return take<std::uint16_t>();
            case Type::int32:
                return take<std::int32_t>();
            case Type::uint32:
                return take<std::uint32_t>();
            case Type::float32:
                return double(take<float>());
            default:
                return take<double>();
        }
    }
    /// Returns the number of bytes that are left; each number takes at least one.
    std::size_t left() const { return rest_.size(); }

  private:
    template <class T>
    T take() {
        char bytes[sizeof(T)];
        if (rest_.size() < sizeof(T)) throw std::runtime_error("it ends before its data do: it is cut short");
        std::memcpy(bytes, rest_.data(), sizeof(T));
        rest_.remove_prefix(sizeof(T));
        if (form_ == PlyEncoding::big_endian) std::reverse(bytes, bytes + sizeof(T));
        T value;
        std::memcpy(&value, bytes, sizeof(T));
        return value;
    }

    double word() {
        rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size()));
        if (rest_.empty()) throw std::runtime_error("it ends before its data do: it is cut short");
        const std::string text(rest_.substr(0, std::min<std::size_t>(rest_.find_first_of(" \t\r\n"), 64)));
        char* end = nullptr;
        const double x = std::strtod(text.c_str(), &end);
        if (end == text.c_str()) throw std::runtime_error("it has a word where a number should be");
        rest_.remove_prefix(std::size_t(end - text.c_str()));
        return x;
    }

    std::string_view rest_;
    PlyEncoding form_;
};

void PlyFile::read(PlyElement& element, const std::vector<PropertyTypes>& columns, Body& body) {
    for (PlyProperty& property : element.properties)
        if (property.is_list) property.starts.push_back(0);
    for (std::size_t row = 0; row < element.count && !columns.empty(); ++row) {
        for (std::size_t c = 0; c < columns.size(); ++c) {
            PlyProperty& property = element.properties[c];
            double count = 1;
            if (property.is_list) {
                count = body.number(columns[c].count);
                if (!(count >= 0 && count <= double(body.left())))
                    throw std::runtime_error("a list of its element \"" + element.name +
                                             "\" has more numbers than the file: it is damaged");
            }
            for (std::size_t k = std::size_t(count); k > 0; --k) property.values.push_back(body.number(columns[c].value));
            if (property.is_list) property.starts.push_back(property.values.size());
        }
    }
}

const PlyProperty* PlyElement::find(std::initializer_list<std::string_view> names) const {
    for (const std::string_view wanted : names)
        for (const PlyProperty& property : properties)
            if (property.name == wanted) return &property;
    return nullptr;
}

const PlyElement* PlyFile::find(std::string_view name) const {
    for (const PlyElement& element : elements)
        if (element.name == name) return &element;
    return nullptr;
}

PlyFile::PlyFile(std::string_view bytes) {
    bool has_form = false, ended = false;
    while (!ended) {
        const std::size_t end = bytes.find_first_of("\r\n");
        if (end == std::string_view::npos) throw std::runtime_error("its header has no end");
        std::string line(bytes.substr(0, end));
        bytes.remove_prefix(end + (bytes.substr(end).starts_with("\r\n") ? 2 : 1));
        std::istringstream words(line);
        std::string key, type, name;
        words >> key;
        if (key == "format") {
            words >> name;
            has_form = true;
            if (name == "ascii")
                form_ = PlyEncoding::text;
            else if (name == "binary_little_endian")
                form_ = PlyEncoding::little_endian;
            else if (name == "binary_big_endian")
                form_ = PlyEncoding::big_endian;
            else
                throw std::runtime_error("its header has an unknown format");
        } else if (key == "comment") {
            constexpr std::string_view texture = "comment TextureFile ";
            if (line.starts_with(texture)) textures.push_back(line.substr(texture.size()));
        } else if (key == "element") {
            PlyElement& element = elements.emplace_back();
            if (!(words >> element.name >> element.count)) throw std::runtime_error("its header has an element without a count");
            columns_.emplace_back();
        } else if (key == "property") {
            if (elements.empty()) throw std::runtime_error("its header has a property without an element");
            PlyProperty& property = elements.back().properties.emplace_back();
            words >> type;
            property.is_list = type == "list";
            PropertyTypes column{};
            if (property.is_list) {
                words >> type;
                column.count = type_of(type);
                words >> type;
            }
            column.value = type_of(type);
            property.unit = unit_of(column.value);
            if (!(words >> property.name)) throw std::runtime_error("its header has a property without a name");
            columns_.back().push_back(column);
        }
        ended = key == "end_header";
    }
    if (!has_form) throw std::runtime_error("its header has no format");
    body_ = bytes;
}

void PlyFile::read() {
    Body body(body_, form_);
    for (std::size_t e = 0; e < elements.size(); ++e) read(elements[e], columns_[e], body);
}

}  // namespace lfdsim::reader
