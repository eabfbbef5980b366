#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Numbers to check a decoder by, worked out from the text of spec/09, 09b and 09d alone, in hexadecimal.

usage: check_numbers.py [PAGE...]
Prints them; with pages of the specification, names those that none of the pages shows (exit status 1).
"""
import math
import pathlib
import struct
import sys


def f32(x):
    """The nearest number of binary32: of one operation of binary64 on such numbers, the operation of binary32."""
    return struct.unpack("<f", struct.pack("<f", x))[0]


def shown(numbers):
    """Numbers in a line, as short as C's %a and Python's float.fromhex() read them."""
    def one(x):
        if isinstance(x, int):
            return str(x)
        sign, digits = ("-", x.hex()[1:]) if math.copysign(1, x) < 0 else ("", x.hex())
        mantissa, exponent = digits.split("p")
        return sign + (mantissa.rstrip("0").rstrip(".") if "." in mantissa else mantissa) + "p" + exponent
    return " ".join(one(x) for x in numbers)


class Solver:
    """Section 3 of spec/09."""

    def __init__(self, matrix, ridge):
        n = self.n = len(matrix)
        self.low, self.inverse, diagonal = [[0.0] * n for _ in range(n)], [0.0] * n, [0.0] * n
        for j in range(n):
            t = [f32(self.low[j][p] * diagonal[p]) for p in range(j)]
            x = f32(matrix[j][j] + ridge)
            for p in range(j):
                x = f32(x - f32(self.low[j][p] * t[p]))
            diagonal[j], self.inverse[j] = x, f32(1 / x)
            for i in range(j + 1, n):
                x = matrix[i][j]
                for p in range(j):
                    x = f32(x - f32(self.low[i][p] * t[p]))
                self.low[i][j] = f32(x * self.inverse[j])

    def solve(self, right):
        """x of the equations."""
        x = list(right)
        for i in range(self.n):
            for p in range(i):
                x[i] = f32(x[i] - f32(self.low[i][p] * x[p]))
        x = [f32(a * b) for a, b in zip(x, self.inverse)]
        for i in reversed(range(self.n)):
            for p in range(i + 1, self.n):
                x[i] = f32(x[i] - f32(self.low[p][i] * x[p]))
        return x


def total(terms):
    """A sum in binary32, from 0."""
    result = 0.0
    for term in terms:
        result = f32(result + term)
    return result


RANK = [(10, 0, 0), (0, 12, 1), (-9, 3, 0), (2, -11, 2), (7, 8, -3), (-5, -6, 4)]
SAMPLE, RESIDUAL, OMEGA, RADIUS = [-3.0, 5.5, 1.25, -0.5, 7.0, 2.0], 3, 130, 12


def prediction_numbers():
    """spec/09, section 7: a rank at 0 of six neighbours, m = 8."""
    m, one = 8, f32(1.0)
    valid = [one] * len(RANK) + [0.0] * (m - len(RANK))
    x = [list(map(float, p)) for p in RANK] + [[0.0] * 3 for _ in range(m - len(RANK))]

    def dot(a, b):
        return f32(f32(f32(a[0] * b[0]) + f32(a[1] * b[1])) + f32(a[2] * b[2]))

    lengths = [f32(math.sqrt(dot(p, p))) for p in x]
    scale = f32(total(valid) / total(lengths))
    x = [[f32(c * scale) for c in p] for p in x]
    lengths = [f32(length * scale) for length in lengths]
    inverse = f32(1 / f32(RADIUS))

    def phi(z):
        t = f32(z * inverse)
        u = max(f32(1 - t), 0.0)
        w = f32(u * u)
        return f32(f32(w * w) * f32(f32(4 * t) + 1))

    right = [f32(valid[a] * f32(100 + f32(10 * phi(lengths[a])))) for a in range(m)]
    matrix = [[0.0] * m for _ in range(m)]
    for a in range(m):
        for k in range(a + 1):
            e = [f32(p - q) for p, q in zip(x[a], x[k])]
            near = phi(f32(math.sqrt(dot(e, e))))
            matrix[a][k] = f32(f32(valid[a] * valid[k]) * f32(f32(100 + f32(10 * dot(x[a], x[k]))) + f32(10 * near)))
    w0 = Solver(matrix, f32(0.02)).solve(right)
    sample = SAMPLE + [0.0] * (m - len(SAMPLE))
    p = p0 = total(f32(a * b) for a, b in zip(w0, sample))
    u = f32(f32(f32(p * 64) + 12582912) - 12582912)
    y = f32(f32(u * f32(1 / 64)) + RESIDUAL)
    e = f32(y - p0)
    omega = f32(struct.unpack(">f", bytes.fromhex(("3F800000", "3F9837F0", "3FB504F3", "3FD744FD")[OMEGA % 4]))[0] *
                2.0 ** (OMEGA // 4 - 32))
    z = [f32(value * omega) for value in sample]
    moments = [[f32(0.0 + f32(z[a] * sample[b])) if b <= a else 0.0 for b in range(m)] for a in range(m)]
    g = [f32(0.0 + f32(value * e)) for value in z]
    ridge = f32(f32(0.3) + f32(total(moments[a][a] for a in range(m)) * f32(1e-5 / m)))
    w = [f32(a + b) for a, b in zip(w0, Solver(moments, ridge).solve(g))]
    yield "scale", [scale]
    yield "M[1][0..1], M[5][4]", [*matrix[1][:2], matrix[5][4]]
    yield "w0", w0
    yield "p0, y, e", [p0, y, e]
    yield "A[1][0..1], A[5][4]", [*moments[1][:2], moments[5][4]]
    yield "g", g
    yield "ridge", [ridge]
    yield "w", w


class Filter:
    """Section 6.3 of spec/08, with another factor of forgetting."""

    def __init__(self, weights, diagonal, keep):
        self.u, self.diagonal, self.keep = list(weights), diagonal, keep
        self.reset()

    def reset(self):
        """The matrix as at first."""
        n = len(self.u)
        self.matrix = [[self.diagonal if i == j else 0.0 for j in range(n)] for i in range(n)]

    def y(self, z):
        """The expected number."""
        result = 0.0
        for weight, value in zip(self.u, z):
            result += weight * value
        return result

    def learn(self, z, value, noise):
        """z went with the value."""
        error, d, gains = value - self.y(z), self.keep * noise, []
        for row in self.matrix:
            gain = 0.0
            for a, b in zip(row, z):
                gain += a * b
            gains.append(gain)
        for a, gain in zip(z, gains):
            d += a * gain
        s = 1 / d
        for i, gain in enumerate(gains):
            self.u[i] += gain * s * error
        trace = 0.0
        for i, row in enumerate(self.matrix):
            for j, old in enumerate(row):
                row[j] = (old - gains[i] * gains[j] * s) * (1 / self.keep)
            trace += row[i]
        if not trace < 1e12:
            self.reset()


def added(a, b):
    return [p + q for p, q in zip(a, b)]


def less(a, b):
    return [p - q for p, q in zip(a, b)]


def times(factor, a):
    return [factor * p for p in a]


def dot3(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def length(a):
    return math.sqrt(dot3(a, a))


TRIANGLES = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)]
POSE = [(0, 0, 10), (100, 5, 0), (8, 96, -7), (-104, 3, 4), (-6, -99, 12)]


class Pose:
    """spec/09b, sections 3, 4 and 7, of a mesh whose vertices have few corners, without places to follow."""

    def __init__(self):
        corners = [v for t in TRIANGLES for v in t]
        self.vertex = corners
        self.corners_at = {v: [c for c, w in enumerate(corners) if w == v] for v in set(corners)}
        edges = {}
        self.opposite = {}
        for c in range(len(corners)):
            key = tuple(sorted((corners[self.next(c)], corners[self.previous(c)])))
            if key in edges:
                other = edges.pop(key)
                self.opposite[c], self.opposite[other] = other, c
            else:
                edges[key] = c
        self.filters = {}
        self.far, self.usual = [10000.0, 300.0], [100.0, 10.0]
        self.error = [[0.0, 0.0] for _ in POSE]
        self.offset = [[0.0] * 3 for _ in POSE]
        self.told = []

    @staticmethod
    def next(c):
        return c - 2 if c % 3 == 2 else c + 1

    @staticmethod
    def previous(c):
        return c + 2 if c % 3 == 0 else c - 1

    def filter(self, kind, name):
        first = {"offset": ([0.0] * 7, 0.05), "height": ([0.0] * 3, 0.05), "size of offsets": ([0.5, 0.1, 0.0, 0.0, 0.0], 0.1),
                 "size of heights": ([0.5, 0.1, 0.0, 0.0], 0.1)}
        return self.filters.setdefault((kind, name), Filter(*first[name], 994 / 1000))

    def tell(self, name, numbers):
        self.told.append((name, list(numbers)))

    def vertex_of(self, v):
        """Vertex v; `told` then has what is worked out of it."""
        self.told = []
        position = [list(map(float, p)) for p in POSE]
        near, gates, noted = [], [], set()
        normal, forward, valences = [0.0] * 3, [0.0] * 3, 0.0
        for c in self.corners_at[v]:
            a, b = self.vertex[self.next(c)], self.vertex[self.previous(c)]
            for w in (a, b):
                if w != v and w not in noted:
                    noted.add(w)
                    if w < v:
                        near.append(w)
            o = self.opposite.get(c)
            if a < v and b < v and o is not None and self.vertex[o] < v:
                x = position[self.vertex[o]]
                a, b, valence = position[a], position[b], float(len(self.corners_at[a]) + len(self.corners_at[b]))
                gates.append(less(added(a, b), x))
                normal = added(normal, cross(less(b, a), less(x, a)))
                forward = added(forward, less(times(0.5, added(a, b)), x))
                valences += valence
        kind = 0 if not near else 1 if not gates else 1 + min(len(gates), 3)
        mean = [0.0] * 3
        for w in near:
            mean = added(mean, position[w])
        if near:
            mean = times(1 / len(near), mean)
        if kind < 2:
            self.far_vertex(v, kind, mean if kind == 1 else position[v - 1] if v > 0 else [0.0] * 3, position[v])
        else:
            self.near_vertex(v, kind, near, gates, mean, normal, forward, valences, position)

    def far_vertex(self, v, kind, base, truth):
        for d in range(3):
            residual = truth[d] - base[d]
            self.far[kind] += 0.1 * (abs(residual) - self.far[kind])
            if kind == 1:
                self.error[v][0] = f32(self.error[v][0] + f32(abs(residual) / 3))
        if kind == 1:
            self.error[v][1] = f32(self.usual[1])

    def near_vertex(self, v, kind, near, gates, mean, normal, forward, valences, position):
        each = 1 / len(gates)
        base = [0.0] * 3
        for gate in gates:
            base = added(base, gate)
        base, forward, valences = times(each, base), times(each, forward), each * valences
        n = times(1 / length(normal), normal)
        k = max(range(3), key=lambda axis: (abs(n[axis]), -axis))
        i, j = (k + 1) % 3, (k + 2) % 3
        if abs(n[i]) > abs(n[j]):
            i, j = j, i
        share = [math.sqrt(1 - n[i] * n[i]), 0.0, 1 / abs(n[k])]
        share[1] = abs(n[k]) / share[0]
        correlation = -n[i] * n[j] / (share[0] * share[0])
        spread = 0.0
        for gate in gates:
            spread += length(less(gate, base))
        spread /= len(gates)
        size = tan = nor = 0.0
        drift = [0.0] * 3
        for w in near:
            size += length(less(position[w], base))
            tan += self.error[w][0]
            nor += self.error[w][1]
            drift = added(drift, self.offset[w])
        each = 1 / len(near)
        size, tan, nor, drift = size * each, tan * each, nor * each, times(each, drift)
        valence = max(len(self.corners_at[v]), 3)
        vectors = [less(mean, base), drift, forward, times(6 / valence - 1, forward), times(valences / 12 - 1, forward),
                   less(gates[0], base) if len(gates) > 1 else [0.0] * 3, less(gates[1], base) if len(gates) > 2 else [0.0] * 3]
        self.tell("base", base)
        self.tell("n", n)
        self.tell("i, j, k", [i, j, k])
        self.tell("share, correlation", [*share, correlation])
        self.tell("length, tan, nor, spread", [size, tan, nor, spread])
        for number, vector in enumerate(vectors):
            self.tell(f"f[{number}]", vector)

        def kept(e, u):
            low, high = 0.15 * u, 8 * u + 8 * size
            return (e if e < high else high) if e > low else low

        def height(q):
            return q[k] - base[k] + (n[i] * (q[i] - base[i]) + n[j] * (q[j] - base[j])) / n[k]

        truth, residual, relative = position[v], [0.0] * 3, 0.0
        for step, d in ((0, i), (1, j)):
            z = [vector[d] for vector in vectors]
            offset, sizes = self.filter(kind, "offset"), self.filter(kind, "size of offsets")
            y = offset.y(z)
            expected = base[d] + (correlation * residual[i] if step else 0) + y
            s = [tan, size, spread, self.usual[0], abs(relative) if step else 0.0]
            expect = kept(sizes.y(s), max(tan if tan > 0 else self.usual[0], 0.001))
            scale = expect * share[step]
            self.tell(f"axis {'ij'[step]}: mean, scale, near, spread, before",
                      [expected, scale, tan * share[step], spread * share[step], (s[4] if step else size) * share[step]])
            relative = (truth[d] - expected) / share[step]
            magnitude = abs(relative)
            residual[d] = truth[d] - base[d] - y
            offset.learn(z, truth[d] - base[d], 0.01 + scale * scale)
            self.error[v][0] = f32(self.error[v][0] + f32(0.5 * magnitude))
            self.offset[v][d] = f32(truth[d] - base[d])
            sizes.learn(s, magnitude, 0.1 + expect * expect)
            self.usual[0] += 0.01 * (magnitude - self.usual[0])
            self.tell(f"axis {'ij'[step]}: relative error", [relative])
            self.tell(f"axis {'ij'[step]}: u of offset", offset.u)
        ground = base[k] - (n[i] * (truth[i] - base[i]) + n[j] * (truth[j] - base[j])) / n[k]
        h = [height(gates[0]) if len(gates) > 1 else 0.0, height(mean), dot3(n, drift) / n[k]]
        heights, sizes = self.filter(kind, "height"), self.filter(kind, "size of heights")
        expected = ground + heights.y(h)
        apart = 0.0
        for gate in gates:
            apart += abs(height(gate))
        apart /= len(gates)
        s = [nor, apart / share[2], self.usual[1], self.error[v][0]]
        expect = kept(sizes.y(s), max(nor if nor > 0 else self.usual[1], 0.001))
        scale = expect * share[2]
        self.tell("axis k: ground, h", [ground, *h])
        self.tell("axis k: mean, scale, near, spread, before", [expected, scale, nor * share[2], apart, self.error[v][0] * share[2]])
        relative = (truth[k] - expected) / share[2]
        heights.learn(h, truth[k] - ground, 0.01 + scale * scale)
        self.error[v][1] = f32(abs(relative) + 0.001)
        self.offset[v][k] = f32(truth[k] - base[k])
        sizes.learn(s, abs(relative), 0.1 + expect * expect)
        self.usual[1] += 0.01 * (abs(relative) - self.usual[1])
        self.tell("axis k: u of height", heights.u)
        self.tell("error", self.error[v])
        self.tell("offset", self.offset[v])
        self.tell("usual", self.usual)


def pose_numbers():
    """spec/09b, section 10: the last vertex of a fan."""
    pose = Pose()
    for v in range(len(POSE)):
        pose.vertex_of(v)
    yield from pose.told


FRAMES = [[0.1, 0.35, -0.2, 0.7], [0.13, 0.4, -0.21, 0.79], [0.17, 0.44, -0.2, 0.9]]
NOISE = 0.01


def exact_numbers():
    """spec/09d, section 6: x of four vertices in three frames, the first axis, without a lattice."""
    frames = [[f32(x) for x in frame] for frame in FRAMES]
    near = {1: [0, 0, 0, 0], 2: [1, 0, 1, 0], 3: [2, 1, 0, 2]}
    first, later = Filter([0.25] * 3, 0.1, 0.999), Filter([0.25] * 4 + [0.0] * 5, 0.1, 0.999)
    m = [[0.0] * 4 for _ in FRAMES]
    for f, frame in enumerate(frames):
        r = max(f - 1, 0)
        for v in range(4):
            if f == 0:
                o = frame[near[v][0]] if v else 0.0
                z = [frame[near[v][i]] - o for i in (1, 2, 3)] if v else [0.0] * 3
                y = first.y(z) if v else 0.0
                p = o + y if v else 0.0
            else:
                before = frames[max(r - 1, 0)]
                z = [frame[w] - frames[r][w] for w in near[v]] + [frames[r][w] - before[w] for w in near[v]] if v else [0.0] * 8
                z.append(frames[r][v] - before[v])
                y = later.y(z)
                p = frames[r][v] + y
            close = 0.0
            for w in near.get(v, []):
                close += m[f][w]
            close *= 0.25
            expected = close if f == 0 else 0.5 * (close + m[f - 1][v])
            exponent = struct.unpack("<I", struct.pack("<f", f32(p)))[0] >> 23 & 255
            quantum = 2.0 ** (max(exponent, 1) - 150)
            bits = struct.unpack("<Q", struct.pack("<d", expected / quantum))[0]
            a = f32(abs(frame[v] - p))
            m[f][v] = a if f == 0 else f32(f32(f32(0.7) * a) + f32(f32(0.3) * m[f - 1][v]))
            if f == 0 and v:
                first.learn(z, frame[v] - frame[near[v][0]], NOISE)
            if f and v % 2 == 0:
                later.learn(z, frame[v] - frames[r][v], NOISE)
            if v in (2, 3) and f in (0, 2):
                where = f"frame {f}, vertex {v}: "
                yield where + "x, p", [frame[v], p]
                yield where + "expected error, class", [expected, min(max((bits >> 51) - 2036, 0), 63)]
                yield where + "q", [ordinal(frame[v]) - ordinal(f32(p))]
                yield where + "m", [m[f][v]]
                yield where + "u", first.u if f == 0 else later.u


def ordinal(x):
    bits = struct.unpack("<i", struct.pack("<f", x))[0]
    return bits if bits >= 0 else -1 - (bits & 0x7FFFFFFF)


def main():
    pages = "\n".join(pathlib.Path(page).read_text(encoding="utf-8") for page in sys.argv[1:])
    missing = 0
    for title, numbers in (("09, section 7", prediction_numbers), ("09b, section 10", pose_numbers), ("09d, section 6", exact_numbers)):
        if not pages:
            print(title)
        for name, values in numbers():
            line = f"{name}: {shown(values)}"
            if not pages or line not in pages:
                missing += bool(pages)
                print(line)
    if missing:
        sys.exit("the pages lack these lines")


if __name__ == "__main__":
    main()
