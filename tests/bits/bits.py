#!/usr/bin/python3
"""Whether lfdsim still writes the same: hashes of small pictures and of data, and texts, against those that are kept beside this script.

Usage: bits.py PROGRAM [--quick] [--only PATTERN ...] [--write] [--against OTHER_PROGRAM] [--keep FOLDER] [--commands]
Prints a line for each difference, of texts the lines that differ; exit code 1 if there is any. README.md says when to use it.
"""
import argparse
import base64
import concurrent.futures
import difflib
import fnmatch
import hashlib
import io
import os
import pathlib
import re
import shlex
import struct
import subprocess
import sys
import tempfile
import time
import zlib

import numpy as np

import cases

HERE = pathlib.Path(__file__).resolve().parent
HASHES, TEXTS = ("pictures", "data"), ("help", "check", "messages")
# What may differ from run to run, in all that is text.
SUBSTITUTIONS = [
    (r'"(seconds|mrays_per_s)": [-+.e0-9]+', r'"\1": 0'),
    (r'; measured in [^<]*</p>', '</p>'),
    (r'("lfdsim": "|by lfdsim |<th scope="row">lfdsim</th><td>)[0-9]+(\.[0-9]+)+', r'\1VERSION'),
]


def processor():
    """What Embree picks its code by, and whose approximations it starts from."""
    try:
        words = dict(re.findall(r"^(vendor_id|flags)\s*: (.*)$", pathlib.Path("/proc/cpuinfo").read_text().split("\n\n")[0], re.M))
    except OSError:
        return "unknown"
    widest = next((name for name in ("avx512f", "avx2", "avx") if name in words.get("flags", "").split()), "sse")
    return f"{words.get('vendor_id', 'unknown')} {widest}"


