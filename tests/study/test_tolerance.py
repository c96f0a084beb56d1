"""Tolerance studies whose answer is known in closed form: ideal lenses whose gap and place are wrong."""

import json
import unittest

import numpy as np
import pandas
from scipy import stats

from common import DISPLAY, StudyTest, call

import lfdsim
from lfdsim import study
from lfdsim.study import Loss, StudyError, errors, tolerances

GAP, FOCAL, PITCH, DISTANCE, SD = 16.485, 15.7, 12.0, 1000.0, 0.03


def depth(gap):
    return 1 / (1 / FOCAL - 1 / gap)


def fov(gap):
    """Of elemental images, which are made for eyes at DISTANCE and therefore wider than a lens: p D/(D - g)."""
    return np.degrees(2 * np.arctan(PITCH * DISTANCE / (DISTANCE - gap) / (2 * gap)))


def percentile_within(test, values, percent, known, sigmas=4):
    """An empirical percentile against the distribution's: so many values below it as a binomial distribution allows."""
    p = percent / 100
    below = np.sum(values <= known)
    test.assertLess(abs(below - p * len(values)), sigmas * np.sqrt(len(values) * p * (1 - p)) + 0.5)


class Chance(unittest.TestCase):
    """What the budget says of its own certainty, on losses that are known: |x| of a normal x, of which 95 % are below 1.96."""

    def intervals(self, draws, times):
        random = np.random.default_rng(3)
        for _ in range(times):
            lost = np.sort(np.abs(random.standard_normal(draws)))
            yield tolerances._interval({s: s * lost for s in (0.5, 1, 2)}, stats.norm.ppf(0.975), 95.0)

    def test_most_intervals_hold_the_scale(self):
        for draws in (59, 60, 100, 200):
            found = list(self.intervals(draws, 1000))
            self.assertGreater(sum(low <= 1 <= high for low, high in found), 930)  # at least 950, and two standard deviations of chance
            self.assertLess(np.median([high / low for low, high in found]), 2)

    def test_few_draws_say_nothing_of_the_rarest(self):
        self.assertTrue(np.isnan(list(self.intervals(58, 1))).all())

    def test_ranks_by_counting(self):
        """P(l <= B < u) of a binomial B is the chance that the percentile lies between the draws of ranks l and u."""
        for percent, fewest in ((95, 59), (99, 299), (50, 6), (5, 59)):
            self.assertEqual(tolerances.fewest_draws(percent), fewest)
            self.assertIsNone(tolerances.ranks_about(fewest - 1, percent))
            for draws in (fewest, 2 * fewest, 1000):
                low, high = tolerances.ranks_about(draws, percent)
                chances = stats.binom.pmf(np.arange(draws + 1), draws, percent / 100)
                self.assertGreaterEqual(chances[low:high].sum(), 0.95 - 1e-12)
                widest = np.convolve(chances[1:draws], np.ones(high - low - 1), "valid").max()  # of any two ranks that are nearer
                self.assertLess(widest, 0.95)
                self.assertTrue(low <= tolerances.rank_of(draws, percent) <= high)

    def test_the_rank_of_a_percentile(self):
        """The smallest draw that so many per cent do not exceed."""
        for draws, percent, rank in ((60, 95, 57), (59, 95, 57), (61, 95, 58), (20, 95, 19), (100, 7, 7), (1000, 99.9, 999), (3, 1, 1), (1, 99, 1)):
            self.assertEqual(tolerances.rank_of(draws, percent), rank)
            self.assertGreaterEqual(100 * rank, percent * draws - 1e-9)


