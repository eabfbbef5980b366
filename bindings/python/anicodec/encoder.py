# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Encoding."""
from __future__ import annotations

import difflib
import inspect
import json
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from . import _anicodec, _arrays
from ._options import CAP_PERCENT, CHOICES, ERROR_PERCENT, FLAGS, GOALS, LOSSLESS, NUMBERS, PERCENT, QUALITIES
from ._words import ATTRIBUTE_KIND, BOUND, DOMAIN
from .clip import UP, chosen
from .errors import InputError
from .material import Material, to_file

_NUMBERS = {**NUMBERS, "threads": "threads", "max_bytes": "max_bytes"}
_SWITCHES = ("quality", "lossless", "attribute_error", "metadata", *FLAGS)
_UNITS = {"m": 1.0, "cm": 0.01, "mm": 0.001, "km": 1000.0, "in": 0.0254, "ft": 0.3048}

Progress = Callable[[str, float], Optional[bool]]
Bound = Union[float, str]  # units of the values, a text "0.1%" of their range, or "exact"


class Encoded(bytes):
    """The bytes of a file, with what was measured of it: `measured["max_error"]`, "rmse", "kg", "diagonal"..."""

    measured: Dict[str, Any]
    notes: Sequence[str] = ()  #: data of the source that importers read and the file does not keep


@dataclass(frozen=True)
class Moving:
    """An attribute of a live stream whose values come with each frame."""

    domain: str  #: "vertices", "corners" or "polygons"
    components: int  #: 2 of uv, 3 or 4 of colours, 1 to 16 of others


@dataclass(frozen=True)
class Field:
    """An attribute and its domain, where numbers of vertices, corners and polygons do not tell it."""

    domain: str  #: "vertices", "corners" or "polygons"
    values: Any  #: elements x components, or frames of these


@dataclass
class SourceMesh:
    """A mesh of encode_meshes()."""

    positions: Any  #: frames x vertices x 3, or a function of a frame that returns vertices x 3; None of encode_live()
    faces: Any = None  #: see encode()
    name: str = ""
    vertex_count: Optional[int] = None  #: with a function alone
    #: vertices x 2 or corners x 2, or frames of these; a mapping of names for several
    uv: Any = None
    colours: Any = None  #: vertices, corners or polygons x 3 or 4, or frames of these; 0 to 1
    normals: Any = None  #: vertices x 3 or corners x 3
    #: in place of normals: a number for each corner, of whose vertex those with the same number share a normal
    shared_normals: Any = None
    custom: Mapping[str, Any] = field(default_factory=dict)  #: other numbers, as colours; any of these may be a Field
    #: names, and for each polygon a number of one or -1; then maybe looks: for each name a Material, or None
    materials: Optional[Tuple[Any, ...]] = None
    parts: Optional[Tuple[Sequence[str], Any]] = None  #: the same of objects
    runs: Sequence[Tuple[int, int]] = ()  #: first and count of the frames that show it; none: all


@dataclass
class SourceClip:
    """A clip of a file with several; what is None is as encode() says."""

    name: str
    frame_count: int
    fps: Any = None
    loop: Optional[bool] = None
    start_time: float = 0
    times: Any = None  #: seconds of its frames, from 0 on; None: evenly by the rate
    events: Sequence[Tuple[str, float]] = ()  #: names and seconds from its first frame on


def _length(value: Any, name: str) -> Tuple[float, bool]:
    """A number of scene units, or a text "0.05%"."""
    percent = isinstance(value, str) and value.strip().endswith("%")
    try:
        return float(value.strip().rstrip("%") if isinstance(value, str) else value), percent
    except (TypeError, ValueError):
        raise InputError(f"{name} must be a number or a text as '0.05%', not {value!r}") from None


