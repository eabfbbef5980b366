#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Compares stages of a folder, encoded, with what usd-core makes of them at every sample: points, transforms, skins baked, instances.

usage: compare_stages.py FOLDER      in a Python with anicodec[usd]; no part of CI

stages_of_blender.py, stages_of_newton.py and stages_of_usd.py write such folders. Each stage is encoded, and read back twice: as
decode() writes it, and as a layer. Printed is how far vertices are from their places in the stage at most, in per cent of the diagonal:
more than was asked for is a fault, and so are meshes, instances, samples or a rate that are lost. Stages of Blender that are not what
Blender shows are counted: its export of bones is another thing below objects that are scaled unevenly.
"""
import pathlib
import sys
import tempfile

import numpy as np

import anicodec
from anicodec import usd
from pxr import Gf, Usd, UsdGeom, UsdSkel

sys.dont_write_bytecode = True
ASKED = 0.05  # per cent of the diagonal


def codes_of(stage):
    """All time codes of the stage's range with a sample of points or of a transform."""
    codes = set()
    for prim in stage.Traverse(Usd.TraverseInstanceProxies()):
        for attribute in prim.GetAuthoredAttributes():
            codes.update(attribute.GetTimeSamples())
            if hasattr(attribute, "HasSpline") and attribute.HasSpline():
                codes.update(attribute.GetSpline().GetKnots().keys())
    if stage.HasAuthoredTimeCodeRange():
        codes = {code for code in codes if stage.GetStartTimeCode() <= code <= stage.GetEndTimeCode()}
        codes.update((stage.GetStartTimeCode(), stage.GetEndTimeCode()))
    return sorted(codes) or [0.0]


def baked(path):
    stage = Usd.Stage.Open(str(path))
    if any(prim.IsA(UsdSkel.Root) for prim in stage.Traverse(Usd.TraverseInstanceProxies())):
        per_second, frames, codes = stage.GetTimeCodesPerSecond(), stage.GetFramesPerSecond(), codes_of(stage)
        stage = Usd.Stage.Open(stage.Flatten())
        stage.SetTimeCodesPerSecond(per_second)
        stage.SetStartTimeCode(codes[0])
        stage.SetEndTimeCode(codes[-1])
        stage.SetFramesPerSecond(64 * max(per_second, frames) if per_second < 240 else 64 * frames)  # between samples, too
        UsdSkel.BakeSkinning(stage.Traverse(), Gf.Interval.GetFullInterval())
    return stage


def points_of(prim, code):
    mesh = UsdGeom.Mesh(prim)
    moving = mesh.ComputePointsAtTime(code, code) if mesh.GetVelocitiesAttr().HasAuthoredValue() else mesh.GetPointsAttr().Get(code)
    return None if moving is None else np.array(moving, float).reshape(-1, 3)


def moved(points, matrix):
    return points @ np.array(matrix)[:3, :3] + np.array(matrix)[3, :3]


def is_shown_level(prim):
    parent = prim.GetParent()
    return "LODRootAPI" not in parent.GetAppliedSchemas() or prim == parent.GetChildren()[0]


def clouds(stage, code):
    """World points of all that is shown: of meshes by their paths, of instances in lists by the path of the outermost instancer."""
    found = {}
    cache = UsdGeom.XformCache(code)

    def walk(prim, to_world, above, outermost):
        """above: the prototype whose space to_world begins in; None for that of the stage."""
        imageable = UsdGeom.Imageable(prim)
        if imageable and imageable.GetVisibilityAttr().Get(code) == UsdGeom.Tokens.invisible or not is_shown_level(prim):
            return
        space = cache.GetLocalToWorldTransform(prim) if above is None else cache.ComputeRelativeTransform(prim, above)[0] * to_world
        if prim.IsA(UsdGeom.PointInstancer):
            instancer = UsdGeom.PointInstancer(prim)
            kinds = instancer.GetPrototypesRel().GetForwardedTargets()
            places = instancer.ComputeInstanceTransformsAtTime(code, code, UsdGeom.PointInstancer.IncludeProtoXform, UsdGeom.PointInstancer.IgnoreMask)
            mask = instancer.ComputeMaskAtTime(code) or [True] * len(places)
            for place, number, shown in zip(places, instancer.GetProtoIndicesAttr().Get(code) or [], mask):
                kind = stage.GetPrimAtPath(kinds[number])
                if shown:
                    walk(kind, place * space, kind, outermost or str(prim.GetPath()))
            return
        if prim.IsA(UsdGeom.Mesh) and imageable.ComputePurpose() in ("default", "render"):
            points = points_of(prim, code)
            if points is not None and len(points):
                found.setdefault(outermost or str(prim.GetPath()), []).append(moved(points, space))
        for child in prim.GetFilteredChildren(Usd.TraverseInstanceProxies()):
            walk(child, to_world, above, outermost)

    for prim in stage.GetPseudoRoot().GetChildren():
        walk(prim, None, None, None)
    return found


