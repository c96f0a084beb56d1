"""Which figures of `lfdsim check` and `lfdsim analyze` are held against which form, and what the program is told to measure for them."""
import math

import field_of_view
import one_lens
import paraxial
import viewing_zone
import white
from edges import Unsure
from sight import Sight
from table import UNSURE

LINES = 512  # of sight in each set; many for shares of 1 %
MANY = 2048


class Forms:
    """All forms of a drawn display, worked out when asked for. Each method gives {path in the result: form, or a list of forms}."""

    def __init__(self, display, description, seed):
        self.display, self.description, self.seed = display, description, seed
        self.viewing = description["content"]["viewing_distance_mm"]
        self.eye = description["camera"]["position_mm"][2]
        stretch = 1 + display.paraxial.front / (self.viewing - display.paraxial.rear)
        self.hint = math.degrees(math.atan(stretch * display.array.pitch_mm / (2 * display.paraxial.front)))

    def sight(self, lines, with_diffuser):
        return Sight(self.display, self.viewing, lines, self.seed, with_diffuser)

    def check(self):
        return {f"theory.{path}": form for path, form in paraxial.forms(self.display, self.description).items()}

    def fov(self):
        bare, out = self.sight(LINES, False), {}
        for axis, name in enumerate(("horizontal", "vertical")):
            out[f"{name}.own_lens_deg"] = pair(field_of_view.own_lens_deg, bare, axis, self.eye, self.hint)
        out["eyebox_mm"] = [sure(field_of_view.eyebox_mm, bare, axis, self.eye, self.hint) for axis in (0, 1)]
        if self.display.diffuser:
            spread = self.sight(LINES, True)
            for axis, name in enumerate(("horizontal", "vertical")):
                out[f"{name}.own_lens_with_diffuser_deg"] = pair(field_of_view.own_lens_deg, spread, axis, self.eye, self.hint)
        return out

    def dof(self):
        rays = one_lens.fan(self.display)
        most = self.display.panel.pixel_pitch_mm / self.display.paraxial.front
        ends = one_lens.sharp_range(rays, most) if len(rays[0]) else None
        return {"spot_diopters": [None, None] if ends is None else [(1000 * u, 1e-6 * 1000 * (ends[1] - ends[0])) for u in ends]}

    def zone(self):
        lines, out = self.sight(MANY, True), {}
        for axis, name in enumerate(("horizontal", "vertical")):
            for percent in (1, 50):
                out[f"{name}.wrong_{percent}_percent_deg"] = pair(viewing_zone.zone_deg, lines, axis, self.eye, percent / 100, self.hint)
        return out

    def uniformity(self):
        return {"screen.luminance_over_panel": white.luminance(self.sight(MANY, True), [0.0, 0.0, self.eye])}


def sure(form, *arguments):
    try:
        return form(*arguments)
    except Unsure:
        return UNSURE


def pair(form, *arguments):
    """Forms of two ends: neither is defined where one of them is not."""
    ends = sure(form, *arguments)
    return [UNSURE, UNSURE] if ends == UNSURE else list(ends)
