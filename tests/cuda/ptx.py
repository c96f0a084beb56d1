"""The GPU's code without a GPU: compiles for every architecture, computes in single precision where that is meant, and what a sample
costs. Usage: ptx.py NVCC SOURCE_DIR [--full]; exit code 77: skipped, no nvcc. Without --full it compiles for the oldest alone and, where
nvcc can, with little optimisation: that takes a fifth of the time, and registers and instructions are then more than those of a build."""

import pathlib
import re
import subprocess
import sys
import tempfile

ARCHITECTURES = [75, 86, 90]
SPECIALISATIONS = ["paper_plain", "paper_plain_schlick", "paper", "paper_strips", "paper_staggered", "opaque", "ideal", "lit_between", "others"]


def functions(ptx):
    """Name -> body of each function in PTX text."""
    parts = re.split(r"\n(?=(?:\.visible |\.weak |\.extern )?\.(?:entry|func) )", ptx)
    named = {}
    for part in parts:
        match = re.match(r"(?:\.\w+ )?\.(?:entry|func)\s+(?:\([^)]*\)\s*)?([\w$]+)", part)
        if match and "{" in part:
            named[match[1]] = part
    return named


def loop_of(body):
    """Instructions of the longest loop: that over samples."""
    lines = [line.strip() for line in body.splitlines()]
    labels = {line[:-1]: i for i, line in enumerate(lines) if re.fullmatch(r"\$L\w+:", line)}
    jumps = [(labels.get(match[1], i), i) for i, line in enumerate(lines) if (match := re.search(r"\bbra\S*\s+(\$L\w+);", line))]
    first, last = max(jumps, key=lambda jump: jump[1] - jump[0])
    return [line for line in lines[first:last + 1] if line and not line.startswith((".", "//", "{", "}", "$", ")"))]


def main():
    nvcc, source = sys.argv[1], pathlib.Path(sys.argv[2])
    if not nvcc or nvcc.endswith("NOTFOUND"):
        print("SKIPPED: no CUDA toolkit (nvcc)")
        return 77
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder)
        base = [nvcc, "-std=c++20", "--fmad=false", "-O3", f"-I{source / 'src'}", "-DLFDSIM_ISA=cuda", "-Werror", "all-warnings"]
        if "--full" not in sys.argv and "--Ofast-compile" in subprocess.run([nvcc, "--help"], capture_output=True, text=True, check=True).stdout:
            base += ["--Ofast-compile", "min"]
        ptx = out / "probe.ptx"
        subprocess.run([*base, "-arch=compute_75", "-ptx", str(source / "tests/cuda/probe.cu"), "-o", str(ptx)], check=True)
        for arch in ARCHITECTURES if "--full" in sys.argv else ARCHITECTURES[:1]:  # as a driver does, from the same PTX
            made = subprocess.run([nvcc, f"-arch=sm_{arch}", "-Werror", "all-warnings", "-Xptxas", "-v", "-cubin", str(ptx), "-o", str(out / "probe.cubin")],
                                  capture_output=True, text=True)
            if made.returncode != 0:
                faults.append(f"sm_{arch} does not compile:\n{made.stderr}")
                continue
            used = re.findall(r"Compiling entry function 'probe_(\w+)'.*?(\d+) bytes spill stores.*?Used (\d+) registers", made.stderr, re.S)
            if sorted(name for name, _, _ in used) != sorted(SPECIALISATIONS):
                faults.append(f"sm_{arch}: kernels missing: {used}")
            for name, spilled, registers in used:
                print(f"sm_{arch} {name}: {registers} registers, {spilled} bytes spilled")
        found = functions(ptx.read_text())
        for name in SPECIALISATIONS:
            if f"probe_{name}" not in found:
                faults.append(f"no kernel probe_{name} in the PTX")
                continue
            loop = loop_of(found[f"probe_{name}"])
            divisions, roots = (sum(any(t in line for t in texts) for line in loop)
                                for texts in (("div.rn", "rcp.rn", "rcp.approx"), ("sqrt.rn", "rsqrt.approx")))
            print(f"PTX of a sample, {name}: {len(loop)} instructions in all branches, {divisions} divisions, {roots} roots")
        for name, body in found.items():
            doubles = [line.strip() for line in body.splitlines() if ".f64" in line and not line.strip().startswith(".")]
            own = re.sub(r"// begin inline asm.*?// end inline asm", "", body, flags=re.S)  # divisions' and roots' are meant
            fused = [line.strip() for line in own.splitlines() if re.search(r"\bfma\.", line)]
            # A camera with a pupil or a pixel filter takes the view's doubles to single precision, away from the other samples.
            if doubles and "displaced" not in name:
                faults.append(f"{name}: double precision, as in {doubles[0]}")
            if fused:
                faults.append(f"{name}: contracted, as in {fused[0]}: not the CPU's bits")
    for fault in faults:
        print("FAILED:", fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
