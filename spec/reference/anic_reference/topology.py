# SPDX-License-Identifier: CC0-1.0
"""Chapter 07, sections 3 and 4: faces, copies, polygons apart."""
from .common import need
from .entropy import Mixed, Models, RangeDecoder, bit_model, integers


class Walk:
    """Section 3. Corners of all faces stand in `vertex`; a gate is the corner that opened it."""

    def __init__(self, stream, bits, coded, corners, repeats):
        self.stream, self.bits, self.coded, self.corners, self.repeats = stream, bits, coded, corners, repeats
        self.vertex, self.opposite = [], []          # of each corner
        self.face_start, self.is_repeat = [], []     # of each face: its first corner; whether it repeats the one before
        self.from_, self.to = [], []                 # of each vertex: its open gates {gate: other end}, the latest last
        self.faces, self.borders, self.first = [], [], []
        self.triangles = []
        self.mixed = {'B': Mixed(4), 'R': Mixed(7), 'L': Mixed(7)}
        self.ways, self.last_border, self.size_before, self.repeats_before = 0, 0, 3, 0
        self.q = self.q_before = 6

    def run(self, faces):
        self.left, pivot = faces, 0
        while self.left:
            if pivot == len(self.faces):
                self.seed()
                continue
            self.first[pivot] = self.faces[pivot]
            starting, ending = self.from_[pivot], self.to[pivot]
            while self.left and (starting or ending):
                if starting:
                    gate = next(reversed(starting))
                    self.pass_gate(gate, pivot, starting[gate], 0)
                else:
                    gate = next(reversed(ending))
                    self.pass_gate(gate, ending[gate], pivot, 1)
            self.q_before, self.q = self.q, min(self.faces[pivot], 15)
            pivot += 1

    def way(self, w):
        self.ways = (self.ways << 3 | w) & 0o7777

    def open(self, gate, a, b):
        self.from_[a][gate] = b
        self.to[b][gate] = a

    def shut(self, gate, a, b):
        del self.from_[a][gate]
        del self.to[b][gate]

    def after(self, v):
        gates = self.from_[v]
        return gates[next(reversed(gates))] if gates else None

    def before(self, v):
        gates = self.to[v]
        return gates[next(reversed(gates))] if gates else None

    def close(self, face, gate):
        """Section 3.1; `gate` is (gate, a, b) or None."""
        c, n = len(self.vertex), len(face)
        self.face_start.append(c)
        self.is_repeat.append(False)
        self.vertex += face
        for i, a in enumerate(face):
            b = face[i + 1] if i + 1 < n else face[0]
            if self.faces[a] < 255:
                self.faces[a] += 1
            met = None
            if i == 0 and gate is not None:
                met = gate[0]
            else:
                for looked, other in enumerate(reversed(self.from_[a])):
                    if looked == 64:
                        break
                    if self.from_[a][other] == b:
                        met = other
                        break
            if met is not None:
                self.shut(met, a, b)
            else:
                self.open(c + i, b, a)
            self.opposite.append(met)
        self.triangles += [(face[0], face[k], face[k + 1]) for k in range(1, n - 1)]
        self.left -= 1
        if self.repeats:
            m = 0
            while m < self.left and self.stream.bit(self.bits['again', min(m, 1), min(self.repeats_before, 2)]):
                m += 1
            self.repeats_before = m
            need(m * n <= self.corners - len(self.vertex), 'TOPOLOGY', 'corners of repeated faces')
            for _ in range(m):
                self.face_start.append(len(self.vertex))
                self.is_repeat.append(True)
                self.vertex += face
                self.opposite += [None] * n
            self.left -= m

    def size(self):
        left, n = self.corners - len(self.vertex), 3
        need(left >= 3, 'TOPOLOGY', 'no corners left')
        while n < left and self.stream.bit(self.bits['more', min(n - 3, 5), min(self.size_before - 3, 5)]):
            n += 1
        self.size_before = n
        return n

    def new(self):
        v = len(self.faces)
        need(v < self.coded, 'TOPOLOGY', 'too many vertices')
        for line in (self.faces, self.borders, self.first):
            line.append(0)
        self.from_.append({})
        self.to.append({})
        return v

    def number(self):
        count = len(self.faces)
        v = self.stream.raw((count - 1).bit_length())
        need(v < count, 'INDEX_RANGE', 'number of a vertex')
        return v

    def seed(self):
        face = []
        for i in range(self.size()):
            old = self.faces and self.stream.bit(self.bits['old', min(i, 3)])
            face.append(self.number() if old else self.new())
        self.way(5)
        self.close(face, None)

    def pass_gate(self, gate, a, b, side):
        """Section 3.2, with the contexts of 3.3."""
        stream, faces, borders, ways = self.stream, self.faces, self.borders, self.ways
        y, x = self.after(b), self.before(a)
        fa, fb, border_a, border_b = faces[a], faces[b], borders[a], borders[b]
        beta_a, beta_b = border_a > 0, border_b > 0
        self.last_border = self.mixed['B'].read(stream, (
            (beta_a, beta_b, self.last_border), (min(border_a, 2), min(border_b, 2), min(fa, 7), min(fb, 7)),
            (ways & 63, beta_a, beta_b), (min(fa, 9), side, beta_a)), (beta_a, beta_b))
        if self.last_border:
            self.shut(gate, a, b)
            for v in (a, b):
                if borders[v] < 255:
                    borders[v] += 1
            self.way(7)
            return
        n = self.size()
        s = min(n - 3, 2)

        def d(v):
            return 12 if v is None else min(faces[v], 12)

        low, e, z, face = 2, b, y, [a, b] + [None] * (n - 2)
        while low < n and z is not None and z != a:
            fe, de, right = faces[e], d(e), low > 2
            if not self.mixed['R'].read(stream, (
                    (de, d(a), s, side), (de, d(z), right), (ways & 511, side),
                    (min(fe, 7), min(fa, 7), min(faces[z], 7), 7 if x is None else min(faces[x], 6)),
                    (min(fe, 9), ways & 63, min(borders[e], 2)), (de, d(a), d(z)), (de, z == x)),
                    (min(fe, 11), side), (ways & 7, side)):
                break
            face[low] = e = z
            low += 1
            z = self.after(e)
        right, high, h, z, dy = low > 2, n, a, x, min(d(y), 9)
        while low < high and z is not None and z != e:
            fh, dh = faces[h], d(h)
            if not self.mixed['L'].read(stream, (
                    (dh, d(b), d(z), side), (ways & 511, side, right, s),
                    (min(fh, 9), min(fb, 9), min(faces[z], 9), dy),
                    (dh, self.q, self.q_before), (dh, d(z), d(b), self.q),
                    (dh, d(z), d(self.before(z)), min(self.first[h], 12)), (dh, ways & 0o7777)),
                    (min(fh, 11), side), (min(fb, 3), min(faces[z], 3), right)):
                break
            high -= 1
            face[high] = h = z
            z = self.before(h)
        left, other = high < n, False
        for k in range(low, high):
            seen = self.bits['seen', ways & 7, min(fa, 7), side, border_a + border_b > 0]
            if not stream.bit(seen):
                face[k] = self.new()
            else:
                other = True
                face[k] = self.search(a, b)
        self.way(4 if other else 3 if right and left else 1 if right else 2 if left else 0)
        self.close(face, (gate, a, b))

    def search(self, a, b):
        z = [b, a]
        for s in range(24):
            for d in (0, 1):
                if z[d] is None:
                    continue
                z[d] = self.before(z[d]) if d else self.after(z[d])
                if z[d] is None or z[d] == a or z[d] == b or s == 0:
                    continue
                if self.stream.bit(self.bits['step', s, d]):
                    return z[d]
        return self.number()


