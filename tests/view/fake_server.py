#!/usr/bin/python3
"""Serves the viewer's page with made-up pictures: docs/view-protocol.md without the simulator, to try the page alone.

Usage: fake_server.py [--port 0] [--token T] [--render-ms 10]; prints its address.
"""
import argparse
import asyncio
import base64
import hashlib
import json
import pathlib
import re
import secrets
import struct
import subprocess
import tempfile
import time
import urllib.parse

import fake_display
import fake_socket

ROOT = pathlib.Path(__file__).resolve().parents[2]


def page():
    with tempfile.TemporaryDirectory() as folder:
        html = pathlib.Path(folder) / "page.html"
        subprocess.run(["cmake", "-D", f"HTML={html}", "-P", ROOT / "src/view/page/join.cmake"], check=True)
        return html.read_text()


def policy(html):
    """Lets in the page's one style and one script, and nothing else: as strict as a server of it can be."""
    def allowed(tag):
        inline, = re.findall(f"<{tag}[^>]*>(.*?)</{tag}>", html, re.S)
        return "'sha256-" + base64.b64encode(hashlib.sha256(inline.encode()).digest()).decode() + "'"
    return (f"default-src 'none'; style-src {allowed('style')}; script-src {allowed('script')}; connect-src 'self'; img-src blob: data:; "
            "base-uri 'none'; form-action 'none'; frame-ancestors 'none'")


class Visitor:
    def __init__(self, writer, render_ms):
        self.writer, self.render_ms = writer, render_ms
        self.wanted = self.values = self.told = None
        self.news = asyncio.Event()

    def text(self, message):
        self.writer.write(fake_socket.packed(1, json.dumps(message).encode()))

    def frame(self, wanted, lane, quality, image, began, ssim=None):
        drawn = time.monotonic()
        form, data = fake_display.encoded(image, quality)
        header = {"id": wanted["id"], "lane": lane, "quality": quality, "format": form, "width": image.width, "height": image.height,
                  "samples": 4, "render_ms": 1000 * (drawn - began), "encode_ms": 1000 * (time.monotonic() - drawn), "ssim": ssim}
        head = json.dumps(header).encode()
        return fake_socket.packed(2, struct.pack("<I", len(head)) + head + data)

    def take(self, text):
        message = json.loads(text)
        if message["type"] == "ask":
            if not self.wanted:
                self.text({"type": "error", "what": "there is nothing yet that it could be about"})
            elif message["what"] == "exr":
                self.writer.write(self.exr(message["id"]))
            else:
                self.text(fake_display.answer(self.wanted, self.values, message))
            return
        values, problems = fake_display.display(message["set"])
        if message["eye_mm"][2] < 400:
            problems.append({"key": "camera.position_mm", "what": "must be above the diffuser"})
        if problems:
            return self.text({"type": "problems", "id": message["id"], "problems": problems})
        self.wanted, self.values = message, values
        told = json.dumps([values, message["eye_mm"]])
        if told != self.told:
            self.text(fake_display.resolved(message, values))
        self.told = told
        self.news.set()

    def exr(self, number):
        head = json.dumps({"id": number, "lane": "file", "quality": "final", "format": "exr", "width": 1, "height": 1}).encode()
        return fake_socket.packed(2, struct.pack("<I", len(head)) + head + b"v/1\x01")

    def frames(self, wanted, values, quality):
        began = time.monotonic()
        time.sleep(self.render_ms / 1000)
        ssim = 0.9 if wanted["beside"] != "none" else None
        return [self.frame(wanted, lane, quality, image, began, ssim)
                for lane, image in fake_display.lanes(wanted, values, 2 if quality == "coarse" else 1)]

    async def paint(self):
        """The newest alone: a frame for what moves, a sharp one for what rests."""
        while True:
            await self.news.wait()
            self.news.clear()
            wanted = self.wanted
            for quality in ["coarse"] if wanted["moving"] else ["coarse", "final"]:
                if self.wanted["id"] != wanted["id"]:
                    break
                for frame in await asyncio.to_thread(self.frames, wanted, self.values, quality):
                    self.writer.write(frame)
                await self.writer.drain()


class Server:
    def __init__(self, token, render_ms):
        self.token, self.render_ms, self.html = token, render_ms, page()
        self.policy = policy(self.html)

    def reply(self, writer, status, text):
        body = text.encode()
        writer.write((f"HTTP/1.1 {status}\r\nContent-Type: text/html; charset=utf-8\r\nContent-Length: {len(body)}\r\n"
                      f"Content-Security-Policy: {self.policy}\r\nCache-Control: no-store\r\nConnection: close\r\n\r\n").encode() + body)

    async def serve(self, reader, writer):
        painter = None
        try:
            target, headers = await fake_socket.read_request(reader)
            address = urllib.parse.urlsplit(target)
            if urllib.parse.parse_qs(address.query).get("token") != [self.token]:
                self.reply(writer, "403 Forbidden", "The token is missing or wrong.")
            elif address.path == "/":
                self.reply(writer, "200 OK", self.html)
            elif address.path == "/socket":
                fake_socket.accept(writer, headers)
                visitor = Visitor(writer, self.render_ms)
                visitor.text({"type": "hello", "version": "0", "display": "made up.toml", "eye_mm": [0, 0, 2000],
                              "shown": {"kind": "start", "name": "monkey.blend"}, "patterns": ["checkerboard"], "most_pixels": 8294400})
                painter = asyncio.create_task(visitor.paint())
                async for text in fake_socket.messages(reader, writer):
                    visitor.take(text)
            else:
                self.reply(writer, "404 Not Found", "There is nothing here.")
            await writer.drain()
        except (ConnectionError, asyncio.IncompleteReadError):
            pass  # the browser has gone
        finally:
            if painter:
                painter.cancel()
            writer.close()


async def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--port", type=int, default=0)
    options.add_argument("--token", default=secrets.token_hex(16))
    options.add_argument("--render-ms", type=float, default=10)
    options = options.parse_args()
    server = await asyncio.start_server(Server(options.token, options.render_ms).serve, "127.0.0.1", options.port)
    port = server.sockets[0].getsockname()[1]
    print(f"http://127.0.0.1:{port}/?token={options.token}", flush=True)
    await server.serve_forever()


asyncio.run(main())
