# SPDX-License-Identifier: CC0-1.0
"""Chapter 09a: segments. Chapter 06, sections 8, 9 and 11: BASI, CORR, ROOT."""
import math
import numpy as np
from types import SimpleNamespace as Record
from . import records
from .coefficients import Coefficients
from .common import Reader, need, signed32, xxh64
from .entropy import Models, RangeDecoder, Words, bit_model, bits, integers
from .exact import ExactPositions, neighbours_of, read_diff
from .order import decoding_order, graph_of, is_dense
from .pose import read_key_frames, read_pose
from .prediction import reconstruct
from .timeweights import TimeWeights

BIG = 2.0 ** 64


def i32_bytes(values):
    """Integers as the hashes take them."""
    return np.asarray(values, np.int64).astype(np.int32).astype('<i4').tobytes()


class Series:
    """Section 2.5."""

    def __init__(self, stream):
        self.stream, self.models = stream, integers()

    def read(self, frames):
        o = self.stream.unsigned(self.models['order'])
        need(o <= 2, 'ENTROPY', 'order of a series')
        c, x = 12, []
        for f in range(frames):
            p = 0 if o == 0 or f == 0 else x[f - 1] if o == 1 or f == 1 else 2 * x[f - 1] - x[f - 2]
            r = self.stream.signed(self.models['residual', c])
            x.append(p + r)
            need(abs(x[f]) < 2 ** 28, 'ENTROPY', 'value of a series')
            c = (c + min(abs(r).bit_length(), 12) + 1) // 2
        return x


def read_pose_chunk(data, corners):
    """A `POSE` chunk (06, section 6)."""
    r = Reader(data, 'RECORD')
    origin = [r.f64() for _ in range(3)]
    step = r.f64()
    need(all(math.isfinite(x) for x in origin) and math.isfinite(step) and step > 0, 'QUANTIZER', 'grid of a pose')
    return Record(origin=origin, step=step, p=read_pose(r.rest(), corners))


