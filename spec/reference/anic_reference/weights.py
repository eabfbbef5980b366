# SPDX-License-Identifier: CC0-1.0
"""Chapter 08, sections 6 and 7: time weights, coefficients; filters, which 09b and 09d use, too."""
import math
import numpy as np
from .conventions import check, clamp, divide, floor_log2, sign, toward_zero, total
from .entropy import Bit, Models, Row, defaultdict, log_class

LIMIT, LONGEST = 2**26, 1024                            # of weights; frames of one transform
LINE, REGRESSION, COSINE = 0, 1, 2                      # predictors

def dot(a, b):                                          # The sum of a[i] b[i] from the left, from 0
    value = 0.0
    for x, y in zip(a, b):
        value += x * y
    return value

class Filter:
    """A regression that learns, in exact arithmetic: weights u and the matrix of its inputs (section 6.3)."""
    def __init__(self, weights, diagonal, forgetting):
        self.u, self.diagonal, self.forgetting = list(weights), diagonal, forgetting
        self.reset()
    def reset(self):
        size = range(len(self.u))
        self.matrix = [[self.diagonal if i == j else 0.0 for j in size] for i in size]
    expect = lambda self, z: dot(self.u, z)
    def learn(self, z, value, noise):                   # Learns that z went with the value
        error, gain = value - self.expect(z), [dot(row, z) for row in self.matrix]
        s = divide(1.0, total((x * g for x, g in zip(z, gain)), self.forgetting * noise))
        self.u = [u + (g * s) * error for u, g in zip(self.u, gain)]
        for i, row in enumerate(self.matrix):
            for j in range(i + 1):
                row[j] = self.matrix[j][i] = (row[j] - (gain[i] * gain[j]) * s) * (1.0 / self.forgetting)
        if not total(row[i] for i, row in enumerate(self.matrix)) < 1e12:
            self.reset()

mass = lambda q: 64 * min(abs(q), 65535)

class Component:  # The integers of a component in one run, by row, for those that follow
    def __init__(self, rows):
        self.count, self.masses = len(rows), [sum(map(mass, column)) for column in zip(*rows)]
    def around(self, f, weights):  # The weighted mean of the masses of all rows at the places around f
        first = f - len(weights) // 2
        places = range(len(self.masses))
        part = [(w, self.masses[first + i]) for i, w in enumerate(weights) if first + i in places]
        return sum(w * m for w, m in part) // (sum(w for w, _ in part) * self.count)
    def pattern(self, f):
        return sum(1 << i for i in range(3) if 0 <= f - 1 + i < len(self.masses) and self.masses[f - 1 + i])

