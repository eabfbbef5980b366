# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""File > Import."""
import math
import pathlib
import struct

import anicodec
import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, StringProperty
from bpy_extras.io_utils import ImportHelper

from . import follow, meshes

_KEY_STEP = 10.0  # evaluation time between two absolute shape keys


class ImportAnic(bpy.types.Operator, ImportHelper):
    """Import an animated mesh"""

    bl_idname = "import_scene.anic"
    bl_label = "Import .anic"
    bl_options = {"UNDO"}
    filename_ext = ".anic"
    filter_glob: StringProperty(default="*.anic", options={"HIDDEN"})
    method: EnumProperty(
        name="Animate By",
        items=[("FOLLOW", "Clip", "The mesh follows the timeline and holds no frames"),
               ("SHAPE_KEYS", "Shape Keys", "A shape key for each frame, for files that go without the add-on"),
               ("CACHE", "Mesh Cache", "A PC2 file beside the clip, and a modifier")])
    set_scene: BoolProperty(name="Set Rate and Range", description="Of the scene, as in the clip", default=True)
    pack: BoolProperty(name="Pack", description="Store the clip in the .blend file")

    def execute(self, context):
        try:
            clip = anicodec.open(self.filepath)
            add_clip(context, clip, self.filepath, self.method, self.set_scene, self.pack)
        except (OSError, anicodec.AnicodecError) as error:
            self.report({"ERROR"}, f"{self.filepath}: {error}")
            return {"CANCELLED"}
        return {"FINISHED"}


def add_clip(context, clip, path, method, set_scene, pack):
    """Adds an object for each mesh of a clip to the collection of the context."""
    scene = context.scene
    if set_scene:
        rate = clip.fps
        scene.render.fps = max(1, round(rate))
        scene.render.fps_base = scene.render.fps / float(rate)
        scene.frame_start = 1
        scene.frame_end = max(1, round(clip.duration * float(rate)) + 1)
    scene.render.use_lock_interface = True  # the handler must not run while the viewport draws
    stem = pathlib.Path(path).stem
    for number, source in enumerate(clip.meshes):
        mesh = meshes.add_mesh(source.name or stem, source)
        item = bpy.data.objects.new(mesh.name, mesh)
        if clip.info["up"] == "y":
            item.rotation_euler[0] = math.pi / 2
        if clip.info["metres_per_unit"] > 0:
            item.scale = [clip.info["metres_per_unit"] / scene.unit_settings.scale_length] * 3
        context.collection.objects.link(item)
        shown = [source.shown_in(frame) for frame in range(clip.frame_count)]
        _hide_where_absent(item, shown, clip, scene)
        _animate(item, mesh, source, clip, (path, number, shown), method, scene)
        if pack and method == "FOLLOW":
            follow.pack(mesh)
        context.view_layer.objects.active = item


def _scene_frame(clip, frame, scene):
    return 1 + clip.time(frame) * scene.render.fps / scene.render.fps_base


def _animate(item, mesh, source, clip, place, method, scene):
    path, number, shown = place
    first = shown.index(True)
    if method == "FOLLOW":
        settings = mesh.anicodec
        settings.number = number
        settings.path = path
        if not shown[0]:
            meshes.set_positions(mesh, source[first])
        follow.move(mesh, scene)
        _allow_blur(item)
        return
    frames, last = [], source[first]
    for frame, there in enumerate(shown):
        last = source[frame] if there else last
        frames.append(last)
    meshes.set_positions(mesh, frames[0])
    if method == "SHAPE_KEYS":
        _add_shape_keys(item, frames, clip, scene)
    else:
        _add_cache(item, frames, f"{path}.{number}.pc2")


def _allow_blur(item):
    """Cycles blurs the motion only of meshes with a modifier that deforms: this one turns by 0 degrees."""
    modifier = item.modifiers.new("anicodec motion blur", "SIMPLE_DEFORM")
    modifier.deform_method = "TWIST"
    modifier.angle = 0
    modifier.show_viewport = False


def _add_shape_keys(item, frames, clip, scene):
    item.shape_key_add(name="0", from_mix=False)
    keys = item.data.shape_keys
    keys.use_relative = False
    for frame, positions in enumerate(frames[1:], 1):
        item.shape_key_add(name=str(frame), from_mix=False).data.foreach_set("co", positions.ravel())
    for block in keys.key_blocks:
        block.interpolation = "KEY_LINEAR"
    for frame in (0, len(frames) - 1):
        keys.eval_time = keys.key_blocks[frame].frame
        keys.keyframe_insert("eval_time", frame=_scene_frame(clip, frame, scene))
    _set_interpolation(keys, "LINEAR")


def _add_cache(item, frames, path):
    head = b"POINTCACHE2\0" + struct.pack("<iiffi", 1, len(frames[0]), 1.0, 1.0, len(frames))
    with open(path, "wb") as file:
        file.write(head)
        for positions in frames:
            file.write(np.ascontiguousarray(positions, "<f4").tobytes())
    modifier = item.modifiers.new("anicodec", "MESH_CACHE")
    modifier.cache_format = "PC2"
    modifier.filepath = path
    modifier.frame_start = 1


def _hide_where_absent(item, shown, clip, scene):
    if all(shown):
        return
    for frame, there in enumerate(shown):
        if frame == 0 or shown[frame - 1] != there:
            item.hide_render = item.hide_viewport = not there
            for path in ("hide_render", "hide_viewport"):
                item.keyframe_insert(path, frame=_scene_frame(clip, frame, scene))


def _set_interpolation(owner, kind):
    action = owner.animation_data.action
    curves = action.fcurves if hasattr(action, "fcurves") else \
        [curve for layer in action.layers for strip in layer.strips for bag in strip.channelbags
         for curve in bag.fcurves]
    for curve in curves:
        for point in curve.keyframe_points:
            point.interpolation = kind


def _menu(self, _context):
    self.layout.operator(ImportAnic.bl_idname, text="anicodec (.anic)")


def register():
    bpy.utils.register_class(ImportAnic)
    bpy.types.TOPBAR_MT_file_import.append(_menu)


def unregister():
    bpy.types.TOPBAR_MT_file_import.remove(_menu)
    bpy.utils.unregister_class(ImportAnic)
