# SPDX-License-Identifier: CC0-1.0
"""Chapter 07, sections 5 and 6: the source's order of vertices and polygons."""
from .common import need
from .entropy import Mixed, Models, RangeDecoder, bit_model, bits, integers


class Once:
    """Numbers 0 .. n - 1 that occur once each (section 5)."""

    def __init__(self, stream, n):
        self.stream, self.n = stream, n
        self.bits, self.step = Models(bit_model), bits()
        self.up, self.down = list(range(n + 1)), list(range(n + 1))     # forests; of down, i + 1 stands for number i
        self.steps, self.b, self.context = [0] * 12, 0, 0

    @staticmethod
    def _find(forest, i):
        root = i
        while forest[root] != root:
            root = forest[root]
        while forest[i] != root:
            forest[i], i = root, forest[i]
        return root

    def take(self, x):
        self.up[x], self.down[x + 1] = x + 1, x
        self.b, self.context = x + 1, 0

    def number(self):
        bit, context, b = self.stream.bit, self.context, self.b
        up = self._find(self.up, b)
        down = self._find(self.down, b - 1) - 1 if b > 0 else -1        # below b - 1
        if up < self.n and bit(self.bits[0, context]):
            x, kind = up, 0
        elif down >= 0 and bit(self.bits[1, context]):
            x, kind = down, 1
        else:
            k = 0
            while k < 12 and not bit(self.bits[2 + k, context]):
                k += 1
            s, kind = (self.steps[k], 2) if k < 12 else (self.stream.signed(self.step), 3)
            del self.steps[min(k, 11)]
            self.steps.insert(0, s)
            x = b + s
            need(0 <= x < self.n, 'INDEX_RANGE', 'number')
        need(self.up[x] == x, 'INDEX_RANGE', 'number that is not free')
        self.take(x)
        self.context = kind
        return x


NEARNESS = (1, 2, 3, 5, 9, 17, 65)


