# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Frames as vtkPolyData, with the modules of VTK that its wheel, ParaView and Debian's package have."""
from __future__ import annotations

from typing import Any, Dict, Optional

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkDataArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

from ._steps import fields_of, positions_at, values_at
from .clip import Mesh


class PolyBuilder:
    """Makes the frames of a mesh; they share cells, and fields that rest."""

    def __init__(self, mesh: Mesh):
        self._mesh = mesh
        self._fields, self.left_out = fields_of(mesh)
        self._resting: Dict[int, Any] = {}
        offsets, corners = mesh.polygons
        self._cells = vtkCellArray()
        if len(offsets) > 1:
            self._cells.SetData(numpy_to_vtkIdTypeArray(offsets.astype(np.int64), deep=True),
                                numpy_to_vtkIdTypeArray(corners.astype(np.int64), deep=True))
        self._points_alone: Optional[Any] = None
        if len(offsets) == 1:
            self._points_alone = vtkCellArray()
            count = mesh.vertex_count
            self._points_alone.SetData(numpy_to_vtkIdTypeArray(np.arange(count + 1, dtype=np.int64), deep=True),
                                       numpy_to_vtkIdTypeArray(np.arange(count, dtype=np.int64), deep=True))

    def build(self, frame: int, only: Any = None) -> vtkPolyData:
        """A frame in which the mesh is shown. only: a function of a field's name and domain that says whether it is wanted."""
        data = vtkPolyData()
        points = vtkPoints()
        points.SetData(numpy_to_vtk(positions_at(self._mesh, frame), deep=True))
        data.SetPoints(points)
        if self._points_alone is not None:
            data.SetVerts(self._points_alone)
        else:
            data.SetPolys(self._cells)
        for field in self._fields:
            if only is not None and not only(field.name, field.of_cells):
                continue
            array = self._resting.get(field.number)
            if array is None:
                array = numpy_to_vtk(np.ascontiguousarray(values_at(self._mesh, field, frame)), deep=True)
                array.SetName(field.name)
                if field.unit:
                    array.GetInformation().Set(vtkDataArray.UNITS_LABEL(), field.unit)
                if not field.moves:
                    self._resting[field.number] = array
            (data.GetCellData() if field.of_cells else data.GetPointData()).AddArray(array)
        return data
