# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Whole clips in viewers of other packages, by what these have for time."""
from __future__ import annotations

from typing import Any, Callable, Dict, List

import numpy as np

from ._steps import clip_of, names_of, positions_at, shown_frames, times_of

_FRAMES_AT_ONCE = 64  #: that are handed to Rerun together


def _rerun(clip: Any) -> Any:
    """A RecordingStream with each mesh on the timeline "time"."""
    import rerun

    recording = rerun.RecordingStream(clip.name or "anicodec")
    times = np.array(times_of(clip))
    for name, mesh in zip(names_of(clip), clip.meshes):
        path = rerun.new_entity_path([name])
        recording.log(path, rerun.Mesh3D.from_fields(triangle_indices=mesh.triangles), static=True)
        shown = shown_frames(mesh)
        for first in range(0, len(shown), _FRAMES_AT_ONCE):
            some = shown[first:first + _FRAMES_AT_ONCE]
            positions = np.concatenate([positions_at(mesh, frame) for frame in some]).astype(np.float32)
            columns = rerun.Mesh3D.columns(vertex_positions=positions).partition([mesh.vertex_count] * len(some))
            recording.send_columns(path, indexes=[rerun.TimeColumn("time", duration=times[some])], columns=columns)
        gone = [frame for frame in range(len(clip)) if not mesh.shown_in(frame)]
        if gone:
            recording.send_columns(path, indexes=[rerun.TimeColumn("time", duration=times[gone])],
                                   columns=rerun.Clear.columns(is_recursive=[False] * len(gone)))
    return recording


def _k3d(clip: Any) -> Any:
    """A plot whose meshes have the series of times that K3D plays."""
    import k3d

    plot = k3d.plot(fps=float(clip.fps))
    times = times_of(clip)
    for name, mesh in zip(names_of(clip), clip.meshes):
        shown = shown_frames(mesh)
        body = k3d.mesh({str(times[frame]): positions_at(mesh, frame).astype(np.float32) for frame in shown}, mesh.triangles, name=name,
                        side="double")
        if len(shown) < len(clip):
            body.visible = {str(moment): mesh.shown_in(frame) for frame, moment in enumerate(times)}
        plot += body
    return plot


def _viser(clip: Any) -> Any:
    """A server with a slider of time; port and address are those it has by default."""
    import viser

    server = viser.ViserServer(verbose=False)
    handles = [server.scene.add_mesh_simple(f"/{name}", positions_at(mesh, shown_frames(mesh)[0]).astype(np.float32), mesh.triangles)
               for name, mesh in zip(names_of(clip), clip.meshes)]
    slider = server.gui.add_slider("frame", 0, len(clip) - 1, 1, 0)

    def show(_: Any = None) -> None:
        for mesh, handle in zip(clip.meshes, handles):
            handle.visible = mesh.shown_in(slider.value)
            if handle.visible:
                handle.vertices = positions_at(mesh, slider.value).astype(np.float32)

    slider.on_update(show)
    show()
    return server


def _polyscope(clip: Any) -> Any:
    """Polyscope, with a slider of time in its window: polyscope.show() opens that."""
    import polyscope
    import polyscope.imgui as imgui

    polyscope.init()
    names = names_of(clip)
    surfaces = [polyscope.register_surface_mesh(name, positions_at(mesh, shown_frames(mesh)[0]), mesh.triangles)
                for name, mesh in zip(names, clip.meshes)]
    shown = [-1]

    def show(frame: int) -> None:
        if frame == shown[0]:
            return
        shown[0] = frame
        for mesh, surface in zip(clip.meshes, surfaces):
            surface.set_enabled(mesh.shown_in(frame))
            if mesh.shown_in(frame):
                surface.update_vertex_positions(positions_at(mesh, frame))

    def draw() -> None:
        show(imgui.SliderInt("frame", max(shown[0], 0), 0, len(clip) - 1)[1])

    show(0)
    polyscope.set_user_callback(draw)
    return polyscope


def _pyvista(clip: Any) -> Any:
    """The reader that pyvista.get_reader() gives of a file: its time values, and frames by read()."""
    from .pyvista import ClipReader

    return ClipReader(clip)


def _open3d(clip: Any) -> List[Dict[str, Any]]:
    """For open3d.visualization.draw(): a geometry for each frame, as it plays these by their time."""
    import open3d

    found = []
    times = times_of(clip)
    for name, mesh in zip(names_of(clip), clip.meshes):
        triangles = open3d.utility.Vector3iVector(mesh.triangles.astype(np.int32))
        for frame in shown_frames(mesh):
            positions = open3d.utility.Vector3dVector(positions_at(mesh, frame).astype(np.float64))
            body = open3d.geometry.TriangleMesh(positions, triangles)
            body.compute_vertex_normals()
            found.append({"name": f"{name} {frame}", "geometry": body, "group": name, "time": times[frame]})
    return found


_PLAYERS: Dict[str, Callable[[Any], Any]] = {
    "rerun": _rerun, "k3d": _k3d, "viser": _viser, "polyscope": _polyscope, "pyvista": _pyvista, "open3d": _open3d}
_INSTALLED_AS = {"rerun": "rerun-sdk"}


def to_player(clip: Any, package: str) -> Any:
    """A clip in a viewer, see Clip.to(). Raises ImportError naming the package that is missing, and InputError."""
    source = clip_of(clip)
    try:
        return _PLAYERS[package](source)
    except ImportError as error:
        raise ImportError(f"{package} is missing: pip install {_INSTALLED_AS.get(package, package)}") from error
