# SPDX-License-Identifier: CC0-1.0
"""Chapter 07: faces, copies, polygons, the source's order of all of them."""
from itertools import islice
from types import SimpleNamespace
from .conventions import check
from .entropy import Bit, Mixed, RangeDecoder, defaultdict, integers

GATES_OF_A_SIDE, STEPS_OF_A_SEARCH, COPIES_ASKED_FOR, MOST = 64, 24, 16, 255

class Walk:
    """The walk over the faces (section 3). A gate is the number of the corner at which its side starts."""
    def __init__(self, decoder, counts, faces, repeats):
        self.decoder, self.counts, self.left, self.repeats = decoder, counts, faces, repeats
        self.border, self.right, self.left_side = Mixed(4), Mixed(7), Mixed(7)          # B, R, L
        self.bits, self.count, self.opposite, self.faces = defaultdict(Bit), 0, [], []  # count: vertices seen
        self.starting, self.ending, self.ends = defaultdict(dict), defaultdict(dict), {}        # open gates
        self.faces_at, self.borders_at, self.first_at = defaultdict(int), defaultdict(int), defaultdict(int)
        self.ways, self.size_before, self.repeats_before, self.last_border, self.quiet = 0, 3, 0, 0, (6, 6)
        pivot = 0
        while self.left:
            if pivot == self.count:
                corners = []
                for i in range(self.size()):
                    corners.append(self.number() if self.count and self.bit("old", min(i, 3)) else self.new())
                self.close(corners, None, 5)
                continue
            self.first_at[pivot] = self.faces_at[pivot]
            while self.left and (self.starting[pivot] or self.ending[pivot]):
                side, gates = int(not self.starting[pivot]), self.starting[pivot] or self.ending[pivot]
                self.pass_gate(next(reversed(gates)), side)
            self.quiet, pivot = (min(self.faces_at[pivot], 15), self.quiet[0]), pivot + 1
    bit = lambda self, *name: self.decoder.bit(self.bits[name])
    after = lambda self, v: self.ends[next(reversed(self.starting[v]))][1] if self.starting[v] else None
    before = lambda self, v: self.ends[next(reversed(self.ending[v]))][0] if self.ending[v] else None
    latest_ways = lambda self, count: self.ways & (1 << 3 * count) - 1  # h of section 3.3, octal digits
    degree = lambda self, v, most, none=12: none if v is None else min(self.faces_at[v], most)  # m of 3.3
    left_over = lambda self: self.counts.corners - len(self.opposite)
    def size(self):
        n = 3
        check(self.left_over() >= 3, "TOPOLOGY", "no corners left")
        while n < self.left_over() and self.bit("more", min(n - 3, 5), min(self.size_before - 3, 5)):
            n += 1
        self.size_before = n
        return n
    def new(self):
        self.count += 1
        check(self.count <= self.counts.coded_vertices, "TOPOLOGY", "more vertices than there are")
        return self.count - 1
    def number(self):
        v = self.decoder.raw((self.count - 1).bit_length())
        check(v < self.count, "INDEX_RANGE", "a vertex that was not seen")
        return v
    def drop(self, gate):
        a, b = self.ends.pop(gate)
        del self.starting[a][gate], self.ending[b][gate]
    def close(self, corners, gate, way):  # section 3.1: the sides of a face meet gates or open them
        self.ways, first, n, m = (self.ways << 3 | way) & 0xFFF, len(self.opposite), len(corners), 0
        for i, a in enumerate(corners):
            b, latest = corners[(i + 1) % n], islice(reversed(self.starting[a]), GATES_OF_A_SIDE)
            met = next((g for g in latest if self.ends[g][1] == b), None) if i or gate is None else gate
            self.faces_at[a] = min(self.faces_at[a] + 1, MOST)
            self.opposite.append(met)
            if met is None:
                self.ends[first + i] = b, a
                self.starting[b][first + i] = self.ending[a][first + i] = True
            else:
                self.drop(met)
        before = min(self.repeats_before, 2)
        while self.repeats and m < self.left - 1 and self.bit("again", min(m, 1), before):
            m += 1
        check(m * n <= self.left_over(), "TOPOLOGY", "more corners than there are")
        self.opposite += [None] * (m * n)
        self.faces += [(corners, i > 0) for i in range(m + 1)]              # with whether they repeat one
        self.left, self.repeats_before = self.left - 1 - m, m
    def pass_gate(self, gate, side):                    # section 3.2, with the contexts of 3.3
        (a, b), decoder, m, ways = self.ends[gate], self.decoder, self.degree, self.latest_ways
        borders, quiet, y, x = self.borders_at, self.quiet, self.after(b), self.before(a)
        bordered = borders[a] > 0, borders[b] > 0
        contexts = (bordered + (self.last_border,),
                    (min(borders[a], 2), min(borders[b], 2), m(a, 7), m(b, 7)),
                    (ways(2),) + bordered, (m(a, 9), side, bordered[0]))
        self.last_border = self.border.read(decoder, contexts, (bordered, ()))
        if self.last_border:
            self.drop(gate)
            for v in (a, b):
                borders[v] = min(borders[v] + 1, MOST)
            self.ways = (self.ways << 3 | 7) & 0xFFF
            return
        n = self.size()
        corners, s, low, high, e, z = [a, b] + [None] * (n - 2), min(n - 3, 2), 2, n, b, y
        on_right = lambda: (((m(e, 12), m(a, 12), s, side), (m(e, 12), m(z, 12), side, low > 2),
                             (ways(3), side), (m(e, 7), m(a, 7), m(z, 7), m(x, 6, 7)),
                             (m(e, 9), ways(2), min(borders[e], 2)),
                             (m(e, 12), m(a, 12), m(z, 12)), (m(e, 12), z == x)),
                            ((m(e, 11), side), (ways(1), side)))
        while low < high and z not in (None, a) and self.right.read(decoder, *on_right()):
            corners[low] = e = z
            low, z = low + 1, self.after(e)
        right, h, z = int(low > 2), a, x
        on_left = lambda: (((m(h, 12), m(b, 12), m(z, 12), side), (ways(3), side, right, s),
                            (m(h, 9), m(b, 9), m(z, 9), m(y, 9, 9)), (m(h, 12),) + quiet,
                            (m(h, 12), m(z, 12), m(b, 12), quiet[0]),
                            (m(h, 12), m(z, 12), m(self.before(z), 12), min(self.first_at[h], 12)),
                            (m(h, 12), ways(4))), ((m(h, 11), side), (m(b, 3), m(z, 3), right)))
        while low < high and z not in (None, e) and self.left_side.read(decoder, *on_left()):
            high -= 1
            corners[high] = h = z
            z = self.before(h)
        way = right + 2 * (high < n)
        for k in range(low, high):
            seen = self.bit("seen", ways(1), m(a, 7), side, any(bordered))
            corners[k], way = (self.search(a, b), 4) if seen else (self.new(), way)
        self.close(corners, gate, way)
    def search(self, a, b):  # a vertex that was seen, along the gates from b and to a
        ends = [b, a]
        for step, d in ((step, d) for step in range(STEPS_OF_A_SEARCH) for d in (0, 1)):
            ends[d] = None if ends[d] is None else self.before(ends[d]) if d else self.after(ends[d])
            if ends[d] not in (None, a, b) and step and self.bit("step", step, d):
                return ends[d]
        return self.number()

