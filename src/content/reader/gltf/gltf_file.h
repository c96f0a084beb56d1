// glTF 2.0 files, text or binary: the description, and the bytes and numbers that it names. Everything is checked, as a file may
// lie.
#pragma once
#include "content/reader/gltf/gltf_item.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim::reader {

/// What an accessor names, in double precision: `count` elements of `width` numbers; normalized integers as the fractions they
/// mean.
struct AccessorValues {
    std::size_t width = 0, count = 0;
    std::vector<double> all;

    const double* operator[](std::size_t i) const { return &all[i * width]; }
    /// Integers become what they mean by their accessor: fractions, if it says so.
    void normalize(const Item& accessor);
};

class GltfFile {
  public:
    /// The bytes of a file beside the model; none where it is not there.
    using Open = std::function<std::optional<std::string>(const std::string& name)>;

    /// Throws std::runtime_error, as everything here, that says what is wrong and where.
    GltfFile(std::string bytes, Open open);
    GltfFile(const GltfFile&) = delete;

    const Item& root() const { return root_; }
    /// The element of a list of the file ("meshes") whose number `number` is; none where that is null.
    std::optional<Item> named(const Item& number, const char* list) const;

    std::string_view view(const Item& buffer_view);
    AccessorValues numbers(const Item& accessor);
    /// What a data: URI holds; none of others.
    static std::optional<std::string> data_of(const std::string& uri);
    /// The file that a URI names: %20 and the like stand for bytes.
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
