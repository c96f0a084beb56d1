#include "content/pictures/ray_block.h"

namespace lfdsim {
namespace {

// Rays continue a little behind the surface that they met, by more than rounding: they would meet it again and again otherwise.
constexpr float beyond = 1 + 4e-7f, least = 1e-20f;

// Returns the material that ray k has met.
std::uint32_t material_at(const ContentScene::Impl& scene, const RTCHit16& hit, int k) {
    return scene.model->material_of[hit.primID[k]];
}

}  // namespace

void look_through(const ContentScene::Impl& scene, const Beam& beam, RTCIntersectContext& context, RayBlock& block,
                  const Lanes& width_mm) {
    constexpr int lanes = RayBlock::lanes;
    RTCRayHit16& packet = block.packet;
    Lanes through;  // share of the light that passes all images so far, for each ray
    scene.shade(packet.hit, block.hit, width_mm, block.light, &through);
    Lanes::Mask goes_on;
    std::uint32_t last[lanes];  // the material that each ray met last
    for (int k = 0; k < lanes; ++k) {
        goes_on.of[k] = block.hit.of[k] & -int(through.of[k] > 0);
        if (block.hit.of[k]) last[k] = material_at(scene, packet.hit, k);
    }
    while (goes_on.any()) {
        for (int k = 0; k < lanes; ++k) {
            packet.ray.tnear[k] = packet.ray.tfar[k] * beyond + least;
            packet.ray.tfar[k] = INFINITY;
            packet.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
        }
        rtcIntersect16(goes_on.of, scene.tree.get(), &context, &packet);
        Lanes width_here, light[3], through_this;
        for (int k = 0; k < lanes; ++k) {
            goes_on.of[k] &= -int(packet.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID);
            width_here.of[k] = beam.width_per_t * std::abs(packet.ray.tfar[k] - beam.waist_t);
        }
        if (!goes_on.any()) break;
        scene.shade(packet.hit, goes_on, width_here, light, &through_this);
        for (int k = 0; k < lanes; ++k) {
            // An image is plane, so that a ray meets it once; on the edge of two triangles it may meet both.
            if (!goes_on.of[k] || material_at(scene, packet.hit, k) == last[k]) continue;
            last[k] = material_at(scene, packet.hit, k);
            for (int c = 0; c < 3; ++c) block.light[c].of[k] += through.of[k] * light[c].of[k];
            through.of[k] *= through_this.of[k];
            goes_on.of[k] = -int(through.of[k] > 0);
        }
    }
    std::fill_n(packet.ray.tnear, lanes, 0.f);
}

}  // namespace lfdsim
