#!/usr/bin/env python3
"""Spheres of glTF materials side by side: a row for each parameter, which rises from left to right.

usage: materials.py GROVE picture.png [--spp N] [--width W] [--scene scene.gltf]

Writes the scene as one glTF file without others beside it (--scene keeps it) and renders it. Needs nothing but Python.
"""
import argparse
import base64
import json
import math
import struct
import subprocess
import tempfile
import zlib
from pathlib import Path

COLUMNS = 6


def sphere(rings=48, segments=96):
    positions, normals, uvs, indices = [], [], [], []
    for ring in range(rings + 1):
        polar = math.pi * ring / rings
        for segment in range(segments + 1):
            azimuth = 2 * math.pi * segment / segments
            normal = (math.sin(polar) * math.sin(azimuth), math.cos(polar), math.sin(polar) * math.cos(azimuth))
            positions.append(tuple(0.44 * n for n in normal))
            normals.append(normal)
            uvs.append((segment / segments, ring / rings))
    for ring in range(rings):
        for segment in range(segments):
            a = ring * (segments + 1) + segment
            b = a + segments + 1
            # A quad at a pole has a side of no length.
            if ring > 0:
                indices += [a, b, a + 1]
            if ring < rings - 1:
                indices += [a + 1, b, b + 1]
    return positions, normals, uvs, indices


def rectangle(corner, along, up):
    add = lambda a, b: tuple(x + y for x, y in zip(a, b))
    normal = (along[1] * up[2] - along[2] * up[1], along[2] * up[0] - along[0] * up[2], along[0] * up[1] - along[1] * up[0])
    length = math.sqrt(sum(n * n for n in normal))
    normals = [tuple(n / length for n in normal)] * 4
    corners = [corner, add(corner, along), add(add(corner, along), up), add(corner, up)]
    return corners, normals, [(0, 1), (1, 1), (1, 0), (0, 0)], [0, 1, 2, 0, 2, 3]


def png(width, height, pixel):
    rows = b"".join(b"\0" + bytes(c for x in range(width) for c in pixel(x, y)) for y in range(height))
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    data = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")
    return "data:image/png;base64," + base64.b64encode(data).decode()


class Gltf:
    def __init__(self):
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "extensionsUsed": []}
        for name in ("accessors", "bufferViews", "meshes", "nodes", "materials", "textures", "images", "samplers", "cameras"):
            self.json[name] = []
        self.binary = b""

    def array(self, values, kind):
        code, component = ("I", 5125) if kind == "SCALAR" else ("f", 5126)
        flat = values if kind == "SCALAR" else [x for v in values for x in v]
        data = struct.pack("<" + code * len(flat), *flat)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)})
        self.binary += data
        accessor = {"bufferView": len(self.json["bufferViews"]) - 1, "componentType": component, "count": len(values), "type": kind}
        self.json["accessors"].append(accessor)
        return len(self.json["accessors"]) - 1

    def shape(self, positions, normals, uvs, indices):
        attributes = {"POSITION": self.array(positions, "VEC3"), "NORMAL": self.array(normals, "VEC3"), "TEXCOORD_0": self.array(uvs, "VEC2")}
        return {"attributes": attributes, "indices": self.array(indices, "SCALAR")}

    def texture(self, uri):
        self.json["images"].append({"uri": uri})
        self.json["textures"].append({"source": len(self.json["images"]) - 1})
        return len(self.json["textures"]) - 1

    def add(self, shape, material, translation=(0, 0, 0)):
        for name in material.get("extensions", {}):
            if name not in self.json["extensionsUsed"]:
                self.json["extensionsUsed"].append(name)
        self.json["materials"].append(material)
        self.json["meshes"].append({"primitives": [dict(shape, material=len(self.json["materials"]) - 1)]})
        self.node({"mesh": len(self.json["meshes"]) - 1, "translation": list(translation)})

    def node(self, node):
        self.json["nodes"].append(node)
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)

    def write(self, path):
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.binary).decode()
        self.json["buffers"] = [{"byteLength": len(self.binary), "uri": uri}]
        self.json = {key: value for key, value in self.json.items() if value != []}
        path.write_text(json.dumps(self.json))


def surface(colour, metallic=0.0, roughness=0.5, **extensions):
    pbr = {"baseColorFactor": [*colour, 1], "metallicFactor": metallic, "roughnessFactor": roughness}
    return {"pbrMetallicRoughness": pbr, "extensions": {f"KHR_materials_{name}": value for name, value in extensions.items()}}


