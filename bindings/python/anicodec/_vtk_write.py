# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Clips to files that VTK reads."""
from __future__ import annotations

import os
from typing import Any, Callable, Dict, List
from xml.sax.saxutils import quoteattr

import numpy as np

from ._steps import fields_of, names_of, positions_at, shown_frames, times_of, values_at
from ._vtk_poly import PolyBuilder
from .clip import Clip, Mesh

_CHUNK = 65536  #: rows of an array of HDF5 that are compressed together at most
_KINDS = {1: "Scalar", 3: "Vector", 9: "Tensor"}  #: of attributes in XDMF, by components
_TOPOLOGIES = ("Vertices", "Lines", "Polygons", "Strips")


def write_pvd(clip: Clip, path: str) -> None:
    """A collection, and beside it a folder of its name with a file for each frame and mesh."""
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

    stem = os.path.splitext(path)[0]
    os.makedirs(stem, exist_ok=True)
    lines = []
    times, names = times_of(clip), names_of(clip)
    digits = len(str(len(clip) - 1))
    for part, (name, mesh) in enumerate(zip(names, clip.meshes)):
        builder = PolyBuilder(mesh)
        for frame in shown_frames(mesh):
            file = f"{part}_{frame:0{digits}}.vtp" if len(names) > 1 else f"{frame:0{digits}}.vtp"
            writer = vtkXMLPolyDataWriter()
            writer.SetFileName(os.path.join(stem, file))
            writer.SetInputData(builder.build(frame))
            if writer.Write() != 1:
                raise OSError(5, "cannot be written", os.path.join(stem, file))
            of_mesh = f' part="{part}" name={quoteattr(name)}' if len(names) > 1 else ""
            lines.append((frame, part, f'    <DataSet timestep="{times[frame]!r}"{of_mesh} file={quoteattr(os.path.basename(stem) + "/" + file)}/>\n'))
    with open(path, "w", encoding="utf-8") as target:
        target.write('<?xml version="1.0"?>\n<VTKFile type="Collection" version="1.0">\n  <Collection>\n')
        target.writelines(line for _, _, line in sorted(lines))
        target.write("  </Collection>\n</VTKFile>\n")


def _h5(path: str) -> Any:
    try:
        import h5py
    except ImportError as error:
        raise ImportError("HDF5 needs the extra of the package: pip install 'anicodec[vtk]'") from error
    return h5py.File(path, "w", track_order=True)


def _rows(group: Any, name: str, like: np.ndarray, rows: int) -> Any:
    """A compressed array with space for rows like those of another."""
    return group.create_dataset(name, (rows, *like.shape[1:]), like.dtype, chunks=(max(1, min(len(like), _CHUNK)), *like.shape[1:]),
                                compression="gzip", compression_opts=4, shuffle=True)


def _flat(values: np.ndarray) -> np.ndarray:
    return values[:, 0] if values.shape[1] == 1 else values


def _fill(group: Any, name: str, frames: List[int], read: Callable[[int], np.ndarray]) -> None:
    """Frames below each other."""
    first = read(frames[0])
    target = _rows(group, name, first, len(first) * len(frames))
    for number, frame in enumerate(frames):
        target[number * len(first):(number + 1) * len(first)] = first if number == 0 else read(frame)


def write_vtkhdf(clip: Clip, path: str) -> None:
    """One file; polygons and fields that rest are in it once."""
    with _h5(path) as file:
        root = file.create_group("VTKHDF", track_order=True)
        root.attrs["Version"] = np.array([2, 2], np.int64)
        if len(clip.meshes) == 1:
            return _write_poly(root, clip, clip.meshes[0])
        _type(root, "PartitionedDataSetCollection")
        import h5py
        assembly = root.create_group("Assembly", track_order=True)
        for number, (name, mesh) in enumerate(zip(names_of(clip), clip.meshes)):
            key = "".join(c if c.isalnum() else "_" for c in name)
            key = key if key not in root else f"{key}_{number}"
            block = root.create_group(key, track_order=True)
            block.attrs["Version"] = np.array([2, 2], np.int64)
            block.attrs["Index"] = np.int64(number)
            _write_poly(block, clip, mesh)
            assembly.create_group(key, track_order=True)[key] = h5py.SoftLink(block.name)


