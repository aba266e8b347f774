"""Renders a glTF file with Cycles as a job says; runs inside Blender, for compare.py beside it.

usage: blender -b --factory-startup -P render_in_blender.py -- JOB.json

The job names the scene, camera, sky, size, depth and threads, and a list of renders ("samples", "seed", "picture"). To each are added the seconds by the clock
and of all processors that the render call took, and the whole is written to the job's "report". Data stay on Cycles' device from one render to the next, so that
all but the first spend no time on the structure.
"""

import json
import math
import resource
import sys
import time

import numpy

# The importer of Blender 3.4 still asks for the name that NumPy 1.24 took away.
if "bool" not in numpy.__dict__:
    numpy.bool = bool

import bpy  # noqa: E402
import mathutils  # noqa: E402


def to_blender(vector):
    """glTF has y up, Blender z."""
    x, y, z = vector
    return mathutils.Vector((x, -z, y))


def load(path):
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
    bpy.ops.import_scene.gltf(filepath=path)
    # Whatever moves is to stand as the file's nodes have it.
    for thing in bpy.data.objects:
        thing.animation_data_clear()
    for key in bpy.data.shape_keys:
        key.animation_data_clear()
        for block in key.key_blocks[1:]:
            block.value = 0.0


def set_camera(scene, job):
    eye, target, up = (to_blender(job[name]) for name in ("eye", "look_at", "up"))
    backward = (eye - target).normalized()
    right = up.cross(backward).normalized()
    true_up = backward.cross(right)
    lens = bpy.data.cameras.new("compared")
    lens.sensor_fit = "VERTICAL"
    lens.angle = math.radians(job["fov"])
    distance = (eye - target).length
    lens.clip_start = 1e-4 * distance
    lens.clip_end = 1e4 * distance
    camera = bpy.data.objects.new("compared", lens)
    camera.matrix_world = mathutils.Matrix(
        [[right[i], true_up[i], backward[i], eye[i]] for i in range(3)] + [[0.0, 0.0, 0.0, 1.0]])
    scene.collection.objects.link(camera)
    scene.camera = camera


def set_sky(scene, radiance):
    world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (*radiance, 1.0)
    background.inputs["Strength"].default_value = 1.0
    scene.world = world


def set_output(scene, job):
    render = scene.render
    render.resolution_x, render.resolution_y = job["width"], job["height"]
    render.resolution_percentage = 100
    render.film_transparent = False
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_mode = "RGB"
    render.image_settings.color_depth = "32"
    render.image_settings.exr_codec = "NONE"
    render.use_compositing = False
    render.use_sequencer = False


def set_cycles(scene, job):
    scene.render.engine = "CYCLES"
    scene.render.threads_mode = "FIXED"
    scene.render.threads = job["threads"]
    scene.render.use_persistent_data = True
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.use_auto_tile = False
    cycles.time_limit = 0.0
    # Cycles counts bounces after the first surface. Alpha is no bounce in glTF.
    for name in ("max_bounces", "diffuse_bounces", "glossy_bounces", "transmission_bounces", "volume_bounces"):
        setattr(cycles, name, job["depth"] - 1)
    cycles.transparent_max_bounces = 1024
    cycles.sample_clamp_direct = 0.0
    cycles.sample_clamp_indirect = 0.0
    cycles.blur_glossy = 0.0
    cycles.caustics_reflective = True
    cycles.caustics_refractive = True
    cycles.pixel_filter_type = "BLACKMAN_HARRIS"
    cycles.filter_width = job["filter_width"]


def processor_seconds():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def main():
    with open(sys.argv[sys.argv.index("--") + 1], encoding="utf-8") as file:
        job = json.load(file)
    scene = bpy.context.scene
    load(job["scene"])
    set_camera(scene, job)
    set_sky(scene, job["sky"])
    set_output(scene, job)
    set_cycles(scene, job)
    for part in job["renders"]:
        scene.cycles.samples = part["samples"]
        scene.cycles.seed = part["seed"]
        scene.render.filepath = part["picture"]
        clock, processor = time.perf_counter(), processor_seconds()
        bpy.ops.render.render(write_still=True)
        part["processor_seconds"] = processor_seconds() - processor
        part["clock_seconds"] = time.perf_counter() - clock
    job["blender"] = bpy.app.version_string
    with open(job["report"], "w", encoding="utf-8") as file:
        json.dump(job, file)


main()