class VertexMap:
    """VMAP. `order[s]` is the canonical vertex that the source's vertex s is."""

    def __init__(self, data, mesh):
        self.mesh, self.n = mesh, mesh.source
        self.polygons = mesh.polygons()
        around = [set() for _ in range(self.n)]
        self.polygons_at = [[] for _ in range(self.n)]                  # polygon of each corner, ascending
        for p, polygon in enumerate(self.polygons):
            for i, v in enumerate(polygon):
                w = polygon[i - 1]
                around[v].add(w)
                around[w].add(v)
                self.polygons_at[v].append(p)
        self.near = [sorted(line - {v})[:24] for v, line in enumerate(around)]
        self.place = [-1] * self.n
        self.placed = [0] * len(self.polygons)
        # -1 at first, which is s - 2 for s = 1.
        self.latest, self.second = [-1] * len(self.polygons), [-1] * len(self.polygons)
        self.order, self.ways, self.mixed = [], (4, 4, 4), Mixed(7)
        self.stream = RangeDecoder(data)
        self.once = Once(self.stream, self.n)
        for s in range(self.n):
            v = self.choose(s)
            way = 4
            if v is None:
                v = self.once.number()
            else:
                v, way = v
                self.once.take(v)
            self.ways = (way,) + self.ways[:2]
            self.place[v] = s
            self.order.append(v)
            for p in self.polygons_at[v]:
                self.placed[p] += 1
                self.second[p], self.latest[p] = self.latest[p], s
        self.stream.end()

    def copies(self, v):
        mesh = self.mesh
        c = mesh.coded_of[v]
        return range(max(mesh.first[c], v - 8), min(mesh.first[c + 1] - 1, v + 8) + 1)

    def features(self, y, s, places):
        """Sort keys of a candidate: -parallel, distance, copy, -count, y."""
        place, touched, parallel, count = self.place, -1, 0, 0
        for w in self.near[y]:
            p = place[w]
            if p >= 0:
                count += 1
                if p > touched:
                    touched = p
                if p < s - 1 and parallel < 2:
                    if p - 1 in places:
                        parallel = 2
                    elif p + 1 in places:
                        parallel = 1
        copied = max([place[w] for w in self.copies(y)])
        return -parallel, s - max(touched, copied), int(copied > touched), -min(count, 3), y

    def groups(self, s):
        """Candidates beside the vertex before, then the others, with how many are in the group and before it."""
        place, order, near = self.place, self.order, self.near
        last = order[s - 1]
        places = [place[w] for w in near[last] if place[w] >= 0]
        known = set(places)
        first = [y for y in near[last] if place[y] < 0]
        yield sorted(self.features(y, s, known) for y in first), len(first)
        listed, others = set(first), []

        def add(vertices):
            for y in vertices:
                if place[y] < 0 and y not in listed and len(listed) < 32:
                    listed.add(y)
                    others.append(y)
        for a in places:
            if a + 1 < s - 1:
                add(near[order[a + 1]])
            if a > 0:
                add(near[order[a - 1]])
        for k in range(1, min(48, s) + 1):
            if len(listed) >= 32:
                break
            add(near[order[s - k]])
            add(self.copies(order[s - k]))
        yield sorted(self.features(y, s, known) for y in others), len(listed)

    def choose(self, s):
        """The candidate that is chosen, with its way, or None."""
        if s == 0:
            return None
        i = 0
        for group, count in self.groups(s):
            for parallel, distance, copy, placed, y in group:
                if self.read(s, i, count, y, -parallel, distance, copy, -placed):
                    return y, 1 if copy else 0 if distance == 1 else 2 if parallel else 3
                i += 1
        return None

    def read(self, s, i, candidates, y, parallel, distance, copy, count):
        """The decision O with its contexts."""
        place, order, near = self.place, self.order, self.near[y]
        last = order[s - 1]
        nearness = next((k for k, most in enumerate(NEARNESS) if distance <= most), 7)
        free = min(sum([place[w] < 0 for w in near]), 7)
        free_before = min(sum([place[w] < 0 for w in self.near[last]]), 7)
        beside_last = last in near
        beside = 4 * beside_last + 2 * (s > 1 and order[s - 2] in near) + (s > 2 and order[s - 3] in near)
        filled, completes, together = 0, False, False
        for p in self.polygons_at[y][:24]:
            n = self.placed[p]
            filled = max(filled, n)
            completes = completes or n == len(self.polygons[p]) - 1
            together = together or self.latest[p] == s - 1 and self.second[p] == s - 2
        t, before = y - last, last - order[s - 2] if s > 1 else 0
        if t > 0:
            going = 1 if t == 1 else 3 if t < 4 else 4 if t < 16 else 5
        else:
            going = 2 if t == -1 else 6 if t > -4 else 7 if t > -16 else 8
        went = 0 if before == 0 else 1 if before == 1 else 2 if before == -1 else 3 if before > 0 else 4
        r, (l, l2, l3) = min(i, 3), self.ways
        return self.mixed.read(self.stream, (
            (nearness, copy, parallel, count, r, l), (l, l2, l3, r, nearness, parallel, copy),
            (l, l2, l3, min(i, 7), parallel), (beside, completes, together, min(filled, 4), l, parallel),
            (going, went, t == before, r, beside_last), (free, free_before, nearness, r, l),
            (min(i, 20), min(candidates, 20), l)),
            (r, beside_last, l), nearness if going == 1 else 8 + nearness + 8 * completes + 16 * copy)


def read_face_map(data, mesh):
    """FMAP (section 6): P and F of each canonical polygon."""
    stream = RangeDecoder(data)
    n = len(mesh.starts) - 1
    once = Once(stream, n)
    order = [once.number() for _ in range(n)]
    numbers, r, turns = integers(), 0, []
    for i in range(n):
        r = stream.unsigned(numbers['rotation', min(r, 3)])
        need(r < max(1, mesh.starts[i + 1] - mesh.starts[i]), 'INDEX_RANGE', 'rotation')
        turns.append(r)
    stream.end()
    return order, turns