def _type(group: Any, kind: str) -> None:
    group.attrs.create("Type", np.bytes_(kind), dtype=f"S{len(kind)}")


def _write_poly(group: Any, clip: Clip, mesh: Mesh) -> None:
    _type(group, "PolyData")
    shown = shown_frames(mesh)
    offsets, corners = mesh.polygons
    count = len(clip)
    # One part for all steps; where some lack the mesh each has its own, as VTK finds no other layout of these.
    parts = np.array([1] if len(shown) == count else [mesh.shown_in(frame) for frame in range(count)], np.int64)
    group["NumberOfPoints"] = parts * mesh.vertex_count
    _fill(group, "Points", shown, lambda frame: positions_at(mesh, frame))
    before = np.cumsum(parts) - parts if len(parts) > 1 else np.zeros(count, np.int64)  # parts with the mesh that lie before that of a step
    cells, ids = np.zeros((2, count, len(_TOPOLOGIES)), np.int64)
    for column, kind in enumerate(_TOPOLOGIES):
        topology, is_here = group.create_group(kind), kind == "Polygons"
        own, corner_ids = (offsets.astype(np.int64), corners.astype(np.int64)) if is_here else (np.zeros(1, np.int64), np.zeros(0, np.int64))
        topology["NumberOfCells"] = parts * (len(own) - 1)
        topology["NumberOfConnectivityIds"] = parts * len(corner_ids)
        # Readers skip a value for each part before only behind an offset above 0.
        pad = int(is_here and len(parts) > 1)
        topology["Offsets"] = np.concatenate([np.zeros(pad, np.int64), *(own if is_there else [0] for is_there in parts)])
        topology["Connectivity"] = np.tile(corner_ids, parts.sum())
        cells[:, column], ids[:, column] = pad + before * (len(own) - 1), before * len(corner_ids)
    rank = np.maximum(np.searchsorted(shown, np.arange(count), side="right") - 1, 0)  # of the step's data among those stored
    steps = group.create_group("Steps")
    steps.attrs["NSteps"] = np.int64(count)
    steps["Values"] = np.array(times_of(clip), np.float64)
    steps["PartOffsets"] = np.arange(count) if len(parts) > 1 else np.zeros(count, np.int64)
    steps["NumberOfParts"] = np.ones(count, np.int64)
    steps["PointOffsets"] = (rank * mesh.vertex_count).astype(np.int64)
    steps["CellOffsets"], steps["ConnectivityIdOffsets"] = cells, ids
    fields, _ = fields_of(mesh)
    for of_cells, name in ((False, "PointData"), (True, "CellData")):
        data, places = group.create_group(name), steps.create_group(name + "Offsets")
        for field in fields:
            if field.of_cells == of_cells:
                key = field.name.replace("/", "_")
                _fill(data, key, shown if field.moves else shown[:1], lambda frame, field=field: _flat(values_at(mesh, field, frame)))
                elements = len(offsets) - 1 if of_cells else mesh.vertex_count
                places[key] = (rank * elements * field.moves).astype(np.int64)


