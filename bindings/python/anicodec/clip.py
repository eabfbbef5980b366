# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Opened clips."""
from __future__ import annotations

import builtins
import json
import os
import sys
from fractions import Fraction
from typing import Any, Dict, Iterator, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from . import _anicodec, _arrays, _page
from ._convert import PLAYERS, to_package
from ._words import DOMAIN, SAMPLING, SIDE, UP_AXIS, WRAP
from .errors import CorruptError, FrameError, InputError, LimitError
from .material import Material, from_file

UP = (None, *(word for word in UP_AXIS if word != "unknown"))
Blend = Tuple[Union[int, str], float, float]  #: a clip, seconds of it, and its weight


def chosen(table: Dict[str, Any], name: str, what: str) -> Any:
    """The number of a word."""
    if name not in table:
        raise InputError(f"{what} is one of {', '.join(table)}, not {name!r}")
    return table[name]


def _three(values: Any, number: Any, what: str) -> list:
    if np.shape(values) != (3,):
        raise InputError(f"{what} are three numbers, not {values!r}")
    return [number(value) for value in values]


class Attribute(NamedTuple):
    """An attribute of a mesh beside its positions, as in frame 0."""

    name: str
    kind: str  #: uv, normal, tangent, colour, custom, material or part
    domain: str  #: vertices, corners or polygons
    values: np.ndarray  #: elements x components, float32; of labels: one uint32 for each element, 0 for none
    labels: Tuple[str, ...]  #: names of the labels 1, 2 ...
    moves: bool  #: other frames have other values: Mesh.attribute_at()
    looks: Tuple[Optional[Material], ...] = ()  #: of materials: one for each name, None where it is unknown
    unit: str = ""  #: of the values
    whole: bool = False  #: the values are whole numbers, which come back exactly in frames


class RootMotion(NamedTuple):
    """A turn about the up axis through the pivot, then a move along the ground."""

    turn: float  #: radians, counter-clockwise seen from above
    move: Tuple[float, float, float]
    pivot: Tuple[float, float, float]
    matrix: np.ndarray  #: the same as one map, 3 x 4


class SurfaceFrame(NamedTuple):
    """Axes at a point of the surface, of length 1."""

    position: np.ndarray
    normal: np.ndarray  #: of the triangle, on its front
    tangent: np.ndarray  #: from the triangle's first vertex to the second one

    @property
    def matrix(self) -> np.ndarray:
        """3 x 4: tangent, normal x tangent, normal and position as columns. It places an object whose z axis leaves the surface."""
        return np.stack([self.tangent, np.cross(self.normal, self.tangent), self.normal, self.position], axis=1)


class Hit(NamedTuple):
    """The first point of the surface on a ray."""

    distance: float  #: from the origin, in lengths of the direction
    triangle: int  #: a row of Mesh.triangles
    vertices: Tuple[int, int, int]
    weights: Tuple[float, float, float]  #: barycentric coordinates; with `vertices` for Mesh.surface_frame()
    side: str  #: front or back


class ClipInfo(NamedTuple):
    """A clip that was opened of a file that holds one or more: frames first_frame .. first_frame + frame_count - 1."""

    name: str
    first_frame: int
    frame_count: int
    duration: float  #: seconds from its first frame to its last
    loop_duration: float  #: seconds of one turn, when it goes round
    loop: bool  #: it is meant to go round
    fps: Fraction
    start_time: float  #: of its first frame on the clock of the source, seconds
    max_error: float  #: its promise, in units of the file, and so are those that follow
    rmse: float
    kg: float  #: per cent
    max_displacement_error: float  #: of a vertex's move from frame to frame
    events: Tuple[Tuple[str, float], ...] = ()  #: names and seconds from its first frame on

    @property
    def frames(self) -> slice:
        """Its frames: `clip[info.frames]`."""
        return slice(self.first_frame, self.first_frame + self.frame_count)


