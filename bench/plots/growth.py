#!/usr/bin/env python3
"""How building and tracing grow with the number of triangles: builds structures on scenes of rising size, fits powers of the size, prints the
exponents as a Markdown table and draws both.

usage: growth.py GROVE picture.png [--scene NAME]... [--structures "SPEC;SPEC"] [--most N] [--rounds K] [--count N]

A scene is a built-in one that takes `triangles`, by default builtin:mount and builtin:tree. Needs python3-matplotlib.
"""
import argparse
import json
import math
import subprocess
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

LEAST = 10_000
SPECS = "bvh;bvh:split=sweep;bvh:split=object-median;bvh:split=lbvh;bvh:split=ploc"


def sizes_up_to(most):
    """Two a decade."""
    sizes = []
    half_decade = 0
    while round(LEAST * 10 ** (half_decade / 2)) <= most:
        sizes.append(round(LEAST * 10 ** (half_decade / 2)))
        half_decade += 1
    return sizes


def compare(options, scene, rounds):
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "compare.json"
        command = [options.grove, "compare", scene, "--structures", options.structures, "--rays", "diffuse,random"]
        command += ["--rounds", str(rounds), "--count", str(options.count), "--quiet", "--json", str(report)]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        return json.loads(report.read_text())


def exponent(points):
    """The slope of the line of least squares through the logarithms of (size, value)."""
    logs = [(math.log(size), math.log(value)) for size, value in points]
    mean_x = sum(x for x, _ in logs) / len(logs)
    mean_y = sum(y for _, y in logs) / len(logs)
    return sum((x - mean_x) * (y - mean_y) for x, y in logs) / sum((x - mean_x) ** 2 for x, _ in logs)


def measure(options, scene):
    """{structure: {"build" | "diffuse" | "random": [(triangles, seconds or steps)]}}"""
    curves = {}
    for size in sizes_up_to(options.most):
        # The small ones are quick and noisy, the large ones neither.
        report = compare(options, f"{scene}?triangles={size}", 1 if size > 1_000_000 else options.rounds)
        for row in report["rows"]:
            curve = curves.setdefault(row["structure"], {"build": [], "diffuse": [], "random": []})
            curve[row["rays"]].append((report["primitives"], row["nodes_per_ray"] + row["tests_per_ray"]))
            if row["rays"] == "diffuse":
                curve["build"].append((report["primitives"], row["build_seconds"]["median"]))
    return curves


def print_table(scene, curves):
    print(f"### {scene}\n")
    print("| structure | build s, first to last | exponent | nodes + tests a diffuse ray | exponent | a random ray | exponent |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: |")
    for spec, curve in curves.items():
        cells = []
        for kind in ("build", "diffuse", "random"):
            points = curve[kind]
            cells += [f"{points[0][1]:.3g} – {points[-1][1]:.3g}", f"{exponent(points):.2f}"]
        print(f"| `{spec}` | " + " | ".join(cells) + " |")
    print(flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("grove")
    parser.add_argument("picture")
    parser.add_argument("--scene", action="append", dest="scenes")
    parser.add_argument("--structures", default=SPECS)
    parser.add_argument("--most", type=int, default=10_000_000)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--count", type=int, default=30000)
    options = parser.parse_args()
    scenes = options.scenes or ["builtin:mount", "builtin:tree"]
    figure, panels = plt.subplots(len(scenes), 2, figsize=(10, 3.6 * len(scenes)), squeeze=False)
    for row, scene in zip(panels, scenes):
        curves = measure(options, scene)
        print_table(scene, curves)
        for panel, kind, label in zip(row, ("build", "diffuse"), ("build, s", "nodes + tests a diffuse ray")):
            for spec, curve in curves.items():
                panel.plot(*zip(*curve[kind]), marker="o", markersize=3, linewidth=1.2, label=spec)
            panel.set_xscale("log")
            panel.set_yscale("log")
            panel.set_xlabel("triangles")
            panel.set_ylabel(label)
            panel.set_title(scene, fontsize=9)
        row[0].legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(options.picture, dpi=110)


main()
