# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Encoding a capture while it goes on."""
from __future__ import annotations

import math
import threading
import time
from dataclasses import dataclass
from typing import Any, Dict, Iterator, List, Mapping, Optional, Tuple

import numpy as np

from . import _anicodec, _arrays
from .clip import UP
from .encoder import _Adder, _choices, _metres, _named, _origin, _rate, Moving, SourceMesh
from .errors import InputError, LimitError

_SLICE = 0.1  # seconds of a wait, behind each of which signals are looked at


class LivePiece(bytes):
    """The bytes of a file of a live stream, and what is known of it."""

    first_frame: int  #: of the frames that were pushed
    frame_count: int
    start_time: float  #: of its first frame, seconds
    encode_seconds: float  #: that it took
    max_error: float
    rmse: float
    kg: float  #: per cent
    key: bool  #: it begins anew: whoever has lost a file goes on here
    has_mesh: bool  #: it is no continuation: whoever joins needs the last of these, and then a key


@dataclass(frozen=True)
class LiveInfo:
    """How far a live encoder is."""

    pushed_frames: int
    waiting_frames: int  #: frames of which no file is made yet
    late_frames: int  #: of these, frames of full files that are not begun: 0 while it keeps up, else how far it is behind
    waiting_pieces: int  #: files made, and not taken
    encode_seconds: float  #: that the last file took
    piece_frames: int  #: frames of a file, but for the last
    ended: bool  #: all files are taken


class LiveEncoder:
    """Frames in, files of a live stream out: what `anicodec encode --live` writes. encode_live() makes one.

    A thread of its own encodes. Any threads may call push() and take(). As a context it ends with its body; files that nobody took are
    dropped.
    """

    def __init__(self, live: Any, vertex_count: int, moving: List[Tuple[str, str, Tuple[int, int]]]):
        self._live, self._vertices, self._moving = live, vertex_count, moving
        self._pushing, self._taking = threading.Lock(), threading.Lock()

    def __enter__(self) -> "LiveEncoder":
        return self

    def __exit__(self, *_: Any) -> None:
        self._live = None

    def _open(self) -> Any:
        if self._live is None:
            raise InputError("the live encoder is closed")
        return self._live

    def _values(self, given: Dict[Tuple[str, str], Any]) -> List[np.ndarray]:
        values = []
        for kind, name, shape in self._moving:
            what = f"{kind} {name!r}" if name else kind
            if (kind, name) not in given:
                raise InputError(f"{what} moves: each frame has its values")
            array = _arrays.floats(given.pop((kind, name)), what)
            if array.shape != shape and not (shape[1] == 1 and array.shape == shape[:1]):
                raise InputError(f"{what} must be {shape[0]} x {shape[1]}, not {_arrays.shape_text(array)}")
            values.append(array)
        for kind, name in given:
            raise InputError(f"{kind} {name!r} does not move")
        return values

    def push(self, positions: Any, *, uv: Any = None, colours: Any = None, custom: Optional[Mapping[str, Any]] = None,
             wait: float = 0) -> None:
        """Adds a frame: vertices x 3, and the values of each attribute that moves, as encode_live() was told.

        wait: seconds for room, where most_waiting is given; LimitError where there is none, with nothing taken.
        Raises InputError for what does not fit or is not finite, with nothing taken; what ended the encoding.
        """
        array = _arrays.numbers(positions, "positions")
        if array.shape != (self._vertices, 3):
            raise InputError(f"positions must be {self._vertices} x 3, not {_arrays.shape_text(array)}")
        given = {("uv", name): values for name, values in _named(uv).items()}
        given.update({("colour", name): values for name, values in _named(colours).items()})
        given.update({("custom", name): values for name, values in (custom or {}).items()})
        values = self._values(given)
        end = time.monotonic() + wait
        with self._pushing:
            live = self._open()
            push = live.push_doubles if array.dtype == np.float64 else live.push
            while not push(np.ascontiguousarray(array), values, max(0.0, min(end - time.monotonic(), _SLICE))):
                if time.monotonic() >= end:
                    raise LimitError("as many frames wait as may: the encoder is behind")

    def end(self) -> None:
        """No frame follows: the last file gets those that are there."""
        with self._pushing:
            self._open().end()

    def take(self, wait: float = 0) -> Optional[LivePiece]:
        """The next file once it is made; None where none is in so many seconds, or all are taken.

        Raises what ended the encoding, once all files before are taken.
        """
        end = time.monotonic() + wait
        with self._taking:
            while True:
                live = self._open()
                taken = live.take(max(0.0, min(end - time.monotonic(), _SLICE)))
                if taken is not None:
                    data, facts = taken
                    piece = LivePiece(data)
                    vars(piece).update(facts)
                    return piece
                if time.monotonic() >= end or live.info()["ended"]:
                    return None

    def __iter__(self) -> Iterator[LivePiece]:
        """All files, each as soon as it is made, until end() was called and all are taken."""
        while True:
            piece = self.take(math.inf)
            if piece is None:
                return
            yield piece

    @property
    def info(self) -> LiveInfo:
        return LiveInfo(**self._open().info())


