#!/usr/bin/python3
"""This folder's tracer against itself and against closed forms: self_check.py [NAME_PART]. Prints what passed and failed; exit code 1 if any failed."""
import sys

import check_arrays as arrays
import check_colour as colour
import check_errors as errors
import check_light as light
import check_paraxial as paraxial
from check_tools import ASPHERE, FACING, IDEAL, LATTICES, LAYERS, LENS, PINHOLE


def checks():
    """(name, check) pairs; a check returns (good, what was found)."""
    yield "descriptions are written in plain numbers", arrays.written
    yield "hexagons and bricks stand where they should", arrays.neighbours
    yield "a stop's hole reaches beyond its brick", arrays.stop_beyond_the_cell
    yield "slant is a clockwise turn", arrays.slant
    yield "a cylindrical lens by hand, skew rays", light.cylinder
    yield "two halves of a layer", light.halved_layer
    yield "parallel plates by hand", light.parallel_plates
    yield "glued faces at normal incidence", light.glued_loses_nothing
    yield "total internal reflection over layers", light.total_reflection
    yield "a gap given instead of a base", paraxial.gap_given
    yield "strips for a viewer far away", paraxial.picked_up_far
    yield "the exact field", paraxial.exact_fields
    for label, lens, base in (("plano-convex, glued", LENS, 2.2), ("panel facing, in air", FACING, 7.0), ("ideal", IDEAL, 7.0)):
        yield f"strips, {label}: nodal pick-up through glass", lambda z=lens, b=base: paraxial.picked_up_through_glass(z, b)
    for name in LATTICES:
        yield f"{name}: cells", lambda n=name: arrays.cells(n)
        yield f"{name}: the least count", lambda n=name: arrays.counts(n)
        yield f"{name}: a pinhole is an ideal lens without power", lambda n=name: arrays.pinhole_as_ideal(n)
        yield f"{name}: ideal lenses by hand", lambda n=name: arrays.ideal_by_hand(n)
        yield f"{name}: nodal pick-up of rays from the eye", lambda n=name: paraxial.picked_up(n, 400.0)
        yield f"{name}: owners of panel points", lambda n=name: paraxial.picked_up_owner(n)
        for surround in ("opaque", "clear", "plate"):
            yield f"{name}, {surround}: energy", lambda n=name, s=surround: light.energy(n, s)
            yield f"{name}, {surround}: a layer of air", lambda n=name, s=surround: light.layer_of_air(n, ASPHERE, s)
        for aperture in ("circle", "cell"):
            yield f"{name}, {aperture}: glued onto a layer of its own glass", lambda n=name, a=aperture: light.glued_of_one_glass(n, a)
            for surround in ("opaque", "clear", "plate"):
                yield f"{name}, {surround}, {aperture}: all turned", lambda n=name, s=surround, a=aperture: arrays.turn_of_everything(n, LENS, s, a)
            for surround in ("clear", "plate"):
                yield f"{name}, {surround}, {aperture}: lenses of index 1", lambda n=name, s=surround, a=aperture: light.invisible(n, s, a)
                for lens, label in ((LENS, ""), (FACING, ", panel facing")):
                    yield f"{name}, {surround}, {aperture}{label}: bodies", lambda n=name, z=lens, s=surround, a=aperture: light.bodies(n, z, s, a)
    for surround in ("opaque", "clear", "plate"):
        for aperture in ("circle", "cell"):
            yield f"strips along themselves, {surround}, {aperture}", lambda s=surround, a=aperture: arrays.along_strips(s, a)
            yield f"one row of bricks, {surround}, {aperture}", lambda s=surround, a=aperture: arrays.one_row(s, a)
            yield f"hexagons by a sixth of a turn, {surround}, {aperture}", lambda s=surround, a=aperture: arrays.sixth_of_a_turn(FACING if s == "opaque" else LENS, s, a)
    yield "glasses: n_d and V_d", colour.glasses
    yield "wavelengths: Gauss-Hermite sums", colour.quadrature
    yield "glasses of constant index", colour.one_colour
    yield "glasses: each channel alone", colour.each_alone
    yield "glasses: a gap is green's", colour.gap_of_green
    yield "subpixels, rgb_rows: drawn", colour.rows_drawn
    for label, (lens, radii, thickness) in colour.LENSES.items():
        for glass in ("PMMA", colour.VIVID):
            yield f"glasses, {label}: focal lengths", lambda z=lens, r=radii, t=thickness, g=glass: colour.lensmaker(z, r, t, g)
    for kind in colour.PICTURES:
        yield f"subpixels, {kind}: drawn", lambda k=kind: colour.drawn(k)
    for kind in ("rgb_stripe", "bgr_stripe", "rgb_rows", "delta", "swapped"):
        yield f"subpixels, {kind}: made for the eye that sees them", lambda k=kind: colour.made_for_eyes(k)
    for kind in colour.KINDS:
        yield f"subpixels, {kind}: shrunk in place", lambda k=kind: colour.shrunk_in_place(k)
        for q in (1.0, 0.5):
            yield f"subpixels, {kind}, q {q}: white", lambda k=kind, q=q: colour.white(k, q)
            yield f"subpixels, {kind}, q {q}: white behind lenses", lambda k=kind, q=q: colour.behind_lenses(k, q)
            yield f"subpixels, {kind}, q {q}: centroids", lambda k=kind, q=q: colour.centroids(k, q)
            if kind != "none":
                yield f"subpixels, {kind}, q {q}: by brute force", lambda k=kind, q=q: colour.by_brute_force(k, q)
    glued = {"layers": LAYERS, "base_z_mm": 2.2}
    for label, lens in (("plano-convex", LENS), ("panel facing", FACING), ("asphere", ASPHERE), ("ideal", IDEAL), ("pinhole", PINHOLE)):
        for where, given in (("in air", {}), ("over layers", {"layers": LAYERS}), ("on layers", glued), ("on the panel", {"base_z_mm": 0.0})):
            yield f"{label}, {where}: paraxial rays", lambda z=lens, g=given: paraxial.paraxial_rays(z, g)
    yield from of_errors()


