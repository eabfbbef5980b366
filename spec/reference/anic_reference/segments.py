# SPDX-License-Identifier: CC0-1.0
"""Chapter 09a: segments, from parameters to positions."""
import numpy as np
from .chunks import BASI, CORR, DIFF, EXACT, KEY_FRAMES, POSE, REGIONS, SEGM
from .conventions import (Reader, array, check, finite, int32, positive, quantizer, read_record, read_whole,
                          within, xxh64)
from .entropy import Bit, RangeDecoder, StateDecoder, integers, defaultdict
from .exact import read_exact
from .pose import read_poses
from .reconstruction import decoding_order, is_dense, linked, reconstruct
from .weights import Coefficients, TimeWeights

FARTHEST, BLOCK, HASHED = 2.0**64, 16, 1024             # vertices that are corrected, and hashed, together
SUM_TO_ONE, RIGID, AFFINE, RUN_STEPS, ANEW, ALIKE = 1, 2, 1, 2, 4, 8    # flags of kind 0, of kinds 1 and 2
hashed = lambda values: np.asarray(values).astype("<i4").tobytes()
fits = lambda values: np.all(np.abs(np.asarray(values) + 0.5) < 2**15)  # 16 bits

class Series:  # Section 2.5: integers that change smoothly. The models are those of all series of a stream
    def __init__(self, decoder):
        self.decoder, self.order, self.residual = decoder, defaultdict(Bit), integers()
    def read(self, frames):
        order, x, c = self.decoder.unsigned(self.order), [], 12
        check(order <= 2, "ENTROPY", "the order of a series")
        for f in range(frames):
            r, degree = self.decoder.signed(self.residual[c]), min(order, f)
            x.append(r + (0 if degree == 0 else x[-1] if degree == 1 else 2 * x[-1] - x[-2]))
            check(abs(x[-1]) < 2**28, "ENTROPY", "a value of a series")
            c = (c + min(abs(r).bit_length(), 12) + 1) // 2
        return x

def all_series(data, many, frames):                     # A stream of so many series
    series = Series(RangeDecoder(data))
    values = [series.read(frames) for _ in range(many)]
    return series.decoder.end(np.array(values, np.int64).reshape(many, frames))

def check_far(*values):
    for value in values:
        check(np.all(np.abs(value) <= FARTHEST), "NON_FINITE",
              "a weight, an entry of a matrix or a coordinate")

KEY_PARAMETERS = (
    ("flags", "u8", within(0, 3)), quantizer("origin", "f64[3]", finite), quantizer("step", "f64", positive),
    quantizer("weight_bits", "u8", within(0, 24)),
    (lambda r: r.flags & RIGID, quantizer("rotation_bits", "u8", within(0, 27)),
     quantizer("translation_step", "f64", positive)),
    ("frame", array("varint", lambda r: r.components), lambda v, r: sum(v) < r.frames),
    ("parent", lambda reader, r: [reader.varint(j) for j in range(r.components)]))
PARAMETERS = (
    ("flags", "u8", within(0, 15)), quantizer("basis_step weight_step", "f64", positive),
    quantizer("neighbours", "u8", lambda v, r: v in (8, 12, 16, 20, 24)),
    quantizer("colours", "u8", within(1, 8)), quantizer("radius", "u8", within(1, 255)),
    quantizer("schedule", "u8", within(0, 2)),
    (lambda r: r.flags & ALIKE, quantizer("alike", "u8", within(1, 255))))

