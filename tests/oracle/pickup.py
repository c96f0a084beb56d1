"""Nodal pick-up: which lens owns a panel point, and the line along which that lens shows it. Paraxial, lengths in mm, frame of the display."""
import math
from types import SimpleNamespace

import numpy as np

from display import elemental_stretch, turned_by
from lattice import Lattice


def pixel_centres(d, columns, rows):
    """Centres (n, 2) of panel pixels; columns and rows (n,) from the top left."""
    (width, height), a = d.panel.pixels, d.panel.pixel_pitch_mm
    return np.column_stack([(columns + 0.5 - width / 2) * a, (height / 2 - rows - 0.5) * a])


def subpixel_points(d, channel, columns, rows):
    """(centres (n, 2) of what a channel of these pixels shines from, whether there is such a thing): content is made for them."""
    (width, height), a = d.panel.pixels, d.panel.pixel_pitch_mm
    at, shows = d.subpixels.centroids(channel, columns, rows)
    return (at - [width / 2, height / 2]) * [a, -a], shows


def nodal_lines(d, points):
    """The lines of panel points (n, 2), for the viewer at content.viewing_distance_mm.

    Returns lens (n, 2), owned (n,) (a lens of the array has the point), start (n, 3) on the rear principal plane and slope (n, 2), dx/dz and dy/dz.
    A point belongs to the lens whose cell, scaled to the elemental images' pitch, holds it.
    """
    lattice, stretch = Lattice(d), elemental_stretch(d)
    flat = np.column_stack([points, np.zeros(len(points))])
    i, j, owned = lattice.cell(lattice.enter(flat / stretch, flat)[0])
    centre = lattice.leave(lattice.axis(i, j), flat)[0][:, :2]
    if d.strips:
        start, slope = _across_strips(d, points, centre)
    else:
        start, slope = centre, (centre - points) / d.gap
    return SimpleNamespace(lens=np.column_stack([i, j]), owned=owned, start=np.column_stack([start, np.full(len(points), d.paraxial.rear)]), slope=slope)


def _across_strips(d, points, centre):
    """(start, slope) for strips: across them through the nodal lines, along them straight through plates to the eye line y = 0, z = D."""
    turn, distance, rear, top = turned_by(d), d.content.viewing_distance_mm, d.paraxial.rear, d.vertex_plane
    axes = np.array([[math.cos(turn), math.sin(turn)], [-math.sin(turn), math.cos(turn)]])  # rows: x' and y', here about the panel's centre
    at, middle = points @ axes.T, (centre @ axes.T)[:, 0]
    slope_across = (middle - at[:, 0]) / d.gap
    to_top = reduced_height(d)  # of the viewer-side vertex
    if math.isinf(distance):
        slope_along = -math.tan(turn) * slope_across
    else:
        eye_along = -math.tan(turn) * (middle + slope_across * (distance - rear))  # y' where the plane of the light meets the eye line
        slope_along = (eye_along - at[:, 1]) / (to_top + distance - top)
    along = at[:, 1] + slope_along * (to_top - top + rear)  # the line through the eye, at the rear principal plane
    return np.column_stack([middle, along]) @ axes, np.column_stack([slope_across, slope_along]) @ axes


def reduced_height(d):
    """Sum of thickness / index along a lens's axis from the panel to the viewer-side vertex: layers, air, glass."""
    media = list(d.layers)
    if d.ideal:
        media.append((d.lens_z - d.layer_top, 1.0))
    else:
        media.append((d.surfaces[0].z - d.layer_top, 1.0))
        media += [(b.z - a.z, a.n_above) for a, b in zip(d.surfaces, d.surfaces[1:])]
    return sum(thickness / index for thickness, index in media)
