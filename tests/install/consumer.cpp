// A white panel seen through lenses without losses is exactly white: radiance does not change along a ray.
// A public header may also be included by itself.
#include <lfdsim/content/content.h>
#include <lfdsim/engine/render.h>
#include <lfdsim/files/description/display_file.h>

#include <iostream>

int main() {
    const lfdsim::Display display = lfdsim::parse_display(R"(
        schema = 1
        panel = { pixels = [64, 64], pixel_pitch_mm = 0.1 }
        lens = { type = "ideal", focal_length_mm = 3.0 }
        array = { count = [6, 6], pitch_mm = 1.0, gap_mm = 3.3, aperture = "cell" }
        camera = { position_mm = [0, 0, 500], frame_width_mm = 4, resolution = [16, 16] }
        render = { fresnel = "none" })",
                                                          "consumer.cpp");
    const lfdsim::Geometry geometry = lfdsim::resolve(display);
    const lfdsim::Texels panel = lfdsim::make_texels(lfdsim::pattern("white", display, geometry));
    lfdsim::Job job;
    const lfdsim::Rendering rendering = lfdsim::render(display, geometry, panel, {}, job);
    for (const float value : rendering.image.rgb)
        if (value != 1) {
            std::cerr << "a pixel is " << value << ", not 1\n";
            return 1;
        }
    std::cout << rendering.image.rgb.size() << " values, all 1\n";
}
