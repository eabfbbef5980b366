# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""VTK: results of simulations to a clip, and back. Needs the extra: pip install 'anicodec[vtk]'."""
from __future__ import annotations

import os
from typing import Any, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np

try:
    import vtkmodules  # noqa: F401
except ImportError as error:
    raise ImportError("results of simulations need the extra of the package: pip install 'anicodec[vtk]'") from error

from ._clock import set_clock
from ._steps import clip_of, left_out_text
from ._vtk_meshes import Choice, MeshReader
from ._vtk_series import Step, steps_of, time_in
from ._vtk_surface import leaves
from ._vtk_write import WRITERS
from .encoder import Encoded, encode_meshes
from .errors import InputError

__all__ = ["decode", "encode"]


def encode(source: Union[str, os.PathLike, Sequence[Any]], *, fields: Union[None, str, Sequence[str]] = None,
           warp: Union[None, str, Tuple[str, float]] = None, all_points: bool = False, fps: Any = None,
           topology_changes: str = "refuse", **options: Any) -> Encoded:
    """Encodes a series of steps that VTK reads.

    source: a path (.pvd, .series, .vtkhdf, .xdmf, .case, .e: with times inside; .vtk, .vtp, .vtu and other files of VTK are one
    step), a pattern such as "run_*.vtu", in natural order, or several paths. Each block is a mesh. Volumes give their outer surface,
    of the same points in all steps; all_points=True keeps points that no face has, too.
    fields: names of those to keep, of points and of cells, "none", or None for all.
    warp: a vector field that is added to the points, as "displacement" or ("displacement", 20) with a scale.
    fps: frames per second, instead of the times of the steps, which are seconds.
    topology_changes: "refuse", or "keep" to store a mesh for each run of steps with equal cells. Other options are those of
    encode(), as field_errors; integers are exact, and units are kept if arrays tell them. `notes` of the result names what else
    the steps have.

    Cost: every step is read once; arrays of all steps lie in files in TMPDIR or /var/tmp.
    Raises InputError naming file, step and reason, and what encode() raises.
    """
    if topology_changes not in ("refuse", "keep"):
        raise InputError(f"topology_changes is 'refuse' or 'keep', not {topology_changes!r}")
    choice = Choice(_field_names(fields), _warp_of(warp), all_points, topology_changes == "keep")
    steps = steps_of(source, at_rest=choice.warp is not None)
    left_out: Dict[str, int] = {}
    readers: Dict[str, MeshReader] = {}
    times: List[Optional[float]] = []
    for frame, step in enumerate(steps):
        data = step.read()
        found = _leaves_of(step, data)
        if not found:
            raise InputError(f"{step.place}: has no point")
        times.append(step.time if step.time is not None else time_in(data[0][1]))
        for name, leaf in found:
            if name not in readers:
                readers[name] = MeshReader(name, choice, left_out)
            readers[name].add(frame, step.place, leaf)
    seen = {name: None for reader in readers.values() for name in reader.seen}
    absent = [name for name in choice.fields or () if name not in seen]
    if absent:
        raise InputError(f"{steps[0].place}: there is no field {absent[0]!r}; there is {', '.join(seen) or 'none'}")
    notes = set_clock([step.place for step in steps], times, fps, options)
    if choice.warp is None and all(reader.rests() for reader in readers.values()) and len(steps) > 1:
        vectors = {name: None for reader in readers.values() for name in reader.vectors}
        notes.append("the points never move; " + (f"--warp (warp=) moves them by a vector field: {', '.join(vectors)}" if vectors else
                                                  "there is no vector field to move them by"))
    meshes = [mesh for reader in readers.values() for mesh in reader.meshes(len(steps))]
    units = {name: unit for reader in readers.values() for name, unit in reader.units.items()}
    if units:
        options["field_units"] = {**units, **(options.get("field_units") or {})}
    first = os.fspath(source) if isinstance(source, (str, os.PathLike)) else os.fspath(source[0])
    options.setdefault("name", os.path.basename(first).split(".")[0].rstrip("*?_-"))
    result = encode_meshes(meshes, frame_count=len(steps), **options)
    if left_out:
        notes.append("not kept: " + ", ".join(f"{count} {kind}" if count else kind for kind, count in left_out.items()))
    result.notes = notes
    return result


def decode(clip: Any, path: Union[str, os.PathLike]) -> List[str]:
    """Writes a clip (or what open() takes) as .pvd (with a folder of .vtp files), .vtkhdf or .xdmf (with an .h5 file); notes of what
    these cannot hold.

    In .vtkhdf and .xdmf polygons and fields that rest are stored once. Positions have the origin of the clip, colours are bytes.
    Raises InputError, OSError, and what open() raises.
    """
    source = clip_of(clip)
    suffix = os.path.splitext(os.fspath(path))[1].lower()
    if suffix not in WRITERS:
        raise InputError(f"{os.fspath(path)}: {', '.join(WRITERS)} can be written")
    WRITERS[suffix](source, os.fspath(path))
    return left_out_text(source)


def _leaves_of(step: Step, data: List[Tuple[str, Any]]) -> List[Tuple[str, Any]]:
    try:
        found = [leaf for name, part in data for leaf in leaves(name, part)]
    except InputError as error:
        raise InputError(f"{step.place}: {error}") from None
    for number, (name, leaf) in enumerate(found):
        if name in [other for other, _ in found[:number]]:
            found[number] = (f"{name or 'part'} {number}", leaf)
    return found


def _field_names(fields: Union[None, str, Sequence[str]]) -> Optional[Sequence[str]]:
    if fields is None:
        return None
    names = fields.split(",") if isinstance(fields, str) else list(fields)
    return [] if names == ["none"] else names


def _warp_of(warp: Union[None, str, Tuple[str, float]]) -> Optional[Tuple[str, float]]:
    if warp is None:
        return None
    name, scale = (warp, 1.0) if isinstance(warp, str) else warp
    if not np.isfinite(scale):
        raise InputError(f"the scale of warp is a number, not {scale!r}")
    return name, float(scale)
