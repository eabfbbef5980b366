# SPDX-License-Identifier: CC0-1.0
"""Chapter 08, sections 1 to 5: range coder, integers, mixed contexts, classes, rows."""
import struct
from .common import AnicError, need

LEARN = [65536 // (2 * n + 3) for n in range(256)]                  # R[n]


def bit_model():
    """An adaptive bit (section 1): fast, slow, n."""
    return [32768, 32768, 0]


class Models(dict):
    """Models that are made, in their initial state, when they are first used. Keys are names and indices."""

    def __init__(self, new):
        super().__init__()
        self.new = new

    def __missing__(self, key):
        value = self[key] = self.new()
        return value


def bits():
    return Models(bit_model)


def integers():
    """Integer models by name; each has an adaptive bit for each node (section 2)."""
    return Models(bits)


def probability(a):
    p = a[0] + a[1] >> 1
    return 16 if p < 16 else 65520 if p > 65520 else p


def learn_bit(a, b):
    fast, slow, n = a
    t = 65535 if b else 0
    a[0] = fast + ((t - fast) * LEARN[n if n < 14 else 14] >> 15)
    a[1] = slow + ((t - slow) * LEARN[n] >> 15)
    if n < 126:
        a[2] = n + 1


class RangeDecoder:
    """Section 1."""

    def __init__(self, data):
        self.data, self.size, self.position, self.range = data, len(data), 8, 2 ** 64 - 1
        self.code = int.from_bytes(data[:8].ljust(8, b'\0'), 'big')
        need(self.code != self.range, 'ENTROPY', 'begin')

    def _refill(self):
        word = self.data[self.position:self.position + 4]
        self.range, self.position = self.range << 32, self.position + 4
        self.code = (self.code << 32 | int.from_bytes(word.ljust(4, b'\0'), 'big')) & 0xFFFFFFFFFFFFFFFF
        need(self.position <= self.size + 8, 'ENTROPY', 'stream ran out')

    def decide(self, p):
        bound = (self.range >> 16) * p
        b = self.code < bound
        if b:
            self.range = bound
        else:
            self.code, self.range = self.code - bound, self.range - bound
        if self.range < 0x100000000:
            self._refill()
        return int(b)

    def raw(self, n):
        x = 0
        for _ in range(n):
            x = 2 * x + self.decide(32768)
        return x

    def bit(self, a):
        b = self.decide(probability(a))
        learn_bit(a, b)
        return b

    def either(self, a, c):
        """A decision with the mean of two adaptive bits, which both learn (section 6.1)."""
        b = self.decide(probability(a) + probability(c) >> 1)
        learn_bit(a, b)
        learn_bit(c, b)
        return b

    def part(self, starts):
        """A symbol; symbol s has starts[s] .. starts[s + 1] - 1 of 32768."""
        unit = self.range >> 15
        x = min(self.code // unit, 32767)
        s = 0
        while starts[s + 1] <= x:
            s += 1
        self.code -= unit * starts[s]
        if starts[s + 1] < 32768:
            self.range = unit * (starts[s + 1] - starts[s])
        else:
            self.range -= unit * starts[s]
        if self.range < 0x100000000:
            self._refill()
        return s

    take = part

    def _integer(self, model, limit, sign):
        """Section 2; `sign`: 0 never negative, 1 raw, 2 modelled."""
        bit = self.bit
        if not bit(model[0]):
            return 0
        negative = sign and (self.decide(32768) if sign == 1 else bit(model[1]))
        e = 0
        while e < limit and bit(model[2 + min(e, 19)]):
            e += 1
        x = 1
        if e > 0:
            b = 22 + 3 * (min(e, 14) - 1)
            x = 2 + bit(model[b])
            if e > 1:
                x = 2 * x + bit(model[b + 1 + (x & 1)])
            if e > 2:
                x = (x << e - 2) + self.raw(e - 2)
        return -x if negative else x

    def unsigned(self, model):
        return self._integer(model, 30, 0)

    def signed(self, model):
        return self._integer(model, 30, 1)

    def modelled(self, model, limit):
        return self._integer(model, limit, 2)

    def end(self):
        word = self.data[self.position - 8:self.position].ljust(8, b'\0')
        w = int.from_bytes(word, 'big')
        low = (w - self.code) & 0xFFFFFFFFFFFFFFFF
        zeros = 8 - len(word.rstrip(b'\0'))
        m = 64
        while (-low & (1 << m) - 1) >= self.range:
            m -= 1
        need(self.size + zeros == self.position and (-low & (1 << m) - 1) == self.code, 'ENTROPY', 'end of a stream')


# Section 3: stretch, squash, counters, mixing.

_E = [2 ** 32]
while len(_E) < 10250:
    _E.append(_E[-1] * 4290775039 >> 32)


def _squash_table():
    upper = [2 ** 48 // (2 ** 32 + _E[8 * i + 4]) for i in range(1280)]
    return [65536 - u for u in reversed(upper)] + upper


def _stretch_table():
    lower, x = [0] * 2048, 0
    for i in range(2047, -1, -1):
        o = 2 * i + 1
        while _E[x] * (8192 - o) > o * 2 ** 32:
            x += 1
        lower[i] = -((x + 2) >> 2)
    return lower + [-x for x in reversed(lower)]


SQUASH, STRETCH = _squash_table(), _stretch_table()       # SQUASH[i + 1280] is SQ[i]
RATE = [8 + 320 // (n + 8) for n in range(320)]           # L[n]


class Mixed:
    """A mixed model of one node (section 3). Contexts and selectors are any values that can be keys."""

    def __init__(self, contexts):
        first = [10649 // contexts] * contexts + [0, 0]   # weights, then their count
        self.counters = [Models(lambda: [2 ** 21, 0]) for _ in range(contexts)]
        self.weights = [Models(lambda: list(first)) for _ in range(2)]

    def read(self, stream, contexts, selector0, selector1=None):
        counters = [table[value] for table, value in zip(self.counters, contexts)]
        inputs = [STRETCH[k[0] >> 10] for k in counters]
        inputs.append(64)
        sets = (self.weights[0][selector0], self.weights[1][selector1])
        x0, x1 = (sum([w * i for w, i in zip(weights, inputs)]) for weights in sets)
        x = (x0 + x1 >> 1) >> 14
        b = stream.decide(SQUASH[0 if x < -1280 else 2559 if x > 1279 else x + 1280])
        target = 65535 if b else 0
        for weights, x in ((sets[0], x0), (sets[1], x1)):
            x >>= 14
            n = weights[-1]
            g = (target - SQUASH[0 if x < -1280 else 2559 if x > 1279 else x + 1280]) * RATE[n] >> 7
            for i, v in enumerate(inputs):
                w = weights[i] + (g * v + 8192 >> 14)
                weights[i] = -32768 if w < -32768 else 32767 if w > 32767 else w
            if n < 319:
                weights[-1] = n + 1
        target = 4194303 if b else 0
        for k in counters:
            p, n = k
            k[0] = p + ((target - p) * LEARN[n] >> 15)
            if n < 255:
                k[1] = n + 1
        return b


# Section 4: classes.

def lg(x):
    """floor_log2, of 0: 0."""
    return x.bit_length() - 1 if x else 0


def class_of(r, x, n):
    if x >> r:
        e = x.bit_length() - 1 - r
        x = (e << r) + (x >> e)
    return x if x < n else n - 1


def size_of(x, n, r):
    return class_of(r, x, n) if x >= 0 else -class_of(r, -x, n)


# Section 5: rows.

class Words:
    """The asymmetric numeral system of section 5."""

    def __init__(self, data):
        need(len(data) >= 16 and len(data) % 2 == 0, 'ENTROPY', 'size of a stream')
        self.states = list(struct.unpack('<4I', data[:16]))
        need(min(self.states) >= 65536, 'ENTROPY', 'states')
        self.words = struct.unpack('<%dH' % ((len(data) - 16) // 2), data[16:])
        self.turn = self.position = 0

    def slot(self):
        return self.states[self.turn] & 32767

    def advance(self, start, width):
        """The symbol that has `width` slots from `start` on was taken."""
        turn = self.turn
        y = self.states[turn]
        y = width * (y >> 15) + (y & 32767) - start
        if y < 65536:
            at = self.position
            if at >= len(self.words):
                raise AnicError('ENTROPY', 'stream ran out')
            y = y << 16 | self.words[at]
            self.position = at + 1
        self.states[turn] = y
        self.turn = turn + 1 & 3

    def take(self, starts):
        x, s = self.states[self.turn] & 32767, 0
        while starts[s + 1] <= x:
            s += 1
        self.advance(starts[s], starts[s + 1] - starts[s])
        return s

    def bit(self, a):
        one = probability(a) >> 1
        b = int(self.slot() < one)
        self.advance(*((0, one) if b else (one, 32768 - one)))
        learn_bit(a, b)
        return b

    def raw(self, n):
        if n > 12:
            high = self.raw(n - 12)
            return high << 12 | self.raw(12)
        if n == 0:
            return 0
        v = self.slot() >> 15 - n
        self.advance(v << 15 - n, 1 << 15 - n)
        return v

    def end(self):
        need(self.position == len(self.words) and self.states == [65536] * 4, 'ENTROPY', 'end of a stream')


def row():
    """A row: C[0 .. 6], then n."""
    return [4096, 8192, 12288, 16384, 20480, 24576, 28672, 1]


def started_row(u, v):
    """start(a, u, v)."""
    t, a = 32768, []
    for i in range(7):
        t = t * u // (u + v)
        a.append(32768 - max(t, 8 * (7 - i)))
    return a + [3]


def rows():
    return Models(row)


def learn(a, s):
    c0, c1, c2, c3, c4, c5, c6, n = a
    r = LEARN[n]
    a[:] = (c0 + (((0 if s > 0 else 32767) - c0) * r >> 15), c1 + (((0 if s > 1 else 32767) - c1) * r >> 15),
            c2 + (((0 if s > 2 else 32767) - c2) * r >> 15), c3 + (((0 if s > 3 else 32767) - c3) * r >> 15),
            c4 + (((0 if s > 4 else 32767) - c4) * r >> 15), c5 + (((0 if s > 5 else 32767) - c5) * r >> 15),
            c6 + (((0 if s > 6 else 32767) - c6) * r >> 15), n + 1 if n < 30 else 30)


def starts_of(m):
    starts, i = [0], 0
    for x in m:
        i += 8
        starts.append(x - (x >> 9) + i)
    starts.append(32768)
    return starts


def symbol(stream, a, b, c):
    """A symbol 0 .. 7 of three rows."""
    s = stream.take(starts_of([x + (y + z + 1 >> 1) + 1 >> 1 for x, y, z, _ in zip(a, b, c, range(7))]))
    learn(a, s)
    learn(b, s)
    learn(c, s)
    return s


def weighted(stream, four, w):
    """A symbol of four rows with weights w, which learn."""
    m = [sum([k * r[i] for k, r in zip(w, four)]) >> 15 for i in range(7)]
    starts = starts_of(m)
    s = stream.take(starts)
    inverse = 2 ** 24 // (starts[s + 1] - starts[s])
    u = []
    for k, r in zip(w, four):
        width = (r[s] if s < 7 else 32768) - (r[s - 1] if s else 0)
        g = min(width * inverse >> 16, 1023) - 256
        u.append(max(k + (k * g >> 12), 512))
    scale = 2 ** 30 // sum(u)
    w[:] = [x * scale >> 15 for x in u]
    for r in four:
        learn(r, s)
    return s


def number(stream, g, low):
    e = 0
    for i in range(4):
        p = symbol(stream, g[i], g[i], g[i])
        e += p
        if p < 7:
            break
    need(e + low < 24, 'ENTROPY', 'number')
    return (1 << e + low) + stream.raw(e + low)


def excess(stream, a, b, c, g):
    s = symbol(stream, a, b, c)
    if s < 7:
        n = s // 2 + 1
        return ((2 + s % 2) << n) + stream.raw(n) - 4
    return number(stream, g, 4) + 28


def magnitude(stream, s, more, g, low):
    """`more`: the three rows of what exceeds 7; `g`: four rows; `low`: bits that are as good as random."""
    if s == 0:
        return 0
    if s == 7:
        s = 7 + excess(stream, *more, g)
    need(s - 1 < 1 << 24 - low, 'ENTROPY', 'magnitude')
    return 1 + (s - 1 << low) + stream.raw(low)
