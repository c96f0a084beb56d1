"""Which figures of `lfdsim check` and `lfdsim analyze` are held against which form, and what the program is told to measure for them."""
import functools
import math

import numpy as np

import colours
import crosstalk
import field_of_view
import moire
import one_lens
import oracle
import paraxial
import sharpness
import viewing_zone
import white
from edges import Unsure, error_of
from sight import SETS, Sight, without_diffuser
from table import UNSURE

LINES = 128   # of sight in each set
MANY = 512    # for shares of 1 %, means and spreads
BETWEEN_EYES_MM = 65.0
LOOSE = 0.05  # of a frequency: a form that knows it no better does not tell
SCREEN_LINES = 1 << 16  # of sight in each set, all parts of the screen together, for colours
COLOUR_UNSURE = 0.002   # in u', v': a form that knows a distance no better does not tell
LIT, MORE = 64, 16      # of a colour's lines of sight in each set so many should meet light: a narrow stop and small subpixels ask for up to so many times more
VISIBLE = 0.01          # contrast: a wave of less need not be found


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
        in_rows = display.array.lattice in ("square", "rectangle")
        self.one_lens = in_rows and not display.layers and not display.glued  # one_lens.py knows it
        self.coloured, self.dispersing = colours.has_colours(display), len(display.colours) > 1
        self.structured = display.panel.subpixels != "none" or display.panel.aperture_ratio < 1
        power = 1 / display.paraxial.f - 1 / display.gap
        self.central_depth = 1 / power if power else math.inf
        self.hint = np.degrees(np.arctan(stretch * display.cell.width / (2 * display.gap)))  # along x' and y'

    def takes(self, measure):
        """Whether there are forms for it: pinholes image nothing, one_lens.py knows rows of lenses in air."""
        if self.display.errors:  # of the array: the forms below of how rays and content meet, not those of one perfect lens
            return measure in ("fov", "zone", "crosstalk", "uniformity")
        if measure == "dof":
            return self.display.lens.type != "pinhole" and self.one_lens
        if measure == "spot":
            return self.display.lens.type != "pinhole" and (self.one_lens or self.dispersing)
        if measure == "moire":
            return self.structured
        return not (measure == "mtf" and self.display.lens.type == "pinhole")

    def sight(self, lines, with_diffuser):
        return Sight(self.display, self.viewing, lines, self.seed, with_diffuser)

    def lit_sight(self, lines, with_diffuser):
        """More lines where few get through."""
        sight = self.sight(lines, with_diffuser)
        share = (sight.see(np.array([0.0, 0.0, self.eye])).weight > 0).mean()
        return sight if share * lines >= LIT / 2 else self.sight(int(lines * min(LIT / 2 / (lines * max(share, 1e-9)), MORE)), with_diffuser)

    def check(self, result):
        if self.display.errors:
            return {}
        return paraxial.forms(self.display, self.description)

    def fov(self, result):
        bare, out = self.lit_sight(LINES, False), {}
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
        sight = self.lit_sight(LINES, True)
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
        if self.display.errors:
            return out
        middle = Sight(self.display, self.viewing, 8 * MANY, self.seed, True, middle_half=True)
        for axis, name in self.named_axes():
            out[f"bands.{name}_contrast"] = white.band_contrast(middle, eye, axis)
        if self.one_lens:
            out["light.efficiency"] = white.efficiency(without_diffuser(self.display), MANY, self.seed)
        if self.coloured:
            out |= self.colour_of_white(result["colour"])
        return out

    def lenses_of_blocks(self):
        """(first lens, number), across and up: of those that cover the panel, in the array's middle."""
        lenses, cover = self.sight(1, False).lenses, oracle.covering_count(self.description)
        if self.display.strips:
            cover[1] = lenses[1]
        beside = np.maximum(lenses - cover, 0) // 2
        return beside, lenses - 2 * beside

    def colour_of_white(self, told):
        """Of blocks of the screen, and of the middle one from angles: how far their colours are from that of all of them."""
        d, out = self.display, {}
        (beside, count), share = self.lenses_of_blocks(), 1 / max(sum(shares.any() for shares, _ in d.colours), 1)

        def add(name, first, number, weights, eye):
            parts = len(weights)
            each = max(int(SCREEN_LINES * share) // parts, 8)  # of each set
            blocks = [np.repeat(v, each, axis=0) for v in (first, number)]
            sight = Sight(d, self.viewing, parts * each, self.seed, True, blocks=blocks)
            light, on = colours.light_of_parts(sight, eye if np.ndim(eye) == 1 else np.tile(np.repeat(eye, each, axis=0), (SETS, 1)), parts)
            if name == "screen":
                light, weights = light[:, :, on >= colours.ON_SCREEN], (weights * on)[on >= colours.ON_SCREEN]
            for figure, form in colours.distances(light, weights).items():
                out[f"colour.{name}_delta_uv_{figure}"] = UNSURE if form and not form[1] <= COLOUR_UNSURE else form

        first, number = colours.blocks_of_screen(count)
        add("screen", beside + first, number, number.prod(axis=1).astype(float), np.array([0.0, 0.0, self.eye]))
        across = d.panel.pixel_pitch_mm * (np.abs(oracle.Lattice(d).turn[0, 0]) if d.strips else 1)
        each_side = min(max(math.ceil(4 * d.cell.width[0] / across - 1e-9), 16), 128)
        angles = np.radians(np.linspace(*told["angle_deg"], 2 * each_side + 1))
        first, number = colours.middle_block(count)
        block = [np.tile(v, (len(angles), 1)) for v in (beside + first, number)]
        for axis, name in ((0, "horizontal"), (1, "vertical")):
            eyes = np.zeros((len(angles), 3))
            eyes[:, axis], eyes[:, 2] = self.eye * np.sin(angles), self.eye * np.cos(angles)
            add(name, *block, np.ones(len(angles)), eyes)
        return out

    def crosstalk(self, result):
        seen, told = crosstalk.Seen(self.sight(8 * MANY, True), self.eye), result["between_views"]
        above, images = self.eye - self.display.paraxial.rear, self.stretch * self.display.cell.width[0]
        if self.display.strips:
            images /= abs(oracle.Lattice(self.display).turn[0, 0])
        apart = 0.5 * BETWEEN_EYES_MM / above > 0.5 * images / self.display.gap
        samplings = {"": crosstalk.SUBPIXEL, "other_sampling.": crosstalk.PIXEL} if self.display.panel.subpixels != "none" else {"": crosstalk.PIXEL}
        out = {}
        for prefix, sampling in samplings.items():
            out[f"between_views.{prefix}woods_percent"] = seen.view_percent(told["innermost_view"], sampling) if told["whole_views"] else None
            for name, side in (("left", -1), ("right", 1)):
                if not (apart and prefix):
                    out[f"between_eyes.{prefix}{name}_eye_percent"] = None if apart else seen.eye_percent(side, BETWEEN_EYES_MM, sampling)
        if told["whole_views"]:
            out["between_views.worst_view_percent"] = seen.view_percent(told["worst_view"], samplings[""])
        return out

    def mtf(self, result):
        d, out = self.display, {}
        wavelengths = max(d.render.wavelength_samples if self.dispersing else 1, 1)
        number = 4 * MANY // wavelengths if self.coloured or self.structured else MANY
        trial = colours.White(self.sight(LINES, True), np.array([0.0, 0.0, self.eye]))
        lit = min(sum((light > 0).mean() for light, _, _ in trial.shining(c)) for c in ((0, 1, 2) if self.coloured else (1,)))
        lines = self.sight(int(number * min(max(LIT / (number * max(lit, 1e-9)), 1), MORE)), True)
        narrow = (d.subpixels.high - d.subpixels.low).min(axis=0)  # the narrowest rectangle along x and y, in pixels

        @functools.cache
        def white(angle):
            eye = np.array([self.eye * math.sin(angle), 0.0, self.eye * math.cos(angle)])
            return eye, colours.White(lines, eye)

        for k, m in enumerate(result["measurements"]):
            eye, seen = white(math.radians(m["angle_deg"]))
            axis, path = int(m["direction"] == "vertical"), f"measurements.{k}"
            z = m["depth_mm"] + d.vertex_plane - d.paraxial.rear
            step = d.panel.pixel_pitch_mm * (np.abs(lines.axes[0]).max() if d.strips else 1)  # from pixel to pixel
            finest = step * (narrow.min() if d.strips else narrow[axis])
            greatest = 0.8 * d.gap / (finest * max(abs(z), 1e-3 * self.eye))  # 0.6 is the limit of a pixel's image
            spreads = [sharpness.differences(lines, seen, eye, m["depth_mm"], c) for c in ((0, 1, 2) if self.coloured else (1,))]
            named = {"green": spreads[0]}
            if self.coloured:
                named = {"red": spreads[0], "green": spreads[1], "blue": spreads[2], "luminance": sharpness.together(spreads)}
            forms = {name: sure(sharpness.mtf50, lines, spread, eye, m["depth_mm"], axis, greatest) for name, spread in named.items()}
            forms = {name: UNSURE if form and form != UNSURE and not form[1] <= LOOSE * form[0] else form for name, form in forms.items()}
            out |= {f"{path}.mtf50_per_mm.{name}": form for name, form in forms.items()}
            lens = self.lens_limit(m["depth_mm"], eye[2], axis)
            pixel = d.gap / (2 * step * max(abs(z), 1e-300))
            out[f"{path}.resolution_per_mm"] = least(forms["luminance" if self.coloured else "green"], min(lens, pixel))
            if self.coloured and forms["luminance"] != UNSURE:
                for name in ("red", "blue"):
                    out[f"{path}.colour.from_green_mm.{name}"] = *sharpness.from_green(named[name], named["green"], axis), step * abs(z) / d.gap
        return out

    def lens_limit(self, depth, eye, axis):
        """Cycles per mm at a depth from the vertices: half a cycle per jump p |1 - z/L| from lens to lens; where the eye sees less than a pixel through
        a lens, per projected pitch."""
        d, p = self.display, self.display.cell.width[axis]
        dioptres, z, away = 1 / d.paraxial.f - 1 / d.gap, depth + d.vertex_plane - d.paraxial.rear, eye - d.vertex_plane
        seen = d.clear_aperture[axis] * d.gap * abs(1 / (eye - d.paraxial.rear) - dioptres)
        if d.lens.type == "pinhole" or seen < d.panel.pixel_pitch_mm:
            return away / (2 * p * (away - depth))
        return 1 / max(2 * p * abs(1 - z * dioptres), 1e-300)

    def spot(self, result):
        d, out = self.display, {}
        fans = [("meridional", one_lens.fan(d, 0)), ("sagittal", one_lens.fan(d, 1))] if self.one_lens else []
        for k, spot in enumerate(result["spots"]):
            if spot["field"] == "axis" and spot["depth_mm"] is not None:
                z = spot["depth_mm"] + d.vertex_plane - d.paraxial.rear
                for name, rays in fans:
                    width = one_lens.width_over_depth(rays, 1 / z) * abs(z)
                    out[f"spots.{k}.{name}_width_mm"] = width, 1e-5 * width + 1e-9
        return out | (self.colour_of_lens(result) if self.dispersing else {})

    def colour_of_lens(self, result):
        """Where red, green and blue come together, and how far apart they are at green's central depth plane."""
        d, out = self.display, {}
        planes = [depth + at.paraxial.rear for at, (_, depth) in zip(d.primaries, oracle.focus(d))]
        exact = [paraxial.ROUNDING * depth**2 / f for f, depth in oracle.focus(d)]
        out["colour.axial_mm"] = planes[0] - planes[2], exact[0] + exact[2]
        if not self.one_lens or not math.isfinite(planes[1]) or exact[1] > 1e-3 * abs(planes[1]):  # too far away to be known to the millimetre
            return out
        for k, field in enumerate(result["colour"]["lateral"]):
            half = d.array.pitch_mm / 2
            start = half * {"axis": (0, 0), "half": (0.5, 0), "edge": (1, 0), "corner": (1, 1)}[field["field"]]
            red, green, blue = (one_lens.centroids(at, start, planes[1]) for at in d.primaries)
            pixel = d.panel.pixel_pitch_mm * abs(self.central_depth) / d.gap
            for name, other in (("red", red), ("blue", blue)):
                apart = None if other is None or green is None else np.hypot(*(other - green).T)
                out[f"colour.lateral.{k}.{name}_mm"] = apart if apart is None else (apart.mean(), error_of(apart) + 1e-9, pixel)
        return out

    def moire(self, result):
        screen, out = moire.Screen(self.display, self.eye, result["window_mm"], self.seed), {}
        for name, weights in screen.patterns(self.coloured).items():
            out |= {f"{name}.{figure}": form for figure, form in moire_of(screen, weights, functools.reduce(dict.get, name.split("."), result)).items()}
        return out


def moire_of(screen, weights, told):
    """Forms of what is told of a pattern: of the wave that is seen best or, where several may be within the errors, of that which is told."""
    claim = told["period_mm"] and [wave_vector(told["period_mm"], told["direction_deg"])]
    waves = screen.waves(weights, claim or ())
    best = max(waves, key=lambda wave: wave.seen, default=None)
    if best is None or best.seen < moire.HEARD * best.seen_error or best.frequency_error * best.period > LOOSE:
        return dict.fromkeys(("period_mm", "direction_deg", "contrast", "contrast_unfiltered"), UNSURE)
    if not claim:
        visible = None if best.seen < VISIBLE else (best.period, best.frequency_error * best.period**2)
        return {"period_mm": visible, "contrast": (best.seen, best.seen_error)}
    near = [wave for wave in waves if min(np.hypot(*((wave.frequency - s * claim[0]) * screen.window)) for s in (-1, 1)) < 1]
    if not near and told["contrast_unfiltered"] < screen.least(weights):
        return dict.fromkeys(("period_mm", "direction_deg", "contrast", "contrast_unfiltered"), UNSURE)
    tied = [wave for wave in waves if wave.seen + 3 * math.hypot(wave.seen_error, best.seen_error) + told["contrast_error"] >= best.seen]
    wave = min(tied, key=lambda wave: min(np.hypot(*(wave.frequency - s * claim[0])) for s in (-1, 1)))
    turn = wave.direction + 180 * round((told["direction_deg"] - wave.direction) / 180)
    return {"period_mm": (wave.period, wave.frequency_error * wave.period**2), "direction_deg": (turn, math.degrees(wave.frequency_error * wave.period)),
            "contrast": (wave.seen, wave.seen_error), "contrast_unfiltered": (wave.contrast, wave.contrast_error)}


def wave_vector(period, degrees):
    return np.array([math.cos(math.radians(degrees)), math.sin(math.radians(degrees))]) / period


def sure(form, *arguments):
    try:
        return form(*arguments)
    except Unsure:
        return UNSURE


def pair(form, *arguments):
    """Forms of two ends: neither is defined where one of them is not."""
    ends = sure(form, *arguments)
    return [UNSURE, UNSURE] if ends == UNSURE else list(ends)
