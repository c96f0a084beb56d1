// Pictures as NumPy arrays, height x width x 3, row 0 at the top, in both directions. Floor 5.
#pragma once
#include "image/image.h"
#include "image/texels.h"

#include <nanobind/ndarray.h>

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace lfdsim::python {

template <class Value>
using Pixels = nanobind::ndarray<const Value, nanobind::shape<-1, -1, 3>, nanobind::c_contig, nanobind::device::cpu>;

/// A picture that Python passes: linear light as float, or 8-bit or 16-bit code values.
using AnyPixels = std::variant<Pixels<float>, Pixels<std::uint8_t>, Pixels<std::uint16_t>>;

/// A part of a picture that Python passes: columns x0 to x1 - 1, rows y0 to y1 - 1, as (x0, y0, x1, y1).
using CropBox = std::array<int, 4>;
std::optional<Rect> rect_of(const std::optional<CropBox>&);

std::int64_t rows_of(const AnyPixels&);
std::int64_t columns_of(const AnyPixels&);

/// A panel's texels or picture and any picture of the array's light, which is copied; code values become light by `encoding`,
/// floats are taken as they are. Throws InputError, with `name` and the first such pixel, for light that is not finite or, of a
/// panel, negative.
Texels texels_of(const AnyPixels&, Encoding, const std::string& name);
Image panel_image_of(const AnyPixels&, Encoding, const std::string& name);
Image image_of(const AnyPixels&, Encoding, const std::string& name);

using Pictured = nanobind::ndarray<nanobind::numpy, float>;
using Numbers = nanobind::ndarray<nanobind::numpy, double>;

/// A writable array of the picture's memory, which is not copied: the array keeps it until Python drops the array.
Pictured array_of(Image&&);

/// A writable array of one dimension with a copy of the values.
Numbers array_of(const std::vector<double>&);

}  // namespace lfdsim::python
