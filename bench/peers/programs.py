"""The programs that are compared: which are there, how those that are missing are got, how they are run and timed."""
import functools
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
VENV = ROOT / "build/peers/venv"  # Mitsuba's own
NAMES = {"pov": "POV-Ray", "cycles": "Cycles", "mitsuba": "Mitsuba 3"}
begun = time.monotonic()


def say(text):
    print(f"[{time.monotonic() - begun:6.1f} s] {text}", flush=True)


class Ran:
    """What a command said, and how long it and its children took."""

    def __init__(self, command, folder):
        before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
        done = subprocess.run(list(map(str, command)), cwd=folder, env={**os.environ, "PWD": str(folder)}, capture_output=True, text=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.wall = time.monotonic() - start
        self.processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        self.text, self.good = done.stdout, done.returncode == 0
        if not self.good:
            self.text += done.stderr
            self.why = f"{' '.join(map(str, command))}: {self.text[-1500:]}"


def run(command, folder):
    done = Ran(command, folder)
    if not done.good:
        raise RuntimeError(done.why)
    return done


def works(*command):
    try:
        return subprocess.run(command, capture_output=True).returncode == 0
    except OSError:
        return False


def venv_python():
    return str(VENV / "bin/python3")


@functools.lru_cache(1)
def working_mitsuba():
    """A Python that has Mitsuba and a variant of it that works, or none."""
    test = "import numpy, mitsuba; mitsuba.set_variant('llvm_ad_rgb'); import drjit; drjit.eval(drjit.arange(mitsuba.Float, 4) + 1)"
    return next((python for python in (sys.executable, "python3", venv_python()) if works(python, "-c", test)), None)


def mitsuba_python():
    return working_mitsuba() or venv_python()


def there(peer):
    return {"pov": lambda: shutil.which("povray"), "cycles": lambda: shutil.which("blender"), "mitsuba": working_mitsuba}[peer]()


def install(peer):
    """Says in words why it could not, and goes on."""
    if peer == "mitsuba":
        say(f"Mitsuba 3 is missing: into {VENV.relative_to(ROOT)} by pip")
        made = any(works(python, "-m", "venv", "--clear", str(VENV)) for python in (sys.executable, "python3"))
        if not made or not works(venv_python(), "-m", "pip", "install", "--quiet", "mitsuba", "numpy"):
            say("pip could not install it (no network, or no python3-venv)")
        working_mitsuba.cache_clear()
        return
    package = {"pov": "povray", "cycles": "blender"}[peer]
    command = ["apt-get", "install", "-y", "--no-install-recommends", package]
    if os.geteuid() != 0:
        command = ["sudo", "-n", *command]
    say(f"{NAMES[peer]} is missing: {' '.join(command)}")
    if not works(*command):
        say("apt could not install it (no right to, or no network)")


def find(peers, may_install):
    """Those of the peers that can run."""
    found = []
    for peer in peers:
        if not there(peer) and may_install:
            install(peer)
        if there(peer):
            found.append(peer)
        else:
            say(f"{NAMES[peer]} is not here: left out")
    return found


def version(peer):
    if peer == "pov":
        done = subprocess.run(["povray", "--version"], capture_output=True, text=True)
        return re.search(r"POV-Ray \d[\w.]*|$", done.stdout + done.stderr)[0]
    if peer == "cycles":
        return subprocess.run(["blender", "--version"], capture_output=True, text=True).stdout.split("\n")[0] + ", Cycles"
    return "Mitsuba " + subprocess.run([mitsuba_python(), "-c", "import mitsuba; print(mitsuba.__version__)"], capture_output=True, text=True).stdout.strip()
