# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""File > Export: the evaluated animation of meshes, and what else makes a mesh."""
import os
import threading

import anicodec
import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty
from bpy_extras.io_utils import ExportHelper

from . import meshes

_KINDS = {"MESH", "CURVE", "SURFACE", "META", "FONT"}


class Baker:
    """Collects the frames of some objects, one frame of the scene after the other."""

    def __init__(self, objects, world, segments):
        self._world, self._segments = world, segments
        self._runs = {item: [] for item in objects}  # meshes of equal polygons, each with its frames
        self.frames = 0

    def add_frame(self, depsgraph, scene_frame):
        """Takes all objects as evaluated now. Raises ValueError where polygons change."""
        for item, runs in self._runs.items():
            evaluated = item.evaluated_get(depsgraph)
            if evaluated.hide_render:
                continue
            mesh = evaluated.to_mesh()
            try:
                if mesh is not None and len(mesh.vertices) > 0:
                    self._add(item, runs, evaluated, mesh, scene_frame)
            finally:
                evaluated.to_mesh_clear()
        self.frames += 1

    def _add(self, item, runs, evaluated, mesh, scene_frame):
        faces = (meshes.polygon_starts(mesh), meshes.corners_of(mesh).astype(np.uint32))
        positions = meshes.positions_of(mesh)
        mirrored = False
        if self._world:
            matrix = np.array(evaluated.matrix_world, np.float64)
            positions = (positions @ matrix[:3, :3].T + matrix[:3, 3]).astype(np.float32)
            mirrored = bool(np.linalg.det(matrix[:3, :3]) < 0)
        same = [run for run in runs[-2:] if len(run["positions"][0]) == len(positions) and
                all(np.array_equal(a, b) for a, b in zip(run["faces"], faces))]
        if same and same[-1] is not runs[-1]:
            same = []
        if runs and not same and not self._segments:
            raise ValueError(f"{item.name}: the faces change in frame {scene_frame}; 'Changing Faces' exports "
                             "each run of equal ones")
        # An object that is mirrored turns its faces, in the frames in which it is.
        run = next((run for run in same if run["mirrored"] == mirrored), None)
        if run is None:
            run = {"faces": faces, "mirrored": mirrored, "positions": [], "frames": [],
                   "attributes": meshes.attributes_of(mesh, mirrored)}
            runs.append(run)
        run["positions"].append(positions)
        run["frames"].append(self.frames)

    def meshes(self):
        """The meshes as encoding takes them."""
        result = []
        for item, runs in self._runs.items():
            for run in runs:
                starts, corners = run["faces"]
                if run["mirrored"]:
                    corners = corners[meshes.turned_order(starts)]
                result.append(anicodec.SourceMesh(np.stack(run["positions"]), (starts, corners), name=item.name,
                                                  runs=self._present_in(run["frames"]), **run["attributes"]))
        return result

    def _present_in(self, frames):
        if len(frames) == self.frames:
            return []
        breaks = np.flatnonzero(np.diff(frames) > 1) + 1
        return [(int(part[0]), len(part)) for part in np.split(np.array(frames), breaks)]


