#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# Blender 5.3.0 (bpy of PyPI) and usd-core 26.11: a skinned mesh that moves itself, as USD.
#
# In Blender a mesh with an armature modifier may have keys of its own location: it moves while bones bend it. The exporter writes
# both, the location as samples of an xformOp, the bones as a Skeleton with a SkelAnimation, but one
# primvars:skel:geomBindTransform, that of the first frame. UsdSkel places skinned points by that transform and the bones alone, so the
# xformOp has no effect: bones bend the mesh where it stood in the first frame. Nothing says so.
#
# Output seen: "first frame 0 apart, second 1 apart". Exit status 1 if it is another.
# Way out: key the armature or a parent of both, or export without armatures, which gives a sample of the points for each frame.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"${PYTHON:-python3.13}" -m venv pip >/dev/null # bpy 5.3 has a wheel for Python 3.13 alone
pip/bin/pip install --quiet --disable-pip-version-check bpy==5.3.0 usd-core==26.11 numpy==2.5.5

cat >write.py <<'P'
import bpy
import numpy as np

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.mesh.primitive_cube_add()
cube = bpy.context.object
bpy.ops.object.armature_add()
bones = bpy.context.object
cube.parent = bones
cube.vertex_groups.new(name=bones.data.bones[0].name).add(range(8), 1.0, "REPLACE")
cube.modifiers.new("Armature", "ARMATURE").object = bones
scene = bpy.context.scene
scene.frame_start, scene.frame_end = 1, 2
shown = []
bone = bones.pose.bones[0]
bone.rotation_mode = "XYZ"
for frame in (1, 2):
    cube.location = (frame - 1, 0, 0)
    cube.keyframe_insert("location", frame=frame)
    bone.rotation_euler = (0.7 * (frame - 1), 0, 0)
    bone.keyframe_insert("rotation_euler", frame=frame)
for frame in (1, 2):
    scene.frame_set(frame)
    cube_now = cube.evaluated_get(bpy.context.evaluated_depsgraph_get())
    shown.append([cube_now.matrix_world @ vertex.co for vertex in cube_now.data.vertices])
np.save("shown.npy", np.array(shown))
bpy.ops.wm.usd_export(filepath="moving.usda", export_animation=True, export_armatures=True)
P
cat >read.py <<'P'
import numpy as np
from pxr import Usd, UsdGeom, UsdSkel

stage = Usd.Stage.Open("moving.usda")
UsdSkel.BakeSkinning(stage.Traverse())
mesh = next(UsdGeom.Mesh(prim) for prim in stage.Traverse() if prim.IsA(UsdGeom.Mesh))
places = []
for code in (1, 2):
    matrix = np.array(mesh.ComputeLocalToWorldTransform(code))
    points = np.array(mesh.GetPointsAttr().Get(code))
    places.append((np.c_[points, np.ones(len(points))] @ matrix)[:, :3])
apart = np.abs(np.load("shown.npy") - places).max(axis=(1, 2))
print("first frame {:.3g} apart, second {:.3g} apart".format(*apart.round(5)))
P
pip/bin/python write.py >/dev/null
seen=$(pip/bin/python read.py)
echo "$seen"
[[ $seen == "first frame 0 apart, second 1 apart" ]]
