#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Writes random stages by usd-core: for compare_stages.py.

usage: stages_of_usd.py FOLDER [COUNT [SEED]]      in a Python with usd-core 26 and numpy

Transforms of all kinds, splines, samples between time codes, velocities, skins and blend shapes, instances, instancers in instancers,
layers that are shifted and scaled in time, payloads, value clips, visibility, levels of detail, odd rates and first codes.
"""
import pathlib
import random
import sys

from pxr import Gf, Sdf, Ts, Usd, UsdGeom, UsdSkel

sys.dont_write_bytecode = True
# Time codes, and frames, of a second.
RATES = ((24, 24), (25, None), (30, 30), (None, 30), (48, 24), (1, 30), (6000, 24), (23.976022856742713, 24), (60000 / 1001, None))


class Writer:
    """A stage with random contents."""

    def __init__(self, path, numbers):
        self.path, self.numbers = path, numbers
        self.stage = Usd.Stage.CreateNew(str(path))
        per_second, frames = numbers.choice(RATES)
        if per_second:
            self.stage.SetTimeCodesPerSecond(per_second)
        if frames:
            self.stage.SetFramesPerSecond(frames)
        step = self.stage.GetTimeCodesPerSecond() / self.stage.GetFramesPerSecond() if per_second in (1, 6000) else 1.0
        first = numbers.choice((1, 0, 1001, -7)) * step
        self.codes = [first + frame * step for frame in range(numbers.randint(3, 9))]
        self.step = step
        if numbers.random() < 0.8:
            self.stage.SetStartTimeCode(self.codes[0])
            self.stage.SetEndTimeCode(self.codes[-1])
        UsdGeom.SetStageUpAxis(self.stage, numbers.choice("YZ"))
        UsdGeom.SetStageMetersPerUnit(self.stage, numbers.choice((0.01, 1, 0.0254)))
        self.root = UsdGeom.Xform.Define(self.stage, "/shot")
        self.stage.SetDefaultPrim(self.root.GetPrim())

    def vector(self, low=-2.0, high=2.0):
        return Gf.Vec3d(*(self.numbers.uniform(low, high) for _ in range(3)))

    def sampled_codes(self):
        """Some of the codes, maybe with one between two."""
        codes = sorted(self.numbers.sample(self.codes, self.numbers.randint(2, len(self.codes))))
        return sorted({*codes, codes[0] + 0.5 * self.step}) if self.numbers.random() < 0.2 else codes

    def animate(self, operation, value):
        if self.numbers.random() < 0.5:
            operation.Set(value())
        for code in self.sampled_codes() if self.numbers.random() < 0.6 else []:
            operation.Set(value(), code)
        if operation.Get(self.codes[0]) is None:
            operation.Set(value())

    def spline(self, attribute):
        spline = Ts.Spline()
        for code in (self.codes[0], self.codes[-1]):
            kind = self.numbers.choice((Ts.InterpLinear, Ts.InterpCurve, Ts.InterpHeld))
            spline.SetKnot(Ts.Knot(time=code, value=self.numbers.uniform(-2, 2), nextInterp=kind))
        attribute.SetSpline(spline)

    def transform(self, prim):
        xform, half = UsdGeom.Xformable(prim), UsdGeom.XformOp.PrecisionFloat
        for number in range(self.numbers.randint(0, 4)):
            kind, name = self.numbers.choice(("move", "turn", "turns", "scale", "orient", "matrix", "pivot", "spline")), f"op{number}"
            if kind == "move":
                self.animate(xform.AddTranslateOp(opSuffix=name), self.vector)
            elif kind == "turn":
                self.animate(xform.AddRotateZOp(opSuffix=name), lambda: self.numbers.uniform(-180, 180))
            elif kind == "turns":
                add = self.numbers.choice((xform.AddRotateXYZOp, xform.AddRotateZXYOp, xform.AddRotateYZXOp))
                self.animate(add(opSuffix=name), lambda: Gf.Vec3f(self.vector(-180, 180)))
            elif kind == "scale":
                signs = [self.numbers.choice((1, 1, -1)) for _ in range(3)]  # never through 0, for which UsdSkel has no numbers
                self.animate(xform.AddScaleOp(opSuffix=name), lambda: Gf.Vec3f(*(sign * self.numbers.choice((1, 2, 0.5)) for sign in signs)))
            elif kind == "orient":
                turn = Gf.Rotation(self.vector(), self.numbers.uniform(-180, 180))
                self.animate(xform.AddOrientOp(half, name), lambda: Gf.Quatf(turn.GetQuat()))
            elif kind == "matrix":
                shear = Gf.Matrix4d(1)
                shear.SetRow(0, Gf.Vec4d(1, 0.3, 0, 0))
                self.animate(xform.AddTransformOp(opSuffix=name), lambda: shear * Gf.Matrix4d().SetTranslate(self.vector()))
            elif kind == "pivot":
                xform.AddTranslateOp(opSuffix=name).Set(self.vector())
                self.animate(xform.AddRotateXOp(opSuffix=name), lambda: self.numbers.uniform(-90, 90))
                xform.AddTranslateOp(opSuffix=name, isInverseOp=True)
            else:
                self.spline(xform.AddTranslateXOp(opSuffix=name).GetAttr())
        if self.numbers.random() < 0.1:
            xform.SetResetXformStack(True)
        if self.numbers.random() < 0.2:
            UsdGeom.Imageable(prim).CreateVisibilityAttr().Set("invisible", self.codes[len(self.codes) // 2])
            UsdGeom.Imageable(prim).CreateVisibilityAttr().Set("inherited", self.codes[0])

    def mesh(self, path, moves=True, stage=None):
        mesh = UsdGeom.Mesh.Define(stage or self.stage, path)
        columns, rows = self.numbers.randint(2, 8), self.numbers.randint(2, 8)
        rest = [Gf.Vec3f(x, y, self.numbers.uniform(0, 0.3)) for y in range(rows) for x in range(columns)]
        mesh.CreateFaceVertexCountsAttr([4] * ((columns - 1) * (rows - 1)))
        mesh.CreateFaceVertexIndicesAttr([y * columns + x + corner for y in range(rows - 1) for x in range(columns - 1)
                                          for corner in (0, 1, columns + 1, columns)])
        mesh.CreateSubdivisionSchemeAttr(self.numbers.choice(("none", "catmullClark")))
        if self.numbers.random() < 0.2:
            mesh.CreateOrientationAttr("leftHanded")
        if not moves or self.numbers.random() < 0.2:
            mesh.CreatePointsAttr(rest)
            return mesh
        codes, fast = self.sampled_codes(), self.numbers.random() < 0.2
        for code in codes:
            mesh.CreatePointsAttr().Set([point + Gf.Vec3f(self.vector(-0.2, 0.2)) for point in rest], code)
            if fast:
                mesh.CreateVelocitiesAttr().Set([Gf.Vec3f(self.vector()) for _ in rest], code)
        return mesh

    def skin(self, path):
        root = UsdSkel.Root.Define(self.stage, path)
        bones = UsdSkel.Skeleton.Define(self.stage, path + "/bones")
        motion = UsdSkel.Animation.Define(self.stage, path + "/motion")
        rest = [Gf.Matrix4d(1), Gf.Matrix4d(1).SetTranslate(Gf.Vec3d(0, 1, 0))]
        for skeleton in (bones, motion):
            skeleton.CreateJointsAttr(["low", "low/high"])
        bones.CreateBindTransformsAttr(rest)
        bones.CreateRestTransformsAttr(rest)
        motion.CreateTranslationsAttr([Gf.Vec3f(0, 0, 0), Gf.Vec3f(0, 1, 0)])
        motion.CreateScalesAttr([Gf.Vec3h(1, 1, 1)] * 2)
        motion.CreateBlendShapesAttr(["bulge"])
        for code in self.sampled_codes():
            turn = Gf.Rotation(Gf.Vec3d(1, 0, 0), self.numbers.uniform(-90, 90)).GetQuat()
            motion.CreateRotationsAttr().Set([Gf.Quatf(1), Gf.Quatf(turn)], code)
            motion.CreateBlendShapeWeightsAttr().Set([self.numbers.random()], code)
        self.transform(root.GetPrim())
        mesh = self.mesh(path + "/skin", moves=False)
        count = len(mesh.GetPointsAttr().Get())
        shape = UsdSkel.BlendShape.Define(self.stage, path + "/skin/bulge")
        shape.CreateOffsetsAttr([Gf.Vec3f(self.vector(0, 1)) for _ in range(count)])
        UsdSkel.BindingAPI.Apply(bones.GetPrim()).CreateAnimationSourceRel().SetTargets([motion.GetPath()])
        binding = UsdSkel.BindingAPI.Apply(mesh.GetPrim())
        binding.CreateSkeletonRel().SetTargets([bones.GetPath()])
        binding.CreateBlendShapesAttr(["bulge"])
        binding.CreateBlendShapeTargetsRel().SetTargets([shape.GetPath()])
        binding.CreateJointIndicesPrimvar(False, 2).Set([0, 1] * count)
        weights = [self.numbers.random() for _ in range(count)]
        binding.CreateJointWeightsPrimvar(False, 2).Set([part for weight in weights for part in (weight, 1 - weight)])

    def crowd(self, path, deep=True):
        instancer = UsdGeom.PointInstancer.Define(self.stage, path)
        kinds = []
        for name in ("a", "b"):
            prim = UsdGeom.Xform.Define(self.stage, f"{path}/{name}").GetPrim()
            self.transform(prim)
            if deep and name == "b":
                self.crowd(f"{path}/{name}/inner", deep=False)
            else:
                self.mesh(f"{path}/{name}/leaf")
            kinds.append(prim.GetPath())
        instancer.CreatePrototypesRel().SetTargets(kinds)
        ids = list(range(10, 10 + self.numbers.randint(2, 4)))
        numbers = {one: self.numbers.randrange(2) for one in ids}
        coming = self.numbers.random() < 0.4
        for code in self.codes:
            here = ids if not coming else self.numbers.sample(ids, self.numbers.randint(1, len(ids)))
            instancer.CreateIdsAttr().Set(here, code)
            instancer.CreateProtoIndicesAttr().Set([numbers[one] for one in here], code)
            instancer.CreatePositionsAttr().Set([Gf.Vec3f(self.vector(-9, 9)) for _ in here], code)
            instancer.CreateOrientationsAttr().Set([Gf.Quath(Gf.Quatf(Gf.Rotation(self.vector(), 70).GetQuat())) for _ in here], code)
            instancer.CreateScalesAttr().Set([Gf.Vec3f(1, self.numbers.choice((1, -1, 2)), 1) for _ in here], code)
            if self.numbers.random() < 0.3:
                instancer.CreateInvisibleIdsAttr().Set([self.numbers.choice(ids)], code)
        if self.numbers.random() < 0.3:
            UsdGeom.PointInstancer(instancer).DeactivateId(ids[0])

    def levels(self, path):
        prim = self.stage.DefinePrim(path, "Xform")
        prim.SetMetadata("apiSchemas", Sdf.TokenListOp.Create(prependedItems=["LODRootAPI"]))
        for name in ("fine", "coarse"):
            self.mesh(f"{path}/{name}")

    def layer(self, name):
        """Another file with a mesh, at codes of a time line of its own."""
        path = self.path.with_suffix("") / f"{name}.usda"
        path.parent.mkdir(exist_ok=True)
        stage = Usd.Stage.CreateNew(str(path))
        stage.SetTimeCodesPerSecond(self.stage.GetTimeCodesPerSecond())
        stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, "/prop").GetPrim())
        self.mesh("/prop/part", stage=stage)
        stage.GetRootLayer().Save()
        return f"./{path.parent.name}/{path.name}"

    def reference(self, path, number):
        prim = self.stage.DefinePrim(path, "Xform")
        file = self.layer(f"layer{number}")
        offset = Sdf.LayerOffset(self.numbers.choice((0.0, self.step)), self.numbers.choice((1.0, 2.0, 0.5)))
        if self.numbers.random() < 0.5:
            prim.GetReferences().AddReference(file, layerOffset=offset)
        else:
            prim.GetPayloads().AddPayload(Sdf.Payload(file, layerOffset=offset))
        if self.numbers.random() < 0.5:
            prim.SetInstanceable(True)
        self.transform(prim)

    def value_clips(self, path, number):
        mesh = self.mesh(path, moves=False)
        count = len(mesh.GetPointsAttr().Get())
        mesh.GetPointsAttr().Clear()
        files = []
        for frame, code in enumerate(self.codes):
            file = self.path.with_suffix("") / f"clip{number}.{frame}.usda"
            file.parent.mkdir(exist_ok=True)
            part = Usd.Stage.CreateNew(str(file))
            UsdGeom.Mesh.Define(part, "/a").CreatePointsAttr().Set([Gf.Vec3f(self.vector()) for _ in range(count)], code)
            part.GetRootLayer().Save()
            files.append(Sdf.AssetPath(f"./{file.parent.name}/{file.name}"))
        clips = Usd.ClipsAPI(mesh.GetPrim())
        clips.SetClipAssetPaths(files)
        clips.SetClipPrimPath("/a")
        clips.SetClipActive([(code, i) for i, code in enumerate(self.codes)])
        clips.SetClipTimes([(code, code) for code in self.codes])

    def write(self):
        makers = ["mesh", "mesh", "skin", "crowd", "levels", "reference", "value_clips"]
        for number, kind in enumerate(self.numbers.sample(makers, self.numbers.randint(1, 4))):
            group = UsdGeom.Xform.Define(self.stage, f"/shot/group{number}")
            self.transform(group.GetPrim())
            path = f"{group.GetPath()}/{kind}"
            if kind in ("reference", "value_clips"):
                getattr(self, kind)(path, number)
            else:
                getattr(self, kind)(path)
        self.transform(self.root.GetPrim())
        self.stage.GetRootLayer().Save()


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    count, seed = (int(text) for text in (sys.argv[2:4] + ["30", "1"][len(sys.argv) - 2:]))
    for number in range(seed, seed + count):
        Writer(folder / f"{number}.usda", random.Random(number)).write()


if __name__ == "__main__":
    main()
