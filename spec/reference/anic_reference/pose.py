# SPDX-License-Identifier: CC0-1.0
"""Chapter 09b: reference poses and native key-frames."""
import math
import struct
from types import SimpleNamespace as Record
from .common import need
from .entropy import Models, Words, bit_model, class_of, lg, magnitude, row, symbol
from .filters import Filter, divide, root

FORGET = 994 / 1000
STEPS = ((0, 2), (5, 7), (1, 3), (6, 4), (2, 0), (4, 6), (3, 1), (7, 5))     # T
AXES = (0, 1, 2)


class Corners:
    """Section 1, and of section 3 what follows from the triangles alone. Made once for each mesh."""

    def __init__(self, n, triangles):
        self.n = n
        self.at = at = [v for t in triangles for v in t]                     # V(c)
        corners = [[] for _ in range(n)]
        for c, v in enumerate(at):
            corners[v].append(c)
        self.valence = [len(line) for line in corners]
        self.corners = [line[:32] for line in corners]
        opposite = self._opposites()
        self.neighbours, self.gates, self.valences = [], [], []              # N; a, b, x of G; sums of valences
        for v in range(n):
            noted, gates, total = {}, [], 0
            for c in self.corners[v]:
                a, b = at[next_corner(c)], at[previous_corner(c)]
                noted[a] = noted[b] = True
                o = opposite[c]
                if a < v and b < v and o is not None and at[o] < v and len(gates) < 16:
                    gates.append((a, b, at[o]))
                    total += self.valence[a] + self.valence[b]
            self.neighbours.append([w for w in noted if w < v])
            self.gates.append(gates)
            self.valences.append(float(total))

    def _opposites(self):
        at, keys = self.at, []
        for c in range(len(at)):
            a, b = at[next_corner(c)], at[previous_corner(c)]
            keys.append((a, b, c) if a < b else (b, a, c))
        keys.sort()
        opposite, i = [None] * len(at), 0
        while i + 1 < len(keys):
            if keys[i][:2] == keys[i + 1][:2]:
                c, d = keys[i][2], keys[i + 1][2]
                opposite[c], opposite[d] = d, c
                i += 1
            i += 1
        return opposite


def next_corner(c):
    return c + 1 if c % 3 < 2 else c - 2


def previous_corner(c):
    return c - 1 if c % 3 else c + 2


def f32(x):
    """x rounded to binary32."""
    try:
        return struct.unpack('<f', struct.pack('<f', x))[0]
    except OverflowError:
        return math.copysign(math.inf, x)


def plus(a, b):
    return [a[0] + b[0], a[1] + b[1], a[2] + b[2]]


def minus(a, b):
    return [a[0] - b[0], a[1] - b[1], a[2] - b[2]]


def times(s, a):
    return [s * a[0], s * a[1], s * a[2]]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def norm(a):
    return root(dot(a, a))


def mean_of(vectors):
    total = [0.0, 0.0, 0.0]
    for a in vectors:
        total = plus(total, a)
    return times(1 / len(vectors), total)


def mean_number(numbers):
    total = 0.0
    for x in numbers:
        total += x
    return 1 / len(numbers) * total


def largest(x, y):
    return y if x < y else x


def whole(x):
    """X(y) of section 5: 8 y rounded down, within 0 .. 2^30."""
    x = 8 * x
    return 0 if not x > 0 else 2 ** 30 if not x < 2 ** 30 else math.floor(x)


class Turn:
    """Section 7: three filters that turn a place."""

    def __init__(self, flips):
        self.filters = []
        for d in AXES:
            u = [0.0, 0.0, 0.0]
            u[d] = -1.0 if flips >> d & 1 else 1.0
            self.filters.append(Filter(u, 0.1, FORGET))
        self.mirrors = flips.bit_count() % 2 == 1

    def __call__(self, x):
        return [f.y(x) for f in self.filters]

    def learn(self, there, moved):
        d = FORGET * (1 + 0.001 * dot(there, there))
        for f, value in zip(self.filters, moved):
            f.learn(there, value - f.y(there), d)