def key_frame_segment(segment, record, mesh):
    """Section 2: positions, [frame, vertex, axis], and the parts of what is hashed."""
    p = read_whole(record.parameters, KEY_PARAMETERS, components=segment.components, frames=segment.frames)
    q, sums = read_poses(record.pose, mesh.table, p.parent), p.flags & SUM_TO_ONE
    told = all_series(record.weights, segment.components - sums, segment.frames)
    first = [[int32((1 << p.weight_bits) - int(others)) for others in told.sum(0)]] if sums else told[:0]
    check(fits(q[segment.wide_components:]), "QUANTIZER", "a key-frame of more than 16 bits")
    weights, parts = p.step * np.concatenate([first, told]) * 2.0**-p.weight_bits, [hashed(q), hashed(told)]
    check_far(weights, p.origin)
    positions = np.array(p.origin) + np.einsum("jf,jva->fva", weights, q.astype(float))
    if p.flags & RIGID:
        motion = all_series(record.motion, 7, segment.frames)
        turns = np.array([rotation(*turn) for turn in motion[:4].T.tolist()])
        moves = p.translation_step * motion[4:].T
        check_far(moves)
        positions = np.einsum("fab,fvb->fva", turns, positions) + moves[:, None]
        parts.append(hashed(motion))
    check(p.flags & RIGID or not record.motion, "RECORD", "motions that are not asked for")
    return positions, parts

def rotation(x, y, z, w):  # Section 2.4: the matrix of a quaternion of any length
    norm = x * x + y * y + z * z + w * w
    s = 2 / norm if norm else 0
    return [[1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)],
            [s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)],
            [s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)]]

def read_parameters(data, segment, runs):
    """Section 3.1, the table included. `components`, and each of `sigma`, are of the regions."""
    reader, many = Reader(data), segment.components
    p = read_record(reader, PARAMETERS)
    p.run_steps = list(reader.bytes(len(runs))) if p.flags & RUN_STEPS else [0] * len(runs)
    check(max(p.run_steps) <= 64, "QUANTIZER", "a step of a run")
    decoder, models = RangeDecoder(reader.field("rest")), integers()
    fewer = [decoder.unsigned(models["fewer"]) if segment.regions > 1 else 0 for _ in range(segment.regions)]
    p.components, p.omega, p.sigma, o, s = [many - n for n in fewer], [], [], 128, [0] * segment.regions
    for j in range(many):
        o += decoder.signed(models["omega"])
        s = [old + (decoder.signed(models["sigma"]) if own > j else 0) for old, own in zip(s, p.components)]
        p.omega.append(o)
        p.sigma.append(s)
    decoder.end()
    right = min(p.components) >= 0 and all(0 <= o <= 255 for o in p.omega)
    check(right and all(abs(s) <= 8000 for each in p.sigma for s in each), "QUANTIZER", "in the table")
    return p

def read_regions(data, segment, triangles):             # Section 3.6: the region of each vertex
    decoder, bits, graph, of = RangeDecoder(data), defaultdict(Bit), linked(segment.vertices, triangles), []
    dense = is_dense(graph)
    for v in range(segment.vertices):
        near = [w for w in graph[v] if w < v and not dense] or [v - 1] * (v > 0)
        counts = [sum(of[w] == r for w in near) for r in range(segment.regions)]
        r = counts.index(max(counts))
        if not decoder.bit(bits["same", min(counts[r], 3), min(len(near) - counts[r], 3)]):
            *others, last = [other for other in range(segment.regions) if other != r]
            r = next((r for r in others if decoder.bit(bits["is", r, min(counts[r], 1)])), last)
        of.append(r)
    return decoder.end(of)

def affine_functions(pose):  # Section 3.3: phi_0, the mean and the matrix K of the vertices of a region
    count, k = len(pose), np.zeros((3, 3))
    if count == 0:
        return 0.0, np.zeros(3), k
    mean = pose.sum(0) / count
    g = (pose - mean).T @ (pose - mean)
    for a in range(3):
        lower = k[:a] @ g[a]
        rest = g[a, a] - lower @ lower
        if rest > 1e-9 * g[a, a]:
            k[a, a] = 1 / np.sqrt(rest)
            k[a, :a] = -k[a, a] * (lower @ k[:a, :a])
    return 1 / np.sqrt(count), mean, k

