#!/usr/bin/python3
"""The viewer in a browser: pictures come, hands and parameters take effect, mistakes are marked, a lost connection comes back.

Usage: browser.py (--fake | --program build/release/lfdsim) [--display FILE] [--full] [--shots FOLDER]
Prints figures as JSON: frames a second and latency while dragging, time from rest to the sharp picture. Fails if anything is wrong.
"""
import argparse
import json
import math
import pathlib
import statistics
import tempfile
import time

from browser_session import HERE, Page, Server

GAP = "#c-array-gap_mm"
PITCH = "#c-array-pitch_mm"


def first_picture(page, server):
    began = time.monotonic()
    page.driver.get(server.address)
    page.until("a first frame", lambda s: sum(s["frames"][q] for q in ("coarse", "fine", "final")) > 0)
    figures = {"first_frame_s": round(time.monotonic() - began, 2)}
    page.sharp()
    figures["first_sharp_s"] = round(time.monotonic() - began, 2)
    sent = page.stats()["sent"]
    time.sleep(0.5)
    stats = page.stats()
    assert stats["sent"] == sent, "the page does not come to rest"
    assert not stats["notes"], f"the program complains of the page: {stats['notes']}"
    page.until("what to do next is said", lambda s: page.find("#probe-says").text.startswith("Point at the picture"))
    picture = page.picture()
    assert picture["size"] == picture["screen"], f"not one to one: {picture}"
    assert page.unscaled(), "the screen does not show the picture's own pixels"
    assert abs(picture["size"][0] / picture["size"][1] - 16 / 9) < 0.03, picture
    assert picture["colours"] > 20, f"the picture is empty: {picture}"
    return figures


def drag_moves_the_picture(page):
    before, eye = page.picture(), page.state()["eye"]
    with page.held() as move:
        for k in range(12):
            move(10 * k, -4 * k)
    stats = page.sharp()
    now = page.state()["eye"]
    assert now[0] > eye[0] and now[1] > eye[1], f"to the right and up: {eye}, {now}"
    assert abs(math.hypot(*now) - math.hypot(*eye)) < 0.01, f"the distance changed: {now}"
    assert page.picture()["sum"] != before["sum"], "the picture did not change"
    assert stats["frames"]["malformed"] == stats["malformed"] == 0, stats
    page.find("#stage").send_keys("\ue011")  # Home
    page.sharp()
    assert page.picture()["sum"] == before["sum"], "the same place shows another picture"
    page.find("#stage").send_keys("\ue014")  # right
    page.sharp()
    x, _, z = page.state()["eye"]
    assert abs(math.degrees(math.atan2(x, z)) - 1) < 1e-3, "an arrow key is a degree"


def parameter_takes_effect(page):
    before, fov = page.picture(), page.stats()["theory"][0]["value"]
    field = page.find(GAP)
    gap = float(field.get_attribute("value"))
    page.type(GAP, str(gap * 1.05))
    page.until("theory follows", lambda s: s["theory"][0]["value"] != fov)
    page.sharp()
    changed = page.picture()
    assert changed["sum"] != before["sum"], "the picture did not change"
    assert "array.gap_mm=" in page.stats()["command"]

    page.type(GAP, "-3")
    page.until("a problem", lambda s: s["problems"])
    assert field.get_attribute("aria-invalid") == "true"
    error = page.find("#" + field.get_attribute("aria-describedby"))
    assert error.is_displayed() and error.text, "the mistake is not named in its place"
    assert "gap" in page.find("#problems").text
    page.shot("problems")
    assert page.picture()["sum"] == changed["sum"], "a mistake changed the picture"
    page.run("document.getElementById('undo').click()")
    page.until("no problem", lambda s: not s["problems"])
    assert field.get_attribute("aria-invalid") == "false" and not error.is_displayed()
    page.run("document.getElementById('reset-all').click()")
    page.sharp()
    assert page.picture()["sum"] == before["sum"], "as described is not as it was"
    page.run("document.getElementById('undo').click()")
    page.sharp()
    assert page.picture()["sum"] == changed["sum"], "undo did not bring the parameter back"

    page.run("const s = document.querySelector('.control:has(#c-array-gap_mm) input[type=range]');"
             "s.value = arguments[0]; s.dispatchEvent(new Event('input')); s.dispatchEvent(new Event('change'))", gap)
    page.sharp()
    assert page.picture()["sum"] == before["sum"] or page.state()["set"]["array.gap_mm"] != str(gap), "the slider did nothing"
    page.choose("#c-diffuser", "none")
    page.until("no diffuser", lambda s: not page.run("return document.getElementById('c-diffuser-distance_mm')"))
    page.run("arguments[0].focus()", page.find(GAP))
    page.choose("#c-diffuser", "there")
    page.until("the diffuser again", lambda s: page.run("return document.getElementById('c-diffuser-distance_mm')?.value > 0"))
    assert float(page.find(GAP).get_attribute("value")) > 0, "a field lost its value"
    page.find("#filter").send_keys("offset")
    rows = page.run("return [...document.querySelectorAll('.control')].filter((c) => c.offsetParent).length")
    assert 1 <= rows < 6, f"{rows} rows are about an offset"
    page.run("const f = document.getElementById('filter'); f.value = ''; f.dispatchEvent(new Event('input'))")