def _size(value: Any) -> float:
    """A number of bytes, or a text "40k"."""
    factors = {"k": 1e3, "M": 1e6, "G": 1e9}
    try:
        if isinstance(value, str) and value[-1:] in factors:
            return float(value[:-1]) * factors[value[-1]]
        return float(value)
    except (TypeError, ValueError):
        raise InputError(f"size must be a number of bytes or a text as '40k', not {value!r}") from None


def _number(value: Any, name: str) -> Any:
    if not hasattr(value, "__float__") and not hasattr(value, "__index__"):
        raise TypeError(f"{name} is not a number that fits")
    return value


def _goal(options: Dict[str, Any]) -> Dict[str, Any]:
    """The target among the options, taken out of them."""
    quality = options.pop("quality", None)
    given = {name: value for name in GOALS if (value := options.pop(name, None)) is not None}
    if quality is not None:
        if "sted" in given:
            raise InputError("quality and sted are two targets")
        given["sted"] = chosen(QUALITIES, quality, "quality")
    choices: Dict[str, Any] = {"flags": 0}
    if options.pop("lossless", False):
        if given:
            raise InputError(f"lossless goes without {next(iter(given))}")
        choices["flags"] |= LOSSLESS
    cap = given.pop("max_error", None) if len(given) > 1 else None
    if len(given) > 1:
        raise InputError(f"{' and '.join(given)} are two targets; there is one, and max_error may stand beside it")
    for name, value in given.items():
        number, percent = (_length(value, name) if name in ("max_error", "rmse", "displacement") else
                           (_size(value) if name == "size" else _length(value, name)[0], False))
        if not number > 0 or not np.isfinite(number):
            raise InputError(f"{name} must be greater than 0, not {value!r}")
        choices.update(goal=GOALS[name], goal_value=number)
        choices["flags"] |= PERCENT if percent else 0
    if cap is not None:
        choices["max_error"], percent = _length(cap, "max_error")
        choices["flags"] |= CAP_PERCENT if percent else 0
    return choices


def _choices(options: Dict[str, Any]) -> Dict[str, Any]:
    """Options as the extension module takes them. An unknown option is an error."""
    choices = _goal(options)
    for name, (field, table) in CHOICES.items():
        value = options.pop(name, None)
        if value is not None:
            choices[field] = chosen(table, value, name)
    for name, field in _NUMBERS.items():
        value = options.pop(name, None)
        if value is not None:
            choices[field] = _number(value, name)
    error = options.pop("attribute_error", None)
    if error is not None:
        choices["attribute_error"], percent = _length(error, "attribute_error")
        choices["flags"] |= ERROR_PERCENT if percent else 0
    for name, flag in FLAGS.items():
        choices["flags"] |= flag if options.pop(name, False) else 0
    metadata = options.pop("metadata", None)
    if metadata:
        choices["metadata"] = json.dumps(dict(metadata), ensure_ascii=False, allow_nan=False)
    if options:
        raise TypeError(_no_option(next(iter(options))))
    return choices


def option_names() -> List[str]:
    """The options of encode() and encode_meshes(), by name."""
    return [*GOALS, *CHOICES, *_NUMBERS, *_SWITCHES,
            *(name for function in (encode, encode_meshes) for name in inspect.signature(function).parameters)]


def _no_option(name: str) -> str:
    near = difflib.get_close_matches(name, sorted({*option_names()} - {"options"}), 1)
    return f"encode() has no option {name!r}" + (f"; did you mean {near[0]}?" if near else "")


def _rate(fps: Any) -> Tuple[int, int]:
    if fps is None:
        return 0, 1
    try:
        rate = Fraction(fps).limit_denominator(100000)
    except (TypeError, ValueError, OverflowError, ZeroDivisionError):
        raise InputError(f"fps must be a number or a text as '30000/1001', not {fps!r}") from None
    if rate <= 0:
        raise InputError(f"fps must be greater than 0, not {fps!r}")
    return rate.numerator, rate.denominator


