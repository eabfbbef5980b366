# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Imports glTF files and what a round trip made of them into Blender, and compares both: check_files.py -- FOLDER

FOLDER/files.json lists them. A line for each difference; exit status 1 if there is any.
"""
import json
import pathlib
import re
import sys

import addon_utils
import bpy
import numpy as np
from mathutils.kdtree import KDTree

if "bool" not in vars(np):
    np.bool = bool  # Debian's importer of glTF is older than its numpy

FOLDER = pathlib.Path(sys.argv[sys.argv.index("--") + 1])
SAMPLES = 5
faults = []


def complain(case, text):
    faults.append(f"{case}: {text}")
    print(faults[-1], flush=True)


def material_values(material):
    """Inputs of a material's shader that no image drives."""
    shader = next((node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED"), None) \
        if material.use_nodes else None
    if shader is None:
        return {}
    names = ("Metallic", "Roughness", "Alpha", "Base Color", "Emission")
    values = {name: np.round(np.atleast_1d(shader.inputs[name].default_value)[:3], 3).tolist()
              for name in names if not shader.inputs[name].is_linked}
    values["culling"] = material.use_backface_culling
    return values


def world_positions(items):
    graph, points = bpy.context.evaluated_depsgraph_get(), []
    for item in items:
        owner = item.evaluated_get(graph)
        mesh = owner.to_mesh()
        own = np.empty(3 * len(mesh.vertices), np.float32)
        mesh.vertices.foreach_get("co", own)
        used = np.empty(len(mesh.loops), np.int32)
        mesh.loops.foreach_get("vertex_index", used)
        matrix = np.array(owner.matrix_world)
        points.append((own.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3])[np.unique(used)])
        owner.to_mesh_clear()
    return np.concatenate(points)


class Seen:
    """A scene as Blender shows it."""

    def __init__(self, path, fps, frames):
        bpy.ops.wm.read_homefile(use_empty=True)
        addon_utils.enable("io_scene_gltf2")
        scene = bpy.context.scene
        scene.render.fps, scene.render.fps_base = fps[0], fps[1]
        bpy.ops.import_scene.gltf(filepath=str(path))
        # Shapes of bones are no part of the scene.
        shapes = {bone.custom_shape for item in bpy.data.objects if item.pose for bone in item.pose.bones}
        items = [item for item in scene.objects if item.type == "MESH" and item.data.polygons and item not in shapes]
        self.names = sorted(item.name for item in items)
        # Blender numbers materials of one name, of which it makes one more for meshes with vertex colours:
        # by name and input, all values.
        self.materials = {}
        for material in {m for item in items for m in item.data.materials if m}:
            inputs = self.materials.setdefault(re.sub(r"\.\d+$", "", material.name), {})
            for key, value in material_values(material).items():
                inputs.setdefault(key, []).append(value)
        uvs = [np.empty(2 * len(item.data.loops), np.float32) for item in items if item.data.uv_layers]
        for uv, item in zip(uvs, (item for item in items if item.data.uv_layers)):
            item.data.uv_layers[0].data.foreach_get("uv", uv)
        self.uv = np.concatenate(uvs).reshape(-1, 2) if uvs else np.zeros((0, 2))
        self.area = sum(polygon.area * abs(item.matrix_world.to_scale()[0]) ** 2 for item in items
                        for polygon in item.data.polygons)
        self.frames = []
        for frame in frames:
            scene.frame_set(int(frame))
            self.frames.append(world_positions(items))


def farthest(a, b):
    """The farthest that a point of one set is from the other."""
    most = 0
    for points, others in ((a, b), (b, a)):
        tree = KDTree(len(others))
        for i, p in enumerate(others):
            tree.insert(p, i)
        tree.balance()
        most = max(most, max(tree.find(p)[2] for p in points))
    return most


def compare(case):
    name, first = case["name"], case["start"] * case["fps"][0] / case["fps"][1]
    frames = np.unique(np.linspace(0, case["frames"] - 1, SAMPLES).astype(int)) + round(first)
    before = Seen(case["original"], case["fps"], frames)
    after = Seen(FOLDER / case["back"], case["fps"], frames)
    if len(before.names) != len(after.names):
        complain(name, f"{len(after.names)} objects, not {len(before.names)}")
    if sorted(before.materials) != sorted(after.materials):
        complain(name, f"materials {sorted(after.materials)}, not {sorted(before.materials)}")
    for material, inputs in before.materials.items():
        for key, values in inputs.items():
            for found in after.materials.get(material, {}).get(key, []):
                if not any(np.allclose(found, value, atol=4e-3) for value in values):
                    complain(name, f"{material} has {key} {found}, not one of {values}")
    if len(before.uv) and farthest3(before.uv, after.uv) > 2.0 ** -12:
        complain(name, "texture coordinates are others")
    for frame, a, b in zip(frames, before.frames, after.frames):
        off = farthest(a, b)
        if off > case["bound"]:
            complain(name, f"frame {frame} is off by {off:.4g}; allowed are {case['bound']:.4g}")


def farthest3(a, b):
    """The same of points of two coordinates, each looked at once."""
    return farthest(*(np.pad(np.unique(np.round(x, 6), axis=0), ((0, 0), (0, 1))) for x in (a, b)))


def main():
    cases = json.loads((FOLDER / "files.json").read_text())
    for case in cases:
        compare(case)
        print(f"{case['name']}: compared", flush=True)
    print(f"{len(faults)} differences")
    sys.exit(1 if faults else 0)


main()
