// Scenes of one channel, of displays whose glass disperses.
#include "files/description/display_file.h"
#include "interchange/peers/peers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lfdsim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Display dispersing(std::vector<std::string> overrides = {}) {
    overrides.insert(overrides.begin(), {"diffuser=none", "render.fresnel=\"none\"", "lens.index=none", "lens.glass=\"PC\""});
    return read_display(LFDSIM_SOURCE_DIR "/displays/desktop-spherical.toml", overrides);
}

std::vector<std::string> not_expressed_keys(Peer peer, const Display& d, const PeerOptions& options = {}) {
    std::vector<std::string> keys;
    for (const Problem& p : not_expressed(peer, d, resolve(d), options)) keys.push_back(p.where);
    return keys;
}

// Glass that disperses: one channel at a time, with the indices and the panel's light of that channel.
TEST(Scene, OfOneChannel) {
    const Display d = dispersing();
    for (const Peer peer : {Peer::pov, Peer::cycles, Peer::mitsuba}) {
        EXPECT_THAT(not_expressed_keys(peer, d), ElementsAre("panel.wavelengths_nm"));
        for (const int channel : {0, 1, 2}) {
            PeerOptions options;
            options.channel = channel;
            EXPECT_TRUE(not_expressed_keys(peer, d, options).empty());
            const PeerScene scene = peer_scene(peer, d, resolve(d), options);
            const double nm = d.panel.wavelengths_nm[std::size_t(channel)];
            EXPECT_EQ(scene.shown.lens.as<PlanoConvex>().index, index_of(shipped_glass("PC")->glass, nm));
            EXPECT_NEAR(resolve(scene.shown).base_z_mm, resolve(d).base_z_mm, 1e-12);
            EXPECT_THAT(scene.deviations.back(), HasSubstr("Only "));
        }
    }
    const Display broad = dispersing({"panel.primary_widths_nm=[20,20,20]", "render.wavelength_samples=3"});
    PeerOptions green;
    green.channel = 1;
    EXPECT_THAT(not_expressed_keys(Peer::pov, broad, green), ElementsAre("render.wavelength_samples"));
    Texels panel(2, 1);
    for (int k = 0; k < 8; ++k) panel.data()[k] = float(k + 1);
    const Texels only = light_of_channel(std::move(panel), 1);
    EXPECT_EQ(std::vector(only.data(), only.data() + 7), (std::vector<float>{0, 2, 0, 4, 0, 6, 0}));
}

}  // namespace
}  // namespace lfdsim