def linear_segment(segment, record, mesh, payloads, grid, runs):
    """Section 3: positions, [frame, vertex, axis], and the parts of what is hashed. `grid`: the pose."""
    many, frames, triangles, layers = segment.components, segment.frames, mesh.triangles, []
    p, left, regions = read_parameters(record.parameters, segment, runs), many, [0] * segment.vertices
    check(grid, "CHUNK_MISSING", "POSE")
    pose = grid.integers
    if segment.moves_attribute:
        pose, triangles = mesh.surface_of(segment.attribute, pose)
    check(not record.motion, "RECORD", "motions of shapes")
    check(segment.flags & REGIONS or not record.pose, "RECORD", "regions that are not announced")
    check(many == 0 or np.all(np.abs(pose) <= 2**21), "QUANTIZER", "a coordinate of the pose")
    for data in payloads:
        layers.append(read_whole(data, BASI, left=left))
        left -= layers[-1].count
    check(left == 0, "CHUNK_MISSING", "components")
    layers, parts = [layer for layer in layers if layer.count], [hashed(pose)]
    if segment.flags & REGIONS:
        regions = read_regions(record.pose, segment, triangles)
        parts.append(hashed(regions))
    def read_weights(data, many, rows, first):
        """[function or component][region][row, frame]; of functions of the base, j is below 0."""
        decoder, found = RangeDecoder(data), []
        for j in range(first, first + many):
            found.append([model.component(decoder, rows) if own > j else None for own in p.components])
            parts.extend(hashed(values) for values in found[-1] if values)
        return decoder.end(found)
    model, weights, y = TimeWeights(runs), [], np.zeros((0, segment.channels, segment.vertices))
    base = read_weights(record.weights, 4 if p.flags & AFFINE else 0, 3, -4)
    for layer in layers:
        model = TimeWeights(runs) if p.flags & ANEW and weights else model
        weights += read_weights(layer.weights, layer.count, segment.rows, len(weights))
    if many:
        order = decoding_order(pose, triangles, regions, p.neighbours, p.colours)
        residuals = read_residuals(segment, layers, order, p.flags & ANEW)
        coefficients = reconstruct(residuals, pose[order.vertex], order, p)
        y = np.empty(coefficients.shape)
        for start in range(0, segment.vertices, HASHED):
            block = np.trunc(64 * coefficients[:, :, start:start + HASHED].astype(float)).transpose(2, 0, 1)
            parts.append(xxh64(hashed(block)).to_bytes(8, "little"))
        y[:, :, order.vertex] = coefficients
    # resident integers (section 5) and positions
    shifts = [next((b for b in range(6, -1, -1) if j < segment.wide_components or 2**b * most <= 32767), None)
              for j, most in enumerate(np.abs(y).max((1, 2), initial=0))]
    check(None not in shifts, "QUANTIZER", "a coefficient of more than 16 bits")
    steps = p.weight_step * np.repeat(2.0 ** (np.array(p.run_steps) / 8), runs) / 16
    positions, regions, pose = np.empty((frames, segment.vertices, 3)), np.array(regions), pose.astype(float)
    for r, own in enumerate(p.components):
        there, matrix, origin = regions == r, grid.step * np.eye(3)[None], np.array(grid.origin)[None]
        if p.flags & AFFINE:
            phi, mean, k = affine_functions(pose[there])
            w = np.array([function[r] for function in base]) * steps            # function, axis, frame
            matrix = np.einsum("baf,bd->fad", w[1:], k)
            origin = origin + (w[0] * phi).T - matrix @ mean
        check_far(matrix, origin)
        positions[:, there] = origin[:, None] + np.einsum("fad,vd->fva", matrix, pose[there])
        for j, shift in enumerate(shifts[:own]):
            u = np.array(weights[j][r]) * steps * (2.0 ** (-p.sigma[j][r] / 8) * p.basis_step / 2.0**shift)
            check_far(u)
            positions[:, there] += u.T[:, None] * np.rint(2.0**shift * y[j][:, there]).T
    return positions, parts