def encode_live(faces: Any = None, *, vertex_count: int, fps: Any, piece: float = 1, key_every: float = 4,
                box: float = 0, most_waiting: int = 0, uv: Any = None, colours: Any = None, normals: Any = None,
                custom: Optional[Mapping[str, Any]] = None, materials: Any = None, parts: Any = None, name: str = "",
                start_time: float = 0, up: Optional[str] = None, unit: Any = None, origin: Any = "none",
                **options: Any) -> LiveEncoder:
    """Begins to encode a capture while it goes on.

    faces, uv, colours, normals, custom, materials, parts: as of encode(), for the first frame; a Moving in place of an array of uv,
        colours or custom is an attribute that moves: each push() has its values.
    piece: seconds of a file. key_every: a file begins anew so many seconds after the last that did; whoever joins late, or has
        lost a file, goes on there; 0: every file does.
    box: the diagonal that errors in per cent are of, scene units; 0: that of the first file's frames, which is smaller than the clip's.
    most_waiting: frames that wait for being encoded at most, at least those of a file; 0: any number, whatever memory they take.
    Other options are those of encode(), without what needs all frames: sizes, key-frames, lossless, massage, root_motion,
        progress. effort="fast" is fast enough for 10,000 vertices at 30 frames a second. origin: "none" or three numbers.

    Raises InputError, TypeError.
    """
    mesh = SourceMesh(None, faces, vertex_count=vertex_count, uv=uv, colours=colours, normals=normals, custom=custom or {},
                      materials=materials, parts=parts)
    choices = _choices(dict(options))
    metres = _metres(unit)
    point = _origin(origin)
    if point is None:
        raise InputError("origin is 'none' or three numbers: a live stream does not have all frames to find it")
    if vertex_count < 1:
        raise InputError("the mesh has no vertex")
    for text, value in (("piece", piece), ("key_every", key_every), ("box", box), ("most_waiting", most_waiting)):
        if not value >= 0 or math.isinf(value) and text != "key_every":
            raise InputError(f"{text} must be finite and not negative, not {value!r}")
    encoder = _anicodec.Encoder()
    numerator, denominator = _rate(fps)
    if up not in UP:
        raise InputError(f"up is 'y', 'z' or None, not {up!r}")
    encoder.add_clip(name, 0, numerator, denominator, UP.index(up), False, start_time, metres,
                     None, [], point)
    adder = _Adder(encoder, 0, mesh, 0, choices.get("max_bytes", 0))
    live = encoder.begin_live(choices, piece, key_every if key_every > 0 else -1, box, most_waiting)
    return LiveEncoder(live, vertex_count, adder.moving)
