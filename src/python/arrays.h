// Pictures in and out of NumPy arrays: height x width x 3, row 0 at the top. Floor 5.
#pragma once
#include "image/image.h"
#include "image/texels.h"

#include <nanobind/ndarray.h>

#include <string>
#include <variant>
#include <vector>

namespace lfdsim::python {

template <class Value>
using Pixels = nanobind::ndarray<const Value, nanobind::shape<-1, -1, 3>, nanobind::c_contig, nanobind::device::cpu>;

/// Linear light, or 8-bit or 16-bit codes.
using AnyPixels = std::variant<Pixels<float>, Pixels<std::uint8_t>, Pixels<std::uint16_t>>;

std::int64_t rows_of(const AnyPixels&);
std::int64_t columns_of(const AnyPixels&);

/// Codes become light by `encoding`. Throws InputError that names the array and the place for light that is not finite, or, on a
/// panel, is negative.
Texels texels_of(const AnyPixels&, Encoding, const std::string& name);
Image image_of(const AnyPixels&, Encoding, const std::string& name);

using Pictured = nanobind::ndarray<nanobind::numpy, float>;
using Numbers = nanobind::ndarray<nanobind::numpy, double>;

/// The picture's own memory, writable.
Pictured array_of(Image&&);

/// A copy, of one dimension.
Numbers array_of(const std::vector<double>&);

}  // namespace lfdsim::python