class Copies:
    """Section 4.1: the copy at each corner of the walk, and how many each coded vertex has."""
    def __init__(self, decoder, walk, counts):
        self.decoder, self.opposite, self.bits = decoder, walk.opposite, defaultdict(Bit)
        spare, first = defaultdict(Bit), 0
        self.used, self.copies, self.following, self.answers = [0] * counts.coded_vertices, [], [], 0
        self.over_before, self.over_after, self.fresh = Mixed(6), Mixed(6), Mixed(4)            # F, G, N
        several, made = counts.source_vertices != counts.coded_vertices, counts.coded_vertices - walk.count
        for face, _ in walk.faces:                      # the corner after each in its face
            corner = len(self.following)
            self.following += [*range(corner + 1, corner + len(face)), corner]
        for face, repeated in walk.faces:
            if several and repeated and decoder.bit(self.bits["same"]):
                self.copies += self.copies[-len(face):]
            else:
                for i, v in enumerate(face):
                    copy = self.choice(face, i, first) if several and self.used[v] else 0
                    self.copies.append(copy)
                    self.used[v], made = max(self.used[v], copy + 1), made + (copy == self.used[v])
                    check(made <= counts.source_vertices, "TOPOLOGY", "more vertices than there are")
            first += len(face)
        self.used[walk.count:], v = [1] * (counts.coded_vertices - walk.count), 0               # loose ones
        for _ in range(made, counts.source_vertices):
            v += decoder.unsigned(spare)
            check(v < counts.coded_vertices, "INDEX_RANGE", "a copy of no vertex")
            self.used[v] += 1
    at = lambda self, corner: self.copies[corner] if corner < len(self.copies) else 0
    def ask(self, model, contexts, selector):
        answer = model.read(self.decoder, contexts, (selector, ()))
        self.answers = (self.answers << 1 | answer) & 255                       # the last eight
        return answer
    def choice(self, face, i, first):  # P and Q of the text are p_kind and q_kind, t is `around`
        n, v, used, place, p, q = len(face), face[i], self.used, min(i, 3), None, None
        over_p, over_q, p_kind, q_kind = self.opposite[first + (i - 1) % n], self.opposite[first + i], 2, 2
        if over_p is not None:
            p, other = self.at(over_p), self.at(self.following[over_p])
            p_kind = 3 if i == 0 else int(other == self.copies[-1])
        if over_q is not None:
            q, other = self.at(self.following[over_q]), self.at(over_q)
            q_kind = 3 if i < n - 1 else int(other == self.copies[first])
        has_p, has_q, several, late = int(p is not None), int(q is not None), used[v] > 1, self.answers
        around = tuple(min(used[w], 4) for w in (v, face[i - 1], face[(i + 1) % n]))
        if has_p:
            equal = int(q == p) if has_q else 2
            contexts = ((p_kind, several, has_q), (p_kind, q_kind, around), (late & 15, p_kind),
                        (equal, p_kind, place), (around, equal), (late,))
            if self.ask(self.over_before, contexts, (p_kind,)):
                return p
        late = self.answers
        if has_q and q != p:
            contexts = ((q_kind, has_p, several), (q_kind, p_kind, has_p, around), (late & 15, q_kind, has_p),
                        (q_kind, p_kind, has_p, place), (around, has_p), (late, has_p))
            if self.ask(self.over_after, contexts, (q_kind, has_p)):
                return q
        others = [x for x in range(used[v] - 1, -1, -1) if x not in (p, q)]
        contexts = ((min(used[v], 7), has_p, has_q), (around, has_p),
                    (self.answers & 15, has_p, min(used[v], 6)), (p_kind, q_kind, has_p, has_q))
        if not others or self.fresh.read(self.decoder, contexts, ((has_p,), ())):
            return used[v]
        for asked, x in enumerate(others[:COPIES_ASKED_FOR]):
            if x == others[-1] or self.decoder.bit(self.bits["which", asked]):
                return x
        x = self.decoder.raw((used[v] - 1).bit_length()) if len(others) > COPIES_ASKED_FOR + 1 else others[-1]
        check(x < used[v], "TOPOLOGY", "a copy that there is not")
        return x

