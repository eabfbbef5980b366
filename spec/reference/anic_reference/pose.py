# SPDX-License-Identifier: CC0-1.0
"""Chapter 09b: reference poses and native key-frames, in exact arithmetic of binary64. Vectors are arrays."""
import math
from types import SimpleNamespace
import numpy as np
from .conventions import check, clamp, floor_log2, total
from .entropy import Bit, Models, Row, StateDecoder, log_class, defaultdict
from .weights import Filter

STATES = ((0, 2), (5, 7), (1, 3), (6, 4), (2, 0), (4, 6), (3, 1), (7, 5))
FORGETTING, FARTHEST, NONE = 994 / 1000, 2.0**22, np.zeros(3)

dot = lambda a, b: a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
cross = lambda a, b: a[[1, 2, 0]] * b[[2, 0, 1]] - a[[2, 0, 1]] * b[[1, 2, 0]]
length = lambda a: np.sqrt(dot(a, a))
mean = lambda values, zero=NONE: 1 / len(values) * total(values, zero)
larger = lambda x, y: y if x < y else x
eighths = lambda y: 0 if not 8 * y > 0 else math.floor(8 * y) if 8 * y < 2.0**30 else 2**30  # X of section 5

class Corners:
    """Section 1: the corners of the coded triangles: those at vertices, opposites, vertices beside them."""
    def __init__(self, count, triangles):
        self.vertex, self.at = [v for triangle in triangles for v in triangle], [[] for _ in range(count)]
        self.beside = [pair for a, b, c in triangles
                       for pair in ((b, c), (c, a), (a, b))]      # next, previous
        self.opposite, waiting = [None] * len(self.vertex), (None, None)
        for c, v in enumerate(self.vertex):
            self.at[v].append(c)
        for ends, c in sorted((sorted(pair), c) for c, pair in enumerate(self.beside)):
            met = waiting[0] == ends
            if met:
                self.opposite[c], self.opposite[waiting[1]] = waiting[1], c
            waiting = (None, None) if met else (ends, c)
        self.valence = [len(at) for at in self.at]

class Turn:  # Section 7: how the place that is followed is turned; bits of `flips`: axes that are flipped
    def __init__(self, flips=0):
        self.mirrors, ones = bin(flips).count("1") % 2, [-1.0 if flips >> d & 1 else 1.0 for d in range(3)]
        self.filters = [Filter(row, 0.1, FORGETTING) for row in np.diag(ones).tolist()]

def new_filters(_, follows):
    """The filters of a kind: for two axes, for the last one, and for the sizes of what is left of either."""
    weights = (([0.0] * 7, [0.0] * 3, [0.5, 0.1, 0.0, 0.0, 0.0], [0.5, 0.1, 0.0, 0.0]),
               ([0.0] * 7 + [0.5] * 2, [0.0] * 3 + [0.5] * 2, [0.5] + [0.0] * 5, [0.5] + [0.0] * 4))[follows]
    return [Filter(u, diagonal, FORGETTING) for u, diagonal in zip(weights, (0.05, 0.05, 0.1, 0.1))]

class Partners:  # Section 8: vertices that are like others of the same pose
    def __init__(self, decoder, corners):
        self.decoder, self.corners, self.bits, self.last = decoder, corners, defaultdict(Bit), 0
        self.to, self.back, self.strand, self.turns, self.strands = {}, {}, {}, {}, 0
    bit = lambda self, *name: self.decoder.bit(self.bits[name])
    def image(self, w, s):
        u = self.to[w] if self.strand.get(w) == s else self.back.get(w)
        return u if s in (self.strand.get(w), self.strand.get(u)) else None
    def start(self):
        s, self.strands = self.strands % 256, self.strands + 1
        self.turns[s] = Turn(self.decoder.raw(3))
        return s
    def read(self, v, neighbours):                      # Reads the partner of v and its strand, if it has one
        linked, selves, nearest, scores, corners = 0, 0, None, {}, self.corners
        for w in (w for w in neighbours[:8] if w in self.to or w in self.back):
            u = self.to.get(w, self.back.get(w))
            s = self.strand[w if w in self.to else u]
            linked, selves, nearest = linked + 1, selves + (u == w), s if nearest is None else nearest
            for x in (x for c in corners.at[u][:16] for x in corners.beside[c]):
                if x < v and x != w and self.image(x, s) is None and ((x, s) in scores or len(scores) < 12):
                    scores[x, s] = scores.get((x, s), corners.valence[x] == corners.valence[v]) + 1
        candidates, linked = sorted(scores, key=scores.get, reverse=True), min(linked, 3)
        ranked, found = [scores[candidate] for candidate in candidates] + [0], None
        some = self.bit("any", linked, min(ranked[0], 9), self.last)
        self.last = (2 * self.last + some) & 3
        if some and self.bit("itself", linked, min(selves, 3)):
            found = v, self.start() if nearest is None else nearest
        elif some:
            found = next((candidate for i, candidate in enumerate(candidates) if
                          self.bit("which", min(i, 2), min(ranked[i] - ranked[i + 1], 3))), None)
            if not found:
                u = self.decoder.raw((len(corners.at) - 1).bit_length())
                check(u < v, "ENTROPY", "a partner that is not known")
                found = u, self.start()
        if found:
            self.to[v], self.strand[v], self.back[found[0]] = *found, v

