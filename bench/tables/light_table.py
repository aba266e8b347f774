#!/usr/bin/env python3
"""Noise and time of the ways to choose one of many lights, as a Markdown table.

For each number of lanterns in builtin:lanterns, each way of `grove render --lights` renders the same few samples, and then as many as fit
into the processor time that one lantern took. Light is scattered once. Errors are root mean square errors of the luminance over its mean, against
a picture of another seed with many more samples; times are processor times of all threads, of rendering and what precedes it. Lanterns are
without area, since the edges of those that are seen would have more noise than what they light.

usage: light_table.py GROVE [--kind points|spots] [--counts N,N] [--ways NAME,NAME] [--spp N] [--reference-spp N] [--width W] [--height H]
"""

import argparse
import math
import pathlib
import resource
import subprocess
import tempfile

from film_file import luminances

def render(options, lights, way, spp, seed, directory):
    film = directory / "picture.film"
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(
        [options.grove, "render", f"builtin:lanterns?lights={lights}&kind={options.kind}", "-o", film, "--lights", way, "--spp", str(spp), "--seed",
         str(seed), "--width", str(options.width), "--height", str(options.height), "--max-depth", "1", "--quiet"], check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return luminances(film), seconds


def error(values, reference):
    return math.sqrt(sum((a - b) ** 2 for a, b in zip(values, reference)) * len(reference)) / sum(reference)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("grove")
    parser.add_argument("--kind", default="points", choices=["points", "spots"])
    parser.add_argument("--counts", default="1,10,100,1000,10000")
    parser.add_argument("--ways", default="hierarchy,groups,power,uniform")
    parser.add_argument("--spp", type=int, default=16)
    parser.add_argument("--reference-spp", type=int, default=1024)
    parser.add_argument("--width", type=int, default=192)
    parser.add_argument("--height", type=int, default=108)
    options = parser.parse_args()
    print(f"| lanterns ({options.kind}) | way | time, {options.spp} samples | error | samples in the time of one lantern | error |")
    print("| ---: | --- | ---: | ---: | ---: | ---: |")
    budget = None
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        for count in map(int, options.counts.split(",")):
            reference, _ = render(options, count, "hierarchy", options.reference_spp, 1, directory)
            for way in options.ways.split(","):
                values, seconds = render(options, count, way, options.spp, 0, directory)
                budget = budget or seconds
                fitting = max(1, round(options.spp * budget / seconds))
                equal, _ = render(options, count, way, fitting, 0, directory)
                print(f"| {count:,} | {way} | {seconds:.2f} s | {error(values, reference):.3f} | {fitting} | {error(equal, reference):.3f} |",
                      flush=True)


if __name__ == "__main__":
    main()
