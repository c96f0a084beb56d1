// What a viewer sees of a display: minimal DISPLAY.toml VIEW.png
#include <lfdsim/lfdsim.h>

#include <iostream>

int main(int count, char** arguments) {
    if (count != 3) {
        std::cerr << "usage: minimal DISPLAY.toml VIEW.png\n";
        return 2;
    }
    try {
        // The description: panel, lenses, array, diffuser, camera. All its faults are reported together, with line and column.
        const lfdsim::Display display = lfdsim::read_display(arguments[1]);
        // What follows from it: where every surface lies, in mm from the panel, and what paraxial theory predicts.
        const lfdsim::Geometry geometry = lfdsim::resolve(display);
        std::cout << "field of view: " << lfdsim::theory(display, geometry).along[0].fov_deg << " degrees\n";

        // A Job reports progress and may cancel long work; this one does neither.
        lfdsim::Job job;
        // What the panel shows: the elemental images of a scene, here of the model that is built in, by 0 = all threads.
        const lfdsim::ContentScene scene(lfdsim::built_in_model(), display, geometry);
        const lfdsim::Picture elemental = lfdsim::elemental_images(display, geometry, scene, 0, job);
        // The panel is driven by 8-bit codes.
        const lfdsim::Texels panel = lfdsim::shown_texels(elemental.image, display.panel.encoding);

        // What the camera of the description sees: rays go backwards, from its pixels through the lenses to the panel.
        const lfdsim::Rendering view = lfdsim::render(display, geometry, panel, {}, job);
        lfdsim::write_image(arguments[2], view.image);
        // The same scene without the display, and how alike the two are.
        const lfdsim::Picture truth = lfdsim::reference_photograph(display, geometry, scene, 0, {}, job);
        std::cout << "similarity to the scene (SSIM): " << lfdsim::compare(view.image, truth.image).ssim << '\n';
    } catch (const lfdsim::InputError& error) {
        std::cerr << error.what() << '\n';
        return 2;
    }
}
