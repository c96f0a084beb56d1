"""Crosstalk: how much of the light that an eye sees is meant for other views, or for the other eye. Leak over signal; the panel's black is 0.

A panel point P in the elemental image centred at e C is meant for the horizontal slope s = (e C - P)/g; along slanted strips' rows, which is across them over
the cosine of the slant. A pixel, or a subpixel where content is made for each, shines as a whole for the slope of its centre. View k has the slopes within half
a step of k a/g. Light of pixels that lie on a border of two elemental images within rounding is in the errors, and so is one line of sight: as much may be missed.
"""
import functools

import numpy as np

import oracle
from colours import LUMINANCE, White
from edges import error_of
from sight import per_set
from table import FORM_ERRORS, UNSURE

SUBPIXEL, PIXEL = "subpixel", "pixel"  # what content is made for
TIE = 1e-9  # of slopes: a pixel whose centre lies on the border of two views is half of either


class Seen:
    """What eyes at z = `distance`, level with the screen's middle, see of a white panel along lines of sight."""

    def __init__(self, sight, distance):
        self.sight, self.distance = sight, distance
        self.step = sight.display.panel.pixel_pitch_mm / sight.display.gap  # of views, as slopes
        raised = sight.display.errors.gap_mm if sight.display.errors else 0.0
        self.view_mm = sight.display.panel.pixel_pitch_mm / (sight.display.gap + raised) * (distance - sight.display.paraxial.rear - raised)  # of the display as built
        self.white = functools.cache(lambda x: White(sight, np.array([x, 0.0, distance])))

    def slopes(self, x, sampling):
        """(s, luminance, that of pixels of two lenses) of each line of sight, a row for each channel and wavelength; light on no lens's image does not count."""
        found, on_screen = [], self.sight.on_screen([x, 0.0, self.distance])
        for channel in range(3):
            for light, column, row in self.white(x).shining(channel):
                slope, owned, either = self.meant(channel, column, row, sampling)
                counts = np.where(on_screen, LUMINANCE[channel] * light, 0.0)
                found.append((slope, np.where(owned, counts, 0.0), np.where(either, counts, 0.0)))
        return tuple(np.array(part) for part in zip(*found))

    def meant(self, channel, column, row, sampling):
        """(slope, whether a lens owns it, whether two may) of pixels or their subpixels."""
        d = self.sight.display
        if sampling == SUBPIXEL:
            points, shows = oracle.subpixel_points(d, channel, column, row)
        else:
            points, shows = oracle.pixel_centres(d, column, row), True
        lines = oracle.nodal_lines(d, points)
        towards = (self.sight.centres(lines.lens) - points) / d.gap
        along_row = towards @ self.sight.axes[0] / self.sight.axes[0, 0] if d.strips else towards[:, 0]
        return along_row, lines.owned & shows, self.sight.between_lenses(points) & shows

    def view_percent(self, middle, sampling):
        """Of an eye in the middle of a view, in steps: all other light over that of the view."""
        s, light, either = self.slopes(middle * self.view_mm, sampling)
        meant = above(0.5 * self.step - np.abs(s - middle * self.step))
        return over(light * (1 - meant), light * meant, either)

    def eye_percent(self, side, between, sampling):
        """Of one of two eyes `between` mm apart, side -1 (left) or 1: light meant for the other side of the head over that for its own."""
        s, light, either = self.slopes(0.5 * side * between, sampling)
        return over(light * above(-side * s), light * above(side * s), either)


def above(x):
    """1 where x is positive, a half where it is 0."""
    return np.where(np.abs(x) < TIE, 0.5, x > 0)


def over(leak, signal, either):
    """In per cent, of rows over sets: (value, error); None without signal, UNSURE where pixels of two lenses make out half of it."""
    if 2 * either.sum() > max(leak.sum(), 0.02 * signal.sum()):
        return UNSURE
    open_light = either.sum() + max(leak.max(), signal.max())
    leak, signal = per_set(leak.sum(axis=0)), per_set(signal.sum(axis=0))
    if not signal.sum() > 0:
        return None
    share = leak.sum() / signal.sum()
    return 100 * share, 100 * (error_of(leak - share * signal) / signal.mean() + (1 + share) * open_light / signal.sum() / FORM_ERRORS)
