# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Compressed animated meshes: encode numpy arrays to .anic files, and play them.

>>> data = anicodec.encode(positions, faces, fps=30)     # positions: frames x vertices x 3
>>> clip = anicodec.open(data)
>>> clip[10]                                             # vertices x 3, float32
"""
from ._anicodec import version as __version__
from ._batch import Result, batch
from .clip import Attribute, Clip, ClipInfo, Mesh, open, read_bounds, read_metadata
from .encoder import Encoded, Field, Moving, SourceClip, SourceMesh, encode, encode_meshes
from .errors import (AbsentError, AnicodecError, Cancelled, CorruptError, FrameError, InputError, InternalError,
                     LimitError, UnsupportedError)
from .live import LiveEncoder, LiveInfo, LivePiece, encode_live
from .material import Material

__all__ = ["AbsentError", "AnicodecError", "Attribute", "Cancelled", "Clip", "ClipInfo", "CorruptError", "Encoded",
           "Field", "FrameError", "InputError", "InternalError", "LimitError", "LiveEncoder", "LiveInfo", "LivePiece", "Material", "Mesh",
           "Moving", "Result", "SourceClip", "SourceMesh", "UnsupportedError", "__version__", "batch", "encode",
           "encode_live", "encode_meshes", "open", "read_bounds", "read_metadata"]
