"""What is kept is what was computed: changed files, other studies' folders and torn journals are noticed."""

import json
import shutil
import unittest

import pyarrow as pa
import pyarrow.parquet as pq

from common import StudyTest

import lfdsim
from lfdsim import study
from lfdsim.study import StudyError, chunk, files, planned


def change_a_number(path):
    """As a person would do it by hand, all else of the file as it was."""
    table = pq.read_table(path, partitioning=None)
    name = "check.theory.central_depth_mm"
    values = table[name].to_pylist()
    changed = table.set_column(table.column_names.index(name), name, pa.array([values[0] + 1e-9, *values[1:]]))
    pq.write_table(changed.replace_schema_metadata(table.schema.metadata), path)


class Kept(StudyTest):
    def setUp(self):
        super().setUp()
        self.file, self.out = self.lhs(8), self.folder / "out"

    def run_it(self, **more):
        return study.run(self.file, self.out, workers=1, progress=False, **more)

    def test_a_finished_study_is_not_computed_again(self):
        first = self.run_it()
        times = {p: p.stat().st_mtime_ns for p in self.out.rglob("*")}
        self.assertTrue(first.equals(self.run_it()))
        self.assertEqual(times, {p: p.stat().st_mtime_ns for p in self.out.rglob("*")})

    def test_figures_that_a_finished_study_is_asked_for_later(self):
        self.run_it()
        text = self.file.read_text()
        self.file.write_text(text + '[[limit]]\nfigure = "check.theory.fov_deg"\nmin = 1\n')
        self.assertIn("check.theory.fov_deg", self.run_it().columns)
        self.file.write_text(text + '[[limit]]\nfigure = "check.theory.fovv_deg"\nmin = 1\n')
        with self.assertRaisesRegex(StudyError, '"check.theory.fovv_deg" is not a figure; did you mean'):
            self.run_it()

    def test_planning_that_was_stopped_goes_on(self):
        whole = files.write_whole
        self.addCleanup(setattr, files, "write_whole", whole)
        for stop in ("plan.parquet", "study.toml", "plan.json"):

            def stopped(path, content, stop=stop):
                if path.name == stop:
                    raise KeyboardInterrupt
                whole(path, content)

            files.write_whole = stopped
            with self.assertRaises(KeyboardInterrupt):
                study.plan(self.file, self.out)
            files.write_whole = whole
            study.plan(self.file, self.out)
            shutil.rmtree(self.out)

    def test_pictures_and_curves_of_another_study_are_not_written_over(self):
        for name in ("pictures.zarr", "curves"):
            (self.out / name).mkdir(parents=True)
            with self.assertRaisesRegex(StudyError, f"{name}: exists and is no file of this study"):
                study.plan(self.file, self.out)
            shutil.rmtree(self.out)

    def test_only_the_missing_chunk_is_computed(self):
        first = self.run_it()
        (self.out / "study.parquet").unlink()
        (self.out / "rows" / "chunk-000001.parquet").unlink()
        times = {p: p.stat().st_mtime_ns for p in (self.out / "rows").iterdir()}
        self.assertTrue(first.equals(self.run_it()))
        self.assertEqual(times, {p: p.stat().st_mtime_ns for p in times})

    def test_a_chunk_or_table_changed_by_hand_is_refused(self):
        self.run_it()
        change_a_number(self.out / "study.parquet")
        with self.assertRaisesRegex(StudyError, "study.parquet: was changed by hand.*remove it"):
            self.run_it()
        (self.out / "study.parquet").unlink()
        change_a_number(self.out / "rows" / "chunk-000001.parquet")
        with self.assertRaisesRegex(StudyError, "chunk-000001.parquet: was changed by hand.*remove this file"):
            self.run_it()
        (self.out / "rows" / "chunk-000001.parquet").unlink()
        self.run_it()

    def test_a_chunk_of_another_place_or_cut_off_is_refused(self):
        self.run_it()
        (self.out / "study.parquet").unlink()
        chunks = self.out / "rows"
        shutil.copy(chunks / "chunk-000000.parquet", chunks / "chunk-000001.parquet")
        with self.assertRaisesRegex(StudyError, "chunk-000001"):
            self.run_it()
        whole = (chunks / "chunk-000000.parquet").read_bytes()
        (chunks / "chunk-000001.parquet").write_bytes(whole[: len(whole) // 2])
        with self.assertRaisesRegex(StudyError, "chunk-000001"):
            self.run_it()

    def test_a_plan_changed_by_hand_is_refused(self):
        study.plan(self.file, self.out)
        table = pq.read_table(self.out / "plan.parquet")
        pq.write_table(
            table.set_column(0, "array.gap_mm", pa.array([16.0] * 8)).replace_schema_metadata(table.schema.metadata),
            self.out / "plan.parquet",
        )
        with self.assertRaisesRegex(StudyError, "plan.parquet: was changed by hand"):
            self.run_it()

    def test_a_folder_of_another_study_is_refused_naming_the_difference(self):
        self.run_it()
        text = self.file.read_text()
        for old, new, said in (
            ("rows = 8", "rows = 9", "differs in: rows"),
            ("sd = 0.05", "sd = 0.06", "differs in: factor"),
            ("rows_per_chunk = 3", "rows_per_chunk = 4", "is in chunks of 3"),
        ):
            self.write(text.replace(old, new))
            with self.assertRaisesRegex(StudyError, said):
                self.run_it()
        self.write(text)
        display = self.folder / "display.toml"
        display.write_text(display.read_text().replace("1000.0]", "1001.0]"))
        with self.assertRaisesRegex(StudyError, "differs in: display"):
            self.run_it()

    def test_comments_limits_and_wishes_may_change(self):
        first = self.run_it()
        self.write(
            self.file.read_text().replace('"theory.fov_exact_deg"', '"theory.views"') + "# a comment\n[[limit]]\n"
            'figure = "check.theory.central_depth_mm"\nmin = 3\n'
        )
        second = self.run_it()
        self.assertIn("check.theory.views", second)
        self.assertNotIn("check.theory.fov_exact_deg", second)
        self.assertTrue(first["check.theory.central_depth_mm"].equals(second["check.theory.central_depth_mm"]))

    def test_an_unknown_figure_is_refused_and_costs_no_row(self):
        self.write(self.file.read_text().replace("fov_exact_deg", "fov_exact"))
        with self.assertRaisesRegex(StudyError, "theory.fov_exact.*is not a figure of check; did you mean theory.fov_exact_deg"):
            self.run_it()
        self.write(self.file.read_text().replace("fov_exact", "views") + '[[limit]]\nfigure = "check.theory.gap_mmm"\nmin = 1\n')
        with self.assertRaisesRegex(StudyError, "gap_mmm.*is not a figure; did you mean check.theory.gap_mm"):
            self.run_it()
        done = {p.name: p.stat().st_mtime_ns for p in (self.out / "rows").glob("*.parquet")}
        self.assertTrue(done)
        self.lhs(8)
        self.run_it()
        self.assertEqual(done, {n: (self.out / "rows" / n).stat().st_mtime_ns for n in done})

    def test_a_model_that_changed_makes_another_study(self):
        model = self.folder / "model.obj"
        model.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        display = self.folder / "display.toml"
        display.write_text(display.read_text() + 'model = "model.obj"\n')
        self.run_it()
        model.write_text("v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n")
        with self.assertRaisesRegex(StudyError, "differs in: files"):
            self.run_it()

    def test_what_a_model_names_counts_as_much(self):
        model, material = self.folder / "parts" / "model.obj", self.folder / "parts" / "red.mtl"
        model.parent.mkdir()
        material.write_text("newmtl m\nKd 0.8 0.1 0.1\n")
        model.write_text("mtllib red.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n")
        (self.folder / "rows.csv").write_text("content.model\nparts/model.obj\n")
        self.write('schema = 1\ndisplay = "display.toml"\ndesign = "table"\ntable = "rows.csv"\n[[measure]]\nname = "check"\n')
        study.plan(self.file, self.out)
        study.plan(self.file, self.out)  # the same study
        material.write_text("newmtl m\nKd 0.1 0.1 0.8\n")
        with self.assertRaisesRegex(StudyError, "red.mtl: has changed since"):
            study.run_part(self.out, 0, 1)
        with self.assertRaisesRegex(StudyError, "differs in: files"):
            study.plan(self.file, self.out)

    def test_models_are_looked_at_by_whoever_computes(self):
        """An array job's tasks, or a machine where the model is another or missing: its rows would be others, or called impossible."""
        model = self.folder / "model.obj"
        model.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        (self.folder / "rows.csv").write_text("content.model\nmodel.obj\n")
        self.write('schema = 1\ndisplay = "display.toml"\ndesign = "table"\ntable = "rows.csv"\n[[measure]]\nname = "check"\n')
        study.plan(self.file, self.out)
        model.write_text("v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n")
        with self.assertRaisesRegex(StudyError, "model.obj: has changed since"):
            study.run_part(self.out, 0, 1)
        model.unlink()
        with self.assertRaisesRegex(StudyError, "model.obj: cannot be read"):
            study.run_part(self.out, 0, 1)
        self.assertFalse(list((self.out / "rows").iterdir()))

    def test_another_version_is_refused(self):
        self.run_it()
        mine = lfdsim.__version__
        self.addCleanup(setattr, lfdsim, "__version__", mine)
        lfdsim.__version__ = "0.0.0"
        with self.assertRaisesRegex(StudyError, "version"):
            self.run_it()

    def test_rows_of_a_journal_are_used_but_torn_and_foreign_lines_are_not(self):
        plan = study.plan(self.file, self.out)
        whole = study.run(self.file, self.folder / "other", workers=1, progress=False)
        journal = chunk._Journal(plan, 0)
        for row in range(3):
            journal.add(chunk._compute(plan, row, chunk.overrides_of(plan, row), 1))
        journal.close()
        lines = journal.path.read_bytes().splitlines(keepends=True)
        record = json.loads(lines[1].partition(b" ")[2])
        forged = record | {"figures": {k: v + 1 for k, v in record["figures"].items() if isinstance(v, float)}}
        journal.path.write_bytes(lines[0] + lines[1][:9] + json.dumps(forged).encode() + b"\n" + lines[2][:-20])
        computed = []
        original = chunk._compute
        self.addCleanup(setattr, chunk, "_compute", original)
        chunk._compute = lambda plan, row, *more: computed.append(row) or original(plan, row, *more)
        chunk.run(plan, 0, 1)
        self.assertEqual(computed, [1, 2])
        self.assertFalse(list((self.out / "rows").glob("*.journal")))
        self.assertTrue(whole.equals(self.run_it()))

    def test_damaged_plans_are_told(self):
        self.run_it()
        path = self.out / "plan.json"
        whole = path.read_text()
        for old, new in (
            ('"rows": 8', '"rows": "8"'),
            ('"rows": 8', '"rows": -8'),
            ('"rows": 8', '"rows": 9'),
            ('"rows_per_chunk": 3', '"rows_per_chunk": 0'),
            ('"rows_per_chunk": 3', '"rows_per_chunk": 2'),
            ('"seed": 5', '"seed": 6'),
            ('"version"', '"vision"'),
            ("focal_length_mm = 15.7", "focal_length_mm = 16.7"),
            ("display_folder\": \"/", "display_folder\": \"/other/"),
            ('"name": "study"', '"name": "other"'),
            ('"format": 2', '"format": 1'),
        ):
            with self.subTest(new):
                self.assertIn(old, whole)
                path.write_text(whole.replace(old, new))
                for work in (self.run_it, lambda: planned.load(self.out), lambda: study.run_part(self.out, 0, 1)):
                    with self.assertRaises(StudyError):
                        work()
        for damaged in ("", "{}", "[]", '{"basis": []}', "[" * 100_000, whole[:100], b"\xff\xfe"):
            with self.subTest(damaged[:20]):
                path.write_bytes(damaged if isinstance(damaged, bytes) else damaged.encode())
                for work in (self.run_it, lambda: planned.load(self.out)):
                    with self.assertRaisesRegex(StudyError, "plan.json: is not the plan of a study, or damaged"):
                        work()
        with self.assertRaisesRegex(StudyError, "holds no study"):
            planned.load(self.folder / "nowhere")


if __name__ == "__main__":
    unittest.main()
