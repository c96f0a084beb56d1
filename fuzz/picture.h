// What the readers of pictures have to stand.
#pragma once
#include "file_of_bytes.h"
#include "image/formats/image_file.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lfdsim {

/// A picture's values are finite and as many as its size says; whatever else is asked of the file is answered or refused in words.
inline int fuzz_picture(
    const std::string& ending, const unsigned char* data, std::size_t size,
    bool (*is_quick)(const std::filesystem::path&) = [](const std::filesystem::path&) { return true; }) {
    static const FuzzFolder folder;
    const std::filesystem::path file = folder.put("picture" + ending, {reinterpret_cast<const char*>(data), size});
    if (!is_quick(file)) return 0;
    const auto or_refused = [](const auto& read) {
        try {
            read();
        } catch (const InputError& error) {
            if (error.problems.empty() || error.problems.front().what.empty()) std::abort();
        }
    };
    const auto check = [](const Image& image) {
        if (image.width < 1 || image.height < 1 || image.rgb.size() != std::size_t(image.width) * std::size_t(image.height) * 3 ||
            !std::all_of(image.rgb.begin(), image.rgb.end(), [](float light) { return std::isfinite(light); }))
            std::abort();
    };
    or_refused([&] { check(read_image(file, Encoding::srgb)); });
    or_refused([&] {
        const Texels texels = read_panel_image(file, Encoding::linear, 4, 3);
        if (!std::all_of(texels.data(), texels.data() + 4 * 4 * 3, [](float light) { return light >= 0 && light < INFINITY; }))
            std::abort();
    });
    or_refused([&] { holds_codes(file); });
    or_refused([&] { read_metadata(file); });
    or_refused([&] { other_colours(file, Encoding::srgb); });
    or_refused([&] {
        if (const auto layer = read_layer(file, "error")) check(*layer);
    });
    return 0;
}

}  // namespace lfdsim
