# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Meshes and fields of a series of steps, which are read one by one: arrays of all steps lie in files."""
from __future__ import annotations

import os
import tempfile
from typing import Any, Dict, List, Optional, Sequence, Tuple

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_DOUBLE, VTK_FLOAT, vtkDataArray

from . import _arrays
from ._vtk_surface import Surface, equal, points_of, signature, surface_of
from .encoder import Field, SourceMesh
from .errors import InputError

_MOST_COMPONENTS = 16
_BOOKKEEPING = ("vtkGhostType", "vtkValidPointMask", "vtkOriginalPointIds", "vtkOriginalCellIds")
_LARGEST_INTEGER = 2**24  # that float32 has exactly, as those below it


class _Frames:
    """Equal arrays, one after the other in a file without a name."""

    def __init__(self) -> None:
        self._file = tempfile.TemporaryFile(dir=os.environ.get("TMPDIR") or ("/var/tmp" if os.path.isdir("/var/tmp") else None))
        self._first: Optional[np.ndarray] = None
        self._count = 0
        self.moves = False

    def add(self, values: np.ndarray) -> None:
        if self._first is None:
            self._first = values.copy()
        elif not self.moves and not np.array_equal(values, self._first):
            self.moves = True
        np.ascontiguousarray(values, dtype=self._first.dtype).tofile(self._file)
        self._count += 1

    def shape(self) -> Tuple[int, ...]:
        assert self._first is not None
        return self._first.shape

    def all(self) -> np.ndarray:
        """Frames x elements x components."""
        assert self._first is not None
        self._file.flush()
        if self._first.size == 0:
            return np.zeros((self._count, *self._first.shape), self._first.dtype)
        return np.memmap(self._file, self._first.dtype, "r", shape=(self._count, *self._first.shape))

    def kept(self) -> np.ndarray:
        """The same of what moves; of what does not, the values of the first."""
        assert self._first is not None
        return self.all() if self.moves else self._first


class _Run:
    """Frames of equal faces."""

    def __init__(self, marks: List[Any], surface: Surface):
        self.marks, self.surface = marks, surface
        self.shown: List[int] = []
        self.positions = _Frames()
        self.fields: Dict[Tuple[str, str], _Frames] = {}  #: by domain and name


class Choice:
    """The parts of the data that are taken."""

    def __init__(self, fields: Optional[Sequence[str]], warp: Optional[Tuple[str, float]], all_points: bool, keep_changes: bool):
        self.fields, self.warp, self.all_points, self.keep_changes = fields, warp, all_points, keep_changes


