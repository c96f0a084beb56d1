#!/usr/bin/env python3
"""How like the content a display is that shows views of it, against the number of views: content, views, elemental images, photograph.

Usage: likeness.py LFDSIM DISPLAY.toml (--quilts 2,8,32 | --grids 3,5,9 [--depth]) --camera-mm X,Y,Z [--size 640x400] [--view-size 480x320]

Prints the SSIM of the view against the content's own photograph for each number of views and for elemental images made of the content itself.
The exit code is 1 if it does not rise with the number of views."""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("display")
    kind = parser.add_mutually_exclusive_group(required=True)
    kind.add_argument("--quilts", help="numbers of views in a row")
    kind.add_argument("--grids", help="numbers of views along both sides")
    parser.add_argument("--depth", action="store_true", help="with a depth map for each view")
    parser.add_argument("--camera-mm", required=True)
    parser.add_argument("--size", default="640x400")
    parser.add_argument("--view-size", default="480x320")
    arguments = parser.parse_args()

    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        camera = ["--camera-mm", arguments.camera_mm, "--size", arguments.size]

        def run(*command):
            return subprocess.run([arguments.program, *map(str, command)], check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout

        def ssim(*source):
            run("eia", arguments.display, *source, "-o", folder / "panel.exr")
            run("render", arguments.display, "--panel-image", folder / "panel.exr", *camera, "-o", folder / "view.npy")
            return json.loads(run("compare", folder / "view.npy", folder / "photo.npy", "--json"))["ssim"]

        run("photo", arguments.display, *camera, "-o", folder / "photo.npy")
        found = []
        for n in map(int, (arguments.quilts or arguments.grids).split(",")):
            if arguments.quilts:
                views = folder / f"quilt_qs{n}x1a1.5.exr"
                run("views", arguments.display, "--cone", "bins", "--view-size", arguments.view_size, "-o", views)
            else:
                views = folder / f"grid{n}"
                run("views", arguments.display, "--grid", f"{n}x{n}", "--view-size", arguments.view_size, "--views-as", "exr",
                    *(["--depth"] if arguments.depth else []), "-o", views)
            found.append(ssim("--views", views))
            print(f"{n if arguments.quilts else f'{n} x {n}'} views: SSIM {found[-1]:.4f}", flush=True)
        print(f"the content itself: SSIM {ssim():.4f}")
    return 0 if all(a < b for a, b in zip(found, found[1:])) else 1


if __name__ == "__main__":
    sys.exit(main())
