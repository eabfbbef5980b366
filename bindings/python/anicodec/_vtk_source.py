# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""A file as a source in pipelines of VTK, for PyVista and ParaView: time steps, and fields that can be switched off."""
from __future__ import annotations

from typing import Any, Dict, List, Optional

import numpy as np
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import vtkDataArraySelection, vtkOutputWindow
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkDataObject, vtkMultiBlockDataSet, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

from ._steps import clip_of, fields_of, names_of, times_of
from ._vtk_poly import PolyBuilder
from .errors import AnicodecError


class ClipSource(VTKPythonAlgorithmBase):
    """Frames of a file at the last time that is not after the one asked for: vtkPolyData of one mesh, a vtkMultiBlockDataSet of several."""

    def __init__(self) -> None:
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkDataObject")
        self._path: Optional[str] = None
        self._clip: Any = None
        self._told = False
        self._times: List[float] = []
        self._builders: List[PolyBuilder] = []
        #: fields of points (False) and of cells (True), and which of them are wanted, as far as the file is open
        self.wanted: Dict[bool, Any] = {of_cells: vtkDataArraySelection() for of_cells in (False, True)}
        for selection in self.wanted.values():
            selection.AddObserver("ModifiedEvent", lambda *_: self.Modified())

    def SetFileName(self, path: Optional[str]) -> None:
        """Opens nothing yet."""
        if path != self._path:
            self._path, self._clip, self._told, self._times, self._builders = path, None, False, [], []
            self.Modified()

    def GetFileName(self) -> Optional[str]:
        return self._path

    @property
    def times(self) -> List[float]:
        """Seconds of the steps."""
        self._open()
        return self._times

    def selection(self, of_cells: bool) -> Any:
        """The fields and which of them are wanted."""
        self._open()
        return self.wanted[of_cells]

    def _open(self) -> None:
        if self._clip is not None or not self._path:
            return
        self.SetClip(clip_of(self._path))

    def SetClip(self, clip: Any) -> None:
        """An opened clip instead of a file."""
        self._clip = clip
        self._times = times_of(self._clip)
        self._builders = [PolyBuilder(mesh) for mesh in self._clip.meshes]
        for mesh in self._clip.meshes:
            for field in fields_of(mesh)[0]:
                self.wanted[field.of_cells].AddArray(field.name)

    def is_open(self) -> bool:
        """Opens the file; a fault is one line in the output window of VTK, as pipelines would print all calls that lead to it."""
        try:
            self._open()
        except (AnicodecError, OSError) as error:
            if not self._told:
                vtkOutputWindow.GetInstance().DisplayErrorText(f"{self._path}: {error}\n")
            self._told = True
        return self._clip is not None

    def RequestDataObject(self, request: Any, inputs: Any, outputs: Any) -> int:
        kind = vtkMultiBlockDataSet if self.is_open() and len(self._builders) > 1 else vtkPolyData
        information = outputs.GetInformationObject(0)
        if not isinstance(information.Get(vtkDataObject.DATA_OBJECT()), kind):
            information.Set(vtkDataObject.DATA_OBJECT(), kind())
        return 1

    def RequestInformation(self, request: Any, inputs: Any, outputs: Any) -> int:
        self.is_open()
        information = outputs.GetInformationObject(0)
        information.Remove(vtkStreamingDemandDrivenPipeline.TIME_STEPS())
        for moment in self._times:
            information.Append(vtkStreamingDemandDrivenPipeline.TIME_STEPS(), moment)
        for moment in (self._times[0], self._times[-1]) if self._times else ():
            information.Append(vtkStreamingDemandDrivenPipeline.TIME_RANGE(), moment)
        return 1

    def RequestData(self, request: Any, inputs: Any, outputs: Any) -> int:
        if not self.is_open():
            return 1  # with nothing in it
        information = outputs.GetInformationObject(0)
        key = vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP()
        moment = information.Get(key) if information.Has(key) else self._times[0]
        # Programs hand times over that differ in the last digit.
        frame = max(int(np.searchsorted(self._times, moment + 1e-9 * max(1.0, abs(moment)), side="right")) - 1, 0)
        data = information.Get(vtkDataObject.DATA_OBJECT())
        data.Initialize()
        if isinstance(data, vtkPolyData):
            if self._clip.meshes[0].shown_in(frame):
                data.ShallowCopy(self._built(0, frame))
        else:
            data.SetNumberOfBlocks(len(self._builders))
            for number, name in enumerate(names_of(self._clip)):
                data.SetBlock(number, self._built(number, frame) if self._clip.meshes[number].shown_in(frame) else vtkPolyData())
                data.GetMetaData(number).Set(vtkCompositeDataSet.NAME(), name)
        data.GetInformation().Set(vtkDataObject.DATA_TIME_STEP(), self._times[frame])
        return 1

    def _built(self, number: int, frame: int) -> vtkPolyData:
        return self._builders[number].build(frame, lambda name, of_cells: bool(self.wanted[of_cells].ArrayIsEnabled(name)))

    # Under the names that VTK's own readers have.
    def GetNumberOfPointArrays(self) -> int:
        return self.selection(False).GetNumberOfArrays()

    def GetNumberOfCellArrays(self) -> int:
        return self.selection(True).GetNumberOfArrays()

    def GetPointArrayName(self, number: int) -> str:
        return self.selection(False).GetArrayName(number)

    def GetCellArrayName(self, number: int) -> str:
        return self.selection(True).GetArrayName(number)

    def GetPointArrayStatus(self, name: str) -> int:
        return self.selection(False).ArrayIsEnabled(name)

    def GetCellArrayStatus(self, name: str) -> int:
        return self.selection(True).ArrayIsEnabled(name)

    def SetPointArrayStatus(self, name: str, status: int) -> None:
        self.selection(False).SetArraySetting(name, status)

    def SetCellArrayStatus(self, name: str, status: int) -> None:
        self.selection(True).SetArraySetting(name, status)
