// The problems that validation has found so far, and its steps. Floor 0.
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

/// A list of problems to which the steps of validation add theirs.
class Findings {
  public:
    explicit Findings(std::vector<Problem>& all) : all_(all) {}

    /// Adds a problem: the TOML key, and what is wrong with it, formatted as by fmt::format().
    template <class... Args>
    void add(std::string where, fmt::format_string<Args...> what, Args&&... args) {
        all_.push_back({std::move(where), fmt::format(what, std::forward<Args>(args)...)});
    }

    /// Returns whether no problem has been found with a key ("lens.index"), with any key of a table ("lens."), or with a table
    /// that contains it: only then may another check use its value.
    bool sound(std::string_view key) const {
        return std::none_of(all_.begin(), all_.end(), [&](const Problem& p) {
            return p.where.starts_with(key) || (key.starts_with(p.where) && key.substr(p.where.size()).starts_with('.'));
        });
    }

  private:
    std::vector<Problem>& all_;
};

/// The rounding error of sums of lengths up to a metre, mm: parts that overlap by less touch.
inline constexpr double rounding_mm = 1e-9;

/// Runs all checks of validate(). A reader may run first and add the keys that it could not read, which are then not checked
/// further. If it could not read the glasses (`glasses_known` false), lenses have no positions, and whatever depends on them is
/// not checked.
void validate_all(const Display&, Findings&, bool glasses_known);

// The steps of validate_all(), in their order: later ones use values that earlier ones have found sound.
void validate_values(const Display&, Findings&);   // each key by itself: ranges, NaN, counts, keys that exclude or need one another
void validate_panel(const Display&, Findings&);    // whether its subpixels make sense together
void validate_content(const Display&, Findings&);  // whether each object of a scene is one thing of one size, lit from somewhere
void validate_glass(const Display&, Findings&);    // whether each medium has an index, at every wavelength that is used
void validate_lens(const Display&, Findings&);     // whether such a lens can be made and fits its cell
void validate_layout(const Display&, Findings&);   // whether parts collide, by the resolved geometry
void validate_errors(const Display&, Findings&);   // whether parts collide, or rays are undefined, with the errors of the array

}  // namespace lfdsim
