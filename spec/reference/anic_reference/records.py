# SPDX-License-Identifier: CC0-1.0
"""Chapter 06: the records LIMI, CLIP, SEGM, BNDS and META, field by field."""
import json
import math
from types import SimpleNamespace as Record
from .common import AnicError, Reader, need

U24, U31, U32 = 2 ** 24 - 1, 2 ** 31 - 1, 2 ** 32 - 1


def optional_fields(r, known):
    """Optional fields at the end of a record (06, section 1): {tag: value}. `known` has the sizes of known tags."""
    fields, last = {}, 0
    while r.left():
        last = r.varint(U32, last + 1)
        value = r.block()
        need(last not in known or known[last] == len(value), 'RECORD', 'size of an optional field')
        fields[last] = value
    return fields


def read_limi(data, features):
    """Section 2."""
    r = Reader(data)
    clips, meshes, segments = r.varint(U24, 1), r.varint(65535, 1), r.varint(U24, 1)
    left = r.left()
    need(clips <= left and 6 * meshes <= left and 9 * segments <= left, 'RECORD', 'counts')
    limi = Record(clip_frames=[], meshes=[], segments=[], frames=0)
    for _ in range(clips):
        limi.clip_frames.append(r.varint(U24, 1))
        limi.frames += limi.clip_frames[-1]
        need(limi.frames <= U24, 'RECORD', 'frames')
    for _ in range(meshes):
        limi.meshes.append(_read_mesh(r))
    for _ in range(segments):
        limi.segments.append(_read_segment(r, limi))
    limi.root_frames = r.varint(limi.frames)
    fields = optional_fields(r, {1: 8})
    limi.mesh_hash = int.from_bytes(fields[1], 'little') if 1 in fields else None
    need(bool(features & 2) == any(s.draco for s in limi.segments), 'RECORD', 'feature 1')
    need(bool(features & 4) == any(s.reconstruction for s in limi.segments), 'RECORD', 'feature 2')
    need(bool(features & 8) == any(s.learns for s in limi.segments), 'RECORD', 'feature 3')
    end = {}
    for s in sorted(limi.segments, key=lambda s: s.first):
        what = (s.mesh, s.attribute, s.triple)
        need(s.first >= end.get(what, 0), 'RECORD', 'segments share a frame')
        end[what] = s.first + s.frames
    return limi


def _read_mesh(r):
    m = Record(source=r.varint(U31, 1))
    m.coded = r.varint(m.source, 1)
    m.triangles, m.polygons, m.corners, m.attributes = r.varint(U31), r.varint(U31), r.varint(U32), r.varint(256)
    m.labels = m.head = m.numbers = 0
    if m.attributes:
        m.labels, m.head, m.numbers = r.varint(U32), r.varint(U32), r.varint(2 ** 46)
        need(m.head >= 4 * m.attributes and m.head >= m.labels, 'RECORD', 'attribute_head')
    need(3 * m.triangles <= U32, 'RECORD', 'triangles')
    return m


def _read_segment(r, limi):
    s = Record(mesh=r.varint(len(limi.meshes) - 1))
    s.kind = r.u8()
    need(s.kind <= 2, 'FEATURE', 'kind of a segment')
    s.reconstruction = r.u8()
    need(s.reconstruction <= 1, 'FEATURE', 'reconstruction')
    flags = r.u8()
    need(flags < 32, 'FEATURE', 'flags of a segment')
    s.exact, s.has_regions, s.moves_attribute, s.draco, s.learns = (bool(flags >> i & 1) for i in range(5))
    need(not s.reconstruction or s.kind == 0, 'FEATURE', 'combination')
    need(flags & ~{0: 9, 1: 17, 2: 23}[s.kind] == 0 and (not s.moves_attribute or flags == 4), 'FEATURE', 'combination')
    s.first = r.varint(limi.frames - 1)
    s.frames = r.varint(limi.frames - s.first, 1)
    s.components = r.varint(2 ** 20)
    need(s.kind or s.components, 'SEGMENT', 'no key-frame')
    s.wide = r.varint(s.components)
    s.corrections = r.varint(U32)
    s.regions = r.varint(8, 2) if s.has_regions else 1
    s.attribute = s.triple = s.domain = s.entries = None
    if s.moves_attribute:
        m = limi.meshes[s.mesh]
        s.attribute, s.triple, s.domain = r.varint(m.attributes - 1), r.varint(5), r.u8()
        need(s.domain <= 2, 'FEATURE', 'domain')
        s.elements = (m.source, m.corners, m.polygons)[s.domain]
        s.entries = r.varint(s.elements, 1)
    s.draco_bytes = s.draco_points = 0
    if s.draco:
        s.draco_bytes, s.draco_points = r.varint(U32, 1), r.varint(U32, 1)
    s.channels = 1 if s.kind == 2 else 3             # numbers of a coefficient
    s.rows = 1 if s.kind == 1 else 3                 # rows of a time weight
    return s


