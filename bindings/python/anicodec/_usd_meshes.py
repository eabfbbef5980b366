# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Meshes of a stage of USD, and of instances: where they stand, and what they hold at each time code."""
from __future__ import annotations

from typing import Any, Callable, Dict, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
from pxr import Sdf, Usd, UsdGeom, UsdShade

from . import _arrays
from ._usd_materials import read_look
from ._usd_stage import MATERIALS, PARTS, identifier
from .encoder import SourceMesh
from .errors import InputError
from .material import Material

# Prims that become meshes or say how these move and look; materials keep their names.
_KEPT_TYPES = ("", "Mesh", "Xform", "Scope", "GeomSubset", "Material", "Shader", "NodeGraph", "SkelRoot", "Skeleton", "SkelAnimation",
               "BlendShape", "PointInstancer")


class _Instancer:
    """An instancer, and what it shows at each code. An instance is known by its id (or number) and the number of its prototype."""

    def __init__(self, stage: Usd.Stage, prim: Usd.Prim):
        self.prim, self._schema = prim, UsdGeom.PointInstancer(prim)
        self.prototypes = [stage.GetPrimAtPath(path) for path in self._schema.GetPrototypesRel().GetForwardedTargets()]
        self._shown: Dict[float, Dict[Tuple[int, int], np.ndarray]] = {}

    def identities(self, code: float) -> List[Tuple[int, int]]:
        numbers = list(self._schema.GetProtoIndicesAttr().Get(code) or [])
        ids = list(self._schema.GetIdsAttr().Get(code) or [])
        for number in numbers:
            if not 0 <= number < len(self.prototypes) or not self.prototypes[number]:
                raise InputError(f"{self.prim.GetPath()}: an instance has no prototype {number}")
        return list(zip(ids if len(ids) == len(numbers) else range(len(numbers)), numbers))

    def shown(self, code: float) -> Dict[Tuple[int, int], np.ndarray]:
        """The matrix of each instance that is shown, to the space of the instancer."""
        if code not in self._shown:
            here, mask = self.identities(code), self._schema.ComputeMaskAtTime(code)
            # All instances have a place, masked ones too.
            places = self._schema.ComputeInstanceTransformsAtTime(
                code, code, UsdGeom.PointInstancer.IncludeProtoXform, UsdGeom.PointInstancer.IgnoreMask)
            if len(places) != len(here):
                raise InputError(f"{self.prim.GetPath()}: {len(here)} instances have {len(places)} positions at time code {code:g}")
            self._shown[code] = {one: np.array(place) for i, (one, place) in enumerate(zip(here, places)) if not mask or mask[i]}
        return self._shown[code]


class _Step(NamedTuple):
    """An instance on the way from the world to a mesh."""

    instancer: _Instancer
    identity: Tuple[int, int]

    @property
    def prototype(self) -> Usd.Prim:
        return self.instancer.prototypes[self.identity[1]]


class _Place:
    """A mesh, or one instance of it, maybe in an instance of another: matrices are those of pxr, for row vectors."""

    def __init__(self, mesh: UsdGeom.Mesh, steps: Sequence[_Step] = ()):
        self.mesh, self.prim, self._steps = mesh, mesh.GetPrim(), steps
        self.name = "_".join([self.prim.GetName(), *(str(step.identity[0]) for step in steps)])
        self.path = str(steps[0].instancer.prim.GetPath().AppendChild(identifier(self.name)) if steps else self.prim.GetPath())

    def matrix(self, cache: UsdGeom.XformCache, code: float) -> Optional[np.ndarray]:
        """To world space; None where the mesh is not shown."""
        matrix, prim = np.eye(4), self.prim
        for step in reversed(self._steps):
            place = step.instancer.shown(code).get(step.identity)
            if place is None or _hides(prim, step.prototype, code):
                return None
            in_prototype = cache.ComputeRelativeTransform(prim, step.prototype)[0]
            matrix, prim = matrix @ np.array(in_prototype) @ place, step.instancer.prim
        hidden = UsdGeom.Imageable(prim).ComputeVisibility(code) == UsdGeom.Tokens.invisible
        return None if hidden else matrix @ np.array(cache.GetLocalToWorldTransform(prim))


