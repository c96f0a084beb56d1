"""Rows are what the file says: by counting, by quantiles of known distributions, and by the definitions of the designs."""

import unittest

import numpy as np
from scipy import stats

from common import StudyTest

from lfdsim.study import design, factors
from lfdsim.study.file import read_study

HEAD = 'schema = 1\ndisplay = "display.toml"\n'
MEASURE = '[[measure]]\nname = "check"\n'


class Designs(StudyTest):
    def rows(self, text: str, replicate_keys=("render.seed",)):
        return design.rows_of(read_study(self.write(HEAD + text + MEASURE)), replicate_keys)

    def test_a_grid_has_all_combinations_and_the_last_factor_changes_fastest(self):
        rows = self.rows(
            'design = "grid"\n[[factor]]\nkey = "a"\nvalues = [1, 2]\n[[factor]]\nkeys = ["b", "c"]\nvalues = [["x", 1.5], ["y", 2]]\n'
            '[[factor]]\nkey = "d"\nfrom = 0\nto = 1\nsteps = 3\n'
        )
        self.assertEqual(rows["a"], [1] * 6 + [2] * 6)
        self.assertEqual(rows["b"], ["x", "x", "x", "y", "y", "y"] * 2)
        self.assertEqual(rows["c"], [1.5, 1.5, 1.5, 2, 2, 2] * 2)
        self.assertEqual(rows["d"], [0, 0.5, 1] * 4)

    def test_ranges_end_exactly_and_keep_whole_numbers(self):
        self.assertEqual(factors.steps(0.1, 0.7, 7)[-1], 0.7)
        self.assertEqual(factors.steps(2, 8, 4), (2, 4, 6, 8))
        self.assertTrue(all(isinstance(x, int) for x in factors.steps(2, 8, 4)))

    def test_replicates_repeat_each_row_with_the_same_seeds(self):
        rows = self.rows('design = "grid"\nreplicates = 3\n[[factor]]\nkey = "a"\nvalues = [1, 2]\n')
        self.assertEqual(rows["a"], [1, 1, 1, 2, 2, 2])
        self.assertEqual(rows["replicate"], [0, 1, 2] * 2)
        self.assertEqual(rows["render.seed"][:3], rows["render.seed"][3:])
        self.assertEqual(len(set(rows["render.seed"])), 3)

    def test_distributions_have_their_quantiles(self):
        p = np.linspace(0.001, 0.999, 999)
        for mine, known in (
            (factors.truncated_normal(2, 0.5, 3), stats.truncnorm(-3, 3, 2, 0.5)),
            (factors.uniform(1, 4), stats.uniform(1, 3)),
            (factors.triangular(1, 2, 5), stats.triang(0.25, 1, 4)),
            (factors.triangular(1, 1, 5), stats.triang(0, 1, 4)),
        ):
            np.testing.assert_allclose(mine(p), known.ppf(p), rtol=1e-9)
        self.assertLessEqual(np.abs(factors.truncated_normal(0, 1, 3)(np.array([0, 1]))).max(), 3)
        drawn = factors.integers(3, 5)(np.linspace(0, 1, 3001))
        self.assertEqual([int(np.sum(drawn == k)) for k in (2, 3, 4, 5, 6)], [0, 1000, 1000, 1001, 0])

    def test_a_latin_hypercube_has_one_row_in_each_stratum(self):
        rows = self.rows(
            'design = "lhs"\nrows = 50\nseed = 2\n[[factor]]\nkey = "a"\nuniform = { from = 0, to = 50 }\n[[factor]]\nkey = "b"\n'
            "uniform = { from = 0, to = 50 }\n"
        )
        for key in "ab":
            self.assertEqual(sorted(np.floor(rows[key]).astype(int)), list(range(50)))

    def test_seeds_make_other_rows_and_the_same_seed_the_same(self):
        def text(seed, kind):
            factors = '[[factor]]\nkey = "a"\nnormal = { sd = 1 }\n[[factor]]\nkey = "b"\nvalues = [1, 2, 3]\n'
            return f'design = "{kind}"\nrows = 16\nseed = {seed}\n' + factors

        for kind in ("lhs", "sobol", "monte_carlo", "saltelli"):
            self.assertEqual(self.rows(text(1, kind)), self.rows(text(1, kind)))
            self.assertNotEqual(self.rows(text(1, kind)), self.rows(text(2, kind)))

    def test_tied_keys_follow_their_factor(self):
        rows = self.rows(
            'design = "monte_carlo"\nrows = 9\n[[factor]]\nkeys = ["a", "b"]\ntimes = [1, 0.5]\nuniform = { from = 1, to = 2 }\n'
        )
        self.assertEqual([a * 0.5 for a in rows["a"]], rows["b"])

    def test_saltelli_is_two_samples_and_one_with_each_column_of_the_other(self):
        points = design.shares_of("saltelli", 8, 3, 1)
        a, b, mixed = points[:8], points[8:16], points[16:].reshape(3, 8, 3)
        self.assertEqual(points.shape, (40, 3))
        for k in range(3):
            for column in range(3):
                np.testing.assert_array_equal(mixed[k][:, column], (b if k == column else a)[:, column])

    def test_cells_of_a_table(self):
        (self.folder / "rows.csv").write_text('a,b,c,d\n1,x,"[1, 2]",true\n1.5,none,,3\n')
        rows = self.rows('design = "table"\ntable = "rows.csv"\n')
        self.assertEqual(rows, {"a": [1, 1.5], "b": ["x", "none"], "c": [[1, 2], None], "d": [True, 3]})
        self.assertEqual(design.overrides(rows, 1), {"a": 1.5, "b": "none", "d": 3})


if __name__ == "__main__":
    unittest.main()