def read_faces(data, counts):  # The connectivity of a mesh, whose counts are those of LIMI
    decoder, sizes, step, v, first = RangeDecoder(data), defaultdict(Bit), defaultdict(Bit), 0, [0]
    apart = decoder.unsigned(sizes)
    check(apart <= counts.polygons, "TOPOLOGY", "more polygons than there are")
    walk = Walk(decoder, counts, counts.polygons - apart, decoder.bit(Bit()))
    once = [face for face, repeated in walk.faces if not repeated]
    check(sum(len(face) - 2 for face in once) == counts.triangles, "TOPOLOGY", "triangles")
    copies = Copies(decoder, walk, counts)
    for used in copies.used:
        first.append(first[-1] + used)
    at, left = iter(copies.copies), walk.left_over()
    polygons = [[first[v] + next(at) for v in face] for face, _ in walk.faces]
    for _ in range(apart):
        polygons.append([])
        size = decoder.unsigned(sizes)
        left -= size
        check(left >= 0, "TOPOLOGY", "more corners than there are")
        for _ in range(size):
            v += decoder.signed(step)
            check(0 <= v < counts.source_vertices, "INDEX_RANGE", "a corner at no vertex")
            polygons[-1].append(v)
    check(left == 0, "TOPOLOGY", "fewer corners than announced")
    decoder.end()
    # polygons in canonical numbers; the first copy of each coded vertex; the coded vertex of each vertex
    return SimpleNamespace(counts=counts, polygons=polygons, first=first,
                           triangles=[(f[0], f[k], f[k + 1]) for f in once for k in range(1, len(f) - 1)],
                           coded=[v for v, used in enumerate(copies.used) for _ in range(used)])

