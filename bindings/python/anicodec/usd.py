# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""USD: meshes of a stage to a clip, and back. Needs the extra: pip install 'anicodec[usd]'."""
from __future__ import annotations

import os
from fractions import Fraction
from typing import Any, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np

from .clip import Clip, open as open_clip
from .encoder import Encoded, SourceMesh, encode_meshes
from .errors import InputError

try:
    from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade, UsdSkel, Vt
except ImportError as error:
    raise ImportError("USD needs the extra of the package: pip install 'anicodec[usd]'") from error

_MATERIALS = "materialBind"


def encode(stage: Union[str, os.PathLike, Usd.Stage], prims: Union[None, str, Sequence[str]] = None, *,
           fps: Any = None, topology_changes: str = "refuse", **options: Any) -> Encoded:
    """Encodes the meshes of a stage, in world space.

    stage: a stage or the path of one. prims: paths; their meshes and all below them. Skins and blend shapes are baked.
    fps: frames per second, default one for each time code, or more where samples stand between them, from the stage's start to
    its end. Texture coordinates, colours, other numbers, hard edges, subsets as materials and visibility are kept; each
    instance of a PointInstancer is a mesh. `notes` of the result names what else the stage has. topology_changes: "refuse",
    or "keep" to store a mesh for each run of frames with equal faces. Other options are those of encode().

    Raises InputError naming the prim, and what encode() raises.
    """
    if topology_changes not in ("refuse", "keep"):
        raise InputError(f"topology_changes is 'refuse' or 'keep', not {topology_changes!r}")
    source = _opened(stage)
    baked = _bake_skins(source)
    notes: List[str] = []
    codes, rate = _time_codes(baked, fps, notes)
    left_out: Dict[str, int] = {}
    readers = [_MeshReader(place, codes, left_out) for place in _places(baked, prims, codes, left_out)]
    meshes = [mesh for reader in readers for mesh in reader.read(topology_changes == "keep")]
    if not meshes:
        raise InputError("the stage has no mesh that is visible")
    options.setdefault("up", "z" if UsdGeom.GetStageUpAxis(baked) == UsdGeom.Tokens.z else "y")
    options.setdefault("unit", UsdGeom.GetStageMetersPerUnit(baked))
    options.setdefault("start_time", codes[0] / baked.GetTimeCodesPerSecond())
    options.setdefault("name", os.path.splitext(os.path.basename(source.GetRootLayer().GetDisplayName()))[0])
    result = encode_meshes(meshes, frame_count=len(codes), fps=rate, **options)
    if left_out:
        notes.append("not kept: " + ", ".join(f"{count} {kind}" if count else kind for kind, count in left_out.items()))
    result.notes = notes
    return result


def _opened(stage: Any) -> Usd.Stage:
    if isinstance(stage, Usd.Stage):
        return stage
    path = os.fspath(stage)
    if not os.path.exists(path):
        raise FileNotFoundError(2, "there is no such file", path)
    try:
        return Usd.Stage.Open(path)
    except Exception as error:
        raise InputError(f"{path}: {str(error).strip().splitlines()[-1]}") from None


def _bake_skins(stage: Usd.Stage) -> Usd.Stage:
    """The stage, or a copy of it in which points move."""
    if not any(prim.IsA(UsdSkel.Root) for prim in stage.Traverse(Usd.TraverseInstanceProxies())):
        return stage
    copy = Usd.Stage.Open(stage.Flatten())
    for prim in copy.Traverse():
        if prim.IsInstance():
            prim.SetInstanceable(False)
    if not UsdSkel.BakeSkinning(copy.Traverse(), Gf.Interval.GetFullInterval()):
        raise InputError("the skins of the stage cannot be baked")
    return copy


