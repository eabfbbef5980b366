#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Clips as layers of OpenUSD, against usdc: usd_layers.py FILE.anic..., in a Python with anicodec and usd-core.

Prints a line for each file: bytes of it and of a usdc with the same points and faces, without normals, as usd-core writes it; processor
time, medians of 9 turns: to open either as a stage, and to get the points at a time code whose frame was not asked for before; and bytes
by which the process grew when the layer was opened, against the points of all frames.
"""
import os
import pathlib
import resource
import statistics
import sys
import tempfile
import time

import anicodec
from anicodec import usd
from pxr import Usd, UsdGeom

TURNS = 9


def resident():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * resource.getpagesize()


def median_of(function):
    times = []
    for turn in range(TURNS):
        begin = time.process_time()
        function(turn)
        times.append(time.process_time() - begin)
    return statistics.median(times)


def points_of(stage):
    return next(UsdGeom.Mesh(prim).GetPointsAttr() for prim in stage.Traverse() if prim.IsA(UsdGeom.Mesh))


def timed(path):
    """Seconds to open a stage, and to get a new sample."""
    opening = median_of(lambda _: Usd.Stage.Open(path))
    stage = Usd.Stage.Open(path)
    points = points_of(stage)
    codes = points.GetTimeSamples()
    # The first frame makes what all share.
    points.Get(codes[0])
    return opening, median_of(lambda turn: points.Get(codes[1 + turn * (len(codes) - 2) // TURNS]))


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    print("| clip | usdc, bytes | .anic, bytes | ratio | open usdc, ms | open .anic, ms | sample of usdc, us | sample of .anic, us | "
          "memory, MB | points, MB |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        small = pathlib.Path(folder, "small.anic")  # what the first layer of a process costs is not of the clip
        small.write_bytes(anicodec.encode([[[0, 0, 0], [1, 0, 0], [0, 1, frame]] for frame in range(2)], [[0, 1, 2]], effort=1))
        first = Usd.Stage.Open(str(small))
        points_of(first).Get(0)
        for name in sys.argv[1:]:
            clip = anicodec.open(name)
            written = os.path.join(folder, pathlib.Path(name).stem + ".usdc")
            usd.decode(clip, written, normals=False)
            points = 12 * sum(mesh.vertex_count for mesh in clip.meshes) * len(clip)
            del clip
            before = resident()
            stage = Usd.Stage.Open(name)
            points_of(stage).GetTimeSamples()
            grown = resident() - before
            del stage
            of_usdc, of_clip = timed(written), timed(name)
            sizes = os.path.getsize(written), os.path.getsize(name)
            print(f"| {pathlib.Path(name).stem} | {sizes[0]} | {sizes[1]} | {sizes[0] / sizes[1]:.0f} | {1e3 * of_usdc[0]:.2f} | "
                  f"{1e3 * of_clip[0]:.1f} | {1e6 * of_usdc[1]:.0f} | {1e6 * of_clip[1]:.0f} | {grown / 1e6:.1f} | {points / 1e6:.1f} |", flush=True)


if __name__ == "__main__":
    main()
