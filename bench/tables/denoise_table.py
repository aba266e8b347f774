#!/usr/bin/env python3
"""What `grove render --denoise` makes of few samples, as Markdown tables: errors against a picture of another seed with many samples, and seconds.

For each scene: still pictures as they are and filtered; frames of a camera that stands still, which go on from each other; and the last frame of a camera that
turns a little, which ends where the still pictures were taken, so that one reference serves for all.

References take long. They are kept with their films in --work, and the same command goes on from there.

usage: denoise_table.py GROVE [--scenes DIR] [--work DIR] [--only NAME,NAME] [--reference-spp N] [--frames N] [--scale S] [--turn DEGREES] [--into docs/rendering.md]
"""

import argparse
import dataclasses
import json
import math
import statistics
import subprocess
from pathlib import Path

import marked_page

HEADINGS = ["scene", "samples", "filter", "RMSE", "relMSE", "FLIP", "HDR-FLIP", "mean", "filtered in", "whole"]


@dataclasses.dataclass
class Scene:
    """A file with the camera that it describes, and a point to turn round."""

    file: str
    width: int
    height: int
    eye: tuple
    target: tuple
    field_of_view: float


SCENES = {
    "cornell-box": Scene("cornell-box/scene-v4.pbrt", 256, 256, (0, 1, 6.8), (0, 1, 0), 19.5),
    "classroom": Scene("classroom/scene-v4.pbrt", 320, 180, (-1.690484, 1.271575, 5.88653), (-1.085308, 1.384803, 1.934198), 35.9834),
    "country-kitchen": Scene("country-kitchen/scene-v4.pbrt", 320, 180, (1.211004, 1.80475, 3.852393), (-0.103296, 1.679739, 1.158513), 35.9834),
}


def turned(scene, degrees):
    """The eye, turned round the target about the vertical, counter-clockwise seen from above."""
    x, y, z = (e - t for e, t in zip(scene.eye, scene.target))
    angle = math.radians(degrees)
    offset = (math.cos(angle) * x + math.sin(angle) * z, y, math.cos(angle) * z - math.sin(angle) * x)
    return tuple(o + t for o, t in zip(offset, scene.target))


def vector(values):
    return ",".join(f"{value:.9g}" for value in values)


class Renders:
    def __init__(self, options, name):
        self.options = options
        self.name = name
        self.scene = SCENES[name]
        self.work = options.work / f"{name}.{options.size_of(self.scene)[0]}"
        self.work.mkdir(parents=True, exist_ok=True)

    def run(self, eye, *more):
        scene = self.scene
        width, height = self.options.size_of(scene)
        figures = self.work / "figures.json"
        subprocess.run([self.options.grove, "render", self.options.scenes / scene.file, "--structure", "fast", "--width", str(width), "--height",
                        str(height), "--eye", vector(eye), "--look-at", vector(scene.target), "--fov", str(scene.field_of_view), "--layers", "none",
                        "--json", figures, "--quiet", *map(str, more)], check=True)
        return json.loads(figures.read_text())

    def reference(self):
        spp = self.options.reference_spp
        file = self.work / f"reference.{spp}.exr"
        if not file.exists():
            # An interrupted render writes what it has: that is not yet a reference.
            part = file.with_suffix(".part.exr")
            self.run(self.scene.eye, "-o", part, "--spp", spp, "--seed", 1000, "--checkpoint", file.with_suffix(".film"))
            part.rename(file)
        return file

    def still(self, spp, way):
        figures = self.run(self.scene.eye, "-o", self.work / f"still.{spp}.{way}.png", "--spp", spp, "--denoise", way, "--compare", self.reference())
        return figures["comparison"], figures["denoise_seconds"], figures["render_seconds"] + figures["denoise_seconds"]

    def frames(self, spp, way, turn):
        """The comparison of each frame, and medians of seconds over them."""
        count = self.options.frames
        moving = ["--camera", "orbit", "--turn", turn * count / (count - 1)] if turn else []
        begin = turned(self.scene, -turn) if turn else self.scene.eye
        figures = self.run(begin, "-o", self.work / f"{'moving' if turn else 'standing'}.{spp}.{way}.%02d.png", "--frames", f"0:{count}", "--spp", spp,
                           "--denoise", way, "--compare", self.reference(), *moving)["frames"]
        filtering = statistics.median(frame["denoise_seconds"] for frame in figures)
        whole = statistics.median(frame["render_seconds"] + frame["update_seconds"] + frame["pose_seconds"] + frame["denoise_seconds"] for frame in figures)
        return [frame["comparison"] for frame in figures], filtering, whole


