"""Random arguments: values of all kinds in all places, arrays of all kinds. An exception that names the argument, never a crash.

The seed is fixed; with LFDSIM_FULL=1 there are 30 times as many calls with another seed each time, which a failure tells.
"""

import math
import os
import random
import unittest
import warnings
from typing import Any

import numpy as np

import lfdsim
from lfdsim.arguments import KEYS
from tiny import TinyTest

FULL = "LFDSIM_FULL" in os.environ
SEED = random.SystemRandom().randrange(2**32) if FULL else 20
ROWS, COLUMNS = 48, 88  # of the panel
OTHER_NAMES = {
    "key": ["is unknown", "is not TOML", "é: "],
    "progress": [" argument"],
    "path": ["no such file"],
    "changes": ["is unknown"],
    "name": ["pattern"],
}
CORNERS = [(2.0, 2.0), (80.0, 2.0), (80.0, 40.0), (2.0, 40.0)]
ODD: list[Any] = [
    None, True, -1, 0, 1, 2**31, 2**63, 2**200, 0.5, -0.0, math.nan, math.inf, 1e308, "", "x", "none", "\x00", "\ud800", "é" * 300, b"x",
    (), [], {}, (1, 2), (1, 2, 3), [[1], 2], {"a": 1}, {"a": {"b": [{}]}}, object(), len, 2**5000, 1j, float, np.float32(1), np.int8(3),
    np.zeros(3), np.zeros((ROWS, COLUMNS, 3)), np.zeros((ROWS, COLUMNS, 3), np.uint8), np.zeros((2, 3, 4, 5)), np.zeros((4, 2)),
    np.array("x"), np.array(None), range(4), CORNERS,
]  # fmt: skip


def full_alpha(array: np.ndarray) -> int:
    """The least alpha of a pixel that hides all behind it."""
    return int(np.iinfo(array.dtype).max) if array.dtype.kind == "u" else 1


