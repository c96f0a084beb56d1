"""The programs that are compared: which are installed, how missing ones are installed, how they are run and timed."""
import contextlib
import functools
import glob
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
VENV = ROOT / "build/peers/venv"  # Mitsuba's own
NAMES = {"pov": "POV-Ray", "cycles": "Cycles", "mitsuba": "Mitsuba 3"}
begun = time.monotonic()
failed = {}  # renderers that failed, and how; they are left out from then on


def say(text):
    print(f"[{time.monotonic() - begun:6.1f} s] {text}", flush=True)


class Ran:
    """A command's output, and how long it and its children took."""

    def __init__(self, command, folder):
        before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
        done = subprocess.run(list(map(str, command)), cwd=folder, env={**os.environ, "PWD": str(folder)}, capture_output=True, text=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.wall = time.monotonic() - start
        self.processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        self.text, self.good = done.stdout, done.returncode == 0
        if not self.good:
            self.text += done.stderr
            self.how = f"ended by {signal.Signals(-done.returncode).name}" if done.returncode < 0 else f"exit code {done.returncode}"
            self.why = f"{' '.join(map(str, command))}: {self.how}: {self.text[-1500:]}"


def run(command, folder):
    done = Ran(command, folder)
    if not done.good:
        raise RuntimeError(done.why)
    return done


class PeerFailed(Exception):
    """A renderer ended by a signal or with an error, or left no picture."""


def run_peer(command, folder, picture):
    done = Ran(command, folder)
    if not done.good:
        say(done.why)
        raise PeerFailed(done.how)
    if not picture.is_file():
        raise PeerFailed(f"left no {picture.name}")
    return done


@contextlib.contextmanager
def going_on(peer):
    """A renderer may fail within this: the failure is recorded, and the others go on. A failure of lfdsim itself ends the run."""
    try:
        yield
    except PeerFailed as error:
        failed[peer] = str(error)
        say(f"{NAMES[peer]} failed ({error}) and is left out from here on")


def failed_row(peer, why, columns):
    """The table row of a renderer that failed."""
    return f"| {NAMES[peer]} | failed: {why} " + "| " * (columns - 2) + "|"


def works(*command, env={}):
    try:
        return subprocess.run(command, capture_output=True, env={**os.environ, **env}).returncode == 0
    except OSError:
        return False


def venv_python():
    return str(VENV / "bin/python3")


def llvms():
    """The LLVM libraries to try for Mitsuba, as DRJIT_LIBLLVM_PATH takes them: the one that it chooses (""), then the newest. LLVM 15, the newest that Debian 12
    installs by itself, crashes on processors that it does not know, as those of the Zen 5 family. What the user names is taken alone."""
    if named := os.environ.get("DRJIT_LIBLLVM_PATH"):
        return [named]
    numbers = lambda path: [int(number) for number in re.findall(r"\d+", pathlib.Path(path).name)]
    paths = [path for pattern in ("/usr/lib/*-linux-gnu/libLLVM*.so*", "/usr/lib/llvm-*/lib/libLLVM*.so*") for path in sorted(glob.glob(pattern))]
    newer = {numbers(path)[0]: path for path in paths if numbers(path) and numbers(path)[0] > 15}
    return ["", *(newer[number] for number in sorted(newer, reverse=True))]


# Renders a picture, since an LLVM that does not support the processor fails only in the code of a whole renderer.
PROBE = """import numpy, mitsuba as m
m.set_variant('llvm_ad_rgb')
scene = m.load_dict({'type': 'scene', 'integrator': {'type': 'path'}, 'emitter': {'type': 'constant'}, 'shape': {'type': 'sphere', 'bsdf': {'type': 'dielectric'}},
                     'sensor': {'type': 'perspective', 'to_world': m.ScalarTransform4f().look_at([0, 0, 5], [0, 0, 0], [0, 1, 0]),
                                'film': {'type': 'hdrfilm', 'width': 16, 'height': 16}}})
assert numpy.isfinite(numpy.array(m.render(scene, spp=4))).all()"""


@functools.lru_cache(1)
def working_mitsuba():
    """A Python that has Mitsuba and an LLVM with which it makes a picture, or none. The LLVM is then that of all that runs from here."""
    for python in (sys.executable, "python3", venv_python()):
        if not works(python, "-c", "import numpy, mitsuba"):
            continue
        for library in llvms():
            if works(python, "-c", PROBE, env={"DRJIT_LIBLLVM_PATH": library} if library else {}):
                if library:
                    os.environ["DRJIT_LIBLLVM_PATH"] = library
                    say(f"Mitsuba uses {library}")
                return python
            say(f"Mitsuba of {python} makes no picture with {library or 'the LLVM that it chooses'}")
    return None


def mitsuba_python():
    return working_mitsuba() or venv_python()


def there(peer):
    return {"pov": lambda: shutil.which("povray"), "cycles": lambda: shutil.which("blender"), "mitsuba": working_mitsuba}[peer]()


NEWER_LLVM = "libllvm19"  # of Debian 12


def as_root(*command):
    return command if os.geteuid() == 0 else ("sudo", "-n", *command)


def install(peer):
    """Installs a renderer; if that fails, prints why and goes on."""
    if peer == "mitsuba":
        say(f"Mitsuba 3 is missing: into {VENV.relative_to(ROOT)} by pip")
        made = any(works(python, "-m", "venv", "--clear", str(VENV)) for python in (sys.executable, "python3"))
        if not made or not works(venv_python(), "-m", "pip", "install", "--quiet", "mitsuba", "numpy"):
            say("pip could not install it (no network, or no python3-venv)")
        working_mitsuba.cache_clear()
        if made and not working_mitsuba() and works(*as_root("apt-get", "install", "-y", "--no-install-recommends", NEWER_LLVM)):
            working_mitsuba.cache_clear()
        return
    package = {"pov": "povray", "cycles": "blender"}[peer]
    command = as_root("apt-get", "install", "-y", "--no-install-recommends", package)
    say(f"{NAMES[peer]} is missing: {' '.join(command)}")
    if not works(*command):
        say("apt could not install it (no right to, or no network)")


def find(peers, may_install):
    """The peers that can run."""
    found = []
    for peer in peers:
        if not there(peer) and may_install:
            install(peer)
        if there(peer):
            found.append(peer)
        else:
            say(f"{NAMES[peer]} is not installed: left out")
    return found


def version(peer):
    if peer == "pov":
        done = subprocess.run(["povray", "--version"], capture_output=True, text=True)
        return re.search(r"POV-Ray \d[\w.]*|$", done.stdout + done.stderr)[0]
    if peer == "cycles":
        return subprocess.run(["blender", "--version"], capture_output=True, text=True).stdout.split("\n")[0] + ", Cycles"
    return "Mitsuba " + subprocess.run([mitsuba_python(), "-c", "import mitsuba; print(mitsuba.__version__)"], capture_output=True, text=True).stdout.strip()
