#!/usr/bin/env python3
"""Puts pictures of one size side by side, four to a row, each made half as large.

Usage: contact_sheet.py SHEET.png FRAME.png...

Reads and writes PNG files of eight bits a channel, as `grove render` writes them, and needs nothing but Python.
"""

import struct
import sys
import zlib

COLUMNS = 4
SIGNATURE = b"\x89PNG\r\n\x1a\n"


def paeth(left, above, corner):
    """The neighbour nearest to left + above - corner (PNG specification, section 9.4)."""
    guess = left + above - corner
    distances = (abs(guess - left), abs(guess - above), abs(guess - corner))
    return (left, above, corner)[distances.index(min(distances))]


def unfilter(kind, row, above, step):
    for i, value in enumerate(row):
        left = row[i - step] if i >= step else 0
        corner = above[i - step] if i >= step else 0
        if kind == 1:
            row[i] = (value + left) & 255
        elif kind == 2:
            row[i] = (value + above[i]) & 255
        elif kind == 3:
            row[i] = (value + (left + above[i]) // 2) & 255
        elif kind == 4:
            row[i] = (value + paeth(left, above[i], corner)) & 255


def read_png(path):
    """Width, height and rows of RGB bytes."""
    with open(path, "rb") as file:
        data = file.read()
    if not data.startswith(SIGNATURE):
        sys.exit(f"{path}: is not a PNG file")
    place, packed, header = len(SIGNATURE), b"", None
    while place < len(data):
        size, kind = struct.unpack(">I4s", data[place : place + 8])
        chunk = data[place + 8 : place + 8 + size]
        if kind == b"IHDR":
            header = struct.unpack(">IIBBBBB", chunk)
        elif kind == b"IDAT":
            packed += chunk
        place += size + 12
    width, height, depth, colour, _, _, interlace = header
    if depth != 8 or colour not in (2, 6) or interlace:
        sys.exit(f"{path}: only eight bits a channel, RGB or RGBA, not interlaced")
    step = 3 if colour == 2 else 4
    pixels = zlib.decompress(packed)
    rows, above = [], bytearray(width * step)
    for y in range(height):
        start = y * (width * step + 1)
        row = bytearray(pixels[start + 1 : start + 1 + width * step])
        unfilter(pixels[start], row, above, step)
        rows.append(row if step == 3 else bytearray(b for i, b in enumerate(row) if i % 4 != 3))
        above = row
    return width, height, rows


def halved(picture):
    width, height, rows = picture
    result = []
    for y in range(0, height - 1, 2):
        row = bytearray()
        for x in range(0, 3 * (width // 2) * 2, 6):
            for c in range(3):
                total = rows[y][x + c] + rows[y][x + 3 + c] + rows[y + 1][x + c] + rows[y + 1][x + 3 + c]
                row.append((total + 2) // 4)
        result.append(row)
    return width // 2, height // 2, result


def write_png(path, width, rows):
    lines, above = b"", bytearray(3 * width)
    for row in rows:
        # Differences to the line above pack best where pictures are smooth.
        lines += b"\x02" + bytes((a - b) & 255 for a, b in zip(row, above))
        above = row

    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    header = struct.pack(">IIBBBBB", width, len(rows), 8, 2, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(SIGNATURE + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(lines, 9)) + chunk(b"IEND", b""))


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    pictures = [halved(read_png(path)) for path in sys.argv[2:]]
    width, height, _ = pictures[0]
    if any(picture[:2] != (width, height) for picture in pictures):
        sys.exit("the pictures differ in size")
    rows = []
    for first in range(0, len(pictures), COLUMNS):
        group = pictures[first : first + COLUMNS]
        for y in range(height):
            row = b"".join(bytes(picture[2][y]) for picture in group)
            rows.append(bytearray(row.ljust(3 * width * min(COLUMNS, len(pictures)), b"\xff")))
    write_png(sys.argv[1], width * min(COLUMNS, len(pictures)), rows)


if __name__ == "__main__":
    main()
