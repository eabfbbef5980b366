# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Steps of a simulation, in any of the forms that VTK reads them in."""
from __future__ import annotations

import contextlib
import glob
import importlib
import json
import os
import re
import xml.etree.ElementTree as ElementTree
from typing import Any, Callable, Dict, Iterator, List, NamedTuple, Optional, Sequence, Tuple, Union

from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

from .errors import InputError

_KINDS = {"vtp": "PolyData", "vtu": "UnstructuredGrid", "vts": "StructuredGrid", "vtr": "RectilinearGrid", "vti": "ImageData"}
#: The room of VTK and the reader in it, for files of one step and for files that may have several.
_OF_STEP = {
    ".vtk": ("vtkIOLegacy", "vtkGenericDataObjectReader"),
    ".vtm": ("vtkIOXML", "vtkXMLMultiBlockDataReader"),
    **{f".{letters}": ("vtkIOXML", f"vtkXML{kind}Reader") for letters, kind in _KINDS.items()},
    **{f".p{letters}": ("vtkIOXML", f"vtkXMLP{kind}Reader") for letters, kind in _KINDS.items()}}
_OF_STEPS = {
    **dict.fromkeys((".vtkhdf", ".hdf"), ("vtkIOHDF", "vtkHDFReader")),
    **dict.fromkeys((".xdmf", ".xmf"), ("vtkIOXdmf2", "vtkXdmfReader")),
    ".case": ("vtkIOEnSight", "vtkGenericEnSightReader"),
    **dict.fromkeys((".e", ".exo", ".ex2"), ("vtkIOExodus", "vtkExodusIIReader"))}
_TIMES_IN_DATA = ("TimeValue", "TIME")  #: arrays in which programs note the time of a file of one step


class Step(NamedTuple):
    """A moment of a series."""

    place: str  #: the file, and the step in it, for messages
    time: Optional[float]  #: None where only the data may tell
    read: Callable[[], List[Tuple[str, Any]]]  #: names and data objects


def steps_of(source: Union[str, os.PathLike, Sequence[Any]], at_rest: bool) -> List[Step]:
    """The steps of a file, of a pattern, or of several files in their order. at_rest: without displacements that readers add.
    Raises InputError and OSError."""
    paths: List[str] = []
    for text in [source] if isinstance(source, (str, os.PathLike)) else source:
        path = os.fspath(text)
        if any(sign in path for sign in "*?[") and not os.path.exists(path):
            found = sorted(glob.glob(path), key=_natural_key)
            if not found:
                raise InputError(f"{path}: no file has such a name")
            paths += found
        else:
            paths.append(path)
    return [step for path in paths for step in _steps_of_file(path, at_rest)]


def _natural_key(path: str) -> List[Tuple[int, int, str]]:
    """To sort as people count: 9 before 10."""
    return [(0, int(part), "") if part.isdigit() else (1, 0, part) for part in re.split(r"([0-9]+)", path) if part]


def time_in(data: Any) -> Optional[float]:
    """The time that data note."""
    fields = data.GetFieldData()
    for name in _TIMES_IN_DATA:
        array = fields.GetArray(name) if fields else None
        if array is not None and array.GetNumberOfValues() == 1:
            return float(array.GetTuple1(0))
    return None


def _steps_of_file(path: str, at_rest: bool) -> List[Step]:
    if not os.path.isfile(path):
        raise InputError(f"{path}: is a folder; name its steps with a pattern such as '{os.path.join(path, '*.vtu')}'") \
            if os.path.isdir(path) else FileNotFoundError(2, "there is no such file", path)
    suffix = os.path.splitext(path)[1].lower()
    if suffix == ".pvd":
        return _of_pvd(path)
    if suffix == ".series":
        return _of_series(path)
    return _of_reader(path, suffix, at_rest)


def _parsed(path: str, parse: Callable[[str], Any], form: str) -> Any:
    try:
        return parse(path)
    except (ValueError, SyntaxError, UnicodeDecodeError) as error:  # a ParseError is a SyntaxError
        raise InputError(f"{path}: is no {form}: {error}") from None


def _number(text: Any, place: str) -> float:
    try:
        return float(text)
    except (TypeError, ValueError):
        raise InputError(f"{place}: {text!r} is no time") from None


def _of_pvd(path: str) -> List[Step]:
    """Data sets of equal time are parts of a step."""
    root = _parsed(path, lambda name: ElementTree.parse(name).getroot(), "collection of ParaView")
    steps: Dict[str, List[Tuple[str, str]]] = {}
    for entry in root.iter("DataSet"):
        file, moment = entry.get("file"), entry.get("timestep", "0")
        if file is None:
            raise InputError(f"{path}: a DataSet names no file")
        part = entry.get("name") or (f"part {entry.get('part')}" if entry.get("part", "0") != "0" else "")
        steps.setdefault(moment, []).append((part, os.path.join(os.path.dirname(path), file)))
    if not steps:
        raise InputError(f"{path}: names no DataSet")
    return [Step(f"{path}: step {number}", _number(moment, f"{path}: step {number}"), _reads(parts, f"{path}: step {number}"))
            for number, (moment, parts) in enumerate(steps.items())]