def _clip_info(clip: Dict[str, Any]) -> ClipInfo:
    return ClipInfo(**{name: Fraction(*clip["rate"]) if name == "fps" else clip[name] for name in ClipInfo._fields})


def _root_motion(motion: Dict[str, Any]) -> RootMotion:
    return RootMotion(motion["turn"], motion["move"], motion["pivot"], np.array(motion["matrix"]).reshape(3, 4))


#: Frames whose numbers are handed over in one list.
_FRAMES_AT_ONCE = 4096


def _memory() -> int:
    """Bytes of memory that the machine has, if it tells."""
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, ValueError):
        return sys.maxsize


class Mesh:
    """A mesh of a clip: `mesh[10]` are the positions of frame 10, vertices x 3, float32; `mesh[10:20]` those of ten
    frames in one array. Threads may share it."""

    def __init__(self, clip: "Clip", number: int):
        self._asset, self._number, self._clip = clip._asset, number, clip
        self._mesh = self._asset.mesh(number)
        self._plans: Dict[tuple, Any] = {}
        self._attributes: Optional[Tuple[Attribute, ...]] = None
        self._triangles: Optional[np.ndarray] = None

    @property
    def name(self) -> str:
        return self._mesh["name"]

    @property
    def vertex_count(self) -> int:
        return self._mesh["vertex_count"]

    @property
    def polygons(self) -> Tuple[np.ndarray, np.ndarray]:
        """Offsets and corners: polygon p has the vertices corners[offsets[p]:offsets[p + 1]]. uint32, copies."""
        return self._asset.polygons(self._number)

    @property
    def faces(self) -> Union[np.ndarray, Tuple[np.ndarray, np.ndarray]]:
        """Polygons x corners where all have as many corners, else `polygons`. encode() takes either."""
        offsets, corners = self.polygons
        sizes = np.diff(offsets)
        if len(sizes) > 0 and (sizes == sizes[0]).all() and sizes[0] > 0:
            return corners.reshape(-1, sizes[0])
        return offsets, corners

    @property
    def triangles(self) -> np.ndarray:
        """Triangles x 3, uint32: of every polygon in order, concave ones cut right."""
        return self._asset.triangles(self._number)

    @property
    def attributes(self) -> Tuple[Attribute, ...]:
        """All attributes that the file holds beside positions and polygons."""
        if self._attributes is None:
            found = []
            for i in range(self._mesh["attribute_count"]):
                a = self._asset.attribute(self._number, i)
                field = self._clip.field(a["name"]) if a["values"].ndim == 2 else {}
                found.append(Attribute(a["name"], a["kind"], a["domain"], a["values"],
                                       tuple(a.get("labels", ())), a["moves"],
                                       tuple(from_file(look) for look in a.get("looks", ())),
                                       str(field.get("unit", "")), field.get("whole") is True))
            self._attributes = tuple(found)
        return self._attributes

    def __len__(self) -> int:
        return self._clip.frame_count

    def __iter__(self) -> Iterator[np.ndarray]:
        return (self[frame] for frame in range(len(self)))

    def __getitem__(self, frames: Union[int, slice, Any]) -> np.ndarray:
        return self.frames(frames)

    def frames(self, frames: Union[int, slice, Any], out: Optional[np.ndarray] = None) -> np.ndarray:
        """Positions of a frame, vertices x 3, or of a slice or list of frames, frames x vertices x 3; float32.

        out: an array to fill instead of a new one, which may take at most the max_bytes of open(), or the machine's
        memory. Raises FrameError (an IndexError), AbsentError, LimitError.
        """
        vertices = self.vertex_count
        if isinstance(frames, slice):
            chosen_frames: Sequence[int] = range(len(self))[frames]
        elif np.ndim(frames) == 0:
            try:
                number = range(len(self))[frames]
            except IndexError:
                raise FrameError(f"there is no frame {frames} of {len(self)}") from None
            except TypeError:
                raise TypeError(f"a frame is a number, not {frames!r}") from None
            result = _arrays.output(out, (vertices, 3))
            self._asset.frames(self._number, [number], result)
            return result
        else:
            try:
                chosen_frames = [range(len(self))[int(frame)] for frame in frames]
            except IndexError:
                raise FrameError(f"there are only {len(self)} frames") from None
        # A file of few bytes may announce frames that no memory holds.
        size, limit = 12 * vertices * len(chosen_frames), self._clip._arguments[1] or _memory()
        if out is None and size > limit:
            raise LimitError(f"{len(chosen_frames)} frames take {size} bytes of at most {limit}")
        result = _arrays.output(out, (len(chosen_frames), vertices, 3))
        for first in range(0, len(chosen_frames), _FRAMES_AT_ONCE):
            some = slice(first, first + _FRAMES_AT_ONCE)
            self._asset.frames(self._number, list(chosen_frames[some]), result[some])
        return result

    def at(self, seconds: float, loop: bool = False, sampling: str = "linear", wrap: Optional[str] = None,
           out: Optional[np.ndarray] = None, clip: Union[None, int, str] = None, blend: Optional[Blend] = None,
           blend_wrap: Optional[str] = None) -> np.ndarray:
        """Positions at a time, 0 is the first frame of the clip: vertices x 3, float32.

        sampling: step, linear or cubic. loop=True or wrap="loop": the clip goes round; wrap: clamp, loop, ping-pong.
        clip: name or number of one of Clip.clips, else the first. blend: a clip, a time of it and a
        weight: 0 shows nothing of it, 1 it alone; blend_wrap: of that clip, else as the other.
        """
        result = _arrays.output(out, (self.vertex_count, 3))
        moment = self._moment(seconds, loop, sampling, wrap, clip, blend, blend_wrap)
        self._asset.at(self._number, *moment, result)
        return result

    def _moment(self, seconds: float, loop: bool, sampling: str, wrap: Optional[str], clip: Union[None, int, str],
                blend: Optional[Blend], blend_wrap: Optional[str]) -> tuple:
        """Clip, time, sampling, wrap, and what is blended into them, as the extension module takes them."""
        ends = chosen(WRAP, wrap or ("loop" if loop else "clamp"), "wrap")
        if blend is None:
            blended = (0, 0.0, ends, 0.0)
        else:
            other, moment, weight = blend
            ends_of_other = ends if blend_wrap is None else chosen(WRAP, blend_wrap, "wrap")
            blended = (self._clip.clip_number(other), float(moment), ends_of_other, float(weight))
        return (self._clip.clip_number(clip), float(seconds), chosen(SAMPLING, sampling, "sampling"), ends, *blended)

    def attribute_at(self, number: int, seconds: float, loop: bool = False, sampling: str = "linear",
                     out: Optional[np.ndarray] = None, clip: Union[None, int, str] = None,
                     blend: Optional[Blend] = None) -> np.ndarray:
        """Values of attribute `number` at a time: vertices, corners or polygons x components, float32. See at().
        Whole numbers are rounded between frames, too."""
        if not 0 <= number < len(self.attributes) or self.attributes[number].values.ndim != 2:
            raise InputError(f"there is no attribute {number} of numbers")
        shape = self.attributes[number].values.shape
        result = _arrays.output(out, shape)
        moment = self._moment(seconds, loop, sampling, None, clip, blend, None)
        self._asset.attribute_at(self._number, number, *moment, result, shape[0])
        if self.attributes[number].whole:
            np.rint(result, out=result)
        return result

    def surface_frame(self, vertices: Sequence[int], weights: Sequence[float], seconds: float, loop: bool = False,
                      sampling: str = "linear", clip: Union[None, int, str] = None,
                      blend: Optional[Blend] = None) -> SurfaceFrame:
        """Axes at a point of the surface at a time, for what is attached to it.

        vertices: of a triangle, as in `triangles`; weights: barycentric coordinates in it, whose sum is 1. Others: see at().
        Cost: that of three vertices.
        """
        moment = self._moment(seconds, loop, sampling, None, clip, blend, None)
        numbers = self._asset.surface_frame(self._number, *moment, _three(vertices, int, "vertices"),
                                            _three(weights, float, "weights"))
        return SurfaceFrame(*np.array(numbers, dtype=np.float32).reshape(3, 3))

    def intersect_ray(self, origin: Sequence[float], direction: Sequence[float], seconds: float, loop: bool = False,
                      sampling: str = "linear", clip: Union[None, int, str] = None, blend: Optional[Blend] = None,
                      farthest: float = 0, side: str = "any") -> Optional[Hit]:
        """The first point of the surface on a ray at a time; None if it meets nothing.

        farthest: in lengths of the direction, 0 for any distance; side: of the triangles that count: any, front or back.
        Others: see at(). Cost: that of at(), and O(triangles).
        """
        moment = self._moment(seconds, loop, sampling, None, clip, blend, None)
        if self._triangles is None:
            self._triangles = self.triangles
        found = self._asset.intersect_ray(self._number, *moment, _three(origin, float, "origin"),
                                          _three(direction, float, "direction"), float(farthest),
                                          chosen(SIDE, side, "side"), self._triangles)
        if found is None:
            return None
        triangle, distance, weights, met = found
        vertices = tuple(int(vertex) for vertex in self._triangles[triangle])
        return Hit(distance, triangle, vertices, tuple(weights), tuple(SIDE)[met])

    def normals(self, frame: Union[int, np.ndarray], crease: float = 0, per_corner: bool = False,
                source_edges: bool = False, out: Optional[np.ndarray] = None) -> np.ndarray:
        """Normals of a frame, or of positions: vertices x 3, or corners x 3 if per_corner; float32.

        crease: degrees above which an edge is hard, 0 for none. source_edges: those of the source are.
        """
        key = (float(crease), per_corner, source_edges)
        if key not in self._plans:
            first = next((f for f in range(len(self)) if self.shown_in(f)), 0)
            self._plans[key] = self._asset.normal_plan(self._number, float(crease), first, per_corner, source_edges)
        plan = self._plans[key]
        positions = self[frame] if np.ndim(frame) == 0 else _arrays.floats(frame, "positions")
        if positions.shape != (self.vertex_count, 3):
            raise InputError(f"positions must be {self.vertex_count} x 3, not {_arrays.shape_text(positions)}")
        result = _arrays.output(out, (plan.count, 3))
        plan.write(positions, result)
        return result

    def to(self, package: str, frame: int = 0) -> Any:
        """A frame as a mesh of another package: "trimesh" (triangles), "pyvista" or "meshio" (polygons)."""
        return to_package(self, frame, package)

    def shown_in(self, frame: int) -> bool:
        """Whether the mesh is there in a frame."""
        return self._asset.shows(self._number, frame)

    def __repr__(self) -> str:
        name = f" {self.name!r}" if self.name else ""
        return f"<anicodec.Mesh{name}: {self.vertex_count} vertices, {self._mesh['polygon_count']} polygons>"


