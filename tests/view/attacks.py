"""Hostile browsers: whatever they do, a visitor gets its answers, another can come, and the server's memory stays.

Usage: attacks.py ECHO_SERVER
"""

import base64
import os
import resource
import socket
import struct
import subprocess
import sys
import threading
import time

MOST_DELAY_S = 1.0  # of an answer; the machine may be busy with other tests
MOST_ENTRY_S = 3.0  # until a visitor is let in and has its first answer
MOST_GROWTH_MIB = 32
SERVER_FILES = 200  # that it may have open, sockets too: fewer than those that attack


def connect(port):
    s = socket.create_connection(("127.0.0.1", port), timeout=10)
    s.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return s


def frame(payload, opcode=1, fin=True, claim=None, masked=True, reserved=0):
    """A WebSocket frame (RFC 6455, 5.2); `claim` is the length that its header tells, `reserved` the bits without a meaning."""
    size = len(payload) if claim is None else claim
    head = bytes([(0x80 if fin else 0) | reserved << 4 | opcode])
    bit = 0x80 if masked else 0
    if size < 126:
        head += bytes([bit | size])
    elif size < 1 << 16:
        head += bytes([bit | 126]) + struct.pack(">H", size)
    else:
        head += bytes([bit | 127]) + struct.pack(">Q", size)
    return head + (bytes(4) if masked else b"") + payload  # a mask of zeros


class Socket:
    """A WebSocket's end; what the server says is read as it comes."""

    def __init__(self, server):
        self.socket = connect(server.port)
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall(
            f"GET /socket?token={server.token} HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\nConnection: Upgrade\r\n"
            f"Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\n\r\n".encode()
        )
        self.pending = b""
        while b"\r\n\r\n" not in self.pending:
            self.more()
        head, self.pending = self.pending.split(b"\r\n\r\n", 1)
        if b" 101 " not in head.split(b"\r\n")[0]:
            raise ConnectionError(head.decode())

    def more(self):
        data = self.socket.recv(1 << 16)
        if not data:
            raise ConnectionError("the server has closed the connection")
        self.pending += data

    def exactly(self, size):
        while len(self.pending) < size:
            self.more()
        data, self.pending = self.pending[:size], self.pending[size:]
        return data

    def hear(self):
        first, second = self.exactly(2)
        size = second & 127
        if size == 126:
            size = struct.unpack(">H", self.exactly(2))[0]
        elif size == 127:
            size = struct.unpack(">Q", self.exactly(8))[0]
        return first & 15, self.exactly(size)

    def ask(self, text):
        self.socket.sendall(frame(text))
        return self.hear()

    def send(self, *pieces):
        try:
            for piece in pieces:
                self.socket.sendall(piece)
        except OSError:
            pass  # the server has had enough

    def flood(self, first, again, seconds):
        """Sends again and again, and takes what comes back, until the server has had enough."""
        taker = threading.Thread(target=closed, args=(self.socket,), daemon=True)
        taker.start()
        self.send(first)
        end = time.monotonic() + seconds
        try:
            while time.monotonic() < end:
                self.socket.sendall(again)
            self.socket.shutdown(socket.SHUT_RDWR)
        except OSError:
            pass
        taker.join()
        self.socket.close()


class Server:
    def __init__(self, program):
        few = (SERVER_FILES, SERVER_FILES)
        self.process = subprocess.Popen(
            [program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NOFILE, few)
        )
        port, self.token = self.process.stdout.readline().split()
        self.port = int(port)

    def memory_mib(self, what="VmRSS"):
        with open(f"/proc/{self.process.pid}/status") as status:
            return next(int(line.split()[1]) for line in status if line.startswith(what + ":")) / 1024

    def cpu_s(self):
        with open(f"/proc/{self.process.pid}/stat") as stat:
            fields = stat.read().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Bystander(threading.Thread):
    """A visitor that asks all the while."""

    def __init__(self, server):
        super().__init__()
        self.socket = Socket(server)
        self.stop = threading.Event()
        self.worst_s, self.answers, self.error = 0.0, 0, None

    def run(self):
        try:
            while not self.stop.is_set():
                start = time.monotonic()
                text = b"question %d" % self.answers
                answer = self.socket.ask(text)
                if answer != (1, text):
                    raise ValueError(f"{text} was answered with {answer}")
                self.worst_s = max(self.worst_s, time.monotonic() - start)
                self.answers += 1
                time.sleep(0.01)
        except Exception as e:  # told by the main thread
            self.error = e


def closed(s, within_s=20):
    """The server ends the connection."""
    s.settimeout(within_s)
    try:
        while s.recv(1 << 16):
            pass
    except (ConnectionResetError, BrokenPipeError):
        pass