NEAR, COPIES, CANDIDATES, REACH = 24, 8, 32, 48
NEARNESS = (1, 2, 3, 5, 9, 17, 65)                      # the largest distance of each but the last

class NumbersOnce:
    """Numbers below n, each at most once. Forests with path compression lead to the nearest free ones."""
    def __init__(self, decoder, n):
        self.decoder, self.n, self.b, self.context = decoder, n, 0, 0
        self.hits, self.step, self.steps = defaultdict(Bit), defaultdict(Bit), [0] * 12
        self.upward, self.downward = list(range(n + 1)), list(range(n + 1))     # n: none; 0: none, 1: 0
    hit = lambda self, kind: self.decoder.bit(self.hits[kind, self.context])
    def root(self, forest, x):
        while forest[x] != x:
            forest[x] = x = forest[forest[x]]
        return x
    def take(self, x):
        self.upward[x], self.downward[x + 1], self.b, self.context = x + 1, x, x + 1, 0
    def number(self):
        up, down = self.root(self.upward, self.b), self.root(self.downward, max(self.b - 1, 0)) - 1
        if up < self.n and self.hit(0):
            x, kind = up, 0
        elif down >= 0 and self.hit(1):
            x, kind = down, 1
        else:
            k = next((k for k in range(12) if self.hit(2 + k)), 12)
            step, kind = (self.steps[k], 2) if k < 12 else (self.decoder.signed(self.step), 3)
            del self.steps[min(k, 11)]
            self.steps.insert(0, step)
            x = self.b + step
        check(0 <= x < self.n and self.upward[x] == x, "INDEX_RANGE", "a number out of range or twice")
        self.take(x)
        self.context = kind
        return x