class Clip:
    """An opened .anic file. With one mesh it is used as that: `clip[10]`, `clip.at(0.5)`, `clip.faces`; with several,
    `clip.meshes` has them. In a file with several clips, frames count through those that were opened; name, clock and
    errors are those of the first of them. Can be pickled; threads may share it."""

    def __init__(self, data: bytes, quality: float = 1.0, max_bytes: int = 0, clips: Sequence[str] = (),
                 in_place: bool = False, inexact: bool = False):
        self.data = bytes(data)  #: the file
        self._asset = _anicodec.Asset(self.data, quality, max_bytes, list(clips), in_place, inexact)
        self._arguments = (quality, max_bytes, tuple(clips), in_place, inexact)
        self.info: Dict[str, Any] = self._asset.info()  #: counts, timing, axes, units and the promise of the file
        self.info["up"] = None if self.info["up"] == "unknown" else self.info["up"]
        self.meshes = tuple(Mesh(self, m) for m in range(self.info["mesh_count"]))
        self._fields: Optional[Dict[str, Any]] = None
        #: The clips that were opened; frames count through them.
        self.clips = tuple(_clip_info(c) for c in self._asset.clips())

    @property
    def name(self) -> str:
        return self.info["name"]

    @property
    def metadata(self) -> Dict[str, Any]:
        """The metadata of the file: see encode(); empty if it has none."""
        return read_metadata(self.data)

    def field(self, name: str) -> Dict[str, Any]:
        """The metadata of the attributes with a name: see field_errors of encode(). Empty if there are none."""
        if self._fields is None:
            try:
                fields = self.metadata.get("fields")
            except CorruptError:  # it says nothing of them, and the clip plays
                fields = None
            self._fields = fields if isinstance(fields, dict) else {}
        field = self._fields.get(name)
        return field if isinstance(field, dict) else {}

    @property
    def frame_count(self) -> int:
        return self.info["frame_count"]

    @property
    def fps(self) -> Fraction:
        """Frames per second, of the first of several clips."""
        return Fraction(*self.info["rate"])

    @property
    def duration(self) -> float:
        """Seconds from the first frame to the last, of the first of several clips."""
        return self.info["duration"]

    @property
    def mesh(self) -> Mesh:
        """The only mesh. Raises InputError where there are several."""
        if len(self.meshes) != 1:
            raise InputError(f"the clip has {len(self.meshes)} meshes: choose one of clip.meshes")
        return self.meshes[0]

    def clip_number(self, clip: Union[None, int, str]) -> int:
        """The number in `clips` of one by its name or number; None: of the first. Raises InputError."""
        if clip is None:
            return 0
        for number, info in enumerate(self.clips):
            if clip in (number, info.name):
                return number
        where = "of the file were opened" if self._arguments[2] else "the file has"
        raise InputError(f"there is no clip {clip!r}: {where} {', '.join(info.name for info in self.clips)}")

    def root_motion(self, seconds: float, clip: Union[None, int, str] = None, sampling: str = "linear",
                    wrap: str = "clamp") -> RootMotion:
        """The motion of the whole at a time of a clip, part of the positions or not; none where it is not apart."""
        return _root_motion(self._asset.root_motion(
            self.clip_number(clip), float(seconds), chosen(SAMPLING, sampling, "sampling"), chosen(WRAP, wrap, "wrap")))

    def root_step(self, begin: float, end: float, clip: Union[None, int, str] = None, sampling: str = "linear",
                  wrap: str = "loop") -> RootMotion:
        """The step of a character from one time to another, in the axes that it has at `begin`: its matrix times this one
        is the next. A loop goes on at its end from where it is."""
        return _root_motion(self._asset.root_step(
            self.clip_number(clip), float(begin), float(end), chosen(SAMPLING, sampling, "sampling"),
            chosen(WRAP, wrap, "wrap")))

    def time(self, frame: int) -> float:
        """Seconds at which a frame is shown, from the first of its clip on."""
        return self._asset.frame_time(range(self.frame_count)[frame])

    def verify(self) -> None:
        """Raises CorruptError if this machine decodes other numbers than the encoder meant."""
        self._asset.verify()

    def page(self, against: Optional["Clip"] = None) -> str:
        """One page of HTML with the clip and a player inside, which any browser shows without a network; `against`
        stands beside it. Raises UnsupportedError where the package was built without the viewer."""
        return _page.page(self.data, self.name, against and against.data)

    def show(self, against: Optional["Clip"] = None, height: Union[int, str] = 480) -> Any:
        """Plays the clip: in a notebook as its output, `height` in pixels or as CSS has it, else in the browser.

        Returns what the notebook displays, or the path of the page. Raises UnsupportedError as page() does.
        """
        return _page.show(self.page(against), height)

    def to(self, package: str, frame: Optional[int] = None) -> Any:
        """The whole clip in another package: "rerun" (a RecordingStream), "k3d" (a plot), "viser" (a server), "polyscope" (ready for
        show()), "pyvista" (a reader with times), "open3d" (for visualization.draw()); or a frame of its only mesh: see Mesh.to()."""
        if frame is None and package in PLAYERS:
            from ._play import to_player  # which imports this module
            return to_player(self, package)
        return self.mesh.to(package, frame or 0)

    def __len__(self) -> int:
        return self.frame_count

    def __iter__(self) -> Iterator[np.ndarray]:
        return iter(self.mesh)

    def __getitem__(self, frames: Union[int, slice, Any]) -> np.ndarray:
        return self.mesh.frames(frames)

    def __getattr__(self, name: str) -> Any:
        if not name.startswith("_") and name in _OF_MESH:
            return getattr(self.mesh, name)
        raise AttributeError(f"a clip has no {name}")

    def __reduce__(self) -> tuple:
        return Clip, (self.data, *self._arguments)

    def __repr__(self) -> str:
        name = f" {self.name!r}" if self.name else ""
        what = f"{self.meshes[0].vertex_count} vertices" if len(self.meshes) == 1 else f"{len(self.meshes)} meshes"
        return (f"<anicodec.Clip{name}: {what}, {self.frame_count} frames at {float(self.fps):g} per second, "
                f"{len(self.data)} bytes>")