class PoseDecoder:
    """State shared by the poses of a stream, and the pose at hand. `at` is what is known of the vertex at hand."""
    def __init__(self, decoder, corners):
        self.decoder, self.corners = decoder, corners
        self.rows, self.bits = defaultdict(Row), defaultdict(Bit)
        self.filters, self.usual = Models(new_filters), {False: [100.0, 10.0], True: [100.0, 10.0]}
        self.far = {(0, False): 10000.0, (1, False): 300.0, (0, True): 100.0, (1, True): 30.0}
    def pose(self, key_frame=False, parent=None):
        """The positions of the vertices; `parent`: those of the key-frame that this one is coded against."""
        count, decoder = len(self.corners.at), self.decoder
        self.exact, self.key_frame, self.parent = not key_frame and decoder.raw(1), key_frame, parent
        self.partners = Partners(decoder, self.corners) if parent is None and decoder.raw(1) else None
        self.turn, self.positions, self.states, self.last_candidate = Turn(), [], [0, 0, 0], 0
        self.error, self.offset, self.was_candidate = (np.zeros((count, 3), kind)
                                                       for kind in ("f4", "f4", int))
        for v in range(count):
            at = self.surroundings(v)
            self.find_place(at)
            at.filters, at.usual = self.filters[at.kind, at.follows], self.usual[at.follows]
            at.position, at.residual, at.relative = np.zeros(3), [0.0] * 3, 0.0
            for step, d in enumerate(at.axes):
                told = self.expectation(at, step, d)
                at.position[d] = self.coordinate(at, step, d, told)
                self.learn(at, step, d, told)
            self.positions.append(at.position)
            for each, value in zip(at.turn.filters if at.follows else (), at.position - at.anchor):
                each.learn(at.there, value, 1 + 0.001 * dot(at.there, at.there))
        return self.positions
    def surroundings(self, v):                          # Section 3
        corners, place, noted, near, gates, valences = self.corners, self.positions, {v}, [], [], 0
        normal, forward, at = NONE, NONE, SimpleNamespace(v=v, axes=(0, 1, 2), follows=False, anchor=NONE)
        at.gates, at.neighbours, at.gate_vertices = gates, near, []
        for c in corners.at[v][:32]:
            (a, b), over = corners.beside[c], corners.opposite[c]
            x = v if over is None else corners.vertex[over]
            near += [w for w in dict.fromkeys((a, b)) if w < v and w not in noted]
            noted.update((a, b))
            if max(a, b, x) < v and len(gates) < 16:
                at.gate_vertices.append((a, b, x))
                gates.append(place[a] + place[b] - place[x])
                normal = normal + cross(place[b] - place[a], place[x] - place[a])
                forward = forward + (0.5 * (place[a] + place[b]) - place[x])
                valences += corners.valence[a] + corners.valence[b]
        at.kind = 0 if not near else 1 if not gates else 1 + min(len(gates), 3)
        at.mean = mean([place[w] for w in near]) if near else place[v - 1] if v else NONE
        at.base = mean(gates) if gates else at.mean
        if gates:
            forward, valences = 1 / len(gates) * forward, 1 / len(gates) * valences
            valence = max(corners.valence[v], 3)
            self.directions(at, normal)
            at.length = mean([length(place[w] - at.base) for w in near], 0.0)
            at.tan, at.nor = (mean([float(self.error[w][i]) for w in near], 0.0) for i in (0, 1))
            at.drift = mean([self.offset[w].astype(float) for w in near])
            at.spread = total(length(gate - at.base) for gate in gates) / len(gates)
            at.f = [at.mean - at.base, at.drift, forward, (6 / valence - 1) * forward,
                    (valences / 12 - 1) * forward]
            at.f += [gates[i] - at.base if len(gates) > i + 1 else NONE for i in (0, 1)]
        return at
    def directions(self, at, normal):
        """The order of the axes and what goes with it, by the normal of the gates."""
        at.n, at.share, at.correlation, size = np.array([0.0, 0.0, 1.0]), np.ones(3), 0.0, length(normal)
        if size > 0:
            at.n = n = 1 / size * normal
            k = max(range(3), key=lambda axis: abs(n[axis]))
            i, j = sorted(((k + 1) % 3, (k + 2) % 3), key=lambda axis: abs(n[axis]))
            first = np.sqrt(1 - n[i] * n[i])
            at.axes, at.share = (i, j, k), (first, abs(n[k]) / first, 1 / abs(n[k]))
            at.correlation = -n[i] * n[j] / (first * first)
    def slope(self, at, q):
        """How far the plane through base, across the normal, falls towards q along the last axis."""
        i, j, k = at.axes
        return (at.n[i] * (q[i] - at.base[i]) + at.n[j] * (q[j] - at.base[j])) / at.n[k]
    height = lambda self, at, q: q[at.axes[2]] - at.base[at.axes[2]] + self.slope(at, q)
    def find_place(self, at):  # Reads the partner of a vertex, and follows it or the parent of the key-frame
        if self.parent:
            self.follow(at, self.turn, self.parent, lambda w: w)
        if self.partners:
            partners, v = self.partners, at.v
            partners.read(v, at.neighbours)
            if partners.to.get(v, v) != v:
                s = partners.strand[v]                  # v itself is not known yet
                self.follow(at, partners.turns[s], self.positions,
                            lambda w: None if partners.image(w, s) == v else partners.image(w, s))
    def follow(self, at, turn, other, image):  # Section 7: the vertex follows its image in the pose `other`
        like = [w for w in at.neighbours if image(w) is not None]
        like = [at.v - 1] if at.kind == 0 and at.v > 0 and image(at.v - 1) is not None else like
        if not like:
            return
        at.follows, at.turn, there = True, turn, other[image(at.v)]
        at.anchor = mean([self.positions[w] for w in like])
        at.there = there - mean([other[image(w)] for w in like])
        at.likely = at.anchor + np.array([each.expect(at.there) for each in turn.filters])
        if at.kind < 2:
            at.base = at.likely
            return
        at.f += [at.likely - at.base] * 2
        gates = [gate for gate in at.gate_vertices if all(image(w) is not None for w in gate)]
        here = frame([[self.positions[w] for w in gate] for gate in gates])
        away = frame([[other[image(w)] for w in gate] for gate in gates])
        if here and away:
            (n, ahead, centre), (away_n, away_ahead, away_centre) = here, away
            off = there - away_centre
            along, up, side = dot(off, away_ahead), dot(off, away_n), dot(off, cross(away_n, away_ahead))
            up = -up if turn.mirrors else up
            at.f[8] = centre + (along * ahead + side * cross(n, ahead) + up * n) - at.base
    def expectation(self, at, step, d):
        """Section 4: a mean and the magnitudes scale, near, spread, before; and what is learnt from."""
        if at.kind < 2:
            far = self.far[at.kind, at.follows]
            before = abs(at.residual[at.axes[step - 1]]) if step else far
            return SimpleNamespace(mean=at.base[d], magnitudes=[far, far, far, before])
        last, share = int(step == 2), at.share[step]
        usual, asked, sizes = at.usual[last], at.filters[last], at.filters[2 + last]
        if last:
            ground, error, typical = at.base[d] - self.slope(at,
                                                             at.position), float(self.error[at.v][0]), at.nor
            z = [self.height(at, at.gates[0]) if len(at.gates) > 1 else 0.0, self.height(at, at.mean),
                 dot(at.n, at.drift) / at.n[d]] + [self.height(at, at.base + f) for f in at.f[7:]]
            apart = total(abs(self.height(at, gate)) for gate in at.gates) / len(at.gates)
            s = [at.nor, apart / share, usual, error] + (z[3:] and [abs(z[3] - z[4]) / share])
            others = [at.nor * share, apart, error * share]
        else:
            ground = at.base[d] + (at.correlation * at.residual[at.axes[0]] if step else 0)
            z, before, typical = [vector[d] for vector in at.f], at.relative if step else at.length, at.tan
            s = [at.tan, at.length, at.spread, usual, at.relative]
            s += [length(at.f[7] - at.f[8])] if at.follows else []
            others = [at.tan * share, at.spread * share, before * share]
        told, likely = asked.expect(z), larger(typical if typical > 0 else usual, 0.001)
        expect, low, high = sizes.expect(s), 0.15 * likely, 8 * likely + 8 * at.length
        expect = (expect if expect < high else high) if expect > low else low
        return SimpleNamespace(mean=ground + told, magnitudes=[expect * share] + others, z=z, told=told, s=s,
                               learnt_from=ground if last else at.base[d], expect=expect)
    def coordinate(self, at, step, d, told):            # Section 5: a coordinate
        found, state = self.candidate(at, d, told.mean) if self.exact else None, self.states[d]
        if found is not None or self.exact or self.key_frame:
            return self.residual(told.mean, told.magnitudes, step) if found is None else found
        h = self.residual(0.5 * (told.mean - (state & 1)), [0.5 * y for y in told.magnitudes], step)
        self.states[d] = STATES[state][h & 1]
        return 2 * h + (state & 1)
    def residual(self, expected, magnitudes, step):     # A coordinate by its distance from what is expected
        rows, last, expected = self.rows, int(step == 2), 0.0 if math.isnan(expected) else expected
        expected, x = clamp(expected, -FARTHEST, FARTHEST), [eighths(y) for y in magnitudes]
        c, low, z = math.floor(expected + 0.5), clamp(floor_log2(x[0]) - 4, 0, 12), log_class(2, x[0], 64)
        scale, near, spread, before = (log_class(0, y >> low, 16) for y in x)
        s = self.decoder.symbol(rows["scale", z, last], rows["near", before, near, last],
                                rows["spread", spread, scale, last])
        more = [rows["scale", z], rows["before", before], rows["spread", spread]]
        m = self.decoder.magnitude(s, more, [rows["more", k] for k in range(4)], low)
        quarter = sum(expected - c >= limit for limit in (-0.25, 0, 0.25))
        return c - m if m and self.decoder.bit(self.bits["sign", last, quarter]) else c + m
    def candidate(self, at, d, expected):               # One of the exact coordinates that are near, or none
        choices = [(6, at.likely[d] + 0.5)] if at.follows else []
        choices += [(slot, gate[d]) for slot, gate in enumerate(at.gates[:2])]
        choices += [(2 + slot, self.positions[w][d]) for slot, w in enumerate(at.neighbours[:3])]
        choices += [] if at.neighbours else [(5, expected + 0.5)]
        near, seen = sum(self.was_candidate[w][d] for w in at.neighbours[:3]) if at.neighbours else 4, set()
        for slot, q in ((slot, math.floor(q)) for slot, q in choices if abs(q) < 2.0**32):
            if abs(q) < 2**31 and q not in seen:
                seen.add(q)
                if self.decoder.bit(self.bits[slot, d, near, min(at.kind, 3), self.last_candidate]):
                    self.last_candidate = self.was_candidate[at.v][d] = 1
                    return q
        self.last_candidate = 0
        return None
    def learn(self, at, step, d, told):                 # Section 6. `error` and `offset` are in binary32
        x, error, last, away = at.position[d], self.error[at.v], int(step == 2), at.position[d] - at.base[d]
        if at.kind < 2:
            at.residual[d], far = away, self.far[at.kind, at.follows]
            self.far[at.kind, at.follows] += 0.1 * (abs(away) - far)
            error[:2] = (error[0] + np.float32(abs(away) / 3), at.usual[1]) if at.kind else error[:2]
            return
        at.relative, scale = abs((x - told.mean) / at.share[step]), told.magnitudes[0]
        at.residual[d], self.offset[at.v][d] = away - told.told, away
        at.filters[last].learn(told.z, x - told.learnt_from, 0.01 + scale * scale)
        error[last] = at.relative + 0.001 if last else error[0] + np.float32(0.5 * at.relative)
        at.filters[2 + last].learn(told.s, at.relative, 0.1 + told.expect * told.expect)
        at.usual[last] += 0.01 * (at.relative - at.usual[last])

def frame(gates):
    """Section 7: directions and centre of gates, each given by three places; None where there are none."""
    n, ahead, centre = NONE, NONE, NONE
    for a, b, x in gates:
        n, ahead, centre = n + cross(b - a, x - a), ahead + (0.5 * (a + b) - x), centre + (a + b - x)
    if length(n) > 0:
        n = 1 / length(n) * n
        ahead = ahead - dot(ahead, n) * n
        return (n, 1 / length(ahead) * ahead, 1 / len(gates) * centre) if length(ahead) > 0 else None
    return None

def read_poses(data, corners, parents=None):
    """A reference pose, or the key-frames of section 9 with their parents: [key-frame, vertex, axis]."""
    decoder, found = StateDecoder(data), []
    poses = PoseDecoder(decoder, corners)
    for parent in [0] if parents is None else parents:
        found.append(poses.pose(parents is not None, found[parent - 1] if parent else None))
    return decoder.end(np.array(found).astype(np.int64))
