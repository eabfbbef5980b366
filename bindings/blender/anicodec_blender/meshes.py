# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Meshes of clips as meshes of Blender, and back."""
import numpy as np

import bpy

from . import looks


def add_mesh(name, source):
    """A new mesh with the polygons and attributes of a mesh of a clip; its vertices are all at the origin."""
    mesh = bpy.data.meshes.new(name)
    offsets, corners = source.polygons
    sizes = np.diff(offsets)
    kept = sizes >= 3  # Blender has no others
    corner_kept = np.repeat(kept, sizes)
    starts = np.concatenate([[0], np.cumsum(sizes[kept])[:-1]]) if kept.any() else np.zeros(0)
    mesh.vertices.add(source.vertex_count)
    mesh.loops.add(int(sizes[kept].sum()))
    mesh.polygons.add(int(kept.sum()))
    mesh.loops.foreach_set("vertex_index", corners[corner_kept].astype(np.int32))
    mesh.polygons.foreach_set("loop_start", starts.astype(np.int32))
    if bpy.app.version < (4, 0, 0):
        mesh.polygons.foreach_set("loop_total", sizes[kept].astype(np.int32))
    mesh.polygons.foreach_set("use_smooth", np.ones(int(kept.sum()), bool))
    mesh.update(calc_edges=True)
    for attribute in source.attributes:
        _add_attribute(mesh, attribute, kept, corner_kept)
    mesh.update()
    return mesh


def _add_attribute(mesh, attribute, kept, corner_kept):
    corner_vertices = corners_of(mesh)
    if attribute.domain == "vertices":
        of_corners = attribute.values[corner_vertices]
    elif attribute.domain == "corners":
        of_corners = attribute.values[corner_kept]
    elif attribute.values.ndim == 2:
        of_corners = np.repeat(attribute.values[kept], [polygon.loop_total for polygon in mesh.polygons], axis=0)
    if attribute.kind == "uv":
        layer = mesh.uv_layers.new(name=attribute.name or "UVMap")
        layer.data.foreach_set("uv", np.ascontiguousarray(of_corners, np.float32).ravel())
    elif attribute.kind == "colour":
        domain, values = ("POINT", attribute.values) if attribute.domain == "vertices" else ("CORNER", of_corners)
        layer = mesh.color_attributes.new(attribute.name or "Colour", "FLOAT_COLOR", domain)
        rgba = np.ones((len(values), 4), np.float32)
        rgba[:, :values.shape[1]] = values
        layer.data.foreach_set("color", rgba.ravel())
    elif attribute.kind == "normal" and attribute.domain == "corners":
        _mark_hard_edges(mesh, of_corners)
    elif attribute.kind == "material":
        for label, look in zip(attribute.labels, attribute.looks):
            mesh.materials.append(bpy.data.materials.get(label) or _new_material(label, look))
        numbers = np.maximum(attribute.values[kept].astype(np.int32) - 1, 0)
        mesh.polygons.foreach_set("material_index", numbers)


def _new_material(name, look):
    material = bpy.data.materials.new(name)
    if look is not None:
        looks.apply(material, look)
    return material


def corners_of(mesh):
    """Vertex of each corner."""
    corners = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    return corners


def polygon_starts(mesh):
    """First corner of each polygon, and the number of all corners behind them."""
    starts = np.empty(len(mesh.polygons), np.int32)
    mesh.polygons.foreach_get("loop_start", starts)
    return np.append(starts, len(mesh.loops)).astype(np.uint32)


def _mark_hard_edges(mesh, normals):
    """Edges are hard on whose two sides the corners of a vertex do not share a normal."""
    if normals.ndim == 2:  # numbers: the same ones are the same normal
        normals = np.unique(normals, axis=0, return_inverse=True)[1].ravel()
    count = len(mesh.loops)
    edges = np.empty(count, np.int32)
    mesh.loops.foreach_get("edge_index", edges)
    starts = polygon_starts(mesh)
    following = np.arange(1, count + 1)
    following[starts[1:] - 1] = starts[:-1]
    vertices = corners_of(mesh)
    ends = np.concatenate([np.stack([edges, vertices, normals], axis=1),
                           np.stack([edges, vertices[following], normals[following]], axis=1)]).astype(np.int64)
    distinct = np.unique(ends, axis=0)
    same_end = (distinct[1:, :2] == distinct[:-1, :2]).all(axis=1)
    sharp = np.zeros(len(mesh.edges), bool)
    sharp[distinct[1:][same_end][:, 0]] = True
    mesh.edges.foreach_set("use_edge_sharp", sharp)
    if sharp.any() and hasattr(mesh, "use_auto_smooth"):
        mesh.use_auto_smooth = True
        mesh.auto_smooth_angle = np.pi


def set_positions(mesh, positions):
    """Moves the vertices: vertices x 3, float32."""
    mesh.vertices.foreach_set("co", positions.ravel())
    mesh.update()


def positions_of(mesh):
    """Vertices x 3, float32."""
    positions = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", positions)
    return positions.reshape(-1, 3)


def turned_order(starts):
    """The corners of polygons in the order that turns each over, about its first corner."""
    order = np.arange(starts[-1], dtype=np.int64)
    counts = np.diff(starts.astype(np.int64))
    begins = np.repeat(starts[:-1].astype(np.int64), counts)
    return np.where(order == begins, order, 2 * begins + np.repeat(counts, counts) - order)


def attributes_of(mesh, turned=False):
    """Data to encode beside positions: arguments of SourceMesh. turned: for polygons that are turned over."""
    order = turned_order(polygon_starts(mesh)) if turned else slice(None)
    result = {"uv": {}, "colours": {}}
    for layer in mesh.uv_layers:
        values = np.empty(2 * len(layer.data), np.float32)
        layer.data.foreach_get("uv", values)
        result["uv"][layer.name] = values.reshape(-1, 2)[order]
    for layer in mesh.color_attributes:
        values = np.empty(4 * len(layer.data), np.float32)
        layer.data.foreach_get("color", values)
        of_corners = layer.domain == "CORNER"
        result["colours"][layer.name] = np.clip(values.reshape(-1, 4), 0, 1)[order if of_corners else slice(None)]
    if len(mesh.loops) > 0:
        result["normals"] = _corner_normals(mesh)[order]
    names = [material.name if material else "" for material in mesh.materials]
    if names and len(mesh.polygons) > 0:
        numbers = np.empty(len(mesh.polygons), np.int32)
        mesh.polygons.foreach_get("material_index", numbers)
        result["materials"] = (names, np.minimum(numbers, len(names) - 1),
                               [looks.look_of(material) for material in mesh.materials])
    return result


def _corner_normals(mesh):
    values = np.empty(3 * len(mesh.loops), np.float32)
    if hasattr(mesh, "corner_normals"):
        mesh.corner_normals.foreach_get("vector", values)
    else:
        mesh.calc_normals_split()
        mesh.loops.foreach_get("normal", values)
    return values.reshape(-1, 3)
