# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Installs an extension into Blender, and takes a clip into it and out again: try_extension.py ZIP CLIP FOLDER, with bpy."""
import pathlib
import sys

import bpy

package, clip, folder = map(pathlib.Path, sys.argv[1:4])
print("Blender", bpy.app.version_string, "Python", sys.version.split()[0])
bpy.ops.wm.read_factory_settings(use_empty=True)
repositories = bpy.context.preferences.extensions.repos
name = next(repository.module for repository in repositories if not repository.use_remote_url)
print(bpy.ops.extensions.package_install_files(filepath=str(package), repo=name, enable_on_install=True))
import anicodec  # of the wheel in the extension

print("anicodec", anicodec.__version__, anicodec.__file__)
assert str(folder) in anicodec.__file__
print(bpy.ops.import_scene.anic(filepath=str(clip)))
mesh = next(thing for thing in bpy.context.scene.objects if thing.type == "MESH")
places = []
for frame in (1, 6):
    bpy.context.scene.frame_set(frame)
    shown = mesh.evaluated_get(bpy.context.evaluated_depsgraph_get())
    places.append([tuple(vertex.co) for vertex in shown.data.vertices])
moved = max(abs(a - b) for before, after in zip(*places) for a, b in zip(before, after))
print(len(places[0]), "vertices, which move by", moved)
assert moved > 0
bpy.context.scene.frame_end = 6
mesh.select_set(True)
print(bpy.ops.export_scene.anic(filepath=str(folder / "back.anic")))
print(anicodec.open(folder / "back.anic"))
