// Positions in double precision, until they are near enough to the origin to become floats.
#pragma once
#include <assimp/types.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lfdsim::reader {

using Place = aiVector3t<double>;

/// The middle and the size of the box about positions. Positions are taken relative to the middle if it lies farther from the
/// origin than the box is long: there a float would round by more than about 1e-7 of the size.
class BoxMiddle {
  public:
    void add(const Place& p) {
        for (unsigned k = 0; k < 3; ++k) {
            if (!std::isfinite(p[k])) continue;  // refused later, in words
            low_[k] = std::min(low_[k], p[k]);
            high_[k] = std::max(high_[k], p[k]);
        }
    }
    /// Returns the position to subtract; (0, 0, 0) if that is not needed.
    Place offset() const {
        const Place middle = (low_ + high_) * 0.5;
        const bool far = middle.Length() > size();  // false without places
        return far && std::isfinite(middle.Length()) ? middle : Place();
    }
    /// Returns the diagonal of the box.
    double size() const { return (high_ - low_).Length(); }
    /// Returns the exponent of the power of two that gives the box a diagonal of 2^20 to 2^21; 0 without one. Assimp has thresholds
    /// of length, up to 1e-5, which are then below a float's last bit, and takes squares of areas, which are then within the range
    /// of floats; no bit of a result changes otherwise.
    int exponent() const { return size() > 0 && std::isfinite(size()) ? 20 - std::ilogb(size()) : 0; }

  private:
    static constexpr double none = std::numeric_limits<double>::max() / 4;
    Place low_{none, none, none}, high_{-none, -none, -none};
};

inline aiVector3D to_float(const Place& p) { return {float(p.x), float(p.y), float(p.z)}; }

}  // namespace lfdsim::reader