class TimeWeights:
    """The model of the components of a segment, whose runs have so many frames. Rows and bits are named as in
    the text; `earlier` has the last components with the transform and without by run."""
    def __init__(self, runs):
        self.runs, self.rows, self.bits, self.earlier = runs, defaultdict(Row), defaultdict(Bit), {}
        self.row_weights = defaultdict(lambda: [8192] * 4)
        self.filters = Models(lambda count, row: Filter([1.0, 1.0, 0.0, 0.0] + [0.0] * row, 0.04, 0.99))
    def component(self, decoder, count):                # The weights of a component of `count` rows, in 1/16
        predictor = next((p for p in (0, 1) if not decoder.bit(self.bits["B", p])), COSINE)
        self.g, values = [[0] * count for _ in range(count)], [[] for _ in range(count)]
        h = int(predictor == COSINE)
        for key in ((h, run, part) for run, n in enumerate(self.runs) for part in enumerate(cut(n, h))):
            self.q, self.slow, last = [[] for _ in range(count)], [256 * h] * count, self.earlier.get(key)
            part = [[] for _ in range(count)]
            for f, c in ((f, c) for f in range(key[2][1]) for c in range(count)):
                if h:
                    self.transformed(decoder, c, f, last)
                else:
                    self.predicted(decoder, c, f, last, part[c], predictor)
            self.earlier[key] = Component(self.q)
            part = [inverse_cosine(row) for row in self.q] if h else part
            values = [row + more for row, more in zip(values, part)]
        return values
    def read(self, decoder, c, f, last, h, x, a, b, d, i_of, y_of, signs):
        """The integer of row c at f (section 6.1). i and y of the text depend on what follows from x."""
        low = max(floor_log2(x >> 6) - 2, 0)
        level = lambda z: log_class(0, z >> low + 2, 16)
        i, y, j = i_of(level), y_of(low), log_class(1, x >> low, 18)
        t = 4 * (last.pattern(f) if last else 0) + (a > 0) + 2 * (self.slow[c] >= 64)
        keys = ("X", h, j), ("Z", h, level(a), i), ("W", h, level(b), t), ("Y", h, y, level(d))
        s = decoder.weighted([self.rows[key] for key in keys], self.row_weights[h, log_class(0, x >> 3, 8)])
        more = [self.rows[key] for key in (("X", h, j, 7), ("Z", h, level(a)), ("W", h, level(b)))]
        q = decoder.magnitude(s, more, [self.rows["More", h, k] for k in range(4)], low)
        vote = sum(self.g[c][e] * sign(self.q[e][f]) for e in range(c))
        voted = self.bits["K", h, sign(vote) * log_class(1, abs(vote) >> 2, 16)]
        signed = self.bits["S", h and 1 + min(y, 7), sign(signs[0]), sign(signs[1])]
        q = -q if q and decoder.bit(voted, signed) else q
        q, r = (clamp(q, -2**22, 2**22), 8) if h else (q, 5)
        self.q[c].append(q)
        for e in range(c if q else 0):
            self.g[c][e] += 32 * sign(q) * sign(self.q[e][f]) - toward_zero(self.g[c][e], 8)
        self.slow[c] = ((32 - r) * self.slow[c] + r * mass(q)) >> 5
        return q
    def around(self, c, f, first, beside):
        """a and b of the text: the means of the two integers before and of the other rows."""
        q, rows = self.q[c], self.q
        a = first if f == 0 else mass(q[0]) if f == 1 else (5 * mass(q[f - 1]) + 3 * mass(q[f - 2])) >> 3
        b = [mass(row[f]) for row in rows[:c]] + [mass(row[f - 1]) if f else beside for row in rows[c + 1:]]
        return a, sum(b) // max(len(b), 1)
    def predicted(self, decoder, c, f, last, w, predictor):
        """A frame of a run from frame to frame (sections 6.2 and 6.3)."""
        one, two, three, four = (w[f - k] if f >= k else 0 for k in (1, 2, 3, 4))
        z = (one, one - two, one - 2 * two + three, one - 3 * two + 3 * three - four)
        z = [value / 16 if f > k else 0.0 for k, value in enumerate(z)]
        z += [float(self.q[e][f]) for e in range(c)]
        learner, slow, line = self.filters[len(self.q), c], self.slow[c], one if f < 2 else 2 * one - two
        t = learner.expect(z) * 4
        regression = 4 * (math.floor((t + 2.0**24) + 0.5) - 2**24) if -2.0**24 < t < 2.0**24 else 0
        (a, b), d = self.around(c, f, 0, 0), last.around(f, (1, 2, 1)) if last else 512
        signs = self.q[c][f - 1] if f else 0, one - line if predictor == LINE else (one - regression) >> 3
        q = self.read(decoder, c, f, last, 0, (2 * a + 2 * slow + b + d) // 6, a, b, d,
                      lambda level: level(slow),
                      lambda low: log_class(1, 4 * min(abs(line - one), 2**28) >> low, 26), signs)
        w.append(clamp((regression if predictor == REGRESSION else line) + 16 * q, -LIMIT, LIMIT))
        n = self.slow[c] / 64
        learner.learn(z, w[f] / 16, 1 / 12 + n * n)
    def transformed(self, decoder, c, k, last):         # A coefficient of the cosine transform (section 6.4)
        (a, b), d = self.around(c, k, 1280, 640), last.around(k, (1,) * 5) if last else 0
        signs = [self.q[c][k - i] if k >= i else 0 for i in (1, 2)]
        self.read(decoder, c, k, last, 1, (a + 2 * self.slow[c] + b + 2 * d) // 6, a, b, d,
                  lambda level: floor_log2(k), lambda low: log_class(1, k, 26), signs)