def of_errors():
    yield "errors: decentred lenses", errors.decentred
    yield "errors: image depths", errors.refocused
    yield "errors: a stop's holes", errors.holes
    yield "errors: refused", errors.refused
    for lens in (LENS, FACING, ASPHERE, IDEAL):
        for strips in (False, True):
            yield f"errors: one lens turned, {lens['type']}, strips {strips}", lambda z=lens, s=strips: errors.one_lens_turned(z, s)
    for name in LATTICES:
        yield f"errors, {name}: vertices", lambda n=name: errors.vertices(n)
        for surround in ("opaque", "plate"):
            yield f"errors, {name}, {surround}: wedged", lambda n=name, s=surround: errors.wedged(n, s, LENS)
            for lens in (LENS, FACING, ASPHERE, IDEAL):
                yield f"errors, {name}, {surround}: all moved, {lens['type']}", lambda n=name, s=surround, z=lens: errors.all_moved(n, s, z)
            for aperture in ("circle", "cell"):
                yield f"errors, {name}, {surround}, {aperture}: as described", lambda n=name, s=surround, a=aperture: errors.as_described(n, s, a)
                yield f"errors, {name}, {surround}, {aperture}: every lens searched", lambda n=name, s=surround, a=aperture: errors.every_lens_searched(n, LENS, a, s)
        for aperture in ("circle", "cell"):
            for lens in (LENS, FACING, ASPHERE, IDEAL, PINHOLE):
                yield f"errors, {name}, {aperture}: lens by lens, {lens['type']}", lambda n=name, a=aperture, z=lens: errors.lens_by_lens(n, z, a)
            for lens in (LENS, FACING, errors.BICONVEX):
                yield f"errors, {name}, {aperture}: bodies, {lens['type']}", lambda n=name, a=aperture, z=lens: errors.bodies(n, z, a)
    for name, text in errors.titles().items():
        yield f"errors, none: {name}", lambda t=text: errors.none_at_all(t)


def main():
    passed = failed = 0
    for name, check in checks():
        if all(part in name for part in sys.argv[1:]):
            good, found = check()
            if not good:
                print(f"FAIL  {name}: {found}")
            passed, failed = passed + bool(good), failed + (not good)
    print(f"{passed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
