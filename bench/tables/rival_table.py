#!/usr/bin/env python3
"""Writes what `grove_rival_bench --json F` measured into docs/performance.md, between its marks, or prints it.

usage: rival_table.py F.json [--samples] [--into docs/performance.md]

--samples makes the table of camera rays alone, of a report of `grove_rival_bench --kinds primary --samples N`, which has a place of its own on the page.

Ratios are rates of Grove's to those of the quickest of a group of Embree's settings on the same scene and rays: quality medium or high, its own choice of
instruction set or AVX2.
"""
import argparse
import json
import math
from pathlib import Path

import marked_page

KINDS = ("primary", "diffuse", "shadow", "random")
# Structure, rays a call, and the group that it is set against.
ROWS = (
    ("fast", 1024, "single"),
    ("fast", 1024, "single robust"),
    ("fast", 1024, "packets of 16"),
    ("fast", 1024, "packets of 16 robust"),
    ("fast", 256, "single"),
    ("fast", 32, "single"),
    ("fast", 8, "single"),
    ("fast", 1, "single robust"),
    ("fast", 1, "single"),
    ("bvh", 1, "single robust"),
)


def short(scene):
    return scene.split("shared/scenes/")[-1].removeprefix("builtin:")


def call(count):
    return "single" if count == 1 else f"{count} a call"


def find(scene, structure, count, group, kind, threads):
    for row in scene.get("ratios", []):
        if (row["structure"], row["rays_per_call"], row["group"], row["rays"], row["threads"]) == (structure, count, group, kind, threads):
            return row["ratio"]
    return None


def spread(ratio):
    return "–" if ratio is None else f"{ratio['median']:.2f} ({ratio['min']:.2f}–{ratio['max']:.2f})"


def table(headings, rows, left=1):
    rule = ["---"] * left + ["---:"] * (len(headings) - left)
    return "\n".join("| " + " | ".join(cells) + " |" for cells in (headings, rule, *rows)) + "\n"


def mean_table(scenes, threads):
    rows = []
    for structure, count, group in ROWS:
        cells = [f"`{structure}`, {call(count)}", group]
        for kind in KINDS:
            found = [find(scene, structure, count, group, kind, threads) for scene in scenes]
            medians = [ratio["median"] for ratio in found if ratio]
            if medians:
                mean = math.exp(sum(map(math.log, medians)) / len(medians))
                cells.append(f"{mean:.2f} ({min(medians):.2f})")
            else:
                cells.append("–")
        rows.append(cells)
    return table(["Grove", "beside Embree's quickest", *KINDS], rows, 2)


def scene_table(scenes, row, threads):
    rows = []
    for scene in scenes:
        cells = [short(scene["scene"]), f"{scene['triangles']:,}"]
        rows.append(cells + [spread(find(scene, *row, kind, threads)) for kind in KINDS])
    return table(["scene", "triangles", *KINDS], rows)


def build_table(scenes):
    def built(scene, name):
        return next(b for b in scene["builds"] if b["structure"] == name and b["threads"] == 1)

    rows = []
    for scene in scenes:
        fast, bvh, medium, high = (built(scene, name) for name in ("fast", "bvh", "embree medium", "embree high"))
        seconds = [f"{one['seconds']['median']:.3f}" for one in (fast, bvh, medium, high)]
        size = [f"{one['bytes_per_triangle']:.0f}" for one in (fast, bvh, medium, high)]
        rows.append([short(scene["scene"]), *seconds, *size])
    names = ("`fast`", "`bvh`", "Embree medium", "Embree high")
    return table(["scene", *(f"{name}, seconds" for name in names), *(f"{name}, bytes a triangle" for name in names)], rows)


def differing(scenes):
    worst = {}
    for scene in scenes:
        for row in scene["agreement"]:
            kind = "Grove" if not row["structure"].startswith("embree") else "Embree robust" if "robust" in row["structure"] else "Embree"
            share = row["differing"] / row["count"]
            worst[kind] = max(worst.get(kind, 0.0), share)
    return ", ".join(f"{kind} {100 * share:.4f} %" for kind, share in sorted(worst.items()))


def text(report):
    scenes, machine = report["scenes"], report["machine"]
    parts = [
        f"{machine['cpu']}, {machine['cores']} cores, {machine['compiler']}, {machine['os']}; {report['rays']:,} rays of each kind, {report['rounds']} "
        f"rounds of tracing and {report['build_rounds']} of building. Most rays that differ from `fast` in any scene, kind and way: {differing(scenes)}.\n"
    ]
    for threads in sorted({row["threads"] for scene in scenes for row in scene["rates"]}):
        where = "one pinned thread" if threads == 1 else f"{threads} threads"
        parts.append(f"Geometric mean over the scenes, and the worst, {where}:\n")
        parts.append(mean_table(scenes, threads))
    for row in ROWS[:3]:
        parts.append(f"`{row[0]}`, {call(row[1])}, beside Embree's quickest of {row[2]}, one pinned thread, median (min–max):\n")
        parts.append(scene_table(scenes, row, 1))
    parts.append("Building on one pinned thread, medians, and what is kept:\n")
    parts.append(build_table(scenes))
    return "\n".join(parts)


def text_of_samples(report):
    scenes = report["scenes"]
    groups = ("single", "single robust", "packets of 8", "packets of 16", "packets of 16 robust")
    rows = []
    for scene in scenes:
        rows.append([short(scene["scene"]), *(spread(find(scene, "fast", 1024, group, "primary", 1)) for group in groups)])
    heading = f"Camera rays, {report['samples_per_pixel']} of each pixel one after another, {report['rays']:,} in all, {report['rounds']} rounds: "
    return heading + "`fast`, 1024 a call, beside Embree's quickest of each group, one pinned thread, median (min–max):\n\n" + table(["scene", *groups], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("report", type=Path)
    parser.add_argument("--samples", action="store_true", help="the table of camera rays alone")
    marked_page.add_option(parser)
    options = parser.parse_args()
    report = json.loads(options.report.read_text())
    if report.get("format") != "grove-rivals":
        raise SystemExit(f"{options.report}: not written by grove_rival_bench --json")
    if options.samples:
        marked_page.put(text_of_samples(report), "rivals of samples", options.into)
    else:
        marked_page.put(text(report), "rivals", options.into)


if __name__ == "__main__":
    main()
