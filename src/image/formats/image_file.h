// Pictures in files: PNG (8 or 16 bit), EXR, NPY, PFM and JPEG are read; PNG, EXR and NPY are written. Floor 0, public.
#pragma once
#include "base/input_error.h"
#include "base/job.h"
#include "display/display.h"
#include "image/image.h"
#include "image/texels.h"

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lfdsim {

/// Settings that made a picture, kept in it (PNG text chunks, EXR attributes; NPY has no place for them).
using Metadata = std::map<std::string, std::string>;
/// The key of the metadata that marks a picture as incomplete.
inline constexpr const char* incomplete_mark = "incomplete";

/// Further data for every pixel, of the picture's size; for instance "error", the standard error of each channel in linear
/// light. EXR keeps it as the channels NAME.R, NAME.G, NAME.B; no other format can.
struct ImageLayer {
    std::string name;  // not empty; a dot makes a layer within a layer
    Image image;
};

struct WriteOptions {
    int bits = 8;                        // PNG: 8 or 16
    Encoding encoding = Encoding::srgb;  // PNG code values: sRGB (clipped to [0,1]) or linear
    Metadata metadata;
    std::vector<ImageLayer> layers = {};  // EXR only: see keeps_layers()
};

/// Throws InputError unless `path` ends in .png, .exr or .npy and a file can be made there: makes and removes the temporary
/// file of write_image(). A file at `path` stays as it is.
void check_writable(const std::filesystem::path& path);

/// Whether a file of this name keeps WriteOptions::metadata. Throws InputError for extensions that check_writable() refuses.
bool keeps_metadata(const std::filesystem::path& path);

/// Whether a file of this name keeps WriteOptions::layers, which only .exr does. Throws like keeps_metadata().
bool keeps_layers(const std::filesystem::path& path);

/// Writes a picture under a temporary name, then renames it, so that no partial file is ever visible. .png: see WriteOptions; .exr:
/// float32 RGB, linear; .npy: float32, H x W x 3, linear, C order. Throws InputError (folder missing, layers that the format cannot
/// keep), std::runtime_error (disk full), or std::invalid_argument for an image or layer of a wrong size.
/// Large pictures, which take seconds, are a stage of the job, counted in rows; it does not cancel them.
void write_image(const std::filesystem::path& path, const Image&, const WriteOptions& = {}, Job* = nullptr);

/// Writes an array of numbers in C order as .npy, float32, under a temporary name that is then changed. Throws like write_image().
void write_npy(const std::filesystem::path& path, std::span<const std::int64_t> shape, std::span<const float> values);

/// Returns the bytes of the file that write_image() would write for a name with this ending (".png", ".exr", ".npy"). Finished rows
/// are reported to the job, if there is one, without a stage; an exception from its advance() ends the work. Throws like
/// write_image().
std::string image_bytes(const std::string& ending, const Image&, const WriteOptions& = {}, Job* = nullptr);

/// Reads a picture as linear light. `encoding` is that of code values: PNG, JPEG, and NPY of uint8 and uint16; EXR, PFM and other
/// NPY are linear, and their values must be finite. A picture of a camera that was turned (upright.h) is returned upright, as
/// viewers show it. An alpha channel must be full everywhere. Layers are ignored. Throws InputError, which names the file and the
/// fault: missing, truncated, not an image, too large.
Image read_image(const std::filesystem::path& path, Encoding encoding);

/// Reads a panel image directly into texels, row by row. Throws InputError like read_image(), also for negative light and, with
/// both sizes, for an image that is not columns x rows. A large one is a stage of the job like those of write_image().
Texels read_panel_image(const std::filesystem::path& path, Encoding encoding, std::int64_t columns, std::int64_t rows,
                        Job* = nullptr);

/// Returns the WriteOptions::metadata of a file; empty where its format has no place for it. Only the file's header is read. Throws
/// like read_image().
Metadata read_metadata(const std::filesystem::path& path);

/// Returns what to warn of where a file states colours other than sRGB (ICC profile, cICP, gamma, primaries), which are read as
/// sRGB; an empty text where it states none or sRGB. Codes that are read as Encoding::linear may have any curve. Only the file's
/// header is read. Throws like read_image().
std::string other_colours(const std::filesystem::path& path, Encoding encoding);

/// Whether a file has code values, which are limited by white; .exr, .pfm and .npy of floats have light without a limit. Throws
/// InputError for an unknown extension, and of .npy for an unreadable header.
bool holds_codes(const std::filesystem::path& path);

/// Reads a layer of an EXR file, whose values must be finite; returns nothing where the file has no such layer or is of another
/// format. Throws like read_image().
std::optional<Image> read_layer(const std::filesystem::path& path, const std::string& name);

}  // namespace lfdsim
