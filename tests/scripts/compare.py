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


def diagonal(p):
    """The diagonal of the box around all positions."""
    return math.dist([min(p[a::3]) for a in range(3)], [max(p[a::3]) for a in range(3)])


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
        "diagonal": diagonal(p),
    }


def displacement(p, q, vertices, frames):
    """Largest error of a vertex's move from frame to frame."""
    n, largest = 3 * vertices, 0.0
    for i in range(n, n * frames, 3):
        largest = max(largest, sum(((q[j] - q[j - n]) - (p[j] - p[j - n])) ** 2 for j in (i, i + 1, i + 2)))
    return math.sqrt(largest)


def sted(p, q, vertices, frames, polygons):
    """STED of Vasa and Skala (TVCG 17(2), 2011) by their tool's parameters: width 1, window 5, dt 0.0003."""
    edges = sorted({(min(pair), max(pair)) for polygon in polygons
                    for pair in zip(polygon, polygon[1:] + polygon[:1]) if pair[0] != pair[1]})
    touching = [set() for _ in range(vertices)]
    for number, edge in enumerate(edges):
        for v in edge:
            touching[v].add(number)
    near = [set().union(*(touching[w] for number in touching[v] for w in edges[number])) for v in range(vertices)]

    def point(positions, f, v):
        return positions[3 * (f * vertices + v):3 * (f * vertices + v) + 3]

    spatial = 0.0
    for f in range(frames):
        lengths = [math.dist(point(p, f, a), point(p, f, b)) for a, b in edges]
        errors = [(length - math.dist(point(q, f, a), point(q, f, b))) / length if length else 0
                  for length, (a, b) in zip(lengths, edges)]
        for v in range(vertices):
            weight = math.fsum(lengths[e] for e in near[v])
            if weight > 0:
                mean = math.fsum(lengths[e] * errors[e] for e in near[v]) / weight
                spatial += math.sqrt(math.fsum(lengths[e] * (errors[e] - mean) ** 2 for e in near[v]) / weight)
    first = [point(p, 0, v) for v in range(vertices)]
    diameter = max(math.dist(a, b) for a in first for b in first) or 1

    def speeds(positions, v):
        return [0] + [math.hypot(math.dist(point(positions, f, v), point(positions, f - 1, v)) / diameter, 0.0003)
                      for f in range(1, frames)]

    temporal = 0.0
    for v in range(vertices):
        own, other = speeds(p, v), speeds(q, v)
        for f in range(1, frames):
            around = own[max(1, f - 4):min(frames - 1, f + 5) + 1]
            temporal += abs(other[f] - own[f]) * len(around) / sum(around)
    return math.hypot(spatial / (vertices * frames), 9.144e-5 * temporal / (vertices * max(frames - 1, 1)))


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    vertices, frames, p = read_pc2(sys.argv[1])
    if (vertices, frames) != (other := read_pc2(sys.argv[2]))[:2]:
        sys.exit(f"the files differ in size: {vertices} x {frames} against {other[0]} x {other[1]}")
    print(json.dumps(compare(p, other[2], vertices, frames)))


if __name__ == "__main__":
    main()
