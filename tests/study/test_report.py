"""What the report says of effects is right where the answer is known in closed form; the page has what the file asks for."""

import re
import unittest

import numpy as np
from scipy import stats

from common import StudyTest, call

from lfdsim import study
from lfdsim.study import design, planned
from lfdsim.study.file import Limit, Objective
from lfdsim.study.reports import data, effects, page, plots


class Effects(unittest.TestCase):
    def setUp(self):
        self.random = np.random.default_rng(3)

    def test_regression_of_a_sum(self):
        x = self.random.normal(size=(4000, 3)) * [1, 10, 0.1] + [5, 0, 2]
        y = 3 * x[:, 0] - 0.2 * x[:, 1] + self.random.normal(size=4000)
        found = effects.regression(x, y)
        expected = np.array([3, -0.2, 0]) * x.std(0)
        self.assertTrue(np.all(np.abs(found.coefficients - expected) < 2 * found.errors))
        np.testing.assert_allclose(found.errors, 1.96 / np.sqrt(4000), rtol=0.1)
        self.assertAlmostEqual(found.explained, 13 / 14, delta=0.01)

    def test_the_regressions_intervals_hold_the_truth(self):
        """95 % of them, though replicates of a row share what that row has beyond the sum; some of them are missing."""
        holds = np.zeros(2)
        of, spread = np.repeat(np.arange(25), 8), np.array([1.0, 4.0])
        for _ in range(1000):
            x = self.random.normal(size=(25, 2)) * spread
            y = (x @ [1, 0.2] + self.random.normal(size=25))[of] + 0.3 * self.random.normal(size=200)
            y[self.random.random(200) < 0.1] = np.nan
            found = effects.regression(x[of], y, of)
            holds += np.abs(found.coefficients - [1, 0.2] * x.std(0)) <= found.errors
        np.testing.assert_allclose(holds / 1000, 0.95, atol=0.025)

    def test_replicates_that_repeat_a_value_say_no_more_than_one(self):
        x, y = self.random.normal(size=(30, 2)), self.random.normal(size=30)
        once, often = effects.regression(x, y), effects.regression(x.repeat(5, 0), y.repeat(5), np.arange(150) // 5)
        for name in ("coefficients", "errors", "explained"):
            np.testing.assert_allclose(getattr(often, name), getattr(once, name), rtol=1e-12)

    def test_no_regression_where_there_is_none(self):
        x = self.random.normal(size=(20, 2))
        self.assertIsNone(effects.regression(np.column_stack([x, x[:, 0]]), x[:, 1]))
        self.assertIsNone(effects.regression(x[:3], x[:3, 1]))
        self.assertIsNone(effects.regression(x, np.full(20, np.nan)))

    def test_sobol_indices_of_ishigamis_function(self):
        """Saltelli 2000: variance a^2/8 + b pi^4/5 + b^2 pi^8/18 + 1/2; x3 acts through x1 alone."""
        a, b = 7, 0.1
        x = (2 * design.shares_of("saltelli", 4096, 3, 1) - 1) * np.pi
        y = np.sin(x[:, 0]) + a * np.sin(x[:, 1]) ** 2 + b * x[:, 2] ** 4 * np.sin(x[:, 0])
        v1, v2, v13 = (1 + b * np.pi**4 / 5) ** 2 / 2, a * a / 8, 8 * b * b * np.pi**8 / 225
        v = v1 + v2 + v13
        found = effects.sobol(y, 3)
        np.testing.assert_allclose(found.first, [v1 / v, v2 / v, 0], atol=0.02)
        np.testing.assert_allclose(found.total, [(v1 + v13) / v, v2 / v, v13 / v], atol=0.02)
        self.assertTrue(np.all((found.first_error > 0.001) & (found.first_error < 0.1)))

    def test_interaction_is_what_is_beyond_the_sum(self):
        first, second = (g.ravel() for g in np.indices((3, 4)))
        self.assertAlmostEqual(effects.interaction(effects.cell_means(first, second, first * 2.0 - second)), 0)
        product = (first - 1) * (second - 1.5)
        self.assertAlmostEqual(effects.interaction(effects.cell_means(first, second, product)), np.sqrt(np.mean(product**2)))
        self.assertTrue(np.isnan(effects.interaction(effects.cell_means(first[1:], second[1:], product[1:]))))

    def test_pareto_front_is_that_of_comparing_all_pairs(self):
        figures = np.round(self.random.random((200, 3)), 1)
        figures[3] = np.nan
        objectives = (Objective("a", "high"), Objective("b", "low"), Objective("c", "high"))
        signed = figures * [1, -1, 1]
        expected = [not np.isnan(r).any() and not any(np.all(o >= r) and np.any(o > r) for o in signed) for r in signed]
        np.testing.assert_array_equal(effects.pareto(figures, objectives), expected)

    def test_yield(self):
        figure = np.array([1, 2, 3, np.nan, np.inf])
        self.assertEqual(effects.passes(figure, Limit("f", 2, None)).tolist(), [False, True, True, False, True])
        self.assertEqual(effects.passes(figure, Limit("f", None, 2)).tolist(), [True, True, False, False, False])
        share, low, high = effects.share_with_interval(np.repeat([0, 1], 50), 1)
        self.assertAlmostEqual(share, 0.5)
        self.assertAlmostEqual(low, 0.4038, places=3)  # Wilson 1927
        self.assertAlmostEqual(high, 0.5962, places=3)

    def test_yield_with_replicates(self):
        def wilson(passed: int, of: int) -> tuple[float, float, float]:
            interval = stats.binomtest(passed, of).proportion_ci(0.95, "wilson")
            return passed / of, interval.low, interval.high

        for passed in (0, 1, 17, 50):
            rows = np.repeat([1, 0], [passed, 50 - passed])
            np.testing.assert_allclose(effects.share_with_interval(rows, 1), wilson(passed, 50), atol=1e-12)
            np.testing.assert_allclose(effects.share_with_interval(8 * rows, 8), wilson(passed, 50), atol=1e-12)  # they repeat one value
        np.testing.assert_allclose(effects.share_with_interval(np.full(50, 3), 4), wilson(150, 200), atol=1e-12)  # rows do not differ
        np.testing.assert_allclose(effects.share_with_interval(np.array([3]), 4)[1:], (0.1179, 0.9854), atol=1e-4)  # 0.75 of one draw
        independent = self.random.binomial(10, 0.7, 4000)
        np.testing.assert_allclose(effects.share_with_interval(independent, 10), wilson(independent.sum(), 40000), atol=3e-4)

    def test_the_yields_interval_holds_its_share(self):
        """95 % of intervals hold the true yield, where a row's chance to pass differs from the next one's."""
        holds = 0
        for _ in range(1000):
            chances = self.random.beta(0.6, 0.3, 80)  # two thirds on average
            _, low, high = effects.share_with_interval(self.random.binomial(10, chances), 10)
            holds += low <= 2 / 3 <= high
        self.assertAlmostEqual(holds / 1000, 0.95, delta=0.025)

    def test_groups_are_levels_or_equally_many(self):
        values = self.random.random(800)
        positions, centres = effects.groups(values, None)
        self.assertEqual(np.bincount(positions).tolist(), [100] * 8)
        np.testing.assert_allclose(centres, (np.arange(8) + 0.5) / 8, atol=0.03)


FILE = """schema = 1
display = "display.toml"
design = "grid"
[[factor]]
key = "array.gap_mm"
values = [16.3, 16.5, 16.7, -1.0]
[[factor]]
key = "lens.focal_length_mm"
values = [15.6, 15.8]
[[factor]]
key = "camera.pixel_filter"
values = ["center", "box"]
[[measure]]
name = "check"
[[limit]]
figure = "check.theory.central_depth_mm"
max = 350
[[objective]]
figure = "check.theory.fov_exact_deg"
best = "high"
[[objective]]
figure = "check.theory.central_depth_mm"
best = "low"
"""


class Page(StudyTest):
    def test_a_report_has_its_parts_and_its_numbers(self):
        done = call("run", self.write(FILE), "-o", self.folder / "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (self.folder / "out" / page.NAME).read_text()
        written = (self.folder / "out" / page.NAME).stat().st_ino
        self.assertEqual(call("run", self.write(FILE), "-o", self.folder / "out").stdout, done.stdout)
        self.assertEqual(written, (self.folder / "out" / page.NAME).stat().st_ino)  # it is as it was
        for part in (
            "16 rows, 4 of them impossible",
            "Impossible rows",
            "array.gap_mm",
            "Yield",
            "Main effects",
            "Interactions",
            "What costs most",
            "Pareto front",
            "Best, middle and worst",
            "data:image/png;base64,",
        ):
            self.assertIn(part, text)
        self.assertEqual(text.count("<svg"), text.count("</svg>"))
        self.assertNotIn(
            "http", text.replace("http://www.w3.org", "").replace("http://purl.org", "").replace("http://creativecommons.org", "")
        )
        read = data.read(planned.load(self.folder / "out"))
        self.assertEqual((len(read.rows), len(read.failed)), (12, 4))
        self.assertEqual(read.levels["camera.pixel_filter"], ["box", "center"])
        depth = 1 / (1 / read.rows["lens.focal_length_mm"] - 1 / read.rows["array.gap_mm"])
        np.testing.assert_allclose(read.rows["check.theory.central_depth_mm"], depth)
        self.assertIn(f"{100 * np.sum(depth <= 350) / 16:.2f} %", text)

    def test_replicates_that_repeat_a_value_narrow_no_interval(self):
        """check draws nothing."""
        lines = []
        for replicates in (1, 3):
            out = self.folder / f"out{replicates}"
            file = self.write(FILE.replace('"grid"', f'"grid"\nreplicates = {replicates}'))
            study.run(file, out, workers=1, progress=False)
            study.report(out)
            lines.append(re.search(r"<td>all limits</td>.*?<td>(\d+)</td><td>(.*?)</td><td>(.*?)</td>", (out / page.NAME).read_text()))
        self.assertEqual(int(lines[1][1]), 3 * int(lines[0][1]))
        self.assertEqual(lines[1].groups()[1:], lines[0].groups()[1:])

    def test_an_empty_cell_has_the_displays_value(self):
        (self.folder / "rows.csv").write_text("array.gap_mm\n16.1\n16.2\n16.3\n16.6\n16.7\n\"\"\n")
        text = 'schema = 1\ndisplay = "display.toml"\ndesign = "table"\ntable = "rows.csv"\n[[measure]]\nname = "check"\n'
        text += '[[limit]]\nfigure = "check.theory.fov_exact_deg"\nmin = 1\n'
        out = self.folder / "out"
        study.run(self.write(text), out, workers=1, progress=False)
        found = data.read(planned.load(out))
        self.assertEqual(found.factors["array.gap_mm"].tolist(), [16.1, 16.2, 16.3, 16.6, 16.7, 16.485])
        self.assertEqual(found.numbers, {"array.gap_mm"})

    def test_a_yield_of_figures_that_no_row_has_is_none(self):
        for number, figure in enumerate(("central_depth_mm", "by_pixel_in_front_mm.0")):  # infinite, and undefined
            text = 'schema = 1\ndisplay = "display.toml"\ndesign = "grid"\n[[factor]]\nkey = "camera.position_mm.2"\nvalues = [900, 1000]\n'
            text += f'[set]\n"array.gap_mm" = 15.7\n[[measure]]\nname = "check"\n[[limit]]\nfigure = "check.theory.{figure}"\nmin = 1\nmax = 2\n'
            out = self.folder / f"out{number}"
            study.run(self.write(text), out, workers=1, progress=False)
            study.report(out)
            self.assertIn("<td>all limits</td><td></td><td></td><td>0</td><td>0.00 %</td>", (out / page.NAME).read_text())

    def test_texts_have_no_regression(self):
        text = 'schema = 1\ndisplay = "display.toml"\ndesign = "grid"\n[[factor]]\nkey = "content.pickup"\n'
        text += 'values = ["nodal", "traced", "integrated"]\n[[measure]]\nname = "check"\n[[limit]]\nfigure = "check.theory.views"\nmin = 1\n'
        out = self.folder / "out"
        study.run(self.write(text), out, workers=1, progress=False)
        study.report(out)
        report = (out / page.NAME).read_text()
        self.assertIn("Left out of the regression, as texts, lists and empty cells have no order: content.pickup.", report)
        self.assertNotIn("by linear regression", report)

    def test_rows_of_saltelli_that_repeat_values_do_not_count(self):
        factor = '[[factor]]\nkey = "KEY"\nuniform = { from = FROM, to = TO }\n'
        factors = factor.replace("KEY", "array.gap_mm").replace("FROM", "16.3").replace("TO", "16.7")
        factors += factor.replace("KEY", "content.depth_mm").replace("FROM", "1").replace("TO", "90")
        text = f'schema = 1\ndisplay = "display.toml"\ndesign = "saltelli"\nrows = 8\n{factors}[[measure]]\nname = "check"\n'
        limit = ''.join(f'[[limit]]\nfigure = "check.theory.{name}"\nmax = 330\n' for name in ("central_depth_mm", "views"))
        out = self.folder / "out"
        table = study.run(self.write(text + limit), out, workers=1, progress=False)
        study.report(out)
        self.assertEqual(len(table), 32)
        passed = (table["check.theory.central_depth_mm"][:16] <= 330).sum()
        report = (out / page.NAME).read_text()
        self.assertIn(f"<td>all limits</td><td></td><td></td><td>{passed}</td><td>{100 * passed / 16:.2f} %</td>", report.replace("\n", ""))
        self.assertIn("The first 16 rows of the design count", report)
        factors = table[["array.gap_mm", "content.depth_mm"]].to_numpy(float)[:16]
        explained = effects.regression(factors, table["check.theory.central_depth_mm"].to_numpy(float)[:16]).explained
        self.assertIn(f"explains {100 * explained:.1f} % of the variance", report)
        self.assertIn("check.theory.views: no Sobol indices: all rows have the same figure.", report)

    def test_another_limit_makes_another_report(self):
        out = self.folder / "out"
        study.run(self.write(FILE), out, workers=1, progress=False)
        study.report(out)
        self.assertEqual(call("run", self.write(FILE.replace("max = 350", "max = 353")), "-o", out).returncode, 0)
        self.assertIn("<td>353</td>", (out / page.NAME).read_text())

    def test_the_strongest_interaction_is_of_gap_and_focal_length(self):
        study.run(self.write(FILE), self.folder / "out", workers=1, progress=False)
        read = data.read(planned.load(self.folder / "out"))
        pairs = plots.strongest_pairs(read, "check.theory.central_depth_mm")
        self.assertEqual({pairs[0][1], pairs[0][2]}, {"array.gap_mm", "lens.focal_length_mm"})
        self.assertAlmostEqual(pairs[1][0], 0, places=9)

    def test_objectives_that_no_row_has_are_told(self):
        text = FILE.replace('figure = "check.theory.central_depth_mm"\nbest', 'figure = "check.theory.fov_horizontal_deg"\nbest')
        study.run(self.write(text), self.folder / "out", workers=1, progress=False)
        self.assertIn("no row has finite figures for all objectives", study.report(self.folder / "out").read_text())

    def test_a_study_without_any_possible_row_has_a_report(self):
        study.run(self.write(FILE.replace("[16.3, 16.5, 16.7, -1.0]", "[-1.0, -2.0]")), self.folder / "out", workers=1, progress=False)
        self.assertIn("8 rows, 8 of them impossible", study.report(self.folder / "out").read_text())


if __name__ == "__main__":
    unittest.main()
