# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Mesh Massage: vertices moved along the surface of their frame, so that a clip codes smaller."""
from __future__ import annotations

from typing import Any

import numpy as np

from . import _anicodec, _arrays


def massage(positions: Any, faces: Any, reference: int = 0, strength: float = 0.5, tolerance: float = 0,
            remove_noise: bool = True) -> np.ndarray:
    """The clip, massaged: frames x vertices x 3, float32.

    reference: frame whose shapes the others follow. strength: of shape against distance, between 0 and 1. tolerance:
    how far a surface may move, scene units; 0: any. remove_noise: takes out what is each frame's alone.
    """
    array = _arrays.floats(_arrays.frames(positions), "positions")
    return _anicodec.massage(array, *_arrays.polygons(faces), reference, float(strength), float(tolerance),
                             remove_noise)