class Segment:
    """A segment, decoded: coded vertices, frames counted within it."""

    def __init__(self, container, limi, index, mesh, corners, mesh_pose):
        self.limits = s = limi.segments[index]
        self.mesh, self.corners, self.n, self.index = mesh, corners, mesh.coded, index
        where = (s.mesh, index)
        self.segm = records.read_segm(container.chunk('SEGM', *where))
        own, layers, corr, diff = (container.chunks(kind, *where) for kind in ('POSE', 'BASI', 'CORR', 'DIFF'))
        self.hashed, self.frames = [], s.frames
        if s.kind == 0:
            self._key_frames()
        else:
            self.pose = read_pose_chunk(own[0], corners) if own else mesh_pose
            self._basis(layers, records.runs_of(limi, s))
        self.corrections = {}
        if s.corrections:
            need(corr and corr[0], 'CHUNK_MISSING', 'CORR')
            self._corrections(corr[0])
        self.exact = None
        if s.exact:
            need(diff, 'CHUNK_MISSING', 'DIFF')
            d = read_diff(diff[0], s.frames, self.n)
            near = neighbours_of(self.n, mesh.triangles)
            self.exact, self.exact_hash = ExactPositions(d, s.frames, self.n, near).positions(), d.hash

    def compare_hashes(self):
        need(xxh64(b''.join(self.hashed)) == self.segm.hash, 'HASH', 'segment %d' % self.index)
        if self.exact is not None:
            bits = self.exact.view(np.int32).astype('<i4').tobytes()
            need(xxh64(bits) == self.exact_hash, 'HASH', 'DIFF %d' % self.index)

    # Section 2: key-frames.

    def _key_frames(self):
        s, segm = self.limits, self.segm
        r = Reader(segm.parameters)
        flags = r.u8()
        need(flags < 4, 'RECORD', 'flags')
        sum_to_one, rigid = flags & 1, flags >> 1
        origin, step, weight_bits = [r.f64() for _ in range(3)], r.f64(), r.u8()
        rotation_bits, translation_step = (r.u8(), r.f64()) if rigid else (0, 1.0)
        if s.reconstruction:
            need(r.u8() >= 1, 'RECORD', 'leaf_faces')
        frame = 0
        for j in range(s.components):
            frame += r.varint(s.frames - 1)
            need(frame < s.frames, 'RECORD', 'frame of a key-frame')
        parents = [r.varint(j) for j in range(s.components)]
        r.end()
        need(rigid or not segm.motion, 'RECORD', 'motion')
        need(all(math.isfinite(x) for x in origin + [step, translation_step]) and step > 0 and translation_step > 0
             and weight_bits <= 24 and rotation_bits <= 27, 'QUANTIZER', 'parameters')
        need(not s.reconstruction or sum_to_one, 'SEGMENT', 'sum_to_one')
        q = np.array(read_key_frames(segm.pose, self.corners, parents), np.int64)
        self.hashed.append(i32_bytes(q))
        stream = RangeDecoder(segm.weights)
        series = Series(stream)
        read = [series.read(s.frames) for _ in range(s.components - sum_to_one)]
        stream.end()
        self.hashed.append(i32_bytes(read))
        w = read
        if sum_to_one:
            w = [[signed32(2 ** weight_bits - sum(column)) for column in zip(*read)] if read
                 else [2 ** weight_bits] * s.frames] + read
        motion = None
        if rigid:
            stream = RangeDecoder(segm.motion)
            series = Series(stream)
            motion = [series.read(s.frames) for _ in range(7)]
            stream.end()
            self.hashed.append(i32_bytes(motion))
        need((np.abs(q[s.wide:] * 2 + 1) <= 65535).all(), 'QUANTIZER', 'key-frame of 16 bits')
        self.r = q                                   # [component, vertex, 3]
        self.u = step * np.array(w, np.float64) * 2.0 ** -weight_bits
        self.origin = np.array(origin)
        self.rotation, self.translation = np.broadcast_to(np.eye(3), (s.frames, 3, 3)), np.zeros((s.frames, 3))
        if rigid:
            self.translation = translation_step * np.array(motion[4:], np.float64).T
            self._rotations(motion[:4])
        need(max(np.abs(self.u).max(), np.abs(self.origin).max(), np.abs(self.translation).max()) <= BIG, 'NON_FINITE')

    def _rotations(self, quaternions):
        """Section 2.4."""
        x, y, z, w = np.array(quaternions, np.float64)
        n = x * x + y * y + z * z + w * w
        s = np.where(n > 0, 2 / np.where(n > 0, n, 1), 0)
        self.rotation = np.array([
            [1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)],
            [s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)],
            [s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)]]).transpose(2, 0, 1)

    # Section 3: eigenshapes and eigentrajectories.

    def _parameters(self, runs):
        s = self.limits
        r = Reader(self.segm.parameters)
        p = Record(flags=r.u8())
        need(p.flags < 16, 'RECORD', 'flags')
        p.affine, p.anew = bool(p.flags & 1), bool(p.flags & 4)
        p.basis_step, p.weight_step, p.neighbours, p.colours, p.radius, p.schedule = (
            r.f64(), r.f64(), r.u8(), r.u8(), r.u8(), r.u8())
        p.alike = r.u8() if p.flags & 8 else 0
        steps = (p.basis_step, p.weight_step)
        good = (all(math.isfinite(x) and x > 0 for x in steps) and p.neighbours in (8, 12, 16, 20, 24)
                and 1 <= p.colours <= 8 and p.radius >= 1 and p.schedule <= 2 and (p.alike or not p.flags & 8))
        need(good, 'QUANTIZER', 'parameters')
        p.run_steps = [r.u8() for _ in runs] if p.flags & 2 else [0] * len(runs)
        need(max(p.run_steps) <= 64, 'QUANTIZER', 'run_step')
        stream, models, j = RangeDecoder(r.rest()), integers(), s.components
        p.of_region = [j]
        if s.regions > 1:
            p.of_region = [j - stream.unsigned(models['fewer']) for _ in range(s.regions)]
            need(min(p.of_region) >= 0, 'QUANTIZER', 'components of a region')
        o, exponents = 128, [0] * s.regions
        p.omegas, p.sigmas = [], []
        for j in range(s.components):
            o += stream.signed(models['omega'])
            for k in range(s.regions):
                if p.of_region[k] > j:
                    exponents[k] += stream.signed(models['sigma'])
            need(0 <= o <= 255 and max(map(abs, exponents)) <= 8000, 'QUANTIZER', 'table')
            p.omegas.append(o)
            p.sigmas.append([2.0 ** (e / 8) for e in exponents])
        stream.end()
        return p

    def _basis(self, layers, runs):
        s, segm, n = self.limits, self.segm, self.n
        pose, p, count = self.pose, self._parameters(runs), s.components
        need(pose is not None, 'CHUNK_MISSING', 'POSE')
        need(not segm.motion and (s.regions > 1 or not segm.pose), 'RECORD', 'blocks that must be empty')
        need(not count or all(abs(x) <= 2 ** 21 for v in pose.p for x in v), 'QUANTIZER', 'coordinate of a pose')
        self.hashed.append(i32_bytes(pose.p))
        self.regions = np.zeros(n, np.int64)
        if s.regions > 1:
            regions = self._read_regions()
            self.regions = np.array(regions, np.int64)
            self.hashed.append(i32_bytes(regions))
        opened, left = [], count
        for data in layers:
            r = Reader(data)
            opened.append(Record(count=r.varint(left), weights=r.block(), coefficients=r.rest()))
            left -= opened[-1].count
        need(left == 0, 'CHUNK_MISSING', 'components')
        opened = [layer for layer in opened if layer.count]          # nothing is read of the others
        # Section 3.4: time weights.
        model, stream = TimeWeights(runs), RangeDecoder(segm.weights)
        base = [[model.component(stream, 3) for _ in range(s.regions)] for _ in range(4 if p.affine else 0)]
        stream.end()
        self.hashed += [i32_bytes(w) for component in base for w in component]
        weights = np.zeros((count, s.regions, s.rows, s.frames), np.int64)
        j = 0
        for i, layer in enumerate(opened):
            if p.anew and i:
                model = TimeWeights(runs)
            stream = RangeDecoder(layer.weights)
            for j in range(j, j + layer.count):
                for region in range(s.regions):
                    if p.of_region[region] > j:
                        w = model.component(stream, s.rows)
                        weights[j, region] = w
                        self.hashed.append(i32_bytes(w))
            j += 1
            stream.end()
        y = self._coefficients(opened, p) if count else np.zeros((0, n, s.channels), np.float32)
        self._residents(y, weights, base, p, runs)

    def _read_regions(self):
        """Section 3.6."""
        stream, models = RangeDecoder(self.segm.pose), Models(bit_model)
        graph, count = graph_of(self.n, self.mesh.triangles), self.limits.regions
        dense, regions = is_dense(graph), []
        for v in range(self.n):
            near = [] if dense else [w for w in graph[v] if w < v]
            if not near and v:
                near = [v - 1]
            c = [0] * count
            for w in near:
                c[regions[w]] += 1
            most = max(c)
            a = c.index(most)
            if not stream.bit(models['same', min(most, 3), min(len(near) - most, 3)]):
                others = [r for r in range(count) if r != a]
                a = next((r for r in others[:-1] if stream.bit(models['is', r, min(c[r], 1)])), others[-1])
            regions.append(a)
        stream.end()
        return regions

    def _coefficients(self, layers, p):
        """Section 3.5."""
        s, n, pose = self.limits, self.n, self.pose.p
        regions = self.regions.tolist() if s.regions > 1 else None
        order, levels, neighbours = decoding_order(pose, self.mesh.triangles, regions, p.colours, p.neighbours)
        residuals, j = np.zeros((s.components, n, s.channels), np.int64), 0
        model = None
        for layer in layers:
            if p.anew or model is None:
                model = Coefficients(levels, neighbours, s.channels)
            stream = Words(layer.coefficients)
            for _ in range(layer.count):
                q = residuals[j] = model.component(stream)
                need(j < s.wide or np.abs(2 * q + 1).max() <= 65535, 'ENTROPY', 'residual of 16 bits')
                j += 1
            stream.end()
        ranked = [pose[v] for v in order]
        y = reconstruct(ranked, levels, neighbours, residuals, p.omegas, p.neighbours, p.radius, p.schedule, p.alike)
        # Towards zero: a u between -2^23 and -2^22 is not rounded by the two operations of 09, section 6.
        blocks = np.trunc(64 * y.astype(np.float64)).astype(np.int64).transpose(1, 0, 2)
        for start in range(0, n, 1024):
            h = xxh64(i32_bytes(blocks[start:start + 1024]))
            self.hashed.append(h.to_bytes(8, 'little'))
        by_vertex = np.empty_like(y)
        by_vertex[:, order] = y
        return by_vertex

    def _residents(self, y, weights, base, p, runs):
        """Sections 3.3 and 5."""
        s, pose = self.limits, self.pose
        steps = np.repeat([p.weight_step * 2.0 ** (x / 8) for x in p.run_steps], runs)
        self.r = np.zeros(y.shape, np.int64)
        self.u = np.zeros((s.components, s.regions, s.rows, s.frames))
        for j in range(s.components):
            largest = float(np.abs(y[j]).max())
            shift = 6 if j < s.wide else next((b for b in range(6, -1, -1) if 2 ** b * largest <= 32767), None)
            need(shift is not None, 'QUANTIZER', 'coefficient of 16 bits')
            self.r[j] = np.rint(y[j].astype(np.float64) * 2 ** shift)
            for region in range(s.regions):
                scale = steps / p.sigmas[j][region] * p.basis_step / 2 ** shift
                self.u[j, region] = weights[j, region] / 16 * scale
        self.origin = np.array(pose.origin)
        grid = np.array(pose.p, np.float64)
        if not p.affine:
            self.base = None
            self.still = self.origin + pose.step * grid
            need(pose.step <= BIG, 'NON_FINITE', 'step of a pose')
        else:
            self.base = steps / 16 * np.array(base, np.float64)       # [function, region, axis, frame]
            self.phi = np.zeros((4, self.n))
            for region in range(s.regions):
                members = self.regions == region
                if members.any():
                    self.phi[:, members], k, mean = affine_functions(grid[members])
                    matrix = np.einsum('braf,bd->radf', self.base[1:], k)[region]
                    offset = self.base[0, region] / math.sqrt(members.sum()) - np.einsum('adf,d->af', matrix, mean)
                    need(np.abs(matrix).max() <= BIG and np.abs(offset + self.origin[:, None]).max() <= BIG,
                         'NON_FINITE', 'matrix of a base')
        need(np.abs(self.origin).max() <= BIG and np.abs(self.u).max(initial=0) <= BIG, 'NON_FINITE', 'weight')

    # Section 6: corrections.

    def _corrections(self, data):
        s, n, copies = self.limits, self.n, self.mesh.copies
        r = Reader(data)
        step = r.f64()
        need(math.isfinite(step) and step > 0, 'QUANTIZER', 'step of corrections')
        stream, models, delta = RangeDecoder(r.rest()), Models(bit_model), Models(bits)
        bit = stream.bit
        blocks, total, listed = -(-n // 16), 0, []
        a, was, had = 0, {}, [0] * blocks
        for f in range(s.frames):
            a = bit(models['any', a])
            if not a:
                was, had = {}, [0] * blocks
                continue
            t, left, beside, now, found = 0, 0, None, {}, []
            for block in range(blocks):
                t = had[block] = bit(models['block', t + 2 * had[block]])
                if not t:
                    left, beside = 0, None
                    continue
                for v in range(16 * block, min(16 * block + 16, n)):
                    before = was.get(v)
                    c = bit(models['vertex', left + (0 if before is None else 4)])
                    left = (2 * left + c) & 3
                    if c:
                        now[v] = [stream.signed(delta[axis, sign_of(before, axis), sign_of(beside, axis)])
                                  for axis in range(3)]
                        total += copies[v]
                        need(total <= s.corrections, 'ENTROPY', 'corrections')
                        found.append(v)
                        listed.append([f, v] + now[v])
                    beside = now[v] if c else None
            need(found, 'ENTROPY', 'frame without a correction')
            was = now
            self.corrections[f] = (found, step * np.array([now[v] for v in found], np.float64))
            need(np.abs(self.corrections[f][1]).max() <= BIG, 'NON_FINITE', 'correction')
        stream.end()
        need(total == s.corrections, 'ENTROPY', 'corrections')
        self.hashed.append(i32_bytes(listed))

    # Section 7: positions.

    def made(self, f):
        """What the segment makes of frame f: float64 [coded vertex, 3]."""
        s = self.limits
        if s.kind == 0:
            x = self.origin + np.tensordot(self.u[:, f], self.r.astype(np.float64), 1)
            x = x @ self.rotation[f].T + self.translation[f]
        else:
            x = self.still.copy() if self.base is None else np.broadcast_to(self.origin, (self.n, 3)).copy()
            for region in range(s.regions):
                members = slice(None) if s.regions == 1 else self.regions == region
                r, u = self.r[:, members].astype(np.float64), self.u[:, region, :, f]
                x[members] += (np.tensordot(r[:, :, 0], u, ([0], [0])) if s.kind == 2
                               else np.tensordot(u[:, 0], r, 1))
                if self.base is not None:
                    x[members] += self.phi[:, members].T @ self.base[:, region, :, f]
        if f in self.corrections:
            vertices, moves = self.corrections[f]
            x[vertices] += moves
        return x


    def tolerance(self, f):
        """Section 7: how far a coordinate of frame f may be from the formula; roughly, and no less."""
        if self.exact is not None:
            return 0.0
        s = self.limits
        if s.kind == 0:
            size = np.abs(self.origin) + np.tensordot(np.abs(self.u[:, f]), np.abs(self.r).astype(np.float64), 1)
            size = size @ np.abs(self.rotation[f]).T + np.abs(self.translation[f])
        else:
            r, u = np.abs(self.r).astype(np.float64), np.abs(self.u[..., f])[:, self.regions]
            size = np.einsum('jvc,jvr->vr' if s.kind == 2 else 'jvc,jvr->vc', r, u)
            if self.base is None:
                size += np.abs(self.still) + 2 * np.abs(self.origin)
            else:
                size += 8 * np.abs(self.phi).T @ np.abs(self.base[..., f]).max(1) + np.abs(self.origin)
        if f in self.corrections:
            size[self.corrections[f][0]] += np.abs(self.corrections[f][1])
        return (s.components + 16) * 2.0 ** -23 * size


def sign_of(d, axis):
    return 0 if d is None or d[axis] == 0 else 1 if d[axis] > 0 else 2


def affine_functions(p):
    """Section 3.3: the four functions of some vertices, with K and the mean of the pose."""
    n = len(p)
    mean = p.sum(0) / n
    c = p - mean
    g, k, lower = c.T @ c, np.zeros((3, 3)), np.zeros((3, 3))
    for a in range(3):
        for b in range(a):
            lower[a, b] = sum(k[b, d] * g[a, d] for d in range(b + 1))
        rest = g[a, a] - sum(lower[a, b] ** 2 for b in range(a))
        if not rest > 1e-9 * g[a, a]:
            continue
        k[a, a] = 1 / math.sqrt(rest)
        for d in range(a):
            k[a, d] = -k[a, a] * sum(lower[a, b] * k[b, d] for b in range(d, a))
    phi = np.empty((4, n))
    phi[0] = 1 / math.sqrt(n)
    phi[1:] = k @ c.T
    return phi, k, mean


class Root:
    """Chapter 06, section 11: the motion of the whole."""

    def __init__(self, data, limi, up):
        r = Reader(data)
        need(len(limi.clip_frames) <= len(data), 'RECORD', 'ROOT')
        self.a, self.b = (0, 1) if up == 2 else (2, 0)
        clips, frames, bad = [], 0, False
        for count in limi.clip_frames:
            c = Record(holds=r.u8(), pivot=(0.0, 0.0), step=0.0, turn_step=0.0, frames=count)
            need(c.holds < 4, 'RECORD', 'holds')
            if c.holds:
                frames += count
                c.pivot = (r.finite(error='QUANTIZER'), r.finite(error='QUANTIZER'))
            if c.holds & 1:
                c.step = r.finite(error='QUANTIZER')
                need(c.step > 0, 'QUANTIZER', 'step')
            if c.holds & 2:
                c.turn_step = r.finite(error='QUANTIZER')
                need(c.turn_step > 0, 'QUANTIZER', 'turn_step')
            clips.append(c)
        need(frames == limi.root_frames, 'RECORD', 'root_frames')
        stream = RangeDecoder(r.rest())
        moves, turns, self.frames = Series(stream), Series(stream), []
        largest = float(np.finfo(np.float32).max)
        for c in clips:
            a = b = t = [0] * c.frames
            if c.holds & 1:
                a = moves.read(c.frames)
                b = moves.read(c.frames)
            if c.holds & 2:
                t = turns.read(c.frames)
            for x, y, z in zip(a, b, t):
                line = (c.pivot, c.step * x, c.step * y, c.turn_step * z)
                bad = bad or not max(map(abs, line[1:] + (2 * c.pivot[0], 2 * c.pivot[1]))) <= largest
                self.frames.append(line if c.holds else None)
        stream.end()
        need(not bad, 'NON_FINITE', 'ROOT')

    def apply(self, x, frame):
        """Positions of a frame of the file, moved in place."""
        if self.frames[frame] is None:
            return
        (pa, pb), move_a, move_b, t = self.frames[frame]
        a, b = x[:, self.a] - pa, x[:, self.b] - pb
        x[:, self.a] = pa + move_a + math.cos(t) * a - math.sin(t) * b
        x[:, self.b] = pb + move_b + math.sin(t) * a + math.cos(t) * b
