// What validation has found so far. Floor 0.
#pragma once
#include "base/input_error.h"
#include "display/display.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace lfdsim {

class Findings {
  public:
    explicit Findings(std::vector<Problem>& all) : all_(all) {}

    template <class... Args>
    void add(std::string where, fmt::format_string<Args...> what, Args&&... args) {
        all_.push_back({std::move(where), fmt::format(what, std::forward<Args>(args)...)});
    }

    /// Whether nothing is wrong yet with a key ("lens.index"), with any in a table ("lens."), or with what it is part of: only then
    /// may another check build on its value.
    bool sound(std::string_view key) const {
        return std::none_of(all_.begin(), all_.end(), [&](const Problem& p) {
            return p.where.starts_with(key) || (key.starts_with(p.where) && key.substr(p.where.size()).starts_with('.'));
        });
    }

  private:
    std::vector<Problem>& all_;
};

inline constexpr double rounding_mm = 1e-9;  // of sums of lengths up to a metre

/// Runs all checks of validate(). A reader may run first and name the keys that it could not read; these are not checked further.
/// If it could not read the glasses, lenses have no positions, and whatever depends on them is not checked.
void validate_all(const Display&, Findings&, bool glasses_known);

// The steps of validate_all(), in order.
void validate_values(const Display&, Findings&);   // each key by itself: ranges, NaN, counts, keys that exclude or need one another
void validate_panel(const Display&, Findings&);    // whether its subpixels make sense together
void validate_content(const Display&, Findings&);  // whether each object of a scene is one thing of one size, lit from somewhere
void validate_glass(const Display&, Findings&);    // whether each medium has an index, at every wavelength that is used
void validate_lens(const Display&, Findings&);     // whether such a lens can be made and fits its cell
void validate_layout(const Display&, Findings&);   // whether parts collide, by the resolved geometry
void validate_errors(const Display&, Findings&);   // whether the array can be off by so much

}  // namespace lfdsim