def parameters_do_not_block_each_other(page, real):
    """What cannot be gives way to the next change; apertures follow a pitch that becomes smaller than them, and come back with it."""
    page.run("document.getElementById('reset-all').click()")
    page.sharp()
    before, gap = page.picture(), page.find(GAP).get_attribute("value")
    page.type(GAP, "-3")
    page.until("a problem", lambda s: s["problems"])
    page.find("#stage").send_keys("\ue014")  # right
    page.until("no problem", lambda s: not s["problems"])
    page.sharp()
    assert "array.gap_mm" not in page.state()["set"] and page.find(GAP).get_attribute("value") == gap, "what cannot be stays in the way"
    assert page.picture()["sum"] != before["sum"], "the eye did not move"
    page.find("#stage").send_keys("\ue012")
    if real:
        pitch = float(page.find(PITCH).get_attribute("value"))
        slide = ("const s = document.querySelector('.control:has(#c-array-pitch_mm) input[type=range]');"
                 "s.value = arguments[0]; s.dispatchEvent(new Event('input')); if (arguments[1]) s.dispatchEvent(new Event('change'))")
        apertures = {key: value for key, value in page.run("return lfdsim.controls()").items() if key.endswith("aperture_mm")}
        page.run(slide, 0.75 * pitch, False)
        page.until("a smaller pitch", lambda s: f"array.pitch_mm={0.75 * pitch:g}" in (s["command"] or ""))
        assert not page.stats()["problems"] and apertures, page.stats()["problems"]
        assert all(page.state()["set"][key] == f"{0.375 * pitch:g}" for key in apertures), page.state()["set"]
        assert "follows the pitch" in page.find("#controls").text
        page.run(slide, pitch, True)
        page.until("the pitch as before", lambda s: f"array.pitch_mm={pitch:g}" in (s["command"] or ""))
        assert set(page.state()["set"]) == {"array.pitch_mm"} and "follows" not in page.find("#controls").text, "apertures did not come back"
    page.run("document.getElementById('reset-all').click()")
    page.sharp()
    assert page.picture()["sum"] == before["sum"]


def errors_are_drawn_again(page):
    page.run("document.querySelector('details[data-table=errors]').open = true")
    before = page.picture()
    page.type("#c-errors-decenter_sd_mm", "0.02")
    page.sharp()
    drawn = page.picture()
    assert drawn["sum"] != before["sum"], "lenses that stand apart changed nothing"
    page.click("#draw-again")
    page.sharp()
    assert page.state()["set"]["errors.seed"] == "1" and page.picture()["sum"] != drawn["sum"], "the same errors were drawn again"
    page.shot("errors")
    page.run("document.getElementById('reset-all').click()")
    page.sharp()
    assert page.picture()["sum"] == before["sum"], "as described is not as it was"


def layouts(page):
    page.choose("#layout", "pair")
    stats = page.until("both eyes", lambda s: s["last_ids"].get("left") == s["last_ids"].get("right") == s["id"] and s["quality"] == "final")
    assert page.picture("left")["sum"] != page.picture("right")["sum"], "both eyes see the same"
    page.shot("pair")
    page.choose("#layout", "one")
    for compare, lane in (("beside", "photograph"), ("difference", "difference"), ("wipe", "photograph")):
        page.choose("#compare", compare)
        stats = page.until(compare, lambda s: s["last_ids"].get(lane) == s["last_ids"]["one"] == s["id"] and s["quality"] == "final")
        assert 0 < stats["ssim"] < 1 and page.find("#ssim").text == f"SSIM of the content {stats['ssim']:.4f}"
        assert lane == "difference" or page.picture(lane)["colours"] > 5, "the photograph is empty"
        page.shot(compare)
    page.choose("#compare", "none")
    page.until("the picture alone", lambda s: s["quality"] == "final" and s["last_ids"]["one"] == s["id"])