def read_residuals(segment, layers, order, anew):       # Section 4: the residuals of all components, by rank
    model, residuals = Coefficients(order, segment.channels), []
    for layer in layers:
        model = Coefficients(order, segment.channels) if anew else model
        decoder = StateDecoder(layer.coefficients)
        for _ in range(layer.count):
            residuals.append(model.component(decoder))
            narrow = len(residuals) > segment.wide_components
            check(not narrow or fits(residuals[-1]), "ENTROPY", "a residual of more than 16 bits")
        decoder.end()
    return residuals

def read_corrections(data, segment, copies):
    """Section 6: frame, vertex and three numbers of each. `copies`: how many each vertex counts for."""
    decoder, bits, delta, found, count = RangeDecoder(data), defaultdict(Bit), integers(), [], 0
    none, some, was, had = (0, 0, 0), 0, {}, {}
    signs = lambda number: (number > 0) + 2 * (number < 0)
    for f in range(segment.frames):
        some = decoder.bit(bits["any", some])
        before, had_before, was, had, t, left, beside = was, had, {}, {}, 0, 0, none
        for start in range(0, segment.vertices if some else 0, BLOCK):
            t = had[start] = decoder.bit(bits["block", t + 2 * had_before.get(start, 0)])
            left, beside = (left, beside) if t else (0, none)
            for v in range(start, min(start + BLOCK, segment.vertices) if t else start):
                c = decoder.bit(bits["vertex", left + (4 if v in before else 0)])
                left, contexts, beside = (2 * left + c) & 3, zip(range(3), before.get(v, none), beside), none
                if c:
                    beside = tuple(decoder.signed(delta[axis, signs(d), signs(e)]) for axis, d, e in contexts)
                    was[v], count = beside, count + copies[v]
                    found.append((f, v) + beside)
                    check(count <= segment.corrections, "ENTROPY", "more corrections than announced")
        check(was or not some, "ENTROPY", "a frame without the corrections that it announces")
    decoder.end()
    check(count == segment.corrections, "ENTROPY", "fewer corrections than announced")
    return np.array(found)

def read_pose(data, mesh):                              # The record of a POSE, with its integers
    pose = read_whole(data, POSE)
    pose.integers = read_poses(pose.stream, mesh.table)[0]
    return pose

def read_segment(segment, mesh, chunks, runs):
    """Positions, [frame, vertex, axis]; exact ones or None; hashes as stated and as decoded."""
    segm, poses, layers, corr, diff = (chunks.payloads(kind, segment.mesh, segment.number) for kind in
                                       ("SEGM", "POSE", "BASI", "CORR", "DIFF"))
    record, exact, own_pose = read_whole(segm[0], SEGM), None, [read_pose(data, mesh) for data in poses]
    if segment.kind == KEY_FRAMES:
        positions, parts = key_frame_segment(segment, record, mesh)
    else:
        positions, parts = linear_segment(segment, record, mesh, layers, (own_pose + [mesh.pose])[0], runs)
    if segment.corrections:
        check(corr[0], "CHUNK_MISSING", "CORR")
        corrections = read_whole(corr[0], CORR)
        found = read_corrections(corrections.stream, segment, mesh.copies(segment))
        check_far(corrections.step * np.abs(found).max())
        positions[found[:, 0], found[:, 1]] += corrections.step * found[:, 2:]
        parts.append(hashed(found))
    hashes = [(record.hash, xxh64(b"".join(parts)))]
    if segment.flags & EXACT:
        record = read_whole(diff[0], DIFF, positions=segment.frames * segment.vertices)
        exact, found = read_exact(record, segment.vertices, segment.frames, mesh.triangles)
        hashes.append((record.hash, found))
    return positions, exact, hashes
