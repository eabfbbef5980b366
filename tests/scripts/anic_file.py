# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Files of the format taken apart and put together, for tests: spec/05-file-layout.md."""
import dataclasses
import struct

MASK = (1 << 64) - 1
PRIMES = (11400714785074694791, 14029467366897019727, 1609587929392839161, 9650029242287828579,
          2870177450012600261)
HEADER_BYTES = 40
NO_MESH, NO_SEGMENT = 0xFFFF, 0xFFFFFFFF
REQUIRED, OF_MESH, OF_SEGMENT, COPIED = 1, 2, 4, 8


def _rotated(x, n):
    return (x << n | x >> (64 - n)) & MASK


def _round(total, word):
    return _rotated((total + word * PRIMES[1]) & MASK, 31) * PRIMES[0] & MASK


def xxh64(data):
    """XXH64 with seed 0."""
    length, at = len(data), 0
    if length >= 32:
        lanes = [(PRIMES[0] + PRIMES[1]) & MASK, PRIMES[1], 0, -PRIMES[0] & MASK]
        while at + 32 <= length:
            lanes = [_round(lane, word) for lane, word in zip(lanes, struct.unpack_from("<4Q", data, at))]
            at += 32
        total = sum(_rotated(lane, n) for lane, n in zip(lanes, (1, 7, 12, 18))) & MASK
        for lane in lanes:
            total = ((total ^ _round(0, lane)) * PRIMES[0] + PRIMES[3]) & MASK
    else:
        total = PRIMES[4]
    total = (total + length) & MASK
    while at + 8 <= length:
        total ^= _round(0, struct.unpack_from("<Q", data, at)[0])
        total = (_rotated(total, 27) * PRIMES[0] + PRIMES[3]) & MASK
        at += 8
    if at + 4 <= length:
        total ^= struct.unpack_from("<I", data, at)[0] * PRIMES[0] & MASK
        total = (_rotated(total, 23) * PRIMES[1] + PRIMES[2]) & MASK
        at += 4
    for byte in data[at:]:
        total ^= byte * PRIMES[4] & MASK
        total = _rotated(total, 11) * PRIMES[0] & MASK
    total ^= total >> 33
    total = total * PRIMES[1] & MASK
    total ^= total >> 29
    total = total * PRIMES[2] & MASK
    return total ^ total >> 32


@dataclasses.dataclass
class Chunk:
    """One chunk, as the table lists it; the flags are those of no mesh and segment."""
    type: str
    flags: int
    mesh: int
    segment: int
    payload: bytes


def read_varint(data, at):
    """A varint and the offset behind it."""
    value, shift = 0, 0
    while True:
        byte = data[at]
        value |= (byte & 127) << shift
        at, shift = at + 1, shift + 7
        if byte < 128:
            return value, at


def table_bytes(data):
    """Bytes of header and table."""
    return HEADER_BYTES + struct.unpack_from("<I", data, 36)[0]


def entries(data):
    """(offset of the entry, type, flags, mesh, segment, offset, size) of the chunks of a good file."""
    at, payload = HEADER_BYTES, table_bytes(data)
    for _ in range(struct.unpack_from("<I", data, 12)[0]):
        entry = at
        kind, _, flags = struct.unpack_from("<4sIB", data, at)
        at += 9
        mesh, segment = NO_MESH, NO_SEGMENT
        if flags & OF_MESH:
            mesh, at = read_varint(data, at)
        if flags & OF_SEGMENT:
            segment, at = read_varint(data, at)
        size, at = read_varint(data, at)
        yield entry, kind.decode("latin-1"), flags & ~(OF_MESH | OF_SEGMENT), mesh, segment, payload, size
        payload += size


def features(data):
    """The feature bits of the header."""
    return struct.unpack_from("<Q", data, 16)[0]


def file_size(data):
    """The bytes of the first file of a stream."""
    return struct.unpack_from("<Q", data, 24)[0]


def split_stream(data):
    """The files of a live stream."""
    files = []
    while data:
        size = file_size(data)
        files.append(data[:size])
        data = data[size:]
    return files


def field(tag, value):
    """An optional field of a record."""
    return varints((tag, len(value))) + value


def read_chunks(data):
    """The chunks of a good file."""
    return [Chunk(kind, flags, mesh, segment, data[offset:offset + size])
            for _, kind, flags, mesh, segment, offset, size in entries(data)]


def checked_header(data):
    """The same with the checksum of header and table made right."""
    data = bytearray(data)
    data[32:36] = bytes(4)
    struct.pack_into("<I", data, 32, xxh64(bytes(data[:table_bytes(data)])) & 0xFFFFFFFF)
    return bytes(data)


def entry(chunk, size=None):
    """The table's entry of a chunk."""
    flags, numbers = chunk.flags, []
    if chunk.mesh != NO_MESH:
        flags |= OF_MESH
        numbers.append(chunk.mesh)
    if chunk.segment != NO_SEGMENT:
        flags |= OF_SEGMENT
        numbers.append(chunk.segment)
    numbers.append(len(chunk.payload) if size is None else size)
    return struct.pack("<4sIB", chunk.type.encode("latin-1"), xxh64(chunk.payload) & 0xFFFFFFFF, flags) + varints(numbers)


def write_table(chunks, table, version=(1, 0), needs=0):
    """A file of chunks with any table. `needs`: its feature bits."""
    body = b"".join(chunk.payload for chunk in chunks)
    header = struct.pack("<8sHHIQQII", b"\x89ANI\r\n\x1a\n", *version, len(chunks), needs, HEADER_BYTES + len(table) + len(body), 0,
                         len(table))
    return checked_header(header + table + body)


def write_chunks(chunks, version=(1, 0), needs=0):
    """A file of these chunks, all checksums right. `needs`: its feature bits."""
    return write_table(chunks, b"".join(map(entry, chunks)), version, needs)


def varints(values):
    """Unsigned integers as the format writes them, least significant seven bits first."""
    out = b""
    for value in values:
        while value >= 128:
            out += bytes([value & 127 | 128])
            value >>= 7
        out += bytes([value])
    return out