class Draws(unittest.TestCase):
    layout = errors.Layout({"errors.gap_mm": SD, "errors.shift_mm": [0.2, 0.1], "errors.decenter_sd_mm": 0.01}, 400, 100)

    def rows(self):
        import csv
        import io
        import json

        lines = list(csv.DictReader(io.StringIO(errors.rows_csv(self.layout, 7))))
        return [{k: json.loads(v) for k, v in line.items()} for line in lines]

    def test_blocks_are_groups_times_scales(self):
        rows = self.rows()
        blocks = self.layout.blocks()
        self.assertEqual(len(rows), 1 + 400 + 11 * 100)
        self.assertEqual(rows[0], {"errors.gap_mm": 0, "errors.shift_mm": [0, 0], "errors.decenter_sd_mm": 0, "errors.seed": 0})
        whole = next(r for g, s, r in blocks if g == errors.ALL and s == 1)
        for group, scale, block in blocks:
            for draw, at in enumerate(block):
                row, full = rows[at], rows[whole[draw]]
                self.assertEqual(row["errors.seed"], full["errors.seed"])
                for key in self.layout.sizes:
                    expected = np.asarray(full[key]) * (scale if group in (errors.ALL, key) else 0)
                    np.testing.assert_allclose(row[key], expected, rtol=1e-15)

    def test_errors_of_the_array_are_truncated_normal_and_independent(self):
        rows = self.rows()
        whole = next(r for g, s, r in self.layout.blocks() if g == errors.ALL and s == 1)
        drawn = np.array(
            [[rows[k]["errors.gap_mm"] / SD, rows[k]["errors.shift_mm"][0] / 0.2, rows[k]["errors.shift_mm"][1] / 0.1] for k in whole]
        )
        for column in drawn.T:
            self.assertGreater(stats.kstest(column, stats.truncnorm(-3, 3).cdf).pvalue, 1e-4)
        self.assertLess(np.abs(np.corrcoef(drawn.T) - np.eye(3)).max(), 4 / np.sqrt(400))
        self.assertEqual(len({rows[k]["errors.seed"] for k in whole}), 400)


