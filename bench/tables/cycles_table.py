#!/usr/bin/env python3
"""Writes what compare.py measured into docs/rendering.md, between its marks, or prints it.

usage: cycles_table.py F.json [--clock processor|clock] [--into docs/rendering.md]
"""

import argparse
import json
import pathlib

import marked_page

KINDS = {"processor": "processor time", "clock": "time by the clock"}


def table(headings, rows):
    rule = ["---"] + ["---:"] * (len(headings) - 1)
    return "\n".join("| " + " | ".join(cells) + " |" for cells in (headings, rule, *rows)) + "\n"


def ratios(scene, key, clock):
    return list(scene[key][clock].values())


def time_table(scenes, clock, counts):
    rows = []
    for scene in scenes:
        cells = [scene["scene"]]
        for name in ("Grove", "Cycles"):
            cells.append(f"{1e3 * scene['renderers'][name][f'{clock}_seconds_a_sample']:.1f} ms")
        cells += [f"{value:.2f}" for value in ratios(scene, "time_ratio", clock)]
        cells.append(" ".join(f"{value:.2f}" for value in ratios(scene, "time_ratio_relative", clock)[-1:]))
        rows.append(cells)
    headings = ["scene", "Grove, a sample", "Cycles, a sample", *(f"to Cycles' error at {n}" for n in counts), f"relative, at {counts[-1]}"]
    return table(headings, rows)


def error_table(scenes, counts):
    rows = []
    for scene in scenes:
        for name in ("Grove", "Cycles"):
            figures = scene["renderers"][name]
            rows.append([f"{scene['scene']}, {name}", *(f"{figures['rmse'][n]:.4f}" for n in counts), f"{figures['mean']:.4f}"])
    return table(["RMSE", *counts, "mean of the reference"], rows)


def text(report, clock):
    scenes, machine = report["scenes"], report["machine"]
    counts = list(scenes[0]["time_ratio"][clock])
    threads = "one thread" if report["threads"] == 1 else f"{report['threads']} threads"
    return (f"{report['renderers']['Grove']} (`{report['structure']}`) and {report['renderers']['Cycles']} on {machine['cpu']}, {machine['cores']} cores; "
            f"{threads} each, {report['width']} x {report['height']} pixels, depth {report['depth']}, references of {report['reference_samples']:,} samples, "
            f"{report['rounds']} rounds, medians. {KINDS[clock].capitalize()} for a sample of all pixels, and Cycles' {KINDS[clock]} over Grove's to the error that Cycles "
            f"has at a number of samples: above 1 Grove is faster.\n\n{time_table(scenes, clock, counts)}\n"
            f"Errors by samples a pixel, each against the renderer's own reference:\n\n{error_table(scenes, counts)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("report", type=pathlib.Path)
    parser.add_argument("--clock", choices=sorted(KINDS), default="processor", help="which seconds")
    marked_page.add_option(parser)
    options = parser.parse_args()
    report = json.loads(options.report.read_text())
    if report.get("format") != "grove-cycles":
        raise SystemExit(f"{options.report}: not written by compare.py --json")
    marked_page.put(text(report, options.clock), "cycles", options.into)


if __name__ == "__main__":
    main()