def distance_of(theirs, ours):
    """The largest distance from a cloud to the nearest of ours; infinite where one is lost or was added."""
    if len(theirs) != len(ours):
        return np.inf
    largest, left = 0.0, list(ours)
    for cloud in theirs:
        distances = [np.linalg.norm(cloud - other, axis=1).max() if cloud.shape == other.shape else np.inf for other in left]
        nearest = int(np.argmin(distances))
        largest = max(largest, distances[nearest])
        left.pop(nearest)
    return largest


def compare_one(path, folder):
    """Distance from usd-core and from Blender, in per cent of the diagonal."""
    data = usd.encode(str(path), max_error=f"{ASKED}%", effort="fast")
    clip = anicodec.open(data)
    layer = folder / (path.stem + ".anic")
    layer.write_bytes(data)
    source, written, stacked = baked(path), usd.decode(clip, Usd.Stage.CreateInMemory()), Usd.Stage.Open(str(layer))
    plain = Usd.Stage.Open(str(path))
    for name in ("GetTimeCodesPerSecond", "GetStartTimeCode"):
        if plain.HasAuthoredTimeCodeRange() and abs(getattr(written, name)() - getattr(plain, name)()) > 1e-9:
            return f"{name}() is {getattr(written, name)()}, not {getattr(plain, name)()}"
    shown = np.load(path.with_suffix(".npz")) if path.with_suffix(".npz").exists() else None
    if shown is not None:
        rate = shown["rate"][0] / shown["rate"][1]
        if abs(float(clip.fps) - rate) > (1e-6 if shown["rate"][1] != 1 else 1e-12) * rate:
            return f"{float(clip.fps)} frames per second, not {rate}"
    of_stage = of_blender = 0.0
    own_codes = codes_of(written)
    for code in codes_of(plain):
        theirs, at_once = clouds(source, code), {}
        ours_at = min(own_codes, key=lambda own: abs(own - code), default=code)  # which may differ in the last digit
        ours_at = ours_at if abs(ours_at - code) < 1e-9 * max(1, abs(code)) else code
        for name, ours in (("decoded", clouds(written, ours_at)), ("layer", clouds(stacked, ours_at))):
            for place, group in theirs.items():
                # Instances stand below the instancer; a mesh that mirrors at some codes is two.
                mine = [cloud for other, found in ours.items() for cloud in found
                        if other == place or other.startswith(place + "/") or (other.startswith(place + "_") and other[len(place) + 1:].isdigit())]
                distance = distance_of(group, mine)
                if not np.isfinite(distance):
                    return f"{name}: {place} has {[len(one) for one in mine]} points at code {code:g}, not {[len(one) for one in group]}"
                of_stage = max(of_stage, distance)
                at_once[place] = mine
        for frame in np.flatnonzero(shown["codes"] == code) if shown is not None else []:
            for thing in (thing for thing in shown.files if thing.startswith("Thing")):
                mine = next((group for place, group in at_once.items() if f"/{thing}/" in place), [])
                of_blender = max(of_blender, distance_of([shown[thing][frame]], mine))
    return [100 * distance / max(clip.info["diagonal"], 1e-9) for distance in (of_stage, of_blender)]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    paths = sorted((path for path in pathlib.Path(sys.argv[1]).iterdir() if path.suffix in (".usd", ".usda", ".usdc", ".usdz")),
                   key=lambda path: (len(path.stem), path.stem))
    faults = others = 0
    largest = 0.0
    with tempfile.TemporaryDirectory() as folder:
        for path in paths:
            try:
                found = compare_one(path, pathlib.Path(folder))
            except ValueError as error:
                found = str(error)
            if not isinstance(found, str) and found[0] > 1.02 * ASKED:
                found = f"{found[0]:.4f} % is more than {ASKED} %"
            if isinstance(found, str):
                faults += 1
                print(f"{path.name}: {found}", flush=True)
            else:
                largest, others = max(largest, found[0]), others + (found[1] > 1.02 * ASKED)
    print(f"{len(paths)} stages, {faults} faults; at most {largest:.4f} % of the diagonal from usd-core, where {ASKED} % were asked for"
          + (f"; {others} are not what Blender shows" if others else ""))
    sys.exit(1 if faults or not paths else 0)


if __name__ == "__main__":
    main()