def _bytes_of(source: Any) -> bytes:
    if isinstance(source, (str, os.PathLike)):
        with builtins.open(source, "rb") as file:
            source = file.read()
    elif hasattr(source, "read"):
        source = source.read()
    if isinstance(source, str):
        raise TypeError("the file must be open in binary mode")
    return bytes(memoryview(source))


def read_metadata(source: Any) -> Dict[str, Any]:
    """The metadata of a file, which is not opened: see encode(). Empty if it has none. source: as of open()."""
    text = _anicodec.read_metadata(_bytes_of(source))
    if text is None:
        return {}
    try:
        metadata = json.loads(text)
    except ValueError:
        metadata = None
    if not isinstance(metadata, dict):
        raise CorruptError("chunk META: is not a JSON object")
    return metadata


def read_bounds(source: Any, mesh: int = 0, first_frame: int = 0, frames: int = 0) -> Optional[np.ndarray]:
    """A box around frames of a mesh that a file keeps for culling: 2 x 3 of float32, least and greatest, without
    decoding. None if the file has none, or the mesh is in none of the frames. frames 0: all from first_frame on. The
    first bytes of the file suffice."""
    return _anicodec.read_bounds(_bytes_of(source), mesh, first_frame, frames)


#: Names that a clip of one mesh passes on to it.
_OF_MESH = {"at", "attribute_at", "attributes", "faces", "frames", "intersect_ray", "normals", "polygons", "shown_in",
            "surface_frame", "triangles", "vertex_count"}


def open(source: Any, quality: float = 1.0, max_bytes: int = 0, clips: Sequence[str] = (),  # noqa: A001
         in_place: bool = False, inexact: bool = False) -> Clip:
    """Opens a clip: a path, bytes (anything with the buffer protocol), or a file open for reading.

    quality: share of the components to open, in (0, 1]. max_bytes: of memory, else LimitError; 0: by the size of the
    file. clips: names of those to open of a file with several, none for all; others are not there then, and frames count
    through those that are. in_place: leaves out the motion of the
    whole, where it is apart: Clip.root_motion(). inexact: leaves the exact positions of a lossless file closed, which
    take as much memory as all frames. Raises OSError, CorruptError,
    UnsupportedError, LimitError, AbsentError: no clip has this name.
    """
    return Clip(_bytes_of(source), quality, max_bytes, clips, in_place, inexact)
