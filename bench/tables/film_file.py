"""Reads film files of `grove render` for tables of errors; the layout is in src/grove/render/saved/film_file.h."""

import array
import json
import struct

WORDS = 12  # a pixel: sums of radiance, albedo and normal, of squares, and two counts


def luminances(path):
    """Mean luminances of the pixels, in the order of the file, which is the same for all films of one size and part."""
    data = path.read_bytes()
    magic, version, header_size = struct.unpack_from("<8sII", data)
    if magic != b"GROVFILM" or version != 2:
        raise ValueError(f"{path} is no film file of version 2")
    first = 16 + header_size
    header = json.loads(data[16:first])
    pixels = header["width"] * header["height"]
    floats = array.array("f", data[first:first + 4 * WORDS * pixels])
    counts = array.array("I", data[first:first + 4 * WORDS * pixels])
    values = []
    for i in range(0, WORDS * pixels, WORDS):
        count = max(1, counts[i + 10])
        values.append((0.2126 * floats[i] + 0.7152 * floats[i + 1] + 0.0722 * floats[i + 2]) / count)
    return values
