# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Pictures of 8 bits a channel, and PNG files of them."""
import struct
import zlib


class Picture:
    """width, height, and three bytes a pixel, row by row from the top."""

    def __init__(self, width, height, rgb):
        self.width, self.height, self.rgb = width, height, rgb

    def pixel(self, x, y):
        at = 3 * (y * self.width + x)
        return tuple(self.rgb[at:at + 3])

    def differences(self, other):
        """The largest and the mean difference of a channel."""
        assert (self.width, self.height) == (other.width, other.height)
        steps = [abs(a - b) for a, b in zip(self.rgb, other.rgb)]
        return max(steps), sum(steps) / len(steps)

    def mean(self):
        return sum(self.rgb) / len(self.rgb)

    def png(self):
        """The bytes of a PNG file."""
        rows = b"".join(b"\0" + self.rgb[3 * self.width * y:3 * self.width * (y + 1)] for y in range(self.height))

        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

        head = struct.pack(">IIBBBBB", self.width, self.height, 8, 2, 0, 0, 0)
        return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")

    def write(self, path):
        path.write_bytes(self.png())


def paeth(a, b, c):
    da, db, dc = abs(b - c), abs(a - c), abs(a + b - 2 * c)
    return a if da <= db and da <= dc else b if db <= dc else c


def read_png(path):
    """A PNG of 8 bits a channel, RGB or RGBA, as the program writes it."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, _, color = struct.unpack(">IIBB", body[:10])
        if kind == b"IDAT":
            packed += body
        at += size + 12
    step = 4 if color == 6 else 3
    raw, stride, above, rgb = zlib.decompress(packed), step * width, bytearray(step * width), bytearray()
    for y in range(height):
        kind, line = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride if kind else 0):
            left, corner = (line[i - step], above[i - step]) if i >= step else (0, 0)
            line[i] = (line[i] + (0, left, above[i], (left + above[i]) // 2, paeth(left, above[i], corner))[kind]) & 255
        above = line
        if step == 4:
            line = bytearray(line)
            del line[3::4]
        rgb += line
    return Picture(width, height, bytes(rgb))
