# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""USD: meshes of a stage to a clip, and back. Needs the extra: pip install 'anicodec[usd]'.

Importing it makes .anic files layers of this process, by the plug-in of bindings/usd, if it comes before the first stage is opened.
"""
from __future__ import annotations

import os
from typing import Any, Dict, List, Sequence, Union

import numpy as np

try:
    from pxr import Usd, UsdGeom
except ImportError as error:
    raise ImportError("USD needs the extra of the package: pip install 'anicodec[usd]'") from error

from . import _usd_plugin
from ._usd_meshes import Extent, MeshReader, places
from ._usd_stage import bake_skins, opened, other_variants, resting_skins, snapped_rate, time_codes, warnings_as_notes
from ._usd_write import decode
from .encoder import Encoded, _origin, encode_meshes
from .errors import InputError

__all__ = ["decode", "encode"]
_usd_plugin.register()


def encode(stage: Union[str, os.PathLike, Usd.Stage], prims: Union[None, str, Sequence[str]] = None, *,
           fps: Any = None, topology_changes: str = "refuse", **options: Any) -> Encoded:
    """Encodes the meshes of a stage, in world space.

    stage: a stage or the path of one. prims: paths; their meshes and all below them. Skins and blend shapes are baked.
    fps: frames per second; default the stage's, one for each time code, or more where samples stand between them, from the
    stage's start to its end; samples that no such rate meets are frames of their own. Texture coordinates, colours, other
    numbers (those that meshes inherit, too), hard edges, materials (values and names of images of UsdPreviewSurface), parts and
    visibility are kept; each instance of a PointInstancer is a mesh. Paths of prims and time codes stay in the metadata, as "usd",
    for decode() and for the plug-in of USD. `notes` of the result names what else the stage has, and what USD warns of.
    topology_changes: "refuse", or "keep" to store a mesh for each run of frames with equal faces. Other options are those of
    encode().

    Raises InputError naming the prim, and what encode() raises.
    """
    if topology_changes not in ("refuse", "keep"):
        raise InputError(f"topology_changes is 'refuse' or 'keep', not {topology_changes!r}")
    notes: List[str] = []
    with warnings_as_notes(notes):
        return _encode(stage, prims, fps, topology_changes == "keep", notes, options)


def _encode(stage: Any, prims: Union[None, str, Sequence[str]], fps: Any, keep_changes: bool, notes: List[str], options: Dict[str, Any]) -> Encoded:
    source = opened(stage)
    codes, rate, even = time_codes(source, fps, notes)
    baked = bake_skins(source, codes, float(rate))
    left_out: Dict[str, int] = {}
    extent = Extent()
    readers = [MeshReader(place, codes, left_out, extent) for place in places(baked, prims, codes, left_out)]
    read = [(mesh, reader.path) for reader in readers for mesh in reader.read(keep_changes)]
    if not read:
        raise InputError("the stage has no mesh that is visible")
    origin = _origin(options.get("origin", "auto"))
    if origin is None:
        extent.move_origin()
    else:
        extent.origin = np.array(origin)
    options["origin"] = extent.origin.tolist()
    per_second = float(snapped_rate(baked.GetTimeCodesPerSecond()))
    options.setdefault("up", "z" if UsdGeom.GetStageUpAxis(baked) == UsdGeom.Tokens.z else "y")
    options.setdefault("unit", UsdGeom.GetStageMetersPerUnit(baked))
    options.setdefault("start_time", codes[0] / per_second)
    options.setdefault("name", os.path.splitext(os.path.basename(source.GetRootLayer().GetDisplayName()))[0])
    if not even:
        options.setdefault("times", [(code - codes[0]) / per_second for code in codes])
    about: Dict[str, Any] = {"prims": [path for _, path in read]}
    if baked.GetTimeCodesPerSecond() != float(rate):
        about["timeCodesPerSecond"] = baked.GetTimeCodesPerSecond()
    if source.HasDefaultPrim():
        about["defaultPrim"] = source.GetDefaultPrim().GetName()
    options["metadata"] = {"usd": about, **(options.get("metadata") or {})}
    result = encode_meshes([mesh for mesh, _ in read], frame_count=len(codes), fps=rate, **options)
    notes.extend(other_variants(source) + resting_skins(source))
    if UsdGeom.GetStageUpAxis(baked) not in (UsdGeom.Tokens.y, UsdGeom.Tokens.z):
        notes.append(f"the up axis {UsdGeom.GetStageUpAxis(baked)} is taken for Y")
    if left_out:
        notes.append("not kept: " + ", ".join(f"{count} {kind}" if count else kind for kind, count in left_out.items()))
    result.notes = notes
    return result
