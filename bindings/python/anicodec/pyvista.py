# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""PyVista reads .anic files: pyvista.read("clip.anic"), and pyvista.get_reader("clip.anic") for their times and fields.

Needs the extra: pip install 'anicodec[pyvista]'. An entry point makes PyVista import this module by itself.
"""
from __future__ import annotations

from typing import Any, List

import pyvista
from pyvista.core.utilities.reader import BaseReader, PointCellDataSelection, TimeReader

from ._vtk_source import ClipSource
from .clip import Clip

__all__ = ["ClipReader"]


class ClipReader(BaseReader, PointCellDataSelection, TimeReader):
    """Frames as PolyData, or as MultiBlock where the clip has several meshes. Times are seconds on the clock of the source."""

    _class_reader = ClipSource

    def __init__(self, path: Any) -> None:
        """path: of a file, or a Clip."""
        self._given = path if isinstance(path, Clip) else None
        super().__init__("" if self._given is not None else path)

    @property
    def path(self) -> Any:
        return super().path if self._given is None else self._given.name

    @path.setter
    def path(self, path: Any) -> None:
        if self._given is None:
            BaseReader.path.fset(self, path)
        else:
            self.reader.SetClip(self._given)
            self._update_information()

    def _set_defaults(self) -> None:
        self._active: int = 0

    def _update_information(self) -> None:
        self.reader.times  # opens the file here, as what a pipeline of VTK raises is only printed
        super()._update_information()

    @property
    def number_time_points(self) -> int:
        return len(self.reader.times)

    def time_point_value(self, time_point: int) -> float:
        return self.reader.times[time_point]

    @property
    def time_values(self) -> List[float]:
        return list(self.reader.times)

    @property
    def active_time_value(self) -> float:
        return self.reader.times[self._active]

    def set_active_time_point(self, time_point: int) -> None:
        self._active = range(self.number_time_points)[time_point]

    def set_active_time_value(self, time_value: float) -> None:
        if time_value not in self.reader.times:
            raise ValueError(f"there is no time {time_value}; time_values has those of the file")
        self._active = self.reader.times.index(time_value)

    def read(self, **options: Any) -> Any:
        self.reader.UpdateTimeStep(self.active_time_value)
        return super().read(**options)


if ".anic" not in {reader.extension for reader in pyvista.registered_readers()}:
    pyvista.register_reader(".anic", ClipReader)
