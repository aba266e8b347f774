#!/usr/bin/env python3
"""Compares `grove render` with Blender's path tracer, Cycles, on a processor: how long each takes to the same error on the same glTF files.

Camera, sky, depth, size and threads are the same. Both render a reference of many samples, and then, in turns, pictures of 1, 4, 16, 64 and 256 samples with
other seeds. Errors are root mean squares in linear light over pixels and channels, each against the renderer's own reference, so that no difference in what
materials look like counts as noise. Writes what it measured as JSON and pictures side by side as PNG; bench/tables/cycles_table.py makes tables of the JSON.

Without Blender it says so and ends; with --install it installs Debian's packages first (about 1 GB).

usage: compare.py GROVE --scenes FOLDER [--only NAME,NAME] [--json F.json] [--pictures F.png] [...]
"""

import argparse
import hashlib
import json
import os
import pathlib
import platform
import shutil
import statistics
import subprocess
import tempfile

import curves
from open_exr import read_rgb
from renderers import Cycles, Grove, Picture, View
from scenes import SCENES
from sheet import write_sheet

REFERENCE_SEED = 1000
SHOWN_SAMPLES = 16


def find_blender(options):
    if options.install:
        as_root = [] if os.geteuid() == 0 else ["sudo"]
        subprocess.run([*as_root, "apt-get", "install", "-y", "--no-install-recommends", "blender", "python3-numpy"], check=True)
    if shutil.which(options.blender) is None:
        raise SystemExit(f"{options.blender}: is not there; install Blender, on Debian with --install, or name it with --blender")
    return options.blender


def chosen_scenes(options):
    if not options.only:
        return SCENES
    by_name = {scene.name: scene for scene in SCENES}
    names = options.only.split(",")
    unknown = [name for name in names if name not in by_name]
    if unknown:
        raise SystemExit(f"--only: there is no scene {unknown[0]}; there are {', '.join(by_name)}")
    return [by_name[name] for name in names]


def reference(renderer, scene, file, view, options):
    """A picture of many samples; one that is there already for the same view and sky is taken as it is."""
    look = repr((scene.eye, scene.look_at, scene.up, scene.fov, scene.sky, file.read_bytes(), view.width, view.height, view.depth, options.reference_spp))
    path = options.work / f"{scene.name}-{renderer.name}-{hashlib.sha256(look.encode()).hexdigest()[:12]}.exr"
    if not path.exists():
        part = path.with_suffix(".part.exr")
        renderer.render(scene, file, view, [Picture(part, options.reference_spp, REFERENCE_SEED)], options.work)
        part.rename(path)
    return read_rgb(path)[2]


def measure(renderers, scene, file, view, options):
    references = {renderer.name: reference(renderer, scene, file, view, options) for renderer in renderers}
    rows = {renderer.name: {n: {"squared": [], "relative": [], "processor": [], "clock": []} for n in options.samples} for renderer in renderers}
    shown = {}
    for number in range(options.rounds):
        for renderer in renderers:
            pictures = [Picture(options.work / f"{renderer.name}-{n}.exr", n, number * len(options.samples) + i) for i, n in enumerate(options.samples)]
            renderer.render(scene, file, view, pictures, options.work)
            for picture in pictures:
                planes = read_rgb(picture.path)[2]
                row = rows[renderer.name][picture.samples]
                row["squared"].append(curves.squared_error(planes, references[renderer.name]))
                row["relative"].append(curves.relative_squared_error(planes, references[renderer.name]))
                row["processor"].append(picture.processor_seconds)
                row["clock"].append(picture.clock_seconds)
                if picture.samples == SHOWN_SAMPLES:
                    shown[renderer.name] = planes
    return references, rows, shown


def seconds_a_sample(rows, kind):
    """Median over the rounds of what a sample of the whole picture takes."""
    rounds = len(next(iter(rows.values()))[kind])
    return statistics.median(curves.seconds_a_sample({n: row[kind][i] for n, row in rows.items()}) for i in range(rounds))


def error_curve(rows, kind):
    return {n: statistics.mean(row[kind])**0.5 for n, row in rows.items()}


def time_ratios(kind, figures, rows):
    """Cycles' time over Grove's to the error that Cycles has at each number of samples."""
    grove, cycles = (error_curve(rows[name], kind) for name in ("Grove", "Cycles"))
    ratios = {}
    for n, error in cycles.items():
        needed = curves.samples_for(error, grove)
        for clock in ("processor", "clock"):
            key = f"{clock}_seconds_a_sample"
            ratios.setdefault(clock, {})[n] = n * figures["Cycles"][key] / (needed * figures["Grove"][key])
    return ratios


