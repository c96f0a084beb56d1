// A visitor for the tests of the painter: a small display in a folder of its own, and an outbox that keeps what it is given.
#pragma once
#include "files/description/display_file.h"
#include "image/formats/encoding.h"
#include "image/formats/image_file.h"
#include "view/painting/painter.h"
#include "view/painting/panels.h"
#include "view/server/outbox.h"

#include "../image/helpers.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

namespace lfdsim::view::test {

using lfdsim::test::TemporaryFolder;

inline constexpr const char* tiny_display = R"(
schema = 1
[panel]
pixels = [480, 270]
pixel_pitch_mm = 0.2
[lens]
type = "plano_convex"
sphere_radius_mm = 3
aperture_radius_mm = 0.95
cylinder_height_mm = 0.5
index = 1.49
[array]
count = [48, 27]
pitch_mm = 2
gap_mm = 6.5
[diffuser]
distance_mm = 60
angle_deg = [1.9, 1.9]
[camera]
position_mm = [0, 0, 500]
[content]
model = "built-in:spheres"
viewing_distance_mm = 500
)";

struct Sent {
    nlohmann::json header;
    std::string picture;
    std::chrono::steady_clock::time_point at;
};

class Kept : public Outbox {
  public:
    void text(std::string json) override {
        const std::lock_guard lock(mutex_);
        texts_.push_back(nlohmann::json::parse(json));
        came_.notify_all();
    }
    void frame(const std::string& lane, std::string bytes) override {
        std::size_t length = 0;
        for (std::size_t k = 0; k < 4; ++k) length |= std::size_t(static_cast<unsigned char>(bytes.at(k))) << (8 * k);
        Sent one{nlohmann::json::parse(bytes.substr(4, length)), bytes.substr(4 + length), std::chrono::steady_clock::now()};
        EXPECT_EQ(one.header.at("lane"), lane);
        const std::lock_guard lock(mutex_);
        frames_.push_back(std::move(one));
        came_.notify_all();
    }
    bool busy(const std::string&) const override { return busy_; }

    /// The first frame of that state, lane and quality; fails after a while.
    Sent wait(std::int64_t id, const std::string& lane = "one", const std::string& quality = "final") {
        Sent found;
        EXPECT_TRUE(until([&] {
            for (const Sent& f : frames_)
                if (f.header["id"] == id && f.header["lane"] == lane && f.header["quality"] == quality) {
                    found = f;
                    return true;
                }
            return false;
        })) << id
            << ' ' << lane << ' ' << quality;
        return found;
    }
    /// The problems of that state.
    nlohmann::json problems(std::int64_t id) {
        nlohmann::json found;
        EXPECT_TRUE(until([&] {
            for (const auto& t : texts_)
                if (t["type"] == "problems" && t["id"] == id) {
                    found = t["problems"];
                    return true;
                }
            return false;
        })) << id;
        return found;
    }
    std::vector<Sent> frames() const {
        const std::lock_guard lock(mutex_);
        return frames_;
    }
    std::vector<nlohmann::json> texts() const {
        const std::lock_guard lock(mutex_);
        return texts_;
    }
    void clear() {
        const std::lock_guard lock(mutex_);
        frames_.clear();
        texts_.clear();
    }
    void set_busy(bool busy) { busy_ = busy; }

  private:
    bool until(const std::function<bool()>& is) {
        std::unique_lock lock(mutex_);
        return came_.wait_for(lock, std::chrono::seconds(60), is);
    }

    mutable std::mutex mutex_;
    std::condition_variable came_;
    std::vector<Sent> frames_;
    std::vector<nlohmann::json> texts_;
    std::atomic<bool> busy_{false};
};

inline Wanted wanted(std::int64_t id, std::vector<std::string> set = {}) {
    Wanted w;
    w.id = id;
    w.set = std::move(set);
    w.eye_mm = {0, 0, 500};
    w.size = {160, 90};
    return w;
}

/// What the codes of a lossless frame are.
inline std::vector<std::uint8_t> codes_of(const Sent& frame, const TemporaryFolder& folder) {
    lfdsim::test::save(folder / "frame.png", frame.picture);
    return encode8(read_image(folder / "frame.png", Encoding::srgb), Encoding::srgb);
}

}  // namespace lfdsim::view::test
