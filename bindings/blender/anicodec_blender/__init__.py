# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Import and export of .anic files: animated meshes that follow the timeline."""
bl_info = {
    "name": "anicodec (.anic)",
    "description": "Import and export compressed animated meshes",
    "author": "The anicodec authors",
    "version": (1, 0, 0),
    "blender": (3, 4, 0),
    "location": "File > Import-Export",
    "category": "Import-Export",
}

from . import exporter, follow, importer  # noqa: E402


def register():
    follow.register()
    importer.register()
    exporter.register()


def unregister():
    exporter.unregister()
    importer.unregister()
    follow.unregister()
