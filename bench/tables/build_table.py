#!/usr/bin/env python3
"""Writes what `grove_build_bench --structure fast:quality=low … --json F` measured of the qualities of `fast` into docs/performance.md, between its marks, or prints it.

usage: build_table.py F.json [--into docs/performance.md]

Each quality stands beside Embree's of the same name: low builds along the Morton curve, medium by bins, high with spatial splits.
"""
import argparse
import json
from pathlib import Path

import marked_page
from rival_table import geometric_mean, short, table

# As the benchmark names builders, and how many times as fast as Embree's of that quality they are to be.
QUALITIES = {
    "low": ("fast:quality=low", "embree low robust", 1.0),
    "medium": ("fast", "embree medium robust", 1.25),
    "high": ("fast:quality=high", "embree high", 1.0),
}
THREADS = {"seconds_one_thread": "one thread", "seconds_all_threads": "all threads"}


def seconds(scene, builder, threads):
    for row in scene["rows"]:
        if row["builder"] == builder:
            return row[threads]["median"]
    raise SystemExit(f"{scene['scene']}: has no {builder}; run: grove_build_bench --structure fast --structure fast:quality=low --structure fast:quality=high --json F")


def measured(scenes):
    """Which numbers of threads were: all are left out where the machine has one."""
    return {key: name for key, name in THREADS.items() if key == "seconds_one_thread" or scenes[0]["threads"] > 1}


def scene_table(scenes):
    rows = []
    for scene in scenes:
        cells = [short(scene["scene"]), f"{scene['triangles']:,}"]
        for own, rival, _ in QUALITIES.values():
            cells += [f"{seconds(scene, own, threads):.3f} / {seconds(scene, rival, threads):.3f}" for threads in measured(scenes)]
        rows.append(cells)
    headings = [f"{quality}, {threads}" for quality in QUALITIES for threads in measured(scenes).values()]
    return table(["scene", "triangles", *headings], rows)


def goal_table(scenes):
    rows = []
    for quality, (own, rival, goal) in QUALITIES.items():
        cells = [quality, f"{goal:g}"]
        for threads in measured(scenes):
            ratios = [seconds(scene, rival, threads) / seconds(scene, own, threads) for scene in scenes]
            cells.append(f"{geometric_mean(ratios):.2f} ({min(ratios):.2f})")
        rows.append(cells)
    return table(["quality", "goal", *measured(scenes).values()], rows)


def text(report):
    scenes, machine = report["scenes"], report["machine"]
    return "\n".join(
        (
            f"{machine['cpu']}, {machine['cores']} cores, {machine['compiler']}, {machine['os']}; threads: {scenes[0]['threads']}.\n",
            "How many times as fast as Embree's quality of the same name `fast` is built, geometric mean over the scenes, and the worst:\n",
            goal_table(scenes),
            "Seconds, medians, `fast` / Embree:\n",
            scene_table(scenes),
        )
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("report", type=Path)
    marked_page.add_option(parser)
    options = parser.parse_args()
    report = json.loads(options.report.read_text())
    if "builder" not in report["scenes"][0].get("rows", [{}])[0]:
        raise SystemExit(f"{options.report}: not written by grove_build_bench --json")
    marked_page.put(text(report), "builders", options.into)


if __name__ == "__main__":
    main()
