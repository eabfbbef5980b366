# SPDX-License-Identifier: CC0-1.0
"""Chapter 12 (status codes), chapter 03 (types, varints), XXH64."""
import math
import struct
from functools import partial, partialmethod

CODES = {
    'OK': 0, 'MAGIC': 10, 'VERSION': 11, 'FEATURE': 12, 'TRUNCATED': 20, 'HEADER': 21, 'HEADER_CHECKSUM': 22,
    'CHUNK_BOUNDS': 23, 'CHUNK_CHECKSUM': 24, 'CHUNK_DUPLICATE': 25, 'CHUNK_MISSING': 26, 'CHUNK_UNKNOWN': 27,
    'TRAILING_BYTES': 29, 'FILE_SIZE': 30, 'RECORD': 40, 'ENTROPY': 41, 'ZSTD': 42, 'TOPOLOGY': 43,
    'INDEX_RANGE': 44, 'QUANTIZER': 45, 'NON_FINITE': 46, 'DRACO': 47, 'SEGMENT': 48, 'HASH': 49, 'MESHES': 50,
    'SEGMENT_MISSING': 51,
    'LIMIT': 60, 'MEMORY': 70, 'INTERNAL': 90}


class AnicError(Exception):
    """A refusal: the name of a status of chapter 12, and where."""

    def __init__(self, name, detail='', chunk=''):
        super().__init__(name, detail)
        self.name, self.code, self.detail, self.chunk = name, CODES[name], detail, chunk


def need(condition, name, detail=''):
    """Ends the decoding with status `name` unless the condition holds."""
    if not condition:
        raise AnicError(name, detail)


def signed32(x):
    """x modulo 2^32 as two's complement (03, section 3)."""
    return ((x + 0x80000000) & 0xFFFFFFFF) - 0x80000000


def sgn(x):
    return (x > 0) - (x < 0)


def _unpack(reader, form):
    return struct.unpack(form, reader.take(struct.calcsize(form)))[0]


class Reader:
    """Fields of a record, one after the other (03, sections 1 and 2)."""

    def __init__(self, data, error='RECORD'):
        self.data, self.at, self.error = data, 0, error

    def left(self):
        return len(self.data) - self.at

    def take(self, n):
        need(n <= self.left(), self.error, 'record ends early')
        self.at += n
        return self.data[self.at - n:self.at]

    def u8(self):
        return self.take(1)[0]

    u16, u32, u64, i32, f32, f64 = map(partial(partialmethod, _unpack), ('<H', '<I', '<Q', '<i', '<f', '<d'))

    def finite(self, low=-math.inf, form='f64', error=None):
        """A number that must be finite and at least `low`."""
        x = self.f64() if form == 'f64' else self.f32()
        need(math.isfinite(x) and x >= low, error or self.error, 'number')
        return x

    def varint(self, limit=2 ** 64 - 1, low=0):
        x = 0
        for i in range(10):
            b = self.u8()
            need(i < 9 or (b & 0x7F) <= 1, self.error, 'varint')
            x |= (b & 0x7F) << 7 * i
            if b < 0x80:
                need((b or i == 0) and low <= x <= limit, self.error, 'varint')
                return x
        raise AnicError(self.error, 'varint')

    def block(self):
        return self.take(self.varint())

    text = block

    def rest(self):
        return self.take(self.left())

    def end(self):
        need(self.left() == 0, self.error, 'bytes left over')


_P1, _P2, _P3, _P4, _P5 = (11400714785074694791, 14029467366897019727, 1609587929392839161, 9650029242287828579,
                           2870177450012600261)
_M = 2 ** 64 - 1


def xxh64(data):
    """XXH64 with seed 0."""
    n, at = len(data), 0
    if n >= 32:
        a, b, c, d = (_P1 + _P2) & _M, _P2, 0, -_P1 & _M
        for w, x, y, z in struct.iter_unpack('<4Q', data[:n & ~31]):
            a = (a + w * _P2) & _M
            a = ((a << 31 | a >> 33) & _M) * _P1 & _M
            b = (b + x * _P2) & _M
            b = ((b << 31 | b >> 33) & _M) * _P1 & _M
            c = (c + y * _P2) & _M
            c = ((c << 31 | c >> 33) & _M) * _P1 & _M
            d = (d + z * _P2) & _M
            d = ((d << 31 | d >> 33) & _M) * _P1 & _M
        h = ((a << 1 | a >> 63) & _M) + ((b << 7 | b >> 57) & _M) + ((c << 12 | c >> 52) & _M) + (
            (d << 18 | d >> 46) & _M) & _M
        for v in (a, b, c, d):
            v = v * _P2 & _M
            h = ((h ^ ((v << 31 | v >> 33) & _M) * _P1 & _M) * _P1 + _P4) & _M
        at = n & ~31
    else:
        h = _P5
    h = (h + n) & _M
    while at + 8 <= n:
        v = int.from_bytes(data[at:at + 8], 'little') * _P2 & _M
        h ^= ((v << 31 | v >> 33) & _M) * _P1 & _M
        h = (((h << 27 | h >> 37) & _M) * _P1 + _P4) & _M
        at += 8
    if at + 4 <= n:
        h ^= int.from_bytes(data[at:at + 4], 'little') * _P1 & _M
        h = (((h << 23 | h >> 41) & _M) * _P2 + _P3) & _M
        at += 4
    for byte in data[at:]:
        h ^= byte * _P5 & _M
        h = ((h << 11 | h >> 53) & _M) * _P1 & _M
    h = (h ^ h >> 33) * _P2 & _M
    h = (h ^ h >> 29) * _P3 & _M
    return h ^ h >> 32


def checksum(data):
    """Low 32 bits of XXH64 (05, section 4)."""
    return xxh64(data) & 0xFFFFFFFF
