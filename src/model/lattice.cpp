#include "model/lattice.h"

#include "model/display.h"
#include "model/numbers.h"

#include <cmath>

namespace lfdsim {

bool differs_by_axis(const LensArray& array) { return array.lattice == LatticeKind::rectangle; }

double inner_radius_mm(const LensArray& array) { return array.pitch_mm.least() / 2; }

// Half the diagonal, in a form that gives p / sqrt(2) to the last bit for a square.
double outer_radius_mm(const LensArray& array) {
    const double q = array.pitch_mm[1] / array.pitch_mm[0];
    return array.pitch_mm[0] / std::sqrt(4 / (1 + q * q));
}

template <class S>
Lattice<S> make_lattice(const LensArray& array) {
    Lattice<S> l{};
    for (std::size_t k = 0; k < 2; ++k) {
        const double pitch = array.pitch_mm[k];
        l.pitch[k] = S(pitch);
        l.per_pitch[k] = S(1 / pitch);
        l.half_pitch[k] = S(pitch / 2);
        l.count[k] = S(array.count[k]);
        l.offset[k] = S(array.offset_mm[k]);
    }
    l.cos_turn = S(std::cos(array.rotation_deg * degree));
    l.sin_turn = S(std::sin(array.rotation_deg * degree));
    return l;
}

template Lattice<float> make_lattice<float>(const LensArray&);
template Lattice<double> make_lattice<double>(const LensArray&);

}  // namespace lfdsim
