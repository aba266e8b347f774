"""Grove and Cycles, each asked for pictures of a scene with some numbers of samples, and how long they took."""

import dataclasses
import json
import os
import pathlib
import resource
import shutil
import subprocess

# Grove's pixel filter is a tent two pixels wide. Cycles has none; its Blackman-Harris window of this width, which is half of what it covers, has the same
# standard deviation of 0.41 pixels.
FILTER_WIDTH = 1.47


@dataclasses.dataclass
class View:
    """What all pictures of a comparison have in common."""
    width: int
    height: int
    depth: int
    threads: int


@dataclasses.dataclass
class Picture:
    path: pathlib.Path
    samples: int
    seed: int
    processor_seconds: float = 0.0
    clock_seconds: float = 0.0


def run(command, environment=None):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, env=environment)
    if done.returncode != 0:
        lines = (done.stderr.strip() or done.stdout.strip()).splitlines()
        raise SystemExit(f"{command[0]} failed with exit code {done.returncode}: {lines[-1] if lines else 'it said nothing'}")
    return done.stdout


def vector(values):
    return ",".join(map(str, values))


class Grove:
    name = "Grove"

    def __init__(self, program, structure):
        self.program, self.structure = program, structure

    def version(self):
        return run([self.program, "--version"]).strip()

    def render(self, scene, file, view, pictures, work):
        """Renders each picture in a process of its own. Seconds by the clock are those of rendering; those of the processors are of all that the process does."""
        figures = work / "grove.json"
        for picture in pictures:
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            run([
                self.program, "render", file, "-o", picture.path, "--layers", "none", "--structure", self.structure, "--spp", picture.samples, "--seed",
                picture.seed, "--width", view.width, "--height", view.height, "--max-depth", view.depth, "--threads", view.threads, "--eye",
                vector(scene.eye), "--look-at", vector(scene.look_at), "--up", vector(scene.up), "--fov", scene.fov, "--sky", vector(scene.sky),
                "--json", figures, "--quiet"
            ])
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            picture.processor_seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
            picture.clock_seconds = json.loads(figures.read_text())["render_seconds"]


class Cycles:
    name = "Cycles"

    def __init__(self, program):
        self.program = program

    def version(self):
        return run([self.program, "--version"]).splitlines()[0]

    def render(self, scene, file, view, pictures, work):
        """Renders all pictures in one process, after one that is thrown away and for which the structure is built. Seconds are those of the call."""
        job, report = work / "job.json", work / "report.json"
        first = Picture(work / "first.exr", 1, 0)
        renders = [{"samples": p.samples, "seed": p.seed, "picture": str(p.path)} for p in [first, *pictures]]
        job.write_text(json.dumps({
            "scene": str(file), "eye": scene.eye, "look_at": scene.look_at, "up": scene.up, "fov": scene.fov, "sky": scene.sky,
            "width": view.width, "height": view.height, "depth": view.depth, "threads": view.threads, "filter_width": FILTER_WIDTH,
            "report": str(report), "renders": renders
        }))
        script = pathlib.Path(__file__).with_name("render_in_blender.py")
        # Otherwise the exit code would be 0 even when the script fails.
        # Blender takes its Python's modules from beside the first python3 on the path, which may be of another installation.
        beside = pathlib.Path(shutil.which(self.program)).resolve().parent
        environment = dict(os.environ, PATH=f"{beside}{os.pathsep}{os.environ['PATH']}")
        run([self.program, "-b", "--factory-startup", "--python-exit-code", "1", "-P", script, "--", job], environment)
        for picture, part in zip(pictures, json.loads(report.read_text())["renders"][1:]):
            picture.processor_seconds, picture.clock_seconds = part["processor_seconds"], part["clock_seconds"]