class ExportAnic(bpy.types.Operator, ExportHelper):
    """Export the animation of meshes, as they are evaluated"""

    bl_idname = "export_scene.anic"
    bl_label = "Export .anic"
    filename_ext = ".anic"
    filter_glob: StringProperty(default="*.anic", options={"HIDDEN"})
    selected: BoolProperty(name="Selected Only", default=True)
    whole_range: BoolProperty(name="Range of the Scene", default=True)
    start: IntProperty(name="Start", default=1)
    end: IntProperty(name="End", default=250)
    space: EnumProperty(name="Space", items=[("WORLD", "World", ""), ("OBJECT", "Object", "")])
    error: FloatProperty(name="Largest Error", default=0.05, min=1e-7, precision=5)
    error_unit: EnumProperty(name="Error In", items=[("PERCENT", "Per Cent", "Share of the diagonal of the box around all"),
                                                     ("UNITS", "Scene Units", "")])
    effort: EnumProperty(name="Effort", description="How long to search", default="normal",
                         items=[("fast", "Fast", ""), ("normal", "Normal", ""), ("best", "Best", "")])
    segments: BoolProperty(name="Changing Faces", description="Store a mesh for each run of frames with equal faces")

    def invoke(self, context, event):
        self.start, self.end = context.scene.frame_start, context.scene.frame_end
        return super().invoke(context, event)

    def _begin(self, context):
        scene = context.scene
        objects = [item for item in (context.selected_objects if self.selected else scene.objects)
                   if item.type in _KINDS]
        if not objects:
            raise ValueError("no mesh is selected" if self.selected else "the scene has no mesh")
        first, last = (scene.frame_start, scene.frame_end) if self.whole_range else (self.start, self.end)
        frames = list(range(first, last + 1, scene.frame_step))
        if not frames:
            raise ValueError(f"there is no frame from {first} to {last}")
        self._baker = Baker(objects, self.space == "WORLD", self.segments)
        self._frames, self._back_to = frames, scene.frame_current

    def _bake(self, context, index):
        context.scene.frame_set(self._frames[index])
        self._baker.add_frame(context.evaluated_depsgraph_get(), self._frames[index])

    def _encode(self, scene_options, progress):
        error = f"{self.error}%" if self.error_unit == "PERCENT" else self.error
        sources = self._baker.meshes()
        if not sources:
            raise ValueError("the objects are in no frame")
        return anicodec.encode_meshes(sources, frame_count=self._baker.frames, max_error=error, effort=self.effort,
                                      progress=progress, **scene_options)

    def _scene_options(self, scene):
        rate = scene.render.fps / scene.render.fps_base / scene.frame_step
        name = os.path.splitext(os.path.basename(self.filepath))[0]
        return {"fps": rate, "up": "z", "unit": scene.unit_settings.scale_length, "name": name}

    def _write(self, data):
        beside = self.filepath + ".part"
        with open(beside, "wb") as file:
            file.write(data)
        os.replace(beside, self.filepath)
        self.report({"INFO"}, f"{len(data)} bytes, largest error {data.measured['max_error']:.4g}, "
                              f"{data.measured['kg']:.3g} % KG")

    def execute(self, context):
        """In one go where nobody watches, else with progress and Esc."""
        try:
            self._begin(context)
            if not bpy.app.background:
                return self._run_modal(context)
            try:
                for index in range(len(self._frames)):
                    self._bake(context, index)
            finally:
                context.scene.frame_set(self._back_to)
            self._write(self._encode(self._scene_options(context.scene), None))
        except (OSError, ValueError, anicodec.AnicodecError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}

    def _run_modal(self, context):
        self._index, self._worker, self._outcome = 0, None, {}
        self._done, self._stop = 0.0, False
        self._timer = context.window_manager.event_timer_add(0.05, window=context.window)
        context.window_manager.progress_begin(0, 100)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def _work(self, options):
        try:
            self._outcome["data"] = self._encode(options, self._tell)
        except Exception as error:  # noqa: B902: reported by the thread that may
            self._outcome["error"] = error

    def _tell(self, _stage, done):
        self._done = done
        return not self._stop

    def modal(self, context, event):
        if event.type == "ESC":
            self._stop = True
            if self._worker is None:
                return self._end(context, "stopped")
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
        try:
            return self._step(context)
        except (OSError, ValueError, anicodec.AnicodecError) as error:
            return self._end(context, str(error))

    def _step(self, context):
        if self._index < len(self._frames):
            self._bake(context, self._index)
            self._index += 1
            context.window_manager.progress_update(50 * self._index / len(self._frames))
            return {"RUNNING_MODAL"}
        if self._worker is None:
            context.scene.frame_set(self._back_to)
            self._worker = threading.Thread(target=self._work, args=(self._scene_options(context.scene),))
            self._worker.start()
        if self._worker.is_alive():
            context.window_manager.progress_update(50 + 50 * self._done)
            return {"RUNNING_MODAL"}
        if "error" in self._outcome:
            return self._end(context, str(self._outcome["error"]) or "stopped")
        self._write(self._outcome["data"])
        return self._end(context, None)

    def _end(self, context, fault):
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        context.scene.frame_set(self._back_to)
        if fault is None:
            return {"FINISHED"}
        self.report({"WARNING" if self._stop else "ERROR"}, fault)
        return {"CANCELLED"}


def _menu(self, _context):
    self.layout.operator(ExportAnic.bl_idname, text="anicodec (.anic)")


def register():
    bpy.utils.register_class(ExportAnic)
    bpy.types.TOPBAR_MT_file_export.append(_menu)


def unregister():
    bpy.types.TOPBAR_MT_file_export.remove(_menu)
    bpy.utils.unregister_class(ExportAnic)
