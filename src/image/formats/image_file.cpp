#include "image/formats/image_file.h"
#include "image/formats/picture_size.h"

#include "base/free_memory.h"
#include "base/text.h"
#include "image/formats/formats.h"

#include <fmt/format.h>
#include <set>

namespace lfdsim {
namespace {

using namespace detail;
namespace fs = std::filesystem;

enum class Format { png, exr, npy, pfm, jpeg };

/// Returns the end of a name in lower case: ".png".
std::string extension(const fs::path& path) { return lower_case(path.extension().string()); }

Format format_to_read(const fs::path& path) {
    const std::string e = extension(path);
    if (e == ".png") return Format::png;
    if (e == ".exr") return Format::exr;
    if (e == ".npy") return Format::npy;
    if (e == ".pfm") return Format::pfm;
    if (e == ".jpg" || e == ".jpeg") return Format::jpeg;
    throw InputError(path.string(),
                     fmt::format("unknown image extension \"{}\"; .png, .exr, .npy, .pfm, .jpg and .jpeg can be read", e));
}

Format format_to_write(const fs::path& path) {
    const std::string e = extension(path);
    if (e == ".png") return Format::png;
    if (e == ".exr") return Format::exr;
    if (e == ".npy") return Format::npy;
    throw InputError(path.string(), fmt::format("unknown image extension \"{}\"; .png, .exr and .npy can be written", e));
}

/// Refuses pictures for which the operating system would kill the program.
void check_memory(const InputFile& file, std::int64_t columns, std::int64_t rows, int floats_per_pixel) {
    const double needed = double(columns) * double(rows) * floats_per_pixel * sizeof(float);
    constexpr double small_bytes = 1 << 20;
    if (needed < small_bytes) return;
    if (const FreeMemory free = free_memory(); needed > free.bytes)
        file.refuse(
            fmt::format("is too large: {} x {} pixels take {} of memory; {}", columns, rows, bytes_text(needed), free_text(free)));
}

/// Begins a stage of the caller's job, if there is one and the picture is large enough to take long; else returns a job that does
/// nothing.
Job& stage(Job* caller, const char* name, std::int64_t columns, std::int64_t rows) {
    constexpr std::int64_t large_pixels = 1 << 24;  // from here on a second or more
    static Job nobody;
    if (!caller || columns * rows < large_pixels) return nobody;
    caller->stage(name, rows);
    return *caller;
}

/// Does the work, and refuses the file where memory does not suffice: such a picture counts as bad input.
template <class Work>
auto within_memory(const InputFile& file, const Work& work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        file.refuse("takes more memory than there is; give a smaller picture");
    } catch (const std::length_error&) {
        file.refuse("takes more memory than there is; give a smaller picture");
    }
}

enum class Values { finite, radiance };  // radiance: finite and not negative, as of a panel

/// Refuses NaN and infinities in a picture, and negative radiance on a panel; the error names the first such value.
void check_values(const InputFile& file, Values allowed, const Pixels& pixels, std::int64_t rows) {
    const float least = allowed == Values::radiance ? 0 : std::numeric_limits<float>::lowest();
    for (std::int64_t r = 0; r < rows; ++r) {
        const float* value = pixels.row(r);
        for (std::int64_t i = 0; i < pixels.columns; ++i, value += pixels.stride)
            for (int c = 0; c < 3; ++c)
                if (!(value[c] >= least && value[c] <= std::numeric_limits<float>::max()))
                    file.refuse(fmt::format("holds {} in channel {} at column {}, row {}; values must be finite{}", value[c],
                                            "RGB"[c], i, r, allowed == Values::radiance ? " and not negative" : ""));
    }
}

/// For formats that can hold any float: checks the values that `reader` reads.
template <class Reader>
void read_floats(const InputFile& file, Values allowed, const Allocate& allocate, const Reader& reader) {
    Pixels pixels{};
    std::int64_t height = 0;
    const Allocate remember = [&](std::int64_t columns, std::int64_t rows) {
        height = rows;
        return pixels = allocate(columns, rows);
    };
    reader(file, remember);
    check_values(file, allowed, pixels, height);
}

/// Reads a file of any format.
void read(const InputFile& file, Format format, Encoding encoding, Values allowed, const Allocate& allocate) {
    if (format == Format::png) return read_png(file, encoding, allocate);
    if (format == Format::jpeg) return read_jpeg(file, encoding, allocate);
    if (format == Format::npy)
        return read_floats(file, allowed, allocate, [&](const InputFile& npy, const Allocate& to) { read_npy(npy, encoding, to); });
    read_floats(file, allowed, allocate, format == Format::exr ? read_exr : read_pfm);
}

/// Returns the function that makes `image` a reader's memory. Both file and image must outlive it.
Allocate as_image(const InputFile& file, Image& image) {
    return [&](std::int64_t columns, std::int64_t rows) {
        check_memory(file, columns, rows, 3);
        image = Image(int(columns), int(rows));
        return Pixels{image.rgb.data(), columns, 3, &stage(nullptr, "reading", columns, rows)};
    };
}

/// Checks layers that are to be written: throws as write_image() does.
void check_layers(const fs::path& path, const Image& image, const std::vector<ImageLayer>& layers) {
    if (layers.empty()) return;
    if (!keeps_layers(path))
        throw InputError(path.string(),
                         fmt::format("cannot hold the layer \"{}\" beside the picture; layers need an .exr", layers.front().name));
    std::set<std::string> names;
    for (const ImageLayer& layer : layers)
        if (layer.name.empty() || !names.insert(layer.name).second || layer.image.width != image.width ||
            layer.image.height != image.height || layer.image.rgb.size() != image.rgb.size())
            throw std::invalid_argument(fmt::format("write_image: layer \"{}\" has a wrong name or size", layer.name));
}

// Checks a picture that is to be written: throws as write_image() does.
void check_picture(const fs::path& path, const Image& image, const WriteOptions& options) {
    if (options.bits != 8 && options.bits != 16)
        throw InputError(path.string(), fmt::format("{} bits; 8 or 16 are possible", options.bits));
    if (image.width < 1 || image.height < 1 || image.rgb.size() != std::size_t(image.width) * std::size_t(image.height) * 3)
        throw std::invalid_argument("write_image: the image is empty or its size is wrong");
    check_layers(path, image, options.layers);
}

void write(Output& to, Format format, const Image& image, const WriteOptions& options, Job& job) {
    if (format == Format::png) write_png(to, image, options, job);
    if (format == Format::exr) write_exr(to, image, options, job);
    if (format == Format::npy) write_npy(to, image, job);
}

}  // namespace