class Budgets(unittest.TestCase):
    def test_powers_are_found(self):
        self.assertAlmostEqual(tolerances.allowed_scale({0.5: 0.25, 1: 1, 2: 4}, 2)[0], np.sqrt(2))
        self.assertAlmostEqual(tolerances.allowed_scale({0.5: 0.5, 1: 1, 2: 2}, 0.7)[0], 0.7)
        scale, how = tolerances.allowed_scale({0.5: 0.25, 1: 1, 2: 4}, 0.01)
        self.assertAlmostEqual(scale, 0.1)
        self.assertIn("extrapolated", how)
        # Nothing is allowed that is known to lose more.
        for at in ({0.5: 10.0, 1: 30.0, 2: 50.0}, {0.5: 10.0, 1: 8.0, 2: 50.0}):
            scale, how = tolerances.allowed_scale(at, 0.01)
            self.assertTrue(np.isnan(scale))
            self.assertEqual(how, "less than 0.5 of its size, which loses more; state a smaller size to measure it")

    def test_nothing_is_guessed_beyond_what_was_possible(self):
        self.assertEqual(tolerances.allowed_scale({0.5: 0.0, 1: 0.1, 2: 0.2}, 1)[0], 2)
        # What a larger error makes up for again is not allowed.
        self.assertAlmostEqual(tolerances.allowed_scale({0.5: 0.1, 1: 0.4, 2: 0.1}, 0.2)[0], np.sqrt(0.5))
        self.assertTrue(np.isnan(tolerances.allowed_scale({0.5: 0.3, 1: 0.1, 2: 0.4}, 0.2)[0]))
        self.assertEqual(tolerances.Loss.parse("picture.ssim= -0.02"), tolerances.Loss("picture.ssim", 0.02, "fall"))
        self.assertEqual(tolerances.allowed_scale({0.5: 0.0, 1: 0.0, 2: 1.0}, 0.5)[0], 1)
        scale, how = tolerances.allowed_scale({0.5: np.inf, 1: np.inf, 2: np.inf}, 1, {0.5: "5 of 5 draws impossible"})
        self.assertTrue(np.isnan(scale))
        self.assertIn("unknown: nothing was measured (at 0.5: 5 of 5 draws impossible)", how)

    def test_what_was_not_measured_is_no_limit(self):
        cut = {2.0: "3 of 5 draws impossible, most often because: too far aside"}
        scale, how = tolerances.allowed_scale({0.5: 0.1, 1: 0.2, 2: np.inf}, 1, cut)
        self.assertEqual(scale, 1)
        self.assertEqual(how, "or more: larger ones were not measured (at 2: 3 of 5 draws impossible, most often because: too far aside)")
        self.assertAlmostEqual(tolerances.allowed_scale({0.5: 0.1, 1: 0.4, 2: np.inf}, 0.2, cut)[0], np.sqrt(0.5))
        scale, how = tolerances.allowed_scale({0.5: 2.0, 1: np.inf, 2: np.inf}, 1, {1.0: "all draws impossible"})
        self.assertTrue(np.isnan(scale))
        self.assertIn("less than 0.5 of its size, which loses more; state a smaller size to measure it (at 1: all draws impossible)", how)

    def test_a_figure_that_the_display_without_errors_lacks(self):
        layout = errors.Layout({"errors.gap_mm": SD}, 4, 4)
        rows = pandas.DataFrame({"f": np.ones(layout.rows), "error": None})
        for figure in (np.nan, np.inf):
            budget = tolerances._budget(layout, rows, pandas.Series({"f": figure}), (Loss("f", 1.0),), 50)
            self.assertEqual(set(budget["how"]), {"unknown: the display without errors has no such figure, or an infinite one"})

    def test_lost_draws_beyond_the_percentile_do_not_count(self):
        """Of 40 draws the loss is that of the 38th, of 41 that of the 39th."""
        for draws, lost, how in ((40, 2, "or more: all"), (40, 3, "or more: larger"), (41, 2, "or more: all"), (41, 3, "or more: larger")):
            layout = errors.Layout({"errors.gap_mm": SD}, draws, draws)
            rows = pandas.DataFrame({"f": np.zeros(layout.rows), "error": None})
            for group, scale, block in layout.blocks():
                if scale == 2:
                    rows.loc[block[:lost], ["f", "error"]] = (np.nan, "impossible")
            budget = tolerances._budget(layout, rows, pandas.Series({"f": 0.0}), (Loss("f", 1.0),), 95)
            self.assertTrue(all(line.startswith(how) for line in budget["how"]), (draws, lost, set(budget["how"])))

    def test_a_loss_that_small_errors_do_not_lower_is_not_extrapolated(self):
        scale, how = tolerances.allowed_scale({0.5: 2.0, 1: 2.001, 2: 2.1}, 1)
        self.assertTrue(np.isnan(scale))
        self.assertIn("less than 0.5", how)

    def test_ways_of_losing(self):
        figure = np.array([0.9, 1.0, 1.2])
        np.testing.assert_allclose(Loss.parse("f=0.1").of(figure, 1.0), [0.1, 0, 0.2])
        np.testing.assert_allclose(Loss.parse("f=-0.1").of(figure, 1.0), [0.1, 0, 0])
        np.testing.assert_allclose(Loss.parse("a=b=+0.1").of(figure, 1.0), [0, 0, 0.2])
        for wrong in ("f", "f=", "=1", "f=x", "f=0", "f=nan"):
            with self.assertRaisesRegex(StudyError, "is not FIGURE=AMOUNT"):
                Loss.parse(wrong)
        for wrong in (("f", -1.0), ("f", "1"), ("f", 1.0, "up")):
            with self.assertRaisesRegex(StudyError, "give an amount above 0, and one of"):
                Loss(*wrong)


