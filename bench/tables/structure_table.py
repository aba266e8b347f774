#!/usr/bin/env python3
"""Compares structures on several scenes and prints Markdown: a summary over the scenes, one structure scene by scene, and a table for each scene.

usage: structure_table.py GROVE [--family NAME | --structures "SPEC;SPEC"] [--rounds K] [--count N] [--summary] SCENE...

Each figure of the summary is relative to the first structure's. A family stands for the structures that its page in docs/ compares: bvh (docs/bvh.md has
three scenes, docs/bvh-scenes.md all) and kdtree (docs/kdtree.md, docs/kdtree-scenes.md).
"""
import argparse
import json
import math
import subprocess
import tempfile
from pathlib import Path

FAMILIES = {
    "bvh": (
        "bvh",
        "bvh:split=sweep",
        "bvh:split=spatial",
        "bvh:split=object-median",
        "bvh:split=spatial-median",
        "bvh:split=lbvh",
        "bvh:split=ploc",
        "bvh:optimize=reinsertion",
        "bvh:split=spatial,optimize=reinsertion",
        "bvh:cost=equation-2",
        "bvh:arity=4",
        "bvh:arity=4,widen=greedy",
        "bvh:arity=8",
        "bvh:arity=8,widen=greedy",
        "bvh:bounds=obb",
        "bvh:bounds=sphere",
    ),
    "kdtree": (
        "bvh",
        "bvh:split=spatial",
        "kdtree",
        "kdtree:split=binned",
        "kdtree:split=object-median",
        "kdtree:split=spatial-median",
    ),
}


def compare(options, scene):
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "compare.json"
        command = [options.grove, "compare", scene, "--structures", ";".join(options.structures), "--rays", "diffuse,random"]
        command += ["--rounds", str(options.rounds), "--count", str(options.count), "--quiet", "--json", str(report)]
        if options.threads:
            command += ["--threads", str(options.threads)]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        return json.loads(report.read_text())


def number(value, digits=3):
    if value is None:
        return "–"
    text = f"{value:.{digits}g}"
    return f"{value:,.0f}" if "e" in text else text


def rows_of(report):
    """{structure: {kind of rays: row}}"""
    rows = {}
    for row in report["rows"]:
        rows.setdefault(row["structure"], {})[row["rays"]] = row
    return rows


def print_table(scene, report):
    rows = rows_of(report)
    # What tells families apart: hierarchies may overlap, cells refer to a primitive more than once.
    has_cells = any(kinds["diffuse"]["end_point_overlap"] is None for kinds in rows.values())
    label, key = ("references", "references") if has_cells else ("end-point overlap", "end_point_overlap")
    print(f"## {scene}: {report['primitives']:,} primitives\n")
    print(f"| structure | build ms | MiB | expected cost | {label} | nodes + tests a ray: diffuse | random | Mrays/s: diffuse | random |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    for spec, kinds in rows.items():
        diffuse, random = kinds["diffuse"], kinds["random"]
        own = f"{diffuse[key]:,}" if has_cells else number(diffuse[key])
        print(
            f"| `{spec}` | {number(1e3 * diffuse['build_seconds']['median'])} | {number(diffuse['bytes'] / 2**20)}"
            f" | {number(diffuse['expected_cost'])} | {own}"
            f" | {number(diffuse['nodes_per_ray'])} + {number(diffuse['tests_per_ray'])}"
            f" | {number(random['nodes_per_ray'])} + {number(random['tests_per_ray'])}"
            f" | {number(diffuse['mrays_per_s']['median'])} | {number(random['mrays_per_s']['median'])} |"
        )
    print(flush=True)


def steps(row):
    return row["nodes_per_ray"] + row["tests_per_ray"]


def speed(row):
    return row["mrays_per_s"]["median"]


def build_time(row):
    return row["build_seconds"]["median"]


def ratio(rows, spec, base, kind, value):
    return value(rows[spec][kind]) / value(rows[base][kind])


def mean(values):
    return math.exp(sum(math.log(v) for v in values) / len(values))


def print_summary(structures, reports):
    """Each figure relative to the first structure's: the geometric mean over the scenes, and the worst of them."""
    print("| structure | build time | nodes + tests a ray: diffuse | worst | random | worst | Mrays/s: diffuse | worst | random | worst |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    scenes = [rows_of(report) for report in reports.values()]
    for spec in structures:
        cells = [f"{mean([ratio(rows, spec, structures[0], 'diffuse', build_time) for rows in scenes]):.2f}"]
        for value, worst in ((steps, max), (speed, min)):
            for kind in ("diffuse", "random"):
                values = [ratio(rows, spec, structures[0], kind, value) for rows in scenes]
                cells += [f"{mean(values):.2f}", f"{worst(values):.2f}"]
        print(f"| `{spec}` | " + " | ".join(cells) + " |")
    print(flush=True)


def print_by_scene(spec, base, reports):
    """One structure relative to another, scene by scene."""
    print(f"| `{spec}` / `{base}` | primitives | build time | bytes | references | nodes + tests: diffuse | random | speed: diffuse | random |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    for scene, report in reports.items():
        rows = rows_of(report)
        cells = [ratio(rows, spec, base, "diffuse", build_time)]
        cells += [ratio(rows, spec, base, "diffuse", lambda row, key=key: row[key]) for key in ("bytes", "references")]
        cells += [ratio(rows, spec, base, kind, value) for value in (steps, speed) for kind in ("diffuse", "random")]
        print(f"| {scene} | {report['primitives']:,} | " + " | ".join(f"{cell:.2f}" for cell in cells) + " |")
    print(flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("grove")
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--family", choices=FAMILIES, default="bvh")
    parser.add_argument("--structures", type=lambda text: tuple(text.split(";")), help="specs in place of a family's")
    parser.add_argument("--by-scene", metavar="SPEC", help="print how this one does beside the first, scene by scene")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--count", type=int, default=100000)
    parser.add_argument("--threads", type=int, help="by default all")
    parser.add_argument("--summary", action="store_true", help="no table for each scene")
    options = parser.parse_args()
    options.structures = options.structures or FAMILIES[options.family]
    reports = {scene: compare(options, scene) for scene in options.scenes}
    print_summary(options.structures, reports)
    if options.by_scene:
        print_by_scene(options.by_scene, options.structures[0], reports)
    if not options.summary:
        for scene, report in reports.items():
            print_table(scene, report)


main()