def runs_of(limi, s):
    """Frames of a segment, cut where a clip ends (08, section 6): lengths of the runs."""
    runs, start = [], 0
    for frames in limi.clip_frames:
        n = min(start + frames, s.first + s.frames) - max(start, s.first)
        if n > 0:
            runs.append(n)
        start += frames
    return runs


def read_clip(data, limi):
    """Section 3."""
    r = Reader(data)
    clip = Record(encoder=r.text(), up=r.u8(), order=r.u8())
    need(clip.up <= 2 and clip.order <= 2, 'RECORD', 'up or order')
    clip.metres_per_unit = r.finite(0, 'f32')
    need(61 * len(limi.clip_frames) <= r.left(), 'RECORD', 'clips')
    clip.clips = [_read_one_clip(r, frames) for frames in limi.clip_frames]
    origin = Reader(optional_fields(r, {1: 24}).get(1, bytes(24)))
    clip.origin = [origin.finite() for _ in range(3)]
    return clip


def _read_one_clip(r, frames):
    c = Record(frames=frames, name=r.text(), rate=(r.varint(U32, 1), r.varint(U32, 1)), flags=r.u8())
    need(c.flags < 128, 'RECORD', 'flags of a clip')
    c.start_time = r.finite()
    c.times = None
    if c.flags & 16:
        need(8 * frames <= r.left(), 'RECORD', 'times')
        c.times = [r.finite() for _ in range(frames)]
        need(all(a <= b for a, b in zip(c.times, c.times[1:])), 'RECORD', 'times descend')
    c.asked = r.u8()
    need(c.asked <= 7, 'RECORD', 'asked')
    c.asked_value = r.f64()
    need(c.asked == 0 or math.isfinite(c.asked_value) and c.asked_value >= 0, 'RECORD', 'asked_value')
    c.max_error, c.rmse, c.kg, c.max_displacement_error, c.diagonal = (r.finite(0) for _ in range(5))
    if c.flags & 8:
        c.surface_error, c.surface_error_mean = r.finite(0), r.finite(0)
    c.errors, c.events = [], []
    if c.flags & 32:
        for _ in range(r.varint(_share(r, 18), 1)):
            c.errors.append((r.varint(65534), r.varint(255), r.finite(0), r.finite(0)))
            need(len(c.errors) < 2 or c.errors[-2][:2] < c.errors[-1][:2], 'RECORD', 'errors of attributes')
    if c.flags & 64:
        for _ in range(r.varint(_share(r, 9), 1)):
            c.events.append((r.text(), r.finite(0)))
            need(len(c.events) < 2 or c.events[-2][1] <= c.events[-1][1], 'RECORD', 'events descend')
    return c


def _share(r, size):
    """The most that a count may be whose items have `size` bytes at least, of the bytes that follow it."""
    ahead = Reader(r.data)
    ahead.at = r.at
    ahead.varint()
    return ahead.left() // size


def read_segm(data):
    """Section 7."""
    r = Reader(data)
    segm = Record(hash=r.u64(), parameters=r.block(), pose=r.block(), motion=r.block(), weights=r.block())
    need(1 not in optional_fields(r, {1: 8}), 'RECORD', 'a segment that continues another, and does not learn')
    return segm


def read_bnds(data, frames):
    """Section 13."""
    r = Reader(data)
    b = Record(every=r.varint(frames))
    b.low = [r.finite(form='f32') for _ in range(3)]
    b.high = [r.finite(low, 'f32') for low in b.low]
    count = -(-frames // b.every) if b.every else 0
    data = r.take(6 * count)
    b.boxes = [data[6 * i:6 * i + 6] for i in range(count)]
    optional_fields(r, {})
    return b


def read_meta(data):
    """Section 14: sizes, depth, UTF-8 and that it is a JSON object."""
    need(1 <= len(data) <= 2 ** 20, 'RECORD', 'size of META')
    try:
        text = data.decode('utf-8')
    except UnicodeDecodeError as error:
        raise AnicError('RECORD', 'META is not UTF-8') from error
    depth, inside, escaped = 0, False, False
    for c in text:
        if inside:
            inside = escaped or c != '"'
            escaped = c == '\\' and not escaped
        elif c == '"':
            inside = True
        elif c in '[{':
            depth += 1
            need(depth <= 32, 'RECORD', 'META is too deep')
        elif c in ']}':
            depth -= 1

    def refuse(name):
        raise ValueError(name)
    try:
        value = json.loads(text, parse_constant=refuse, parse_int=str, parse_float=str)
    except (ValueError, RecursionError) as error:
        raise AnicError('RECORD', 'META is no JSON') from error
    need(isinstance(value, dict), 'RECORD', 'META is no object')
    return value