def _hides(prim: Usd.Prim, prototype: Usd.Prim, code: float) -> bool:
    """Whether a prim of a prototype is hidden in it; what is above a prototype does not count."""
    while prim and prim.GetPath().HasPrefix(prototype.GetPath()):
        imageable = UsdGeom.Imageable(prim)
        if imageable and imageable.GetVisibilityAttr().Get(code) == UsdGeom.Tokens.invisible:
            return True
        prim = prim.GetParent()
    return False


def places(stage: Usd.Stage, prims: Union[None, str, Sequence[str]], codes: List[float], left_out: Dict[str, int]) -> List[_Place]:
    wanted = None if prims is None else [Sdf.Path(path) for path in ([prims] if isinstance(prims, str) else prims)]
    for path in wanted or []:
        if not stage.GetPrimAtPath(path):
            raise InputError(f"the stage has no prim {path}")
    found: List[_Place] = []

    def leave_out(kind: str) -> None:
        left_out[kind] = left_out.get(kind, 0) + 1

    walk = iter(Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()))
    next(walk)  # the root of all
    for prim in walk:
        if wanted is not None and not any(prim.GetPath().HasPrefix(path) or path.HasPrefix(prim.GetPath()) for path in wanted):
            walk.PruneChildren()
            continue
        if "LODRootAPI" in prim.GetParent().GetAppliedSchemas() and prim != _shown_level(prim.GetParent()):
            leave_out(f"level of detail beside {_shown_level(prim.GetParent()).GetPath()}")
            walk.PruneChildren()
            continue
        if wanted is not None and not any(prim.GetPath().HasPrefix(path) for path in wanted):
            continue
        kind = prim.GetTypeName()
        if kind not in _KEPT_TYPES:
            leave_out(kind)
        if prim.IsA(UsdGeom.PointInstancer):
            walk.PruneChildren()  # prototypes stand nowhere by themselves
            found.extend(_instances(stage, prim, (), codes, leave_out))
        elif prim.IsA(UsdGeom.Mesh):
            purpose = UsdGeom.Imageable(prim).ComputePurpose()
            if purpose in _PURPOSES:
                found.append(_Place(UsdGeom.Mesh(prim)))
            else:
                leave_out(f"Mesh of purpose {purpose}")
    if not found:
        raise InputError("the stage has no mesh" + (f" below {', '.join(map(str, wanted))}" if wanted else ""))
    return found


_PURPOSES = (UsdGeom.Tokens.default_, UsdGeom.Tokens.render)


def _shown_level(root: Usd.Prim) -> Optional[Usd.Prim]:
    """The level of detail that a renderer takes where nothing else is said."""
    levels = root.GetChildren()
    attribute = root.GetAttribute("lod:default:index")
    index = int(attribute.Get() or 0) if attribute else 0
    return levels[min(max(index, 0), len(levels) - 1)] if levels else None


def _instances(stage: Usd.Stage, prim: Usd.Prim, above: Tuple[_Step, ...], codes: List[float],
               leave_out: Callable[[str], None]) -> List[_Place]:
    """The meshes of the prototype of each instance that is there at any code."""
    if any(step.instancer.prim == prim for step in above):
        raise InputError(f"{prim.GetPath()}: the instancer is in its own prototype")
    instancer = _Instancer(stage, prim)
    for primvar in UsdGeom.PrimvarsAPI(prim).GetPrimvarsWithAuthoredValues():
        if primvar.GetInterpolation() != UsdGeom.Tokens.constant:  # which meshes inherit
            leave_out(f"primvar '{primvar.GetPrimvarName()}' of instances")
    found: List[_Place] = []
    for identity in dict.fromkeys(one for code in codes for one in instancer.identities(code)):
        steps = (*above, _Step(instancer, identity))
        walk = iter(Usd.PrimRange(steps[-1].prototype, Usd.TraverseInstanceProxies()))
        for inner in walk:
            if inner.IsA(UsdGeom.PointInstancer):
                found.extend(_instances(stage, inner, steps, codes, leave_out))
                walk.PruneChildren()
            elif inner.IsA(UsdGeom.Mesh) and UsdGeom.Imageable(inner).ComputePurpose() in _PURPOSES:
                found.append(_Place(UsdGeom.Mesh(inner), steps))
            elif inner.GetTypeName() not in _KEPT_TYPES:
                leave_out(f"{inner.GetTypeName()} of an instance")
    return found


