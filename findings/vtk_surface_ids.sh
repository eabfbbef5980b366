#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# vtk 9.7.2 (PyPI): the surface of curved cells.
#
# vtkDataSetSurfaceFilter and vtkGeometryFilter say by vtkOriginalPointIds and vtkOriginalCellIds which points and cells of the input a
# surface has. With quadratic and other curved cells both arrays hold other numbers: cell ids beyond the number of cells, and points
# that lie elsewhere. Arrays that the input has itself pass through right. Nothing says so.
#
# Output seen: "cells 12, largest id 31; numbers passed through 11". Exit status 1 if it is another.
# Way out: give the input an array of numbers.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"${PYTHON:-python3}" -m venv pip >/dev/null
pip/bin/pip install --quiet --disable-pip-version-check vtk==9.7.2 numpy

cat >surface.py <<'P'
import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

source = vtk.vtkCellTypeSource()
source.SetCellType(vtk.VTK_QUADRATIC_HEXAHEDRON)
source.SetBlocksDimensions(3, 2, 2)
source.Update()
grid = source.GetOutput()
numbers = numpy_to_vtk(np.arange(grid.GetNumberOfCells()), deep=True)
numbers.SetName("number")
grid.GetCellData().AddArray(numbers)
surface = vtk.vtkDataSetSurfaceFilter()
surface.SetInputData(grid)
surface.PassThroughCellIdsOn()
surface.Update()
cells = surface.GetOutput().GetCellData()
print("cells {}, largest id {}; numbers passed through {}".format(
    grid.GetNumberOfCells(), vtk_to_numpy(cells.GetArray("vtkOriginalCellIds")).max(), vtk_to_numpy(cells.GetArray("number")).max()))
P
seen=$(pip/bin/python surface.py)
echo "$seen"
[[ $seen == "cells 12, largest id 31; numbers passed through 11" ]]
