# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Clips to stages of USD."""
from __future__ import annotations

import contextlib
import os
from typing import Any, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, Vt

from ._usd_materials import LookWriter
from ._usd_stage import MATERIALS, PARTS, identifier, snapped_rate
from .clip import Clip, open as open_clip


def decode(clip: Any, target: Union[str, os.PathLike, Usd.Stage], *, over: bool = False, normals: bool = True,
           frames: slice = slice(None)) -> Usd.Stage:
    """Writes a clip (or what open() takes) to a stage, or to a new one at a path, which is saved; returns the stage.

    A mesh for each of the clip, in world space, with points at the time code of each frame; one that rests has them once.
    Meshes of a stage come back at their paths, time codes and units, others below a prim that is named for the clip and is at its
    origin. Several clips are variants "clip". over: prims are "over", and meshes leave the transforms above them, so that the
    result fits as a layer over the stage that was encoded. normals=False leaves out normals that say which edges are smooth. frames: numbers of
    the frames to write; they keep their time codes.
    """
    source = clip if isinstance(clip, Clip) else open_clip(clip)
    stage = target if isinstance(target, Usd.Stage) else Usd.Stage.CreateNew(os.fspath(target))
    about = source.metadata.get("usd")
    about = about if isinstance(about, dict) else {}
    per_second = about.get("timeCodesPerSecond")
    if not isinstance(per_second, (int, float)) or not 0 < per_second < 1e9:
        per_second = float(source.fps)
    codes = _codes(source, float(snapped_rate(per_second)))
    stage.SetTimeCodesPerSecond(per_second)
    stage.SetFramesPerSecond(float(source.fps))
    wanted = range(len(codes))[frames]
    stage.SetStartTimeCode(min((codes[frame] for frame in wanted), default=min(codes)))
    stage.SetEndTimeCode(max((codes[frame] for frame in wanted), default=max(codes)))
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z if source.info["up"] == "z" else UsdGeom.Tokens.y)
    if source.info["metres_per_unit"] > 0:
        UsdGeom.SetStageMetersPerUnit(stage, float(str(np.float32(source.info["metres_per_unit"]))))
    paths = _paths(source, about)
    prims = [_define(stage, path, over) for path in paths]
    roots = list(dict.fromkeys(path.GetPrefixes()[0] for path in paths))
    default = next((root for root in roots if root.name == about.get("defaultPrim")), roots[0])
    stage.SetDefaultPrim(stage.GetPrimAtPath(default))
    for prim in prims if over else map(stage.GetPrimAtPath, roots):
        _place_at_origin(UsdGeom.Xformable(prim) if not over else UsdGeom.Mesh(prim), source.info["origin"], over)
    looks = None if over else LookWriter(stage)
    for prim, mesh in zip(prims, source.meshes):
        _write_surface(UsdGeom.Mesh(prim), mesh, looks)
    for number, info in enumerate(source.clips):
        shown = [frame for frame in range(info.first_frame, info.first_frame + info.frame_count) if frame in wanted]
        if not shown:
            continue
        variants = _addother_variants(stage, roots, info.name or f"clip{number}") if len(source.clips) > 1 else []
        for prim, mesh in zip(prims, source.meshes):
            sets = [chosen for chosen in variants if prim.GetPath().HasPrefix(chosen.GetPrim().GetPath())]
            with sets[0].GetVariantEditContext() if sets else contextlib.nullcontext():
                _write_motion(UsdGeom.Mesh(prim), mesh, source, number, shown, codes, normals)
    if len(source.clips) > 1:
        for root in roots:
            chosen = stage.GetPrimAtPath(root).GetVariantSet("clip")
            chosen.SetVariantSelection(chosen.GetVariantNames()[0] if frames != slice(None) else identifier(source.clips[0].name or "clip0"))
    if not isinstance(target, Usd.Stage):
        stage.GetRootLayer().Save()
    return stage


def _codes(source: Clip, per_second: float) -> List[float]:
    """The time code of each frame; clips have their own."""
    return [_whole((info.start_time + source.time(frame)) * per_second) for info in source.clips
            for frame in range(info.first_frame, info.first_frame + info.frame_count)]


