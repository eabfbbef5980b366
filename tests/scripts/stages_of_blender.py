#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Has Blender write random stages of USD, and keeps what it shows in every frame: for compare_stages.py.

usage: stages_of_blender.py FOLDER [COUNT [SEED]]      in a Python with bpy (5.2 or later) and numpy

Skins, shape keys, modifiers, parents that move, mirrored and scaled objects, flat and smooth shading, odd rates and first frames.
"""
import pathlib
import random
import sys

import numpy as np

sys.dont_write_bytecode = True
RATES = ((24, 1.0), (25, 1.0), (30, 1.0), (60, 1.0), (24, 1.001), (30, 1.001))


def add_mesh(bpy, numbers, name):
    kind = numbers.choice(("cube", "sphere", "grid", "cylinder"))
    add = bpy.ops.mesh
    if kind == "cube":
        add.primitive_cube_add()
    elif kind == "sphere":
        add.primitive_uv_sphere_add(segments=12, ring_count=8)
    elif kind == "grid":
        add.primitive_grid_add(x_subdivisions=9, y_subdivisions=7)
    else:
        add.primitive_cylinder_add(vertices=12)
    thing = bpy.context.object
    thing.name = thing.data.name = name
    thing.location = [numbers.uniform(-3, 3) for _ in range(3)]
    thing.rotation_euler = [numbers.uniform(-3, 3) for _ in range(3)]
    thing.scale = [numbers.choice((1, 1, -1, 0.5, 2)) for _ in range(3)]
    shading = numbers.choice(("flat", "smooth", "mixed"))
    for face in thing.data.polygons:
        face.use_smooth = shading == "smooth" or (shading == "mixed" and face.index % 2 == 0)
    return thing


def key(numbers, thing, path, frames, low, high):
    for frame in (frames[0], frames[-1]):
        value = getattr(thing, path)
        if hasattr(value, "__len__"):
            setattr(thing, path, [numbers.uniform(low, high) for _ in value])
        else:
            setattr(thing, path, numbers.uniform(low, high))
        thing.keyframe_insert(path, frame=frame)


def animate(bpy, numbers, thing, frames):
    if numbers.random() < 0.5:
        key(numbers, thing, numbers.choice(("location", "rotation_euler")), frames, -2, 2)
    ways = numbers.sample(("keys", "bones", "wave", "parent"), numbers.randint(1, 2))
    if "keys" in ways:
        thing.shape_key_add(name="Basis")
        shape = thing.shape_key_add(name="Bulge")
        for point in shape.data:
            point.co = point.co * numbers.uniform(0.8, 1.4)
        key(numbers, shape, "value", frames, 0, 1)
    if "bones" in ways and "keys" not in ways:
        bpy.ops.object.armature_add(location=(0, 0, 0))
        bones = bpy.context.object
        thing.parent = bones
        group = thing.vertex_groups.new(name=bones.data.bones[0].name)
        for vertex in thing.data.vertices:
            group.add([vertex.index], 1.0, "REPLACE")
        thing.modifiers.new("Armature", "ARMATURE").object = bones
        pose = bones.pose.bones[0]
        pose.rotation_mode = "XYZ"
        key(numbers, pose, "rotation_euler", frames, -1, 1)
    elif "wave" in ways and "keys" not in ways:
        thing.modifiers.new("Wave", "WAVE")
    if "parent" in ways and thing.parent is None:
        bpy.ops.object.empty_add(location=(1, 0, 0))
        thing.parent = bpy.context.object
        key(numbers, thing.parent, "rotation_euler", frames, -2, 2)


def write(folder, count, seed):
    import bpy

    folder.mkdir(parents=True, exist_ok=True)
    for number in range(seed, seed + count):
        numbers = random.Random(number)
        bpy.ops.wm.read_factory_settings(use_empty=True)
        scene = bpy.context.scene
        scene.render.fps, scene.render.fps_base = numbers.choice(RATES)
        first = numbers.choice((1, 1, 0, 1001))
        frames = range(first, first + numbers.randint(3, 12))
        scene.frame_start, scene.frame_end = frames[0], frames[-1]
        things = [add_mesh(bpy, numbers, f"Thing{i}") for i in range(numbers.randint(1, 3))]
        for thing in things:
            animate(bpy, numbers, thing, frames)
        shown = {thing.name: [] for thing in things}
        for frame in frames:
            scene.frame_set(frame)
            graph = bpy.context.evaluated_depsgraph_get()
            for thing in things:
                mesh = thing.evaluated_get(graph)
                points = np.array([mesh.matrix_world @ vertex.co for vertex in mesh.data.vertices])
                shown[thing.name].append(points)
        bpy.ops.wm.usd_export(filepath=str(folder / f"{number}.usdc"), export_animation=True, export_armatures=True, export_shapekeys=True)
        np.savez(folder / f"{number}.npz", codes=np.array(frames), rate=np.array([scene.render.fps, scene.render.fps_base]),
                 **{name: np.array(points) for name, points in shown.items()})


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    write(pathlib.Path(sys.argv[1]), *(int(text) for text in (sys.argv[2:4] + ["30", "1"][len(sys.argv) - 2:])))


if __name__ == "__main__":
    main()
