#!/usr/bin/env python3
"""Draws the file that `grove inspect SCENE --split-costs costs.csv` writes: both forms of the cost of a split, and the two medians.

usage: split_costs.py costs.csv picture.png [title]        needs python3-matplotlib
"""
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    with open(sys.argv[1], newline="") as file:
        rows = list(csv.DictReader(file))
    axes = sorted({row["axis"] for row in rows})
    figure, panels = plt.subplots(1, len(axes), figsize=(4.2 * len(axes), 3.4), sharey=True, squeeze=False)
    for panel, axis in zip(panels[0], axes):
        planes = [row for row in rows if row["axis"] == axis]
        position = [float(row["position"]) for row in planes]
        for column, label, colour in (("standard", "today's form", "#1f5aa6"), ("equation_2", "equation 2", "#c4501b")):
            cost = [float(row[column]) for row in planes]
            panel.plot(position, cost, label=label, color=colour)
            best = min(range(len(cost)), key=cost.__getitem__)
            panel.plot(position[best], cost[best], "o", color=colour)
        panel.axvline(float(planes[0]["spatial_median"]), color="grey", linestyle="--", label="spatial median")
        panel.axvline(float(planes[0]["object_median"]), color="grey", linestyle=":", label="object median")
        panel.set_xlabel(f"plane on {axis}")
        panel.set_yscale("log")
    panels[0][0].set_ylabel("expected cost")
    panels[0][-1].legend(fontsize=8)
    if len(sys.argv) > 3:
        figure.suptitle(sys.argv[3])
    figure.tight_layout()
    figure.savefig(sys.argv[2], dpi=110)


main()