class Copies:
    """Section 4.1: copy numbers of the corners of the walk, and how many copies each coded vertex has."""

    def __init__(self, stream, bits, walk, source, coded):
        self.stream, self.bits, self.walk = stream, bits, walk
        count = len(walk.faces)
        self.used = [0] * count + [1] * (coded - count)
        self.copy = [None] * len(walk.vertex)
        self.room = source - (coded - count)
        self.total, self.answers = 0, 0
        self.mixed = {'F': Mixed(6), 'G': Mixed(6), 'N': Mixed(4)}
        ends = walk.face_start[1:] + [len(walk.vertex)]
        self.after = list(range(1, len(walk.vertex) + 1))
        for start, end in zip(walk.face_start, ends):
            self.after[end - 1] = start
        for start, end, repeat in zip(walk.face_start, ends, walk.is_repeat):
            if repeat and stream.bit(bits['same']):
                self.copy[start:end] = self.copy[2 * start - end:start]
            else:
                for i in range(end - start):
                    self.corner(start, end, i)

    def copy_at(self, c):
        """A corner without a copy yet counts as copy 0."""
        return self.copy[c] or 0

    def corner(self, start, end, i):
        c = start + i
        v = self.walk.vertex[c]
        if self.used[v] == 0:
            copy = 0
        else:
            copy = self.choice(start, end, i, c, v)
        self.copy[c] = copy
        if copy == self.used[v]:
            self.used[v] += 1
            self.total += 1
            need(self.total <= self.room, 'TOPOLOGY', 'too many copies')

    def choice(self, start, end, i, c, v):
        walk, used, stream = self.walk, self.used, self.stream
        last, following = (c - 1 if i else end - 1), self.after[c]
        o, p, before = walk.opposite[last], None, 2
        if o is not None:
            p = self.copy_at(o)
            before = 3 if i == 0 else int(self.copy_at(self.after[o]) == self.copy[last])
        o, q, behind = walk.opposite[c], None, 2
        if o is not None:
            q = self.copy_at(self.after[o])
            behind = int(self.copy_at(o) == self.copy[start]) if following == start else 3
        has_p, has_q, n, i = p is not None, q is not None, used[v], min(i, 3)
        t = (min(n, 4), min(used[walk.vertex[last]], 4), min(used[walk.vertex[following]], 4))
        if has_p:
            equal, a = int(q == p) if has_q else 2, self.answers
            if self._answer('F', ((before, n > 1, has_q), (before, behind, t), (a & 15, before), (equal, before, i),
                                  (t, equal), a & 255), before):
                return p
        if has_q and q != p:
            a = self.answers
            if self._answer('G', ((behind, has_p, n > 1), (behind, before, has_p, t), (a & 15, behind, has_p),
                                  (behind, before, has_p, i), (t, has_p), (a & 255, has_p)), (behind, has_p)):
                return q
        a = self.answers
        others = n - has_p - (1 if has_q and q != p else 0)
        if others == 0 or self.mixed['N'].read(stream, (
                (min(n, 7), has_p, has_q), (t, has_p), (a & 15, has_p, min(n, 6)), (before, behind, has_p, has_q)),
                has_p):
            return n
        asked = 0
        for x in range(n - 1, -1, -1):
            if x in (p, q):
                continue
            others -= 1
            if others == 0:
                return x
            if asked == 16:
                x = stream.raw((n - 1).bit_length())
                need(x < n, 'TOPOLOGY', 'copy')
                return x
            if stream.bit(self.bits['which', asked]):
                return x
            asked += 1
        raise AssertionError('a copy is left')

    def _answer(self, name, contexts, selector):
        b = self.mixed[name].read(self.stream, contexts, selector)
        self.answers = (self.answers << 1 | b) & 255
        return b