def several(count, work):
    threads = [threading.Thread(target=work) for _ in range(count)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()


def garbage(server):
    for size in (1, 100, 10000, 1000000):
        with connect(server.port) as s:
            try:
                s.sendall(os.urandom(size))
                s.shutdown(socket.SHUT_WR)
            except OSError:
                pass
            closed(s)
    for text in (b"\r\n\r\n", b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n", b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", b"GET / HTTP/1.1\r\n\0: \0\r\n\r\n"):
        with connect(server.port) as s:
            s.sendall(text)
            s.shutdown(socket.SHUT_WR)
            closed(s)


def half_open(server):
    """1000 connections that say nothing, and then a visitor."""
    silent = []
    for _ in range(1000):
        silent.append(connect(server.port))
    start = time.monotonic()
    assert Socket(server).ask(b"let in") == (1, b"let in")
    came_s = time.monotonic() - start
    assert came_s < MOST_ENTRY_S, f"a visitor was let in after {came_s:.1f} s"
    for s in silent:
        s.close()
    return f"let in after {1000 * came_s:.0f} ms"


def reconnects(server):
    """Connections without end, while visitors come and go."""
    stop = threading.Event()

    def work():
        recent = []
        while not stop.is_set():
            recent.append(connect(server.port))
            if len(recent) > 300:
                recent.pop(0).close()
        for s in recent:
            s.close()

    threads = [threading.Thread(target=work) for _ in range(2)]
    for t in threads:
        t.start()
    worst_s = 0.0
    try:
        for _ in range(20):
            start = time.monotonic()
            s = Socket(server)
            assert s.ask(b"let in") == (1, b"let in")
            worst_s = max(worst_s, time.monotonic() - start)
            s.socket.close()
            time.sleep(0.02)
    finally:
        stop.set()
        for t in threads:
            t.join()
    assert worst_s < MOST_ENTRY_S, f"a visitor was let in after {worst_s:.1f} s"
    return f"let in after {1000 * worst_s:.0f} ms at most"


def long_headers(server):
    for head in (b"GET /" + b"a" * 1000000, b"GET / HTTP/1.1\r\n" + b"A: b\r\n" * 200000, b"GET / HTTP/1.1\r\nA: " + b"b" * 1000000):
        with connect(server.port) as s:
            try:
                s.sendall(head)
            except OSError:
                pass
            closed(s)


def slow_request(server):
    """A byte now and then: the server's patience is counted from the first."""
    with connect(server.port) as s:
        start = time.monotonic()
        s.settimeout(0.2)
        try:
            for byte in b"GET / HTTP/1.1\r\nX: " + b"x" * 1000:
                s.sendall(bytes([byte]))
                try:
                    if not s.recv(1000):
                        break
                except socket.timeout:
                    pass
        except OSError:
            pass
        ended_s = time.monotonic() - start
    assert ended_s < 8, f"a slow request was borne for {ended_s:.1f} s"
    return f"ended after {ended_s:.1f} s"


def broken_frames(server):
    for pieces in (
        [frame(b"\xff\xfe\xfd")],
        [frame(b"\xe2\x82")],
        [frame(b"unmasked", masked=False)],
        [frame(b"reserved", reserved=4)],
        [frame(b"no opcode", opcode=3)],
        [frame(b"long ping" * 100, opcode=9)],
        [frame(b"continues nothing", opcode=0)],
        [frame(b"a", fin=False), frame(b"b", fin=False)],
        [frame(b"\x03", opcode=8)],
        [frame(os.urandom(1000))],
    ):
        s = Socket(server)
        s.send(*pieces)
        closed(s.socket)


def claims(server):
    """Headers of frames as long as there can be."""
    for size in (1 << 17, 1 << 31, (1 << 63) - 1, 1 << 63, (1 << 64) - 1):
        s = Socket(server)
        s.send(frame(b"x" * 1000, claim=size))
        closed(s.socket)


def floods(server):
    for first, again in (
        (b"", frame(b"x" * 1000) * 50),
        (b"", frame(b"malformed") * 1000),
        (b"", frame(b"x" * 125, opcode=9) * 500),
        (b"", frame(b"x" * 70000)),
        (frame(b"x" * 500, fin=False), frame(b"x" * 500, opcode=0, fin=False) * 100),
        (frame(b"", fin=False), frame(b"", opcode=0, fin=False) * 5000),
    ):
        several(3, lambda: Socket(server).flood(first, again, 0.5))
        time.sleep(0.1)  # until they have left: most visitors


def deaf(server):
    """Visitors that ask for much and read nothing."""
    sockets = [Socket(server) for _ in range(3)]
    for s in sockets:
        s.send(frame(b"frames 1000 1000000"), frame(b"texts 200 10000"))
    time.sleep(1)
    for s in sockets:
        s.socket.close()
    time.sleep(0.1)


def main():
    resource.setrlimit(resource.RLIMIT_NOFILE, (min(4096, resource.getrlimit(resource.RLIMIT_NOFILE)[1]),) * 2)
    server = Server(sys.argv[1])
    try:
        besiege(server)
    finally:
        server.process.kill()


def besiege(server):
    bystander = Bystander(server)
    bystander.daemon = True
    bystander.start()
    time.sleep(0.2)
    before = server.memory_mib()
    for attack in (garbage, slow_request, half_open, reconnects, long_headers, broken_frames, claims, floods, deaf):
        bystander.worst_s, start, cpu_s = 0.0, time.monotonic(), server.cpu_s()
        said = attack(server)
        print(
            f"{attack.__name__:14} {time.monotonic() - start:5.1f} s, worst answer {1000 * bystander.worst_s:4.0f} ms, "
            f"{server.cpu_s() - cpu_s:5.2f} s of CPU, {server.memory_mib():5.1f} MiB{', ' + said if said else ''}",
            flush=True,
        )
        assert bystander.error is None, bystander.error
        assert bystander.worst_s < MOST_DELAY_S
    bystander.stop.set()
    bystander.join()
    growth = server.memory_mib("VmHWM") - before
    print(f"memory before {before:.1f} MiB, at most {before + growth:.1f} MiB; {bystander.answers} answers")
    assert growth < MOST_GROWTH_MIB, "the server's memory grew"
    assert bystander.answers > 100
    server.process.stdin.close()
    print(server.process.stdout.read().strip())
    assert server.process.wait() == 0


main()
