# SPDX-License-Identifier: CC0-1.0
"""Chapter 09d: exact positions. Arithmetic is in binary64 where a number is not rounded to binary32."""
import math
import struct
import numpy as np
from numpy import float32
from .conventions import check, clamp, total, xxh64
from .entropy import Bit, RangeDecoder, integers, defaultdict
from .reconstruction import linked
from .weights import Filter

LARGEST, MOST = float(np.finfo(float32).max), 2**31 - 1
bits_of = lambda x: int(float32(x).view(np.int32))      # rounded to binary32
ordinal = lambda x: bits_of(x) if bits_of(x) >= 0 else -1 - (bits_of(x) & MOST)
wrap = lambda i: i - 2 * MOST - 1 if i > MOST else i + 2 * MOST + 1 if i < -MOST else i

def number(i):
    check(-0x7F800000 <= i <= 0x7F7FFFFF, "ENTROPY", "no number of binary32")
    return struct.unpack("<f", struct.pack("<I", i if i >= 0 else -1 - i | 1 << 31))[0]

class Axis:  # State along one axis: its lattice, filters and models
    def __init__(self, lattice, errs, noise):
        self.lattice, self.errs, self.noise = lattice, errs, noise
        self.bits, self.errors, self.erred = integers(), {}, 0
        self.filters = Filter([0.25] * 3, 0.1, 0.999), Filter([0.25] * 4 + [0.0] * 5, 0.1, 0.999)
    def coordinate(self, decoder, p, expected):
        """Section 3: the coordinate that was predicted to be p, with an error of about what is expected."""
        lattice = self.lattice
        step = lattice.step if lattice else 2.0 ** (max(bits_of(p) >> 23 & 255, 1) - 150)
        bits = struct.unpack("<Q", struct.pack("<d", expected / step))[0]
        q = decoder.signed(self.bits["residual", clamp((bits >> 51) - 2036, 0, 63)])
        if lattice is None:
            return number(wrap(ordinal(p) + q))
        last = lattice.first + lattice.count - 1
        k = math.floor(clamp((p - lattice.origin) / lattice.step + 0.5, lattice.first, last)) + q
        check(lattice.first <= k <= last, "ENTROPY", "a point that the lattice does not have")
        point, known = ordinal(lattice.origin + k * lattice.step), k in self.errors
        if not self.errs:
            return number(point)
        e = wrap(self.errors.get(k, 0) + decoder.signed(self.bits["error", 2 if known else self.erred]))
        self.erred, self.errors[k] = self.erred if known else int(e != 0), e
        return number(wrap(point + e))

def read_exact(record, count, frames, triangles):
    """The positions of all frames, [frame, vertex, axis], bit for bit, and the hash of them."""
    decoder, distance, same = RangeDecoder(record.stream), defaultdict(Bit), defaultdict(Bit)
    axes = [Axis(record.lattices[c], record.axes >> 3 + c & 1, record.noise) for c in range(3)]
    near = [sorted((u for u in others if u < v), reverse=True)[:4] or [v - 1]
            for v, others in linked(count, triangles).items()]
    near = [[]] + [(others * 4)[:4] for others in near[1:]]             # section 2
    positions, source, repeated_before = [], [], [0] * count            # x, r and S' of the text
    misses_before = [[float32(0)] * 3] * count                          # m'
    for f in range(frames):
        r, x, repeated, misses = f - 1 - decoder.unsigned(distance) if f else 0, [], [], []
        check(r >= 0, "ENTROPY", "a frame before the first")
        positions.append(x)
        source.append(r)
        here, there = positions[r], positions[source[r]]
        for v, around in enumerate(near):
            repeated.append(f and decoder.bit(same[repeated_before[v], sum(repeated[u] for u in around)]))
            x.append(here[v] if repeated[v] else [])
            misses.append([float32(0.5) * miss for miss in misses_before[v]] if repeated[v] else [])
            for c, axis in enumerate(axes if not repeated[v] else []):
                base = here[v][c] if f else x[around[0]][c] if v else 0.0
                z = [x[u][c] - (here[u][c] if f else base) for u in around[f == 0:]] or [0.0] * (3 + (f > 0))
                if f:
                    z += [here[u][c] - there[u][c] for u in around] or [0.0] * 4
                    z += [base - there[v][c]]
                learner = axis.filters[f > 0]
                p = base + learner.expect(z)            # section 4
                p = p if abs(p) <= LARGEST else base
                expected = 0.25 * total(float(misses[u][c]) for u in around)            # section 5
                expected = 0.5 * (expected + float(misses_before[v][c])) if f else expected
                expected = 0.6 * expected + 0.4 * float(misses[v][c - 1]) if c else expected
                x[v].append(axis.coordinate(decoder, p, expected))
                miss = float32(abs(x[v][c] - p))
                misses[v].append(float32(0.7) * miss + float32(0.3) * misses_before[v][c] if f else miss)
                if v % 2 == 0 if f else v > 0:
                    learner.learn(z, x[v][c] - base, axis.noise)
        repeated_before, misses_before = repeated, misses
    decoder.end()
    exact = np.array(positions, "<f4")
    return exact, xxh64(exact.tobytes())
