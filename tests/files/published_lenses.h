// Lenses with published focal lengths, as files of Zemax's format: our own text, with the numbers of their sources.
#pragma once
#include <string>

namespace lfdsim::published {

// Tessar, f/4.5, focal length 4 inches. Milton Laikin, Lens Design, 4th edition, CRC Press, 2007, p. 63.
inline const std::string tessar = R"(MODE SEQ
UNIT IN X W X CM MR CPMM
FNUM 4.5 0
FTYP 0 0 3 1 0 0 0
YFLN 0 10 20.5
WAVM 1 0.5875618 1
PWAV 1
SURF 0
  CURV 0
  DISZ INFINITY
SURF 1
  TYPE STANDARD
  CURV 0.750243
  DISZ 0.2791
  GLAS N-SK15 0 0 1.5 4.0E+1
SURF 2
  CURV -0.100246
  DISZ 0.2054
SURF 3
  CURV -0.478080
  DISZ 0.09
  GLAS F2 0 0 1.5 4.0E+1
SURF 4
  CURV 0.824878
  DISZ 0.0709
SURF 5
  STOP
  CURV 0
  DISZ 0.1534
SURF 6
  CURV -0.132970
  DISZ 0.09
  GLAS K10 0 0 1.5 4.0E+1
SURF 7
  CURV 0.768640
  DISZ 0.3389
  GLAS N-SK15 0 0 1.5 4.0E+1
SURF 8
  CURV -0.657117
  DISZ 3.4025
SURF 9
  CURV 0
  DISZ 0
)";

// Heliar, f/5, focal length 10, in mm here. The same book and page.
inline const std::string heliar = R"(UNIT MM
ENPD 2.0
FTYP 0
YFLN 0 7 10
SURF 0
  CURV 0
  DISZ 1E10
SURF 1
  CURV 0.2375127664
  DISZ 0.9004
  GLAS N-SK16
SURF 2
  CURV -0.2761820592
  DISZ 0.2999
  GLAS E-LLF6
SURF 3
  CURV 0.0342619462
  DISZ 0.7587
SURF 4
  CURV -0.3153082138
  DISZ 0.2
  GLAS E-LLF6
SURF 5
  CURV 0.3116915438
  DISZ 0.1264
SURF 6
  STOP
  CURV 0
  DISZ 0.2629
SURF 7
  CURV 0.0232174781
  DISZ 0.25
  GLAS E-LLF6
SURF 8
  CURV 0.4082632481
  DISZ 0.8308
  GLAS N-SK16
SURF 9
  CURV -0.3069744597
  DISZ 8.5066
SURF 10
  CURV 0
  DISZ 0
)";

// The achromatic doublet AC254-100-A of Thorlabs's catalogue: focal length 100.1 mm, back focal length 97.1 mm.
inline const std::string achromat = R"(UNIT CM
SURF 0
  CURV 0
  DISZ INFINITY
SURF 1
  STOP
  CURV 0.15923566878980891
  DISZ 0.4
  GLAS N-BK7 1 0 1.5168 64.167
  DIAM 1.27 1 0 0 1 ""
SURF 2
  CURV -0.21881838074398249
  DISZ 0.25
  GLAS ___BLANK 1 0 1.6727 32.21
  DIAM 1.27 1 0 0 1 ""
SURF 3
  CURV -0.078003120124804992
  DISZ 9.71
  DIAM 1.27 1 0 0 1 ""
SURF 4
  CURV 0
  DISZ 0
)";

// The f/5 triplet of 50 mm with a field of 20 degrees that lens design programs show as their first example.
inline const std::string triplet = R"(UNIT MM
ENPD 10
FTYP 0 0 3 3 0 0 0
YFLN 0 14 20
WAVM 1 0.55 1
PWAV 1
SURF 0
  CURV 0
  DISZ INFINITY
SURF 1
  CURV 0.0454264843
  DISZ 3.25896
  GLAS N-SK16 0 0 1.5 4.0E+1
SURF 2
  CURV -0.0022948389
  DISZ 6.00755
SURF 3
  CURV -0.0450181153
  DISZ 0.99997
  GLAS F2 0 0 1.5 4.0E+1
SURF 4
  STOP
  CURV 0.0492806989
  DISZ 4.75041
SURF 5
  CURV 0.0125496338
  DISZ 2.95208
  GLAS N-SK16 0 0 1.5 4.0E+1
SURF 6
  CURV -0.0543616233
  DISZ 42.20778
SURF 7
  CURV 0
  DISZ 0
)";

// A flat face and a hyperboloid of conic constant -n^2 bring a parallel beam to one point, at any aperture: f = R / (n - 1). E.
// Hecht, Optics, section 5.2.1. Here n = 1.5, R = 5 mm, f = 10 mm, f/1.25.
inline const std::string hyperboloid = R"(UNIT MM
SURF 0
  CURV 0
  DISZ INFINITY
SURF 1
  STOP
  TYPE EVENASPH
  CURV 0
  DISZ 3
  GLAS ___BLANK 1 0 1.5 0
  DIAM 4
SURF 2
  CURV -0.2
  CONI -2.25
  DISZ 10
  DIAM 4
SURF 3
  CURV 0
  DISZ 0
)";

}  // namespace lfdsim::published
