// PLY files, text or binary, as their lists of numbers.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim::reader {

/// A property of an element: a number, or a list of numbers, in each of its rows.
struct PlyProperty {
    std::string name;
    double unit = 1;  // the value that means 1 in its type, if it is a colour: 255 of bytes
    bool is_list = false;
    std::vector<double> values;       // of all rows, one after the other
    std::vector<std::size_t> starts;  // of lists: index of each row's first value, and the end

    /// Return the number of values of a row, and the first of them.
    std::size_t size(std::size_t row) const { return is_list ? starts[row + 1] - starts[row] : 1; }
    const double* row(std::size_t row) const { return values.data() + (is_list ? starts[row] : row); }
};

/// An element: rows with the same properties.
struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;

    /// Returns the property with the first of these names that exists, or null.
    const PlyProperty* find(std::initializer_list<std::string_view> names) const;
};

/// A PLY file: its header after construction, its numbers after read().
struct PlyFile {
    std::vector<PlyElement> elements;
    std::vector<std::string> textures;  // "comment TextureFile NAME"

    /// Reads the header, so that elements have names and counts; `bytes` must outlive this. Throws std::runtime_error, which says
    /// what is wrong.
    explicit PlyFile(std::string_view bytes);
    /// Reads the elements' numbers. Throws std::runtime_error.
    void read();
    /// Returns an element; null if there is none.
    const PlyElement* find(std::string_view name) const;

  private:
    enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
    enum class PlyEncoding { text, little_endian, big_endian };
    /// The types of a property's values.
    struct PropertyTypes {
        Type count, value;  // count: of a list
    };
    class Body;
    static Type type_of(const std::string& name);
    static double unit_of(Type);
    static void read(PlyElement&, const std::vector<PropertyTypes>&, Body&);

    std::string_view body_;
    PlyEncoding form_{};
    std::vector<std::vector<PropertyTypes>> columns_;  // of each element
};

}  // namespace lfdsim::reader
