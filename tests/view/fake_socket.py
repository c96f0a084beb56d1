"""A small WebSocket server (RFC 6455) over asyncio: text and binary messages whole, no extensions. For tests of the page alone."""
import asyncio
import base64
import hashlib
import struct

MAGIC = b"258EAFA5-E914-47DA-95CA-C5AB0DC85B11"


async def read_request(reader):
    """Path, and headers by lower-case name."""
    head = (await reader.readuntil(b"\r\n\r\n")).decode("latin-1").split("\r\n")
    headers = {name.strip().lower(): value.strip() for name, _, value in (line.partition(":") for line in head[1:] if line)}
    return head[0].split()[1], headers


def accept(writer, headers):
    key = base64.b64encode(hashlib.sha1(headers["sec-websocket-key"].encode() + MAGIC).digest()).decode()
    writer.write(("HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                  f"Sec-WebSocket-Accept: {key}\r\n\r\n").encode())


def packed(opcode, data):
    size = len(data)
    if size < 126:
        head = struct.pack("!BB", 0x80 | opcode, size)
    elif size < 1 << 16:
        head = struct.pack("!BBH", 0x80 | opcode, 126, size)
    else:
        head = struct.pack("!BBQ", 0x80 | opcode, 127, size)
    return head + data


async def messages(reader, writer):
    """The texts that come, until the peer closes."""
    parts = b""
    while True:
        first, second = await reader.readexactly(2)
        size = second & 0x7F
        if size == 126:
            size, = struct.unpack("!H", await reader.readexactly(2))
        elif size == 127:
            size, = struct.unpack("!Q", await reader.readexactly(8))
        if size > 64 << 10 or not second & 0x80:
            return
        mask = await reader.readexactly(4)
        data = bytes(byte ^ mask[k % 4] for k, byte in enumerate(await reader.readexactly(size)))
        opcode = first & 0x0F
        if opcode == 8:
            return
        if opcode == 9:
            writer.write(packed(10, data))
        elif opcode in (0, 1):
            parts += data
            if first & 0x80:
                yield parts.decode()
                parts = b""
