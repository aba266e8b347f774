"""Puts pictures in linear light side by side into one PNG file. Needs nothing but Python."""

import bisect
import struct
import zlib


def encoded(value):
    """The byte of sRGB (IEC 61966-2-1) for linear light, cut at black and white."""
    value = min(1.0, max(0.0, value))
    return round(255 * (12.92 * value if value <= 0.0031308 else 1.055 * value**(1 / 2.4) - 0.055))


# The light from which on each byte is nearest.
THRESHOLDS = [(lambda s: s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055)**2.4)((i + 0.5) / 255) for i in range(255)]


def rgb_bytes(planes, exposure=1.0):
    result = bytearray(3 * len(planes[0]))
    for c in range(3):
        result[c::3] = bytes(bisect.bisect(THRESHOLDS, exposure * value) for value in planes[c])
    return bytes(result)


def magnified(pixels, width, height, scale):
    rows = []
    for y in range(height):
        row = pixels[3 * width * y:3 * width * (y + 1)]
        rows += [b"".join(row[3 * x:3 * x + 3] * scale for x in range(width))] * scale
    return b"".join(rows)


def write_sheet(path, width, height, rows, scale=1):
    """`rows` of pictures, each as three planes of `width` by `height` values; a strip of white parts them."""
    gap = 4
    across = max(map(len, rows))
    total = across * width * scale + (across - 1) * gap
    lines = []
    for number, row in enumerate(rows):
        pictures = [magnified(rgb_bytes(planes), width, height, scale) for planes in row]
        if number > 0:
            lines += [b"\xff" * (3 * total)] * gap
        size = 3 * width * scale
        for y in range(height * scale):
            line = (b"\xff" * (3 * gap)).join(picture[y * size:(y + 1) * size] for picture in pictures)
            lines.append(line.ljust(3 * total, b"\xff"))

    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    packed = zlib.compress(b"".join(b"\0" + line for line in lines), 9)
    header = struct.pack(">IIBBBBB", total, len(lines), 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", packed) + chunk(b"IEND", b""))