def drawings(page, real):
    for name in ("fov", "spot", "lens", "display"):
        page.click(f"[data-drawing={name}]")
        page.until(f"the drawing {name}", lambda s: page.run("return !!document.querySelector('#drawing svg')"))
        page.shot(f"drawing-{name}")
        assert not real or page.smallest_text() >= 10.99, f"{name} has text of {page.smallest_text():.1f} pixels"
    x, y = page.run("const b = document.getElementById('stage').getBoundingClientRect(); return [b.left + b.width / 2, b.top + b.height / 2]")
    page.mouse("mouseMoved", x, y, buttons=0)
    page.until("a ray over the side view", lambda s: page.run("return document.querySelectorAll('#drawing .fan').length"))
    said = page.find("#probe-says").text
    page.mouse("mouseMoved", x + 60, y + 40, buttons=0)
    page.until("another lens", lambda s: page.find("#probe-says").text not in ("", said))
    assert page.run("return window.attacked === undefined && !document.querySelector('svg script, svg [onload]')"), "a drawing ran a script"
    page.click("[data-drawing=display]")  # away again
    page.sharp()


def another_display(page):
    """It begins with the eye where its own camera stands; the list has what can be shown, and nothing else."""
    page.find("#stage").send_keys("\ue014")  # right
    page.sharp()
    page.run("document.getElementById('display').onfocus()")
    page.until("the list", lambda s: page.run("return document.querySelectorAll('#display option').length") > 2)
    names = page.run("return [...document.querySelectorAll('#display option')].map((o) => o.value)")
    assert "tablet-lenticular.toml" in names, names
    page.choose("#display", "tablet-lenticular.toml")
    page.sharp()
    assert page.state()["eye"] == [0, 0, 450], page.state()["eye"]
    page.choose("#display", "")
    page.sharp()
    assert page.state()["eye"] == [0, 0, 2000], page.state()["eye"]


def files(page, folder):
    def came(name):
        file = folder / name
        page.until(name, lambda s: file.exists() and file.stat().st_size > 0)
        return file.read_bytes()
    for fold in ("#files", "#path"):
        page.run("document.querySelector(arguments[0]).open = true", fold)
    page.click("#exr")
    assert came("view.exr").startswith(b"v/1\x01"), "no OpenEXR file"
    page.click("#toml")
    assert b"schema = 1" in came("display.toml")
    page.click("#copy")
    page.until("the command is copied or selected", lambda s: "command" in page.find("#files-say").text)

    page.find("#stage").send_keys("\ue011")
    page.click("#record")
    with page.held() as move:
        for k in range(20):
            move(-6 * k, 0)
    page.sharp()
    page.click("#record")
    page.click("#path-save")
    path = json.loads(came("path.json"))
    times, end = [pose["time_s"] for pose in path["poses"]], path["poses"][-1]["position_mm"]
    assert path["schema"] == 1 and times[0] == 0 and all(a < b for a, b in zip(times, times[1:])) and len(times) > 3, path
    bad = folder / "bad.json"
    bad.write_text(json.dumps({**path, "poses": path["poses"][::-1]}))
    page.find("#path-load").send_keys(str(bad))
    page.until("a bad path is refused", lambda s: "not a camera path: pose 0" in page.find("#path-says").text)
    page.find("#path-load").send_keys(str(folder / "path.json"))
    page.find("#stage").send_keys("\ue011")
    page.click("#replay")
    page.until("the path's end", lambda s: page.state()["eye"] == end)
    page.sharp()


def reload_and_reconnect(page, server):
    page.choose("#surface", "plane")
    page.type(GAP, str(float(page.find(GAP).get_attribute("value")) * 1.02))
    page.sharp()
    before, state = page.picture(), page.state()
    page.driver.refresh()
    page.sharp()
    assert page.state() == state, f"a reload lost something: {state}, {page.state()}"
    assert page.picture()["sum"] == before["sum"]

    server.stop()
    page.until("the loss is told", lambda s: s["socket"] != "open" and "no connection" in page.find("#connection").text)
    page.shot("no-connection")
    shown = page.stats()
    began = time.monotonic()
    server.start()
    page.until("a new connection with new pictures", lambda s: s["connects"] == shown["connects"] + 1 and s["last_ids"]["one"] > shown["last_ids"]["one"])
    page.sharp()
    assert page.picture()["sum"] == before["sum"], "another picture after the connection was lost"
    page.run("document.getElementById('reset-all').click()")
    page.choose("#surface", "sphere")
    return {"reconnect_s": round(time.monotonic() - began, 2)}


def two_visitors(page, server):
    page.sharp()
    first, eye, before = page.driver.current_window_handle, page.state()["eye"], page.picture()
    page.driver.switch_to.new_window("window")
    page.driver.get(server.address)
    page.sharp()
    for _ in range(3):
        page.find("#stage").send_keys("\ue013")  # up
    page.sharp()
    other = page.state()["eye"], page.picture()
    page.driver.close()
    page.driver.switch_to.window(first)
    page.sharp()
    assert page.state()["eye"] == eye != other[0], "the two share an eye"
    assert page.picture()["sum"] == before["sum"] != other[1]["sum"], "one's picture is the other's"