class MeshReader:
    """Reads one data set of each step."""

    def __init__(self, name: str, choice: Choice, left_out: Dict[str, int]):
        self._name, self._choice, self._left_out = name, choice, left_out
        self._runs: List[_Run] = []
        self.vectors: Dict[str, None] = {}  #: fields that may move the points
        self.seen: Dict[str, None] = {}  #: names of all fields
        self.units: Dict[str, str] = {}  #: of fields whose arrays tell them

    def add(self, frame: int, place: str, data: Any) -> None:
        """A step. Raises InputError naming it."""
        what = f"{place}: {self._name}" if self._name else place
        marks = signature(data)
        run = self._runs[-1] if self._runs and equal(self._runs[-1].marks, marks) else None
        if run is None:
            if self._runs and not self._choice.keep_changes:
                before, now = self._runs[-1].marks, marks
                told = f"has {now[1]} points, not {before[1]} as the steps before" if now[1] != before[1] else \
                    f"has {now[2]} cells, not {before[2]} as the steps before" if now[2] != before[2] else "has other cells than the steps before"
                raise InputError(f"{what}: {told}; --topology-changes keep (topology_changes='keep') stores a mesh for each run of equal ones")
            surface = surface_of(data, self._choice.all_points)
            if not len(surface.points):
                raise InputError(f"{what}: no cell has a face; --all-points (all_points=True) keeps its {marks[1]} points")
            run = _Run(marks, surface)
            self._runs.append(run)
            for kind, count in surface.left_out.items():
                self._left_out[kind] = max(self._left_out.get(kind, 0), count)
        run.positions.add(self._positions(what, data, run.surface))
        self._add_fields(what, data, run)
        run.shown.append(frame)

    def _positions(self, what: str, data: Any, surface: Surface) -> np.ndarray:
        points = points_of(data, surface)
        points = points if points.dtype in (np.float32, np.float64) else points.astype(np.float32)
        if self._choice.warp is not None:
            name, scale = self._choice.warp
            array = data.GetPointData().GetArray(name)
            width = array.GetNumberOfComponents() if array is not None else 0
            if width not in (2, 3):
                vectors = ", ".join(_vectors(data)) or "none"
                raise InputError(f"{what}: has no vector field {name!r} of points; there is {vectors}")
            points = points.astype(np.float64)
            points[:, :width] += scale * vtk_to_numpy(array)
        chosen = points[surface.points]
        _check_finite(chosen, what, "the position of point", surface.points)
        return chosen

    def _add_fields(self, what: str, data: Any, run: _Run) -> None:
        here: Dict[Tuple[str, str], np.ndarray] = {}
        for domain, attributes, chosen in (("vertices", data.GetPointData(), run.surface.points), ("polygons", data.GetCellData(), run.surface.cells)):
            for number in range(attributes.GetNumberOfArrays()):
                array, name = attributes.GetAbstractArray(number), attributes.GetArrayName(number) or f"field {number}"
                values = self._values(array, name, attributes.GetNormals() is array)
                if values is not None and len(chosen):
                    _check_finite(values[chosen], what, f"field {name!r} of {'point' if domain == 'vertices' else 'cell'}", chosen)
                    here[domain, name] = values[chosen]
                    if array.GetInformation().Has(vtkDataArray.UNITS_LABEL()):
                        self.units[name] = array.GetInformation().Get(vtkDataArray.UNITS_LABEL())
        self.vectors.update(dict.fromkeys(_vectors(data)))
        if not run.shown:
            run.fields = {key: _Frames() for key in here}
        for domain, name in run.fields.keys() - here.keys():
            raise InputError(f"{what}: the field {name!r} is missing, which steps before have; --fields (fields=) chooses others")
        for domain, name in here.keys() - run.fields.keys():
            raise InputError(f"{what}: the field {name!r} is there, which steps before do not have; --fields (fields=) chooses others")
        for key, values in here.items():
            if run.shown and values.shape != run.fields[key].shape():
                raise InputError(f"{what}: the field {key[1]!r} has {values.shape[1]} components, not {run.fields[key].shape()[1]} as before")
            run.fields[key].add(values)

    def _values(self, array: Any, name: str, are_normals: bool) -> Optional[np.ndarray]:
        """Elements x components; None for an array that is not kept."""
        if name in _BOOKKEEPING:
            return None
        self.seen[name] = None
        asked = self._choice.fields is not None
        if (asked and name not in (self._choice.fields or ())) or (are_normals and not asked):  # normals follow from positions
            return None
        width = array.GetNumberOfComponents()
        if not isinstance(array, vtkDataArray) or not 0 < width <= _MOST_COMPONENTS:
            self._left_out[f"field {name!r}" + (f" of {width} components" if width > _MOST_COMPONENTS else " of texts")] = 0
            return None
        values = vtk_to_numpy(array).reshape(array.GetNumberOfTuples(), width)
        if values.dtype.kind in "iub" and values.size and max(abs(int(values.max())), abs(int(values.min()))) > _LARGEST_INTEGER:
            self._left_out[f"field {name!r}, whose integers are larger than 2^24"] = 0
            return None
        return values

    def meshes(self, frame_count: int) -> List[SourceMesh]:
        """A mesh for each run of equal faces."""
        return [self._source(run, frame_count) for run in self._runs]

    def rests(self) -> bool:
        return not any(run.positions.moves for run in self._runs) and len(self._runs) < 2

    def _source(self, run: _Run, frame_count: int) -> SourceMesh:
        mesh = SourceMesh(run.positions.all(), (run.surface.offsets, run.surface.corners), name=self._name,
                          runs=_arrays.runs(run.shown, frame_count), uv={}, colours={}, custom={})
        for (domain, name), frames in run.fields.items():
            values, width = frames.kept(), frames.shape()[1]
            twin = domain == "polygons" and ("vertices", name) in run.fields
            told = f"{name} of cells" if twin else name
            if values.dtype == np.uint8 and width in (3, 4):
                mesh.colours[told] = Field(domain, values.astype(np.float32) / 255)
            else:
                mesh.custom[told] = Field(domain, values)
        return mesh


def _vectors(data: Any) -> List[str]:
    attributes = data.GetPointData()
    arrays = [attributes.GetArray(number) for number in range(attributes.GetNumberOfArrays())]
    return [array.GetName() for array in arrays if array is not None and array.GetNumberOfComponents() == 3
            and array.GetDataType() in (VTK_FLOAT, VTK_DOUBLE) and array.GetName() and attributes.GetNormals() is not array]


def _check_finite(values: np.ndarray, what: str, of: str, numbers: np.ndarray) -> None:
    if values.dtype.kind != "f":
        return
    finite = np.isfinite(values)
    if not finite.all():
        row = int(np.argmin(finite.all(axis=1)))
        bad = values[row][~finite[row]][0]
        hint = "" if "position" in of else "; --fields (fields=) chooses others"
        raise InputError(f"{what}: {of} {numbers[row]} is {'not a number' if np.isnan(bad) else 'infinite'}{hint}")
