// The rays of 4 x 4 pixels, from their set-up to their light. Floor 2, internal to content.
#pragma once
#include "content/pictures/scene.h"
#include "optics/sampler.h"

#include <cmath>
#include <vector>

namespace lfdsim {

/// The width of a picture's rays: width_per_t |t - waist_t|, mm, at the distance t along them.
struct Beam {
    float width_per_t;
    float waist_t;
};

/// Sixteen rays of a 4 x 4 block of pixels, which start in a plane in front of the scene, with origins relative to the scene's
/// centre. They are processed in loops over all lanes without branches, which the compiler turns into SIMD. Masks are -1 or 0.
///
/// A packet has neighbouring pixels under one lens, not equal pixels under neighbouring lenses, whose rays are parallel: at z in
/// front of the lenses the rays of four neighbours are 4 a z/g apart, those of four lenses 4 p, which is more for all z < p g/a,
/// more than a metre.
struct RayBlock {
    static constexpr int side = 4, lanes = Lanes::count;
    RTCRayHit16 packet;
    Lanes::Mask exists;                          // a pixel without a lens has no ray
    Lanes::Mask may_hit;                         // only these rays are traced
    Lanes::Mask dark{};                          // pixels whose light does not leave their lens have no ray, and are counted
    Lanes::Mask hit;                             // rays that met the scene
    Lanes light[3];                              // of the rays that hit
    std::int64_t sample = 0;                     // number of the pixels' sample that these rays are
    std::vector<optics::Sampler<float>> points;  // the pixels' sample numbers, kept from sample to sample if needed

    RayBlock() {
        // Embree requires these and never changes them; look_through() sets tnear, and back.
        for (int k = 0; k < lanes; ++k) {
            packet.ray.tnear[k] = 0;
            packet.ray.time[k] = 0;
            packet.ray.mask[k] = ~0u;
            packet.ray.id[k] = 0;
            packet.ray.flags[k] = 0;
            packet.hit.primID[k] = 0;
            packet.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
            packet.hit.u[k] = packet.hit.v[k] = 0;
        }
    }
};

/// Shades a block whose rays have met the scene, `width_mm` wide there, and follows them through images: adds the light behind,
/// each time weighted by the share that all images in front of it let through, C_1 a_1 + (1 - a_1)(...) of docs/model.md,
/// "Shading".
void look_through(const ContentScene::Impl&, const Beam&, RTCIntersectContext&, RayBlock&, const Lanes& width_mm);

/// The light of a scene along a block's rays: traces and shades them, and sets `hit` and `light`. Returns false if no ray meets
/// the scene; then nothing is set.
struct SceneLight {
    const ContentScene::Impl& scene;
    Beam beam;
    bool operator()(RayBlock& block) const;
};

inline bool SceneLight::operator()(RayBlock& block) const {
    if (!block.may_hit.any()) return false;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    RTCRayHit16& packet = block.packet;
    for (int k = 0; k < RayBlock::lanes; ++k) {
        packet.ray.tfar[k] = INFINITY;
        packet.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect16(block.may_hit.of, scene.tree.get(), &context, &packet);
    Lanes width_mm;
    for (int k = 0; k < RayBlock::lanes; ++k) {
        block.hit.of[k] = block.may_hit.of[k] & -int(packet.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID);
        width_mm.of[k] = beam.width_per_t * std::abs(packet.ray.tfar[k] - beam.waist_t);
    }
    if (!block.hit.any()) return false;
    if (scene.see_through)
        look_through(scene, beam, context, block, width_mm);
    else
        scene.shade(packet.hit, block.hit, width_mm, block.light);
    return true;
}

}  // namespace lfdsim
