# SPDX-License-Identifier: CC0-1.0
"""Chapter 08, section 7: residuals of the coefficients of a basis."""
import numpy as np
from .common import need
from .entropy import Models, bit_model, class_of, excess, row, size_of, started_row, symbol

AGREED = (4, 2, 2, 2, 0, 0, 0, 0)                    # H
NEAR = (6, 5, 4, 3, 3, 2)


def _low(c):
    return c if c < 2 else (2 + (c & 1)) * 2 ** (c // 2 - 1)


def _middle(c):
    return _low(c) + _low(c + 1)


def _least(c):
    return c if c < 4 else (4 + (c & 3)) * 2 ** (c // 4 - 1)


class StartedRows(dict):
    """Rows whose first state depends on their contexts."""

    def __init__(self, start):
        super().__init__()
        self.start = start

    def __missing__(self, key):
        value = self[key] = started_row(*self.start(*key))
        return value


def _f(x):
    return class_of(1, x, 20)


class Coefficients:
    """The coefficient model. Vertices are ranks; `levels` are numbers of vertices in decoding order."""

    def __init__(self, levels, neighbours, channels):
        n = len(neighbours)
        self.n, self.levels, self.channels = n, levels, channels
        self.s, self.unit = 2 ** 20 // (23 * channels), 128 // channels
        self.eight = [list(line[:8]) + [n] * (8 - len(line[:8])) for line in neighbours]     # n is none
        self.eight_array = np.array(self.eight, np.int64).reshape(n, 8)
        self.hist, self.past, self.around = (np.zeros(n, np.int64) for _ in range(3))
        self.agree = [[0] * 8 for _ in range(n)]
        self.j, self.recent, self.share = 0, 0, np.array([1638, 2458, 2458, 819, 1638], np.int64)
        self.bits, self.rows = Models(bit_model), Models(row)
        self.expect = StartedRows(lambda x, s: (2 * _least(x) + 1, 256))
        self.near_rows = StartedRows(lambda x, y, s: (11 * (_middle(x) + 3 * _middle(y)), 2048))
        self.past_rows = StartedRows(lambda x, k, s: (_middle(x), 64))

    def component(self, stream):
        """Residuals of the next component: int64 [rank, channel]."""
        n = self.n
        self.q = np.zeros((n, self.channels), np.int64)
        mag = np.zeros(n + 1, np.int64)
        near = np.zeros(n, np.int64)
        self.sign = [[0] * (n + 1) for _ in range(self.channels)]
        self.run, start = 0, 0
        for count in self.levels:
            if count == 0:
                continue
            where = slice(start, start + count)
            level = self.eight_array[where]
            for a, factor in enumerate(NEAR):
                near[where] += factor * mag[level[:, a]]
            totals = (near[where] * self.s >> 16) + (self.hist[where] + self.past[where] >> 3)
            totals = np.add.reduceat(totals, np.arange(0, count, 32)).tolist()
            for i, total in enumerate(totals):
                batch = slice(start + 32 * i, start + min(32 * i + 32, count))
                self._batch(stream, batch, total, near, mag)
            start += count
        m, near = mag[:n] * self.unit, near * self.s >> 13
        self.hist += m - self.hist >> 1
        self.past += 5 * (m - self.past) >> 5
        self.around += 5 * (near - self.around) >> 5
        self.j += 1
        return self.q

    def _batch(self, stream, batch, total, near, mag):
        if total < 512:
            a = stream.bit(self.bits['Any', class_of(2, total >> 1, 32), self.recent])
            self.recent = (2 * self.recent + a) & 3
            if not a:
                self.run = 3 * self.run >> 3
                return
        count = batch.stop - batch.start
        hist, past = self.hist[batch], self.past[batch]
        n = near[batch] * self.s >> 13
        f = np.stack((n, hist, past, np.full(count, self.run, np.int64),
                      np.minimum((past + 4) * (n + 2) // (self.around[batch] + 4), 32767)))
        e = np.minimum((f * self.share[:, None]).sum(0) >> 13, 32767)
        xs = [class_of(2, x, 56) for x in e.tolist()]
        spaces = [(_f(x >> 3), _f(y >> 3)) for x, y in zip(n.tolist(), hist.tolist())]
        j = min(self.j, 7)
        times = [(_f(x >> 2), j) for x in past.tolist()]
        sums = [0] * count
        expect, near_rows, past_rows, rows = self.expect, self.near_rows, self.past_rows, self.rows
        for c in range(self.channels):
            some = []
            for v in range(count):
                total = sums[v]
                s = 0 if c == 0 else 1 if total == 0 else 2 if total <= 2 * c else 3
                z = symbol(stream, expect[xs[v], s], near_rows[spaces[v] + (s,)], past_rows[times[v] + (s,)])
                if z:
                    sums[v] = total + z
                    some.append((v, z))
            for v, z in some:
                if z == 7:
                    x = xs[v]
                    more = excess(stream, rows['Expect', x], rows['Near', spaces[v]], rows['Past', times[v]],
                                  [rows['Far', x >> 2, k] for k in range(4)])
                    z += more
                    sums[v] += more
                    need(z < 2 ** 24, 'ENTROPY', 'residual')
                self.q[batch.start + v, c] = -z if self._negative(stream, batch.start + v, c) else z
        m = np.minimum(np.array(sums, np.int64), 255)
        mag[batch] = m
        error = np.minimum(m * self.unit, 3 * e + 256) - e >> 3
        x = f >> 3
        g = (x * error).sum(1)
        norm = 200 + int((x * x).sum())
        self.share = np.clip(self.share + (g * 1024 >> norm.bit_length() - 1), 0, 16383)
        self.run = 3 * self.run + 5 * (self.unit * int(m.sum()) // count) >> 3

    def _negative(self, stream, v, c):
        sign, agree, agreed = self.sign[c], self.agree[v], 0
        signs = [sign[w] for w in self.eight[v]]
        for s, a, h in zip(signs, agree, AGREED):
            if s:
                agreed += s * (a + h)
        b = stream.bit(self.bits['Sign', size_of(agreed, 21, 1)])
        t = -14 if b else 14
        self.agree[v] = [a - (a >> 3) + t * s for a, s in zip(agree, signs)]
        sign[v] = -1 if b else 1
        return b