class VertexMap:  # Reads VMAP. `vertex`: the canonical numbers of the source's vertices so far
    def __init__(self, mesh):
        self.mesh, self.vertex, self.place = mesh, [], [-1] * mesh.counts.source_vertices
        beside, self.polygons_at = [set() for _ in self.place], [[]
                for _ in self.place]        # one for each corner
        for p, polygon in enumerate(mesh.polygons):
            for i, v in enumerate(polygon):
                beside[v].add(polygon[i - 1])
                beside[polygon[i - 1]].add(v)
                self.polygons_at[v].append(p)
        self.near = [sorted(others - {v})[:NEAR] for v, others in enumerate(beside)]
        self.placed = [[] for _ in mesh.polygons]       # places of the corners of each polygon that have one
    def read(self, data):
        decoder, model, ways = RangeDecoder(data), Mixed(7), (4, 4, 4)
        numbers = NumbersOnce(decoder, len(self.place))
        for s in range(len(self.place)):
            chosen, way = None, 4
            for i, (features, y, size) in enumerate(self.candidates(s)):
                if model.read(decoder, *self.contexts(s, i, y, *features, size, ways)):
                    chosen, way = y, 1 if features[2] else 0 if features[1] == 1 else 2 if features[0] else 3
                    numbers.take(y)
                    break
            chosen = numbers.number() if chosen is None else chosen
            self.vertex.append(chosen)
            self.place[chosen], ways = s, (way,) + ways[:2]
            for p in self.polygons_at[chosen]:
                self.placed[p].append(s)
        return decoder.end(self.vertex)
    def copies(self, v):
        first, c = self.mesh.first, self.mesh.coded[v]
        return range(max(first[c], v - COPIES), min(first[c + 1] - 1, v + COPIES) + 1)
    def candidates(self, s):
        """Candidates for place s by -parallel, distance, copy and -count, with how many there are up to
        the end of their group."""
        before, found = self.near[self.vertex[s - 1]] if s else [], []
        places = [self.place[w] for w in before if self.place[w] >= 0]
        for group in ([before], self.further(s, places)):
            first = len(found)
            for y in (y for vertices in group if len(found) < CANDIDATES for y in vertices):
                if len(found) < CANDIDATES and self.place[y] < 0 and y not in found:
                    found.append(y)
            yield from sorted((self.features(y, s, places), y, len(found)) for y in found[first:])
    def further(self, s, places):
        for a in places:
            if a + 1 < s - 1:
                yield self.near[self.vertex[a + 1]]
            if a > 0:
                yield self.near[self.vertex[a - 1]]
        for k in range(1, min(REACH, s) + 1):
            yield self.near[self.vertex[s - k]]
            yield self.copies(self.vertex[s - k])
    def features(self, y, s, places):
        around = [self.place[w] for w in self.near[y] if self.place[w] >= 0]
        touched, copied = max(around, default=-1), max(self.place[w] for w in self.copies(y))
        steps = {p - a for p in around if p < s - 1 for a in places}
        return (-2 if 1 in steps else -(-1 in steps), s - max(touched, copied), int(copied > touched),
                -min(len(around), 3))
    def contexts(self, s, i, y, parallel, distance, copy, count, size, ways):
        """Contexts and selectors of the question whether y has place s."""
        near, last, rank = self.near[y], self.vertex[s - 1], min(i, 3)
        nearness = sum(distance > limit for limit in NEARNESS)
        faces = [(self.placed[p], len(self.mesh.polygons[p])) for p in self.polygons_at[y][:NEAR]]
        beside = sum(4 >> k for k in range(min(s, 3)) if self.vertex[s - 1 - k] in near)
        filled = min(max((len(placed) for placed, _ in faces), default=0), 4)
        completes = int(any(len(placed) == corners - 1 for placed, corners in faces))
        together = int(any(([-1, -1] + placed)[-2:] == [s - 2, s - 1] for placed, _ in faces))
        t, before = y - last, last - self.vertex[s - 2] if s > 1 else 0
        going = {1: 1, -1: 2}.get(t) or (3 if t > 0 else 6) + (abs(t) >= 4) + (abs(t) >= 16)
        went = {0: 0, 1: 1, -1: 2}.get(before, 3 if before > 0 else 4)
        free, free_before = (min(sum(self.place[w] < 0 for w in self.near[v]), 7) for v in (y, last))
        walked = nearness if going == 1 else 8 + nearness + 8 * completes + 16 * copy
        contexts = ((nearness, copy, parallel, count, rank, ways[0]), ways + (rank, nearness, parallel, copy),
                ways + (min(i, 7), parallel), (beside, completes, together, filled, ways[0], parallel),
                (going, went, t == before, rank, last in near), (free, free_before, nearness, rank, ways[0]),
                (min(i, 20), min(size, 20), ways[0]))
        return contexts, ((rank, last in near, ways[0]), walked)

def read_face_map(data, polygons):
    """FMAP: of each canonical polygon the number in the source, and the rotation."""
    decoder, models, rotations = RangeDecoder(data), integers(), [0]
    numbers = NumbersOnce(decoder, len(polygons))
    order = [numbers.number() for _ in polygons]
    for polygon in polygons:
        rotations.append(decoder.unsigned(models[min(rotations[-1], 3)]))
        check(rotations[-1] < max(1, len(polygon)), "INDEX_RANGE", "a rotation too large")
    return decoder.end((order, rotations[1:]))
