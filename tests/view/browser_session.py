"""A headless Chromium on the viewer's page, and the server that it talks to. For browser.py."""
import base64
import contextlib
import io
import pathlib
import secrets
import select
import signal
import socket
import subprocess
import sys
import time

from PIL import Image, ImageChops
from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By

HERE = pathlib.Path(__file__).resolve().parent


class Server:
    """The program, or with program None the made-up one; always on the same port with the same token."""

    def __init__(self, program, display, folder):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        common = ["--port", str(self.port), "--token", secrets.token_hex(16)]
        self.command = ([program, "view", display, "--model", "built-in:spheres"] if program else [sys.executable, HERE / "fake_server.py"]) + common
        self.folder = folder
        self.start()

    def start(self):
        self.process = subprocess.Popen(self.command, stdout=subprocess.PIPE, text=True, cwd=self.folder)
        until = time.monotonic() + 60
        while time.monotonic() < until:
            if not select.select([self.process.stdout], [], [], until - time.monotonic())[0]:
                break
            line = self.process.stdout.readline()
            if not line:
                break
            found = [word for word in line.split() if word.startswith("http://")]
            if found:
                self.address = found[0]
                return
        self.stop()
        raise AssertionError("the server did not say its address")

    def stop(self):
        self.process.send_signal(signal.SIGTERM)
        try:
            self.process.wait(10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            raise AssertionError("the server did not end within 10 s of SIGTERM")


class Page:
    """What a test does with the page that is open."""

    def __init__(self, folder, shots):
        options = webdriver.ChromeOptions()
        for argument in ["--headless=new", "--disable-gpu", "--hide-scrollbars", "--force-device-scale-factor=1", "--disable-dev-shm-usage",
                         "--no-sandbox"]:  # for root, and where users may make no namespaces; the page is our own
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(options=options, service=Service("/usr/bin/chromedriver"))
        self.driver.set_script_timeout(60)
        self.cdp("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(folder))
        self.shots = shots
        self.run = self.driver.execute_script

    def cdp(self, name, **parameters):
        return self.driver.execute_cdp_cmd(name, parameters)

    def size(self, width, height, phone=False):
        """Of the page itself, in CSS pixels."""
        self.cdp("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=2 if phone else 1, mobile=phone)

    def colours(self, scheme):
        self.cdp("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])

    def stats(self):
        return self.run("return window.lfdsim ? lfdsim.stats() : null")

    def state(self):
        return self.run("return lfdsim.state()")

    def until(self, what, holds, seconds=240):
        """Waits until holds(stats) and returns the stats; fails with what was waited for."""
        until = time.monotonic() + seconds
        while True:
            stats = self.stats()
            if stats and holds(stats):
                return stats
            if time.monotonic() > until:
                self.shot("failed")
                raise AssertionError(f"waited {seconds} s in vain: {what}; {stats}; {self.troubles()[:3]}")
            time.sleep(0.03)

    def sharp(self):
        """Waits for the sharp picture of what was wanted last."""
        time.sleep(0.1)  # the page says what is wanted 80 ms after the last move
        return self.until("the sharp picture", lambda s: s["quality"] == "final" and all(i == s["id"] for i in s["last_ids"].values())
                          if not s["problems"] else False)

    def find(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def click(self, selector):
        self.run("arguments[0].scrollIntoView({block: 'nearest'})", self.find(selector))
        self.find(selector).click()

    def choose(self, selector, value):
        self.run("arguments[0].value = arguments[1]; arguments[0].dispatchEvent(new Event('change', {bubbles: true}))", self.find(selector), value)

    def type(self, selector, text):
        field = self.find(selector)
        self.run("arguments[0].scrollIntoView({block: 'center'}); arguments[0].select()", field)
        field.send_keys(text + "\n")

    def picture(self, lane="one"):
        """Size of the canvas in its own and in the screen's pixels, a checksum, and how many colours a grid of places has."""
        return self.run("""
            const canvas = document.querySelector(`canvas[data-lane=${arguments[0]}]`), box = canvas.getBoundingClientRect();
            const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
            copy.drawImage(canvas, 0, 0);
            const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
            let sum = 0; const colours = new Set();
            for (let i = 0; i < data.length; i += 4) {
              sum = (Math.imul(sum, 31) + data[i] + 256 * data[i + 1] + 65536 * data[i + 2]) | 0;
              if (i % 388 === 0) colours.add(data[i] + 256 * data[i + 1] + 65536 * data[i + 2]);
            }
            return { size: [canvas.width, canvas.height], screen: [box.width * devicePixelRatio, box.height * devicePixelRatio], sum,
                     colours: colours.size };""", lane)

    def pixels(self):
        """The picture, and where on the page its corner lies."""
        left, top, data = self.run("""
            const canvas = document.querySelector("canvas[data-lane=one]"), box = canvas.getBoundingClientRect();
            const copy = Object.assign(document.createElement("canvas"), { width: canvas.width, height: canvas.height });
            copy.getContext("2d").drawImage(canvas, 0, 0);
            return [box.left, box.top, copy.toDataURL().split(",")[1]];""")
        return Image.open(io.BytesIO(base64.b64decode(data))).convert("RGB"), left, top

    def unscaled(self):
        """Whether the screen shows the picture's pixels as they are."""
        drawn, left, top = self.pixels()
        screen = Image.open(io.BytesIO(self.driver.get_screenshot_as_png())).convert("RGB")
        corner = [(round(left) + dx, round(top) + dy) for dx in (-1, 0, 1) for dy in (-1, 0, 1)]  # halves are rounded either way
        return any(not ImageChops.difference(screen.crop((x, y, x + drawn.width, y + drawn.height)), drawn).getbbox() for x, y in corner)

    def smallest_text(self):
        """Of the drawing, in pixels of the screen."""
        return self.run("""return Math.min(...[...document.querySelectorAll("#drawing text")].map((t) => {
            const m = t.getScreenCTM();
            return parseFloat(getComputedStyle(t).fontSize) * Math.hypot(m.a, m.b); }))""")

    def mouse(self, kind, x, y, buttons=1):
        self.cdp("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left" if buttons else "none", buttons=buttons, clickCount=1)

    @contextlib.contextmanager
    def held(self):
        """The pointer held down on the picture; yields a function that moves it by so many CSS pixels from the middle."""
        box = self.run("const b = document.getElementById('stage').getBoundingClientRect(); return [b.left + b.width / 2, b.top + b.height / 2]")
        self.mouse("mousePressed", *box)
        end = [*box]

        def move(x, y):
            end[:] = box[0] + x, box[1] + y
            self.mouse("mouseMoved", *end)
        yield move
        self.mouse("mouseReleased", *end)

    def shot(self, name):
        self.shots.mkdir(parents=True, exist_ok=True)
        self.driver.save_screenshot(str(self.shots / f"{name}.png"))

    def troubles(self):
        """What the browser's console complains of, but for connections that were meant to fail."""
        return [entry["message"] for entry in self.driver.get_log("browser")
                if entry["level"] == "SEVERE" and "ERR_CONNECTION_REFUSED" not in entry["message"] and "WebSocket" not in entry["message"]]

    def close(self):
        self.driver.quit()
