#!/usr/bin/env python3
"""What adaptive sampling reaches, as a Markdown table: for each target of `grove render --noise`, the samples that it takes, its error, and the error of a
picture with the same number of samples at every pixel.

Errors are root mean squares over the pixels of the error of the luminance over the luminance (at least 0.01), against a picture of another seed with
many more samples; and the share of pixels whose error is above twice the target.

usage: noise_table.py GROVE [SCENE] [--targets T,T] [--reference-spp N] [--width W] [--height H]
"""

import argparse
import json
import math
import pathlib
import subprocess
import tempfile

from film_file import luminances

FLOOR = 0.01


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("grove")
    parser.add_argument("scene", nargs="?", default="builtin:cornell")
    parser.add_argument("--targets", default="0.2,0.1,0.05")
    parser.add_argument("--reference-spp", type=int, default=8192)
    parser.add_argument("--width", type=int, default=100)
    parser.add_argument("--height", type=int, default=100)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        film = pathlib.Path(name) / "picture.film"
        figures = pathlib.Path(name) / "figures.json"

        def render(*more):
            subprocess.run([options.grove, "render", options.scene, "-o", film, "--json", figures, "--width", str(options.width), "--height",
                            str(options.height), "--quiet", *more], check=True)
            return luminances(film), json.loads(figures.read_text())

        reference, _ = render("--spp", str(options.reference_spp), "--seed", "1")

        def errors(values, target):
            relative = [abs(a - b) / max(b, FLOOR) for a, b in zip(values, reference)]
            above = sum(e > 2 * target for e in relative) / len(relative)
            return f"{math.sqrt(sum(e * e for e in relative) / len(relative)):.4f} | {100 * above:.1f} %"

        print("| target | samples a pixel: least, mean, most | error | above twice the target | even samples | error | above twice the target |")
        print("| ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
        for target in options.targets.split(","):
            values, json_figures = render("--noise", target)
            taken = json_figures["samples_taken"]
            even = max(1, round(taken["mean"]))
            even_values, _ = render("--spp", str(even))
            print(f"| {target} | {taken['least']}, {taken['mean']:.0f}, {taken['most']} | {errors(values, float(target))} | {even} | "
                  f"{errors(even_values, float(target))} |", flush=True)


if __name__ == "__main__":
    main()
