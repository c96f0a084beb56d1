"""A full disk is exit code 1 and leaves no partial file. Needs the right to mount a small one."""
import os
import subprocess

from program import Checks, Program, skip

if os.geteuid() != 0:
    skip("only root can mount a small disk")
program, checks = Program(), Checks()
disk = program.folder / "disk"
disk.mkdir()
mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=16k", "tmpfs", str(disk)], capture_output=True, text=True)
if mounted.returncode:
    skip(f"no disk could be mounted: {mounted.stderr.strip()}")
try:
    for kind in ["npy", "exr", "png --bits 16"]:
        checks.refused(program, kind, f"render tiny.toml --panel-image panel.png --size 400x300 --progress none -o disk/out.{kind}", "No space left", code=1)
        checks.that(not list(disk.iterdir()), f"{kind}: left {list(disk.iterdir())}")
finally:
    subprocess.run(["umount", str(disk)], check=True)
checks.finish()