# Attributes of a mesh that are read, or say what the mesh says anyway.
_KEPT_ATTRIBUTES = ("points", "faceVertexCounts", "faceVertexIndices", "holeIndices", "orientation", "normals", "extent", "visibility",
                    "purpose", "doubleSided", "subdivisionScheme", "interpolateBoundary", "faceVaryingLinearInterpolation",
                    "triangleSubdivisionRule", "xformOpOrder", "velocities", "accelerations")
_KEPT_SPACES = ("primvars:", "xformOp:", "skel:")


class Extent:
    """The box around all positions, and the point that they count from."""

    def __init__(self) -> None:
        self._least, self._most = np.full(3, np.inf), np.full(3, -np.inf)
        self.origin = np.zeros(3)

    def add(self, positions: np.ndarray) -> None:
        self._least, self._most = np.minimum(self._least, positions.min(axis=0)), np.maximum(self._most, positions.max(axis=0))

    def move_origin(self) -> None:
        """To a point amid the box where it is small and far from zero, as the encoder has it for arrays (PositionBox)."""
        size = np.linalg.norm(self._most - self._least)
        if size > 0 and max(np.abs(self._least).max(), np.abs(self._most).max()) > 800 * size:
            step = 2.0 ** np.ceil(np.log2(size))
            self.origin = np.round((self._least + self._most) / 2 / step) * step


