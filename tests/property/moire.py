"""Moire of a white screen: the wave that an eye sees best in what subpixels and black matrix do to the light of the middle of the screen.

The panel's light is a Fourier series of its place P there: the sum of c_K exp(2 pi i K P). So the sum of light times exp(2 pi i (K P - f r)) over lines of sight
that aim at places r, and end at P, is what the harmonic K gives to the wave of frequency f. These sums are searched for waves K by K: in each of them all else is
missing that would be noise in the light itself.
"""
import functools
from dataclasses import dataclass

import numpy as np

import oracle
from colours import LUMINANCE
from edges import error_of
from sight import SETS, diffuser_turns
from white import radiance

SIDE = 110           # squares along each axis of the window, with a line through each in each set; where most are blocked up to three times as many
HARMONICS = 100      # looked at, the strongest of any channel
SEARCHED = 30        # of these, for waves
ORDERS = 8           # of harmonics, in periods per narrowest rectangle
PEAKS = 6            # of each harmonic and wavelength
WAVES = 12           # of each pattern that are measured
FINEST = 50.0        # cycles per degree
LEAST_PERIODS = 3.0  # in the window
BLOCKS = 64          # along each axis, in which sums are kept while a peak is sought
HEARD = 4            # standard errors: what is surely there
CLOSE = 1e-4         # steps to which a peak is sought
ONE_WAVE = 0.3       # steps of frequency, a period of the window each: harmonics whose waves are no farther apart make one


@dataclass
class Wave:
    frequency: np.ndarray  # cycles per mm along x and y
    frequency_error: float
    contrast: float        # Michelson's
    contrast_error: float
    filter: float          # of the eye

    @property
    def period(self):
        return 1 / np.hypot(*self.frequency)

    @property
    def direction(self):
        return np.degrees(np.arctan2(*self.frequency[::-1])) % 180

    @property
    def seen(self):
        return self.contrast * self.filter

    @property
    def seen_error(self):
        return self.contrast_error * self.filter


def sensitivity(cycles_per_degree):
    """Of the eye to contrast, over its greatest (Mannos and Sakrison)."""
    return _sensitivity(cycles_per_degree) / _GREATEST


def _sensitivity(v):
    return 2.6 * (0.0192 + 0.114 * v) * np.exp(-((0.114 * v) ** 1.1))


_GREATEST = _sensitivity(np.linspace(5, 11, 60001)).max()


def harmonic(subpixels, channel, k, l):
    """c of a channel's light with (k, l) periods in a cell, k to the right and l down."""
    mine = subpixels.channel == channel
    low, high = subpixels.low[mine], subpixels.high[mine]
    nu, size = np.array([k, l]) / subpixels.size, high - low
    share = size.prod(axis=1) / size.prod(axis=1).sum()
    return np.sum(share * np.sinc(nu * size).prod(axis=1) * np.exp(-2j * np.pi * ((low + high) / 2 @ nu)))


def strongest_harmonics(subpixels):
    """[((k, l), c of each channel (3,))] of a half plane."""
    most = np.ceil(ORDERS * subpixels.size / (subpixels.high - subpixels.low).min(axis=0)).astype(int)
    found = [((k, l), np.array([harmonic(subpixels, c, k, l) for c in range(3)])) for k in range(most[0] + 1)
             for l in range(-most[1] if k else 1, most[1] + 1)]
    found.sort(key=lambda one: -np.abs(one[1]).max())
    return [one for one in found[:HARMONICS] if np.abs(one[1]).max() > 1e-3]


def blackman(u):
    """Over -0.5 to 0.5, 1 in the mean."""
    return 1 + (0.5 * np.cos(2 * np.pi * u) + 0.08 * np.cos(4 * np.pi * u)) / 0.42


