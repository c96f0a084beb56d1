#include "analysis/core/elemental_panel.h"

#include "analysis/pictures/shown_content.h"

namespace lfdsim {

ShownPanel::ShownPanel(Texels texels, int threads) : texels_(std::move(texels)), summed_(texels_, threads) {}

std::unique_ptr<ShownPanel> elemental_panel(const Display& display, const Geometry& geometry, const ContentScene& scene,
                                            int threads, const Job& job) {
    Quiet quiet(job);
    const Picture picture = shown_content(display, geometry, scene, threads, quiet).picture;
    if (!picture.complete) throw Stopped{};
    return std::make_unique<ShownPanel>(shown_texels(picture.image, display.panel.encoding), threads);
}

}  // namespace lfdsim
