#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""The range coder and the plain integers of spec/08-entropy.md, sections 1 and 2, written from that text alone.

usage: range_coder.py                prints the worked example of spec/A-examples.md: a stream decision by decision
       range_coder.py check PAGE     checks that PAGE shows the example as it comes out here; exit status 1 if not
"""
import pathlib
import sys

R = [65536 // (2 * n + 3) for n in range(256)]
EXAMPLE = (3, -1, 0, 5)


class AdaptiveBit:
    """Two averages of the bits seen."""

    def __init__(self):
        self.fast = self.slow = 32768
        self.n = 0

    def probability(self):
        """The probability of a 1, in 1/65536."""
        return min(max(self.fast + self.slow >> 1, 16), 65520)

    def update(self, b):
        """Learns a bit."""
        t = 65535 if b else 0
        self.fast += (t - self.fast) * R[min(self.n, 14)] >> 15
        self.slow += (t - self.slow) * R[self.n] >> 15
        self.n = min(self.n + 1, 126)


class Encoder:
    """Writes decisions as bytes."""

    def __init__(self):
        self.low, self.range, self.shifted = 0, (1 << 64) - 1, 0

    def decide(self, p, b):
        """One decision of probability p / 65536."""
        bound = (self.range >> 16) * p
        if b:
            self.range = bound
        else:
            self.low += bound
            self.range -= bound
        if self.range < 1 << 32:
            self.low <<= 32
            self.range <<= 32
            self.shifted += 4

    def finish(self):
        """The bytes of the number in [low, low + range) with the most zero bits at its end."""
        for zeros in range(64, -1, -1):
            number = -(-self.low >> zeros) << zeros
            if number < self.low + self.range:
                break
        data = number.to_bytes(self.shifted + 8, "big")
        return data[:len(data) - min(8, len(data) - len(data.rstrip(b"\0")))]


class Decoder:
    """Reads them back."""

    def __init__(self, data):
        self.data, self.position, self.code, self.range = data, 0, 0, (1 << 64) - 1
        for _ in range(8):
            self.code = self.code << 8 | self._next()
        if self.code == self.range:
            raise ValueError("ENTROPY")

    def _next(self):
        self.position += 1
        return self.data[self.position - 1] if self.position <= len(self.data) else 0

    def decide(self, p, _=None):
        """One decision of probability p / 65536."""
        bound = (self.range >> 16) * p
        b = self.code < bound
        if b:
            self.range = bound
        else:
            self.code -= bound
            self.range -= bound
        if self.range < 1 << 32:
            self.range <<= 32
            for _ in range(4):
                self.code = (self.code << 8 | self._next()) & (1 << 64) - 1
            if self.position > len(self.data) + 8:
                raise ValueError("ENTROPY")
        return int(b)

    def finish(self):
        """The check of the stream's end."""
        last = bytes(self.data[i] if i < len(self.data) else 0 for i in range(self.position - 8, self.position))
        w = int.from_bytes(last, "big")
        low = w - self.code & (1 << 64) - 1
        z = 8 - len(last.rstrip(b"\0"))
        m = 1 << 64
        while -low % m >= self.range:
            m >>= 1
        if len(self.data) + z != self.position or -low % m != self.code:
            raise ValueError("ENTROPY")


class Signed:
    """The model signed(S): codes integers with an Encoder, or reads them with a Decoder, and reports each decision."""

    def __init__(self, coder, report=lambda *_: None):
        self.coder, self.report, self.bits = coder, report, {}

    def _decide(self, node, b):
        model = self.bits.setdefault(node, AdaptiveBit()) if node is not None else None
        p = model.probability() if model else 32768
        before = self.coder.range
        seen = self.coder.decide(p, b)
        b = b if seen is None else seen
        if model:
            model.update(b)
        self.report(node, p, before, b)
        return b

    def code(self, x=0):
        """Codes x, or reads it."""
        if not self._decide(0, int(x != 0)):
            return 0
        negative = self._decide(None, int(x < 0))
        magnitude, e = abs(x), 0
        want = magnitude.bit_length() - 1
        while e < 30 and self._decide(2 + min(e, 19), int(e < want)):
            e += 1
        y = 1
        bit = lambda k: magnitude >> max(e - k, 0) & 1
        if e > 0:
            b = 22 + 3 * (min(e, 14) - 1)
            y = 2 * y + self._decide(b, bit(1))
            if e > 1:
                y = 2 * y + self._decide(b + 1 + (y & 1), bit(2))
            for k in range(3, e + 1):
                y = 2 * y + self._decide(None, bit(k))
        return -y if negative else y


def example():
    """The lines of the worked example."""
    encoder = Encoder()
    model = Signed(encoder)
    for x in EXAMPLE:
        model.code(x)
    data = encoder.finish()
    yield f"bytes     {data.hex(' ')}"
    yield "x   node  p      range             code              bit"
    decoder = Decoder(data)
    rows = []
    before = [decoder.code]

    def report(node, p, before_range, b):
        rows.append(f"{'raw' if node is None else node!s:<4}  {p:<5}  {before_range:016x}  {before[0]:016x}  {b}")
        before[0] = decoder.code

    model = Signed(decoder, report)
    for x in EXAMPLE:
        if (seen := model.code()) != x:
            raise ValueError(f"{seen} is read, not {x}")
        for i, row in enumerate(rows):
            yield f"{x if i == 0 else '':<3} {row}"
        rows.clear()
    yield f"end                  {decoder.range:016x}  {decoder.code:016x}"
    decoder.finish()


def main():
    lines = "\n".join(example())
    if sys.argv[1:2] == ["check"] and len(sys.argv) == 3:
        if lines not in pathlib.Path(sys.argv[2]).read_text(encoding="utf-8"):
            sys.exit(f"{sys.argv[2]} does not show:\n{lines}")
    elif len(sys.argv) > 1:
        sys.exit(__doc__)
    print(lines)


if __name__ == "__main__":
    main()
