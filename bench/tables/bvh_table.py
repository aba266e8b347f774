#!/usr/bin/env python3
"""Compares the builders of the family bvh on several scenes and prints Markdown: a summary over the scenes, then a table for each.

usage: bvh_table.py GROVE [--rounds K] [--count N] [--summary] SCENE...

docs/bvh.md has the tables of three scenes, docs/bvh-scenes.md those of all.
"""
import argparse
import json
import math
import subprocess
import tempfile
from pathlib import Path

SPECS = (
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
)


def compare(grove, scene, rounds, count):
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "compare.json"
        command = [grove, "compare", scene, "--structures", ";".join(SPECS), "--rays", "diffuse,random", "--rounds", str(rounds)]
        command += ["--count", str(count), "--quiet", "--json", str(report)]
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
    print(f"### {scene}: {report['primitives']:,} primitives\n")
    print("| structure | build ms | MiB | expected cost | end-point overlap | nodes + tests a ray: diffuse | random | Mrays/s: diffuse | random |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    for spec, kinds in rows_of(report).items():
        diffuse, random = kinds["diffuse"], kinds["random"]
        print(
            f"| `{spec}` | {number(1e3 * diffuse['build_seconds']['median'])} | {number(diffuse['bytes'] / 2**20)}"
            f" | {number(diffuse['expected_cost'])} | {number(diffuse['end_point_overlap'])}"
            f" | {number(diffuse['nodes_per_ray'])} + {number(diffuse['tests_per_ray'])}"
            f" | {number(random['nodes_per_ray'])} + {number(random['tests_per_ray'])}"
            f" | {number(diffuse['mrays_per_s']['median'])} | {number(random['mrays_per_s']['median'])} |"
        )
    print(flush=True)


def steps(row):
    return row["nodes_per_ray"] + row["tests_per_ray"]


def speed(row):
    return row["mrays_per_s"]["median"]


def print_summary(reports):
    """Each figure relative to the first structure's: the geometric mean over the scenes, and the worst of them."""
    print("| structure | build time | nodes + tests a ray: diffuse | worst | random | worst | Mrays/s: diffuse | worst | random | worst |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    scenes = [rows_of(report) for report in reports.values()]
    for spec in SPECS:
        ratios = lambda kind, value: [value(rows[spec][kind]) / value(rows[SPECS[0]][kind]) for rows in scenes]  # noqa: E731
        mean = lambda values: math.exp(sum(math.log(v) for v in values) / len(values))  # noqa: E731
        build = ratios("diffuse", lambda row: row["build_seconds"]["median"])
        cells = [f"{mean(build):.2f}"]
        for value, worst in ((steps, max), (speed, min)):
            for kind in ("diffuse", "random"):
                values = ratios(kind, value)
                cells += [f"{mean(values):.2f}", f"{worst(values):.2f}"]
        print(f"| `{spec}` | " + " | ".join(cells) + " |")
    print(flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("grove")
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--count", type=int, default=100000)
    parser.add_argument("--summary", action="store_true", help="the summary only")
    options = parser.parse_args()
    reports = {scene: compare(options.grove, scene, options.rounds, options.count) for scene in options.scenes}
    print_summary(reports)
    if not options.summary:
        for scene, report in reports.items():
            print_table(scene, report)


main()
