# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Clips in files of numpy: .npy of positions, .npz of positions, faces and fields."""
from __future__ import annotations

import os
from typing import Any, Dict, Mapping, Optional, Sequence, Union

import numpy as np

from . import _arrays, encoder
from .errors import InputError

SUFFIXES = (".npy", ".npz")
_POSITIONS = ("positions", "points", "vertices")
_FACES = ("faces", "triangles", "cells")
_OTHERS = ("offsets", "times", "fps")


def _loaded(path: str) -> Any:
    try:
        return np.load(path, mmap_mode="r", allow_pickle=False)
    except (ValueError, EOFError, OSError) as error:
        if isinstance(error, FileNotFoundError):
            raise FileNotFoundError(2, "there is no such file", path) from None
        raise InputError(f"{path}: numpy cannot read it: {error}") from None


def _one_of(names: Sequence[str], arrays: Mapping[str, Any], path: str, needed: bool) -> Optional[str]:
    found = [name for name in names if name in arrays]
    if not found and needed:
        raise InputError(f"{path}: has no array {' or '.join(names)}; there is {', '.join(arrays) or 'none'}")
    return found[0] if found else None


def _field(values: np.ndarray, shape: Sequence[int], polygons: Any) -> np.ndarray:
    """Elements x components, or frames of these, of an array that may leave out components of one number."""
    elements = (shape[1], len(polygons[0]) - 1 if isinstance(polygons, tuple) else 0 if polygons is None else len(polygons))
    alone = values.ndim == 1 or (values.ndim == 2 and values.shape[0] == shape[0] and values.shape[1] in elements)
    return values[..., None] if alone else values


def encode(path: str, faces: Optional[str] = None, *, fields: Union[None, str, Sequence[str]] = None, warp: Any = None,
           all_points: Any = None, topology_changes: Any = None, **options: Any) -> encoder.Encoded:
    """Encodes positions of a .npy file, frames x vertices x 3, with faces of another one, or of an .npz file: positions, faces or
    offsets and faces, times in seconds or fps, and fields, elements x components or frames of these, by their names.

    Raises InputError naming file, frame and reason, and what encode() raises.
    """
    for name, value in (("--warp", warp), ("--all-points", all_points), ("--topology-changes", topology_changes)):
        if value is not None:
            raise InputError(f"{path}: {name} is of inputs that VTK reads")
    custom: Dict[str, Any] = {}
    notes = []
    if path.lower().endswith(".npy"):
        positions, polygons = _loaded(path), None if faces is None else _loaded(faces)
    else:
        with _loaded(path) as stored:
            arrays = {name: stored[name] for name in stored.files}
        named = _one_of(_POSITIONS, arrays, path, True)
        positions = arrays.pop(named)
        named = _one_of(_FACES, arrays, path, False)
        polygons = _loaded(faces) if faces is not None else None if named is None else arrays.pop(named)
        if "offsets" in arrays and polygons is not None:
            polygons = (arrays["offsets"], polygons)
        for name, key in (("times", "times"), ("fps", "fps")):
            if name in arrays and options.get(key) is None and options.get("fps") is None:
                options[key] = arrays[name].ravel()[0] if name == "fps" else arrays[name]
        wanted = None if fields is None else [] if fields == "none" else fields.split(",") if isinstance(fields, str) else fields
        for name, values in arrays.items():
            if name in _OTHERS or (wanted is not None and name not in wanted):
                continue
            custom[name] = _field(values, positions.shape, polygons)
    if positions.ndim != 3 or positions.shape[-1] != 3:
        raise InputError(f"{path}: positions must be frames x vertices x 3, not {_arrays.shape_text(positions)}")
    options.setdefault("name", os.path.splitext(os.path.basename(path))[0])
    if polygons is None:
        notes.append("there are no faces: the clip has points alone")
    result = encoder.encode(positions, polygons, custom=custom, **options)
    result.notes = notes
    return result
