# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Frames as meshes of other packages."""
from __future__ import annotations

from typing import Any

import numpy as np

PACKAGES = ("trimesh", "pyvista", "meshio")
PLAYERS = ("rerun", "k3d", "viser", "polyscope", "pyvista", "open3d")  #: which take whole clips


def to_package(mesh: Any, frame: int, package: str) -> Any:
    """A frame of a mesh as trimesh.Trimesh, pyvista.PolyData or meshio.Mesh. Raises ImportError naming the extra."""
    if package not in PACKAGES:
        raise ValueError(f"package is one of {', '.join(PACKAGES)}, or of a whole clip {', '.join(PLAYERS)}, not {package!r}")
    try:
        module = __import__(package)
    except ImportError as error:
        raise ImportError(f"{package} is missing: pip install 'anicodec[{package}]'") from error
    positions = mesh[frame]
    origin = np.asarray(mesh._clip.info["origin"])
    if origin.any():
        positions = positions + origin  # float64
    if package == "trimesh":
        return module.Trimesh(positions, mesh.triangles.astype(np.int64), process=False)
    offsets, corners = mesh.polygons
    if package == "pyvista":
        faces = np.insert(corners.astype(np.int64), offsets[:-1].astype(np.int64), np.diff(offsets).astype(np.int64))
        return module.PolyData(positions, faces)
    sizes = np.diff(offsets)
    names = {3: "triangle", 4: "quad"}
    cells = [(names.get(int(size), "polygon"), corners[np.add.outer(offsets[:-1][sizes == size], np.arange(size))])
             for size in np.unique(sizes) if size >= 3]
    return module.Mesh(positions, cells)
