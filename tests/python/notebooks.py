"""The notebooks run from top to bottom without an exception, in Jupyter's kernel, in a folder of their own. Usage: notebooks.py TOOLS

What runs them is installed into the folder TOOLS, from PyPI, the first time. Exit code 77 where that is not possible.
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

NOTEBOOKS = pathlib.Path(__file__).resolve().parents[2] / "notebooks"


def install(folder: pathlib.Path) -> bool:
    done = folder / "complete"
    if not done.exists():
        command = [sys.executable, "-m", "pip", "install", "--quiet", "--upgrade", "--target", str(folder), "nbclient", "ipykernel"]
        if subprocess.run(command).returncode != 0:
            return False
        done.touch()
    sys.path.insert(0, str(folder))
    os.environ["PYTHONPATH"] = os.pathsep.join([os.environ["PYTHONPATH"], str(folder)])  # of the kernels
    return True


class Notebooks(unittest.TestCase):
    def test_all(self) -> None:
        import nbclient
        import nbformat

        files = sorted(NOTEBOOKS.glob("*.ipynb"))
        self.assertGreaterEqual(len(files), 4)
        for file in files:
            with self.subTest(file.name), tempfile.TemporaryDirectory(prefix="lfdsim-notebook-") as folder:
                shutil.copy(file, folder)
                notebook = nbformat.read(file, as_version=4)
                nbformat.validate(notebook)
                cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
                self.assertFalse(any(cell.outputs or cell.execution_count for cell in cells), "is kept without outputs")
                nbclient.NotebookClient(notebook, timeout=1200, resources={"metadata": {"path": folder}}).execute()
                shown = {kind for cell in cells for output in cell.outputs for kind in output.get("data", {})}
                self.assertLessEqual({"text/html", "image/png"}, shown, "displays, results and pictures show themselves")


if __name__ == "__main__":
    if not install(pathlib.Path(sys.argv.pop())):
        print("SKIPPED: nbclient and ipykernel cannot be installed from here")
        sys.exit(77)
    unittest.main()
