# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Outer surfaces of data sets of VTK: which points and cells they take, so that all steps of a series give the same ones."""
from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any, Dict, List, Tuple

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import (vtkCompositeDataSet, vtkDataSet, vtkDataSetAttributes, vtkImageData, vtkMultiBlockDataSet,
                                           vtkMultiPieceDataSet, vtkPartitionedDataSet, vtkPartitionedDataSetCollection, vtkPointSet,
                                           vtkPolyData, vtkRectilinearGrid, vtkUnstructuredGrid)
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter

from .errors import InputError


@dataclass
class Surface:
    """Polygons of a data set."""

    points: np.ndarray  #: numbers of the points in the data set that are vertices, ascending
    offsets: np.ndarray  #: polygons + 1
    corners: np.ndarray  #: vertices of the polygons
    cells: np.ndarray  #: for each polygon, the cell of the data set that it is of
    placed: np.ndarray  #: positions of all points, of a data set that has them by rule
    left_out: Dict[str, int] = field(default_factory=dict)  #: what has no place in it


def leaves(name: str, data: Any) -> List[Tuple[str, Any]]:
    """The data sets with points in data, by their names. Raises InputError."""
    if isinstance(data, vtkDataSet):
        return [(name, data)] if data.GetNumberOfPoints() else []
    if isinstance(data, (vtkMultiBlockDataSet, vtkMultiPieceDataSet, vtkPartitionedDataSetCollection, vtkPartitionedDataSet)):
        found = []
        collection = isinstance(data, vtkPartitionedDataSetCollection)
        count = data.GetNumberOfBlocks() if isinstance(data, vtkMultiBlockDataSet) else \
            data.GetNumberOfPieces() if isinstance(data, vtkMultiPieceDataSet) else \
            data.GetNumberOfPartitionedDataSets() if collection else data.GetNumberOfPartitions()
        for number in range(count):
            block = data.GetBlock(number) if isinstance(data, vtkMultiBlockDataSet) else \
                data.GetPieceAsDataObject(number) if isinstance(data, vtkMultiPieceDataSet) else \
                data.GetPartitionedDataSet(number) if collection else data.GetPartitionAsDataObject(number)
            if block is None:
                continue
            about = data.GetMetaData(number) if data.HasMetaData(number) else None
            key = vtkCompositeDataSet.NAME()
            own = about.Get(key) if about is not None and about.Has(key) else ""
            own = own or (_name_in_assembly(data, number) if collection else "")
            own = re.sub(r"\[[0-9]+\]$", "", own)  # with which the reader of XDMF tells grids of equal names in other steps apart
            own = own or (f"part {number}" if count > 1 else "")
            found += leaves("/".join(part for part in (name, own) if part), block)
        return found
    raise InputError(f"{data.GetClassName()} is not read" + (f" ({name})" if name else ""))


def _name_in_assembly(data: Any, number: int) -> str:
    """The name of a part of a collection, which some readers give to its place in the assembly alone."""
    assembly = data.GetDataAssembly()
    for node in assembly.GetChildNodes(assembly.GetRootNode()) if assembly is not None else ():
        if number in assembly.GetDataSetIndices(node, True):
            return assembly.GetNodeName(node)
    return ""


def signature(data: Any) -> List[Any]:
    """Numbers and arrays that are equal where the surface takes the same points."""
    found: List[Any] = [data.GetClassName(), data.GetNumberOfPoints(), data.GetNumberOfCells()]
    arrays: List[Any] = []
    if isinstance(data, vtkUnstructuredGrid):
        arrays += [cell_types(data), *_parts(data.GetCells()), *_parts(data.GetPolyhedronFaces()), *_parts(data.GetPolyhedronFaceLocations())]
    elif isinstance(data, vtkPolyData):
        for cells in (data.GetVerts(), data.GetLines(), data.GetPolys(), data.GetStrips()):
            arrays += _parts(cells)
    elif isinstance(data, vtkImageData):
        found += [data.GetExtent(), data.GetOrigin(), data.GetSpacing()]
    elif isinstance(data, vtkRectilinearGrid):
        arrays += [data.GetXCoordinates(), data.GetYCoordinates(), data.GetZCoordinates()]
    else:
        found.append(data.GetExtent())
    for attributes in (data.GetPointData(), data.GetCellData()):
        arrays.append(attributes.GetArray(vtkDataSetAttributes.GhostArrayName()))
    return found + [None if array is None else vtk_to_numpy(array).copy() for array in arrays]


