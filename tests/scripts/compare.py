#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Compares two PC2 files: KG error in per cent, RMSE, largest error with frame and vertex, diagonal.

Independent of anicodec, to check `anicodec compare`. Only the standard library; seconds per million positions.
usage: compare.py ORIGINAL.pc2 DECODED.pc2      prints one JSON object; exit status 1 for bad input
"""
import array
import json
import math
import struct
import sys


def read_pc2(path):
    """Vertex count, frame count, positions as one flat array of float32."""
    with open(path, "rb") as file:
        header = file.read(32)
        if len(header) < 32 or header[:12] != b"POINTCACHE2\0":
            sys.exit(f"{path}: not a PC2 file")
        version, vertices, _start, _rate, frames = struct.unpack("<iiffi", header[12:])
        if version != 1 or vertices < 1 or frames < 1:
            sys.exit(f"{path}: unexpected PC2 header")
        positions = array.array("f")
        positions.frombytes(file.read(vertices * frames * 12))
    if len(positions) != vertices * frames * 3:
        sys.exit(f"{path}: ends early")
    if sys.byteorder == "big":
        positions.byteswap()
    return vertices, frames, positions


def compare(p, q, vertices, frames):
    squares, spread = [], []
    largest, at = -1.0, (0, 0)
    for f in range(frames):
        begin, end = f * vertices * 3, (f + 1) * vertices * 3
        for axis in range(3):
            x = p[begin + axis:end:3]
            mean = math.fsum(x) / vertices
            spread.append(math.fsum((a - mean) ** 2 for a in x))
        for v in range(vertices):
            i = begin + 3 * v
            d2 = sum((p[i + axis] - q[i + axis]) ** 2 for axis in range(3))
            squares.append(d2)
            if d2 > largest:
                largest, at = d2, (f, v)
    error, denominator = math.fsum(squares), math.fsum(spread)
    return {
        "kg_percent": 100 * math.sqrt(error) / (math.sqrt(denominator) or 1),
        "rmse": math.sqrt(error / (vertices * frames)),
        "max_error": math.sqrt(largest),
        "max_frame": at[0],
        "max_vertex": at[1],
        "diagonal": math.dist([min(p[a::3]) for a in range(3)], [max(p[a::3]) for a in range(3)]),
    }


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    vertices, frames, p = read_pc2(sys.argv[1])
    if (vertices, frames) != (other := read_pc2(sys.argv[2]))[:2]:
        sys.exit(f"the files differ in size: {vertices} x {frames} against {other[0]} x {other[1]}")
    print(json.dumps(compare(p, other[2], vertices, frames)))


if __name__ == "__main__":
    main()
