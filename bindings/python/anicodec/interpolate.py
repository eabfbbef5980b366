# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Meshes between meshes, by multi-scale geometry interpolation."""
from __future__ import annotations

from typing import Any, Sequence

import numpy as np

from . import _anicodec, _arrays
from .errors import InputError


class Morpher:
    """Blends meshes x vertices x 3 of one connectivity; triangles x 3. Immutable, shared by threads."""

    def __init__(self, meshes: Any, triangles: Any, leaf_faces: int = 0, sweeps: int = 0):
        array = _arrays.floats(_arrays.frames(meshes, "meshes"), "meshes")
        corners = _arrays.indices(triangles, "triangles")
        if corners.ndim != 2 or corners.shape[1] != 3:
            raise InputError(f"triangles must be triangles x 3, not {_arrays.shape_text(corners)}")
        self._morpher = _anicodec.Morpher(array, corners, leaf_faces, sweeps)

    def at(self, weights: Sequence[float]) -> np.ndarray:
        """The mesh at weights that sum to one: vertices x 3, float32."""
        return self._morpher.at([float(weight) for weight in weights])


def between(a: Any, b: Any, triangles: Any, count: int) -> np.ndarray:
    """`count` meshes from a to b, both included: count x vertices x 3, float32."""
    if count < 2:
        raise InputError(f"count must be at least 2, not {count}")
    morpher = Morpher(np.stack([_arrays.floats(a, "a"), _arrays.floats(b, "b")]), triangles)
    return np.stack([morpher.at([1 - t, t]) for t in np.linspace(0, 1, count)])
