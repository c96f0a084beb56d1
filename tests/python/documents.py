"""The examples of the documents run, in order, in a folder with the README's tablet.toml."""

import pathlib
import re
import unittest

from tiny import TinyTest

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Documents(TinyTest):
    def test_examples(self) -> None:
        readme = (ROOT / "README.md").read_text()
        tablet = re.search(r"cat > tablet.toml <<END\n(.*?)\nEND\n", readme, re.DOTALL)
        pathlib.Path("tablet.toml").write_text(tablet[1])
        for name in ("README.md", "docs/python.md"):
            examples = re.findall(r"^```python\n(.*?)^```", (ROOT / name).read_text(), re.DOTALL | re.MULTILINE)
            self.assertTrue(examples, name)
            names: dict[str, object] = {}
            for example in examples:
                with self.subTest(name, example=example):
                    exec(compile(example, name, "exec"), names)


if __name__ == "__main__":
    unittest.main()
