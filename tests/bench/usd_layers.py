#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Clips as layers of OpenUSD, against usdc: usd_layers.py [--alone] FILE.anic..., in a Python with anicodec and usd-core.

Prints a line for each file: bytes of it and of a usdc with the same points and faces, without normals, as usd-core writes it; processor
time, medians of 9 turns: to open either as a stage, to list the samples of all attributes of the layer, to get the points at a time code
whose frame was not asked for before, and to decode such a frame by the Python package; and bytes by which the process grew when the layer
was opened and listed, against the points of all frames. --alone leaves out usdc, which takes long for gigabytes of points.
"""
import os
import pathlib
import resource
import statistics
import subprocess
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


def list_samples(path):
    stage = Usd.Stage.Open(path)
    for prim in stage.Traverse():
        for attribute in prim.GetAuthoredAttributes():
            attribute.GetTimeSamples()
    return stage


def show_first():
    """Pays what the first layer of a process costs, which is not of the clip."""
    with tempfile.TemporaryDirectory() as folder:
        small = pathlib.Path(folder, "small.anic")
        small.write_bytes(anicodec.encode([[[0, 0, 0], [1, 0, 0], [0, 1, frame]] for frame in range(2)], [[0, 1, 2]], effort="fast"))
        first = Usd.Stage.Open(str(small))
        points_of(first).Get(0)


def grown_by(path):
    """Bytes that a process takes more when it opens a layer and lists its samples."""
    show_first()
    before = resident()
    stage = list_samples(path)
    grown = resident() - before
    del stage
    return grown


def frame_time(path):
    clip = anicodec.open(path)
    clip[0]
    return median_of(lambda turn: clip[1 + turn * (len(clip) - 2) // TURNS])


def timed(path):
    """Seconds to open a stage, and to get a new sample."""
    opening = median_of(lambda _: Usd.Stage.Open(path))
    stage = Usd.Stage.Open(path)
    points = points_of(stage)
    codes = points.GetTimeSamples()
    # The first frame makes what all share.
    points.Get(codes[0])
    return opening, median_of(lambda turn: points.Get(codes[1 + turn * (len(codes) - 2) // TURNS]))


def line_of(path, folder):
    size, stem = os.path.getsize(path), pathlib.Path(path).stem
    of_usdc = ["-"] * 4
    clip = anicodec.open(path)
    points = 12 * sum(mesh.vertex_count for mesh in clip.meshes) * len(clip)
    if folder:
        written = os.path.join(folder, stem + ".usdc")
        usd.decode(clip, written, normals=False)
        opening, sample = timed(written)
        size_of_usdc = os.path.getsize(written)
        of_usdc = [size_of_usdc, f"{size_of_usdc / size:.0f}", f"{1e3 * opening:.2f}", f"{1e6 * sample:.0f}"]
    # In a process of its own: memory that was freed before would be taken again.
    grown = int(subprocess.run([sys.executable, __file__, "--grown", path], check=True, stdout=subprocess.PIPE).stdout)
    opening, sample = timed(path)
    listing = median_of(lambda _: list_samples(path))
    return [stem, of_usdc[0], size, of_usdc[1], of_usdc[2], f"{1e3 * opening:.1f}", f"{1e3 * listing:.1f}", of_usdc[3], f"{1e6 * sample:.0f}",
            f"{1e6 * frame_time(path):.0f}", f"{grown / 1e6:.1f}", f"{points / 1e6:.1f}"]


def main():
    if sys.argv[1:2] == ["--grown"]:
        return print(grown_by(sys.argv[2]))
    alone = "--alone" in sys.argv[1:]
    names = [name for name in sys.argv[1:] if name != "--alone"]
    if not names:
        sys.exit(__doc__)
    titles = ["clip", "usdc, bytes", ".anic, bytes", "ratio", "open usdc, ms", "open .anic, ms", "open and list, ms", "sample of usdc, us",
              "sample of .anic, us", "frame by the package, us", "memory, MB", "points, MB"]
    print("| " + " | ".join(titles) + " |\n|" + "---|" * len(titles))
    show_first()
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            print("| " + " | ".join(map(str, line_of(name, None if alone else folder))) + " |", flush=True)


if __name__ == "__main__":
    main()