class MeshReader:
    """Reads a mesh at all time codes: faces and what else rests at once, positions when the encoder wants them."""

    def __init__(self, place: _Place, codes: List[float], left_out: Dict[str, int], extent: Extent):
        self._place, self._mesh, self._prim, self._codes, self._left_out = place, place.mesh, place.prim, codes, left_out
        self._extent, self._cache = extent, UsdGeom.XformCache()
        self.path = place.path
        scheme = self._mesh.GetSubdivisionSchemeAttr().Get()
        if scheme != UsdGeom.Tokens.none:
            kind = f"subdivision ({scheme}) of a mesh"
            left_out[kind] = left_out.get(kind, 0) + 1
        for attribute in self._prim.GetAuthoredAttributes():
            name = attribute.GetName()
            if name not in _KEPT_ATTRIBUTES and not name.startswith(_KEPT_SPACES):
                left_out[f"'{name}' of meshes"] = 0

    def read(self, keep_changes: bool) -> List[SourceMesh]:
        """The mesh, or several where its faces change; none where it is never there."""
        runs: List[Dict[str, Any]] = []
        for frame, code in enumerate(self._codes):
            matrix = self._matrix(code)
            points = None if matrix is None else self._points(code)
            if points is None or not len(points):
                continue
            faces = self._faces(code)
            if len(faces[1]) and not 0 <= faces[1].min() <= faces[1].max() < len(points):
                raise InputError(f"{self._prim.GetPath()}: a face has a vertex that is not of the {len(points)} points at time code {code:g}")
            positions = _world(points, matrix)
            if not (np.abs(positions) <= np.finfo(np.float32).max).all():
                raise InputError(f"{self._prim.GetPath()}: a point is not finite at time code {code:g}")
            self._extent.add(positions)
            same = [run for run in runs[-2:] if run["vertices"] == len(positions) and
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
                run = {"faces": faces, "mirrored": mirrored, "vertices": len(positions), "frames": []}
                runs.append(run)
            run["frames"].append(frame)
        return [self._source(run) for run in runs]

    def _matrix(self, code: float) -> Optional[np.ndarray]:
        self._cache.SetTime(code)
        return self._place.matrix(self._cache, code)

    def _positions(self, code: float) -> np.ndarray:
        return (_world(self._points(code), self._matrix(code)) - self._extent.origin).astype(np.float32)

    def _points(self, code: float) -> Any:
        # Velocities say how points move from the last sample on; the samples of both stay as they are.
        if self._mesh.GetVelocitiesAttr().HasAuthoredValue():
            return self._mesh.ComputePointsAtTime(code, code)
        return self._mesh.GetPointsAttr().Get(code)

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
        mesh = SourceMesh(lambda frame: self._positions(self._codes[frames[frame]]), (offsets, corners[self._order]),
                          name=self._place.name, vertex_count=run["vertices"], runs=_arrays.runs(frames, len(self._codes)),
                          uv={}, colours={}, normals={}, custom={},
                          materials=self._materials(len(counts), self._codes[frames[0]]),
                          parts=self._parts(len(counts), self._codes[frames[0]]))
        codes = [self._codes[frame] for frame in frames]
        for primvar in UsdGeom.PrimvarsAPI(self._prim).FindPrimvarsWithInheritance():
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
        if not np.isfinite(values).all():
            raise InputError(f"{self._prim.GetPath()}: a value of primvar '{name}' is not finite")
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
        width = max(primvar.GetElementSize(), 1)
        if len(values) % width:
            return None
        values = values.reshape(len(values) // width, -1).astype(np.float32)
        counts = run["faces"][0]
        vertices, corners = run["vertices"], counts.sum()
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
        counts = run["faces"][0]
        values = np.array(values if values is not None else [], np.float32).reshape(-1, 3)
        if interpolation == UsdGeom.Tokens.faceVarying and len(values) == counts.sum():
            mesh.normals["normals"] = values[self._order]
        elif interpolation == UsdGeom.Tokens.uniform and len(values) == len(counts):
            mesh.normals["normals"] = np.repeat(values[self._kept], counts[self._kept], axis=0)
        elif not len(values) and self._mesh.GetSubdivisionSchemeAttr().Get() == UsdGeom.Tokens.none:
            # A polygonal mesh without normals is faceted, says UsdGeomMesh.
            mesh.shared_normals = np.repeat(np.arange(self._kept.sum()), counts[self._kept])
        # Normals of vertices follow from positions.

    def _members(self, subset: UsdGeom.Subset, polygons: int, code: float) -> np.ndarray:
        members = np.array(subset.GetIndicesAttr().Get(code) or [], np.int64)
        if len(members) and (members.min() < 0 or members.max() >= polygons):
            raise InputError(f"{subset.GetPrim().GetPath()}: a face is not of {polygons}")
        return members

    def _materials(self, polygons: int, code: float) -> Optional[Tuple[List[str], np.ndarray, List[Optional[Material]]]]:
        """Names, the number of each face that is kept, and looks."""
        numbers = np.full(polygons, -1)
        found: Dict[Usd.Prim, Optional[Material]] = {}  # a material, or a subset without one

        def number_of(material: UsdShade.Material, other: Optional[Usd.Prim] = None) -> int:
            prim = material.GetPrim() if material else other
            if prim not in found:
                sides = bool(self._mesh.GetDoubleSidedAttr().Get())
                found[prim] = read_look(material, sides, self._leave_out) if material else None
            return list(found).index(prim)

        whole = UsdShade.MaterialBindingAPI(self._prim).ComputeBoundMaterial()[0]
        if whole:
            numbers[:] = number_of(whole)
        for subset in UsdGeom.Subset.GetGeomSubsets(self._mesh, UsdGeom.Tokens.face, MATERIALS):
            bound = UsdShade.MaterialBindingAPI(subset.GetPrim()).ComputeBoundMaterial()[0]
            numbers[self._members(subset, polygons, code)] = number_of(bound, subset.GetPrim())
        if self._mesh.GetDoubleSidedAttr().Get() and not any(found.values()):
            self._left_out["'doubleSided' of meshes without materials"] = 0
        names: List[str] = []
        for prim in found:  # those of one name are apart
            name = prim.GetName()
            names.append(name if name not in names else f"{name}_{len(names)}")
        return (names, numbers[self._kept], list(found.values())) if names else None

    def _parts(self, polygons: int, code: float) -> Optional[Tuple[List[str], np.ndarray]]:
        names: List[str] = []
        numbers = np.full(polygons, -1)
        for subset in UsdGeom.Subset.GetAllGeomSubsets(self._mesh):
            family, element = subset.GetFamilyNameAttr().Get() or "", subset.GetElementTypeAttr().Get()
            if (family, element) == (PARTS, UsdGeom.Tokens.face):
                numbers[self._members(subset, polygons, code)] = len(names)
                names.append(subset.GetPrim().GetName())
            elif (family, element) != (MATERIALS, UsdGeom.Tokens.face):
                self._left_out[f"GeomSubsets of {element}s, family '{family}'"] = 0
        return (names, numbers[self._kept]) if names else None

    def _leave_out(self, what: str) -> None:
        self._left_out[what] = 0


def _world(points: Any, matrix: np.ndarray) -> np.ndarray:
    """Points in world space, in double."""
    local = np.array(points, np.float64).reshape(-1, 3)
    if not matrix[:3, :3].any():  # a scale of 0 hides them, for which skins are baked to no numbers
        local = np.zeros_like(local)
    with np.errstate(invalid="ignore", over="ignore"):
        return local @ matrix[:3, :3] + matrix[3, :3]