def _paths(source: Clip, about: Dict[str, Any]) -> List[Sdf.Path]:
    """A prim for each mesh: that of the stage it came from, if that is known."""
    known = about.get("prims")
    if not isinstance(known, list) or len(known) != len(source.meshes):
        known = [None] * len(source.meshes)
    # One of several clips does not name them all.
    root = "/" + identifier((source.name if len(source.clips) == 1 else "") or "clip")
    found: List[Sdf.Path] = []
    for number, (path, mesh) in enumerate(zip(known, source.meshes)):
        valid = isinstance(path, str) and Sdf.Path.IsValidPathString(path) and Sdf.Path(path).IsAbsoluteRootOrPrimPath() \
            and path != "/" and "{" not in path
        place = Sdf.Path(path) if valid else Sdf.Path(f"{root}/{identifier(mesh.name or 'mesh')}")
        if place in found:
            place = place.ReplaceName(f"{place.name}_{number}")
        while place in found:
            place = place.ReplaceName(place.name + "_")
        found.append(place)
    return found


def _define(stage: Usd.Stage, path: Sdf.Path, over: bool) -> Usd.Prim:
    if over:
        return stage.OverridePrim(path)
    for parent in path.GetPrefixes()[:-1]:
        if not stage.GetPrimAtPath(parent) or not stage.GetPrimAtPath(parent).GetTypeName():
            UsdGeom.Xform.Define(stage, parent)
    return UsdGeom.Mesh.Define(stage, path).GetPrim()


def _place_at_origin(prim: UsdGeom.Xformable, origin: Sequence[float], leave_parents: bool) -> None:
    operations = []
    if any(origin):
        operations.append(prim.AddTranslateOp(UsdGeom.XformOp.PrecisionDouble, "origin"))
        operations[0].Set(Gf.Vec3d(*origin))
    if operations or leave_parents:
        prim.SetXformOpOrder(operations, leave_parents)


def _addother_variants(stage: Usd.Stage, roots: List[Sdf.Path], name: str) -> List[Usd.VariantSet]:
    """The variant of a clip, of each root and chosen there."""
    chosen = [stage.GetPrimAtPath(root).GetVariantSets().AddVariantSet("clip") for root in roots]
    for variants in chosen:
        variants.AddVariant(identifier(name))
        variants.SetVariantSelection(identifier(name))
    return chosen


#: Parts of a time code that frames stand at.
_PARTS = (1, *range(2, 17), 24, 25, 30, 48, 50, 60, 120)


def _whole(code: float) -> float:
    """A time code, whole or a whole part where only rounding keeps it from that."""
    for parts in _PARTS:
        near = round(code * parts) / parts
        # A rate of few digits moves whole codes by more than rounding does.
        if abs(code - near) < max(1e-6 if parts == 1 else 1e-9, 1e-9 * abs(code)):
            return near
    return code


def _write_surface(prim: UsdGeom.Mesh, mesh: Any, looks: Optional[LookWriter]) -> None:
    """Writes all that does not move."""
    offsets, corners = mesh.polygons
    prim.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(np.diff(offsets).astype(np.int32)))
    prim.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(corners.astype(np.int32)))
    prim.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    for number, attribute in enumerate(mesh.attributes):
        if attribute.labels:
            uv = next((other.name or "st" for other in mesh.attributes if other.kind == "uv"), "st")
            _write_subsets(prim, attribute, identifier(uv), looks)
        elif not attribute.moves and attribute.kind != "normal":  # of corners that share one, without numbers
            _write_attribute(prim, attribute, number, [(Usd.TimeCode.Default(), attribute.values)])