def cut(frames, by_cosine):                             # The runs that a run is for the cosine transform
    count, sizes = -(-frames // LONGEST) if by_cosine else 1, []
    for left in range(count, 0, -1):
        sizes.append((frames - sum(sizes)) // left)
    return sizes

def inverse_cosine(q):                                  # The values of a row, in integers
    count, u = len(q), floor_log2(len(q)) // 2
    scale, constant = math.isqrt((2**57 // count) * 4**u), math.isqrt((2**56 // count) * 4**u)
    def cosine(m):
        t, x = 3373259426 * m // (2 * count), 2**30
        for i in range(16, 0, -2):
            x = 2**30 - toward_zero((t * t >> 30) * x >> 30, i * (i - 1))
        return x
    quarter = [(scale * cosine(m) + 2**29) >> 30 for m in range(count)] + [0]
    half = quarter[:count] + [-value for value in reversed(quarter)]                    # T[0] .. T[2 F]
    table, spectrum, k = np.array(half + half[-2:0:-1]), np.array(q[1:], np.int64), np.arange(1, count)
    sums = [constant * q[0] + int(np.dot(table[(2 * f + 1) * k % (4 * count)], spectrum))
            for f in range(count)]
    return [clamp((value + (1 << 23 + u)) >> 24 + u, -LIMIT, LIMIT) for value in sums]

BATCH = 32
NEAR, HEAD_START = (6, 5, 4, 3, 3, 2), (4, 2, 2, 2, 0, 0, 0, 0)         # weights of neighbours; H of the text
# the least number of a class, of `octave` classes to an octave; twice the middle of one of two
least = lambda c, octave: c if c < 2 * octave else (octave + c % octave) << c // octave - 1
middle = lambda c: least(c, 2) + least(c + 1, 2)

class Coefficients:
    """The model of the residuals. `order` is that of 09, section 1: vertices are named by their ranks."""
    def __init__(self, order, channels):
        self.count, self.levels, self.channels = len(order.neighbours), order.levels, channels
        self.neighbours = [(near + [-1] * 8)[:8] for near in order.neighbours]  # -1, the last place: none
        self.scale, self.unit = 2**20 // (23 * channels), 128 // channels
        self.history, self.past, self.around = ([0] * self.count for _ in range(3))
        self.agree, self.share = [[0] * 8 for _ in range(self.count)], [1638, 2458, 2458, 819, 1638]
        self.coded = self.recent = 0                    # j and `recent` of the text
        self.any, self.signs, self.more = defaultdict(Bit), defaultdict(Bit), defaultdict(Row)
        self.expect = Models(lambda x, s: Row(2 * least(x, 4) + 1, 256))
        self.nearby = Models(lambda x, y, s: Row(11 * (middle(x) + 3 * middle(y)), 2048))
        self.earlier = Models(lambda x, k, s: Row(middle(x), 64))
    def component(self, decoder):  # The residuals of the next component: a list of channels for each vertex
        first, self.run, self.mass, self.near = 0, 0, [0] * (self.count + 1), [0] * self.count
        self.residuals = [[0] * self.channels for _ in range(self.count + 1)]
        for size in self.levels:
            for start in range(first, first + size, BATCH):
                self.batch(decoder, range(start, min(start + BATCH, first + size)))
            first += size
        for v in range(self.count):
            m, n = self.mass[v] * self.unit, self.near[v] * self.scale >> 13
            self.history[v] += (m - self.history[v]) >> 1
            self.past[v] += 5 * (m - self.past[v]) >> 5
            self.around[v] += 5 * (n - self.around[v]) >> 5
        self.coded += 1
        return self.residuals[:-1]
    def batch(self, decoder, vertices):
        likely, signals, expected, contexts, sums = 0, {}, {}, {}, dict.fromkeys(vertices, 0)
        for v in vertices:
            self.near[v] = sum(k * self.mass[w] for k, w in zip(NEAR, self.neighbours[v]))
            likely += (self.near[v] * self.scale >> 16) + ((self.history[v] + self.past[v]) >> 3)
        if likely < 512:
            some = decoder.bit(self.any[log_class(2, likely >> 1, 32), self.recent])
            self.recent = (2 * self.recent + some) & 3
            if not some:
                self.run = 3 * self.run >> 3
                return
        for v in vertices:
            n, history, past = self.near[v] * self.scale >> 13, self.history[v], self.past[v]
            both = min((past + 4) * (n + 2) // (self.around[v] + 4), 32767)
            signals[v] = n, history, past, self.run, both
            expected[v] = e = min(sum(f * share for f, share in zip(signals[v], self.share)) >> 13, 32767)
            contexts[v] = ((log_class(2, e, 56),), (log_class(1, n >> 3, 20), log_class(1, history >> 3, 20)),
                           (log_class(1, past >> 2, 20), min(self.coded, 7)))
        for c in range(self.channels):
            symbols = {}
            for v, (x, a, b) in contexts.items():
                s = (0 if c == 0 else 1 if sums[v] == 0 else 2 if sums[v] <= 2 * c else 3,)
                symbols[v] = decoder.symbol(self.expect[x + s], self.nearby[a + s], self.earlier[b + s])
                sums[v] += symbols[v]
            for v, z in symbols.items():
                (x, a, b), far = contexts[v], [self.more[contexts[v][0][0] >> 2, k] for k in range(4)]
                more = [self.more[name] for name in (("x", x), ("a", a), ("b", b))]
                z += decoder.excess(more, far) if z == 7 else 0
                sums[v] += z - symbols[v]
                check(z < 2**24, "ENTROPY", "a residual too large")
                self.residuals[v][c] = -z if z and self.negative(decoder, v, c) else z
        self.learn(vertices, signals, expected, sums)
    def negative(self, decoder, v, c):
        signs = [sign(self.residuals[w][c]) for w in self.neighbours[v]]
        agreed = sum(s * (a + h) for s, a, h in zip(signs, self.agree[v], HEAD_START))
        b = decoder.bit(self.signs[sign(agreed) * log_class(1, abs(agreed), 21)])
        self.agree[v] = [a - (a >> 3) + (-14 if b else 14) * s for a, s in zip(self.agree[v], signs)]
        return b
    def learn(self, vertices, signals, expected, sums):
        gain, norm = [0] * 5, 200
        for v in vertices:
            self.mass[v], inputs = min(sums[v], 255), [f >> 3 for f in signals[v]]
            error = (min(self.mass[v] * self.unit, 3 * expected[v] + 256) - expected[v]) >> 3
            gain, norm = [g + error * x for g, x in zip(gain, inputs)], norm + sum(x * x for x in inputs)
        moved = [share + (g * 1024 >> floor_log2(norm)) for share, g in zip(self.share, gain)]
        self.share = [clamp(share, 0, 16383) for share in moved]
        mass = sum(self.mass[v] for v in vertices)
        self.run = (3 * self.run + 5 * (self.unit * mass // len(vertices))) >> 3
