#!/usr/bin/python3
"""The viewer at work for long: random drags and parameters. Each picture at rest is what the command that the page tells gives, bit
for bit; no connection is lost; the program's memory stays flat.

Usage: soak.py build/release/lfdsim [--seconds 600] [--seed 1] [--display FILE]
Prints figures as JSON. Fails if anything is wrong.
"""
import argparse
import json
import math
import pathlib
import random
import shlex
import subprocess
import tempfile
import time

from PIL import Image, ImageChops

from browser_session import HERE, Page, Server

HOME, LEFT, UP, RIGHT, DOWN = "\ue011", "\ue012", "\ue013", "\ue014", "\ue015"


def memory_mib(process):
    status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
    return int(status.split("VmRSS:")[1].split()[0]) / 1024


def drag(page, pick):
    across, up, turns = pick.uniform(-300, 300), pick.uniform(-120, 120), pick.uniform(1, 4)
    with page.held() as move:
        for k in range(pick.randrange(10, 40)):
            move(across * math.sin(turns * k / 20), up * math.sin(k / 20))
            time.sleep(1 / 60)


def keys(page, pick):
    for _ in range(pick.randrange(1, 5)):
        page.find("#stage").send_keys(pick.choice([HOME, LEFT, UP, RIGHT, DOWN, "+", "-"]))


def parameter(page, pick):
    """Pulls a slider to and fro; what it makes invalid is taken back."""
    names = page.run("return [...document.querySelectorAll('#controls input[type=range]')].filter((e) => e.offsetParent).map((e) => e.ariaLabel)")
    slider = f'#controls input[aria-label="{pick.choice(names)}"]'
    for _ in range(pick.randrange(1, 12)):
        page.run("""const e = document.querySelector(arguments[0]);
                    e.value = +e.value + (e.max - e.min) * arguments[1];
                    e.dispatchEvent(new Event('input', { bubbles: true }))""", slider, pick.uniform(-0.04, 0.04))
        time.sleep(1 / 30)
    page.run("document.querySelector(arguments[0]).dispatchEvent(new Event('change', { bubbles: true }))", slider)


def rest(page):
    """Whether the display is valid; if so its sharp picture is there."""
    page.until("an answer", lambda s: s["answered"] == s["id"] or s["problems"], 60)
    time.sleep(0.3)
    if page.stats()["problems"]:
        return False
    page.sharp()
    return True


def right_picture(page, program, served, folder):
    """The command is for a shell in the served folder: it has no absolute paths."""
    command = page.stats()["command"]
    words = shlex.split(command)
    assert words[0] == "lfdsim", command
    at = words.index("-o") + 1
    words[0], words[at] = program, folder / "soak.png"
    subprocess.run(words + ["--progress", "none"], cwd=served, check=True, stdout=subprocess.DEVNULL)
    wanted, shown = Image.open(folder / "soak.png").convert("RGB"), page.pixels()[0]
    differing = ImageChops.difference(wanted, shown).getbbox() if wanted.size == shown.size else "the sizes"
    assert not differing, f"differs in {differing}: {command}"


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("program", type=pathlib.Path)
    options.add_argument("--seconds", type=float, default=600)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--display", type=pathlib.Path, default=HERE.parents[1] / "displays/desktop-asphere.toml")
    options = options.parse_args()
    pick, program = random.Random(options.seed), options.program.resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        server = Server(program, options.display.resolve(), folder)
        page, counts, memory = None, {"rests": 0, "invalid": 0}, []
        try:
            page = Page(folder, folder / "shots")
            page.size(1366, 768)
            page.driver.get(server.address)
            page.until("a picture", lambda s: s["frames"]["final"] > 0, 60)
            until = time.monotonic() + options.seconds
            while time.monotonic() < until:
                pick.choice([drag, drag, keys, parameter])(page, pick)
                if rest(page):
                    right_picture(page, program, options.display.resolve().parent, folder)
                    counts["rests"] += 1
                else:
                    counts["invalid"] += 1
                    page.run("document.getElementById('undo').click()")
                if pick.random() < 0.1:
                    page.run("document.getElementById('reset-all').click()")
                    rest(page)
                memory.append(memory_mib(server.process))
            stats = page.stats()
            assert stats["connects"] == 1 and stats["malformed"] == stats["frames"]["malformed"] == 0, stats
            assert not page.troubles(), page.troubles()
            # What has been asked for once may be kept: the first third is the time to get it.
            third = len(memory) // 3
            if options.seconds >= 120:
                early, late = max(memory[third:2 * third]), max(memory[2 * third:])
                assert late < 1.1 * early + 32, f"memory grows: {early:.0f} MiB, then {late:.0f} MiB"
            assert counts["rests"] > options.seconds / 20, counts
        finally:
            if page:
                page.close()
            server.stop()
    print(json.dumps(counts | {"frames": stats["frames"], "memory_mib": {"first": round(memory[0]), "most": round(max(memory)), "last": round(memory[-1])}}))


main()
