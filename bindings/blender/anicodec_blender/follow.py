# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Meshes that follow the timeline: the settings of each, and the handler that moves them."""
import hashlib
import os

import anicodec
import bpy
from bpy.app.handlers import persistent
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from . import meshes

_DATA = "anicodec_data"  # bytes of the file, in a mesh that carries them
_clips = {}  # by what was opened: path, time and size, or the hash of packed bytes


def _changed(settings, _context):
    move(settings.id_data, bpy.context.scene)


def _clip_names(settings, _context, _typed):
    try:
        return [info.name for info in clip_of(settings.id_data).clips]
    except (OSError, anicodec.AnicodecError):
        return []


class AnicodecSettings(bpy.types.PropertyGroup):
    """How a mesh follows the timeline. It stays with the mesh: saved, appended and undone with it."""

    path: StringProperty(name="File", subtype="FILE_PATH", update=_changed)
    number: IntProperty(name="Mesh", description="Number of the mesh in the file", min=0, update=_changed)
    clip: StringProperty(name="Clip", description="Clip of a file with several; none: the first", update=_changed,
                         search=_clip_names)
    start: FloatProperty(name="Start", description="Frame of the scene that shows the first frame", default=1,
                         update=_changed)
    offset: FloatProperty(name="Offset", description="Seconds of the clip that are skipped", update=_changed)
    speed: FloatProperty(name="Speed", description="Negative: backwards", default=1, update=_changed)
    wrap: EnumProperty(name="Outside", items=[("clamp", "Hold", "The first and the last frame stay"),
                                              ("loop", "Loop", "The clip begins again"),
                                              ("ping-pong", "Ping-pong", "The clip goes back and forth")],
                       update=_changed)
    sampling: EnumProperty(name="Between Frames", items=[("linear", "Linear", ""), ("step", "Step", ""),
                                                         ("cubic", "Smooth", "")], update=_changed)
    fade_clip: StringProperty(name="Fade To", description="Clip that fades in", update=_changed, search=_clip_names)
    fade_start: FloatProperty(name="Its Start", description="Frame of the scene that shows the first frame of the clip "
                              "that fades in", default=1, update=_changed)
    fade: FloatProperty(name="Fade", description="How far it has: 0 shows nothing of it, 1 it alone; to be animated",
                        min=0, max=1, subtype="FACTOR", update=_changed)
    paused: BoolProperty(name="Paused", description="The mesh stays as it is", update=_changed)


def is_clip(mesh):
    return bool(mesh.anicodec.path) or _DATA in mesh


def pack(mesh):
    """Puts the bytes of the file into the .blend, and forgets the path."""
    mesh[_DATA] = clip_of(mesh).data
    mesh.anicodec.path = ""


def clip_of(mesh):
    """The opened clip of a mesh. Raises OSError, anicodec.AnicodecError."""
    if _DATA in mesh:
        data = bytes(mesh[_DATA])
        key = hashlib.sha256(data).digest()
        return _opened(key, data)
    path = bpy.path.abspath(mesh.anicodec.path, library=mesh.library)
    status = os.stat(path)
    return _opened((path, status.st_mtime_ns, status.st_size), path)


def _opened(key, source):
    if key not in _clips:
        _clips[key] = anicodec.open(source)
    return _clips[key]


def clip_time(settings, scene, start):
    """Seconds of a clip that starts at a frame of the scene, at the scene's, parts of a frame included."""
    rate = scene.render.fps / scene.render.fps_base
    return (scene.frame_current_final - start) / rate * settings.speed


def curves_of(action):
    """The curves of an action of any version of Blender."""
    return action.fcurves if hasattr(action, "fcurves") else \
        [curve for layer in action.layers for strip in layer.strips for bag in strip.channelbags
         for curve in bag.fcurves]


def _fade(mesh, scene):
    """How far another clip fades in. Blender evaluates animation after the handler, so its curve is asked."""
    animation = mesh.animation_data
    curves = curves_of(animation.action) if animation and animation.action else ()
    curve = next((curve for curve in curves if curve.data_path == "anicodec.fade"), None)
    return mesh.anicodec.fade if curve is None else min(max(curve.evaluate(scene.frame_current_final), 0), 1)


def shown(mesh, scene):
    """The moment that a mesh shows in the scene's frame: arguments of anicodec.Mesh.at()."""
    settings = mesh.anicodec
    moment = {"seconds": clip_time(settings, scene, settings.start) + settings.offset, "wrap": settings.wrap,
              "sampling": settings.sampling, "clip": settings.clip or None}
    if settings.fade_clip:
        moment["blend"] = (settings.fade_clip, clip_time(settings, scene, settings.fade_start), _fade(mesh, scene))
    return moment


def move(mesh, scene):
    """Moves the vertices of a mesh to the scene's frame. A fault is printed, and the mesh stays."""
    settings = mesh.anicodec
    if settings.paused or not is_clip(mesh):
        return
    try:
        source = clip_of(mesh).meshes[settings.number]
        if source.vertex_count != len(mesh.vertices):
            raise ValueError(f"the clip has {source.vertex_count} vertices, the mesh {len(mesh.vertices)}")
        positions = source.at(**shown(mesh, scene))
    except anicodec.AbsentError:
        return  # its object is hidden then
    except (OSError, ValueError, IndexError, anicodec.AnicodecError) as error:
        print(f"anicodec: {mesh.name}: {error}")
        return
    meshes.set_positions(mesh, positions)


@persistent
def follow(scene, _depsgraph=None):
    """Before a frame is evaluated, in viewport and render alike."""
    for mesh in bpy.data.meshes:
        if mesh.users > 0 and is_clip(mesh):
            move(mesh, scene)


@persistent
def forget(*_):
    """Another file was opened: closes the clips, and moves the meshes of the new one."""
    _clips.clear()
    if bpy.context.scene:
        follow(bpy.context.scene)


class AnicodecPack(bpy.types.Operator):
    """Store the clip in the .blend file"""

    bl_idname = "mesh.anicodec_pack"
    bl_label = "Pack Clip"
    bl_options = {"UNDO"}

    @classmethod
    def poll(cls, context):
        return context.object and context.object.type == "MESH" and context.object.data.anicodec.path

    def execute(self, context):
        try:
            pack(context.object.data)
        except (OSError, anicodec.AnicodecError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class AnicodecPanel(bpy.types.Panel):
    """How the mesh follows the timeline"""

    bl_idname = "DATA_PT_anicodec"
    bl_label = "anicodec"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "data"

    @classmethod
    def poll(cls, context):
        return context.object and context.object.type == "MESH" and is_clip(context.object.data)

    def draw(self, context):
        layout, mesh = self.layout, context.object.data
        layout.use_property_split = True
        for name in ("path", "number", "clip", "start", "offset", "speed", "wrap", "sampling", "paused"):
            layout.prop(mesh.anicodec, name)
        if len(_clip_names(mesh.anicodec, context, "")) > 1:
            for name in ("fade_clip", "fade_start", "fade"):
                layout.prop(mesh.anicodec, name)
        layout.operator(AnicodecPack.bl_idname)


_CLASSES = (AnicodecSettings, AnicodecPack, AnicodecPanel)


def register():
    for cls in _CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Mesh.anicodec = PointerProperty(type=AnicodecSettings)
    bpy.app.handlers.frame_change_pre.append(follow)
    bpy.app.handlers.load_post.append(forget)


def unregister():
    bpy.app.handlers.load_post.remove(forget)
    bpy.app.handlers.frame_change_pre.remove(follow)
    del bpy.types.Mesh.anicodec
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
    _clips.clear()
