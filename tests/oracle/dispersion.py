"""Refractive indices at a wavelength, and the wavelengths at which the panel's three channels shine. Wavelengths in nm."""
import math

import numpy as np

NM_D, NM_F, NM_C = 587.5618, 486.1327, 656.2725  # Fraunhofer's lines
FULL_WIDTH = math.sqrt(8 * math.log(2))          # full width at half maximum over standard deviation


def sellmeier(b1, c1, b2, c2, b3, c3):
    """n^2 = 1 + sum of B l^2 / (l^2 - C), l in micrometres, C in their squares."""
    return lambda l: math.sqrt(1 + sum(b * l**2 / (l**2 - c) for b, c in ((b1, c1), (b2, c2), (b3, c3))))


def cauchy(a, b, c=0.0):
    """n = A + B / l^2 + C / l^4."""
    return lambda l: a + b / l**2 + c / l**4


def two_figures(nd, vd):
    """n = A + B / l^2 through n_d with n_F - n_C = (n_d - 1) / V_d."""
    square = lambda nm: (1000 / nm) ** 2
    b = (nd - 1) / vd / (square(NM_F) - square(NM_C))
    return cauchy(nd - b * square(NM_D), b)


def even_powers(up, constant, *down):
    """n^2 = constant + up[0] l^2 + up[1] l^4 + ... + down[0] / l^2 + down[1] / l^4 + ..."""
    return lambda l: math.sqrt(constant + sum(a * l ** (2 + 2 * k) for k, a in enumerate(up)) + sum(a / l ** (2 + 2 * k) for k, a in enumerate(down)))


# PMMA: Beadie and others 2015. N-BK7: Schott. PC: six coefficients, as common in lens design.
BY_NAME = {
    "PMMA": even_powers((6.1209e-3, -1.5004e-3), 2.1778, 2.3678e-2, -4.2137e-3, 7.3417e-4, -4.5042e-5),
    "N-BK7": sellmeier(1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653),
    "PC": even_powers((-3.86116645e-5,), 2.42838566, 2.87574474e-2, -1.97897366e-4, 1.48358968e-4, 1.38651935e-6),
}


def formula(glass):
    """The index as a function of the wavelength in micrometres; glass: a name or a table."""
    if isinstance(glass, str):
        return BY_NAME[glass]
    if "sellmeier" in glass:
        return sellmeier(*glass["sellmeier"])
    return cauchy(*glass["cauchy"]) if "cauchy" in glass else two_figures(glass["nd"], glass["vd"])


def index_of(row, nm):
    """The index of a lens, a surface's medium or a layer: constant, of a glass at this wavelength, or that of air."""
    if "glass" not in row:
        return row.get("index", 1.0)
    if "index" in row:
        raise ValueError("both index and glass are given")
    n = formula(row["glass"])(nm / 1000)
    if not 1 <= n <= 4:
        raise ValueError(f"{row['glass']} has an index of {n} at {nm} nm")
    return n


def has_glass(text):
    """Whether an index of a parsed description depends on the wavelength."""
    return any("glass" in row for row in [text["lens"], *text["lens"].get("surface", [])[:-1], *text["panel"].get("layer", [])])


def wavelengths(middle, width, samples):
    """[(nm, share)] of one channel: Gauss-Hermite quadrature over a normal distribution of this full width at half maximum."""
    if samples == 1:
        return [(middle, 1.0)]
    at, weight = np.polynomial.hermite.hermgauss(samples)
    return [(middle + math.sqrt(2) * width / FULL_WIDTH * x, w / math.sqrt(math.pi)) for x, w in zip(at, weight)]
