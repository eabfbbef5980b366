# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""File > Import."""
import math
import pathlib
import struct
from typing import NamedTuple

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
    clip: StringProperty(name="Clip", description="Name of the clip of a file with several; none: the first")
    set_scene: BoolProperty(name="Set Rate and Range", description="Rate and range of the scene follow the clip", default=True)
    pack: BoolProperty(name="Pack", description="Store the clip in the .blend file")

    def execute(self, context):
        try:
            clip = anicodec.open(self.filepath)
            chosen = clip.clips[clip.clip_number(self.clip or None)]
            add_clip(context, clip, chosen, self.filepath, self.method, self.set_scene, self.pack)
        except (OSError, anicodec.AnicodecError) as error:
            self.report({"ERROR"}, f"{self.filepath}: {error}")
            return {"CANCELLED"}
        if any(clip.info["origin"]):
            self.report({"INFO"}, f"Positions count from {clip.info['origin']}, which Blender's float32 has no digits for")
        return {"FINISHED"}


def add_clip(context, clip, chosen, path, method, set_scene, pack):
    """Adds an object for each mesh of a file to the collection of the context, with the motion of one of its clips."""
    scene = context.scene
    if set_scene:
        rate = float(chosen.fps)
        scene.render.fps = max(1, round(rate))
        scene.render.fps_base = scene.render.fps / rate
        scene.frame_start = 1
        scene.frame_end = max(1, round(chosen.duration * rate) + 1)
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
        motion = _Motion(source, chosen, [source.shown_in(f) for f in range(clip.frame_count)[chosen.frames]],
                         [_scene_frame(clip, f, scene) for f in range(clip.frame_count)[chosen.frames]])
        _hide_where_absent(item, motion)
        if method == "FOLLOW":
            settings = mesh.anicodec
            settings.number, settings.path = number, path
            settings.clip = chosen.name if len(clip.clips) > 1 else ""
            _follow(item, motion, scene)
        else:
            _store_frames(item, motion, method, f"{path}.{number}.pc2")
        if pack and method == "FOLLOW":
            follow.pack(mesh)
        context.view_layer.objects.active = item


def _scene_frame(clip, frame, scene):
    return 1 + clip.time(frame) * scene.render.fps / scene.render.fps_base


class _Motion(NamedTuple):
    """The frames of a mesh in a clip."""

    source: anicodec.Mesh
    clip: anicodec.ClipInfo
    there: list  #: whether it is, in each
    scene_frames: list

    def positions(self):
        """The positions of each frame; where the mesh is absent, as last before, or else first after."""
        last = self.source[self.clip.first_frame + self.there.index(True)]
        for number, there in enumerate(self.there):
            last = self.source[self.clip.first_frame + number] if there else last
            yield last


def _follow(item, motion, scene):
    if not motion.there[0]:
        meshes.set_positions(item.data, next(motion.positions()))
    follow.move(item.data, scene)
    _allow_blur(item)


def _store_frames(item, motion, method, cache):
    frames = list(motion.positions())
    meshes.set_positions(item.data, frames[0])
    if method == "SHAPE_KEYS":
        _add_shape_keys(item, frames, (motion.scene_frames[0], motion.scene_frames[-1]))
    else:
        _add_cache(item, frames, cache)


def _allow_blur(item):
    """Cycles blurs the motion only of meshes with a modifier that deforms: this one turns by 0 degrees."""
    modifier = item.modifiers.new("anicodec motion blur", "SIMPLE_DEFORM")
    modifier.deform_method = "TWIST"
    modifier.angle = 0
    modifier.show_viewport = False


def _add_shape_keys(item, frames, ends):
    item.shape_key_add(name="0", from_mix=False)
    keys = item.data.shape_keys
    keys.use_relative = False
    for frame, positions in enumerate(frames[1:], 1):
        item.shape_key_add(name=str(frame), from_mix=False).data.foreach_set("co", positions.ravel())
    for block in keys.key_blocks:
        block.interpolation = "KEY_LINEAR"
    for block, scene_frame in zip((keys.key_blocks[0], keys.key_blocks[-1]), ends):
        keys.eval_time = block.frame
        keys.keyframe_insert("eval_time", frame=scene_frame)
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


def _hide_where_absent(item, motion):
    if all(motion.there):
        return
    for number, there in enumerate(motion.there):
        if number == 0 or motion.there[number - 1] != there:
            item.hide_render = item.hide_viewport = not there
            for path in ("hide_render", "hide_viewport"):
                item.keyframe_insert(path, frame=motion.scene_frames[number])


def _set_interpolation(owner, kind):
    action = owner.animation_data.action
    for curve in follow.curves_of(action):
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
