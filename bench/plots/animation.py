#!/usr/bin/env python3
"""Draws the file that `grove animate SCENE --csv frames.csv` writes: update time, rays a second and the time of a frame, frame by frame.

usage: animation.py frames.csv picture.png [title]        needs python3-matplotlib
"""
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

COLOURS = {"auto": "#111111", "refit": "#c4501b", "rotate": "#b8a11a", "rebuild": "#1f5aa6"}


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    with open(sys.argv[1], newline="") as file:
        rows = list(csv.DictReader(file))
    panels = (
        ("update, ms", lambda row: 1e3 * float(row["update_seconds"])),
        ("Mrays/s", lambda row: float(row["mrays_per_s"])),
        ("update and trace, ms", lambda row: 1e3 * (float(row["update_seconds"]) + float(row["trace_seconds"]))),
    )
    figure, axes = plt.subplots(1, len(panels), figsize=(4.4 * len(panels), 3.4))
    for axis, (label, value) in zip(axes, panels):
        for policy in dict.fromkeys(row["policy"] for row in rows):
            own = [row for row in rows if row["policy"] == policy]
            axis.plot([int(row["frame"]) for row in own], [value(row) for row in own], label=policy, color=COLOURS.get(policy), linewidth=1.2)
        axis.set_xlabel("frame")
        axis.set_ylabel(label)
        axis.set_yscale("log")
    axes[0].legend(fontsize=8)
    if len(sys.argv) > 3:
        figure.suptitle(sys.argv[3])
    figure.tight_layout()
    figure.savefig(sys.argv[2], dpi=110)


main()
