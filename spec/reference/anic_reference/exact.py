# SPDX-License-Identifier: CC0-1.0
"""Chapter 06, section 12: the record DIFF; chapter 09d: exact positions."""
import math
import struct
import numpy as np
from types import SimpleNamespace as Record
from .common import Reader, need
from .entropy import Models, RangeDecoder, bit_model, integers
from .filters import Filter
from .pose import f32

LARGEST = float(np.finfo(np.float32).max)
FORGET = 0.999
SEVEN, THREE = f32(0.7), f32(0.3)


def read_diff(data, frames, coded):
    """The record, without what the stream holds."""
    r = Reader(data)
    flags = r.u8()
    need(flags < 64 and (flags >> 3) & ~flags & 7 == 0, 'RECORD', 'lattices')
    d = Record(hash=r.u64(), noise=r.f64(), lattices=[None] * 3)
    for axis in range(3):
        if flags >> axis & 1:
            errs = bool(flags >> 3 + axis & 1)
            lattice = Record(origin=r.f64(), step=r.f64(), first=r.i32(), errs=errs)
            lattice.count = r.varint(min(2 ** 31 - 1, frames * coded) if errs else 2 ** 31 - 1, 1)
            lattice.errors, lattice.erred = {}, 0
            d.lattices[axis] = lattice
    d.stream = r.rest()
    need(math.isfinite(d.noise) and d.noise > 0, 'QUANTIZER', 'noise')
    for x in d.lattices:
        need(x is None or math.isfinite(x.origin) and math.isfinite(x.step) and x.step > 0, 'QUANTIZER', 'lattice')
    return d


# Section 1.

def ordinal(x):
    """Of a number of binary32."""
    b = struct.unpack('<i', struct.pack('<f', x))[0]
    return b if b >= 0 else -1 - (b & 0x7FFFFFFF)


def wrap(i):
    return i - (2 ** 32 - 1) if i > 2 ** 31 - 1 else i + (2 ** 32 - 1) if i < -(2 ** 31 - 1) else i


def number(i):
    need(-0x7F800000 <= i <= 0x7F7FFFFF, 'ENTROPY', 'a number that is not finite')
    return struct.unpack('<f', struct.pack('<I', i if i >= 0 else 0x80000000 | -1 - i))[0]


def nearest(lattice, p):
    t = (p - lattice.origin) / lattice.step + 0.5
    last = lattice.first + lattice.count - 1
    return lattice.first if t < lattice.first else last if not t < last else math.floor(t)


def point(lattice, k):
    return ordinal(f32(lattice.origin + k * lattice.step))


def neighbours_of(coded, triangles):
    """Section 2. Of vertex 0: four times `coded`, where all numbers are 0."""
    lower = [set() for _ in range(coded)]
    for t in triangles:
        for v in t:
            lower[v].update(u for u in t if u < v)
    lines = [[coded] * 4]
    for v in range(1, coded):
        n = sorted(lower[v], reverse=True)[:4] or [v - 1]
        lines.append([n[i % len(n)] for i in range(4)])
    return lines


class ExactPositions:
    """Section 3. `frames[f][axis][v]`: coordinates."""

    def __init__(self, diff, frames, coded, near):
        self.diff, self.coded, self.near = diff, coded, near
        self.stream, self.bits, self.models = RangeDecoder(diff.stream), Models(bit_model), integers()
        self.first = [Filter([0.25] * 3, 0.1, FORGET) for _ in range(3)]
        self.later = [Filter([0.25] * 4 + [0.0] * 5, 0.1, FORGET) for _ in range(3)]
        self.frames, self.parents = [], []
        zeros = [0.0] * (coded + 1)
        self.zeros, m, same = [zeros] * 3, [zeros] * 3, [0] * (coded + 1)
        for f in range(frames):
            m, same = self.frame(f, m, same)
        self.stream.end()

    def frame(self, f, m_before, same_before):
        coded, near, stream = self.coded, self.near, self.stream
        x = [[0.0] * (coded + 1) for _ in range(3)]
        m, same = [[0.0] * (coded + 1) for _ in range(3)], [0] * (coded + 1)
        parent, before = None, None
        if f:
            r = f - 1 - stream.unsigned(self.models['distance'])
            need(r >= 0, 'ENTROPY', 'frame to predict from')
            self.parents.append(r)
            parent = self.frames[r]
            before = self.frames[self.parents[r]] if r else None
        else:
            self.parents.append(0)
        moved = [[0.0] * (coded + 1) for _ in range(3)]                       # D
        moved_before = [[a - b for a, b in zip(p, q)] for p, q in zip(parent, before)] if before else self.zeros   # D'
        for v in range(coded):
            n = near[v]
            if f:
                same[v] = stream.bit(self.bits['same', same_before[v], sum([same[u] for u in n])])
                if same[v]:
                    for c in range(3):
                        x[c][v], m[c][v] = parent[c][v], f32(0.5 * m_before[c][v])
                    continue
            for c in range(3):
                line, size, size_before = x[c], m[c], m_before[c]
                if f == 0:
                    base, filter_ = line[n[0]], self.first[c]
                    z = [line[u] - base for u in n[1:]]
                else:
                    base, filter_ = parent[c][v], self.later[c]
                    d, e = moved[c], moved_before[c]
                    z = [d[n[0]], d[n[1]], d[n[2]], d[n[3]], e[n[0]], e[n[1]], e[n[2]], e[n[3]], e[v]]
                y = filter_.y(z)
                p = base + y
                if not abs(p) <= LARGEST:
                    p = base
                if f == 0 and v == 0:
                    p = 0.0
                # Section 5: expected error.
                expected = 0.0
                for u in n:
                    expected += size[u]
                expected *= 0.25
                if f:
                    expected = 0.5 * (expected + size_before[v])
                if c:
                    expected = 0.6 * expected + 0.4 * m[c - 1][v]
                value = self.value(self.diff.lattices[c], c, p, expected)
                line[v] = value
                a = f32(abs(value - p))
                size[v] = f32(f32(SEVEN * a) + f32(THREE * size_before[v])) if f else a
                if f:
                    moved[c][v] = value - base
                if v % 2 == 0 and f or f == 0 and v:
                    filter_.learn(z, value - base - y, FORGET * self.diff.noise)
        self.frames.append(x)
        return m, same

    def value(self, lattice, c, p, expected):
        """A coordinate by its prediction p and the error that is expected (sections 3 and 5)."""
        bits = struct.unpack('<i', struct.pack('<f', p))[0]
        step = lattice.step if lattice else 2.0 ** (max(bits >> 23 & 255, 1) - 150)
        y = expected / step
        high = struct.unpack('<Q', struct.pack('<d', y))[0] >> 51
        q = self.stream.signed(self.models['residual', c, min(max(high - 2036, 0), 63)])
        if lattice is None:
            return number(wrap((bits if bits >= 0 else -1 - (bits & 0x7FFFFFFF)) + q))
        k = nearest(lattice, p) + q
        need(lattice.first <= k < lattice.first + lattice.count, 'ENTROPY', 'point of a lattice')
        if not lattice.errs:
            return number(point(lattice, k))
        known = k in lattice.errors
        e = self.stream.signed(self.models['error', c, 2 if known else lattice.erred])
        e = wrap(lattice.errors.get(k, 0) + e)
        if not known:
            lattice.erred = 0 if e == 0 else 1
        lattice.errors[k] = e
        return number(wrap(point(lattice, k) + e))

    def positions(self):
        """float32 [frame, vertex, axis]."""
        return np.array(self.frames, np.float64)[:, :, :self.coded].transpose(0, 2, 1).astype(np.float32)
