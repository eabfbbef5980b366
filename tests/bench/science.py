#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Results of simulations against other ways to store them, at one largest error: science.py [--clips] [--made] [--fields] [--seek]

Without arguments all of it. It runs in a Python with anicodec, numpy, zfpy and pysz; scikit-fem makes some of the data, and h5py, vtk, pyvista-zstd and
bodycompress are measured where they are installed; nothing is installed here. --clips needs the folder of real clips, $ANICODEC_DATA.

A largest error is that of any single number. Ours bounds the distance of a vertex, the root of 3 times as far. Peers get the layout
that suits them best of those tried; SZ3 once more an image for each step where points are those of a grid. Bytes of a field are those that a file has more with it.
"""
import argparse
import importlib.metadata
import io
import os
import pathlib
import statistics
import struct
import tempfile
import time

import numpy as np

import anicodec

POINTS = 5e-4  # of the diagonal: the largest distance of a vertex
FIELD = 1e-3  # of the range of a field
EFFORT = "normal"
CLIPS = ("classic/dance", "classic/horse", "simulated/flag", "captured/face", "classic/chicken")


def version(name):
    try:
        return importlib.metadata.version(name)
    except importlib.metadata.PackageNotFoundError:
        return None


# ---- what peers make of numbers


def layouts(values):
    """The ways to give frames x points x components to a compressor of arrays, as lists of arrays."""
    components = values.shape[2]
    single = [values[:, :, c] for c in range(components)]
    found = {"f,p": single, "p,f": [x.T for x in single]}
    if components > 1:
        found["f,p,c"] = [values]
    return [[np.ascontiguousarray(x, dtype=np.float32) for x in arrays] for arrays in found.values()]


def sz3(arrays, bound):
    from pysz import sz, szConfig, szErrorBoundMode
    size = 0
    for x in arrays:
        settings = szConfig(x.shape)
        settings.errorBoundMode = szErrorBoundMode.ABS
        settings.absErrorBound = bound
        data, _ = sz.compress(x, settings)
        back, _ = sz.decompress(data, np.float32, x.shape)
        if np.abs(np.asarray(back).reshape(x.shape) - x).max() > bound * 1.0001:
            return None
        size += data.nbytes
    return size


def zfp(arrays, bound):
    """At the largest tolerance that keeps the error, which its own bound exceeds by far."""
    import zfpy
    low, high, best = bound / 4, bound * 16, None
    for _ in range(10):
        tolerance = (low * high) ** 0.5
        packed = [zfpy.compress_numpy(x, tolerance=tolerance) for x in arrays]
        error = max(np.abs(zfpy.decompress_numpy(data) - x).max() for data, x in zip(packed, arrays))
        if error <= bound:
            best, low = sum(map(len, packed)), tolerance
        else:
            high = tolerance
    return best


def npz(values):
    stream = io.BytesIO()
    np.savez_compressed(stream, values=values.astype(np.float32))
    return len(stream.getvalue())


def hdf5(values):
    """The HDF5 file that XDMF points to: a data set for each step, shuffled and deflated."""
    import h5py
    stream = io.BytesIO()
    with h5py.File(stream, "w") as file:
        for number, step in enumerate(values.astype(np.float32)):
            file.create_dataset(f"step{number}", data=step, compression="gzip", compression_opts=9, shuffle=True)
    return len(stream.getvalue())


def vtkhdf(points, faces, field, folder):
    """A temporal .vtkhdf of points that move, or of a field over a mesh that is written once."""
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
    from vtkmodules.vtkIOHDF import vtkHDFWriter
    frames = len(points if field is None else field)
    place = vtkPoints()
    place.SetData(numpy_to_vtk(points[0], deep=1))
    cells = vtkCellArray()
    cells.SetData(numpy_to_vtkIdTypeArray(np.arange(0, faces.size + 1, faces.shape[1]), deep=1),
                  numpy_to_vtkIdTypeArray(faces.astype(np.int64).ravel(), deep=1))

    class Source(VTKPythonAlgorithmBase):
        def __init__(self):
            super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkPolyData")

        def RequestInformation(self, request, inputs, outputs):
            keys = vtkStreamingDemandDrivenPipeline
            information = outputs.GetInformationObject(0)
            information.Set(keys.TIME_STEPS(), [float(f) for f in range(frames)], frames)
            information.Set(keys.TIME_RANGE(), [0.0, frames - 1.0], 2)
            return 1

        def RequestData(self, request, inputs, outputs):
            key = vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP()
            information = outputs.GetInformationObject(0)
            frame = int(information.Get(key)) if information.Has(key) else 0
            mesh = vtkPolyData.GetData(outputs)
            if len(points) > 1:  # else the mesh stays, and is written once
                place.SetData(numpy_to_vtk(points[frame], deep=1))
            mesh.SetPoints(place)
            mesh.SetPolys(cells)
            if field is not None:
                values = numpy_to_vtk(np.ascontiguousarray(field[frame, :, 0]), deep=1)
                values.SetName("field")
                mesh.GetPointData().AddArray(values)
            return 1

    writer = vtkHDFWriter()
    source = Source()
    path = pathlib.Path(folder) / "peer.vtkhdf"
    writer.SetInputConnection(source.GetOutputPort())
    writer.SetFileName(str(path))
    writer.SetWriteAllTimeSteps(True)
    writer.SetCompressionLevel(9)
    writer.Write()
    return path.stat().st_size


def pyvista_zstd(points, faces, field, folder):
    """A file for each step: the first with the faces, the others points or a field alone."""
    import pyvista
    import pyvista_zstd as package
    size = 0
    for number in range(len(points if field is None else field)):
        if number == 0:
            sides = [corner for face in faces for corner in (len(face), *face)]
            mesh = pyvista.PolyData(points[0], faces=np.array(sides))
        else:
            mesh = pyvista.PolyData(points[number] if field is None else points[0][:0])
        if field is not None:
            mesh.field_data["field"] = np.ascontiguousarray(field[number, :, 0])
        path = pathlib.Path(folder) / "peer.pv"
        package.write(mesh, path, level=19, shuffle=True)
        size += path.stat().st_size
    return size


def bodycompress(points, bound, folder):
    """Coordinates as multiples of twice the bound, whatever its name says of millimetres."""
    from bodycompress import BodyCompressor, BodyDecompressor
    path, unit = str(pathlib.Path(folder) / "peer.xz"), 1 / (2 * bound)  # a multiple is 1 mm
    with BodyCompressor(path, quantization_mm=1.0, compression_level=9, vertex_order=None) as file:
        for step in points:
            file.append(vertices=step.astype(np.float64) * unit)
    for step, back in zip(points, BodyDecompressor(path)):
        if np.abs(back["vertices"] / unit - step).max() > bound * 1.001:
            return None
    return os.path.getsize(path)


# ---- data


def read_clip(name):
    folder = pathlib.Path(os.environ["ANICODEC_DATA"])
    data = (folder / f"{name}.pc2").read_bytes()
    vertices, frames = struct.unpack_from("<i", data, 16)[0], struct.unpack_from("<i", data, 28)[0]
    points = np.frombuffer(data, "<f4", offset=32, count=frames * vertices * 3).reshape(frames, vertices, 3)
    lines = (line.split()[1:] for line in (folder / f"{name}.obj").read_text(encoding="utf-8").splitlines() if line.startswith("f "))
    faces = [[int(corner.split("/")[0]) - 1 for corner in line] for line in lines]
    return points, np.array(faces) if len(set(map(len, faces))) == 1 else faces


def newmark(mass, damping, stiffness, free, start, force, steps, dt):
    """Displacements of the free unknowns at each step: constant average acceleration, from rest."""
    from scipy.sparse.linalg import factorized
    m, c, k = (matrix[free][:, free].tocsc() for matrix in (mass, damping, stiffness))
    solve = factorized((m + dt / 2 * c + dt * dt / 4 * k).tocsc())
    u, v = start[free].copy(), np.zeros(len(free))
    a = factorized(m)(force(0)[free] - k @ u)
    found = [start.copy()]
    for step in range(1, steps):
        guess, speed = u + dt * v + dt * dt / 4 * a, v + dt / 2 * a
        a = solve(force(step * dt)[free] - c @ speed - k @ guess)
        u, v = guess + dt * dt / 4 * a, speed + dt / 2 * a
        whole = np.zeros_like(start)
        whole[free] = u
        found.append(whole)
    return np.array(found)


def cantilever(steps=300):
    """Surface and von Mises stress of an elastic beam (scikit-fem) whose end is pulled aside, let go, and knocked."""
    import skfem
    from skfem.helpers import ddot, dot, eye, sym_grad, trace
    from skfem.models.elasticity import lame_parameters
    mesh = skfem.MeshHex.init_tensor(np.linspace(0, 4, 41), np.linspace(0, 0.5, 7), np.linspace(0, 0.4, 6))
    basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementHex1()))
    lam, mu = lame_parameters(200.0, 0.3)

    def stress(strain):
        return 2 * mu * strain + lam * eye(trace(strain), 3)

    stiffness = skfem.BilinearForm(lambda u, v, w: ddot(stress(sym_grad(u)), sym_grad(v))).assemble(basis)
    mass = skfem.BilinearForm(lambda u, v, w: dot(u, v)).assemble(basis)
    tip = basis.get_dofs(lambda x: np.isclose(x[0], 4)).all("u^3")
    side = basis.get_dofs(lambda x: np.isclose(x[0], 4)).all("u^2")
    free = basis.complement_dofs(basis.get_dofs(lambda x: np.isclose(x[0], 0)))
    pull, knock = np.zeros(basis.N), np.zeros(basis.N)
    pull[tip], knock[side] = 0.03 / len(tip), 0.6 / len(side)
    start = skfem.solve(*skfem.condense(stiffness, pull, I=free))
    found = newmark(mass, 2e-4 * stiffness + 0.02 * mass, stiffness, free, start,
                    lambda t: knock if 3.0 < t < 3.1 else 0 * knock, steps, 0.08)
    scalar = skfem.Basis(mesh, skfem.ElementHex1())
    quadrature = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementHex1()), intorder=2)
    at_points = skfem.Basis(mesh, skfem.ElementHex1(), intorder=2)
    weights = skfem.BilinearForm(lambda u, v, w: u * v).assemble(scalar)
    from scipy.sparse.linalg import factorized
    project = factorized(weights.tocsc())
    mises = []
    for u in found:
        gradient = quadrature.interpolate(u).grad
        s = stress((gradient + np.swapaxes(gradient, 0, 1)) / 2)
        deviator = s - eye(trace(s), 3) / 3
        value = np.sqrt(1.5 * ddot(deviator, deviator))
        mises.append(project(skfem.LinearForm(lambda v, w: w["value"] * v).assemble(at_points, value=value)))
    facets = mesh.facets[:, mesh.boundary_facets()].T
    used, corners = np.unique(facets, return_inverse=True)
    rest = mesh.p.T[used]
    moved = found[:, basis.nodal_dofs.T[used]]
    return (rest + moved).astype(np.float32), corners.reshape(-1, 4), {"von Mises stress": np.array(mises)[:, used, None]}


def drum(steps=300):
    """A round membrane (scikit-fem) that is struck off its centre twice: it moves, and its speed is a field."""
    import skfem
    from skfem.helpers import dot, grad
    mesh = skfem.MeshTri.init_circle(5)
    basis = skfem.Basis(mesh, skfem.ElementTriP1())
    stiffness = skfem.BilinearForm(lambda u, v, w: dot(grad(u), grad(v))).assemble(basis)
    mass = skfem.BilinearForm(lambda u, v, w: u * v).assemble(basis)
    free = basis.complement_dofs(basis.get_dofs())
    hit = mass @ np.exp(-60 * ((mesh.p[0] - 0.3) ** 2 + (mesh.p[1] - 0.2) ** 2))
    dt = 0.03
    found = newmark(mass, 0.15 * mass + 1e-3 * stiffness, stiffness, free, np.zeros(basis.N),
                    lambda t: 12 * hit if t < 0.15 or 3 < t < 3.15 else 0 * hit, steps, dt)
    points = np.repeat(np.vstack([mesh.p, 0 * mesh.p[:1]]).T[None], steps, 0)
    points[:, :, 2] = found
    return points.astype(np.float32), mesh.t.T, {"speed": np.gradient(found, dt, axis=0)[:, :, None]}


def plate(side=96, steps=300):
    """A heated plate: a torch moves over it; what was hotter than it melts at stays molten, and a crack grows."""
    x, y = np.meshgrid(np.linspace(0, 1, side), np.linspace(0, 1, side))
    heat = np.full((side, side), 20.0)
    fields = {"temperature": [], "molten": [], "damage": []}
    molten = np.zeros((side, side))
    for step in range(steps):
        t = step / steps
        for _ in range(8):
            torch = 90 * np.exp(-((x - 0.5 - 0.32 * np.cos(7 * t)) ** 2 + (y - 0.5 - 0.32 * np.sin(9 * t)) ** 2) / 0.002)
            around = np.pad(heat, 1, mode="edge")
            heat = heat + 0.2 * (around[2:, 1:-1] + around[:-2, 1:-1] + around[1:-1, 2:] + around[1:-1, :-2] - 4 * heat) \
                + 0.2 * torch - 0.0015 * (heat - 20)
        molten = np.maximum(molten, heat > 500)
        path = 0.5 + 0.12 * np.sin(9 * x)
        away = np.hypot(np.maximum(x - 0.9 * t, 0), y - path)
        fields["temperature"].append(heat.ravel())
        fields["molten"].append(molten.ravel())
        fields["damage"].append(np.exp(-away / 0.008).ravel())
    number = np.arange(side * side).reshape(side, side)
    faces = np.stack([number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]], -1).reshape(-1, 4)
    points = np.stack([x, y, 0 * x], -1).reshape(1, -1, 3).astype(np.float32)
    return points, faces, {name: np.array(values)[:, :, None] for name, values in fields.items()}, (side, side)


def made():
    """Name, points, faces, fields and grid of what is made here."""
    if version("scikit-fem"):
        yield ("cantilever", *cantilever(), None)
        yield ("drum", *drum(), None)
    yield ("plate", *plate())


# ---- tables


def cell(size, ours):
    return "" if size is None else f"{size / ours:.1f}"


def best(function, arrays, bound):
    sizes = [size for size in (function(x, bound) for x in arrays) if size is not None]
    return min(sizes) if sizes else None


def peers(values, bound, grid, points, faces, field, folder):
    arrays = layouts(values)
    even = not isinstance(faces, list)
    by_grid = sz3([np.ascontiguousarray(values[:, :, 0]).reshape(-1, *grid)], bound) if grid else None
    return [best(sz3, arrays, bound), best(zfp, arrays, bound), by_grid, npz(values), hdf5(values) if version("h5py") else None,
            vtkhdf(points, faces, field, folder) if version("vtk") and even else None,
            pyvista_zstd(points, faces, field, folder) if version("pyvista-zstd") else None,
            bodycompress(points, bound, folder) if version("bodycompress") and field is None else None]


HEAD = "ours, bytes | SZ3 | zfp | SZ3, told the grid | npz | HDF5 gzip (XDMF) | vtkhdf | pyvista-zstd | bodycompress |"


def mean(ratios):
    return f"{statistics.geometric_mean(ratios):.1f}" if ratios else ""


def table_of_points(clips, folder):
    print(f"| points, largest distance {100 * POINTS:g} % of the diagonal | frames x points | {HEAD}\n|---|---|---|---|---|---|---|---|---|---|---|")
    columns = [[], []]
    for name, points, faces in clips:
        flat = points.reshape(-1, 3)
        distance = POINTS * float(np.linalg.norm(flat.max(0) - flat.min(0)))
        ours = len(anicodec.encode(points, faces, max_error=distance, effort=EFFORT, no_attributes=True))
        sizes = peers(points, distance / 3**0.5, None, points, faces, None, folder)
        for column, size in zip(columns, sizes):
            column.append(size / ours)
        print(f"| {name} | {points.shape[0]} x {points.shape[1]} | {ours} | {' | '.join(cell(s, ours) for s in sizes)} |", flush=True)
    print(f"| geometric mean | | | {mean(columns[0])} | {mean(columns[1])} | | | | | | |\n")


def table_of_fields(folder):
    print(f"| field, largest error {100 * FIELD:g} % of its range | frames x points | {HEAD}\n|---|---|---|---|---|---|---|---|---|---|---|")
    for name, points, faces, fields, grid in made():
        rest = points[:1]
        for field, values in fields.items():
            values = values.astype(np.float32)
            whole = np.array_equal(values, np.round(values))
            bound = 0.499 if whole else FIELD * float(values.max() - values.min())
            still = np.repeat(rest, len(values), 0)
            options = {"effort": EFFORT, "custom": {field: values}, "field_errors": {field: "exact" if whole else bound}}
            data = anicodec.encode(still, faces, **options)
            ours = len(data) - len(anicodec.encode(still, faces, fields=[], effort=EFFORT, custom={field: values}))
            sizes = peers(values, bound, grid, rest, faces, values, folder)
            label = f"{name}: {field}" + (", exact" if whole else "")
            print(f"| {label} | {values.shape[0]} x {values.shape[1]} | {ours} | {' | '.join(cell(s, ours) for s in sizes)} |", flush=True)
    print()


def table_of_steps():
    print("| a step of 1,000, after opening | points | field | ms, median | ms, largest of 200 |\n|---|---|---|---|---|")
    points, faces, fields, _ = plate(96, 1000)
    values = fields["temperature"].astype(np.float32)
    moved = np.repeat(points, 1000, 0)
    moved[:, :, 2] = values[:, :, 0] / values.max() / 10
    data = anicodec.encode(moved, faces, custom={"temperature": values}, effort="fast", fps=1)
    clip = anicodec.Clip(data)
    order = np.random.default_rng(1).integers(0, 1000, 200)
    turns = []
    for step in order:
        begin = time.process_time()
        clip[int(step)]
        clip.attribute_at(0, float(step))
        turns.append(1000 * (time.process_time() - begin))
    print(f"| plate that bulges with its temperature | {moved.shape[1]} | temperature | {statistics.median(turns):.2f} | {max(turns):.2f} |\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for part in ("clips", "made", "fields", "seek"):
        parser.add_argument(f"--{part}", action="store_true")
    asked = vars(parser.parse_args())
    parts = {name for name, wanted in asked.items() if wanted} or set(asked)
    names = ("anicodec", "numpy", "pysz", "zfpy", "h5py", "vtk", "pyvista-zstd", "bodycompress", "scikit-fem")
    print(", ".join(f"{name} {version(name) or 'not installed'}" for name in names) + f"; effort {EFFORT}. Others in multiples of our bytes.\n")
    with tempfile.TemporaryDirectory() as folder:
        if "clips" in parts:
            table_of_points(((name, *read_clip(name)) for name in CLIPS), folder)
        if "made" in parts:
            table_of_points(((name, points, faces) for name, points, faces, _, _ in made() if len(points) > 1), folder)
        if "fields" in parts:
            table_of_fields(folder)
        if "seek" in parts:
            table_of_steps()


if __name__ == "__main__":
    main()