class Learnt:
    """Filters, usual and far (section 4), of vertices that follow (section 7) or of the others."""

    def __init__(self, follows):
        more = [0.5, 0.5] if follows else []
        self.offset = Models(lambda: Filter([0.0] * 7 + more, 0.05, FORGET))          # by kind
        self.height = Models(lambda: Filter([0.0] * 3 + more, 0.05, FORGET))
        sizes = [0.5, 0.0] if follows else [0.5, 0.1]
        self.offsets = Models(lambda: Filter(sizes + [0.0] * (4 if follows else 3), 0.1, FORGET))
        self.heights = Models(lambda: Filter(sizes + [0.0] * (3 if follows else 2), 0.1, FORGET))
        self.usual = [100.0, 10.0]
        self.far = [100.0, 30.0] if follows else [10000.0, 300.0]


class Strands:
    """Section 8: partners."""

    def __init__(self, n):
        self.to, self.back, self.strand = [None] * n, [None] * n, [None] * n
        self.turns, self.count, self.last = [None] * 256, 0, 0
        self.bits = Models(bit_model)

    def image(self, w, s):
        to, back = self.to[w], self.back[w]
        if to is not None and self.strand[w] == s:
            return to
        return back if back is not None and self.strand[back] == s else None

    def link(self, v, u, s):
        self.to[v], self.strand[v], self.back[u] = u, s, v

    def start(self, stream):
        s = self.count % 256
        self.count += 1
        self.turns[s] = Turn(stream.raw(3))
        return s

    def partner(self, stream, mesh, v):
        linked, selves, nearest, scores = 0, 0, None, {}
        for w in mesh.neighbours[v][:8]:
            if self.to[w] is not None:
                u, s = self.to[w], self.strand[w]
            elif self.back[w] is not None:
                u = self.back[w]
                s = self.strand[u]
            else:
                continue
            linked += 1
            selves += u == w
            if nearest is None:
                nearest = s
            for c in mesh.corners[u][:16]:
                for x in (mesh.at[next_corner(c)], mesh.at[previous_corner(c)]):
                    if x < v and x != w and self.image(x, s) is None:
                        if (x, s) in scores:
                            scores[x, s] += 1
                        elif len(scores) < 12:
                            scores[x, s] = 2 if mesh.valence[x] == mesh.valence[v] else 1
        candidates = sorted(scores.items(), key=lambda item: -item[1])
        best = min(candidates[0][1], 9) if candidates else 0
        few = min(linked, 3)
        a = stream.bit(self.bits['any', few, best, self.last])
        self.last = (2 * self.last + a) & 3
        if not a:
            return
        if stream.bit(self.bits['itself', few, min(selves, 3)]):
            self.link(v, v, self.start(stream) if nearest is None else nearest)
            return
        for i, ((x, s), score) in enumerate(candidates):
            gap = min(score - (candidates[i + 1][1] if i + 1 < len(candidates) else 0), 3)
            if stream.bit(self.bits['which', min(i, 2), gap]):
                self.link(v, x, s)
                return
        u = stream.raw((mesh.n - 1).bit_length())
        need(u < v, 'ENTROPY', 'partner')
        self.link(v, u, self.start(stream))