def _time_codes(stage: Usd.Stage, fps: Any, notes: List[str]) -> Tuple[List[float], Fraction]:
    """The time code of each frame, and frames per second."""
    per_second = stage.GetTimeCodesPerSecond()
    samples = np.array(sorted({sample for prim in stage.Traverse(Usd.TraverseInstanceProxies())
                               for attribute in prim.GetAuthoredAttributes() for sample in attribute.GetTimeSamples()}))
    if stage.HasAuthoredTimeCodeRange():
        start, end = stage.GetStartTimeCode(), stage.GetEndTimeCode()
    else:
        start, end = (samples[0], samples[-1]) if len(samples) else (0.0, 0.0)
    samples = samples[(samples >= start) & (samples <= end)]
    if fps is not None:
        rates = [fps]
    else:
        rates = [per_second, stage.GetFramesPerSecond(), *(per_second * parts for parts in range(2, 17))]
    steps = [per_second / float(rate) for rate in rates if rate > 0]
    if not steps:
        raise InputError(f"fps must be greater than 0, not {fps!r}")
    between = [int((np.abs((samples - start) / step - np.round((samples - start) / step)) > 1e-4).sum()) for step in steps]
    best = between.index(0) if 0 in between else 0
    if between[best]:
        notes.append(f"{between[best]} time samples of the stage stand between the frames; fps= samples it at others")
    rate, step = Fraction(rates[best]).limit_denominator(100000), steps[best]
    count = int(np.floor((end - start) / step + 1e-6)) + 1
    if count < 1 or count >= 2**24:
        raise InputError(f"the stage has no frames from {start:g} to {end:g}")
    return [start + frame * step for frame in range(count)], rate


# Prims that become meshes or say how these move and look; materials keep their names.
_KEPT_TYPES = ("", "Mesh", "Xform", "Scope", "GeomSubset", "Material", "Shader", "NodeGraph", "SkelRoot", "Skeleton", "SkelAnimation",
               "BlendShape", "PointInstancer")


class _Place:
    """A mesh, or one instance of it: matrices are those of pxr, for row vectors."""

    def __init__(self, mesh: UsdGeom.Mesh, instancer: Optional[UsdGeom.PointInstancer] = None, instance: int = 0,
                 prototype: Optional[Usd.Prim] = None):
        self.mesh, self.prim = mesh, mesh.GetPrim()
        self._instancer, self._instance, self._prototype = instancer, instance, prototype
        self.name = self.prim.GetName() + (f"_{instance}" if instancer else "")

    def is_visible(self, code: float) -> bool:
        owner = self._instancer or UsdGeom.Imageable(self.prim)
        if UsdGeom.Imageable(owner.GetPrim()).ComputeVisibility(code) == UsdGeom.Tokens.invisible:
            return False
        mask = self._instancer.ComputeMaskAtTime(code) if self._instancer else []
        return not mask or mask[self._instance]

    def matrix(self, cache: UsdGeom.XformCache, code: float) -> np.ndarray:
        world = cache.GetLocalToWorldTransform(self.prim)
        if self._instancer:
            world = world * cache.GetLocalToWorldTransform(self._prototype).GetInverse() * \
                _instances_at(self._instancer, code)[self._instance] * cache.GetLocalToWorldTransform(self._instancer.GetPrim())
        return np.array(world)


def _instances_at(instancer: UsdGeom.PointInstancer, code: float) -> Any:
    return instancer.ComputeInstanceTransformsAtTime(code, code, UsdGeom.PointInstancer.IncludeProtoXform,
                                                     UsdGeom.PointInstancer.IgnoreMask)


def _places(stage: Usd.Stage, prims: Union[None, str, Sequence[str]], codes: List[float], left_out: Dict[str, int]) -> List[_Place]:
    wanted = None if prims is None else [Sdf.Path(path) for path in ([prims] if isinstance(prims, str) else prims)]
    for path in wanted or []:
        if not stage.GetPrimAtPath(path):
            raise InputError(f"the stage has no prim {path}")
    found: List[_Place] = []
    walk = iter(Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()))
    for prim in walk:
        if wanted is not None and not any(prim.GetPath().HasPrefix(path) for path in wanted):
            continue
        kind = prim.GetTypeName()
        if kind not in _KEPT_TYPES:
            left_out[kind] = left_out.get(kind, 0) + 1
        if prim.IsA(UsdGeom.PointInstancer):
            walk.PruneChildren()  # prototypes stand nowhere by themselves
            found.extend(_instances(stage, UsdGeom.PointInstancer(prim), codes, left_out))
        elif kind == "Material" and UsdShade.Material(prim).GetSurfaceOutputs():
            left_out["values of materials"] = 0
        elif prim.IsA(UsdGeom.Mesh) and _is_rendered(prim):
            found.append(_Place(UsdGeom.Mesh(prim)))
    if not found:
        raise InputError("the stage has no mesh" + (f" below {', '.join(map(str, wanted))}" if wanted else ""))
    return found