def rows(ripples):
    """A function of a number from 0 to 1 for each row."""
    red, blue, white, wine = (0.6, 0.05, 0.03), (0.03, 0.1, 0.45), (1, 1, 1), (0.25, 0.02, 0.06)
    gold = (1.0, 0.72, 0.3)

    def bumpy(x):
        material = surface(red, 0.0, 0.6, clearcoat={"clearcoatFactor": x})
        material["normalTexture"] = {"index": ripples, "extensions": {"KHR_texture_transform": {"scale": [24, 12]}}}
        return material

    def cut_out(x):
        material = surface(blue, 0.0, 0.4)
        material["pbrMetallicRoughness"]["baseColorFactor"][3] = 1 - x
        return dict(material, alphaMode="BLEND", doubleSided=True)

    return [
        ("metal, roughness", lambda x: surface(gold, 1.0, x)),
        ("dielectric, specular", lambda x: surface(red, 0.0, 0.15, specular={"specularFactor": x})),
        ("clear coat on ripples", bumpy),
        ("clear coat, roughness", lambda x: surface(blue, 0.0, 0.7, clearcoat={"clearcoatFactor": 1.0, "clearcoatRoughnessFactor": x})),
        ("sheen, roughness", lambda x: surface(wine, 0.0, 0.9, sheen={"sheenColorFactor": [1, 0.6, 0.7], "sheenRoughnessFactor": 0.1 + 0.9 * x})),
        ("thin transmission, roughness", lambda x: surface((0.7, 0.9, 1), 0.0, x, transmission={"transmissionFactor": 1.0})),
        (
            "volume, attenuation",
            lambda x: surface(
                white,
                0.0,
                0.0,
                transmission={"transmissionFactor": 1.0},
                volume={"thicknessFactor": 1, "attenuationDistance": 2 / 2 ** ((COLUMNS - 1) * x), "attenuationColor": [0.6, 0.85, 0.7]},
            ),
        ),
        ("blend, 1 - alpha", cut_out),
    ]


def make_scene(path):
    gltf = Gltf()
    tiles = gltf.texture(png(2, 2, lambda x, y: (225,) * 3 if (x + y) % 2 else (110,) * 3))
    wave = lambda x: math.sin(2 * math.pi * x / 32) * 0.4
    as_byte = lambda v: round(127.5 + 127.5 * v)
    ripples = gltf.texture(png(32, 32, lambda x, y: (as_byte(wave(x)), as_byte(wave(y)), as_byte(math.sqrt(1 - wave(x) ** 2 - wave(y) ** 2)))))
    gltf.json["samplers"].append({"magFilter": 9728})
    gltf.json["textures"][tiles]["sampler"] = 0
    ball = gltf.shape(*sphere())
    all_rows = rows(ripples)
    for row, (_, material) in enumerate(all_rows):
        for column in range(COLUMNS):
            gltf.add(ball, material(column / (COLUMNS - 1)), (column - (COLUMNS - 1) / 2, (len(all_rows) - 1) / 2 - row, 0))
    wall = surface((1, 1, 1), 0.0, 1.0)
    scale = {"KHR_texture_transform": {"scale": [33.5, 33.5]}}
    wall["pbrMetallicRoughness"]["baseColorTexture"] = {"index": tiles, "extensions": scale}
    gltf.add(gltf.shape(*rectangle((-10, -10, -0.9), (20, 0, 0), (0, 20, 0))), wall)
    gltf.json["extensionsUsed"].append("KHR_texture_transform")
    for corner, along, up, strength in (
        ((-6, 5.5, 2), (7, 0, 0), (0, 1.5, 5), 6),
        ((4.5, -4, 8), (4, 0, -6), (0, 8, 0), 3),
        ((-9, -6, 2), (3, 0, 6), (0, 10, 0), 1.5),
    ):
        middle = [c + (a + u) / 2 for c, a, u in zip(corner, along, up)]
        shape = rectangle(corner, along, up)
        # The front looks at the spheres.
        if sum(n * m for n, m in zip(shape[1][0], middle)) > 0:
            shape = rectangle(corner, up, along)
        lamp = surface((0, 0, 0), 0.0, 1.0, emissive_strength={"emissiveStrength": strength})
        gltf.add(gltf.shape(*shape), dict(lamp, emissiveFactor=[1, 1, 1]))
    height = len(all_rows) + 0.1
    distance = 30.0
    lens = {"yfov": 2 * math.atan(height / 2 / distance), "znear": 0.1, "aspectRatio": (COLUMNS + 0.1) / height}
    gltf.json["cameras"].append({"type": "perspective", "perspective": lens})
    gltf.node({"camera": 0, "translation": [0, 0, distance]})
    gltf.write(path)
    return (COLUMNS + 0.1) / height


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("grove")
    parser.add_argument("picture")
    parser.add_argument("--spp", type=int, default=160)
    parser.add_argument("--width", type=int, default=270)
    parser.add_argument("--scene")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        scene = Path(options.scene or Path(folder) / "materials.gltf")
        aspect = make_scene(scene)
        size = ["--width", str(options.width), "--height", str(round(options.width / aspect))]
        command = [options.grove, "render", str(scene), "-o", options.picture, "--spp", str(options.spp), "--max-depth", "16", *size]
        subprocess.run(command, check=True)


if __name__ == "__main__":
    main()