def noise(size):
    """Light of a panel: noise of single pixels on noise of squares of 8. The bits of PCG64 are the same in every NumPy."""
    columns, rows = size
    bits = np.random.PCG64(48)
    fine = bits.random_raw(rows * columns * 3).reshape(rows, columns, 3) >> np.uint64(56)
    coarse = bits.random_raw((rows // 8 + 1) * (columns // 8 + 1) * 3).reshape(rows // 8 + 1, columns // 8 + 1, 3) >> np.uint64(56)
    coarse = np.repeat(np.repeat(coarse, 8, axis=0), 8, axis=1)[:rows, :columns]
    return ((fine + coarse) / 510).astype(np.float32)


def png_pixels(file):
    """A PNG's header and filtered rows, which do not depend on zlib's version."""
    at, rows = 8, b""
    while at < len(file):
        (length,), kind = struct.unpack(">I", file[at:at + 4]), file[at + 4:at + 8]
        if kind == b"IHDR":
            header = file[at + 8:at + 8 + length]
        elif kind == b"IDAT":
            rows += file[at + 8:at + 8 + length]
        at += 12 + length
    return header + zlib.decompress(rows)


def hashed(content):
    return hashlib.sha256(content).hexdigest()[:16]


def comparable(name, content):
    """The content without what differs from run to run."""
    if name.endswith(".png"):
        return png_pixels(content)
    if name.endswith((".npy", ".exr", ".ply")):
        return content
    text = content.decode()
    for pattern, replacement in SUBSTITUTIONS:
        text = re.sub(pattern, replacement, text)
    text = re.sub(r"data:image/png;base64,([A-Za-z0-9+/=]+)", lambda found: "PNG:" + hashed(png_pixels(base64.b64decode(found[1]))), text)
    return text.encode()


class Program:
    def __init__(self, path, folder):
        self.path, self.folder = pathlib.Path(path).resolve(), folder
        self.failed = []  # (case, why)
        folder.mkdir(parents=True)
        kept = {name: value for name, value in os.environ.items() if not name.startswith("LFDSIM_")}
        self.environment = kept | {"LFDSIM_DEVICE": "cpu", "LC_ALL": "C"}
        if options.kernel:
            self.environment["LFDSIM_KERNEL"] = options.kernel

    def prepare(self, chosen):
        """Descriptions and panels, under names relative to the folder: no file then tells where it was made."""
        (self.folder / "displays").symlink_to(cases.ROOT / "displays")
        (self.folder / "cases").mkdir()
        (self.folder / "base.toml").write_text(cases.toml(cases.BASE))
        for size in {case.panel for case in chosen if case.panel}:
            np.save(self.folder / f"noise-{size[0]}x{size[1]}.npy", noise(size))
        for case in chosen:
            if isinstance(case.display, dict):
                (self.folder / self.description(case)).write_text(cases.toml(case.display))

    @staticmethod
    def description(case):
        return f"displays/{case.display}.toml" if isinstance(case.display, str) else f"cases/{case.name.replace('/', '-')}.toml"

    def command(self, case):
        names = {"DISPLAY": self.description(case), "PANEL": "noise-{}x{}.npy".format(*case.panel or (0, 0))}
        return [names.get(word, word.replace("FOLDER", f"out/{case.name}")) for word in case.words]

    def name(self, case):
        """What a case is kept by: its name, of texts its command line."""
        return shlex.join(["lfdsim", *self.command(case)]) if case.kind in TEXTS else case.name

    def run(self, case):
        """{name: content} of all that the case writes, standard output among it."""
        out = self.folder / "out" / case.name
        out.mkdir(parents=True)
        words = self.command(case)
        done = subprocess.run(["lfdsim", *words], executable=self.path, cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL,
                              capture_output=True, timeout=600)
        if done.returncode and case.kind not in TEXTS:
            self.failed.append((case.name, f"exit code {done.returncode}\n{shlex.join(['lfdsim', *words])}\n{done.stderr.decode()}"))
            return {}
        said = done.stdout + (done.stderr if case.kind in TEXTS else b"")
        files = {f":{file.relative_to(out)}": file.read_bytes() for file in sorted(out.rglob("*")) if file.is_file()}
        if case.kind == "pictures":
            (picture,) = files.values()
            return {"": picture}
        if case.kind in TEXTS and done.returncode:
            said += f"(exit code {done.returncode})\n".encode()
        return {name: comparable(name, content) for name, content in (files | ({"": said} if said else {})).items()}

    def run_all(self, chosen):
        """{case or case:file: content}"""
        self.prepare(chosen)
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            return {self.name(case) + name: content for case, found in zip(chosen, pool.map(self.run, chosen)) for name, content in found.items()}


class Hashes:
    """A file of hashes: a line for each case, or for each file of a case; first the processor of those that depend on it."""

    def __init__(self, kind):
        self.file = HERE / f"{kind}.txt"
        lines = self.file.read_text().splitlines() if self.file.exists() else []
        self.processor = lines[0].rpartition(": ")[2] if lines else processor()
        self.kept = dict(reversed(line.split()) for line in lines[1:])

    def write(self):
        head = f"# What bits.py keeps. Where Embree traces rays it is that of this processor: {self.processor}"
        self.file.write_text("\n".join([head, *(f"{kept}  {name}" for name, kept in sorted(self.kept.items()))]) + "\n")

    def differences(self, found, done):
        """Of names that are kept, or found, of the cases that were run."""
        for name in sorted(found.keys() | {name for name in self.kept if name.split(":")[0] in done}):
            if name not in found:
                yield name, "is no longer written"
            elif self.kept.get(name) != hashed(found[name]):
                yield name, "is another one" if name in self.kept else "is new"

    def renew(self, found, done, all_of_them):
        self.kept = {name: kept for name, kept in self.kept.items() if not all_of_them and name.split(":")[0] not in done}
        self.kept |= {name: hashed(content) for name, content in found.items()}
        self.write()


class Texts:
    """A file of texts, each after the command line that writes it."""

    def __init__(self, kind):
        self.file = HERE / "text" / f"{kind}.txt"
        parts = re.split(r"^\$\$ (.*)\n", self.file.read_text() if self.file.exists() else "", flags=re.M)
        self.kept = dict(zip(parts[1::2], parts[2::2]))

    def differences(self, found, done):
        for name in sorted(found.keys() | (self.kept.keys() & done)):
            before, now = self.kept.get(name, ""), found.get(name, b"").decode()
            if before != now:
                yield name, "\n" + diff(name, before.encode(), now.encode())

    def renew(self, found, done, all_of_them):
        self.kept = {} if all_of_them else self.kept
        self.kept |= {name: content.decode() for name, content in found.items()}
        self.file.parent.mkdir(exist_ok=True)
        self.file.write_text("".join(f"$$ {name}\n{text}" for name, text in sorted(self.kept.items())))


def diff(name, before, after):
    """The lines that differ, or of pictures how far they are apart."""
    if before.startswith(b"\x93NUMPY"):
        a, b = (np.load(io.BytesIO(content)) for content in (before, after))
        if a.shape != b.shape:
            return f"{a.shape} and {b.shape}"
        return f"{np.count_nonzero(a != b)} of {a.size} values, by up to {np.abs(a - b).max():.3g}"
    try:
        lines = [content.decode().splitlines() for content in (before, after)]
    except UnicodeDecodeError:
        return "other bytes"
    return "\n".join(line[:400] for line in list(difflib.unified_diff(*lines, lineterm="", n=0))[2:80])


def between(before, now):
    """Differences between what two builds write."""
    for name in sorted(before.keys() | now.keys()):
        if name not in before or name not in now:
            yield name, "only " + ("this build writes it" if name in now else "the other build writes it")
        elif before[name] != now[name]:
            yield name, "\n" + diff(name, before[name], now[name])


def main():
    begun, chosen = time.monotonic(), [case for case in cases.all_cases() if not options.quick or case.quick]
    if options.only:
        chosen = [case for case in chosen if any(fnmatch.fnmatch(case.name, f"*{pattern}*") for pattern in options.only)]
    keeps = {kind: (Hashes if kind in HASHES else Texts)(kind) for kind in HASHES + TEXTS}
    apart = [case.name for case in chosen if case.embree and keeps[case.kind].processor != processor()]
    if apart and not options.against and not options.write:
        print(f"left out on this processor ({processor()}), as Embree traces their rays: {len(apart)} cases; --against compares them")
        chosen = [case for case in chosen if case.name not in apart]
    with tempfile.TemporaryDirectory(prefix="lfdsim-bits-") as temporary:
        folder = pathlib.Path(options.keep or temporary)
        program = Program(options.program, folder / "now")
        if options.commands:
            print(*(shlex.join(["lfdsim", *program.command(case)]) for case in chosen), sep="\n")
            return 0
        found, differences = program.run_all(chosen), program.failed
        if options.against:
            differences += list(between(Program(options.against, folder / "before").run_all(chosen), found))
        for kind, kept in keeps.items() if not options.against else ():
            done = {program.name(case) for case in chosen if case.kind == kind}
            if not options.only and not options.quick:  # what is kept of cases that are no more
                done |= {name.split(":")[0] for name in kept.kept} - {program.name(case) for case in cases.all_cases()}
            these = {name: content for name, content in found.items() if name.split(":")[0] in done}
            differences += kept.differences(these, done)
            if options.write:
                kept.renew(these, done, not options.only and not options.quick)
    for name, what in differences:
        print(f"{name}: {what}")
    if differences and not options.write and not options.against:
        print("how they differ: --against another build of lfdsim; if they should: --write")
    print(f"{len(chosen)} cases, {len(found)} pictures, files and texts: {len(differences) or 'none'} differ"
          f"{' and are kept now' if options.write else ''}; {time.monotonic() - begun:.1f} s")
    return 1 if differences and not options.write else 0


parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
parser.add_argument("program", help="lfdsim as built")
parser.add_argument("--quick", action="store_true", help="the cases that are quick, as ./test runs them")
parser.add_argument("--only", nargs="+", metavar="PATTERN", help="cases with this in their names")
parser.add_argument("--write", action="store_true", help="keep what is found")
parser.add_argument("--against", metavar="PROGRAM", help="compare with another build in place of what is kept; also shows how data differ")
parser.add_argument("--keep", metavar="FOLDER", type=pathlib.Path, help="leave all files in this new folder")
parser.add_argument("--commands", action="store_true", help="print the command lines only")
parser.add_argument("--kernel", help="instruction set; all give the same bits")
parser.add_argument("--jobs", type=int, default=1)
options = parser.parse_args()
sys.exit(main())