class Arguments(StudyTest):
    def test_wrong_ones_are_named(self):
        display, out = self.folder / "display.toml", self.folder / "out"
        for words, named in (
            ("draws: is 2.5; give a whole number from 1", {"draws": 2.5}),
            ("draws: is 'many'; give a whole number from 1", {"draws": "many"}),
            ("alone: is -1; give a whole number from 0", {"alone": -1}),
            ("seed: is 0.5; give a whole number from 0", {"seed": 0.5}),
            ("percent: is '95'; give a number above 0", {"percent": "95"}),
            ("percent: is 100; give a number above 0", {"percent": 100}),
            ("measures: is 'fov'; give a tuple of names", {"measures": "fov"}),
            ("losses: is .*; give a tuple of losses", {"losses": ("check.a=5",)}),
        ):
            with self.subTest(words), self.assertRaisesRegex(StudyError, words):
                tolerances.tolerance(display, out, **named)
        with self.assertRaisesRegex(TypeError, "display is a int; give a path"):
            tolerances.tolerance(5, out)
        self.assertFalse(out.exists())


class KnownAnswers(StudyTest):
    def test_a_gap_that_is_normal(self):
        """Percentiles of a monotonous function of the gap are that function of the gap's percentiles."""
        rows = 1500
        study_file = self.write(
            f'schema = 1\ndisplay = "display.toml"\ndesign = "monte_carlo"\nrows = {rows}\nseed = 11\n[[factor]]\nkey = "array.gap_mm"\n'
            f'normal = {{ mean = {GAP}, sd = {SD} }}\n[[measure]]\nname = "check"\n'
        )
        table = study.run(study_file, self.folder / "out", progress=False)
        np.testing.assert_allclose(table["check.theory.central_depth_mm"], depth(table["array.gap_mm"]), rtol=1e-9)
        for percent in (5, 25, 50, 75, 95):
            gap = stats.truncnorm(-3, 3, GAP, SD).ppf(1 - percent / 100)  # both fall where the gap grows
            percentile_within(self, table["check.theory.central_depth_mm"], percent, depth(gap))
            percentile_within(self, table["check.theory.fov_exact_deg"], percent, fov(gap))
        np.testing.assert_allclose(table["check.theory.fov_exact_deg"], fov(table["array.gap_mm"]), rtol=1e-9)


