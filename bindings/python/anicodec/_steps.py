# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Clips as programs for simulations take them: steps with times, positions, and fields of points and of cells."""
from __future__ import annotations

from typing import Any, List, NamedTuple, Tuple

import numpy as np

from .clip import Clip, Mesh, open as open_clip
from .errors import InputError

_OF_CELLS = " of cells"  #: behind the name of a field of cells that a field of points has, too


class StepField(NamedTuple):
    """An attribute as a field."""

    name: str
    of_cells: bool
    number: int  #: of the attribute
    kind: str
    moves: bool
    unit: str


def clip_of(clip: Any) -> Clip:
    """A clip, or what open() takes. Raises InputError where a file has several."""
    source = clip if isinstance(clip, Clip) else open_clip(clip)
    if len(source.clips) > 1:
        raise InputError(f"the file has the clips {', '.join(info.name for info in source.clips)}; choose one (clips=[NAME], --clip NAME)")
    return source


def times_of(clip: Clip) -> List[float]:
    """Seconds of the steps on the clock of the source."""
    return [clip.info["start_time"] + clip.time(frame) for frame in range(len(clip))]


def names_of(clip: Clip) -> List[str]:
    """A name of its own for each mesh."""
    found: List[str] = []
    for number, mesh in enumerate(clip.meshes):
        name = mesh.name or (f"mesh {number}" if len(clip.meshes) > 1 else clip.name or "mesh")
        found.append(name if name not in found else f"{name} {number}")
    return found


def fields_of(mesh: Mesh) -> Tuple[List[StepField], List[str]]:
    """The fields of a mesh, and what of it cannot be one."""
    found: List[StepField] = []
    left_out: List[str] = []
    for number, attribute in enumerate(mesh.attributes):
        name = attribute.name or {"uv": "TCoords", "colour": "RGB"}.get(attribute.kind, attribute.kind)
        if attribute.domain == "corners" or (attribute.kind == "normal" and attribute.values.size == 0):
            left_out.append(f"{attribute.kind} {attribute.name!r} of corners" if attribute.name else f"{attribute.kind} of corners")
            continue
        if attribute.labels:
            left_out.append(f"names of {attribute.kind}s")
        of_cells = attribute.domain == "polygons"
        if of_cells and name.endswith(_OF_CELLS) and any(f.name == name[:-len(_OF_CELLS)] for f in found):
            name = name[:-len(_OF_CELLS)]
        while any(f.name == name and f.of_cells == of_cells for f in found):
            name += "_"
        found.append(StepField(name, of_cells, number, attribute.kind, attribute.moves, attribute.unit))
    return found, left_out


def values_at(mesh: Mesh, field: StepField, frame: int) -> np.ndarray:
    """Elements x components: float32, uint8 of colours, int32 of labels and of whole numbers."""
    attribute = mesh.attributes[field.number]
    if attribute.labels:
        return attribute.values.reshape(-1, 1).astype(np.int32)
    values = mesh.attribute_at(field.number, mesh._clip.time(frame)) if field.moves else attribute.values
    if field.kind == "colour":
        return np.rint(255 * np.clip(values, 0, 1)).astype(np.uint8)
    return np.rint(values).astype(np.int32) if attribute.whole else values


def positions_at(mesh: Mesh, frame: int) -> np.ndarray:
    """Vertices x 3: float32, or float64 where the clip counts them from an origin."""
    origin = np.asarray(mesh._clip.info["origin"])
    return mesh[frame] + origin if origin.any() else mesh[frame]


def shown_frames(mesh: Mesh) -> List[int]:
    return [frame for frame in range(len(mesh)) if mesh.shown_in(frame)]


def left_out_text(clip: Clip) -> List[str]:
    """A note of what has no place among fields."""
    found = list(dict.fromkeys(text for mesh in clip.meshes for text in fields_of(mesh)[1]))
    return ["not kept: " + ", ".join(found)] if found else []
