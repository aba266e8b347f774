#!/usr/bin/env python3
"""Compares the builders of the family bvh on several scenes and prints the Markdown tables of docs/bvh.md.

usage: bvh_table.py GROVE [--rounds K] [--count N] SCENE...
"""
import argparse
import json
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


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("grove")
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--count", type=int, default=100000)
    options = parser.parse_args()
    for scene in options.scenes:
        report = compare(options.grove, scene, options.rounds, options.count)
        rows = {}
        for row in report["rows"]:
            rows.setdefault(row["structure"], {})[row["rays"]] = row
        print(f"### {scene}\n")
        print("| structure | build ms | MiB | expected cost | end-point overlap | nodes + tests a ray: diffuse | random | Mrays/s: diffuse | random |")
        print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
        for spec, kinds in rows.items():
            diffuse, random = kinds["diffuse"], kinds["random"]
            print(
                f"| `{spec}` | {number(1e3 * diffuse['build_seconds']['median'])} | {number(diffuse['bytes'] / 2**20)}"
                f" | {number(diffuse['expected_cost'])} | {number(diffuse['end_point_overlap'])}"
                f" | {number(diffuse['nodes_per_ray'])} + {number(diffuse['tests_per_ray'])}"
                f" | {number(random['nodes_per_ray'])} + {number(random['tests_per_ray'])}"
                f" | {number(diffuse['mrays_per_s']['median'])} | {number(random['mrays_per_s']['median'])} |"
            )
        print(flush=True)


main()
