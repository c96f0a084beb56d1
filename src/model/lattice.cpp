#include "model/lattice.h"

#include "model/display.h"
#include "model/numbers.h"

#include <cmath>

namespace lfdsim {

template <class S>
Lattice<S> make_lattice(const LensArray& array) {
    Lattice<S> l{};
    for (std::size_t k = 0; k < 2; ++k) {
        const double pitch = array.pitch_mm;
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
