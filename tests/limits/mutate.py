#!/usr/bin/python3
"""Which tests notice that a limit of the estimators or of the choice between them (src/engine/estimator/limits.h) is another one?

Changes one limit after the other, compiles the scalar kernel and the engine with it, and runs the tests that keep the bits of
pictures. Prints a line for each limit; exit code 1 if one went unnoticed. Takes about a minute for each; the sources stay as they are.
Usage: tests/limits/mutate.py [--build build/release] [LIMIT...]
"""
import argparse
import json
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
HEADER = "engine/estimator/limits.h"
TESTS = ["FilteredEstimator.KeepsItsBits*", "FilteredExtremes.LightStaysLight", "*HasTheSameBitsEverywhere*", "*OfEveryLatticeAndCamera*", "Choice.KeepsItsBits"]


def limits(text):
    """(name, value, another value) of each limit."""
    found = []
    for kind, declared in re.findall(r"static constexpr (double|int|std::uint32_t) ([^;]+);", text):
        for name, value in re.findall(r"(\w+) = ([^,\s]+)", declared):
            if kind != "double":  # node_step: there is no room for more nodes
                found.append((name, value, str(int(value) * 3 // 2 if name == "node_step" else int(value) // 2)))
            else:
                found.append((name, value, f"{1.5 * float(value):g}"))
    return found


class Engine:
    """The built engine's tests, with some objects made anew."""

    def __init__(self, build):
        self.build = build.resolve()
        self.compile = {}
        for entry in json.loads((build / "compile_commands.json").read_text()):
            source = pathlib.Path(entry["file"])
            text = source.read_text() if "Unity" in source.parts else str(source)
            if source.name == "scalar.cpp" or any(f"src/engine/{name}.cpp" in text for name in ("scene/traced_display", "estimator/choice")):
                self.compile[source.name + ".o"] = entry
        lines = subprocess.run(["ninja", "-C", build, "-t", "commands", "engine_tests"], capture_output=True, text=True, check=True)
        self.link = next(line for line in reversed(lines.stdout.splitlines()) if "-o engine_tests" in line)

    def failures(self, header):
        """Names of the tests that fail with this header: those of the first filter of which any does."""
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder)
            (place / HEADER).parent.mkdir(parents=True)
            (place / HEADER).write_text(header)
            archive = place / "engine.a"
            shutil.copy(self.build / "src/liblfdsim_engine.a", archive)
            for name, entry in self.compile.items():
                words = shlex.split(entry["command"])
                words[words.index("-o") + 1] = str(place / name)
                words = ["-O1" if word == "-O3" else word for word in words]  # quicker to compile, and the same bits
                words.insert(1, f"-I{place}")
                subprocess.run(words, cwd=entry["directory"], check=True)
                subprocess.run(["ar", "r", archive, place / name], check=True)
            program = place / "engine_tests"
            command = self.link.replace("-o engine_tests", f"-o {program}").replace("src/liblfdsim_engine.a", str(archive))
            subprocess.run(command.split(" && ")[1], cwd=self.build, shell=True, check=True)
            for tests in TESTS:
                done = subprocess.run([program, f"--gtest_filter={tests}"], capture_output=True, text=True)
                if failed := sorted(set(re.findall(r"\[  FAILED  \] (\S+?)(?:, where|$| \()", done.stdout))):
                    return failed
            return []


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("limits", nargs="*", metavar="LIMIT")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    arguments = parser.parse_args()
    text = (ROOT / "src" / HEADER).read_text()
    engine = Engine(arguments.build)
    unnoticed = []
    if engine.failures(text):
        sys.exit("these tests fail as the limits are")
    for name, value, other in limits(text):
        if arguments.limits and name not in arguments.limits:
            continue
        changed = re.sub(rf"\b{name} = {re.escape(value)}", f"{name} = {other}", text)
        assert changed != text, name
        failed = engine.failures(changed)
        print(f"{name:16} {value:>6} -> {other:8} {', '.join(failed) or 'NOT NOTICED'}", flush=True)
        unnoticed += [] if failed else [name]
    if unnoticed:
        sys.exit(f"not noticed: {', '.join(unnoticed)}")


main()
