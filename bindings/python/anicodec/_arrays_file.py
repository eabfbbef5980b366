# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Clips in files of numpy: .npy of positions, .npz of positions, faces and fields."""
from __future__ import annotations

import os
import zipfile
from typing import Any, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from . import _arrays, encoder
from ._clock import set_clock
from ._steps import clip_of, fields_of, left_out_text, positions_at, times_of, values_at
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
    notes: List[str] = []
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
        if "times" in arrays:
            times = arrays["times"].ravel().tolist()
            notes += set_clock([f"{path}: frame {frame}" for frame in range(len(times))], times, options.get("fps"), options)
        elif "fps" in arrays and options.get("fps") is None:
            options["fps"] = float(arrays["fps"].ravel()[0])
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


def decode(clip: Any, path: str) -> List[str]:
    """Writes a clip (or what open() takes) of one mesh as .npz: positions, offsets and faces, times in seconds, and its fields; notes of
    what has no place. Frames go into the file one by one. Raises InputError and OSError."""
    source = clip_of(clip)
    if len(source.meshes) != 1 or not all(map(source.meshes[0].shown_in, range(len(source)))):
        raise InputError(f"{path}: .npz holds one mesh that is there in all frames; .vtkhdf holds others")
    mesh = source.meshes[0]
    frames = range(len(source))
    offsets, corners = mesh.polygons
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        _store(archive, "positions", len(source), (positions_at(mesh, frame) for frame in frames))
        sizes = np.diff(offsets)
        if len(sizes) and (sizes == sizes[0]).all():
            _store(archive, "faces", None, [corners.reshape(len(sizes), -1).astype(np.int64)])
        elif len(sizes):
            _store(archive, "faces", None, [corners.astype(np.int64)])
            _store(archive, "offsets", None, [offsets.astype(np.int64)])
        _store(archive, "times", None, [np.array(times_of(source))])
        taken = [*_POSITIONS, *_FACES, *_OTHERS]
        for field in fields_of(mesh)[0]:
            name = field.name.replace("/", "_")
            while name in taken:
                name += "_"
            taken.append(name)
            if field.moves:
                _store(archive, name, len(source), (values_at(mesh, field, frame) for frame in frames))
            else:
                _store(archive, name, None, [values_at(mesh, field, 0)])
    return left_out_text(source)


def _store(archive: zipfile.ZipFile, name: str, count: Optional[int], arrays: Iterable[np.ndarray]) -> None:
    """Equal arrays as one of `count`, or one alone, as a member of an .npz file."""
    with archive.open(name + ".npy", "w", force_zip64=True) as member:
        for number, array in enumerate(arrays):
            array = np.ascontiguousarray(array)
            if number == 0:
                shape: Tuple[int, ...] = array.shape if count is None else (count, *array.shape)
                about = {"descr": np.lib.format.dtype_to_descr(array.dtype), "fortran_order": False, "shape": shape}
                np.lib.format.write_array_header_1_0(member, about)
            member.write(array.tobytes())
