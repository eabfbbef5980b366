# SPDX-License-Identifier: CC0-1.0
"""Chapter 08, sections 1 to 5: range coder, integers, mixed contexts, classes, rows.

Models are in a defaultdict, in their initial state when first asked for; an integer model is one of bits."""
import struct
from bisect import bisect_right
from collections import defaultdict
from .conventions import check, clamp, floor_log2

RATE = [65536 // (2 * n + 3) for n in range(256)]       # R of the text
LEARNING = [8 + 320 // (n + 8) for n in range(320)]     # L

class Models(dict):                                     # Models whose initial state is `new` of their key
    def __init__(self, new):
        self.new = new
    __missing__ = lambda self, key: self.setdefault(key, self.new(*key))

class Bit:                                              # An adaptive bit (section 1)
    def __init__(self):
        self.fast, self.slow, self.n = 32768, 32768, 0
    probability = lambda self: clamp((self.fast + self.slow) >> 1, 16, 65520)
    def learn(self, bit):
        self.fast += (65535 * bit - self.fast) * RATE[min(self.n, 14)] >> 15
        self.slow += (65535 * bit - self.slow) * RATE[self.n] >> 15
        self.n = min(self.n + 1, 126)
        return bit

integers = lambda: defaultdict(lambda: defaultdict(Bit))                # integer models by their contexts

class Row:  # A distribution of eight symbols (section 5), as `start` leaves it where u and v are given
    def __init__(self, u=None, v=None):
        self.c, self.n, t = [4096 * (i + 1) for i in range(7)], 1 if u is None else 3, 32768
        for i in range(0 if u is None else 7):
            t = t * u // (u + v)
            self.c[i] = 32768 - max(t, 8 * (7 - i))
    def learn(self, symbol):
        rate, self.n = RATE[self.n], min(self.n + 1, 30)
        targets = [32767 if symbol <= i else 0 for i in range(7)]
        self.c = [c + ((target - c) * rate >> 15) for c, target in zip(self.c, targets)]

starts = lambda m: [0] + [m[i] - (m[i] >> 9) + 8 * (i + 1) for i in range(7)] + [32768]

def log_class(r, x, n):                                 # `class` of section 4
    e = floor_log2(x) - r
    return min(x if e < 0 else (e << r) + (x >> e), n - 1)

class Decoder:
    """Shared by both coders. They add bit, raw and end; `slot`, which says what symbol is next; and
    `advance`, which takes it: the one that has so many of 32768 slots from one on."""
    def unsigned(self, bits, negative=lambda: 0):
        """An integer (section 2), the sign of which `negative` reads."""
        if not self.bit(bits[0]):
            return 0
        minus, x, e = negative(), 1, 0
        while e < 30 and self.bit(bits[2 + min(e, 19)]):
            e += 1
        b = 22 + 3 * (min(e, 14) - 1)
        x = 2 + self.bit(bits[b]) if e > 0 else x
        x = 2 * x + self.bit(bits[b + 1 + (x & 1)]) if e > 1 else x
        x = (x << e - 2) + self.raw(e - 2) if e > 2 else x
        return -x if minus else x
    def signed(self, bits, modelled=False):
        return self.unsigned(bits, lambda: self.bit(bits[1]) if modelled else self.raw(1))
    def take(self, table, rows=()):                     # A symbol, and whose table it is, which learn it
        s = bisect_right(table, self.slot()) - 1
        self.advance(table[s], table[s + 1] - table[s])
        for row in rows:
            row.learn(s)
        return s
    def symbol(self, a, b, c):
        mean = [(x + ((y + z + 1) >> 1) + 1) >> 1 for x, y, z in zip(a.c, b.c, c.c)]
        return self.take(starts(mean), (a, b, c))
    def weighted(self, rows, weights):
        table = starts([sum(w * row.c[i] for w, row in zip(weights, rows)) >> 15 for i in range(7)])
        edges, s = [[0] + row.c + [32768] for row in rows], self.take(table, rows)
        scale = 2**24 // (table[s + 1] - table[s])
        gains = [min((c[s + 1] - c[s]) * scale >> 16, 1023) - 256 for c in edges]
        raised = [max(w + (w * g >> 12), 512) for w, g in zip(weights, gains)]
        weights[:] = [u * (2**30 // sum(raised)) >> 15 for u in raised]
        return s
    def number(self, rows, e):
        part = self.symbol(rows[0], rows[0], rows[0])
        if part == 7 and len(rows) > 1:
            return self.number(rows[1:], e + 7)
        check(e + part < 24, "ENTROPY", "a number too large")
        return (1 << e + part) + self.raw(e + part)
    def excess(self, rows, more):
        s = self.symbol(*rows)
        return ((2 + s % 2) << s // 2 + 1) + self.raw(s // 2 + 1) - 4 if s < 7 else self.number(more, 4) + 28
    def magnitude(self, s, rows, more, low):
        s += self.excess(rows, more) if s == 7 else 0
        check(s - 1 < 1 << 24 - low, "ENTROPY", "a number too large")
        return 1 + ((s - 1) << low) + self.raw(low) if s else 0

class RangeDecoder(Decoder):                            # The range coder of section 1
    def __init__(self, data):
        self.data, self.position, self.range = data, 8, 2**64 - 1
        self.code = int.from_bytes(data[:8].ljust(8, b"\0"), "big")
        check(self.code != self.range, "ENTROPY")
    def narrow(self, low, size):
        self.code, self.range = self.code - low, size
        if size < 2**32:
            word = self.data[self.position:self.position + 4].ljust(4, b"\0")
            self.code, self.range = (self.code << 32 | int.from_bytes(word, "big")) & 2**64 - 1, size << 32
            self.position += 4
            check(self.position <= len(self.data) + 8, "ENTROPY", "the stream has run out")
    def decide(self, p):
        bound = (self.range >> 16) * p
        b = int(self.code < bound)
        self.narrow(0 if b else bound, bound if b else self.range - bound)
        return b
    def bit(self, *models):  # A decision with a bit, or with two of them (`either` of section 6.1)
        b = self.decide(sum(model.probability() for model in models) // len(models))
        for model in models:
            model.learn(b)
        return b
    raw = lambda self, count: 2 * self.raw(count - 1) + self.decide(32768) if count else 0
    slot = lambda self: min(self.code // (self.range >> 15), 32767)
    def advance(self, low, size):
        unit = self.range >> 15
        self.narrow(unit * low, unit * size if low + size < 32768 else self.range - unit * low)
    def end(self, value=None):                          # nothing may follow; the value is what was read
        window = self.data[self.position - 8:self.position].ljust(8, b"\0")
        low, zeros = int.from_bytes(window, "big") - self.code, 8 - len(window.rstrip(b"\0"))
        step = next(1 << k for k in range(64, -1, -1) if -low % (1 << k) < self.range)
        check(len(self.data) + zeros == self.position and -low % step == self.code, "ENTROPY", "not the end")
        return value

class StateDecoder(Decoder):  # The asymmetric numeral system of section 5, whose four states take turns
    def __init__(self, data):
        check(len(data) >= 16 and len(data) % 2 == 0, "ENTROPY")
        self.states, self.position, self.turn = list(struct.unpack_from("<4I", data)), 0, 0
        self.words = struct.unpack_from(f"<{len(data) // 2 - 8}H", data, 16)
        check(min(self.states) >= 2**16, "ENTROPY")
    slot = lambda self: self.states[self.turn] & 32767
    def advance(self, low, size):
        y = size * (self.states[self.turn] >> 15) + self.slot() - low
        if y < 2**16:
            check(self.position <= len(self.words), "ENTROPY", "the stream has run out")
            y = (y << 16) + (self.words[self.position] if self.position < len(self.words) else 0)
            self.position += 1
        self.states[self.turn], self.turn = y, self.turn + 1 & 3
    bit = lambda self, model: model.learn(1 - self.take([0, model.probability() >> 1, 32768]))
    def raw(self, count):
        if count > 12:
            return (self.raw(count - 12) << 12) + self.raw(12)
        return self.take(range(0, 32769, 1 << 15 - count)) if count else 0
    def end(self, value=None):
        check(self.position == len(self.words) and self.states == [2**16] * 4, "ENTROPY", "not the end")
        return value

def tables():                                           # Squash, from -1280 on, and stretch of section 3
    power, lower, x = [2**32], [], 8 * 1280 - 1
    for _ in range(x):
        power.append(power[-1] * 4290775039 >> 32)
    upper = [2**48 // (2**32 + power[8 * i + 4]) for i in range(1280)]
    for o in range(1, 4096, 2):
        while x > 0 and power[x - 1] * (8192 - o) <= o << 32:
            x -= 1
        lower.append(-((x + 2) >> 2))
    return [65536 - value for value in reversed(upper)] + upper, lower + [-value for value in reversed(lower)]

SQUASH, STRETCH = tables()
squash = lambda x: SQUASH[clamp(x >> 14, -1280, 1279) + 1280]

class Mixed:
    """A mixed model of one node (section 3). Counters are pairs of p and n, weights have their n last."""
    def __init__(self, contexts):
        self.counters = defaultdict(lambda: (2**21, 0))
        self.weights = defaultdict(lambda: [10649 // contexts] * contexts + [0, 0])
    def read(self, decoder, contexts, selectors):
        contexts, selectors = list(enumerate(contexts)), list(enumerate(selectors))
        inputs = [STRETCH[self.counters[context][0] >> 10] for context in contexts] + [64]
        sums = [sum(w * x for w, x in zip(self.weights[selector], inputs)) for selector in selectors]
        b = decoder.decide(squash(sum(sums) >> 1))
        for selector, x in zip(selectors, sums):
            *weights, n = self.weights[selector]
            gain = (65535 * b - squash(x)) * LEARNING[n] >> 7
            self.weights[selector] = [clamp(w + ((gain * value + 8192) >> 14), -32768, 32767)
                                      for w, value in zip(weights, inputs)] + [min(n + 1, 319)]
        for context in contexts:
            p, n = self.counters[context]
            self.counters[context] = p + (((2**22 - 1) * b - p) * RATE[n] >> 15), min(n + 1, 255)
        return b
