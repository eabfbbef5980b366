# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Clips in Panda3D. Needs the extra: pip install 'anicodec[panda3d]'."""
from __future__ import annotations

from typing import Any, Dict, List, Optional, Union

import numpy as np

from ._words import WRAP
from .clip import Clip, Mesh, chosen, open as open_clip
from .errors import InputError

try:
    from panda3d.core import (ClockObject, Geom, GeomEnums, GeomNode, GeomTriangles, GeomVertexArrayFormat,
                              GeomVertexData, GeomVertexFormat, InternalName, Material, NodePath, PandaNode,
                              TransparencyAttrib)
except ImportError as error:
    raise ImportError("this needs the extra of the package: pip install 'anicodec[panda3d]'") from error

_POSITIONS, _NORMALS, _STILL = range(3)  # arrays of a vertex
_LINEAR = 1


def _format() -> GeomVertexFormat:
    """Positions and normals in arrays of their own, which move; texture coordinates in a third."""
    made = GeomVertexFormat()
    for name, components, contents in ((InternalName.get_vertex(), 3, GeomEnums.C_point),
                                       (InternalName.get_normal(), 3, GeomEnums.C_normal),
                                       (InternalName.get_texcoord(), 2, GeomEnums.C_texcoord)):
        array = GeomVertexArrayFormat()
        array.add_column(name, components, GeomEnums.NT_float32, contents)
        made.add_array(array)
    return GeomVertexFormat.register_format(made)


def _numbers(data: GeomVertexData, array: int) -> np.ndarray:
    """The numbers of an array of vertices, to be written."""
    return np.frombuffer(memoryview(data.modify_array(array)).cast("B").cast("f"), np.float32)


class _Surface:
    """The part of a mesh that all instances share: the plan of its vertices, triangles, texture coordinates."""

    def __init__(self, mesh: Mesh, crease: float):
        first = next((f for f in range(len(mesh)) if mesh.shown_in(f)), 0)
        self.plan = mesh._asset.render_plan(mesh._number, float(crease), first, True)
        info = self.plan.info()
        self.vertex_count: int = info["vertex_count"]
        self.name = mesh.name
        instance = mesh._asset.instance()
        instance.seek(mesh._clip.time(first), 0, 0)
        self.uvs = np.zeros((self.vertex_count, 2), np.float32)
        for number, attribute in enumerate(mesh.attributes):
            if attribute.kind == "uv" and attribute.domain != "polygons":
                instance.write_attribute(self.plan, number, 2, self.uvs)
                break
        materials = next((a for a in mesh.attributes if a.kind == "material"), None)
        names: tuple = materials.labels if materials else ()
        looks: tuple = materials.looks if materials else ()
        begin, indices = info["group_begin"], info["indices"]
        #: a name, a look and the triangles of each material
        self.groups = [(names[label - 1] if 0 < label <= len(names) else "",
                        looks[label - 1] if 0 < label <= len(looks) else None,
                        self._triangles(indices[3 * begin[g]:3 * begin[g + 1]]))
                       for g, label in enumerate(info["group_materials"].tolist())]

    @staticmethod
    def _triangles(indices: np.ndarray) -> GeomTriangles:
        triangles = GeomTriangles(Geom.UH_static)
        triangles.set_index_type(Geom.NT_uint32)
        array = triangles.modify_vertices()
        array.unclean_set_num_rows(len(indices))
        np.frombuffer(memoryview(array).cast("B").cast("I"), np.uint32)[:] = indices
        return triangles


def _set_look(node: NodePath, look: Any, name: str) -> None:
    """Base colour, metal, roughness and transparency of a material; textures are for the scene to set."""
    material = Material(name)
    material.set_base_color(look.base_colour)
    material.set_metallic(look.metallic)
    material.set_roughness(look.roughness)
    material.set_emission((*look.emissive, 1))
    node.set_material(material)
    node.set_two_sided(look.double_sided)
    if look.alpha != "opaque":
        node.set_transparency(TransparencyAttrib.M_alpha if look.alpha == "blend" else TransparencyAttrib.M_binary)


