# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Files of the format taken apart and put together, for tests: spec/05-file-layout.md."""
import dataclasses
import struct

MASK = (1 << 64) - 1
PRIMES = (11400714785074694791, 14029467366897019727, 1609587929392839161, 9650029242287828579,
          2870177450012600261)
HEADER_BYTES, ENTRY_BYTES = 40, 32


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
    """One chunk, as the table lists it."""
    type: str
    flags: int
    mesh: int
    segment: int
    payload: bytes


def read_chunks(data):
    """The chunks of a good file."""
    chunks = []
    for i in range(struct.unpack_from("<I", data, 12)[0]):
        kind, flags, mesh, segment, _, offset, size = struct.unpack_from("<4sHHIIQQ", data, 40 + 32 * i)
        chunks.append(Chunk(kind.decode("latin-1"), flags, mesh, segment, data[offset:offset + size]))
    return chunks


def checked_header(data):
    """The same with the checksum of header and table made right."""
    data = bytearray(data)
    data[32:36] = bytes(4)
    count = struct.unpack_from("<I", data, 12)[0]
    struct.pack_into("<I", data, 32, xxh64(bytes(data[:HEADER_BYTES + ENTRY_BYTES * count])) & 0xFFFFFFFF)
    return bytes(data)


def write_chunks(chunks, version=(0, 2)):
    """A file of these chunks, all checksums right."""
    at = HEADER_BYTES + ENTRY_BYTES * len(chunks)
    table, body = b"", b""
    for chunk in chunks:
        padding = -at % 8
        at += padding
        body += bytes(padding) + chunk.payload
        table += struct.pack("<4sHHIIQQ", chunk.type.encode("latin-1"), chunk.flags, chunk.mesh, chunk.segment,
                             xxh64(chunk.payload) & 0xFFFFFFFF, at, len(chunk.payload))
        at += len(chunk.payload)
    header = struct.pack("<8sHHIQQII", b"\x89ANI\r\n\x1a\n", *version, len(chunks), 0, at, 0, 0)
    return checked_header(header + table + body)


def varints(values):
    """Unsigned integers as the format writes them, least significant seven bits first."""
    out = b""
    for value in values:
        while value >= 128:
            out += bytes([value & 127 | 128])
            value >>= 7
        out += bytes([value])
    return out
