// A posed model ready for rays. Floor 2, internal to content.
#pragma once
#include "content/content.h"
#include "content/model.h"
#include "content/texture.h"

#include <embree3/rtcore.h>

#include <array>
#include <memory>
#include <vector>

namespace lfdsim {

struct Scene::Impl {
    std::shared_ptr<const Model> model;

    // Rays live in the frame whose origin is `centre_mm`, the centre of the posed bounding box: there float32 is at its best.
    Vec3d centre_mm{}, half_mm{};     // half: half the box's extents
    std::vector<float> positions_mm;  // posed, about the centre; one float more than the vertices need, as Embree asks

    std::array<float, 3> light{};  // unit vector towards the light, in the model's own axes
    std::vector<Pyramid> textures;
    std::vector<float> texels_per_mm;  // of each triangle, the mean over directions; 0: no texture

    struct Release {
        void operator()(RTCSceneTy* s) const { rtcReleaseScene(s); }
        void operator()(RTCDeviceTy* d) const { rtcReleaseDevice(d); }
    };
    std::unique_ptr<RTCDeviceTy, Release> device;
    std::unique_ptr<RTCSceneTy, Release> tree;

    /// Linear light of the point with barycentric coordinates (u, v) in `triangle`, seen by a ray `width_mm` wide.
    /// Depends on nothing else: a surface looks the same from everywhere.
    Rgb shade(std::uint32_t triangle, float u, float v, float width_mm) const;
};

}  // namespace lfdsim
