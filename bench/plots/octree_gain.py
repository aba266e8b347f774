#!/usr/bin/env python3
"""Draws the files that `grove_octree_bench gain --json F` writes: what octree-R gains over an octree of as many leaves, against how uneven the scene is.

usage: octree_gain.py picture.png FILE...        needs python3-matplotlib
"""
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

SEARCHES = {"candidates": "#1f5aa6", "events": "#c4501b", "joint": "#4a8a3f"}
DASHES = {10_000: ":", 100_000: "-", 1_000_000: "--"}
REVIEW = (4, 47)


def curve(rows, value):
    """Skews in order, and the value at each."""
    rows = sorted(rows, key=lambda row: row["skew"])
    return [row["skew"] for row in rows], [value(row) for row in rows]


def draw(panel, rows, value, title):
    panel.axhspan(*REVIEW, color="#dddddd", zorder=0)
    panel.axhline(0, color="black", linewidth=0.8)
    for search, colour in SEARCHES.items():
        for count in sorted({row["count"] for row in rows}):
            chosen = [row for row in rows if row["name"] == search and row["count"] == count]
            if chosen:
                panel.plot(*curve(chosen, value), color=colour, linestyle=DASHES.get(count, "-."), marker="o", markersize=3,
                           label=f"{search}, {count:,}")
    panel.set_title(title, fontsize=10)
    panel.set_xlabel("skew: coordinates are u^skew")


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    rows = []
    for name in sys.argv[2:]:
        with open(name) as file:
            rows += json.load(file)["rows"]
    kinds = sorted({row["primitives"] for row in rows})
    figure, panels = plt.subplots(2, len(kinds), figsize=(5.2 * len(kinds), 7.2), sharex=True, sharey="row", squeeze=False)
    for column, kind in enumerate(kinds):
        chosen = [row for row in rows if row["primitives"] == kind]
        draw(panels[0][column], chosen, lambda row: row["gain_in_tests"], f"{kind}: fewer tests")
        draw(panels[1][column], chosen, lambda row: row["gain_in_time"]["median"], f"{kind}: more rays a second")
    for line in panels:
        line[0].set_ylabel("gain over an octree, %")
    panels[0][-1].legend(fontsize=7)
    figure.suptitle("Octree-R against an octree of as many leaves; grey: 4 % to 47 %", fontsize=11)
    figure.tight_layout()
    figure.savefig(sys.argv[1], dpi=100)


if __name__ == "__main__":
    main()