def _named(values: Any) -> Dict[str, Any]:
    if values is None:
        return {}
    return dict(values) if isinstance(values, Mapping) else {"": values}


class _Fields:
    """The attributes that are kept, their bounds and units, by their names."""

    def __init__(self, fields: Optional[Sequence[str]] = None, errors: Optional[Mapping[str, Bound]] = None,
                 units: Optional[Mapping[str, str]] = None):
        if isinstance(fields, str):
            raise InputError(f"fields are names in a list, not {fields!r}")
        self._fields, self._units = fields, dict(units or {})
        self._bounds = {name: self._bound(name, error) for name, error in (errors or {}).items()}

    @staticmethod
    def _bound(name: str, error: Bound) -> Tuple[int, float]:
        if error == "exact":
            return BOUND["exact"], 0.0
        number, percent = _length(error, f"the error of {name}")
        if not number > 0 or not np.isfinite(number):
            raise InputError(f"the error of {name} must be greater than 0, not {error!r}")
        return BOUND["percent" if percent else "units"], number

    def check(self, meshes: Sequence[SourceMesh]) -> None:
        """Refuses a name that no attribute has."""
        custom = {name for mesh in meshes for name in mesh.custom}
        named = custom.union(*(_named(values) for mesh in meshes for values in (mesh.uv, mesh.colours, mesh.normals)))
        for what, names, known in (("fields", self._fields or (), custom), ("field_errors", self._bounds, named),
                                   ("field_units", self._units, named)):
            for name in names:
                if name not in known:
                    there = ", ".join(sorted(known - {""})) or "no name"
                    raise InputError(f"{what}: there is no attribute {name!r}, but {there}")

    def keeps(self, name: str) -> bool:
        return self._fields is None or name in self._fields

    def of(self, name: str, kind: str, values: Any) -> Tuple[int, float, str]:
        """Bound, error and unit of an attribute. Numbers of an integer type are exact as a rule."""
        is_whole = kind == "custom" and getattr(values, "dtype", np.dtype(float)).kind in "biu"
        bound, error = self._bounds.get(name, (BOUND["exact" if is_whole else "usual"], 0.0))
        return bound, error, self._units.get(name, "")


