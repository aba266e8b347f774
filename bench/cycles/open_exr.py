"""Reads OpenEXR pictures of 32-bit floats in scan lines, unpacked or packed by zip, as Cycles and `grove render` write them. Needs nothing but Python.

The layout is that of "The OpenEXR File Layout" of the OpenEXR project.
"""

import array
import struct
import sys
import zlib

MAGIC, MULTI_PART_OR_TILED = 20000630, 0x1A00
FLOAT_TYPE = 2
LINES_OF_A_BLOCK = {0: 1, 2: 1, 3: 16}  # by compression: none, zip of single lines, zip


class Reader:
    def __init__(self, data):
        self.data, self.place = data, 0

    def text(self):
        end = self.data.index(b"\0", self.place)
        value = self.data[self.place:end].decode()
        self.place = end + 1
        return value

    def numbers(self, form):
        values = struct.unpack_from("<" + form, self.data, self.place)
        self.place += struct.calcsize("<" + form)
        return values


def read_channels(data):
    """Names of a channel list, in the order of the file; all must be floats at every pixel."""
    reader, names = Reader(data), []
    while name := reader.text():
        kind, _, x_step, y_step = reader.numbers("iiii")
        if (x_step, y_step) != (1, 1):
            raise ValueError(f"channel {name} is not there for every pixel")
        names.append((name, kind))
    return names


def unzipped(block):
    """Undoes what OpenEXR does before zip: bytes as differences to the one before, first those in even places."""
    data = bytearray(zlib.decompress(block))
    for i in range(1, len(data)):
        data[i] = (data[i - 1] + data[i] - 128) & 255
    half = (len(data) + 1) // 2
    result = bytearray(len(data))
    result[0::2], result[1::2] = data[:half], data[half:]
    return bytes(result)


def read_rgb(path):
    """Width, height, and three lists of values row by row: R, G and B."""
    data = path.read_bytes()
    reader = Reader(data)
    magic, version = reader.numbers("ii")
    if magic != MAGIC or version & MULTI_PART_OR_TILED:
        raise ValueError(f"{path}: is not an OpenEXR file of one part in scan lines")
    header = {}
    while name := reader.text():
        reader.text()
        (size,) = reader.numbers("i")
        header[name] = data[reader.place:reader.place + size]
        reader.place += size
    names = read_channels(header["channels"])
    if any(kind == 1 for _, kind in names) or not {("R", FLOAT_TYPE), ("G", FLOAT_TYPE), ("B", FLOAT_TYPE)} <= set(names):
        raise ValueError(f"{path}: R, G and B must be 32-bit floats")
    lines = LINES_OF_A_BLOCK.get(header["compression"][0])
    if lines is None:
        raise ValueError(f"{path}: is packed in another way than by zip")
    left, top, right, bottom = struct.unpack("<iiii", header["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    count = -(-height // lines)
    planes = {name: array.array("f", bytes(4 * width * height)) for name in "RGB"}
    for offset in reader.numbers(f"{count}Q"):
        first, size = struct.unpack_from("<ii", data, offset)
        first -= top
        rows = min(lines, height - first)
        block = data[offset + 8:offset + 8 + size]
        if len(block) < 4 * width * len(names) * rows:
            block = unzipped(block)
        values = array.array("f", block)
        if sys.byteorder == "big":
            values.byteswap()
        for row in range(rows):
            for i, (name, _) in enumerate(names):
                if name in planes:
                    start = (row * len(names) + i) * width
                    planes[name][(first + row) * width:(first + row + 1) * width] = values[start:start + width]
    return width, height, [planes[name] for name in "RGB"]
