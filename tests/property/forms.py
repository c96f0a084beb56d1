"""Which figures of `lfdsim check` and `lfdsim analyze` are held against which form, and what the program is told to measure for them."""
import math

import numpy as np

import crosstalk
import field_of_view
import one_lens
import paraxial
import sharpness
import viewing_zone
import white
from edges import Unsure
from sight import Sight, without_diffuser
from table import UNSURE

LINES = 128   # of sight in each set
MANY = 512    # for shares of 1 %, means and spreads
BETWEEN_EYES_MM = 65.0
LOOSE = 0.05  # of a frequency: a form that knows it no better does not tell


def least(form, limit):
    """The lesser of a form and a number; a form of None lies above it."""
    if form == UNSURE or form is None:
        return UNSURE if form == UNSURE else (limit, 1e-6 * limit)
    value, error = form
    return min(value, limit), error if value < limit + 4 * error else 1e-6 * limit


class Forms:
    """All forms of a drawn display. Each method is named as its measure, takes its result, and gives {path there: form, or a list of forms}."""

    def __init__(self, display, description, seed):
        self.display, self.description, self.seed = display, description, seed
        self.viewing = description["content"]["viewing_distance_mm"]
        self.eye = description["camera"]["position_mm"][2]
        stretch = 1 + display.gap / (self.viewing - display.paraxial.rear)
        self.stretch = stretch
        self.axes = (0,) if display.strips else (0, 1)  # along which the lenses image
        self.in_rows = display.array.lattice in ("square", "rectangle")
        self.covered = bool(display.layers) or display.glued
        power = 1 / display.paraxial.f - 1 / display.gap
        self.central_depth = 1 / power if power else math.inf
        self.hint = np.degrees(np.arctan(stretch * display.cell.width / (2 * display.gap)))  # along x' and y'

    def takes(self, measure):
        """Whether there are forms for it: pinholes image nothing, one_lens.py knows rows of lenses in air, crosstalk.py no pixels askew to strips."""
        if measure in ("dof", "spot"):
            return self.display.lens.type != "pinhole" and self.in_rows and not self.covered
        return not (measure == "mtf" and self.display.lens.type == "pinhole") and not (measure == "crosstalk" and self.display.strips)

    def sight(self, lines, with_diffuser):
        return Sight(self.display, self.viewing, lines, self.seed, with_diffuser)

    def check(self, result):
        return paraxial.forms(self.display, self.description)

    def fov(self, result):
        bare, out = self.sight(LINES, False), {}
        for axis, name in self.named_axes():
            out[f"{name}.own_lens_deg"] = pair(field_of_view.own_lens_deg, bare, axis, self.eye, self.hint[axis])
        if not self.display.strips:
            out["eyebox_mm"] = [sure(field_of_view.eyebox_mm, bare, axis, self.eye, self.hint[axis]) for axis in (0, 1)]
        if self.display.diffuser:
            out |= {f"{name}.own_lens_with_diffuser_deg": ends for name, ends in self.edges_as_shown().items()}
        return out

    def named_axes(self):
        return [(axis, ("horizontal", "vertical")[axis]) for axis in self.axes]

    def edges_as_shown(self):
        """Through the diffuser where there is one."""
        sight = self.sight(LINES, True)
        return {name: pair(field_of_view.own_lens_deg, sight, axis, self.eye, self.hint[axis]) for axis, name in self.named_axes()}

    def likeness(self, result):
        """The scene's share of the picture is a half where that of its light is."""
        return {f"{name}.gradient_edge_deg": ends for name, ends in self.edges_as_shown().items()}

    def dof(self, result):
        rays = one_lens.fan(self.display, np.argmax(self.display.clear_aperture))  # the wider one
        most = self.display.panel.pixel_pitch_mm / self.display.gap
        ends = one_lens.sharp_range(rays, most) if len(rays[0]) else None
        return {"spot_diopters": [None, None] if ends is None else [(1000 * u, 1e-6 * 1000 * (ends[1] - ends[0])) for u in reversed(ends)]}  # near, far

    def zone(self, result):
        lines, out = self.sight(MANY, True), {}
        for axis, name in self.named_axes():
            for percent in (1, 50):
                out[f"{name}.wrong_{percent}_percent_deg"] = pair(viewing_zone.zone_deg, lines, axis, self.eye, percent / 100, self.hint[axis])
        return out

    def uniformity(self, result):
        eye, out = [0.0, 0.0, self.eye], {"screen.luminance_over_panel": white.luminance(self.sight(MANY, True), [0.0, 0.0, self.eye])}
        middle = Sight(self.display, self.viewing, 8 * MANY, self.seed, True, middle_half=True)
        for axis, name in self.named_axes():
            out[f"bands.{name}_contrast"] = white.band_contrast(middle, eye, axis)
        if self.in_rows and not self.covered:
            out["light.efficiency"] = white.efficiency(without_diffuser(self.display), MANY, self.seed)
        return out

    def crosstalk(self, result):
        lines, above = self.sight(8 * MANY, True), self.eye - self.display.paraxial.rear
        apart = 0.5 * BETWEEN_EYES_MM / above > 0.5 * self.stretch * self.display.cell.width[0] / self.display.gap
        sides = {f"between_eyes.{name}_eye_percent": None if apart else crosstalk.eye_percent(lines, self.eye, side, BETWEEN_EYES_MM)
                 for name, side in (("left", -1), ("right", 1))}
        return {"between_views.woods_percent": crosstalk.middle_view_percent(lines, self.eye), **sides}

    def mtf(self, result):
        lines, d, out = self.sight(MANY, True), self.display, {}
        for k, m in enumerate(result["measurements"]):
            angle = math.radians(m["angle_deg"])
            z = m["depth_mm"] + d.vertex_plane - d.paraxial.rear
            step = d.panel.pixel_pitch_mm * (np.abs(lines.axes[0]).max() if d.strips else 1)  # from pixel to pixel
            greatest = 0.8 * d.gap / (step * max(abs(z), 1e-3 * self.eye))  # 0.6 is the limit of a pixel's image
            eye = [self.eye * math.sin(angle), 0.0, self.eye * math.cos(angle)]
            form = sure(sharpness.mtf50, lines, eye, m["depth_mm"], int(m["direction"] == "vertical"), greatest)
            form = UNSURE if form and form != UNSURE and form[1] > LOOSE * form[0] else form
            out[f"measurements.{k}.mtf50_per_mm.green"] = form
            lens = (eye[2] - d.vertex_plane) / (2 * d.cell.width[int(m["direction"] == "vertical")] * (eye[2] - d.vertex_plane - m["depth_mm"]))
            pixel = d.gap / (2 * step * max(abs(z), 1e-300))
            out[f"measurements.{k}.resolution_per_mm"] = least(form, min(lens, pixel))
        return out

    def spot(self, result):
        d, out = self.display, {}
        fans = [("meridional", one_lens.fan(d, 0)), ("sagittal", one_lens.fan(d, 1))]
        for k, spot in enumerate(result["spots"]):
            if spot["field"] == "axis" and spot["depth_mm"] is not None:
                z = spot["depth_mm"] + d.vertex_plane - d.paraxial.rear
                for name, rays in fans:
                    width = one_lens.width_over_depth(rays, 1 / z) * abs(z)
                    out[f"spots.{k}.{name}_width_mm"] = width, 1e-5 * width + 1e-9
        return out


def sure(form, *arguments):
    try:
        return form(*arguments)
    except Unsure:
        return UNSURE


def pair(form, *arguments):
    """Forms of two ends: neither is defined where one of them is not."""
    ends = sure(form, *arguments)
    return [UNSURE, UNSURE] if ends == UNSURE else list(ends)
