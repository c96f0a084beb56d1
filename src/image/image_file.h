// Pictures in files: PNG (8 or 16 bit), EXR, JPEG in; PNG, EXR, NPY out. Floor 0.
#pragma once
#include "image/image.h"
#include "image/texels.h"
#include "model/display.h"
#include "model/error.h"

#include <filesystem>
#include <map>
#include <string>

namespace lfdsim {

/// Settings that made a picture, kept in it (PNG text chunks, EXR attributes; NPY has no place for them).
using Metadata = std::map<std::string, std::string>;

struct WriteOptions {
    int bits = 8;                        // PNG: 8 or 16
    Encoding encoding = Encoding::srgb;  // PNG code values: sRGB (clipped to [0,1]) or linear
    Metadata metadata;
};

/// Throws InputError unless `path` ends in .png, .exr or .npy and a file can be made there: makes and removes the temporary file of
/// write_image(). What is at `path` stays as it is.
void check_writable(const std::filesystem::path& path);

/// Whether a file of this name keeps WriteOptions::metadata. Throws InputError like check_writable() for another extension.
bool keeps_metadata(const std::filesystem::path& path);

/// Writes beside, then renames, so that no partial file is ever seen. .png: see WriteOptions; .exr: float32 RGB, linear;
/// .npy: float32, H x W x 3, linear, C order. Throws InputError (folder missing) or std::runtime_error (disk full).
void write_image(const std::filesystem::path& path, const Image&, const WriteOptions& = {});

/// Linear light. `encoding` says how PNG and JPEG code values decode; EXR and NPY are linear. No alpha channel.
/// Throws InputError that names the file and what is wrong with it: missing, truncated, not an image, too large.
Image read_image(const std::filesystem::path& path, Encoding encoding);

/// The same for a panel image, straight into texels, row by row. Throws InputError if its size is not columns x rows (says both).
Texels read_panel_image(const std::filesystem::path& path, Encoding encoding, std::int64_t columns, std::int64_t rows);

}  // namespace lfdsim