class WholeStudies(StudyTest):
    def setUp(self):
        super().setUp()
        self.display = self.write(DISPLAY + f"[errors]\ngap_mm = {SD}\nrotation_deg = 0.01\n", "errors.toml")

    def test_the_budget_of_a_gap_error(self):
        """95 % of gaps are within 1.96 standard deviations, so a loss of depth(g - 1.96 sd) - depth(g) is just allowed.

        The percentile of 200 draws is within 7 %, one standard error."""
        allowed = depth(GAP - stats.truncnorm(-3, 3).ppf(0.975) * SD) - depth(GAP)
        found = study.tolerance(
            self.display,
            self.folder / "out",
            200,
            alone=200,
            measures=("check",),
            progress=False,
            losses=(Loss("check.theory.central_depth_mm", allowed),),
        )
        budget = found.budget.set_index("error")
        self.assertAlmostEqual(budget.loc["errors.gap_mm", "allowed scale"], 1, delta=0.2)
        self.assertAlmostEqual(budget.loc[errors.ALL, "allowed scale"], budget.loc["errors.gap_mm", "allowed scale"], places=6)
        self.assertEqual(budget.loc["errors.rotation_deg", "allowed scale"], 2)
        low, high = budget.loc["errors.gap_mm", ["allowed scale from", "allowed scale to"]]
        self.assertTrue(0.7 < low < 1 < high < 1.4, (low, high))
        values = found.draws["check.theory.central_depth_mm"]
        for percent in (5, 50, 95):
            percentile_within(self, values, percent, depth(GAP + stats.truncnorm(-3, 3, 0, SD).ppf(1 - percent / 100)))

    def test_the_measured_view_of_a_shifted_and_raised_array(self):
        """Elemental images are p (1 + g/Z) wide, Z from lenses to eyes. The panel's point P is seen through a lens at d that is
        raised by e from d + (d - P) (Z - e)/(g + e): the view's slope shifts by d (1/g + 1/Z), its half width scales with
        (Z - e)/(g + e). Rays measure where half of the lenses show a neighbour's image, to 0.06 mm."""
        text = DISPLAY + f"[errors]\ngap_mm = {SD}\nshift_mm = [0.1, 0.0]\n"
        draws, reach = 100, DISTANCE - GAP
        found = study.tolerance(
            self.write(text, "errors.toml"),
            self.folder / "out",
            draws,
            alone=0,
            measures=({"name": "zone", "settings": {"size": [16, 9]}},),
            seed=4,
            progress=False,
        )
        left, right = (found.draws[f"zone.horizontal.wrong_50_percent_mm.{k}"].to_numpy() for k in (0, 1))
        shift = np.array([json.loads(s)[0] for s in found.draws["errors.shift_mm"]])
        raised = found.draws["errors.gap_mm"].to_numpy(float)
        scale = (reach - raised) / (GAP + raised)
        middle = (left + right) / 2
        np.testing.assert_allclose(middle, shift * (1 + scale), atol=0.06)
        without = [found.without[f"zone.horizontal.wrong_50_percent_mm.{k}"] for k in (0, 1)]
        self.assertAlmostEqual(without[1], PITCH / 2 * (1 + GAP / reach) * reach / GAP, delta=2)  # a pixel is 8 mm wide there
        np.testing.assert_allclose((right - left) / (without[1] - without[0]), scale / (reach / GAP), rtol=1e-3)
        self.assertFalse([n for n in found.percentiles.index if "_error" in n])
        for percent in (5, 25, 50, 75, 95):
            share = percent / 100
            known = stats.truncnorm(-3, 3, 0, 0.1).ppf(share) * (1 / GAP + 1 / reach)
            percentile_within(self, middle / reach, percent, known)
            raised_by = stats.truncnorm(-3, 3, 0, SD).ppf(1 - share)
            known = (without[1] - without[0]) * (reach - raised_by) / (GAP + raised_by) / (reach / GAP)
            percentile_within(self, right - left, percent, known)

    def test_the_command(self):
        words = (
            "tolerance",
            self.display,
            "-o",
            self.folder / "out",
            "--draws",
            20,
            "--measure",
            "check",
            "--loss",
            "check.theory.central_depth_mm=5",
        )
        done = call(*words)
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (self.folder / "out" / "tolerance.html").read_text()
        self.assertIn("Budget for check.theory.central_depth_mm", text)
        self.assertEqual(done.stdout, call(*words).stdout)
        self.assertIn("holds another study (draws.csv differs)", call(*words[:4], "--draws", 21, "--measure", "check").stderr)

    def test_fewer_draws_together_than_alone(self):
        losses = ("--loss", "check.theory.central_depth_mm=+5", "--loss", "check.theory.central_depth_mm=-4")
        words = ("--draws", 8, "--alone", 20, "--measure", "check", *losses, "--percent", 50)
        done = call("tolerance", self.display, "-o", self.folder / "out", *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("8 draws of all errors together, 0 of them impossible.\n136 draws of each error alone", done.stdout)
        for way in ("rise by 5", "fall by 4"):
            self.assertIn(f"Budget for check.theory.central_depth_mm: it may {way}\n  all together", done.stdout)

    def test_errors_are_those_of_the_changed_display(self):
        none = {"errors": None}
        with self.assertRaisesRegex(StudyError, "states no error"):
            study.tolerance(self.display, self.folder / "none", 2, alone=0, measures=("check",), progress=False, set=none)
        self.write("i,j,dx_mm,dy_mm,dz_mm,tilt_x_deg,tilt_y_deg,curvature\n0,0,0,0,0.1,0,0,0\n", "lenses.csv")
        done = call(
            *("tolerance", self.display, "-o", self.folder / "out", "--draws", 2, "--alone", 0, "--measure", "check"),
            *("--set", "errors.gap_mm=none", f"errors.table={self.folder / 'lenses.csv'}"),
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("All rows, also the one without errors, have the errors of errors.table (", done.stdout)
        self.assertNotIn("gap_mm", (self.folder / "out" / "draws.csv").read_text())

    def test_sizes_in_place_of_impossible_ones(self):
        """What --set changes is judged with it, in the description, in a study's [set] and in Python."""
        display = self.write(DISPLAY + "[errors]\ndecenter_sd_mm = 0.5\n", "too_much.toml")
        found = study.tolerance(
            display, self.folder / "out", 3, alone=2, measures=("check",), progress=False, set={"errors.decenter_sd_mm": 0.01, "diffuser": None}
        )
        self.assertEqual((found.layout.sizes, len(found.draws)), ({"errors.decenter_sd_mm": 0.01}, 3))
        with self.assertRaisesRegex(StudyError, "decenter_sd_mm of up to"):
            study.tolerance(display, self.folder / "other", 3, alone=2, measures=("check",), progress=False)
        self.assertEqual(lfdsim.Display.load(display, {"errors.decenter_sd_mm": 0.01})["errors.decenter_sd_mm"], 0.01)

    def test_decentres_that_are_impossible(self):
        """Lenses 12 mm wide may stand 0.6 mm aside at most: three standard deviations of 0.15 mm fit, of twice that none."""
        display = self.write(DISPLAY, "plain.toml")
        words = ("tolerance", display, "-o", self.folder / "out", "--draws", 5, "--alone", 5, "--measure", "check")
        done = call(*words, "--set", "errors.decenter_sd_mm=0.15", "content.viewing_distance_mm=900", "--loss", "check.theory.fov_deg=1")
        self.assertEqual(done.returncode, 0, done.stderr)
        line = next(x for x in done.stdout.splitlines() if x.startswith("  errors.decenter_sd_mm: 1 of its size, 0.15; or more"))
        self.assertIn("larger ones were not measured (at 2: 5 of 5 draws impossible, most often because: ", line)
        self.assertIn("decenter_sd_mm of up to 0.2", line)
        self.assertIn("At 95 % an allowed scale has an interval only with 59 draws or more; make more draws", done.stdout)
        self.assertIn("5 draws of all errors together, 0 of them impossible.", done.stdout)
        self.assertIn("25 draws of each error alone and at other sizes, 10 of them impossible, most often because: ", done.stdout)
        self.assertIn('"content.viewing_distance_mm" = 900', (self.folder / "out" / "tolerance.toml").read_text())
        self.assertIn("10 of them impossible", (self.folder / "out" / "tolerance.html").read_text())
        self.assertIn("is not KEY=VALUE", call(*words, "--set", "gap").stderr)

    def test_figures_fit_a_terminal_and_a_page(self):
        done = call("tolerance", self.display, "-o", self.folder / "out", "--draws", 4, "--alone", 0, "--measure", "check")
        self.assertLessEqual(max(map(len, done.stdout.splitlines()[2:-1])), 100)
        page = (self.folder / "out" / "tolerance.html").read_text()
        self.assertIn("body{max-width:none}", page)


class BadInput(StudyTest):
    def test_is_told(self):
        for words, said in (
            ((self.folder / "display.toml",), "states no error"),
            ((self.folder / "none.toml",), "cannot be read"),
            ((self.folder / "display.toml", "--loss", "x"), "is not FIGURE=AMOUNT"),
            ((self.folder / "display.toml", "--percent", 100), "percent"),
            ((self.folder / "display.toml", "--measure", "fow"), '"fow" is not a measure; did you mean fov'),
            ((self.folder / "display.toml", "--measure", "fov,fov"), '"fov" is given more than once'),
            ((self.folder / "display.toml", "--loss", "zone.x=1"), "zone.x: is of no measure here; there are: picture, fov, crosstalk"),
        ):
            done = call("tolerance", words[0], "-o", self.folder / "out", *words[1:])
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(said, done.stderr)
            self.assertNotIn("Traceback", done.stderr)
            self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    unittest.main()