def _write_motion(prim: UsdGeom.Mesh, mesh: Any, clip: Clip, chosen: int, frames: List[int], codes: List[float], normals: bool) -> None:
    """Writes all that moves, in frames of one of the clips."""
    shown = [mesh.shown_in(frame) for frame in frames]
    there = [frame for frame, is_there in zip(frames, shown) if is_there]
    for number, frame in enumerate(frames):
        if not all(shown) and (number == 0 or shown[number - 1] != shown[number]):
            prim.CreateVisibilityAttr().Set(UsdGeom.Tokens.inherited if shown[number] else UsdGeom.Tokens.invisible, codes[frame])
    rests = all(shown) and all(np.array_equal(mesh[frame], mesh[frames[0]]) for frame in frames[1:])
    told = [number for number, a in enumerate(mesh.attributes) if a.kind == "normal"]
    hard = any(mesh.attributes[number].domain == "corners" for number in told)
    # Normals of the first frame are wrong in others.
    kept = [number for number in told if mesh.attributes[number].values.ndim == 2 and (mesh.attributes[number].moves or rests)]
    for frame in there[:1] if rests else there:
        code = Usd.TimeCode.Default() if rests else codes[frame]
        positions = mesh[frame]
        prim.CreatePointsAttr().Set(Vt.Vec3fArray.FromNumpy(positions), code)
        prim.CreateExtentAttr().Set(Vt.Vec3fArray.FromNumpy(np.stack([positions.min(axis=0), positions.max(axis=0)])), code)
        if normals and not kept:
            values = mesh.normals(positions, per_corner=hard, source_edges=hard)
            prim.CreateNormalsAttr().Set(Vt.Vec3fArray.FromNumpy(values), code)
            prim.SetNormalsInterpolation(UsdGeom.Tokens.faceVarying if hard else UsdGeom.Tokens.vertex)
    gone = [codes[frame] for number, frame in enumerate(frames) if not shown[number] and (number == 0 or shown[number - 1])]
    moving = [prim.GetPointsAttr(), prim.GetExtentAttr(), prim.GetNormalsAttr()] if there else []
    for number, attribute in enumerate(mesh.attributes):
        if attribute.moves and there:
            moving.append(_write_attribute(prim, attribute, number, [
                (codes[frame], mesh.attribute_at(number, clip.time(frame), clip=chosen)) for frame in there]))
        elif number in kept[:1]:
            _write_attribute(prim, attribute, number, [(Usd.TimeCode.Default(), attribute.values)])
    for target in moving:
        for code in gone if target.GetNumTimeSamples() else []:
            target.Set(Sdf.ValueBlock(), code)


def _write_subsets(prim: UsdGeom.Mesh, attribute: Any, uv: str, looks: Optional[LookWriter]) -> None:
    family = MATERIALS if attribute.kind == "material" else PARTS
    for label, name in enumerate(attribute.labels, 1):
        faces = np.flatnonzero(attribute.values == label).astype(np.int32)
        if not len(faces):
            continue
        subset = UsdGeom.Subset.CreateUniqueGeomSubset(prim, identifier(name), UsdGeom.Tokens.face, Vt.IntArray.FromNumpy(faces), family)
        if family == MATERIALS and looks:
            look = attribute.looks[label - 1] if attribute.looks else None
            looks.bind(subset.GetPrim(), prim.GetPath().GetPrefixes()[0], name, look, uv)
            if look is not None and look.double_sided:
                prim.CreateDoubleSidedAttr(True)


def _write_attribute(prim: UsdGeom.Mesh, attribute: Any, number: int, samples: List[Tuple[Any, np.ndarray]]) -> Usd.Attribute:
    types = Sdf.ValueTypeNames
    width = attribute.values.shape[1]
    kind = {("uv", 2): (types.TexCoord2fArray, Vt.Vec2fArray), ("colour", 3): (types.Color3fArray, Vt.Vec3fArray),
            ("colour", 4): (types.Color4fArray, Vt.Vec4fArray), ("normal", 3): (types.Normal3fArray, Vt.Vec3fArray)}
    by_width = {2: (types.Float2Array, Vt.Vec2fArray), 3: (types.Float3Array, Vt.Vec3fArray), 4: (types.Float4Array, Vt.Vec4fArray)}
    chosen, array = kind.get((attribute.kind, width)) or by_width.get(width) or (types.FloatArray, Vt.FloatArray)
    standard = {"uv": "st", "colour": "displayColor"}.get(attribute.kind, f"attribute{number}")
    interpolation = {"vertices": UsdGeom.Tokens.vertex, "corners": UsdGeom.Tokens.faceVarying,
                     "polygons": UsdGeom.Tokens.uniform}[attribute.domain]
    if attribute.kind == "normal":
        target = prim.CreateNormalsAttr()
        prim.SetNormalsInterpolation(interpolation)
    else:
        target = UsdGeom.PrimvarsAPI(prim).CreatePrimvar(identifier(attribute.name or standard), chosen, interpolation,
                                                         *([width] if width > 4 else [])).GetAttr()
    for code, values in samples:
        values = np.ascontiguousarray(values)
        target.Set(array.FromNumpy(values if 1 < width < 5 else values.ravel()), code)
    return target
