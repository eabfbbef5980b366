#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Compares stages that Blender writes, encoded, with what usd-core makes of them, and both with what Blender shows.

usage: blender_stages.py write FOLDER [COUNT [SEED]]      in a Python with bpy and numpy
       blender_stages.py compare FOLDER                   in a Python with anicodec[usd]

`write` makes random scenes (skins, shape keys, modifiers, parents that move, mirrored and scaled objects, flat and smooth shading, odd
rates and first frames), exports each as usdc, and keeps what Blender shows in every frame. `compare` encodes the stages, and prints
how far vertices are from their places in the stage (points, transforms, skins baked by usd-core) at most, in per cent of the diagonal:
more than was asked for is a fault. Stages that are not what Blender shows are counted: its export of bones is another thing below
objects that are scaled unevenly. No part of CI.
"""
import pathlib
import random
import sys

import numpy as np

sys.dont_write_bytecode = True
ASKED = 0.05  # per cent of the diagonal
RATES = ((24, 1.0), (25, 1.0), (30, 1.0), (60, 1.0), (24, 1.001), (30, 1.001))


# ---- in Blender ------------------------------------------------------------------------------------------------------


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


# ---- in anicodec -----------------------------------------------------------------------------------------------------


def baked(usd, path):
    from pxr import Gf, UsdSkel

    stage = usd.Usd.Stage.Open(usd.Usd.Stage.Open(str(path)).Flatten())
    if any(prim.IsA(UsdSkel.Root) for prim in stage.Traverse()):
        UsdSkel.BakeSkinning(stage.Traverse(), Gf.Interval.GetFullInterval())
    return stage


def world(usd, stage, path, code):
    prim = stage.GetPrimAtPath(path)
    matrix = np.array(usd.UsdGeom.XformCache(code).GetLocalToWorldTransform(prim))
    return np.array(usd.UsdGeom.Mesh(prim).GetPointsAttr().Get(code), float) @ matrix[:3, :3] + matrix[3, :3]


def compare_one(anicodec, usd, path, truth):
    """Distances from usd-core and from Blender in per cent of the diagonal, and a fault or None."""
    data = usd.encode(str(path), max_error=f"{ASKED}%", effort=1)
    clip = anicodec.open(data)
    rate = truth["rate"][0] / truth["rate"][1]
    if abs(float(clip.fps) - rate) > (1e-6 if truth["rate"][1] != 1 else 1e-12) * rate:
        return 0, 0, f"{float(clip.fps)} frames per second, not {rate}"
    written, source = usd.decode(clip, usd.Usd.Stage.CreateInMemory()), baked(usd, path)
    paths = clip.metadata["usd"]["prims"]
    of_stage = of_blender = 0
    for name in (name for name in truth.files if name.startswith("Thing")):
        place = next((prim for prim in paths if f"/{name}/" in prim), None)
        if place is None:
            return 0, 0, f"{name} is lost"
        for frame, code in enumerate(map(float, truth["codes"])):
            ours, theirs, shown = world(usd, written, place, code), world(usd, source, place, code), truth[name][frame]
            if ours.shape != theirs.shape:
                return 0, 0, f"{name} has {len(ours)} vertices, not {len(theirs)}"
            of_stage = max(of_stage, np.linalg.norm(ours - theirs, axis=1).max())
            of_blender = max(of_blender, np.linalg.norm(ours - shown, axis=1).max() if ours.shape == shown.shape else np.inf)
    percents = [100 * distance / clip.info["diagonal"] for distance in (of_stage, of_blender)]
    return *percents, f"{percents[0]:.4f} % is more than {ASKED} %" if percents[0] > 1.02 * ASKED else None


def compare(folder):
    import anicodec
    from anicodec import usd

    faults = stages = others = 0
    largest = 0
    for path in sorted(folder.glob("*.usdc"), key=lambda path: int(path.stem)):
        try:
            percent, of_blender, fault = compare_one(anicodec, usd, path, np.load(path.with_suffix(".npz")))
        except ValueError as error:
            percent, of_blender, fault = 0, 0, str(error)
        stages += 1
        largest = max(largest, percent)
        others += of_blender > 1.02 * ASKED
        if fault:
            faults += 1
            print(f"{path.name}: {fault}", flush=True)
    print(f"{stages} stages, {faults} faults; at most {largest:.4f} % of the diagonal from usd-core, where {ASKED} % were asked for; "
          f"{others} stages are not what Blender shows")
    return 1 if faults or not stages else 0


def main():
    if len(sys.argv) < 3 or sys.argv[1] not in ("write", "compare"):
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[2])
    if sys.argv[1] == "write":
        write(folder, *(int(text) for text in (sys.argv[3:5] + ["30", "1"][len(sys.argv) - 3:])))
    else:
        sys.exit(compare(folder))


if __name__ == "__main__":
    main()
