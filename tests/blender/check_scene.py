# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Imports what a round trip made of the scene into Blender, and compares it with what the scene showed and with an import of
what Blender had exported: check_scene.py -- FOLDER

A line for each difference; exit status 1 if there is any.
"""
import pathlib
import sys

import addon_utils
import bpy
import numpy as np
from mathutils.kdtree import KDTree

if "bool" not in vars(np):
    np.bool = bool  # Debian's importer of glTF is older than its numpy

FOLDER = pathlib.Path(sys.argv[sys.argv.index("--") + 1])
RATE, FRAMES = 25, 36
UV_STEP = 2.0 ** -12
TRUTH = dict(np.load(FOLDER / "truth.npz"))
ALL = np.concatenate([TRUTH[name].reshape(-1, 3) for name in ("Arm", "Crate")])
BOUND = 0.0005 * np.linalg.norm(ALL.max(axis=0) - ALL.min(axis=0)) * 1.001
faults = []


def complain(case, text):
    faults.append(f"{case}: {text}")
    print(faults[-1], flush=True)


class Seen:
    """An object as Blender shows it after an import."""

    def __init__(self, item):
        mesh, size = item.data, item.matrix_world.to_scale()[0]
        count = len(mesh.loops)
        self.corners, uv = np.empty(count, np.int32), np.zeros(2 * count, np.float32)
        mesh.loops.foreach_get("vertex_index", self.corners)
        if mesh.uv_layers:
            mesh.uv_layers[0].data.foreach_get("uv", uv)
        self.uv = uv.reshape(-1, 2)
        self.materials = {material.name: values_of(material) for material in mesh.materials if material}
        self.areas = {}
        for polygon in mesh.polygons:
            material = mesh.materials[polygon.material_index] if mesh.materials else None
            name = material.name if material else ""
            self.areas[name] = self.areas.get(name, 0) + size ** 2 * polygon.area
        self.frames = None


def values_of(material):
    """Values of a material, rounded as files round them."""
    shader = next((node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED"), None) \
        if material.use_nodes else None
    if shader is None:
        return {}
    values = {name: shader.inputs[name].default_value for name in ("Metallic", "Roughness", "Alpha")}
    for name in ("Base Color", "Emission"):
        values[name] = tuple(shader.inputs[name].default_value)[:3]
    if not any(values["Emission"]):
        values["Emission"] = (0, 0, 0)
    return {name: np.round(value, 3).tolist() for name, value in values.items()}


def world_positions(item):
    owner = item.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = owner.to_mesh()
    points = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", points)
    matrix = np.array(owner.matrix_world)
    owner.to_mesh_clear()
    return points.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]


def empty_scene():
    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.context.scene.render.fps, bpy.context.scene.render.fps_base = RATE, 1
    for module in ("io_scene_gltf2", "io_scene_fbx"):
        addon_utils.enable(module)


def meshes_of_scene():
    return {item.name.partition(".")[0]: item for item in bpy.data.objects if item.type == "MESH"}


def seen_over_time(first):
    """All meshes of the scene, whose animation begins in frame `first`."""
    items = meshes_of_scene()
    seen = {name: Seen(item) for name, item in items.items()}
    frames = {name: [] for name in items}
    for frame in range(FRAMES):
        bpy.context.scene.frame_set(first + frame)
        for name, item in items.items():
            frames[name].append(world_positions(item))
    for name, one in seen.items():
        one.frames = np.array(frames[name])
    return seen


def first_and_last_key():
    curves = [curve for action in bpy.data.actions for curve in action.fcurves]
    times = [point.co[0] for curve in curves for point in curve.keyframe_points]
    return round(min(times), 3), round(max(times), 3)


def see_scene(case, path):
    """An animated scene in one file."""
    empty_scene()
    if path.suffix == ".fbx":
        bpy.ops.import_scene.fbx(filepath=str(path))
    else:
        bpy.ops.import_scene.gltf(filepath=str(path))
    first, last = first_and_last_key()
    if last - first != FRAMES - 1:
        complain(case, f"{path.name} has keys from frame {first} to {last} at {RATE} a second, not {FRAMES}")
    return seen_over_time(int(first))


def import_obj(path, **axes):
    empty_scene()
    bpy.ops.wm.obj_import(filepath=str(path), **axes)


def see_frames(case, paths):
    """Numbered OBJ files."""
    if len(paths) != FRAMES:
        complain(case, f"{len(paths)} frames instead of {FRAMES}")
    seen, frames = {}, {}
    for path in paths:
        import_obj(path)
        for name, item in meshes_of_scene().items():
            if name not in seen:
                seen[name] = Seen(item)
            frames.setdefault(name, []).append(world_positions(item))
    for name, one in seen.items():
        one.frames = np.array(frames[name])
    return seen


def see_cache(_case, cache):
    """A mesh with a vertex cache beside it."""
    import_obj(cache.with_suffix(".obj"), forward_axis="Y", up_axis="Z")
    for item in meshes_of_scene().values():
        modifier = item.modifiers.new("cache", "MESH_CACHE")
        modifier.cache_format, modifier.filepath, modifier.frame_start = cache.suffix[1:].upper(), str(cache), 1
    return seen_over_time(1)


def compare_shape(case, name, one):
    """Every vertex that the scene showed is there in every frame, and no other."""
    truth = TRUTH[name]
    tree = KDTree(truth.shape[1])
    for number, place in enumerate(truth[0]):
        tree.insert(place, number)
    tree.balance()
    origin = np.array([tree.find(place)[1] for place in one.frames[0]])
    missing = truth.shape[1] - len(set(origin.tolist()))
    if missing:
        complain(case, f"{name}: {missing} vertices are gone")
    off = np.linalg.norm(one.frames - truth[:, origin], axis=2)
    if off.max() > BOUND:
        frame, vertex = np.unravel_index(off.argmax(), off.shape)
        complain(case, f"{name}: off by {off.max():.4g} in frame {frame}, vertex {origin[vertex]}; allowed are {BOUND:.4g}")
    return origin


def compare_uv(case, name, one, origin):
    wanted = {}
    for vertex, uv in zip(TRUTH[name + " corners"], TRUTH[name + " uv"]):
        wanted.setdefault(int(vertex), []).append(uv)
    for vertex, uv in zip(origin[one.corners], one.uv):
        if np.abs(np.array(wanted[int(vertex)]) - uv).max(axis=1).min() > UV_STEP:
            return complain(case, f"{name}: vertex {vertex} has texture coordinates {uv}, not one of {wanted[int(vertex)]}")
    return None


def compare_materials(case, name, one, before):
    if sorted(one.materials) != sorted(before.materials):
        complain(case, f"{name}: materials {sorted(one.materials)}, not {sorted(before.materials)}")
    for material, values in before.materials.items():
        found = one.materials.get(material, values)
        for key, value in values.items():
            if not np.allclose(found.get(key, np.nan), value, atol=2e-3):
                complain(case, f"{name}: {material} has {key} {found.get(key)}, not {value}")
    for material, area in before.areas.items():
        if not np.isclose(one.areas.get(material, 0), area, rtol=0.02):
            complain(case, f"{name}: {material} covers {one.areas.get(material, 0):.3f}, not {area:.3f}")


def compare(case, seen, before, objects=("Arm", "Crate")):
    if sorted(seen) != sorted(objects):
        complain(case, f"objects {sorted(seen)}, not {sorted(objects)}")
    for name in objects:
        if name not in seen:
            continue
        origin = compare_shape(case, name, seen[name])
        compare_uv(case, name, seen[name], origin)
        compare_materials(case, name, seen[name], before[name])


def main():
    scenes = {"glb": FOLDER / "scene.glb", "fbx": FOLDER / "scene.fbx"}
    for case, path in scenes.items():
        compare(case, see_scene(case, FOLDER / f"{case}_back.glb"), see_scene(case, path))
    import_obj(FOLDER / "frames" / "scene1.obj")
    before = {name: Seen(item) for name, item in meshes_of_scene().items()}
    compare("obj", see_frames("obj", sorted((FOLDER / "obj_back").glob("*.obj"))), before)
    for case in ("pc2", "mdd"):
        import_obj(FOLDER / f"{case}.obj", forward_axis="Y", up_axis="Z")
        before = {name: Seen(item) for name, item in meshes_of_scene().items()}
        compare(case, see_cache(case, FOLDER / f"{case}_back.{case}"), before, ("Arm",))
    print(f"{len(faults)} differences")
    sys.exit(1 if faults else 0)


main()