def looks(page, real):
    for scheme in ("light", "dark"):
        page.colours(scheme)
        page.shot(f"desktop-{scheme}")
    page.colours("light")
    page.size(390, 844, phone=True)
    page.sharp()
    wide = page.run("return document.documentElement.scrollWidth")
    assert wide <= 390, f"the page is {wide} pixels wide on a phone"
    page.shot("phone")
    if real:
        for name in ("display", "fov"):
            page.click(f"[data-drawing={name}]")
            page.until(f"the drawing {name}", lambda s: page.run("return !!document.querySelector('#drawing svg')"))
            page.shot(f"phone-{name}")
            assert page.smallest_text() >= 10.99, f"{name} has text of {page.smallest_text():.1f} pixels on a phone"
        outside = page.run("""const box = document.getElementById('drawing').getBoundingClientRect();
            return [...document.querySelectorAll('#drawing text')].filter((t) => t.getBoundingClientRect().right > box.right + 1).map((t) => t.textContent)""")
        assert not outside, f"a plot's text is cut off: {outside}"
        page.click("[data-drawing=fov]")
    page.run("window.scrollTo(0, 700)")
    page.shot("phone-below")
    page.size(1366, 768)
    page.sharp()
    wide, high = page.run("return [document.documentElement.scrollWidth, document.documentElement.scrollHeight]")
    assert wide <= 1366 and high <= 768, (wide, high)
    nameless = page.run("""return [...document.querySelectorAll('button, input, select, textarea')].filter((e) =>
        !e.textContent.trim() && !e.getAttribute('aria-label') && !e.labels?.length).map((e) => e.outerHTML)""")
    assert not nameless, f"a screen reader has no name for {nameless}"


def measured(page, size, seconds):
    """While the pointer goes round: frames a second, and the time from a pointer event to its frame; then to the sharp picture."""
    page.choose("#size", size)
    page.sharp()
    coarse = page.stats()["frames"]["coarse"]
    with page.held() as move:
        began = time.monotonic()
        # Slow or busy machines move on until there are frames to count, for a minute at most.
        while (now := time.monotonic() - began) < seconds or (now < 60 and page.stats()["frames"]["coarse"] < coarse + 3):
            move(150 * math.sin(2 * now), 80 * math.sin(3 * now))
            time.sleep(max(0, 1 / 60 - (time.monotonic() - began - now)))
        during = page.stats()
    after = page.sharp()
    frames = during["frames"]["coarse"] - coarse
    assert frames >= 3, f"{frames} frames in {now:.0f} s at {size}"
    assert list(map(int, size.split("x"))) == page.picture()["size"]
    ordered = sorted(during["latency_ms"][-frames:])
    return {"frames_per_second": round(frames / now, 1), "latency_p50_ms": round(statistics.median(ordered), 1),
            "latency_p95_ms": round(ordered[int(0.95 * (len(ordered) - 1))], 1), "rest_to_sharp_ms": round(after["final_ms"][-1], 1)}


def main():
    options = argparse.ArgumentParser(description=__doc__)
    which = options.add_mutually_exclusive_group(required=True)
    which.add_argument("--fake", action="store_true", help="made-up pictures: the page alone")
    which.add_argument("--program", type=pathlib.Path)
    options.add_argument("--display", type=pathlib.Path, default=HERE.parents[1] / "displays/desktop-asphere.toml")
    options.add_argument("--full", action="store_true", help="longer, and at 3840x2160")
    options.add_argument("--shots", type=pathlib.Path, default=HERE.parents[1] / "build/view-screenshots")
    options = options.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        server = Server(options.program and options.program.resolve(), options.display.resolve(), folder)
        page = None
        try:
            page = Page(folder, options.shots)
            page.size(1366, 768)
            figures = first_picture(page, server)
            drag_moves_the_picture(page)
            parameter_takes_effect(page)
            parameters_do_not_block_each_other(page, bool(options.program))
            if options.program:
                errors_are_drawn_again(page)
                another_display(page)
            layouts(page)
            drawings(page, bool(options.program))
            files(page, folder)
            figures |= reload_and_reconnect(page, server)
            two_visitors(page, server)
            looks(page, bool(options.program))
            page.size(2300, 1400)
            for size in ["1280x720", "1920x1080"] + ["3840x2160"] * options.full:
                figures[size] = measured(page, size, 10 if options.full else 3)
            troubles = page.troubles()
            assert not troubles or options.fake and all("inline event handler" in text for text in troubles), troubles
        finally:
            if page:
                page.close()
            server.stop()
    print(json.dumps(figures, indent=2))


main()
