# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""A beam that swings, in the forms that simulations are stored in. Needs the vtk wheel."""
import json

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase

STEPS = 6


def put(attributes, name, values):
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    attributes.AddArray(array)


def points_of(data):
    return vtk_to_numpy(data.GetPoints().GetData())


def swing(points, step):
    """Displacement of points at a step."""
    moves = np.zeros_like(points)
    moves[:, 2] = np.sin(0.4 * step) * points[:, 0] ** 2 / 40
    return moves


def beam(step, blocks=(8, 2, 2), moved=True, kind=vtk.VTK_HEXAHEDRON):
    """Volume cells, with fields of points and of cells."""
    source = vtk.vtkCellTypeSource()
    source.SetCellType(kind)
    source.SetBlocksDimensions(*blocks)
    source.SetOutputPrecision(1)
    source.Update()
    grid = vtk.vtkUnstructuredGrid()
    grid.CopyStructure(source.GetOutput())
    points = points_of(grid).astype(np.float64)
    moves = swing(points, step)
    if moved:
        place(grid, points + moves)
    put(grid.GetPointData(), "displacement", moves)
    put(grid.GetPointData(), "heat", np.exp(-(points[:, 0] - step) ** 2 / 4))
    put(grid.GetPointData(), "stress", np.stack([moves[:, 2] * k for k in range(6)], axis=1))
    cells = np.arange(grid.GetNumberOfCells())
    put(grid.GetCellData(), "phase", ((cells + step) % 7).astype(np.int32))
    put(grid.GetCellData(), "material", (cells % 3).astype(np.int32))
    return grid


def place(data, positions):
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(positions), deep=True))
    data.SetPoints(points)


def write(data, path):
    """One step, by the writer of its kind."""
    legacy = path.suffix == ".vtk"
    writer = vtk.vtkDataSetWriter() if legacy else vtk.vtkXMLMultiBlockDataWriter() if path.suffix == ".vtm" else \
        vtk.vtkXMLDataSetWriter()
    writer.SetFileName(str(path))
    writer.SetInputDataObject(data)
    assert writer.Write() == 1
    return path


class Series(VTKPythonAlgorithmBase):
    """A source of VTK with steps at 0, 0.5 ... seconds."""

    def __init__(self, steps, kind="vtkUnstructuredGrid"):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType=kind)
        self._steps = steps

    def RequestInformation(self, request, inputs, outputs):
        information, keys = outputs.GetInformationObject(0), vtk.vtkStreamingDemandDrivenPipeline
        times = [0.5 * number for number in range(len(self._steps))]
        information.Set(keys.TIME_STEPS(), times, len(times))
        information.Set(keys.TIME_RANGE(), [times[0], times[-1]], 2)
        return 1

    def RequestData(self, request, inputs, outputs):
        information, keys = outputs.GetInformationObject(0), vtk.vtkStreamingDemandDrivenPipeline
        moment = information.Get(keys.UPDATE_TIME_STEP()) if information.Has(keys.UPDATE_TIME_STEP()) else 0
        data = self.GetOutputDataObject(0)
        data.ShallowCopy(self._steps[round(moment / 0.5)])
        data.GetInformation().Set(vtk.vtkDataObject.DATA_TIME_STEP(), moment)
        return 1


def collection(**blocks):
    """Data sets with names."""
    found = vtk.vtkPartitionedDataSetCollection()
    for number, (name, data) in enumerate(blocks.items()):
        found.SetPartition(number, 0, data)
        found.GetMetaData(number).Set(vtk.vtkCompositeDataSet.NAME(), name)
    return found


def write_series(steps, path):
    """All steps in one file that has times, or in files that it names."""
    if path.suffix == ".pvd":
        names = [write(data, path.with_name(f"{path.stem}_{number}.vtu")).name for number, data in enumerate(steps)]
        entries = "".join(f'<DataSet timestep="{0.5 * number}" file="{name}"/>' for number, name in enumerate(names))
        path.write_text(f'<VTKFile type="Collection"><Collection>{entries}</Collection></VTKFile>')
    elif path.suffix == ".series":
        names = [write(data, path.with_name(f"{path.name[:-11]}_{number}.vtk")).name for number, data in enumerate(steps)]
        path.write_text(json.dumps({"file-series-version": "1.0", "files": [
            {"name": name, "time": 0.5 * number} for number, name in enumerate(names)]}))
    elif path.suffix == ".case":
        write_ensight(steps, path)
    else:
        writer = {".vtkhdf": vtk.vtkHDFWriter, ".xdmf": vtk.vtkXdmfWriter, ".e": vtk.vtkIOSSWriter}[path.suffix]()
        writer.SetFileName(str(path))
        source = Series([collection(beam=data) for data in steps], "vtkPartitionedDataSetCollection") if path.suffix == ".e" else Series(steps)
        writer.SetInputConnection(source.GetOutputPort())  # which the writer does not keep
        if path.suffix != ".e":
            writer.SetWriteAllTimeSteps(1)
        writer.Write()
    return path


def write_ensight(steps, path):
    """EnSight Gold as text, of hexahedra whose points move."""
    stem = path.with_suffix("")
    times = " ".join(str(0.5 * number) for number in range(len(steps)))
    path.write_text(f"FORMAT\ntype: ensight gold\nGEOMETRY\nmodel: 1 {stem.name}.geo**\nVARIABLE\n"
                    f"scalar per node: 1 heat {stem.name}.heat**\nTIME\ntime set: 1\nnumber of steps: {len(steps)}\n"
                    f"filename start number: 0\nfilename increment: 1\ntime values: {times}\n")
    for number, data in enumerate(steps):
        points = points_of(data)
        cells = vtk_to_numpy(data.GetCells().GetConnectivityArray()).reshape(-1, 8) + 1
        head = "a beam\nof hexahedra\nnode id off\nelement id off\npart\n         1\nbeam\ncoordinates\n"
        rows = "".join(f"{value:12.5e}\n" for value in points.T.ravel())
        corners = "".join("".join(f"{corner:10d}" for corner in cell) + "\n" for cell in cells)
        path.with_name(f"{stem.name}.geo{number:02d}").write_text(
            f"{head}{len(points):10d}\n{rows}hexa8\n{len(cells):10d}\n{corners}")
        heat = "".join(f"{value:12.5e}\n" for value in vtk_to_numpy(data.GetPointData().GetArray("heat")))
        path.with_name(f"{stem.name}.heat{number:02d}").write_text(f"heat\npart\n         1\ncoordinates\n{heat}")
