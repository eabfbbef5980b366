# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""A reader of .anic files for ParaView: Tools > Manage Plugins > Load New, and this file. README.md says what it needs."""
from paraview.util.vtkAlgorithm import smdomain, smhint, smproperty, smproxy

try:
    from anicodec._vtk_source import ClipSource
except ImportError as error:
    raise ImportError("ParaView's Python has no package anicodec: bindings/paraview/README.md says how to get it there") from error


@smproxy.reader(name="AnicReader", label="Anic Reader", extensions="anic", file_description="Animated meshes")
class AnicReader(ClipSource):
    """Frames at the times of the clip, with the fields that are chosen."""

    @smproperty.stringvector(name="FileName")
    @smdomain.filelist()
    @smhint.filechooser(extensions="anic", file_description="Animated meshes")
    def SetFileName(self, path):
        super().SetFileName(path)

    @smproperty.doublevector(name="TimestepValues", information_only="1", si_class="vtkSITimeStepsProperty")
    def GetTimestepValues(self):
        return self.times if self.is_open() else []

    @smproperty.dataarrayselection(name="Point Arrays")
    def GetPointArrays(self):
        self.is_open()
        return self.wanted[False]

    @smproperty.dataarrayselection(name="Cell Arrays")
    def GetCellArrays(self):
        self.is_open()
        return self.wanted[True]