class _Adder:
    """Adds a mesh and its attributes to an encoder."""

    def __init__(self, encoder: Any, number: int, mesh: SourceMesh, frame_count: int, max_bytes: int,
                 fields: Optional[_Fields] = None):
        self._encoder, self._number, self._max_bytes = encoder, number, max_bytes
        self._choice = fields or _Fields()
        self.moving: List[Tuple[str, str, Tuple[int, int]]] = []  #: kind, name and shape of attributes that come with each frame
        self._frames = sum(count for _, count in mesh.runs) if mesh.runs else frame_count
        for part in mesh.faces if isinstance(mesh.faces, tuple) else (mesh.faces,):
            _arrays.check_size(part, "faces", max_bytes)
        self._offsets, self._corners = _arrays.polygons(mesh.faces)
        positions: Any = mesh.positions
        if callable(positions):
            if mesh.vertex_count is None:
                raise InputError("vertex_count is needed where positions are a function")
            vertices = mesh.vertex_count
            source = positions

            def positions(frame: int) -> np.ndarray:
                array = _arrays.floats(source(frame), "positions")
                if array.shape != (vertices, 3):
                    raise InputError(f"frame {frame}: positions must be {vertices} x 3, "
                                     f"not {_arrays.shape_text(array)}")
                return array
        elif frame_count == 0 and mesh.vertex_count is not None:
            vertices = mesh.vertex_count
        else:
            _arrays.check_size(positions, "positions", max_bytes)
            positions = _arrays.frames(positions)
            vertices = positions.shape[1]
            if positions.shape[0] != self._frames:
                raise InputError(f"positions have {positions.shape[0]} frames of {self._frames}")
        self._counts = (vertices, len(self._corners), len(self._offsets) - 1)
        encoder.add_mesh(mesh.name, vertices, self._offsets, self._corners, positions, list(mesh.runs))
        for name, values in _named(mesh.uv).items():
            self._values(name, "uv", values, (2,))
        for name, values in _named(mesh.colours).items():
            self._values(name, "colour", values, (3, 4))
        for name, values in _named(mesh.normals).items():
            self._values(name, "normal", values, (3,))
        for name, values in mesh.custom.items():
            if not self._choice.keeps(name):
                continue
            self._values(name, "custom", values, tuple(range(1, 17)))
        if mesh.shared_normals is not None:
            labels = np.asarray(mesh.shared_normals)
            if labels.shape != (len(self._corners),):
                raise InputError(f"shared_normals must be a number for each of {len(self._corners)} corners, "
                                 f"not {_arrays.shape_text(labels)}")
            encoder.add_attribute(number, "", ATTRIBUTE_KIND["normal"], DOMAIN["corners"], 0, 1, None,
                                  _arrays.indices(labels, "shared_normals"), [], [], 0, 0, "")
        for kind, labels in (("material", mesh.materials), ("part", mesh.parts)):
            if labels is not None:
                self._labels(kind, *labels)

    def _values(self, name: str, kind: str, given: Any, components: Tuple[int, ...]) -> None:
        what = f"{kind} {name!r}" if name else kind
        if isinstance(given, Moving):
            return self._move(name, kind, what, given, components)
        told = given.domain if isinstance(given, Field) else None
        given = given.values if isinstance(given, Field) else given
        _arrays.check_size(given, what, self._max_bytes)
        values = _arrays.floats(given, what)
        moving = values.ndim == 3
        frames = values.shape[0] if moving else 1
        elements = values.shape[1 if moving else 0] if values.ndim in (2, 3) else -1
        if elements not in self._counts or values.shape[-1] not in components:
            wanted = " or ".join(map(str, components)) if len(components) < 5 else "1 to 16"
            domains = [f"{count} {domain}" for count, domain in zip(self._counts, DOMAIN)]
            raise InputError(f"{what} must be {', '.join(domains[:-1])} or {domains[-1]} x {wanted}, not {_arrays.shape_text(values)}")
        domain = self._counts.index(elements) if told is None else chosen(DOMAIN, told, "domain")
        if self._counts[domain] != elements:
            raise InputError(f"{what} must be {self._counts[domain]} {told}, not {elements}")
        self._encoder.add_attribute(self._number, name, ATTRIBUTE_KIND[kind], domain, values.shape[-1], frames, values,
                                    None, [], [], *self._choice.of(name, kind, given))

    def _move(self, name: str, kind: str, what: str, given: Moving, components: Tuple[int, ...]) -> None:
        if self._frames > 0:
            raise InputError(f"{what}: a Moving is of a live stream; give frames of values")
        if kind == "normal" or given.components not in components:
            raise InputError(f"{what} cannot move with {given.components} components")
        domain = chosen(DOMAIN, given.domain, "domain")
        self.moving.append((kind, name, (self._counts[domain], given.components)))
        self._encoder.add_attribute(self._number, name, ATTRIBUTE_KIND[kind], domain, given.components, 0, None, None, [], [],
                                    *self._choice.of(name, kind, None))

    def _labels(self, kind: str, names: Sequence[str], of_polygon: Any,
                looks: Sequence[Optional[Material]] = ()) -> None:
        labels = np.asarray(of_polygon)
        if labels.shape != (self._counts[2],):
            raise InputError(f"{kind}s must be a number for each of {self._counts[2]} polygons, "
                             f"not {_arrays.shape_text(labels)}")
        self._encoder.add_attribute(self._number, "", ATTRIBUTE_KIND[kind], DOMAIN["polygons"], 0, 1, None,
                                    _arrays.indices(labels.astype(np.int64) + 1, kind), list(names),
                                    to_file(looks, names), 0, 0, "")