def cell_types(data: Any) -> Any:
    """The array of them; which function has it depends on the version of VTK."""
    try:
        return data.GetCellTypes()
    except TypeError:  # before 9.6 it fills an array with the kinds that there are
        return data.GetCellTypesArray()


def _parts(cells: Any) -> List[Any]:
    return [None, None] if cells is None else [cells.GetOffsetsArray(), cells.GetConnectivityArray()]


def equal(one: List[Any], other: List[Any]) -> bool:
    return len(one) == len(other) and all(np.array_equal(a, b) for a, b in zip(one, other))


def points_of(data: Any, surface: Surface) -> np.ndarray:
    """Positions of all points of a data set."""
    if not isinstance(data, vtkPointSet):
        return surface.placed
    return vtk_to_numpy(data.GetPoints().GetData())


def surface_of(data: Any, all_points: bool) -> Surface:
    """The polygons of a data set: its faces, and the outer ones of its volumes."""
    count = data.GetNumberOfPoints()
    left_out: Dict[str, int] = {}
    if isinstance(data, vtkPolyData):
        outer, points, cells = data, np.arange(count), None
    else:
        extract = vtkDataSetSurfaceFilter()
        extract.SetInputData(_numbered(data))
        extract.Update()
        outer = extract.GetOutput()
        points = _numbers(outer.GetPointData().GetArray(_NUMBER))
        cells = _numbers(outer.GetCellData().GetArray(_NUMBER))
    offsets, corners, of_cell = _polygons(outer)
    for kind, number in (("lines", outer.GetNumberOfLines()), ("cells that are vertices", outer.GetNumberOfVerts())):
        if number and not (all_points and kind != "lines"):
            left_out[kind] = number
    corners = points[corners] if len(corners) else corners
    kept = np.arange(count) if all_points else np.unique(corners)
    if len(kept) < count:
        left_out["points that no face has (--all-points keeps them)"] = count - len(kept)
    placed = np.array([]) if isinstance(data, vtkPointSet) else np.array([data.GetPoint(i) for i in range(count)])
    return Surface(kept, offsets, np.searchsorted(kept, corners), of_cell if cells is None else cells[of_cell], placed, left_out)


_NUMBER = "anicodec number"  #: arrays of numbers, as those that the filter itself passes through are wrong where cells are curved


def _numbered(data: Any) -> Any:
    """The data set with no arrays but numbers of its points and cells, and those that hide some."""
    copy = data.NewInstance()
    copy.CopyStructure(data)
    for source, target, count in ((data.GetPointData(), copy.GetPointData(), data.GetNumberOfPoints()),
                                  (data.GetCellData(), copy.GetCellData(), data.GetNumberOfCells())):
        ghosts = source.GetArray(vtkDataSetAttributes.GhostArrayName())
        if ghosts is not None:
            target.AddArray(ghosts)
        numbers = numpy_to_vtkIdTypeArray(np.arange(count, dtype=np.int64), deep=True)
        numbers.SetName(_NUMBER)
        target.AddArray(numbers)
    return copy


def _numbers(array: Any) -> np.ndarray:
    return np.zeros(0, np.int64) if array is None else vtk_to_numpy(array).astype(np.int64)


def _polygons(data: Any) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Offsets, corners, and the number of the cell of each polygon, of polygons and strips of triangles."""
    offsets, corners = (_numbers(array) for array in _parts(data.GetPolys()))
    first = data.GetNumberOfVerts() + data.GetNumberOfLines()
    cells = np.arange(first, first + max(len(offsets) - 1, 0))
    offsets = offsets if len(offsets) else np.zeros(1, np.int64)
    if data.GetNumberOfStrips() == 0:
        return offsets, corners, cells
    starts, strip = (_numbers(array) for array in _parts(data.GetStrips()))
    triangles, owners = [], []
    for number, (begin, end) in enumerate(zip(starts[:-1], starts[1:])):
        for k in range(begin, end - 2):  # every other one is turned over
            triangles.append(strip[[k, k + 1, k + 2] if (k - begin) % 2 == 0 else [k + 1, k, k + 2]])
            owners.append(first + len(cells) + number)
    joined = np.concatenate([corners, *triangles])
    return np.concatenate([offsets, offsets[-1] + 3 * np.arange(1, len(triangles) + 1)]), joined, np.concatenate([cells, owners]).astype(np.int64)
