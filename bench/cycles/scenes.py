"""The scenes that Grove and Cycles are compared on: glTF files of a folder of scenes, and two that are written here."""

import dataclasses
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "plots"))
import materials  # noqa: E402


@dataclasses.dataclass
class Scene:
    """A file and how it is looked at. Both renderers put the sky round it, and light from it alone where there are no emissive surfaces."""
    name: str
    file: object  # a path within the folder of scenes, or a function that writes the file
    eye: tuple
    look_at: tuple
    fov: float  # from bottom to top, degrees
    sky: tuple = (1.0, 1.0, 1.0)
    up: tuple = (0.0, 1.0, 0.0)
    credit: str = ""

    def path(self, folder, work):
        if not callable(self.file):
            return folder / self.file
        path = work / f"{self.name}.gltf"
        self.file(path)
        return path


def write_materials(path):
    """The spheres of bench/plots/materials.py. Lamps shine from both sides, since Cycles has no others."""
    materials.make_scene(path)
    scene = json.loads(path.read_text())
    for material in scene["materials"]:
        if "emissiveFactor" in material:
            material["doubleSided"] = True
    path.write_text(json.dumps(scene))


def write_room(path):
    """A white room with a red and a green wall, open towards the viewer, a lamp below its ceiling, a box that turns to the left and a sphere of metal."""
    gltf = materials.Gltf()
    white, red, green = (0.73, 0.73, 0.73), (0.63, 0.06, 0.05), (0.14, 0.45, 0.09)

    def wall(corner, along, up, colour):
        gltf.add(gltf.shape(*materials.rectangle(corner, along, up)), dict(materials.surface(colour, 0.0, 1.0), doubleSided=True))

    wall((-1, -1, -1), (2, 0, 0), (0, 2, 0), white)
    wall((-1, -1, 1), (2, 0, 0), (0, 0, -2), white)
    wall((-1, 1, -1), (2, 0, 0), (0, 0, 2), white)
    wall((-1, -1, 1), (0, 0, -2), (0, 2, 0), red)
    wall((1, -1, -1), (0, 0, 2), (0, 2, 0), green)
    x, z, side, height, base = -0.35, -0.3, 0.3, 1.2, -0.9999
    corners = [(x - side, z + 0.3 * side), (x + 0.3 * side, z + side), (x + side, z - 0.3 * side), (x - 0.3 * side, z - side)]
    for (x0, z0), (x1, z1) in zip(corners, corners[1:] + corners[:1]):
        wall((x0, base, z0), (x1 - x0, 0, z1 - z0), (0, height, 0), white)
    (x0, z0), (x1, z1), _, (x3, z3) = corners
    wall((x0, base + height, z0), (x1 - x0, 0, z1 - z0), (x3 - x0, 0, z3 - z0), white)
    gltf.add(gltf.shape(*materials.sphere()), materials.surface((0.9, 0.6, 0.3), 1.0, 0.3), (0.4, -0.5599, 0.25))
    lamp = materials.surface((0, 0, 0), 0.0, 1.0, emissive_strength={"emissiveStrength": 15})
    lamp = dict(lamp, emissiveFactor=[1, 0.8, 0.55], doubleSided=True)
    gltf.add(gltf.shape(*materials.rectangle((-0.25, 0.98, -0.25), (0.5, 0, 0), (0, 0, 0.5))), lamp)
    gltf.write(path)


SCENES = [
    Scene("flight-helmet", "flight-helmet/FlightHelmet.gltf", eye=(0.35, 0.5, 0.95), look_at=(0.0, 0.33, 0.0), fov=38,
          credit="FlightHelmet, Microsoft, converted by Gary Hsu (CC0)"),
    Scene("pine-tree", "pine-tree/scene.gltf", eye=(60.0, 50.0, 115.0), look_at=(0.0, 37.0, 0.0), fov=36,
          credit="Pine Tree [Game-ready] by Oskar \"K1TT3N\" Adamczyk (CC BY 4.0)"),
    Scene("room", write_room, eye=(0, 0, 3.7), look_at=(0, 0, 0), fov=40, sky=(0, 0, 0)),
    Scene("materials", write_materials, eye=(0, 0, 30), look_at=(0, 0, 0), fov=15.4, sky=(0.0, 0.0, 0.0)),
    Scene("morph-stress-test", "animated/MorphStressTest.gltf", eye=(1.2, 1.9, 4.6), look_at=(0.0, 0.15, 0.0), fov=36,
          credit="MorphStressTest by Ed Mackey, Analytical Graphics, Inc. (CC BY 4.0)"),
]
