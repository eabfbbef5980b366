# SPDX-License-Identifier: CC0-1.0
"""Chapter 08, section 6: time weights."""
import math
import numpy as np
from .common import sgn
from .entropy import Models, bit_model, class_of, lg, magnitude, row, weighted
from .filters import Filter

LIMIT, COEFFICIENT = 2 ** 26, 2 ** 22


def _clamp(x, limit):
    return -limit if x < -limit else limit if x > limit else x


def cosine_runs(frames):
    """Section 6.4: runs of at most 1024 frames."""
    runs = []
    while frames > 0:
        n = -(-frames // 1024)
        runs.append(frames // n)
        frames -= runs[-1]
    return runs


_tables = {}


def cosine_table(frames):
    """T[0 .. 4 F - 1], constant, u of section 6.4."""
    if frames in _tables:
        return _tables[frames]
    u = lg(frames) // 2
    scale = math.isqrt((2 ** 57 // frames) * 4 ** u)
    constant = math.isqrt((2 ** 56 // frames) * 4 ** u)
    table = [0] * (4 * frames)
    for m in range(frames):
        t = 3373259426 * m // (2 * frames)
        t = t * t >> 30
        x = 2 ** 30
        for i in range(16, 0, -2):
            x = 2 ** 30 - (t * x >> 30) // (i * (i - 1))
        v = scale * x + 2 ** 29 >> 30
        table[m] = table[-m % (4 * frames)] = v
        table[2 * frames - m] = table[2 * frames + m] = -v
    if len(_tables) > 16:
        _tables.clear()
    _tables[frames] = np.array(table, np.int64), constant, u
    return _tables[frames]


def cosine_inverse(q):
    """Values in 1/16 of the coefficients of one row."""
    frames = len(q)
    table, constant, u = cosine_table(frames)
    total = np.full(frames, constant * q[0] + 2 ** (23 + u), np.int64)
    odd = 2 * np.arange(frames, dtype=np.int64) + 1
    for k in range(1, frames):
        if q[k]:
            total += table[odd * k % (4 * frames)] * q[k]
    return np.clip(total >> (24 + u), -LIMIT, LIMIT).tolist()


def _mean_around(lines, at, weights):
    """Mean, rounded down, of m over all rows of a component around `at`; frames outside are left out."""
    total = count = 0
    reach = len(weights) // 2
    for i, w in enumerate(weights):
        f = at + i - reach
        if 0 <= f < len(lines[0]):
            count += w
            for line in lines:
                total += w * (64 * min(abs(line[f]), 65535))
    return total // (count * len(lines))


class TimeWeights:
    """A time weight model: components, one after the other, of streams that follow one another."""

    def __init__(self, runs):
        self.runs = runs
        self.rows, self.bits = Models(row), Models(bit_model)
        self.shares = Models(lambda: [8192] * 4)
        self.filters = {}
        self.last = {False: None, True: None}        # integers of the last component without, with cosine transform

    def component(self, stream, rows):
        """Values in 1/16 of a component: rows x frames."""
        p = 0
        while p < 2 and stream.bit(self.bits['B', p]):
            p += 1
        cosine = p == 2
        values, integers, start = [[] for _ in range(rows)], [[] for _ in range(rows)], 0
        self.g = [[0] * rows for _ in range(rows)]
        for frames in self.runs:
            for n in cosine_runs(frames) if cosine else [frames]:
                before = self.last[cosine]
                before = before and [line[start:start + n] for line in before]
                q, w = (self._transformed if cosine else self._frames)(stream, rows, n, before, p)
                for c in range(rows):
                    integers[c] += q[c]
                    values[c] += w[c]
                start += n
        self.last[cosine] = integers
        return values

    def _integer(self, stream, q, c, f, h, pattern, slow, a, b, d, x, i, y, s1, s2, low):
        """The integer of row c at f (section 6.1)."""
        z = low + 2
        g = self.g[c]
        v = 0
        for e in range(c):
            v += g[e] * sgn(q[e][f])
        t = 4 * pattern + (a > 0) + 2 * (slow >= 64)
        j, ca, cb, cd = class_of(1, x >> low, 18), class_of(0, a >> z, 16), class_of(0, b >> z, 16), class_of(
            0, d >> z, 16)
        rows = self.rows
        s = weighted(stream, (rows['X', h, j], rows['Z', h, ca, i], rows['W', h, cb, t], rows['Y', h, y, cd]),
                     self.shares[h, class_of(0, x >> 3, 8)])
        if s == 0:
            return 0
        m = magnitude(stream, s, (rows['XMore', h, j], rows['ZMore', h, ca], rows['WMore', h, cb]),
                      [rows['More', h, k] for k in range(4)], low)
        negative = stream.either(self.bits['K', h, sgn(v) * class_of(1, abs(v) >> 2, 16)],
                                 self.bits['S', 1 + min(y, 7) if h else 0, sgn(s1), sgn(s2)])
        return -m if negative else m

    def _learn_signs(self, q, c, f):
        """What g learns of the integer of row c at f."""
        x = q[c][f]
        if x:
            for e in range(c):
                g = self.g[c][e]
                self.g[c][e] = g + 32 * sgn(x) * sgn(q[e][f]) - sgn(g) * (abs(g) // 8)

    @staticmethod
    def _pattern(before, f):
        bits = 0
        if before:
            for i in range(3):
                if 0 <= f - 1 + i < len(before[0]) and any(line[f - 1 + i] for line in before):
                    bits |= 1 << i
        return bits

    def _frames(self, stream, rows, frames, before, p):
        """Sections 6.2 and 6.3: predictors 0 and 1."""
        q, w = [[] for _ in range(rows)], [[] for _ in range(rows)]
        m, slow = [[] for _ in range(rows)], [0] * rows
        for f in range(frames):
            d = _mean_around(before, f, (1, 2, 1)) if before else 512
            pattern = self._pattern(before, f)
            for c in range(rows):
                line = w[c]
                held = line[f - 1] if f else 0
                guess = held if f < 2 else 2 * line[f - 1] - line[f - 2]
                z, y, regression = self._regression(rows, c, line, q, f)
                a = 0 if f == 0 else m[c][0] if f == 1 else 5 * m[c][f - 1] + 3 * m[c][f - 2] >> 3
                b = 0
                if rows > 1:
                    b = (sum(m[e][f] for e in range(c)) + sum(m[e][f - 1] if f else 0 for e in range(c + 1, rows))
                         ) // (rows - 1)
                x = (2 * a + 2 * slow[c] + b + d) // 6
                low = max(lg(x >> 6) - 2, 0)
                s2 = held - regression >> 3 if p else held - guess
                n = self._integer(stream, q, c, f, 0, pattern, slow[c], a, b, d, x, class_of(0, slow[c] >> low + 2, 16),
                                  class_of(1, 4 * min(abs(guess - held), 2 ** 28) >> low, 26), q[c][f - 1] if f else 0,
                                  s2, low)
                q[c].append(n)
                line.append(_clamp((regression if p else guess) + 16 * n, LIMIT))
                self._learn_signs(q, c, f)
                m[c].append(64 * min(abs(n), 65535))
                slow[c] = 27 * slow[c] + 5 * m[c][f] >> 5
                size = slow[c] / 64
                self.filters[rows, c].learn(z, line[f] / 16 - y, 0.99 * (1 / 12 + size * size))
        return q, w

    def _regression(self, rows, c, w, q, f):
        """Inputs, y and P[1] of row c (section 6.3)."""
        if (rows, c) not in self.filters:
            self.filters[rows, c] = Filter([1.0, 1.0] + [0.0] * (2 + c), 0.04, 0.99)
        w1, w2, w3, w4 = (w[f - i] if f >= i else 0 for i in (1, 2, 3, 4))
        z = [w1 / 16 if f > 0 else 0.0, (w1 - w2) / 16 if f > 1 else 0.0, (w1 - 2 * w2 + w3) / 16 if f > 2 else 0.0,
             (w1 - 3 * w2 + 3 * w3 - w4) / 16 if f > 3 else 0.0]
        z += [float(q[e][f]) for e in range(c)]
        y = self.filters[rows, c].y(z)
        t = y * 4
        return z, y, 4 * (math.floor((t + 2 ** 24) + 0.5) - 2 ** 24) if -2 ** 24 < t < 2 ** 24 else 0

    def _transformed(self, stream, rows, frames, before, _):
        """Section 6.4: predictor 2."""
        q, m, slow = [[] for _ in range(rows)], [[] for _ in range(rows)], [256] * rows
        for k in range(frames):
            d = _mean_around(before, k, (1, 1, 1, 1, 1)) if before else 0
            pattern = self._pattern(before, k)
            for c in range(rows):
                a = 1280 if k == 0 else m[c][0] if k == 1 else 5 * m[c][k - 1] + 3 * m[c][k - 2] >> 3
                b = 0
                if rows > 1:
                    b = (sum(m[e][k] for e in range(c)) + sum(m[e][k - 1] if k else 640 for e in range(c + 1, rows))
                         ) // (rows - 1)
                x = (a + 2 * slow[c] + b + 2 * d) // 6
                low = max(lg(x >> 6) - 2, 0)
                n = self._integer(stream, q, c, k, 1, pattern, slow[c], a, b, d, x, lg(k), class_of(1, k, 26),
                                  q[c][k - 1] if k else 0, q[c][k - 2] if k > 1 else 0, low)
                q[c].append(_clamp(n, COEFFICIENT))
                self._learn_signs(q, c, k)
                m[c].append(64 * min(abs(n), 65535))
                slow[c] = 24 * slow[c] + 8 * m[c][k] >> 5
        return q, [cosine_inverse(line) for line in q]