class Mesh:
    """What `MESH` decodes to, in the canonical order."""

    def __init__(self, data, limits):
        """data: the faces of `MESH`; limits: the mesh in `LIMI`."""
        source, coded = limits.source, limits.coded
        self.source, self.coded = source, coded
        stream = RangeDecoder(data)
        bits, numbers = Models(bit_model), integers()
        apart = stream.unsigned(numbers['corners'])
        need(apart <= limits.polygons, 'TOPOLOGY', 'polygons apart')
        repeats = stream.bit(bits['repeated'])
        walk = Walk(stream, bits, coded, limits.corners, repeats)
        walk.run(limits.polygons - apart)
        self.triangles = walk.triangles
        need(len(walk.triangles) == limits.triangles, 'TOPOLOGY', 'triangles')
        if source == coded:
            copies, used = [0] * len(walk.vertex), [1] * coded
        else:
            made = Copies(stream, bits, walk, source, coded)
            copies, used = made.copy, made.used
            total, v = made.total + coded - len(walk.faces), 0
            while total < source:
                v += stream.unsigned(numbers['spare'])
                need(v < coded, 'INDEX_RANGE', 'spare copy')
                used[v] += 1
                total += 1
        self.copies, self.first = used, [0]          # first[v] .. first[v + 1] - 1 are the vertices of coded vertex v
        for n in used:
            self.first.append(self.first[-1] + n)
        self.coded_of = [v for v, n in enumerate(used) for _ in range(n)]
        first = self.first
        self.vertex = [first[v] + x for v, x in zip(walk.vertex, copies)]
        self.starts = walk.face_start + [len(walk.vertex)]         # first corner of each polygon, and the end
        self._apart(stream, numbers, apart, limits.corners)
        stream.end()
        self.polygon_of = [p for p in range(len(self.starts) - 1)
                           for _ in range(self.starts[p + 1] - self.starts[p])]

    def _apart(self, stream, numbers, apart, corners):
        """Section 4.2."""
        v = 0
        for _ in range(apart):
            m = stream.unsigned(numbers['corners'])
            need(m <= corners - len(self.vertex), 'TOPOLOGY', 'corners of polygons apart')
            for _ in range(m):
                v += stream.signed(numbers['step'])
                need(0 <= v < self.source, 'INDEX_RANGE', 'corner')
                self.vertex.append(v)
            self.starts.append(len(self.vertex))
        need(len(self.vertex) == corners, 'TOPOLOGY', 'corners')

    def polygons(self):
        return [self.vertex[a:b] for a, b in zip(self.starts, self.starts[1:])]
