# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Arrays of callers, brought into the form that the extension module takes."""
from __future__ import annotations

from typing import Any, List, Optional, Sequence, Tuple

import numpy as np

from .errors import InputError, LimitError


def numbers(values: Any, name: str) -> np.ndarray:
    """Values as an array of real numbers in this machine's byte order: float32, or float64 where they are that."""
    array = np.asarray(values)
    if array.dtype.kind not in "fiu":
        raise InputError(f"{name} must be numbers, not {array.dtype}")
    if array.dtype == np.float64 or array.dtype == np.float32:
        return array if array.dtype.isnative else array.astype(array.dtype.newbyteorder("="))
    return array.astype(np.float32)


def floats(values: Any, name: str) -> np.ndarray:
    """Values as a contiguous array of float32."""
    return np.ascontiguousarray(numbers(values, name), dtype=np.float32)


def frames(values: Any, name: str = "positions") -> np.ndarray:
    """Frames x vertices x 3, with x, y and z side by side."""
    array = numbers(values, name)
    if array.ndim != 3 or array.shape[2] != 3:
        raise InputError(f"{name} must be frames x vertices x 3, not {shape_text(array)}")
    if array.shape[0] == 0:
        raise InputError("the sequence has no frame")
    if array.shape[1] == 0:
        raise InputError("the mesh has no vertex")
    size = array.dtype.itemsize
    if array.strides[2] != size or array.strides[1] % size or array.strides[0] % size:
        array = np.ascontiguousarray(array)
    return array


def runs(shown: Sequence[int], count: int) -> List[Tuple[int, int]]:
    """First and count of each run of the frames that show a mesh, of `count`; none where all do."""
    if len(shown) == count:
        return []
    breaks = np.flatnonzero(np.diff(shown) > 1) + 1
    return [(int(part[0]), len(part)) for part in np.split(np.array(shown), breaks)]


def shape_text(array: np.ndarray) -> str:
    """ "4 x 3" """
    return " x ".join(str(n) for n in array.shape) or "a number"


def indices(values: Any, name: str) -> np.ndarray:
    """Values as a contiguous array of uint32, which they must be without loss."""
    array = np.asarray(values)
    if array.size == 0:
        return np.zeros(array.shape, np.uint32)
    if array.dtype.kind not in "iu":
        raise InputError(f"{name} must be integers, not {array.dtype}")
    low, high = int(array.min()), int(array.max())
    if low < 0 or high >= 2**32:
        raise InputError(f"{name}: {low if low < 0 else high} is out of range")
    return np.ascontiguousarray(array, dtype=np.uint32)


def check_size(values: Any, name: str, max_bytes: int) -> None:
    """Raises LimitError for an array that takes more than max_bytes as 32-bit numbers; 0: any may. A broadcast one,
    which takes nothing yet, would be converted to all that it shows."""
    if max_bytes > 0 and isinstance(values, np.ndarray) and 4 * values.size > max_bytes:
        raise LimitError(f"{name} take {4 * values.size} bytes of at most {max_bytes}")


def polygons(faces: Any) -> Tuple[np.ndarray, np.ndarray]:
    """Offsets and corners of faces: an array polygons x corners, a pair (offsets, corners), a list of polygons of any
    length, or None."""
    if faces is None:
        return np.zeros(1, np.uint32), np.zeros(0, np.uint32)
    if isinstance(faces, tuple) and len(faces) == 2 and all(np.ndim(part) == 1 for part in faces) \
            and len(faces[0]) > 0 and faces[0][0] == 0:
        offsets, corners = indices(faces[0], "offsets"), indices(faces[1], "faces")
        if offsets[-1] != len(corners):
            raise InputError("the polygon offsets do not fit the corners")
        return offsets, corners
    if not isinstance(faces, np.ndarray):
        faces = list(faces)
        lengths = [len(face) for face in faces]
        if len(set(lengths)) > 1:
            corners = indices([corner for face in faces for corner in face], "faces")
            return np.concatenate([[0], np.cumsum(lengths)]).astype(np.uint32), corners
        faces = np.asarray(faces) if faces else np.zeros((0, 3), np.uint32)
    if faces.ndim != 2:
        raise InputError(f"faces must be polygons x corners, not {shape_text(faces)}")
    if faces.shape[0] >= 2**31 or faces.shape[0] * faces.shape[1] >= 2**32:
        raise InputError("there are too many corners")
    offsets = np.arange(faces.shape[0] + 1, dtype=np.uint64) * faces.shape[1]
    return offsets.astype(np.uint32), indices(faces, "faces").ravel()


def output(out: Optional[np.ndarray], shape: Tuple[int, ...]) -> np.ndarray:
    """An array of float32 to be filled: a new one, or that of the caller if it fits."""
    if out is None:
        return np.empty(shape, np.float32)
    if not isinstance(out, np.ndarray):
        raise TypeError(f"out must be an array of numpy, not {type(out).__name__}")
    if out.shape != shape or out.dtype != np.float32 or not out.dtype.isnative:
        raise InputError(f"out must be float32, {' x '.join(map(str, shape))}, not {out.dtype}, {shape_text(out)}")
    if not out.flags.c_contiguous or not out.flags.writeable:
        raise InputError("out must be contiguous and writeable")
    return out
