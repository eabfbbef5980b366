# SPDX-License-Identifier: CC0-1.0
"""The output for tests/conformance/README.md: OUT.pc2, OUT.obj, OUT.json."""
import json
import struct
import numpy as np
from .chunks import origin_of

def told_of_look(look):
    if not look.flags:
        return None
    images = iter(look.images)
    told = {name: getattr(look, name) for name in ("base_colour", "metallic", "roughness", "emissive")}
    return {**told, "double_sided": bool(look.flags & 2), "alpha": look.flags >> 2,
            "alpha_cutoff": 0.5 if look.alpha_cutoff is None else look.alpha_cutoff,
            "textures": [next(images) if look.textures >> bit & 1 else "" for bit in range(5)]}

def told_of_attribute(attribute, mesh):
    order, values, group_of = mesh.order[attribute.domain], [[]], attribute.labels_of or attribute.entries
    if attribute.components:
        frames = attribute.values[None] if attribute.moves is None else attribute.moves.astype(np.float32)
        values = frames[:, order].reshape(len(frames), -1).tolist()
    return {"kind": attribute.kind, "domain": attribute.domain, "components": attribute.components or 0,
            "name": attribute.name, "labels": attribute.labels or [], "moves": attribute.moves is not None,
            "groups": [] if attribute.components else [group_of[element] for element in order],
            "looks": [told_of_look(look) for look in attribute.looks or []], "values": values}

def told_of_mesh(mesh):
    there = mesh.frames[~np.isnan(mesh.frames[:, 0, 0])].reshape(-1, 3)
    told = {"name": mesh.name, "low": there.min(0).tolist(), "high": there.max(0).tolist(),
            "attributes": [told_of_attribute(attribute, mesh) for attribute in mesh.attributes]}
    return {**told, "boxes": mesh.boxes} if any(mesh.boxes) else told

def told_of_clip(clip, root, frames):
    even = [f * clip.rate_denominator / clip.rate_numerator for f in range(frames)]
    names = "rate_assumed", "loop", "closed", "massaged"
    flags = {name: bool(clip.flags >> bit & 1) for bit, name in enumerate(names)}
    errors = [list(vars(error).values()) for error in clip.attribute_errors or []]
    stored = ("name", "start_time", "asked", "asked_value", "max_error", "rmse", "kg", "max_displacement_error", "diagonal")
    told = {**{name: getattr(clip, name) for name in stored}, **flags, "frames": frames, "root": root,
            "rate": [clip.rate_numerator, clip.rate_denominator],
            "times": clip.times or even, "attribute_errors": errors, "surface_error": clip.surface_error or 0,
            "surface_error_mean": clip.surface_error_mean or 0,
            "events": clip.events and [list(vars(event).values()) for event in clip.events]}
    return {name: value for name, value in told.items() if value is not None}

def tell(decoded):
    """OUT.json."""
    told = {name: getattr(decoded.clip, name) for name in ("encoder", "up", "order", "metres_per_unit")}
    clips = zip(decoded.clip.clips, decoded.roots, decoded.clip_frames)
    told["clips"] = [told_of_clip(*each) for each in clips]
    told["meshes"] = [told_of_mesh(mesh) for mesh in decoded.meshes]
    if any(origin := origin_of(decoded.clip.optional)):
        told["origin"] = origin
    return told if decoded.metadata is None else {**told, "metadata": decoded.metadata}

def write(out, decoded):
    for number, mesh in enumerate(decoded.meshes):
        stem, (frames, vertices, _) = f"{out}.{number}" if number else out, mesh.frames.shape
        with open(f"{stem}.pc2", "wb") as file:
            file.write(b"POINTCACHE2\0" + struct.pack("<iiffi", 1, vertices, 0.0, 1.0, frames))
            file.write(mesh.frames.astype("<f4").tobytes())
        with open(f"{stem}.obj", "w", encoding="ascii") as file:
            file.writelines("v {} {} {}\n".format(*position) for position in mesh.frames[0].tolist())
            file.writelines("f" + "".join(f" {v + 1}" for v in polygon) + "\n" for polygon in mesh.polygons)
    with open(f"{out}.json", "w", encoding="ascii") as file:
        json.dump(tell(decoded), file)