def _is_rendered(prim: Usd.Prim) -> bool:
    return UsdGeom.Imageable(prim).ComputePurpose() in (UsdGeom.Tokens.default_, UsdGeom.Tokens.render)


def _instances(stage: Usd.Stage, instancer: UsdGeom.PointInstancer, codes: List[float], left_out: Dict[str, int]) -> List[_Place]:
    """The meshes of the prototype of each instance."""
    roots = [stage.GetPrimAtPath(path) for path in instancer.GetPrototypesRel().GetForwardedTargets()]
    numbers = list(instancer.GetProtoIndicesAttr().Get(codes[0]) or [])
    same = all(list(instancer.GetProtoIndicesAttr().Get(code) or []) == numbers for code in codes) and \
        all(len(_instances_at(instancer, code)) == len(numbers) for code in codes)
    if not same or any(number < 0 or number >= len(roots) or not roots[number] for number in numbers):
        kind = "PointInstancer whose instances come and go"
        left_out[kind] = left_out.get(kind, 0) + 1
        return []
    return [_Place(UsdGeom.Mesh(prim), instancer, instance, roots[number]) for instance, number in enumerate(numbers)
            for prim in Usd.PrimRange(roots[number], Usd.TraverseInstanceProxies()) if prim.IsA(UsdGeom.Mesh) and _is_rendered(prim)]


# Attributes of a mesh that are read, or say what the mesh says anyway.
_KEPT_ATTRIBUTES = ("points", "faceVertexCounts", "faceVertexIndices", "holeIndices", "orientation", "normals", "extent", "visibility",
                    "purpose", "subdivisionScheme", "interpolateBoundary", "faceVaryingLinearInterpolation",
                    "triangleSubdivisionRule", "xformOpOrder")
_KEPT_SPACES = ("primvars:", "xformOp:", "skel:")


