// A posed model ready for ray tracing, independent of its position. Floor 2, internal to content.
#pragma once
#include "content/content.h"
#include "content/models/model.h"
#include "content/models/texture.h"

#include <embree3/rtcore.h>

#include <array>
#include <memory>
#include <vector>

namespace lfdsim {

/// A number for each of the sixteen rays of a packet.
struct alignas(64) Lanes {
    static constexpr int count = 16;
    /// A truth value for each ray.
    struct alignas(64) Mask {
        int of[count];  // -1: yes, 0: no
        bool any() const {
            int all = 0;
            for (const int k : of) all |= k;
            return all != 0;
        }
    };
    float of[count];
};

struct ContentScene::Impl : std::enable_shared_from_this<Impl> {
    mutable std::shared_ptr<const void> kept;  // what keep() gave, for as long as the scene exists
    std::shared_ptr<const Model> model;
    bool joined = false;  // the model was made for this scene

    // The frame of rays has its origin at centre_mm(), the middle of the posed model's box: there float32 is most precise, and
    // nothing here changes when the scene moves.
    Vec3d half_mm{};                  // half the extents of the smallest box about the origin that contains all
    std::vector<float> positions_mm;  // posed, about the centre; one float more than the vertices need, as Embree requires

    std::array<float, 3> light{};     // l, unit vector towards the light, in the model's axes
    float ambient = 0, strength = 0;  // a and s of docs/model.md, "Shading"
    bool see_through = false;         // some material is not opaque
    std::vector<MipMap> textures;
    std::vector<float> texels_per_mm;  // of each triangle, a mean over directions; 0: no texture

    std::int64_t tree_bytes = 0;  // memory that Embree has taken
    struct Release {
        void operator()(RTCSceneTy* s) const { rtcReleaseScene(s); }
        void operator()(RTCDeviceTy* d) const { rtcReleaseDevice(d); }
    };
    std::unique_ptr<RTCDeviceTy, Release> device;
    std::unique_ptr<RTCSceneTy, Release> tree;

    /// Returns the linear light (red, green, blue) of the points that a packet of rays has hit, seen by rays `width_mm` wide:
    /// colour (a + s max(0, n.l)), docs/model.md, "Shading". It depends on nothing else, so that a surface looks the same from
    /// everywhere. Lanes without a hit get meaningless numbers. `through`, if not null: the share of light from behind that
    /// passes, 0 for opaque materials.
    void shade(const RTCHit16&, const Lanes::Mask& hit, const Lanes& width_mm, Lanes* light, Lanes* through = nullptr) const;
};

}  // namespace lfdsim
