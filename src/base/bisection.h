// Bisection: where something ceases to hold. Floor 0.
#pragma once

namespace lfdsim {

/// Two numbers between which something ceases to hold: it holds at `in` and not at `out`, either of which may be the greater.
struct Bisected {
    double in, out;
    double middle() const { return 0.5 * (in + out); }
};

inline constexpr int to_last_bit = 2200;  // halvings, more than there are between any two numbers

/// Returns the last of `times` halvings of an interval, or the one between whose ends no number lies. `holds(number)` is not asked
/// at the ends.
template <class Holds>
Bisected bisected(double in, double out, int times, Holds holds) {
    Bisected b{in, out};
    for (int k = 0; k < times; ++k) {
        const double middle = b.middle();
        if (middle == b.in || middle == b.out) break;
        (holds(middle) ? b.in : b.out) = middle;
    }
    return b;
}

}  // namespace lfdsim
