#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Sizes of characters with all their clips in one file, against files of single clips, at a KG error of 0.1 % a clip.

usage: compare_clips.py ANICODEC DATA      DATA: the folder of real sequences; prints a row for each character
"""
import pathlib
import struct
import subprocess
import sys
import tempfile

ROBOT = ["Robot_Walking", "Robot_Running", "Robot_Jump", "Robot_Wave", "Robot_Dance"]
TANK = [f"TankArmature|Tank_{what}" for what in ("Backwards", "Forward", "TurningLeft", "TurningRight")]
SCENES = {"Fox": ["Survey", "Walk", "Run"], "raylib_robot": ROBOT, "Tank4": TANK}


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    command, data = sys.argv[1], pathlib.Path(sys.argv[2])
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out.anic"

        def size(*arguments):
            subprocess.run([command, "encode", *map(str, arguments), "-o", out, "-f", "-q", "--kg", "0.1"], check=True)
            return out.stat().st_size

        print(f"{'character':<14} {'clips':>5} {'one file':>9} {'single files':>13} {'ratio':>6}")

        def row(name, clips, together, alone):
            print(f"{name:<14} {clips:>5} {together:>9} {alone:>13} {together / alone:>6.3f}", flush=True)

        for name, clips in SCENES.items():
            scene = data / f"gltf/{name}.glb"
            row(name, len(clips), size(scene, "--clips", ",".join(clips)),
                sum(size(scene, "--clip", clip) for clip in clips))
        mesh, cache = data / "classic/chicken.obj", (data / "classic/chicken.pc2").read_bytes()
        vertices, = struct.unpack_from("<i", cache, 16)
        parts = [pathlib.Path(folder) / f"part{k}.pc2" for k in range(4)]
        for k, part in enumerate(parts):  # against the one clip that they were cut from
            frames = cache[32 + 12 * vertices * 100 * k:32 + 12 * vertices * 100 * (k + 1)]
            part.write_bytes(cache[:28] + struct.pack("<i", 100) + frames)
        row("chicken, cut", 4, size(mesh, *parts, "--fps", 24), size(mesh, data / "classic/chicken.pc2", "--fps", 24))


if __name__ == "__main__":
    main()