def report(scene, references, rows, view):
    figures = {}
    for name in rows:
        figures[name] = {f"{clock}_seconds_a_sample": seconds_a_sample(rows[name], clock) for clock in ("processor", "clock")}
        figures[name]["mpaths_per_processor_second"] = 1e-6 * view.width * view.height / figures[name]["processor_seconds_a_sample"]
        figures[name]["rmse"] = error_curve(rows[name], "squared")
        figures[name]["root_relative_mse"] = error_curve(rows[name], "relative")
        figures[name]["mean"] = curves.mean(references[name])
        figures[name]["rounds"] = rows[name]
    difference = curves.squared_error(references["Grove"], references["Cycles"])**0.5
    return {
        "scene": scene.name, "credit": scene.credit, "renderers": figures, "references_differ_by_rmse": difference,
        "time_ratio": time_ratios("squared", figures, rows), "time_ratio_relative": time_ratios("relative", figures, rows)
    }


def machine():
    names = [line.split(":", 1)[1].strip() for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines() if line.startswith("model name")]
    return {"cpu": names[0] if names else platform.processor(), "cores": os.cpu_count(), "os": platform.platform()}


def save(path, text):
    part = path.with_name(path.name + ".part")
    part.write_text(text)
    part.rename(path)


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("grove", help="the program grove")
    parser.add_argument("--scenes", type=pathlib.Path, default=pathlib.Path("../shared/scenes"), help="the folder of the glTF files")
    parser.add_argument("--only", help="scenes to compare on")
    parser.add_argument("--blender", default="blender")
    parser.add_argument("--install", action="store_true", help="install Blender with apt-get first")
    parser.add_argument("--structure", default="fast", help="Grove's")
    parser.add_argument("--width", type=int, default=160)
    parser.add_argument("--height", type=int, default=120)
    parser.add_argument("--depth", type=int, default=8, help="surfaces that light scatters at, at least 1")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--samples", default="1,4,16,64,256")
    parser.add_argument("--reference-spp", type=int, default=4096)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--work", type=pathlib.Path, help="folder for pictures; references in it are used again")
    parser.add_argument("--json", type=pathlib.Path)
    parser.add_argument("--pictures", type=pathlib.Path)
    options = parser.parse_args()
    options.samples = sorted({SHOWN_SAMPLES, *map(int, options.samples.split(","))})
    return options


def compare(options):
    renderers = [Grove(options.grove, options.structure), Cycles(find_blender(options))]
    view = View(options.width, options.height, options.depth, options.threads)
    result = {
        "format": "grove-cycles", "version": 1, "machine": machine(), "renderers": {renderer.name: renderer.version() for renderer in renderers},
        "structure": options.structure, "width": view.width, "height": view.height, "depth": view.depth, "threads": view.threads,
        "reference_samples": options.reference_spp, "rounds": options.rounds, "scenes": []
    }
    sheet = []
    for scene in chosen_scenes(options):
        file = scene.path(options.scenes, options.work).resolve()
        if not file.exists():
            raise SystemExit(f"{file}: is not there; name the folder of the scenes with --scenes, or leave {scene.name} out with --only")
        references, rows, shown = measure(renderers, scene, file, view, options)
        result["scenes"].append(report(scene, references, rows, view))
        sheet.append([references["Grove"], references["Cycles"], shown["Grove"], shown["Cycles"]])
        ratio = result["scenes"][-1]["time_ratio"]["processor"]
        print(f"{scene.name}: Cycles' time over Grove's to the error of its {', '.join(map(str, ratio))} samples: "
              f"{', '.join(f'{value:.2f}' for value in ratio.values())}", flush=True)
        if options.json:
            save(options.json, json.dumps(result, indent=1) + "\n")
        if options.pictures:
            write_sheet(options.pictures, view.width, view.height, sheet)


def main():
    options = parse()
    if options.work:
        options.work.mkdir(parents=True, exist_ok=True)
        options.work = options.work.resolve()
        compare(options)
        return
    with tempfile.TemporaryDirectory() as folder:
        options.work = pathlib.Path(folder)
        compare(options)


if __name__ == "__main__":
    main()
