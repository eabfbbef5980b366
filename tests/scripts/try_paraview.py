# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Tries the plug-in for ParaView in its own Python, which must have the package.

usage: PYTHONPATH=FOLDER_WITH_THE_PACKAGE pvpython tests/scripts/try_paraview.py      exit status 1 for a fault; no part of CI
"""
import inspect
import os
import pathlib
import sys
import tempfile

if not hasattr(inspect, "getargspec"):  # which ParaView 5.11 takes from it; Python 3.11 has it no longer
    inspect.getargspec = inspect.getfullargspec

import numpy as np  # noqa: E402
from paraview import servermanager  # noqa: E402
from paraview.simple import LoadPlugin, OpenDataFile  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402

import anicodec  # noqa: E402

PLUGIN = pathlib.Path(__file__).resolve().parents[2] / "bindings" / "paraview" / "anicodec_reader.py"
FACES = [[0, 1, 3, 2], [2, 3, 5, 4]]


def frames(count):
    rest = np.array([[x, y, 0] for y in range(3) for x in range(2)], float)
    return np.stack([rest + [0, 0, 0.1 * frame * frame] for frame in range(count)])


def points(data):
    return vtk_to_numpy(data.GetPoints().GetData())


def check(one, other, what):
    if not np.array_equal(one, other):
        sys.exit(f"{what}: {one} is not {other}")
    print("ok", what)


def names(attributes):
    return [attributes.GetArrayName(number) for number in range(attributes.GetNumberOfArrays())]


def main():
    LoadPlugin(str(PLUGIN), remote=False, ns=globals())
    folder = tempfile.mkdtemp()
    path = os.path.join(folder, "one.anic")
    positions = frames(6)
    with open(path, "wb") as file:
        file.write(anicodec.encode(positions, FACES, fps=4, start_time=2, lossless=True, custom={
            "heat": positions[:, :, 2:], "damage": anicodec.Field("polygons", np.array([[0.0], [1.0]]))}))
    clip, reader = anicodec.open(path), OpenDataFile(path)
    check(list(reader.TimestepValues), [2 + frame / 4 for frame in range(6)], "times")
    for frame in (0, 3, 5, 1):
        reader.UpdatePipeline(2 + frame / 4)
        data = servermanager.Fetch(reader)
        check(points(data), clip[frame], f"frame {frame}")
        check(vtk_to_numpy(data.GetPointData().GetArray("heat")).ravel(), clip.attribute_at(0, frame / 4).ravel(), f"field of frame {frame}")
    check(data.GetNumberOfPolys(), 2, "polygons")
    check(names(data.GetCellData()), ["damage"], "fields of cells")
    reader.PointArrays = []
    reader.UpdatePipeline(2.5)
    check(names(servermanager.Fetch(reader).GetPointData()), [], "fields switched off")

    path = os.path.join(folder, "two.anic")
    with open(path, "wb") as file:
        file.write(anicodec.encode_meshes([anicodec.SourceMesh(positions, FACES, name="sheet"), anicodec.SourceMesh(
            positions[1:3], FACES, name="guest", runs=[(1, 2)])], frame_count=6, lossless=True))
    reader = OpenDataFile(path)
    for frame, there in ((0, 0), (2, 6), (5, 0)):
        reader.UpdatePipeline(anicodec.open(path).time(frame))
        blocks = servermanager.Fetch(reader)
        check([blocks.GetBlock(0).GetNumberOfPoints(), blocks.GetBlock(1).GetNumberOfPoints()], [6, there], f"blocks of frame {frame}")

    with open(path, "rb") as file:
        damaged = file.read()[:200]
    path = os.path.join(folder, "damaged.anic")
    with open(path, "wb") as file:
        file.write(damaged)
    reader = OpenDataFile(path)
    reader.UpdatePipeline()
    check(servermanager.Fetch(reader) is None or servermanager.Fetch(reader).GetNumberOfPoints() == 0, True, "a damaged file, whose error stands above")


main()
