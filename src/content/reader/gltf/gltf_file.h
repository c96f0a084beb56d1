// glTF 2.0 files, text or binary: the description, and the bytes and numbers to which it refers. Everything is checked, since a
// file may be damaged or hostile.
#pragma once
#include "content/reader/gltf/gltf_item.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim::reader {

/// The numbers of an accessor in double precision: `count` elements of `width` numbers; normalized integers as the fractions that
/// they mean.
struct AccessorValues {
    std::size_t width = 0, count = 0;
    std::vector<double> all;

    /// Returns the first number of an element.
    const double* operator[](std::size_t i) const { return &all[i * width]; }
    /// Turns integers into fractions if their accessor says so (glTF 2.0, 3.6.2.2).
    void normalize(const Item& accessor);
};

/// A file with its buffers, which are read when needed. Its functions throw std::runtime_error, which says what is wrong and
/// where.
class GltfFile {
  public:
    /// A function that returns the bytes of a file beside the model; nothing if it does not exist.
    using Open = std::function<std::optional<std::string>(const std::string& name)>;

    /// Parses a file's bytes.
    GltfFile(std::string bytes, Open open);
    GltfFile(const GltfFile&) = delete;

    const Item& root() const { return root_; }
    /// Returns the element of a list of the file ("meshes") with the number `number`; nothing if that is null.
    std::optional<Item> named(const Item& number, const char* list) const;

    /// Return the bytes of a buffer view, and the numbers of an accessor with its sparse replacements.
    std::string_view view(const Item& buffer_view);
    AccessorValues numbers(const Item& accessor);
    /// Checks that an accessor of indices has a type that indices may have.
    static void check_index_type(const Item& accessor);
    /// Returns the content of a data: URI; nothing for others.
    static std::optional<std::string> data_of(const std::string& uri);
    /// Returns the file that a URI names, with %20 and the like replaced by their bytes.
    static std::string file_name(const std::string& uri);

  private:
    struct Layout;
    void read(const Layout&, std::string_view from, double* to) const;
    void replace(AccessorValues&, const Layout&, const Item& sparse);
    const std::string& buffer(std::size_t number, const Item& wanted_by);

    std::string bytes_;
    std::string_view binary_;  // the second chunk of a binary file
    Open open_;
    nlohmann::json description_;
    Item root_;
    std::vector<std::optional<std::string>> buffers_;
};

}  // namespace lfdsim::reader