def _reads(parts: List[Tuple[str, str]], place: str) -> Callable[[], List[Tuple[str, Any]]]:
    def read() -> List[Tuple[str, Any]]:
        found = []
        for name, file in parts:
            if not os.path.isfile(file):
                raise InputError(f"{place}: there is no file {file}")
            steps = _of_reader(file, os.path.splitext(file)[1].lower(), False)
            found += [(name or inner, data) for inner, data in steps[0].read()]
        return found
    return read


def _of_series(path: str) -> List[Step]:
    def parse(name: str) -> List[Tuple[str, Any]]:
        with open(name, encoding="utf-8") as file:
            found = json.load(file)
        entries = found.get("files") if isinstance(found, dict) else None
        if not isinstance(entries, list) or not entries or not all(isinstance(e, dict) and isinstance(e.get("name"), str) for e in entries):
            raise ValueError("it has no list of files")
        return [(entry["name"], entry.get("time")) for entry in entries]

    steps = []
    for number, (file, moment) in enumerate(_parsed(path, parse, "series of files")):
        place = f"{path}: step {number}"
        steps.append(Step(place, None if moment is None else _number(moment, place),
                          _reads([("", os.path.join(os.path.dirname(path), file))], place)))
    return steps


@contextlib.contextmanager
def _told(place: str) -> Iterator[None]:
    """Raises InputError for what VTK would print as an error."""
    before, window = vtkOutputWindow.GetInstance(), vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(window)
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    try:
        yield
    finally:
        vtkOutputWindow.SetInstance(before)
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_INFO)
    text = window.GetOutput()
    if "ERROR:" in text or "ERR|" in text:
        first = text[text.find("ERR"):].split("\n\n")[0]
        # The first line says which line of VTK it was, the next one names the object.
        told = re.sub(r"^ERR.*\n|^\s*vtk\w+ \(0x\w+\): ", "", first).strip()
        told = re.sub(r"^vtk\w+ \(0x\w+\): ", "", told)
        raise InputError(f"{place}: VTK cannot read it: {' '.join(told.split()) or 'no reason is given'}")


def _reader(path: str, suffix: str, at_rest: bool) -> Any:
    room, name = {**_OF_STEP, **_OF_STEPS}.get(suffix, ("", ""))
    if not room:
        raise InputError(f"{path}: is of unknown kind; .pvd, .series, {', '.join((*_OF_STEP, *_OF_STEPS))} are read")
    reader = getattr(importlib.import_module(f"vtkmodules.{room}"), name)()
    if suffix == ".case":
        reader.SetCaseFileName(path)
        return reader
    reader.SetFileName(path)
    if suffix == ".vtk":
        for everything in ("Scalars", "Vectors", "Tensors", "Normals", "TCoords", "Fields", "ColorScalars"):
            getattr(reader, f"ReadAll{everything}On")()
    elif name == "vtkExodusIIReader":
        reader.SetApplyDisplacements(not at_rest)
        reader.GenerateObjectIdCellArrayOff()
        reader.UpdateInformation()
        for kind in (reader.NODAL, reader.ELEM_BLOCK):
            reader.SetAllArrayStatus(kind, 1)
    return reader


def _of_reader(path: str, suffix: str, at_rest: bool) -> List[Step]:
    """The steps in one file, which is opened for its times where it may have several."""
    if suffix in _OF_STEP:
        return [Step(path, None, lambda: _output(_opened(path, suffix, at_rest), path))]
    reader = _opened(path, suffix, at_rest)
    key = vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    with _told(path):
        reader.UpdateInformation()
    information = reader.GetOutputInformation(0)
    times = list(information.Get(key)) if information is not None and information.Has(key) else []
    if not times:
        return [Step(path, None, lambda: _output(reader, path))]

    def read_at(number: int) -> Callable[[], List[Tuple[str, Any]]]:
        return lambda: _output(reader, f"{path}: step {number}", number, times[number])
    return [Step(f"{path}: step {number}", moment, read_at(number)) for number, moment in enumerate(times)]


def _opened(path: str, suffix: str, at_rest: bool) -> Any:
    with _told(path):
        return _reader(path, suffix, at_rest)


def _output(reader: Any, place: str, number: int = 0, moment: Optional[float] = None) -> List[Tuple[str, Any]]:
    with _told(place):
        if hasattr(reader, "SetStep"):  # of vtkHDFReader, which of collections may give the same step again if asked for another time
            reader.SetStep(number)
        if moment is None or hasattr(reader, "SetStep"):
            reader.Update()
        else:
            reader.UpdateTimeStep(moment)
        data = reader.GetOutputDataObject(0)
    if data is None:
        raise InputError(f"{place}: has no data")
    return [("", data)]