class ClipActor(NodePath):
    """A clip in the scene graph, used as an Actor is: `loop()`, `play()`, `stop()`, `pose()`, `set_play_rate()`.

    source: a path, bytes, a Clip, or another ClipActor, whose opened file it shares. crease: degrees above which an edge is
    hard, where the file does not tell. A node for each mesh, below it one for each material, by their names and with
    their colours; textures are for the scene to set. Axes are turned to z up. Normals are smooth, recomputed for each frame.

    `update(dt)` goes on in time; `start(task_mgr)` has it called once for each frame drawn. `root`, a node, the actor itself as
    a rule, is then moved on by the motion of the whole, which `anicodec.open(path, in_place=True)` leaves out of the positions.
    """

    root: Optional[NodePath] = None

    def __init__(self, source: Any, name: str = "", crease: float = 60):
        self.clip: Clip
        if isinstance(source, ClipActor):
            self.clip, self._surfaces = source.clip, source._surfaces
        else:
            self.clip = source if isinstance(source, Clip) else open_clip(source)
            self._surfaces = [_Surface(mesh, crease) for mesh in self.clip.meshes]
        NodePath.__init__(self, PandaNode(name or self.clip.name or "clip"))
        self._instance = self.clip._asset.instance()
        self._data: List[GeomVertexData] = []
        self._nodes: List[NodePath] = []
        turned = self.attach_new_node("axes")
        if self.clip.info["up"] != "z":
            turned.set_p(90)
        for surface in self._surfaces:
            self._add(turned, surface)
        self._names = {clip.name: number for number, clip in enumerate(self.clip.clips)}
        self._playing, self._time, self._rate, self._wrap = 0, 0.0, 0.0, WRAP["loop"]
        self._play_rate = 1.0
        self._fade: Optional[Dict[str, float]] = None
        self._task: Any = None
        self.show_time(0)

    def _add(self, parent: NodePath, surface: _Surface) -> None:
        data = GeomVertexData(surface.name, _FORMAT, Geom.UH_dynamic)
        data.unclean_set_num_rows(surface.vertex_count)
        _numbers(data, _STILL)[:] = surface.uvs.ravel()
        node = parent.attach_new_node(surface.name or "mesh")
        for name, look, triangles in surface.groups:
            geom = Geom(data)
            geom.add_primitive(triangles)
            part = GeomNode(name or "material")
            part.add_geom(geom)
            path = node.attach_new_node(part)
            if look is not None:
                _set_look(path, look, name)
        self._data.append(data)
        self._nodes.append(node)

    def get_anim_names(self) -> List[str]:
        """Names of the clips of the file."""
        return [clip.name for clip in self.clip.clips]

    def _number(self, name: Optional[str]) -> int:
        if name is None:
            return self._playing
        if name not in self._names:
            raise InputError(f"the file has no clip {name!r}, but {', '.join(self._names)}")
        return self._names[name]

    def get_duration(self, name: Optional[str] = None) -> float:
        """Seconds from the first frame to the last."""
        return self.clip.clips[self._number(name)].duration

    def loop(self, name: Optional[str] = None) -> None:
        """Plays a clip of the file, the last one by default, from its beginning on, again and again."""
        self._begin(name, "loop")

    def play(self, name: Optional[str] = None) -> None:
        """Plays a clip once; its last frame stays."""
        self._begin(name, "clamp")

    def _begin(self, name: Optional[str], wrap: str) -> None:
        self._playing, self._time, self._fade = self._number(name), 0.0, None
        self._wrap, self._rate = chosen(WRAP, wrap, "wrap"), self._play_rate
        self.show_time(0)

    def stop(self) -> None:
        """Stays at what is shown."""
        self._rate = 0.0

    def pose(self, name: Optional[str], frame: Union[int, float]) -> None:
        """Shows a frame of a clip, and stays there."""
        self._playing, self._fade = self._number(name), None
        clip = self.clip.clips[self._playing]
        self.stop()
        first = self.clip.time(clip.first_frame + min(max(int(frame), 0), clip.frame_count - 1))
        self.show_time(first)

    def set_play_rate(self, rate: float) -> None:
        """1: as fast as it was recorded; negative: backwards."""
        self._play_rate = float(rate)
        if self._rate != 0:
            self._rate = self._play_rate

    def cross_fade(self, name: str, seconds: float) -> None:
        """Fades to the beginning of a clip of the file."""
        self._fade = {"clip": self._number(name), "time": 0.0, "done": 0.0, "length": max(seconds, 1e-9)}
        self._rate = self._play_rate

    def set_quality(self, quality: float) -> None:
        """Share of the components to play, in (0, 1]: less for what is far away."""
        self._instance.set_quality(float(quality))

    def get_time(self) -> float:
        """Seconds in the clip."""
        return self._time

    def update(self, seconds: float) -> None:
        """Goes on by some seconds and shows what is there then."""
        step = seconds * self._rate
        if step == 0:
            return
        if self.root is not None:
            self._move_root(step)
        self._time += step
        if self._fade:
            self._fade["time"] += step
            self._fade["done"] += abs(step)
            if self._fade["done"] >= self._fade["length"]:
                self._playing, self._time, self._fade = int(self._fade["clip"]), self._fade["time"], None
        self.show_time(self._time)

    def _move_root(self, seconds: float) -> None:
        """A step of the clip that plays, and of what fades in by its share."""
        share = min(self._fade["done"] / self._fade["length"], 1.0) if self._fade else 0.0
        moves = [(self._playing, self._time, 1 - share)]
        if self._fade:
            moves.append((int(self._fade["clip"]), self._fade["time"], share))
        move, turn = np.zeros(3), 0.0
        for clip, time, weight in moves:
            step = self.clip._asset.root_step(clip, time, time + seconds, _LINEAR, self._wrap)
            move += weight * np.array(step["move"])
            turn += weight * step["turn"]
        if self.clip.info["up"] != "z":
            move = np.array([move[0], -move[2], move[1]])
        self.root.set_pos(self.root, *move)
        self.root.set_h(self.root, np.degrees(turn))

    def show_time(self, seconds: float) -> None:
        """Shows a time of the clip that plays, with what fades in."""
        self._time = seconds
        self._instance.set_clip(self._playing)
        self._instance.seek(float(seconds), _LINEAR, self._wrap)
        if self._fade:
            self._instance.blend(int(self._fade["clip"]), self._fade["time"],
                                 min(self._fade["done"] / self._fade["length"], 1.0), _LINEAR, self._wrap)
        for surface, data, node in zip(self._surfaces, self._data, self._nodes):
            positions = _numbers(data, _POSITIONS)
            if self._instance.write_positions(surface.plan, positions):
                surface.plan.write_normals(positions, _numbers(data, _NORMALS))
                node.show()
            else:
                node.hide()

    def start(self, task_mgr: Any, sort: int = 0) -> None:
        """Has update() called for each frame, by the clock of Panda3D."""
        def step(task: Any) -> int:
            self.update(ClockObject.get_global_clock().get_dt())
            return task.cont
        self._task = task_mgr.add(step, f"anicodec {self.get_name()}", sort=sort)

    def cleanup(self) -> None:
        """Takes it out of the scene."""
        if self._task is not None:
            self._task.remove()
        self.remove_node()


_FORMAT = _format()
