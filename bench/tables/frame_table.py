#!/usr/bin/env python3
"""What the time of a frame of an animation goes into, as a Markdown table: for each structure and each way of following what moves, medians over the frames after the first.

`update` is moving nodes and vertices and having the structure follow; `trace` and `shade` are those of rays traced in batches, sums over threads divided by their number; `layers` is the tracing of
camera rays once more for depth, motion and what is emitted; `filter` is the denoiser. Structures take turns, round by round.

usage: frame_table.py GROVE [SCENE] [--frames a:b] [--rounds K] [--more "OPTIONS OF GROVE RENDER"] [--into docs/rendering.md]
"""

import argparse
import json
import shlex
import statistics
import subprocess
import tempfile
from pathlib import Path

import marked_page

ROWS = (("fast", "auto"), ("fast", "rebuild"), ("bvh", "auto"), ("bvh", "refit"), ("bvh", "rebuild"))
COLUMNS = ("update", "trace", "shade", "layers", "filter", "frame")


def render(options, structure, update):
    with tempfile.TemporaryDirectory() as name:
        figures = Path(name) / "figures.json"
        subprocess.run([options.grove, "render", options.scene, "-o", Path(name) / "f.%04d.png", "--structure", structure, "--update", update, "--frames",
                        options.frames, "--spp", str(options.spp), "--width", str(options.width), "--height", str(options.height), "--denoise", "temporal",
                        "--json", figures, "--quiet", *options.more], check=True)
        return json.loads(figures.read_text())


def split(frame, threads):
    update = frame["pose_seconds"] + frame["update_seconds"]
    return {
        "update": update,
        "trace": frame["trace_seconds"] / threads,
        "shade": frame["shade_seconds"] / threads,
        "layers": frame["gather_seconds"],
        "filter": frame["denoise_seconds"],
        "frame": update + frame["render_seconds"] + frame["denoise_seconds"],
        "growth": frame["cost_growth"],
    }


def milliseconds(seconds):
    return f"{1e3 * seconds:.3g} ms" if seconds < 0.0995 else f"{1e3 * seconds:.0f} ms"


def text(options):
    frames = {row: [] for row in ROWS}
    for _ in range(options.rounds):
        for row in ROWS:
            figures = render(options, *row)
            frames[row] += [split(frame, figures["threads"]) for frame in figures["frames"] if not frame["built"]]
    lines = ["| structure | `--update` | cost of a ray | " + " | ".join(COLUMNS) + " |", "| --- | --- | " + "---: | " * (len(COLUMNS) + 1)]
    for (structure, update), rows in frames.items():
        median = {key: statistics.median(row[key] for row in rows) for key in rows[0]}
        cells = " | ".join(milliseconds(median[key]) for key in COLUMNS)
        lines.append(f"| `{structure}` | `{update}` | x {median['growth']:.2f} | {cells} |")
    scene = Path(options.scene).name
    return (f"{scene}, {figures['primitives']} triangles, {options.width} x {options.height} pixels, {options.spp} samples each, `--denoise temporal`, frames "
            f"{options.frames} at {figures['fps']:g} a second, {figures['threads']} threads:\n\n" + "\n".join(line.rstrip() for line in lines) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("grove")
    parser.add_argument("scene", nargs="?", default=str(Path(__file__).resolve().parents[3] / "shared" / "scenes" / "animated" / "Fox.glb"))
    parser.add_argument("--frames", default="0:9")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--spp", type=int, default=4)
    parser.add_argument("--width", type=int, default=1280)
    parser.add_argument("--height", type=int, default=720)
    marked_page.add_option(parser)
    parser.add_argument("--more", type=shlex.split, default="--animation Run --eye 150,75,125 --look-at 0,42,0", help="more options of grove render, in one word")
    options = parser.parse_args()
    result = text(options)
    marked_page.put(result, "frames", options.into)


if __name__ == "__main__":
    main()
