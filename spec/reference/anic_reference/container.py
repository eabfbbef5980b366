# SPDX-License-Identifier: CC0-1.0
"""Chapter 05: header, table, checksums, live streams."""
import struct
from types import SimpleNamespace
from .conventions import Reader, check, xxh64

MAGIC, MAJOR = b"\x89ANI\r\n\x1a\n", 1
REQUIRED, OF_MESH, OF_SEGMENT, COPIED = 1, 2, 4, 8      # flags of a chunk
checksum = lambda data: xxh64(data) & 2**32 - 1

class Chunk:  # An entry of the table with its payload, which is checked when it is first needed
    def __init__(self, table):
        self.type, self.checksum = table.bytes(4).decode("latin-1"), table.field("u32")
        self.flags, self.stored = table.field("u8"), None
        self.mesh = table.varint(65534) if self.flags & OF_MESH else None
        self.segment, self.size = table.varint(2**32 - 2) if self.flags & OF_SEGMENT else None, table.varint()
        check(self.flags < 16, "HEADER", "a reserved flag")
    def payload(self):
        check(checksum(self.stored) == self.checksum, "CHUNK_CHECKSUM", self.type)
        return self.stored

def read_container(data, known_types, stream=False):
    """Section 5: the chunks of the file that `data` begins with. In a stream, others may follow."""
    length = len(data)
    check(length and MAGIC.startswith(data[:8]), "MAGIC")
    check(length >= 40, "TRUNCATED")
    major, minor, chunk_count, features, size, stated, table_bytes = struct.unpack_from("<HHIQQII", data, 8)
    check(major == MAJOR, "VERSION", f"{major}.{minor}" + " is a draft" * (major == 0))
    at, lacking = 40 + table_bytes, features & ~1 if stream else features
    check(at <= length, "TRUNCATED" if size > length else "HEADER")
    check(checksum(data[:32] + bytes(4) + data[36:at]) == stated, "HEADER_CHECKSUM")
    check(not lacking, "FEATURE", f"features {lacking:#x}; key-frames by Draco are 2, interpolation 4, learning 8")
    check(size <= length, "TRUNCATED")
    check(stream or size == length, "TRAILING_BYTES")
    check(10 * chunk_count <= table_bytes, "HEADER")
    file = SimpleNamespace(size=size, continues=features & 1, follows=None, chunks=[])
    table = Reader(data[40:at], "HEADER")
    for _ in range(chunk_count):
        chunk = Chunk(table)
        check(at <= size and chunk.size <= size - at, "CHUNK_BOUNDS")
        chunk.stored = data[at:at + chunk.size]
        at += chunk.size
        file.chunks.append(chunk)
    check(table.left() == 0, "HEADER")
    check(at == size, "FILE_SIZE")
    check_types(file, known_types)
    return file

def check_types(file, known_types):
    for chunk in file.chunks:
        check(chunk.type in known_types or not chunk.flags & REQUIRED, "CHUNK_UNKNOWN", chunk.type)
    once = [(c.type, c.mesh, c.segment) for c in file.chunks if c.type in known_types and c.type != "BASI"]
    check(len(once) == len(set(once)), "CHUNK_DUPLICATE")

def read_stream(data, known_types):
    """Section 8: the files of a live stream, continuations with the meshes they lack. `follows`: the hash
    of the meshes before."""
    meshes = None
    while data or meshes is None:
        check(meshes is None or MAGIC.startswith(data[:8]), "TRAILING_BYTES")
        file = read_container(data, known_types, stream=True)
        data = data[file.size:]
        if file.continues:
            check(meshes is not None, "FEATURE", "a continuation without a file before it")
            entries = [(c.type.encode("latin-1"), c.mesh, xxh64(c.stored)) for c in meshes]
            file.follows = xxh64(b"".join(struct.pack("<4sIQ", *entry) for entry in entries))
            first = next((i for i, c in enumerate(file.chunks) if c.segment is not None), len(file.chunks))
            file.chunks[first:first], file.size = meshes, file.size + sum(c.size for c in meshes)
            check_types(file, known_types)
        else:
            meshes = [chunk for chunk in file.chunks if chunk.mesh is not None and chunk.segment is None]
        yield file