class Screen:
    """The middle of the screen, `window` mm wide and high, from an eye on axis."""

    def __init__(self, display, eye, window, seed):
        self.window, self.per_degree = np.array(window), (eye - display.vertex_plane) * np.pi / 180
        rng = np.random.default_rng([11, seed])
        self.look(display, eye, rng, SIDE)
        lit = len(self.share) / self.lines
        if 0 < lit < 0.5:
            self.look(display, eye, rng, int(SIDE * min(1 / np.sqrt(lit), 3)))
        self.at = self.share * self.window
        self.harmonics = strongest_harmonics(display.subpixels)
        orders = np.array([order for order, _ in self.harmonics]) / display.subpixels.size
        # What each harmonic makes of each line's light, but for c: (harmonics, lines) for each wavelength
        self.moved = [np.exp(2j * np.pi * (orders @ place.T)).astype(np.complex64) * light.astype(np.float32) for place, light in self.seen]

    def look(self, display, eye, rng, side):
        """Follows lines of sight, side x side in each set, and keeps those that bring light."""
        squares = np.stack(np.meshgrid(np.arange(side), np.arange(side)), axis=-1).reshape(-1, 2)
        share = ((squares + rng.random((SETS, side**2, 2))) / side - 0.5).reshape(-1, 2)  # of the window
        aim, start = np.column_stack([share * self.window, np.full(len(share), display.vertex_plane)]), np.array([0.0, 0.0, eye])
        turns = diffuser_turns(display.diffuser, rng.random((len(share), 2))) if display.diffuser else None
        colours = display.primaries if len(display.colours) > 1 else [display]
        hits = [oracle.trace(at, np.broadcast_to(start, aim.shape), aim - start, turns) for at in colours]
        light = [blackman(share).prod(axis=1) * radiance(at, h) for at, h in zip(colours, hits)]
        lit = np.any(light, axis=0)
        self.share, self.lines, self.a_set = share[lit], len(share), side**2
        self.block = np.minimum(((self.share + 0.5) * BLOCKS).astype(int), BLOCKS - 1) @ [BLOCKS, 1] + np.repeat(np.arange(SETS), side**2)[lit] * BLOCKS**2
        self.seen = [(np.column_stack([h.x, h.y])[lit], part[lit]) for h, part in zip(hits, light)]  # places on the panel in pixels, and light
        self.mean = np.array([part.sum() for _, part in self.seen]) / self.lines
        self.noise = [np.sqrt((part**2).sum()) / self.lines for _, part in self.seen]  # of a mean, if each line's light were chance

    def patterns(self, coloured):
        """{name: weights of the channels in each wavelength (wavelengths, 3)}."""
        def by_wavelength(weights):
            return np.diag(weights) if len(self.seen) == 3 else weights[None, :]
        return {"white": by_wavelength(LUMINANCE), **({f"white.{name}": by_wavelength(np.eye(3)[c]) for c, name in enumerate("rgb")} if coloured else {})}

    @functools.cached_property
    def peaks(self):
        """[(wavelength, number of the harmonic, frequency, strength to the eye but for c)]: the strongest of each."""
        bins = 2 ** np.maximum(np.ceil(np.log2(2 * FINEST * self.window / self.per_degree)), 4).astype(int)
        square = np.minimum(((self.share + 0.5) * bins).astype(int), bins - 1) @ [bins[1], 1]
        order = [np.fft.fftfreq(n, 1 / n) for n in bins]
        cycles = np.hypot(order[0][:, None] / self.window[0], order[1] / self.window[1]) * self.per_degree
        factor = sensitivity(cycles) / np.outer(np.sinc(order[0] / bins[0]), np.sinc(order[1] / bins[1])) / self.lines  # squares average waves
        factor[(np.hypot(order[0][:, None], order[1]) < LEAST_PERIODS) | (cycles > FINEST)] = 0.0
        found = []
        for wavelength, moved in enumerate(self.moved):
            for number, light in enumerate(moved[:SEARCHED]):
                plane = np.bincount(square, light.real, bins.prod()) + 1j * np.bincount(square, light.imag, bins.prod())
                strength = np.abs(np.fft.fft2(plane.reshape(bins))) * factor
                for _ in range(PEAKS):
                    k, l = np.unravel_index(strength.argmax(), strength.shape)
                    found.append((wavelength, number, np.array([order[0][k], order[1][l]]) / self.window, strength[k, l]))
                    strength[np.ix_(np.arange(k - 3, k + 4) % bins[0], np.arange(l - 3, l + 4) % bins[1])] = 0.0
        return [peak for peak in found if peak[3] > 0]

    def least(self, weights):
        """The contrast of a wave of the strongest harmonic that is surely found."""
        return max(2 * HEARD * noise * np.abs(c @ of).max() for noise, of in zip(self.noise, weights) for _, c in self.harmonics) / (weights.sum(axis=1) * self.mean).sum()

    def waves(self, weights, also=()):
        """The waves of a pattern that are seen best, and those near the frequencies `also`."""
        mean = (weights.sum(axis=1) * self.mean).sum()
        ranked = sorted(((np.abs(self.harmonics[n][1] @ weights[w]) * strength, tuple(f), (w, n)) for w, n, f, strength in self.peaks), reverse=True)
        wanted, apart = [(f, None) for f in also], []
        for strength, f, of in ranked:
            if strength and len(apart) < WAVES and all(min(np.hypot(*((f - s * g) * self.window)) for s in (-1, 1)) > 2 for g in apart):
                apart.append(np.array(f))
                wanted.append((apart[-1], of))
        found = [self.measured(f, of, weights, mean) for f, of in wanted]
        return [wave for wave in found if wave and np.hypot(*(wave.frequency * self.window)) >= 0.98 * LEAST_PERIODS]

    def measured(self, about, of, weights, mean):
        """The wave near a frequency: of one harmonic in one wavelength (`of`, or else that which gives most there) and of those whose waves are the same."""
        way, found = np.exp(-2j * np.pi * (self.at @ about)), []
        for w, (moved, noise) in enumerate(zip(self.moved, self.noise)):
            c = np.array([c @ weights[w] for _, c in self.harmonics])
            for back in (way, np.conj(way)):  # K, and -K as the conjugate of K at -f
                part = np.abs(moved @ back.astype(np.complex64)) / self.lines
                found += [(abs(c[n]) * part[n], (w, n), back is way, c[n]) for n in np.flatnonzero((part > HEARD * noise) & (c != 0))]
        found.sort(key=lambda one: (one[1] != of, -one[0]))
        if not found:
            return None
        sums, unclear = self.sums(*found[0][1:], way), 0.0
        together, own = sums, peak(sums.mean(axis=0))
        for part, *one in found[1:]:
            if part < 0.01 * found[0][0]:
                continue
            other = self.sums(*one, way)
            away = np.hypot(*(peak(other.mean(axis=0)) - own))
            together = together + other if away <= ONE_WAVE else together
            unclear += part if 0.5 * ONE_WAVE < away < 2 * ONE_WAVE else 0.0
        quarters = np.array([peak(sums[k::4].mean(axis=0)) for k in range(4)]) / self.window
        each = np.array([amplitude(own, one) for one in together])
        along = (each * np.exp(-1j * np.angle(each.mean()))).real * 2 / mean
        frequency = about + own / self.window
        return Wave(frequency, np.hypot(*quarters.std(axis=0, ddof=1)) / 2 + CLOSE / self.window.min(), along.mean(), np.hypot(error_of(along), 2 * unclear / mean / 3),
                    sensitivity(np.hypot(*frequency) * self.per_degree))

    def sums(self, of, forward, c, way):
        """(SETS, BLOCKS, BLOCKS): what a harmonic gives to a wave in each block of the window, of each set's mean."""
        light = self.moved[of[0]][of[1]] * c
        part = (light if forward else np.conj(light)) * way
        return (np.bincount(self.block, part.real, SETS * BLOCKS**2) + 1j * np.bincount(self.block, part.imag, SETS * BLOCKS**2)).reshape(
            SETS, BLOCKS, BLOCKS) / self.a_set


def amplitude(shift, sums):
    """Of the wave `shift` periods of the window off that which the sums are about."""
    turn = [np.exp(-2j * np.pi * s * ((np.arange(BLOCKS) + 0.5) / BLOCKS - 0.5)) / np.sinc(s / BLOCKS) for s in shift]
    return turn[0] @ sums @ turn[1]


def peak(sums):
    """The shift of the strongest wave, by up to 1.5 periods."""
    best, most, width = np.zeros(2), abs(amplitude(np.zeros(2), sums)), 0.5
    while width > CLOSE:
        tried = [best + width * np.array(move) for move in ((1, 0), (-1, 0), (0, 1), (0, -1))]
        values = [abs(amplitude(t, sums)) if np.abs(t).max() <= 1.5 else 0.0 for t in tried]
        if max(values) > most:
            best, most = tried[int(np.argmax(values))], max(values)
        else:
            width /= 2
    return best