def write_xdmf(clip: Clip, path: str) -> None:
    """A file of text, and an .h5 file beside it with the arrays; polygons and fields that rest are in it once."""
    heavy = os.path.splitext(path)[0] + ".h5"
    names, times = names_of(clip), times_of(clip)
    grids: Dict[int, List[str]] = {frame: [] for frame in range(len(clip))}
    with _h5(heavy) as file:
        for number, (name, mesh) in enumerate(zip(names, clip.meshes)):
            group = file.create_group(f"mesh{number}")
            topology = _topology(group, mesh)
            fields, _ = fields_of(mesh)
            for frame in shown_frames(mesh):
                parts = [topology, f'<Geometry GeometryType="XYZ">{_item(group, f"positions{frame}", positions_at(mesh, frame))}</Geometry>']
                for index, field in enumerate(fields):
                    values = values_at(mesh, field, frame)
                    kind = _KINDS.get(values.shape[1])
                    key, centre = f"field{index}_{frame if field.moves else 0}", "Cell" if field.of_cells else "Node"
                    # XDMF has no place for another number of components.
                    for name_of_part, part in [(field.name, values)] if kind else [(f"{field.name}_{i}", column) for i, column in enumerate(values.T[..., None])]:
                        item = _item(group, key + name_of_part[len(field.name):], _flat(part))
                        parts.append(f'<Attribute Name={quoteattr(name_of_part)} AttributeType="{kind or "Scalar"}" Center="{centre}">{item}</Attribute>')
                inner = "\n          ".join(parts)
                grids[frame].append(f'<Grid Name={quoteattr(name)} GridType="Uniform">\n          {inner}\n        </Grid>')
    with open(path, "w", encoding="utf-8") as target:
        target.write('<?xml version="1.0"?>\n<Xdmf Version="3.0">\n  <Domain>\n    <Grid Name="steps" GridType="Collection" CollectionType="Temporal">\n')
        for frame, found in grids.items():
            moment = f'<Time Value="{times[frame]!r}"/>'
            if len(names) == 1 and found:
                found = [found[0].replace('GridType="Uniform">', f'GridType="Uniform">\n          {moment}', 1)]
            else:
                found = ['<Grid Name="step" GridType="Collection" CollectionType="Spatial">\n        ' + moment + "\n        " + "\n        ".join(found) + "</Grid>"]
            target.write("      " + "".join(found) + "\n")
        target.write("    </Grid>\n  </Domain>\n</Xdmf>\n")


def _item(group: Any, key: str, values: np.ndarray) -> str:
    """The array as an item, stored if it is not there yet."""
    if key not in group:
        _rows(group, key, values, len(values))[...] = values
    shape = " ".join(map(str, values.shape))
    kind = {"f": "Float", "i": "Int", "u": "UChar" if values.itemsize == 1 else "UInt"}[values.dtype.kind]
    return (f'<DataItem Dimensions="{shape}" NumberType="{kind}" Precision="{values.itemsize}" Format="HDF">'
            f'{os.path.basename(group.file.filename)}:{group.name}/{key}</DataItem>')


def _topology(group: Any, mesh: Mesh) -> str:
    offsets, corners = mesh.polygons
    sizes = np.diff(offsets)
    count = len(sizes)
    alike = {3: "Triangle", 4: "Quadrilateral"}.get(int(sizes[0])) if count and (sizes == sizes[0]).all() else None
    if alike is not None:
        return f'<Topology TopologyType="{alike}" NumberOfElements="{count}">{_item(group, "polygons", corners.reshape(count, -1).astype(np.int64))}</Topology>'
    if not count:
        numbers = np.arange(mesh.vertex_count, dtype=np.int64)
        return f'<Topology TopologyType="Polyvertex" NumberOfElements="{len(numbers)}" NodesPerElement="1">{_item(group, "polygons", numbers[:, None])}</Topology>'
    polygon = 3  # the number of this kind, behind which the count of corners stands
    heads = np.stack([np.full(count, polygon), sizes], axis=1).ravel()
    mixed = np.insert(corners.astype(np.int64), np.repeat(offsets[:-1].astype(np.int64), 2), heads)
    return f'<Topology TopologyType="Mixed" NumberOfElements="{count}">{_item(group, "polygons", mixed)}</Topology>'


WRITERS: Dict[str, Callable[[Clip, str], None]] = {".pvd": write_pvd, ".vtkhdf": write_vtkhdf, ".xdmf": write_xdmf}