void check_writable(const fs::path& path) {
    format_to_write(path);
    const OutputFile removed_again(path);  // names that are too long, or folders such as /proc, are found only by trying
}

bool keeps_metadata(const fs::path& path) { return format_to_write(path) != Format::npy; }

bool keeps_layers(const fs::path& path) { return format_to_write(path) == Format::exr; }

void write_image(const fs::path& path, const Image& image, const WriteOptions& options, Job* caller) {
    const Format format = format_to_write(path);
    check_picture(path, image, options);
    OutputFile file(path);
    write(file, format, image, options, stage(caller, "writing", image.width, image.height));
    file.commit();
}

std::string image_bytes(const std::string& ending, const Image& image, const WriteOptions& options, Job* caller) {
    const fs::path name = "picture" + ending;
    const Format format = format_to_write(name);
    check_picture(name, image, options);
    OutputMemory memory;
    Job nobody;
    write(memory, format, image, options, caller ? *caller : nobody);
    return memory.take();
}

Image read_image(const fs::path& path, Encoding encoding) {
    const Format format = format_to_read(path);
    const InputFile file(path);
    Image image;
    within_memory(file, [&] { read(file, format, encoding, Values::finite, as_image(file, image)); });
    return image;
}

std::optional<Image> read_layer(const fs::path& path, const std::string& name) {
    const Format format = format_to_read(path);
    const InputFile file(path);
    Image image;
    if (format == Format::exr)
        within_memory(file, [&] {
            read_floats(file, Values::finite, as_image(file, image),
                        [&](const InputFile&, const Allocate& allocate) { read_exr_layer(file, name, allocate); });
        });
    if (image.rgb.empty()) return std::nullopt;
    return image;
}

// A reader asks for memory when it knows the size: the exception leaves it there.
std::array<std::int64_t, 2> picture_size(const fs::path& path) {
    struct PictureSize {
        std::array<std::int64_t, 2> size;
    };
    const Format format = format_to_read(path);
    const InputFile file(path);
    try {
        within_memory(file, [&] {
            read(file, format, Encoding::srgb, Values::radiance, [](std::int64_t columns, std::int64_t rows) -> Pixels {
                throw PictureSize{{columns, rows}};
            });
        });
    } catch (const PictureSize& known) {
        return known.size;
    }
    file.refuse("has no size");
}

Metadata read_metadata(const fs::path& path) {
    const Format format = format_to_read(path);
    const InputFile file(path);
    return within_memory(file, [&] {
        return format == Format::png ? read_png_metadata(file) : format == Format::exr ? read_exr_metadata(file) : Metadata();
    });
}

std::string other_colours(const fs::path& path, Encoding encoding) {
    const Format format = format_to_read(path);
    const InputFile file(path);
    return within_memory(file, [&] {
        if (format == Format::png) return not_srgb(read_png_colours(file), encoding);
        if (format == Format::jpeg) return not_srgb(read_jpeg_colours(file), encoding);
        return format == Format::exr ? not_srgb(read_exr_colours(file), encoding) : std::string();
    });
}

bool holds_codes(const fs::path& path) {
    const Format format = format_to_read(path);
    if (format == Format::npy) return npy_holds_codes(InputFile(path));
    return format == Format::png || format == Format::jpeg;
}

Texels read_panel_image(const fs::path& path, Encoding encoding, std::int64_t columns, std::int64_t rows, Job* caller) {
    const Format format = format_to_read(path);
    const InputFile file(path);
    Texels texels;
    const Allocate as_texels = [&](std::int64_t c, std::int64_t r) {
        if (c != columns || r != rows)
            file.refuse(fmt::format("is {} x {} pixels, the panel has {} x {}; the sizes must be equal", c, r, columns, rows));
        check_memory(file, columns, rows, 4);
        texels = Texels(columns, rows);
        return Pixels{texels.data(), columns, 4, &stage(caller, "reading", columns, rows)};
    };
    within_memory(file, [&] { read(file, format, encoding, Values::radiance, as_texels); });
    return texels;
}

}  // namespace lfdsim
