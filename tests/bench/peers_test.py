#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Tests what peers.py does itself, without its packages: peers_test.py ANICODEC [ENVIRONMENT]

In ENVIRONMENT where this Python has no numpy; exit status 77 where neither has.
"""
import importlib.util
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile

if importlib.util.find_spec("numpy") is None:
    if len(sys.argv) > 2 and (python := pathlib.Path(sys.argv[2], "bin/python")).exists():
        os.execv(python, [python, *sys.argv[:2]])
    print("numpy is not there")
    sys.exit(77)
sys.dont_write_bytecode = True
import numpy as np  # pylint: disable=wrong-import-position
import peers  # pylint: disable=wrong-import-position


def check(what, true):
    if not true:
        sys.exit(f"not so: {what}")


def main():
    command = sys.argv[1]
    with tempfile.TemporaryDirectory() as made:
        folder = pathlib.Path(made)
        clip = peers.find_clip("polygons", command, "30", folder)
        check("points of each frame", clip.points.shape == (clip.frames, clip.vertices, 3) and clip.frames > 1)
        check("polygons become triangles", len(clip.triangles) == sum(len(face) - 2 for face in clip.faces) > len(clip.faces))
        size, error, _, _ = peers.ours(clip, 0.5, command, folder)
        check("bytes", size == (folder / "ours.anic").stat().st_size)
        told = subprocess.run([command, "compare", folder / "clip.pc2", folder / "ours.anic", "--json"], check=True, stdout=subprocess.PIPE)
        told = json.loads(told.stdout)["kg"]
        check(f"KG error {error} is the command's, {told}", abs(error - told) < 1e-6 * told)

        step = peers.step_at_kg(clip.points, 0.0, 0.5)
        check("a grid keeps to its error", 0.45 < peers.kg_error(clip.points, peers.on_grid(clip.points, 0.0, step)[1]) <= 0.5)

        glb = peers.morph_glb(clip)
        (folder / "morph.glb").write_bytes(glb)
        check("length of the GLB", struct.unpack_from("<I", glb, 8)[0] == len(glb))
        again = peers.find_clip(str(folder / "morph.glb"), command, str(peers.RATE), folder)
        check("frames of the GLB", again.points.shape == clip.points.shape)
        check("positions of the GLB", np.abs(again.points - clip.points).max() < 1e-5)
    check("ratios", [peers.ratio(x) for x in (None, 1.234, 12.34, 123.4)] == ["", "1.23", "12.3", "123"])


if __name__ == "__main__":
    main()