class PoseDecoder:
    """Sections 3 to 9. A stream of poses over one mesh; what is learnt goes on from pose to pose."""

    def __init__(self, stream, mesh):
        self.stream, self.mesh = stream, mesh
        self.rows, self.bits = Models(row), Models(bit_model)
        self.more = [self.rows['More', i] for i in range(4)]
        self.learnt = (Learnt(False), Learnt(True))
        self.strands = Strands(mesh.n)

    def pose(self, is_key_frame, parent=None):
        """One pose: n lists of three numbers, which are integers kept as binary64."""
        n = self.mesh.n
        self.error, self.shift = [[0.0, 0.0] for _ in range(n)], [[0.0] * 3 for _ in range(n)]
        self.told, self.last_told, self.states = [[0, 0, 0] for _ in range(n)], 0, [0, 0, 0]
        self.p = []
        exact = 0 if is_key_frame else self.stream.raw(1)
        named = 0 if parent is not None else self.stream.raw(1)
        turn = Turn(0)
        if parent is None:
            self.strands = Strands(n)
        strands = self.strands
        for v in range(n):
            s = self.surroundings(v)
            if named:
                strands.partner(self.stream, self.mesh, v)
            if parent is not None:
                self.follow(s, lambda w: w, parent, turn)
            elif named and strands.to[v] not in (None, v):
                strand = strands.strand[v]

                def image(w, strand=strand, v=v):
                    u = strands.image(w, strand)
                    return None if u == v else u
                self.follow(s, image, self.p, strands.turns[strand])
            self.vertex(s, exact, is_key_frame)
        return self.p

    def surroundings(self, v):
        """Section 3."""
        p, mesh = self.p, self.mesh
        near, gates = mesh.neighbours[v], mesh.gates[v]
        s = Record(v=v, near=near, corners=gates, follows=False, count=len(gates), order=AXES, f=None)
        s.kind = 0 if not near else 1 if not gates else 1 + min(len(gates), 3)
        s.mean = mean_of([p[w] for w in near]) if near else None
        s.gates = [minus(plus(p[a], p[b]), p[x]) for a, b, x in gates]
        if s.kind < 2:
            s.base = s.mean if s.kind else list(p[v - 1]) if v else [0.0, 0.0, 0.0]
            return s
        inverse = 1 / s.count
        normal, forward, total = gate_sums([[p[w] for w in gate] for gate in gates])
        base = s.base = times(inverse, total)
        forward, valences = times(inverse, forward), inverse * mesh.valences[v]
        l = norm(normal)
        if l > 0:
            n = s.n = times(1 / l, normal)
            sizes = [abs(x) for x in n]
            k = sizes.index(max(sizes))
            i, j = (k + 1) % 3, (k + 2) % 3
            if sizes[i] > sizes[j]:
                i, j = j, i
            first = root(1 - n[i] * n[i])
            s.order, s.share = (i, j, k), (first, divide(sizes[k], first), 1 / sizes[k])
            s.correlation = divide(-n[i] * n[j], first * first)
        else:
            s.n, s.share, s.correlation = [0.0, 0.0, 1.0], (1.0, 1.0, 1.0), 0.0
        s.length = mean_number([norm(minus(p[w], base)) for w in near])
        s.tan = mean_number([self.error[w][0] for w in near])
        s.nor = mean_number([self.error[w][1] for w in near])
        s.drift = mean_of([self.shift[w] for w in near])
        total = 0.0
        for g in s.gates:
            total += norm(minus(g, base))
        s.spread = total / s.count
        none = [0.0, 0.0, 0.0]
        s.f = [minus(s.mean, base), s.drift, forward, times(6 / max(mesh.valence[v], 3) - 1, forward),
               times(valences / 12 - 1, forward), minus(s.gates[0], base) if s.count > 1 else none,
               minus(s.gates[1], base) if s.count > 2 else none]
        return s

    def follow(self, s, image, place, turn):
        """Section 7. R(w) = place[image(w)]."""
        p, v = self.p, s.v
        if image(v) is None:
            return
        around = [w for w in s.near if image(w) is not None]
        if s.kind == 0 and v > 0 and image(v - 1) is not None:
            around = [v - 1]
        if not around:
            return
        own = place[image(v)]
        s.anchor = mean_of([p[w] for w in around])
        s.there = minus(own, mean_of([place[image(w)] for w in around]))
        s.likely, s.turn, s.follows = plus(s.anchor, turn(s.there)), turn, True
        if s.kind < 2:
            s.base = s.likely
            return
        direct = minus(s.likely, s.base)
        framed = direct
        gates = [(g, [image(w) for w in g]) for g in s.corners]
        gates = [(g, h) for g, h in gates if None not in h]
        here = frame([[p[w] for w in g] for g, _ in gates])
        other = here and frame([[place[w] for w in h] for _, h in gates])
        if here and other:
            (n, ahead, c), (n1, ahead1, c1) = here, other
            off = minus(own, c1)
            along, up, side = dot(off, ahead1), dot(off, n1), dot(off, cross(n1, ahead1))
            if turn.mirrors:
                up = -up
            sum_ = plus(plus(times(along, ahead), times(side, cross(n, ahead))), times(up, n))
            framed = minus(plus(c, sum_), s.base)
        s.f += [direct, framed]

    def vertex(self, s, exact, is_key_frame):
        """Sections 4 to 6 for the three axes of a vertex."""
        x = [0.0, 0.0, 0.0]
        self.p.append(x)
        learnt = self.learnt[s.follows]
        s.residual, s.relative = [0.0] * 3, 0.0
        for step in AXES:
            d = s.order[step]
            e = self.expect(s, learnt, step, d, x)
            if exact:
                value = self.candidate(s, e, step, d)
                if value is None:
                    value = self.coordinate(e.mean, (e.scale, e.near, e.spread, e.before), step)
            elif is_key_frame:
                value = self.coordinate(e.mean, (e.scale, e.near, e.spread, e.before), step)
            else:
                state = self.states[d]
                h = self.coordinate(0.5 * (e.mean - (state & 1)),
                                    (0.5 * e.scale, 0.5 * e.near, 0.5 * e.spread, 0.5 * e.before), step)
                value = 2 * h + (state & 1)
                self.states[d] = STEPS[state][h & 1]
            x[d] = float(value)
            self.learn(s, learnt, e, step, d, x[d])
        if s.follows:
            s.turn.learn(s.there, minus(x, s.anchor))

    def expect(self, s, learnt, step, d, x):
        """Section 4."""
        e = Record()
        if s.kind < 2:
            far = learnt.far[s.kind]
            e.mean, e.scale, e.near, e.spread = s.base[d], far, far, far
            e.before = abs(s.residual[s.order[step - 1]]) if step else far
            return e
        base, share = s.base, s.share[step]
        if step < 2:
            e.z = [f[d] for f in s.f]
            e.y = learnt.offset[s.kind].y(e.z)
            e.mean = base[d] + (s.correlation * s.residual[s.order[0]] if step else 0.0) + e.y
            e.s = [s.tan, s.length, s.spread, learnt.usual[0], abs(s.relative) if step else 0.0]
            if s.follows:
                e.s.append(norm(minus(s.f[7], s.f[8])))
            e.size = learnt.offsets[s.kind]
            usual, e.near, e.spread, e.before = s.tan, s.tan * share, s.spread * share, (
                e.s[4] if step else s.length) * share
        else:
            i, j, k = s.order
            n = s.n

            def height(q):
                return q[k] - base[k] + (n[i] * (q[i] - base[i]) + n[j] * (q[j] - base[j])) / n[k]
            e.ground = base[k] - (n[i] * (x[i] - base[i]) + n[j] * (x[j] - base[j])) / n[k]
            e.z = [height(s.gates[0]) if s.count > 1 else 0.0, height(s.mean), dot(n, s.drift) / n[k]]
            if s.follows:
                e.z += [height(plus(base, s.f[7])), height(plus(base, s.f[8]))]
            e.y = learnt.height[s.kind].y(e.z)
            e.mean = e.ground + e.y
            total = 0.0
            for g in s.gates:
                total += abs(height(g))
            apart, error = total / s.count, self.error[s.v][0]
            e.s = [s.nor, apart / share, learnt.usual[1], error]
            if s.follows:
                e.s.append(abs(e.z[3] - e.z[4]) / share)
            e.size = learnt.heights[s.kind]
            usual, e.near, e.spread, e.before = s.nor, s.nor * share, apart, error * share
        u = largest(usual if usual > 0 else learnt.usual[step // 2], 0.001)
        low, high = 0.15 * u, 8 * u + 8 * s.length
        e.size_y = e.size.y(e.s)
        e.expect = (e.size_y if e.size_y < high else high) if e.size_y > low else low
        e.scale = e.expect * share
        return e

    def coordinate(self, mean, magnitudes, step):
        """Section 5."""
        scale, near, spread, before = [whole(y) for y in magnitudes]
        limited = 0.0 if mean != mean else min(max(mean, -2.0 ** 22), 2.0 ** 22)
        c = math.floor(limited + 0.5)
        low, last = min(max(lg(scale) - 4, 0), 12), int(step == 2)
        z, rows = class_of(2, scale, 64), self.rows
        scale, near, spread, before = [class_of(0, y >> low, 16) for y in (scale, near, spread, before)]
        s = symbol(self.stream, rows['Scale', z, last], rows['Near', before, near, last],
                   rows['Spread', spread, scale, last])
        if s == 0:
            return c
        m = magnitude(self.stream, s, (rows['ScaleMore', z], rows['BeforeMore', before], rows['SpreadMore', spread]),
                      self.more, low)
        r = limited - c
        quarter = 0 if r < -0.25 else 1 if r < 0 else 2 if r < 0.25 else 3
        return c - m if self.stream.bit(self.bits['Sign', last, quarter]) else c + m

    def candidate(self, s, e, step, d):
        """Section 5, exact coordinates: the candidate that the coordinate is told to be, or None."""
        found = []
        if s.follows:
            found.append((6, rounded(s.likely[d])))
        found += [(i, g[d]) for i, g in enumerate(s.gates[:2])]
        found += [(2 + i, self.p[w][d]) for i, w in enumerate(s.near[:3])]
        if not s.near:
            found.append((5, rounded(e.mean)))
        near = sum(self.told[w][d] for w in s.near[:3]) if s.near else 4
        seen = set()
        for slot, q in found:
            if q is None or not -2.0 ** 31 < q < 2.0 ** 31 or q in seen:
                continue
            seen.add(q)
            if self.stream.bit(self.bits['E', slot, d, near, min(s.kind, 3), self.last_told]):
                self.told[s.v][d] = self.last_told = 1
                return q
        self.last_told = 0
        return None

    def learn(self, s, learnt, e, step, d, x):
        """Section 6."""
        error = self.error[s.v]
        if s.kind < 2:
            s.residual[d] = x - s.base[d]
            size = abs(s.residual[d])
            learnt.far[s.kind] += 0.1 * (size - learnt.far[s.kind])
            if s.kind == 1:
                error[0] = f32(error[0] + f32(size / 3))
                if step == 2:
                    error[1] = f32(learnt.usual[1])
            return
        s.relative = (x - e.mean) / s.share[step]
        m, noise = abs(s.relative), 0.01 + e.scale * e.scale
        moved = x - s.base[d]
        if step < 2:
            s.residual[d] = moved - e.y
            learnt.offset[s.kind].learn(e.z, moved - e.y, FORGET * noise)
            error[0] = f32(error[0] + f32(0.5 * m))
        else:
            learnt.height[s.kind].learn(e.z, x - e.ground - e.y, FORGET * noise)
            error[1] = f32(m + 0.001)
        self.shift[s.v][d] = f32(moved)
        e.size.learn(e.s, m - e.size_y, FORGET * (0.1 + e.expect * e.expect))
        learnt.usual[step // 2] += 0.01 * (m - learnt.usual[step // 2])


def rounded(x):
    """x + 0.5 rounded down, None if it is not finite."""
    return float(math.floor(x + 0.5)) if math.isfinite(x + 0.5) else None


def gate_sums(gates):
    """Sums over gates, triples of points: of their normals, of the ways forward, of the gates themselves."""
    n, ahead, c = [0.0] * 3, [0.0] * 3, [0.0] * 3
    for a, b, x in gates:
        n = plus(n, cross(minus(b, a), minus(x, a)))
        ahead = plus(ahead, minus(times(0.5, plus(a, b)), x))
        c = plus(c, minus(plus(a, b), x))
    return n, ahead, c


def frame(gates):
    """frame(S) of section 7: gates are triples of points."""
    if not gates:
        return None
    n, ahead, c = gate_sums(gates)
    c = times(1 / len(gates), c)
    length = norm(n)
    if not length > 0:
        return None
    n = times(1 / length, n)
    ahead = minus(ahead, times(dot(ahead, n), n))
    length = norm(ahead)
    if not length > 0:
        return None
    return n, times(1 / length, ahead), c


def read_pose(data, mesh):
    """The stream of a `POSE` chunk: integers [vertex][axis]."""
    stream = Words(data)
    p = PoseDecoder(stream, mesh).pose(False)
    stream.end()
    return [[int(x) for x in v] for v in p]


def read_key_frames(data, mesh, parents):
    """Section 9: integers [key-frame][vertex][axis]; parents[j] = 0 for none."""
    stream, poses = Words(data), []
    decoder = PoseDecoder(stream, mesh)
    for parent in parents:
        poses.append(decoder.pose(True, poses[parent - 1] if parent else None))
    stream.end()
    return [[[int(x) for x in v] for v in p] for p in poses]
