# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""The output of a decoder, for tests: a PC2 vertex cache and the faces of an OBJ file."""
import hashlib
import pathlib
import struct


class Clip:
    """Frames of a PC2 file."""

    def __init__(self, path):
        data = pathlib.Path(path).read_bytes()
        magic, _, self.vertices, _, _, count = struct.unpack_from("<12siiffi", data)
        if magic != b"POINTCACHE2\0" or len(data) != 32 + 12 * self.vertices * count:
            raise ValueError(f"{path} is no PC2 file")
        self.frames = [struct.unpack_from(f"<{3 * self.vertices}f", data, 32 + 12 * self.vertices * f)
                       for f in range(count)]

    def position(self, frame, vertex):
        """Three coordinates."""
        return self.frames[frame][3 * vertex:3 * vertex + 3]


def faces(path):
    """Corners of each polygon of an OBJ file, counted from 0."""
    with open(path, encoding="ascii") as file:
        return [[int(word.split("/")[0]) - 1 for word in line.split()[1:]] for line in file if line.startswith("f")]


def faces_hash(polygons):
    """SHA-256 of the number of corners of each polygon followed by its corners, as 32-bit little-endian."""
    digest = hashlib.sha256()
    for polygon in polygons:
        digest.update(struct.pack(f"<{1 + len(polygon)}I", len(polygon), *polygon))
    return digest.hexdigest()
