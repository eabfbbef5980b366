# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""How far apart two clips are."""
from __future__ import annotations

from typing import Any, Dict

from . import _anicodec, _arrays
from .errors import InputError


def compare(original: Any, decoded: Any, faces: Any = None, sted: bool = True) -> Dict[str, float]:
    """Measures of two clips of one connectivity: frames x vertices x 3 each, or a Clip.

    Returns kg (per cent), rmse, max_error, max_frame, max_vertex, diagonal, psnr (dB), displacement_error,
    max_displacement_error, and sted if asked for. Lengths are in scene units.
    """
    a, b = _frames(original), _frames(decoded)
    if a.shape != b.shape:
        raise InputError(f"the clips are {_arrays.shape_text(a)} and {_arrays.shape_text(b)}")
    return _anicodec.compare(a, b, *_arrays.polygons(faces), sted)


def hausdorff(a: Any, a_faces: Any, b: Any, b_faces: Any) -> Dict[str, float]:
    """Mean, RMS and maximum distance between two surfaces, the larger of both directions: vertices x 3 and faces of
    each, in scene units."""
    first, second = (_arrays.floats(points, "positions") for points in (a, b))
    if first.ndim != 2 or second.ndim != 2:
        raise InputError("positions must be vertices x 3")
    return _anicodec.hausdorff(_arrays.floats(_arrays.frames(first[None]), "positions"), *_arrays.polygons(a_faces),
                               _arrays.floats(_arrays.frames(second[None]), "positions"), *_arrays.polygons(b_faces))


def _frames(clip: Any) -> Any:
    return _arrays.floats(_arrays.frames(clip[:] if hasattr(clip, "meshes") else clip), "positions")