def _clock(clip: SourceClip, fps: Any, loop: bool) -> Tuple[int, int, bool, float, Optional[np.ndarray]]:
    """Rate, loop, start and times of a clip as the extension module takes them."""
    table = None if clip.times is None else np.ascontiguousarray(clip.times, dtype=np.float64)
    if table is not None and table.shape != (clip.frame_count,):
        raise InputError(f"times must be {clip.frame_count} seconds, not {_arrays.shape_text(table)}")
    return (*_rate(fps if clip.fps is None else clip.fps), loop if clip.loop is None else clip.loop, clip.start_time,
            table)


def _metres(unit: Union[None, float, str]) -> float:
    metres = _UNITS.get(unit) if isinstance(unit, str) else float(unit or 0)
    if metres is None:
        raise InputError(f"unit is a number of metres or one of {', '.join(_UNITS)}, not {unit!r}")
    return metres


def _origin(value: Any) -> Optional[Tuple[float, float, float]]:
    """A point, or None for one that is found."""
    if isinstance(value, str) and value in ("auto", "none"):
        return None if value == "auto" else (0.0, 0.0, 0.0)
    try:
        x, y, z = map(float, value)
    except (TypeError, ValueError):
        raise InputError(f"origin is 'auto', 'none' or three numbers, not {value!r}") from None
    return x, y, z


def _add_clips(encoder: Any, clips: Sequence[SourceClip], frame_count: int, fps: Any, loop: bool, up: int,
               metres: float, origin: Any) -> None:
    for clip in clips:
        if clip.frame_count < 1:
            raise InputError(f"clip {clip.name!r} has no frame")
    frames = sum(clip.frame_count for clip in clips)
    if frames != frame_count:
        raise InputError(f"the clips have {frames} frames, the positions {frame_count}")
    for clip in clips:
        numerator, denominator, loops, start, table = _clock(clip, fps, loop)
        events = [(str(event), float(seconds)) for event, seconds in clip.events]
        encoder.add_clip(clip.name, clip.frame_count, numerator, denominator, up, loops, start, metres, table, events,
                         _origin(origin))


def encode_meshes(meshes: Sequence[SourceMesh], *, frame_count: Optional[int] = None, fps: Any = None, name: str = "",
                  times: Any = None, start_time: float = 0, up: Optional[str] = None,
                  unit: Union[None, float, str] = None, loop: bool = False,
                  origin: Any = "auto", clips: Optional[Sequence[SourceClip]] = None, events: Sequence[Tuple[str, float]] = (), progress: Optional[Progress] = None,
                  fields: Optional[Sequence[str]] = None, field_errors: Optional[Mapping[str, Bound]] = None,
                  field_units: Optional[Mapping[str, str]] = None, **options: Any) -> Encoded:
    """Encodes several meshes to one file; arguments and options are those of encode().

    frame_count is needed only where no mesh is shown in all frames by an array.
    """
    meshes = list(meshes)
    if not meshes:
        raise InputError("there is no mesh to encode")
    if frame_count is None:
        counts = [len(mesh.positions) for mesh in meshes if not callable(mesh.positions) and not mesh.runs]
        if not counts:
            raise InputError("frame_count is needed")
        frame_count = counts[0]
    choices = _choices(dict(options))
    metres = _metres(unit)
    if up not in UP:
        raise InputError(f"up is 'y', 'z' or None, not {up!r}")
    if frame_count < 1 or frame_count >= 2**24:
        raise InputError("the sequence has no frame" if frame_count < 1 else "at most 2^24 - 1 frames are possible")
    if clips is not None and (name or times is not None or start_time != 0 or events):
        raise InputError("name, times, events and start_time are those of each clip")
    if clips is None:
        clips = [SourceClip(name, frame_count, start_time=start_time, times=times, events=events)]
    choice = _Fields(fields, field_errors, field_units)
    choice.check(meshes)
    encoder = _anicodec.Encoder()
    _add_clips(encoder, clips, frame_count, fps, loop, UP.index(up), metres, origin)
    keep: List[_Adder] = [_Adder(encoder, i, mesh, frame_count, choices.get("max_bytes", 0), choice) for i, mesh in enumerate(meshes)]
    data, measured = encoder.encode(choices, progress)
    del keep
    result = Encoded(data)
    result.measured = measured
    return result


