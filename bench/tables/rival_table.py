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
    ("fast:triangles=fast", 1024, "single"),
    ("fast:triangles=fast", 1, "single"),
    ("bvh", 1, "single robust"),
)
INCOHERENT = ("diffuse", "shadow", "random")
# What is to be reached: query, structure, rays a call, the group that it is set against, kinds of rays with the geometric mean of each, and the worst scene.
GOALS = (
    ("batch, watertight", "fast", 1024, "single", dict(zip(INCOHERENT, (2.4, 2.4, 3.0))), 1.8),
    ("batch, `triangles=fast`", "fast:triangles=fast", 1024, "single", dict(zip(INCOHERENT, (2.8, 2.8, 3.5))), 2.0),
    ("batch, watertight", "fast", 1024, "packets of 16", dict.fromkeys(INCOHERENT, 2.0), 1.0),
    ("batch of camera rays, watertight", "fast", 1024, "packets of 16", {"primary": 1.5}, 1.1),
    ("single ray, watertight", "fast", 1, "single robust", dict.fromkeys(KINDS, 1.2), 1.0),
    ("single ray, `triangles=fast`", "fast:triangles=fast", 1, "single", dict.fromkeys(KINDS, 1.1), 0.95),
    ("batches of 8, watertight", "fast", 8, "single", dict.fromkeys(KINDS, 1.3), 1.0),
    ("batches of 32, watertight", "fast", 32, "single", dict.fromkeys(KINDS, 1.7), 1.0),
)
# Of all threads beside one: the mean, and the worst scene.
THREADS_GOAL = (1.9, 1.8)


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


def geometric_mean(values):
    return math.exp(sum(map(math.log, values)) / len(values))


def rate(scene, structure, count, kind, threads):
    for row in scene["rates"]:
        if (row["structure"], row["rays_per_call"], row["rays"], row["threads"]) == (structure, count, kind, threads):
            return row["mrays_per_s"]["median"]
    return None


def thread_ratios(scenes, structure, count, kind):
    """Of each scene where both were measured: rays a second with all threads to those with one."""
    threads = max(row["threads"] for scene in scenes for row in scene["rates"])
    pairs = [(rate(scene, structure, count, kind, threads), rate(scene, structure, count, kind, 1)) for scene in scenes] if threads > 1 else []
    return [whole / one for whole, one in pairs if whole and one]


def thread_table(scenes):
    rows = []
    for structure, count in (("fast", 1024), ("fast", 1), ("bvh", 1), ("embree medium", 1), ("embree medium", 16)):
        cells = [f"`{structure}`, {call(count)}" if not structure.startswith("embree") else f"Embree medium, {'single' if count == 1 else 'packets of 16'}"]
        for kind in KINDS:
            ratios = thread_ratios(scenes, structure, count, kind)
            cells.append(f"{geometric_mean(ratios):.2f} ({min(ratios):.2f})" if ratios else "–")
        rows.append(cells)
    return table(["all threads / one", *KINDS], rows)


def goal_row(query, rival, goals, worst_goal, ratios):
    """`goals` and `ratios` are by kind of rays."""
    reached = {kind: found for kind, found in ratios.items() if found}
    means = " / ".join(f"{geometric_mean(reached[kind]):.2f}" if kind in reached else "–" for kind in goals)
    worst = f"{min(min(found) for found in reached.values()):.2f}" if reached else "–"
    wanted = " / ".join(f"{goal:.1f}" for goal in goals.values()) if len(set(goals.values())) > 1 else f"{next(iter(goals.values())):.1f}"
    return [query, rival, " / ".join(goals), wanted, means, f"{worst_goal:g}", worst]


def goal_table(scenes):
    rows = []
    for query, structure, count, group, goals, worst in GOALS:
        ratios = {}
        for kind in goals:
            found = [find(scene, structure, count, group, kind, 1) for scene in scenes]
            ratios[kind] = [ratio["median"] for ratio in found if ratio]
        rows.append(goal_row(query, f"Embree, {group}", goals, worst, ratios))
    ratios = {kind: thread_ratios(scenes, "fast", 1024, kind) for kind in KINDS}
    rows.append(goal_row("all threads, batch", "one thread", dict.fromkeys(KINDS, THREADS_GOAL[0]), THREADS_GOAL[1], ratios))
    return table(["query", "beside", "rays", "goal, geometric mean", "reached", "goal, worst scene", "reached"], rows, 3)


def mean_table(scenes, threads):
    rows = []
    for structure, count, group in ROWS:
        cells = [f"`{structure}`, {call(count)}", group]
        for kind in KINDS:
            found = [find(scene, structure, count, group, kind, threads) for scene in scenes]
            medians = [ratio["median"] for ratio in found if ratio]
            if medians:
                cells.append(f"{geometric_mean(medians):.2f} ({min(medians):.2f})")
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
    if any(row["threads"] > 1 for scene in scenes for row in scene["rates"]):
        parts.append("Rays a second with all threads to those with one, geometric mean and the worst scene:\n")
        parts.append(thread_table(scenes))
    parts.append("What is aimed at, one pinned thread (but for the last line), batches of 1,024 rays, geometric mean over the scenes, and the worst of scenes and kinds:\n")
    parts.append(goal_table(scenes))
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
