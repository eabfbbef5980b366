#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# usd-core 26.11: UsdSkel.BakeSkinning of a stage that has timeCodesPerSecond alone.
#
# A stage with framesPerSecond alone has as many time codes per second, but one with timeCodesPerSecond alone has 24 frames per second.
# BakeSkinning writes points at the samples of the animation and at every frame, so a stage of 60 time codes per second whose
# animation has a sample at each of codes 1 to 6 (Blender 5.2 writes such stages) gets points at 3.5, too, amid them. A reader that
# takes the samples of the baked points for the frames then sees an uneven rate.
#
# Output seen: "[1.0, 2.0, 3.0, 3.5, 4.0, 5.0, 6.0]". Exit status 1 if it is another.
# Way out: SetFramesPerSecond(GetTimeCodesPerSecond()) before baking; samples of the animation are those of the frames.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"${PYTHON:-python3}" -m venv pip >/dev/null
pip/bin/pip install --quiet --disable-pip-version-check usd-core==26.11

cat >bake.py <<'P'
from pxr import Gf, Usd, UsdGeom, UsdSkel

stage = Usd.Stage.CreateInMemory()
stage.SetTimeCodesPerSecond(60)
stage.SetStartTimeCode(1)
stage.SetEndTimeCode(6)
root = UsdSkel.Root.Define(stage, "/root")
bones = UsdSkel.Skeleton.Define(stage, "/root/bones")
motion = UsdSkel.Animation.Define(stage, "/root/motion")
mesh = UsdGeom.Mesh.Define(stage, "/root/mesh")
for joints in (bones, motion):
    joints.CreateJointsAttr(["one"])
bones.CreateBindTransformsAttr([Gf.Matrix4d(1)])
bones.CreateRestTransformsAttr([Gf.Matrix4d(1)])
motion.CreateTranslationsAttr([Gf.Vec3f(0)])
motion.CreateScalesAttr([Gf.Vec3h(1)])
for code in range(1, 7):
    motion.CreateRotationsAttr().Set([Gf.Quatf(Gf.Rotation(Gf.Vec3d(1, 0, 0), 10 * code).GetQuat())], code)
UsdSkel.BindingAPI.Apply(bones.GetPrim()).CreateAnimationSourceRel().SetTargets(["/root/motion"])
mesh.CreatePointsAttr([(0, 0, 0), (1, 0, 0), (0, 1, 0)])
mesh.CreateFaceVertexCountsAttr([3])
mesh.CreateFaceVertexIndicesAttr([0, 1, 2])
binding = UsdSkel.BindingAPI.Apply(mesh.GetPrim())
binding.CreateSkeletonRel().SetTargets(["/root/bones"])
binding.CreateJointIndicesPrimvar(False, 1).Set([0] * 3)
binding.CreateJointWeightsPrimvar(False, 1).Set([1.0] * 3)
UsdSkel.BakeSkinning(stage.Traverse())
print(mesh.GetPointsAttr().GetTimeSamples())
P
seen=$(pip/bin/python bake.py)
echo "$seen"
[[ $seen == "[1.0, 2.0, 3.0, 3.5, 4.0, 5.0, 6.0]" ]]