def cells(comparison, filtering, whole):
    seconds = ["–" if filtering == 0 else f"{filtering:.3f} s", "" if whole is None else f"{whole:.2f} s"]
    return [f"{comparison[key]:.3g}" for key in ("rmse", "relative_mse", "flip", "hdr_flip")] + [f"{100 * comparison['relative_bias']:+.1f} %"] + seconds


def table(headings, rows):
    return "\n".join("| " + " | ".join(row) + " |" for row in (headings, ["---"] * len(headings), *rows)) + "\n"


def still_rows(renders):
    return [[renders.name, str(spp), way, *cells(*renders.still(spp, way))] for spp in (1, 4, 16) for way in ("off", "spatial")]


def standing_rows(renders, count):
    rows = []
    for spp in (1, 4):
        comparisons, filtering, whole = renders.frames(spp, "temporal", 0)
        for number in (1, 4, count):
            mean, _, _ = renders.still(spp * number, "off")
            rows.append([renders.name, f"{number} x {spp}", "off", *cells(mean, 0, None)])
            rows.append([renders.name, f"{number} x {spp}", "temporal", *cells(comparisons[number - 1], filtering, whole)])
    return rows


def moving_rows(renders):
    rows = []
    for spp in (1, 4):
        for way in ("off", "spatial", "temporal"):
            comparisons, filtering, whole = renders.frames(spp, way, renders.options.turn)
            rows.append([renders.name, str(spp), way, *cells(comparisons[-1], filtering, whole)])
    return rows


def text(options):
    still, standing, moving = [], [], []
    for name in options.only.split(","):
        renders = Renders(options, name)
        still += still_rows(renders)
        standing += standing_rows(renders, options.frames)
        moving += moving_rows(renders)
    sizes = ", ".join("{} {} x {}".format(name, *options.size_of(SCENES[name])) for name in options.only.split(","))
    return "\n".join([
        f"Errors against {options.reference_spp} samples of another seed ({sizes}); the last columns are what the filter took, and the whole frame with it.\n",
        "Still pictures:\n",
        table(HEADINGS, still),
        "Frames of a camera that stands still, after so many of them; `off` is the plain mean of as many samples, which they tend to:\n",
        table([HEADINGS[0], "frames x samples", *HEADINGS[2:]], standing),
        f"The last of {options.frames} frames of a camera that turns by {options.turn:g} degrees round something before it:\n",
        table(HEADINGS, moving),
    ])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("grove")
    parser.add_argument("--scenes", type=Path, default=Path(__file__).resolve().parents[3] / "shared" / "scenes", help="where the scenes' folders are")
    parser.add_argument("--work", type=Path, default=Path("build/denoise"), help="where pictures, references and their films go")
    parser.add_argument("--only", default="cornell-box,classroom", help="some of " + ", ".join(SCENES))
    parser.add_argument("--reference-spp", type=int, default=4096)
    parser.add_argument("--scale", type=float, default=1.0, help="of the pictures' width and height")
    parser.add_argument("--frames", type=int, default=16)
    parser.add_argument("--turn", type=float, default=7.5, help="degrees that the camera turns by from the first frame to the last")
    parser.add_argument("--references-only", action="store_true")
    marked_page.add_option(parser)
    options = parser.parse_args()
    options.size_of = lambda scene: (round(options.scale * scene.width), round(options.scale * scene.height))
    if options.references_only:
        for name in options.only.split(","):
            Renders(options, name).reference()
        return
    result = text(options)
    marked_page.put(result, "denoise", options.into)


if __name__ == "__main__":
    main()