class _MeshReader:
    """Reads a mesh at all time codes."""

    def __init__(self, place: _Place, codes: List[float], left_out: Dict[str, int]):
        self._place, self._mesh, self._prim, self._codes, self._left_out = place, place.mesh, place.prim, codes, left_out
        for attribute in self._prim.GetAuthoredAttributes():
            name = attribute.GetName()
            if name not in _KEPT_ATTRIBUTES and not name.startswith(_KEPT_SPACES):
                left_out[f"'{name}' of meshes"] = 0

    def read(self, keep_changes: bool) -> List[SourceMesh]:
        """The mesh, or several where its faces change; none where it is never there."""
        runs: List[Dict[str, Any]] = []
        cache = UsdGeom.XformCache()
        for frame, code in enumerate(self._codes):
            if not self._place.is_visible(code):
                continue
            points = self._mesh.GetPointsAttr().Get(code)
            if not points:
                continue
            faces = self._faces(code)
            cache.SetTime(code)
            matrix = self._place.matrix(cache, code)
            positions = np.array(points, np.float64).reshape(-1, 3) @ matrix[:3, :3] + matrix[3, :3]
            same = [run for run in runs[-2:] if len(run["positions"][0]) == len(positions) and
                    all(np.array_equal(a, b) for a, b in zip(run["faces"], faces))]
            if same and same[-1] is not runs[-1]:
                same = []
            if runs and not same and not keep_changes:
                raise InputError(f"{self._prim.GetPath()}: the faces change at time code {code:g}; "
                                 "topology_changes='keep' stores each run of equal ones")
            # A transform that mirrors turns the faces, at the codes at which it does.
            mirrored = bool(np.linalg.det(matrix[:3, :3]) < 0)
            run = next((run for run in same if run["mirrored"] == mirrored), None)
            if run is None:
                run = {"faces": faces, "mirrored": mirrored, "positions": [], "frames": []}
                runs.append(run)
            run["positions"].append(positions)
            run["frames"].append(frame)
        return [self._source(run) for run in runs]

    def _faces(self, code: float) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Corners of each face, vertices of the corners, and the faces that are holes."""
        counts = np.array(self._mesh.GetFaceVertexCountsAttr().Get(code) or [], np.int64)
        corners = np.array(self._mesh.GetFaceVertexIndicesAttr().Get(code) or [], np.int64)
        if counts.sum() != len(corners) or (counts < 0).any():
            raise InputError(f"{self._prim.GetPath()}: faceVertexCounts do not fit faceVertexIndices")
        holes = np.array(self._mesh.GetHoleIndicesAttr().Get(code) or [], np.int64)
        return counts, corners, holes[(holes >= 0) & (holes < len(counts))]

    def _source(self, run: Dict[str, Any]) -> SourceMesh:
        counts, corners, holes = run["faces"]
        self._order = np.arange(len(corners))
        if (self._mesh.GetOrientationAttr().Get() == UsdGeom.Tokens.leftHanded) != run["mirrored"]:
            starts = np.repeat(np.cumsum(counts) - counts, counts)
            self._order = 2 * starts + np.repeat(counts, counts) - 1 - np.arange(len(corners))
        self._kept = np.ones(len(counts), bool)
        self._kept[holes] = False
        self._order = self._order[np.repeat(self._kept, counts)]
        frames = run["frames"]
        offsets = np.concatenate([[0], np.cumsum(counts[self._kept])])
        mesh = SourceMesh(np.stack(run["positions"]), (offsets, corners[self._order]), name=self._place.name,
                          runs=_runs(frames, len(self._codes)), uv={}, colours={}, normals={}, custom={},
                          materials=self._materials(len(counts)))
        codes = [self._codes[frame] for frame in frames]
        for primvar in UsdGeom.PrimvarsAPI(self._prim).GetPrimvarsWithValues():
            self._add_primvar(mesh, primvar, run, codes)
        self._add_normals(mesh, run, codes[0])
        return mesh

    def _add_primvar(self, mesh: SourceMesh, primvar: UsdGeom.Primvar, run: Dict[str, Any], codes: List[float]) -> None:
        name, kind = primvar.GetPrimvarName(), primvar.GetTypeName()
        if name.startswith("skel:") or name == "normals":
            return
        sampled = codes if primvar.ValueMightBeTimeVarying() and len(codes) > 1 else codes[:1]
        frames = [self._values(primvar, run, code) for code in sampled]
        if any(frame is None or frame.shape != frames[0].shape or frame.shape[-1] > 16 for frame in frames):
            self._left_out[f"primvar '{name}'"] = 0
            return
        values = frames[0] if len(frames) == 1 else np.stack(frames)
        is_uv = kind.role == "TextureCoordinate" or name.startswith(("st", "uv", "UV"))
        if is_uv and values.shape[-1] == 2:
            mesh.uv[name] = values
        elif kind.role == "Color" and values.shape[-1] in (3, 4):
            mesh.colours[name] = np.clip(values, 0, 1)
        else:
            mesh.custom[name] = values

    def _values(self, primvar: UsdGeom.Primvar, run: Dict[str, Any], code: float) -> Optional[np.ndarray]:
        """Elements x components, of vertices or of corners; None for what is not numbers."""
        flat = primvar.ComputeFlattened(code)
        try:
            values = np.atleast_1d(np.array(flat))
        except (TypeError, ValueError):
            return None
        if values.dtype.kind not in "fiu" or values.size == 0:
            return None
        if not primvar.GetTypeName().isArray:
            values = values[None]
        values = values.reshape(len(values), -1).astype(np.float32)
        counts = run["faces"][0]
        vertices, corners = len(run["positions"][0]), counts.sum()
        interpolation = primvar.GetInterpolation()
        if interpolation in (UsdGeom.Tokens.vertex, UsdGeom.Tokens.varying):
            return values if len(values) == vertices else None
        if interpolation == UsdGeom.Tokens.faceVarying:
            return values[self._order] if len(values) == corners else None
        if interpolation == UsdGeom.Tokens.uniform:
            return np.repeat(values[self._kept], counts[self._kept], axis=0) if len(values) == len(counts) else None
        return np.repeat(values[:1], vertices, axis=0)

    def _add_normals(self, mesh: SourceMesh, run: Dict[str, Any], code: float) -> None:
        primvar = UsdGeom.PrimvarsAPI(self._prim).GetPrimvar("normals")
        if primvar and primvar.HasValue():
            values, interpolation = primvar.ComputeFlattened(code), primvar.GetInterpolation()
        else:
            values, interpolation = self._mesh.GetNormalsAttr().Get(code), self._mesh.GetNormalsInterpolation()
        if not values or interpolation != UsdGeom.Tokens.faceVarying or len(values) != run["faces"][0].sum():
            return  # normals of vertices follow from positions
        mesh.normals["normals"] = np.array(values, np.float32).reshape(-1, 3)[self._order]

    def _materials(self, polygons: int) -> Optional[Tuple[List[str], np.ndarray]]:
        names: List[str] = []
        numbers = np.full(polygons, -1)
        whole = UsdShade.MaterialBindingAPI(self._prim).ComputeBoundMaterial()[0]
        if whole:
            names.append(whole.GetPrim().GetName())
            numbers[:] = 0
        for subset in UsdGeom.Subset.GetGeomSubsets(self._mesh, UsdGeom.Tokens.face, _MATERIALS):
            bound = UsdShade.MaterialBindingAPI(subset.GetPrim()).ComputeBoundMaterial()[0]
            name = (bound or subset).GetPrim().GetName()
            if name not in names:
                names.append(name)
            members = np.array(subset.GetIndicesAttr().Get() or [], np.int64)
            if len(members) and (members.min() < 0 or members.max() >= polygons):
                raise InputError(f"{subset.GetPrim().GetPath()}: a face is not of {polygons}")
            numbers[members] = names.index(name)
        return (names, numbers[self._kept]) if names else None


def _runs(frames: List[int], count: int) -> List[Tuple[int, int]]:
    if len(frames) == count:
        return []
    breaks = np.flatnonzero(np.diff(frames) > 1) + 1
    return [(int(part[0]), len(part)) for part in np.split(np.array(frames), breaks)]


def decode(clip: Any, target: Union[str, os.PathLike, Usd.Stage]) -> Usd.Stage:
    """Writes a clip (or what open() takes) to a stage, or to a new one at a path, which is saved: a mesh for each of
    the clip, with points at the time code of each frame, as the source had it, below a prim that is at the origin of the clip.
    Returns the stage."""
    source = clip if isinstance(clip, Clip) else open_clip(clip)
    stage = target if isinstance(target, Usd.Stage) else Usd.Stage.CreateNew(os.fspath(target))
    rate = float(source.fps)
    stage.SetTimeCodesPerSecond(rate)
    stage.SetFramesPerSecond(rate)
    first = _whole(source.info["start_time"] * rate)
    stage.SetStartTimeCode(first)
    stage.SetEndTimeCode(_whole(first + source.duration * rate))
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z if source.info["up"] == "z" else UsdGeom.Tokens.y)
    if source.info["metres_per_unit"] > 0:
        UsdGeom.SetStageMetersPerUnit(stage, source.info["metres_per_unit"])
    root = UsdGeom.Xform.Define(stage, "/" + _identifier(source.name or "clip"))
    stage.SetDefaultPrim(root.GetPrim())
    if any(source.info["origin"]):
        root.AddTranslateOp(UsdGeom.XformOp.PrecisionDouble).Set(Gf.Vec3d(*source.info["origin"]))
    taken: set = set()
    for number, mesh in enumerate(source.meshes):
        name = _identifier(mesh.name or "mesh")
        name = name if name not in taken else f"{name}_{number}"
        taken.add(name)
        _write_mesh(UsdGeom.Mesh.Define(stage, root.GetPath().AppendChild(name)), mesh, source,
                    [_whole(first + source.time(frame) * rate) for frame in range(len(source))])
    if not isinstance(target, Usd.Stage):
        stage.GetRootLayer().Save()
    return stage


def _whole(code: float) -> float:
    """A time code, whole where only rounding keeps it from that."""
    return float(round(code)) if abs(code - round(code)) < 1e-6 * max(1.0, abs(code)) else code


def _identifier(text: str) -> str:
    return Sdf.Path.IsValidIdentifier(text) and text or "_" + "".join(c if c.isascii() and c.isalnum() else "_"
                                                                      for c in text)


def _write_mesh(prim: UsdGeom.Mesh, mesh: Any, clip: Clip, codes: List[float]) -> None:
    offsets, corners = mesh.polygons
    prim.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(np.diff(offsets).astype(np.int32)))
    prim.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(corners.astype(np.int32)))
    prim.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    points, extent = prim.CreatePointsAttr(), prim.CreateExtentAttr()
    shown = [mesh.shown_in(frame) for frame in range(len(clip))]
    for frame, there in enumerate(shown):
        code = codes[frame]
        if not all(shown) and (frame == 0 or shown[frame - 1] != there):
            prim.CreateVisibilityAttr().Set(UsdGeom.Tokens.inherited if there else UsdGeom.Tokens.invisible, code)
        if there:
            positions = mesh[frame]
            points.Set(Vt.Vec3fArray.FromNumpy(positions), code)
            extent.Set(Vt.Vec3fArray.FromNumpy(np.stack([positions.min(axis=0), positions.max(axis=0)])), code)
    for number, attribute in enumerate(mesh.attributes):
        _write_attribute(prim, attribute, number)


def _write_attribute(prim: UsdGeom.Mesh, attribute: Any, number: int) -> None:
    if attribute.labels:
        if attribute.kind == "material":
            for label, name in enumerate(attribute.labels, 1):
                UsdGeom.Subset.CreateUniqueGeomSubset(prim, _identifier(name), UsdGeom.Tokens.face, Vt.IntArray.FromNumpy(
                    np.flatnonzero(attribute.values == label).astype(np.int32)), _MATERIALS)
        return
    if attribute.values.ndim != 2:
        return  # hard edges, without numbers
    types = Sdf.ValueTypeNames
    values = np.ascontiguousarray(attribute.values)
    kind = {("uv", 2): (types.TexCoord2fArray, Vt.Vec2fArray), ("colour", 3): (types.Color3fArray, Vt.Vec3fArray),
            ("colour", 4): (types.Color4fArray, Vt.Vec4fArray), ("normal", 3): (types.Normal3fArray, Vt.Vec3fArray)}
    by_width = {1: (types.FloatArray, Vt.FloatArray), 2: (types.Float2Array, Vt.Vec2fArray),
                3: (types.Float3Array, Vt.Vec3fArray), 4: (types.Float4Array, Vt.Vec4fArray)}
    found = kind.get((attribute.kind, values.shape[1])) or by_width.get(values.shape[1])
    if not found:
        return
    standard = {"uv": "st", "colour": "displayColor", "normal": "normals"}.get(attribute.kind, f"attribute{number}")
    interpolation = {"vertices": UsdGeom.Tokens.vertex, "corners": UsdGeom.Tokens.faceVarying,
                     "polygons": UsdGeom.Tokens.uniform}[attribute.domain]
    primvar = UsdGeom.PrimvarsAPI(prim).CreatePrimvar(_identifier(attribute.name or standard), found[0], interpolation)
    primvar.Set(found[1].FromNumpy(values if values.shape[1] > 1 else values.ravel()))