class Fuzz(TinyTest):
    def setUp(self) -> None:
        super().setUp()
        self.draw, self.outcomes = random.Random(SEED), {True: 0, False: 0}
        self.picture = np.random.default_rng(1).random((ROWS, COLUMNS, 3), np.float32)
        caught = warnings.catch_warnings()
        caught.__enter__()
        self.addCleanup(caught.__exit__, None, None, None)
        warnings.simplefilter("ignore")

    def attempt(self, name: str, what: str, call: Any) -> Any:
        """The result, or None if the call was refused in words that say what is wrong with the argument of this name."""
        try:
            result = call()
        except (TypeError, ValueError, MemoryError) as error:
            said = str(error)
            named = any(word in said for word in (name, KEYS.get(name, name), *OTHER_NAMES.get(name, [])))
            if not named or "incompatible function arguments" in said:
                raise AssertionError(f"seed {SEED}: {name} = {what}: {type(error).__name__}: {said}") from error
            self.outcomes[False] += 1
            return None
        except Exception as error:
            raise AssertionError(f"seed {SEED}: {name} = {what}: {type(error).__name__}: {error}") from error
        self.outcomes[True] += 1
        return result

    def tearDown(self) -> None:
        print(f"{self.outcomes[True]} calls were right, {self.outcomes[False]} were refused")
        self.assertGreater(min(self.outcomes.values()), 30)

    def test_values(self) -> None:
        d, picture = self.display, self.picture

        def rendered(name: str) -> Any:
            return lambda value: lfdsim.render(d, **{"crop": (0, 0, 1, 1), "size": (8, 8), name: value})

        calls = {
            "text": lfdsim.Display.parse,
            "path": lfdsim.Display.load,
            "changes": d.with_,
            "display": lfdsim.check,
            "a": lambda value: lfdsim.compare(value, picture),
            "b": lambda value: lfdsim.compare(picture, value),
            "encoding": lambda value: lfdsim.compare(picture, picture, encoding=value),
            "panel": lambda value: lfdsim.panel_codes(d, value),
            "picture": lfdsim.png,
            "measure": lambda value: lfdsim.analyze(d, value),
            "angles_deg": lambda value: lfdsim.analyze(d, "spot", angles_deg=value),
            "name": lambda value: lfdsim.pattern(d, value),
            "view": lambda value: lfdsim.pattern(d, "view", view=value),
            "depth_mm": lambda value: lfdsim.pattern(d, "edge", depth_mm=value),
            "cell_pixels": lambda value: lfdsim.pattern(d, "checkerboard", cell_pixels=value),
            "corners_px": lambda value: lfdsim.compare_photograph(picture, picture, value, CORNERS),
            "view_corners_px": lambda value: lfdsim.compare_photograph(picture, picture, CORNERS, value),
            "fit_blur": lambda value: lfdsim.compare_photograph(picture, picture, CORNERS, CORNERS, fit_blur=value),
            **{name: rendered(name) for name in [*KEYS, "crop", "threads", "device", "kernel", "model", "progress"]},
        }
        del calls["pickup"], calls["samples"]  # not of render(); 2^31 samples take their time
        for _ in range(1500 * (30 if FULL else 1)):
            name, value = self.draw.choice(list(calls)), self.draw.choice(ODD)
            self.attempt(name, f"{value!r:.80}", lambda: calls[name](value))

    def test_keys(self) -> None:
        keys: list[Any] = [*self.display.keys(), "lens", "diffuser", "panel.layer", "lens.surface.0.conic", ".", "a.b.c.d.e.f"]
        keys += [value for value in ODD if not isinstance(value, (dict, list, np.ndarray))]  # those that a dict can have
        for _ in range(1500 * (30 if FULL else 1)):
            key, value = self.draw.choice(keys), self.draw.choice(ODD)
            name = key if isinstance(key, str) and key.isprintable() and 0 < len(key) < 99 else "key"
            self.attempt(name.split(".")[0], f"{key!r:.80}", lambda: self.display[key])
            self.attempt(name.split(".")[0], f"{key!r:.80} with {value!r:.80}", lambda: self.display.with_({key: value}))

    def array(self) -> np.ndarray:
        """Of a random type, shape and layout, with a random value somewhere."""
        draw = self.draw
        kinds = "f4 f4 f4 f8 f8 u1 u1 u2 f2 >f4 >f8 >u2 g c8 c16 ? i1 i2 i4 i8 u4 u8 O S3 U2 M8[s] m8[s]".split()
        kind = draw.choice([*kinds, [("r", "f4")]])
        shape = [ROWS, COLUMNS, 3]
        if draw.random() < 0.3:
            shape = [draw.choice([0, 1, 2, 3, 4, 11, ROWS, COLUMNS]) for _ in range(draw.randrange(4))]
            shape += [draw.choice([0, 1, 2, 3]) for _ in range(draw.randrange(3))]
        elif draw.random() < 0.1:
            shape[2] = 4
        made = np.zeros(shape, kind)
        layout = draw.choice(["C", "C", "F", "strided", "reversed", "broadcast", "transposed", "unaligned", "read-only"])
        if made.dtype.kind in "fu" and made.size:
            made = np.asarray(np.abs(np.random.default_rng(draw.randrange(99)).normal(size=shape)) * 9).astype(kind)
            if made.dtype.kind == "f" and draw.random() < 0.4:
                with np.errstate(over="ignore"):
                    made.flat[draw.randrange(made.size)] = draw.choice([np.nan, np.inf, -np.inf, -1.0, 1e30, 1e-45, 70000.0])
            if made.ndim == 3 and made.shape[2] == 4 and draw.random() < 0.7:
                made[..., 3] = full_alpha(made)
        if layout == "F":
            made = np.asfortranarray(made)
        if layout == "strided" and made.ndim:
            made = np.repeat(made, 2, axis=0)[::2]
        if layout == "reversed" and made.ndim:
            made = np.ascontiguousarray(made[::-1])[::-1]
        if layout == "broadcast" and made.size:
            made = np.broadcast_to(made.flat[0], made.shape)
        if layout == "transposed":
            made = np.ascontiguousarray(made.T).T
        if layout == "unaligned" and made.dtype.kind in "fu":
            made = np.frombuffer(b"\0" + made.tobytes(), made.dtype, offset=1).reshape(made.shape)
        if layout == "read-only":
            made.flags.writeable = False
        return made

    def test_arrays(self) -> None:
        """Also: what is taken is what the plain copy of its colours is. Alpha may be there where it is full everywhere."""
        d, picture = self.display, self.picture
        calls = {
            "panel": lambda array: lfdsim.render(d, array, crop=(40, 20, 48, 24)),
            "a": lambda array: list(lfdsim.compare(array, picture).values()),
            "b": lambda array: list(lfdsim.compare(picture, array).values()),
            "view": lambda array: lfdsim.compare_photograph(array, picture, CORNERS, CORNERS).photograph,
            "photograph": lambda array: lfdsim.compare_photograph(picture, array, CORNERS, CORNERS).photograph,
            "picture": lambda array: np.frombuffer(lfdsim.png(array), np.uint8),
            "codes of panel": lambda array: lfdsim.panel_codes(d, array),
        }
        for _ in range(800 * (30 if FULL else 1)):
            name, array = self.draw.choice(list(calls)), self.array()
            what = f"array of {array.dtype}, shape {array.shape}, strides {array.strides}"
            result = self.attempt(name.split()[-1], what, lambda: calls[name](array))
            if result is None:
                continue
            self.assertTrue(array.dtype.kind == "f" or array.dtype.name in ("uint8", "uint16"), what)
            self.assertTrue(array.ndim == 3 and array.shape[2] in (3, 4), what)
            self.assertTrue(np.isfinite(array[..., :3]).all() and (array[..., 3:] >= full_alpha(array)).all(), what)
            plain = np.array(array[..., :3].tolist(), np.float32 if array.dtype.kind == "f" else array.dtype.newbyteorder("="))
            np.testing.assert_array_equal(result, calls[name](plain), f"seed {SEED}: {what}")


if __name__ == "__main__":
    unittest.main()