def encode(positions: Any, faces: Any = None, *, uv: Any = None, colours: Any = None, normals: Any = None,
           custom: Optional[Mapping[str, Any]] = None, materials: Any = None, parts: Any = None,
           vertex_count: Optional[int] = None, **options: Any) -> Encoded:
    """Encodes a mesh in motion to the bytes of an .anic file, the same that the command writes.

    positions: frames x vertices x 3, numbers of any kind and stride, in scene units; or a function that returns
        vertices x 3 for a frame, with vertex_count= and frame_count=.
    faces: polygons x corners, a list of polygons, a pair (offsets, corners), or None.
    One target: max_error (default "0.05%"), rmse: scene units, or a text in per cent of the diagonal, of several clips each
        of its own; kg: per cent;
        displacement: the largest error of a vertex's move from frame to frame; sted, or quality "good", "better", "best":
        an error as viewers see it; size: bytes, or a text as "40k"; bpfv: bits per frame and vertex. max_error may stand beside any other;
        or lossless=True: positions, as float32, come back bit for bit.
    uv, colours, normals, custom, materials, parts: see SourceMesh.
    field_errors: the largest error of an attribute by its name: in units of its values, as a text "0.1%" of its range over all
        frames, or "exact" for whole numbers (up to 2^24, up to 2^18 where they move), which arrays of integers in custom are
        without it. Others: attribute_error where they move. field_units: of an attribute's values, as {"temperature": "K"}.
    fields: names of those of custom that are kept; None: all.
    fps, times, start_time, name, up ("y", "z"), unit (metres, or "cm"), loop, events (pairs of a name and seconds): stored.
    origin: a point that positions count from, as float32 has few digits for a small mesh far from zero: three numbers, "none",
        or "auto" for one amid such a mesh where positions are arrays. It is taken from arrays in double, not from what a
        function returns. Clip.info["origin"] has it.
    metadata: a mapping that the file keeps as JSON, for instance author, licence, source: Clip.metadata.
    root_motion: keep the motion of the whole along the ground, and its turn about the up axis, apart.
    clips: several SourceClip in one file that share what they can; positions have their frames, one after the other.
    basis ("auto", "keyframes", "eigenshapes", "eigentrajectories"), keyframes,
        keyframe_selection ("pivot", "gas", "uniform"), interpolation ("linear", "msgi", "auto"), keyframe_coder ("native",
        "draco", "auto"), massage ("off", "on", "auto"), massage_strength, massage_tolerance, order ("vertices", the default, "free", "all"), effort ("fast", "normal", "best"),
        smallest (whatever opening takes), uv_bits, colour_bits, attribute_error, store_normals (degrees), no_attributes: as
        of the command.
    threads: 0 for all. max_bytes: of memory, else LimitError.
    progress: a function of the stage and its share done; False from it raises Cancelled, and what it
        raises ends the encoding too.

    Raises InputError (a ValueError), LimitError, Cancelled, TypeError. The GIL is released.
    """
    mesh = SourceMesh(positions, faces, vertex_count=vertex_count, uv=uv, colours=colours, normals=normals,
                      custom=custom or {}, materials=materials, parts=parts)
    if not callable(positions):
        _arrays.check_size(positions, "positions", options.get("max_bytes", 0))
        mesh.positions = _arrays.frames(positions)
    return encode_meshes([mesh], **options)
