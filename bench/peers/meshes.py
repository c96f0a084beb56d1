"""Lenses of triangles: how far rays in Cycles and Mitsuba end from those through the true surfaces, against the number of triangles.

The panel shows addresses: a difference is counted in whole panel pixels. Its mean over many rays is that of the true shift, as a ray shifted by a tenth of
a pixel crosses a border in a tenth of all cases.
"""
import numpy as np

import programs
from programs import NAMES, failed_row, going_on, say
from scenes import Exported, Scene, Truth, address, address_panel, described

FAR = 40  # panel pixels, half an elemental image: such rays took another path through the lens, and are counted separately


def shift(found, exact, where):
    """Mean shift along rows and columns in panel pixels, share within one pixel, share that ended far off."""
    both = where & (found.max(axis=2) > 0) & (exact.max(axis=2) > 0)
    off = np.abs(address(found) - address(exact))
    astray = off.max(axis=0) > FAR
    counted = both & ~astray
    return {"mean_shift": float(off[:, counted].mean()), "within_one": float((off.max(axis=0) <= 1)[both].mean()),
            "same": float((off.max(axis=0) == 0)[both].mean()), "astray": float(astray[both].mean()),
            "lit_in_one_alone": float(((found.max(axis=2) > 0) != (exact.max(axis=2) > 0))[where].mean())}


def order(rows):
    """The exponent q of the law N^-q between the fewest and the most triangles."""
    first, last = rows[0], rows[-1]
    if first is last:
        return None
    return float(np.log(first["mean_shift"] / last["mean_shift"]) / np.log(last["triangles"] / first["triangles"]))


def measure(program, folder, size, peers, counts, degrees=15, name="desktop-spherical"):
    description = described(name, size, degrees, render={"fresnel": "none"})
    scene = Scene(program, folder / "meshes", description, address_panel(description))
    exact, _ = scene.lfdsim("--estimator", "point")
    where = Truth(description).away
    found = {"display": name, "degrees": degrees, "size": list(size), "versions": {p: programs.version(p) for p in peers},
             "counts": len(counts), "rows": [], "orders": []}
    shown = {peer: [] for peer in peers}
    for normals in ("flat", "smooth"):
        mine = []
        for triangles in counts:
            picture, facts = scene.lfdsim("--lens-mesh", triangles, "--lens-normals", normals)
            made = facts["lens_mesh"]["triangles"]
            mine.append((picture, {"peer": "lfdsim", "normals": normals, "triangles": made, **shift(picture, exact, where)}))
        found["rows"] += [row for _, row in mine]
        found["orders"].append({"peer": "lfdsim", "normals": normals, "q": order([row for _, row in mine])})
        for peer in peers:
            if peer in programs.failed:
                continue
            with going_on(peer):
                rows = []
                for triangles, (own, same) in zip(counts, mine):
                    picture, ran = Exported(scene, peer, "--triangles", str(triangles), "--normals", normals).render()
                    against = shift(picture, own, where)
                    if triangles == counts[min(1, len(counts) - 1)]:
                        shown[peer].append(colored(picture, exact, where))
                    rows.append({"peer": peer, "normals": normals, "triangles": same["triangles"], **shift(picture, exact, where),
                                 "same_as_lfdsim_meshed": against["same"], "mean_shift_from_lfdsim_meshed": against["mean_shift"], "within_one_of_lfdsim_meshed": against["within_one"],
                                 "wall_s": ran.wall, "processor_s": ran.processor})
                    row = rows[-1]
                    say(f"{NAMES[peer]}, {row['triangles']} triangles, {normals}: mean shift {row['mean_shift']:.4f} panel pixels ({same['mean_shift']:.4f} of lfdsim's own "
                        f"mesh), {100 * row['within_one']:.2f} % within one; the panel pixel of lfdsim's mesh in {100 * against['same']:.2f} %")
                found["rows"] += rows
                found["orders"].append({"peer": peer, "normals": normals, "q": order(rows)})
    for one in found["orders"]:
        say(f"order of convergence, {NAMES.get(one['peer'], 'lfdsim')}, {one['normals']}: " + ("-" if one["q"] is None else f"N^-{one['q']:.2f}"))
    found["pictured"] = next((peer for peer in peers if peer not in programs.failed), None)
    return found, shown.get(found["pictured"], [])


def colored(found, exact, away):
    """Where the rays of a mesh land, in the colours of text()'s last lines."""
    lit, of_exact = found.max(axis=2) > 0, exact.max(axis=2) > 0
    off = np.where(lit & of_exact, np.abs(address(found) - address(exact)).max(axis=0), 0)
    shown = (0.55 + 0.4 * away[:, :, None]) * np.ones(3)
    for where, color in ((off == 1, (0.1, 0.35, 0.9)), (off > 1, (0.9, 0.05, 0.05)), (lit != of_exact, (0.1, 0.7, 0.2))):
        shown[where] = color
    shown[~away & ((off > 0) | (lit != of_exact))] = (0.9, 0.75, 0.1)
    return shown


def text(found, image, failed):
    lines = ["### Cycles and Mitsuba: lenses of triangles", "",
             f"{', '.join(found['versions'].values())}; {found['display']} from {found['degrees']}°, {found['size'][0]} x {found['size'][1]} pixels, one ray "
             "each, away from lens edges as above. *Mean shift*: how far rays land on the panel from where the true surfaces send them, along rows or columns. "
             "lfdsim is `render --lens-mesh`. Flat triangles should err by N^-1/2 and smooth ones by N^-1.", "",
             "| program | normals | triangles a lens | mean shift, panel pixels | within one panel pixel | panel pixel of lfdsim's mesh, within one | mean shift from there | order |",
             "|---|---|---|---|---|---|---|---|"]
    orders = {(one["peer"], one["normals"]): one["q"] for one in found["orders"]}
    for row in found["rows"]:
        q = orders[row["peer"], row["normals"]]
        same = " | "
        if "same_as_lfdsim_meshed" in row:
            same = f"{100 * row['same_as_lfdsim_meshed']:.2f} %, {100 * row['within_one_of_lfdsim_meshed']:.2f} % | {row['mean_shift_from_lfdsim_meshed']:.4f}"
        lines.append(f"| {NAMES.get(row['peer'], 'lfdsim')} | {row['normals']} | {row['triangles']} | {row['mean_shift']:.4f} | {100 * row['within_one']:.2f} % | {same} | "
                     + ("" if q is None else f"N^-{q:.2f}") + " |")
    lines += [failed_row(peer, why, 8) for peer, why in failed.items() if peer in found["versions"]]
    if not found["pictured"]:
        return lines
    lines += ["", "The shift from lfdsim's picture of the same triangles is the renderer's own: both follow rays in single precision over the whole distance from "
              "the camera. Where it is as large as the shift from the true surfaces, more triangles do not help, and the order ends there.", "",
              f"![Where rays land]({image})", "",
              f"{NAMES[found['pictured']]}, {found['rows'][min(1, found['counts'] - 1)]['triangles']} triangles a lens, flat (left) and smooth. Blue: one panel pixel off, "
              "as rays near a border of panel pixels are. Red: more than one, where the normals of flat triangles are far off. Green: lit in only one of the pictures (rims are "
              "polygons; total internal reflection). Yellow: any of these next to a lens edge. Darker is near lens edges."]
    return lines
