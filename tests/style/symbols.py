"""No kernel shares a function with the rest of the program, and none contracts a product and a sum.

The kernel's source is compiled once per instruction set, and the linker keeps one copy of each weak symbol: were a function shared, an
old machine could meet AVX-512 code in it. So each weak symbol of kernel ISA must sit in a namespace called ISA. Looked at are the
objects of the build and, since optimisation inlines most such functions away, the scalar one compiled without it and with few specialisations:
the source is the same for all. Contracted sums (fused multiply and add), which not every instruction set has, would round differently.

Usage: symbols.py BUILD_DIRECTORY
"""

import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile


def foreign(kernel, isa):
    """Weak symbols of an object outside the namespace. Data is the same on every instruction set: DW.ref.* of exception tables, template arguments."""
    names = subprocess.run(["nm", "-C", kernel], capture_output=True, text=True, check=True).stdout
    weak = re.findall(r"^[0-9a-f ]{16} [WVu] (.*)", names, re.MULTILINE)
    return [name for name in weak if f"::{isa}::" not in name and not name.startswith(("DW.ref.", "template parameter object"))]


def contracted(kernel):
    """How many instructions multiply and add in one."""
    code = subprocess.run(["objdump", "-d", "--no-show-raw-insn", kernel], capture_output=True, text=True, check=True).stdout
    return len(re.findall(r"\tvfn?m(?:add|sub)", code))


build = pathlib.Path(sys.argv[1])
checked = bad = fused = 0
for command in json.loads((build / "compile_commands.json").read_text()):
    found = re.search(r"-o (\S*kernel_(\w+)\.dir\S+)", command["command"])
    if not found:
        continue
    built, isa = build / found[1], found[2]
    with tempfile.NamedTemporaryFile(suffix=".o") as unoptimised:
        kernels = [built]
        if isa == "scalar":
            subprocess.run(shlex.split(command["command"]) + ["-O0", "-DLFDSIM_FEW_SPECIALISATIONS", "-o", unoptimised.name], cwd=command["directory"], check=True)
            kernels.append(unoptimised.name)
        for kernel in kernels:
            checked += 1
            count = contracted(kernel)
            if count:
                fused += count
                print(f"{isa}: {count} contracted sums")
            for name in foreign(kernel, isa):
                bad += 1
                print(f"{isa}: {name}" + (" (without optimisation)" if kernel == unoptimised.name else ""))
print(f"{checked} objects, {bad} weak symbols outside their kernel's namespace, {fused} contracted sums")
sys.exit(bad > 0 or fused > 0 or checked == 0)
