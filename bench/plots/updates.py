#!/usr/bin/env python3
"""Draws the file that `grove_update_bench --csv rounds.csv` writes: for each scene and change, round by round, the time of updates and the expected cost
and the nodes and tests a ray relative to the same structure built anew.

usage: updates.py picture.png rounds.csv...        needs python3-matplotlib
"""
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

COLOURS = {"auto": "#111111", "refit": "#c4501b", "rotate": "#b8a11a", "rebuild": "#1f5aa6"}
STYLES = ("-", "--", ":", "-.")
REBUILD = "rebuild"


def read(paths):
    """{(scene, change, share): {(structure, policy): [row by round]}}"""
    plays = {}
    for path in paths:
        with open(path, newline="") as file:
            for row in csv.DictReader(file):
                ways = plays.setdefault((row["scene"], row["change"], float(row["share"])), {})
                ways.setdefault((row["structure"], row["policy"]), []).append(row)
    return plays


def steps(row):
    return float(row["nodes_per_ray"]) + float(row["tests_per_ray"])


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    plays = read(sys.argv[2:])
    figure, panels = plt.subplots(len(plays), 3, figsize=(12, 2.6 * len(plays)), squeeze=False)
    for (play, ways), row_of_panels in zip(plays.items(), panels):
        styles = {structure: STYLES[i % len(STYLES)] for i, structure in enumerate(dict.fromkeys(structure for structure, _ in ways))}
        for (structure, policy), rows in ways.items():
            anew = ways[structure, REBUILD]
            look = {"color": COLOURS[policy], "linestyle": styles[structure], "linewidth": 1.1, "label": f"{structure} {policy}"}
            # The first update of a structure learns what later ones know.
            rounds = [int(row["round"]) for row in rows[1:]]
            row_of_panels[0].plot(rounds, [1e3 * float(row["seconds"]) for row in rows[1:]], **look)
            if policy == REBUILD:
                continue
            row_of_panels[1].plot(rounds, [float(row["cost"]) / float(best["cost"]) for row, best in zip(rows[1:], anew[1:])], **look)
            row_of_panels[2].plot(rounds, [steps(row) / steps(best) for row, best in zip(rows[1:], anew[1:])], **look)
        scene, change, share = play
        row_of_panels[0].set_title(f"{scene.removeprefix('builtin:')}: {change} {100 * share:g} %", fontsize=9)
        for panel, label in zip(row_of_panels, ("update, ms", "expected cost / anew", "nodes + tests a ray / anew")):
            panel.set_ylabel(label, fontsize=8)
            panel.set_xlabel("round", fontsize=8)
            panel.tick_params(labelsize=7)
        row_of_panels[0].set_yscale("log")
        for panel in row_of_panels[1:]:
            panel.set_ylim(0.98, 1.22)
    panels[0][0].legend(fontsize=6, ncol=2)
    figure.tight_layout()
    figure.savefig(sys.argv[1], dpi=100)


main()
