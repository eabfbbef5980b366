# SPDX-License-Identifier: CC0-1.0
"""Chapter 06: the registry of chunks, and their records field by field; the limits of 11, section 2."""
import itertools
import json
import math
import re
import struct
from .container import COPIED, OF_MESH, OF_SEGMENT, REQUIRED
from .conventions import (Reader, Refused, array, ascend, check, finite, not_negative, positive, quantizer,
                          read_record, within)

KEY_FRAMES, SHAPES, TRAJECTORIES = 0, 1, 2              # kinds of basis
EXACT, REGIONS, ATTRIBUTE, DRACO, LEARNS = 1, 2, 4, 8, 16         # flags of a segment
FREE, ALL, MATERIAL, OBJECT = 1, 2, 5, 6                # orders, kinds of attributes
U24, U31, U32 = 2**24 - 1, 2**31 - 1, 2**32 - 1

flag = lambda bit: lambda r: r.flags >> bit & 1

def counted(share):  # A count of records of at least so many bytes, of which there is one
    def read(reader, _):
        count = reader.varint()
        check(1 <= count <= reader.left() // share, "RECORD", f"{count} records")
        return count
    return read

def read_optional(reader, _):                           # Optional fields: values by tag
    values, before = {}, 0
    while reader.left():
        tag = reader.varint(U32)
        check(tag > before, "RECORD", "tags do not ascend")
        values[tag], before = reader.field("block"), tag
    return values

def origin_of(fields):                                  # Field 1 of CLIP; None where it is malformed
    value = fields.get(1, bytes(24))
    origin = struct.unpack("<3d", value) if len(value) == 24 else (math.nan,)
    return list(origin) if finite(origin) else None

# How many vertices, corners or polygons there are
elements = lambda mesh, domain: (mesh.source_vertices, mesh.corners, mesh.polygons)[domain]

# Section 2, LIMI, and the limits of chapter 11

MESH_COUNTS = (
    ("source_vertices", "varint", within(1, U31)),
    ("coded_vertices", "varint", lambda v, r: 1 <= v <= r.source_vertices),
    ("triangles", "varint", within(0, U32 // 3)), ("polygons", "varint", within(0, U31)),
    ("corners", "varint", within(0, U32)), ("attributes", "varint", within(0, 256)),
    (lambda r: r.attributes, ("attribute_labels", "varint", within(0, U32)),
     ("attribute_head", "varint", lambda v, r: max(4 * r.attributes, r.attribute_labels) <= v <= U32),
     ("attribute_numbers", "varint", within(0, 2**46))))

def combination(flags, r):                              # Whether kind, reconstruction and flags go together
    allowed = {KEY_FRAMES: EXACT | DRACO, SHAPES: EXACT | LEARNS,
               TRAJECTORIES: EXACT | REGIONS | LEARNS}[r.kind]
    return (not flags & ~allowed or flags == ATTRIBUTE and r.kind == TRAJECTORIES) and \
        (r.reconstruction == 0 or r.kind == KEY_FRAMES)

SEGMENT = (
    ("mesh", "varint", lambda v, r: v < len(r.meshes)),
    ("kind", "u8", within(0, 2), "FEATURE"), ("reconstruction", "u8", within(0, 1), "FEATURE"),
    ("flags", "u8", combination, "FEATURE"), ("first_frame", "varint", lambda v, r: v < r.file_frames),
    ("frames", "varint", lambda v, r: 1 <= v <= r.file_frames - r.first_frame),
    ("components", "varint", within(0, 2**20)), ("wide_components", "varint", lambda v, r: v <= r.components),
    ("corrections", "varint", within(0, U32)),
    (lambda r: r.flags & REGIONS, ("regions", "varint", within(2, 8))),
    (lambda r: r.flags & ATTRIBUTE, ("attribute", "varint", lambda v, r: v < r.meshes[r.mesh].attributes),
     ("triple", "varint", within(0, 5)), ("domain", "u8", within(0, 2), "FEATURE"),
     ("entries", "varint", lambda v, r: 1 <= v <= elements(r.meshes[r.mesh], r.domain))),
    (lambda r: r.flags & DRACO, ("draco_bytes draco_points", "varint", within(1, U32))))

def read_counts(reader, _):
    counts, left = [reader.varint() for _ in range(3)], reader.left()
    fits = all(1 <= n <= most for n, most in zip(counts,
            (min(U24, left), min(65535, left // 6), min(U24, left // 9))))
    check(fits, "RECORD", "how many clips, meshes or segments there are")
    return counts

LIMI = (("counts", read_counts),
        ("clip_frames", array("varint", lambda r: r.counts[0]), lambda v, r: min(v) >= 1 and sum(v) <= U24),
        ("meshes", array(MESH_COUNTS, lambda r: r.counts[1])),
        ("segments", array(SEGMENT, lambda r: r.counts[2], meshes=lambda r: r.meshes,
                           file_frames=lambda r: sum(r.clip_frames))),
        ("root_frames", "varint", lambda v, r: v <= sum(r.clip_frames)),
        ("optional", read_optional, lambda v, r: len(v.get(1, bytes(8))) == 8))

def read_limi(data, file):
    limi, ends = read_record(Reader(data), LIMI), {}
    for number, s in enumerate(limi.segments):
        check(s.kind != KEY_FRAMES or s.components, "SEGMENT", "no key-frame")
        check(not s.flags & (DRACO | LEARNS) and not s.reconstruction, "RECORD", "a feature that is not announced")
        s.number, s.regions, s.moves_attribute = number, s.regions or 1, bool(s.flags & ATTRIBUTE)
        s.rows, s.channels = (3, 1) if s.kind == TRAJECTORIES else (1, 3)
        s.vertices = s.entries if s.moves_attribute else s.meshes[s.mesh].coded_vertices
    for s in sorted(limi.segments, key=lambda s: s.first_frame):
        moved = s.mesh, s.attribute, s.triple
        check(ends.get(moved, 0) <= s.first_frame, "RECORD", "two segments share a frame")
        ends[moved] = s.first_frame + s.frames
    if file.follows is not None:                        # a continuation
        check(1 in limi.optional, "RECORD", "a continuation that does not say what it continues")
        check(int.from_bytes(limi.optional[1], "little") == file.follows, "MESHES")
    return limi

def check_limits(limi, size):                           # Limits that no sensible file of that size has
    decisions, most = 0, 256 * size + 2**24
    for mesh in limi.meshes:
        counts, numbers = [elements(mesh, domain) for domain in range(3)], mesh.attribute_numbers or 0
        check(max(counts + [mesh.triangles]) <= size << 16, "LIMIT", "a mesh")
        attributes = 16 * mesh.corners + 256 * numbers + 4096 * mesh.attributes
        check(mesh.corners * mesh.attributes <= attributes, "LIMIT", "attributes")
    for s in limi.segments:
        coefficients = s.vertices * s.components * s.channels
        weights = s.frames * s.regions * (s.components + 4) * s.rows
        check(max(coefficients, 4 * weights) <= size << 22, "LIMIT", "components")
        check(not s.flags & EXACT or s.frames * s.vertices <= size << 16, "LIMIT", "exact positions")
        decisions += min(s.frames, s.corrections) * -(-s.vertices // 16)
        most += 16 * (coefficients + weights)
    check(decisions <= most, "LIMIT", "corrections")

# Section 3, CLIP

ATTRIBUTE_ERROR = (("mesh", "varint", within(0, 65534)), ("attribute", "varint", within(0, 255)),
                   ("max_error rmse", "f64", not_negative))
EVENT = (("name", "text"), ("seconds", "f64", not_negative))
CLIP = (
    ("name", "text"), ("rate_numerator rate_denominator", "varint", within(1, U32)),
    ("flags", "u8", within(0, 127)),
    ("start_time", "f64", finite),
    (flag(4), ("times", array("f64", lambda r: r.frames), lambda v, r: finite(v) and ascend(v))),
    ("asked", "u8", within(0, 7)),
    ("asked_value max_error rmse kg max_displacement_error diagonal", "f64", not_negative),
    (flag(3), ("surface_error surface_error_mean", "f64", not_negative)),
    (flag(5), ("error_count", counted(18)),
     ("attribute_errors", array(ATTRIBUTE_ERROR, lambda r: r.error_count),
                                             lambda v, r: ascend([(e.mesh, e.attribute) for e in v], True))),
    (flag(6), ("event_count", counted(9)), ("events", array(EVENT, lambda r: r.event_count),
                                            lambda v, r: ascend([event.seconds for event in v]))))

def read_clips(reader, r):
    check(61 * len(r.clip_frames) <= reader.left(), "RECORD", "too short for its clips")
    return [read_record(reader, CLIP, frames=frames) for frames in r.clip_frames]

CLIPS = (("encoder", "text"), ("up order", "u8", within(0, 2)), ("metres_per_unit", "f32", not_negative),
         ("clips", read_clips), ("optional", read_optional, lambda v, r: origin_of(v) is not None))

# Sections 4, 6 to 9, 12 and 13

MESH = (("name", "text"), ("faces", "rest"))
POSE = (quantizer("origin", "f64[3]", finite), quantizer("step", "f64", positive), ("stream", "rest"))
SEGM = (("hash", "u64"), ("parameters pose motion weights", "block"),
        ("optional", read_optional, lambda v, r: 1 not in v))    # 1: what it continues, if it learns
BASI = (("count", "varint", lambda v, r: v <= r.left), ("weights", "block"), ("coefficients", "rest"))
CORR = (quantizer("step", "f64", positive), ("stream", "rest"))
LATTICE = (quantizer("origin", "f64", finite), quantizer("step", "f64", positive), ("first", "i32"),
           ("count", "varint", lambda v, r: 1 <= v <= (r.positions if r.errs else U31)))

def read_lattices(reader, r):                           # One for each axis, None where there is none
    return [read_record(reader, LATTICE, positions=r.positions, errs=r.axes >> 3 + axis & 1)
            if r.axes >> axis & 1 else None for axis in range(3)]

DIFF = (("axes", "u8", lambda v, r: v < 64 and not v >> 3 & ~v), ("hash", "u64"),
        quantizer("noise", "f64", positive), ("lattices", read_lattices), ("stream", "rest"))
BNDS = (("every", "varint", lambda v, r: v <= r.frames), ("low", "f32[3]", finite),
        ("high", "f32[3]", lambda v, r: finite(v) and all(a <= b for a, b in zip(r.low, v))),
        ("boxes", array("u8[6]", lambda r: -(-r.frames // r.every) if r.every else 0)),
        ("optional", read_optional))

# Section 10, ATTR

LOOK = (("flags", "u8", lambda v, r: v < 12 and (v & 1 or v == 0)),
        (flag(0), ("base_colour", "f32[4]", not_negative), ("metallic roughness", "f32", not_negative),
         ("emissive", "f32[3]", not_negative),
         (lambda r: r.flags >> 2 == 1, ("alpha_cutoff", "f32", not_negative)),
         ("textures", "u8", within(0, 31)),
         ("images", array("text", lambda r: bin(r.textures).count("1")), lambda v, r: all(v))))
GRID = (quantizer("origin", "f64", finite), quantizer("scale", "f64", positive))

is_labelled = lambda r: r.kind in (MATERIAL, OBJECT)

def read_labels(reader, r):
    count = reader.varint()
    check(count <= min(reader.left(), r.labels_left), "RECORD", f"{count} labels")
    return [reader.field("text") for _ in range(count)]

ATTRIBUTE_RECORD = (
    ("kind", "u8", within(0, 6), "FEATURE"), ("domain", "u8", within(0, 2), "FEATURE"),
    ("name", "text", lambda v, r: r.domain == 2 or not is_labelled(r)),
    (is_labelled, ("labels", read_labels),
     (lambda r: r.kind == MATERIAL, ("has_looks", "u8", lambda v, r: v == 0 or v == 1 and r.labels),
      (lambda r: r.has_looks, ("looks", array(LOOK, lambda r: len(r.labels)))))),
    (lambda r: not is_labelled(r), ("components", "varint", lambda v, r: v <= 16 and (v or r.domain == 1)),
     ("grids", array(GRID, lambda r: r.components))))

def read_attribute_records(data, mesh):  # The attributes that LIMI announces, and the stream behind them
    reader, attributes, labels, numbers = Reader(data), [], 0, 0
    for _ in range(mesh.attributes):
        record = read_record(reader, ATTRIBUTE_RECORD, labels_left=mesh.attribute_labels - labels)
        attributes.append(record)
        labels += len(record.labels or [])
        numbers += elements(mesh, record.domain) * max(1, record.components or 0)
    announced = mesh.attribute_labels, mesh.attribute_numbers, mesh.attribute_head
    check((labels, numbers, reader.position) == announced, "RECORD", "other attributes than announced")
    return attributes, reader.field("rest")

# Sections 11 and 14, ROOT and META

ROOT = (("holds", "u8", within(0, 3)), (lambda r: r.holds, quantizer("pivot", "f64[2]", finite)),
        (lambda r: r.holds & 1, quantizer("step", "f64", positive)),
        (lambda r: r.holds & 2, quantizer("turn_step", "f64", positive)))
ROOTS = (("clips", array(ROOT, lambda r: len(r.clip_frames)),
          lambda v, r: sum(n for root, n in zip(v, r.clip_frames) if root.holds) == r.root_frames),
          ("stream", "rest"))

def refuse(text):
    raise ValueError(text)

def read_metadata(data):
    check(1 <= len(data) <= 2**20, "RECORD", "the size of the metadata")
    try:
        text = data.decode("utf-8")
        brackets = re.findall(r"[\[\]{}]", re.sub(r'"(\\.|[^"\\])*"', "", text, flags=re.S))
        depths = itertools.accumulate(1 if bracket in "[{" else -1 for bracket in brackets)
        check(max(depths, default=0) <= 32, "RECORD", "metadata too deep")
        value = json.loads(text, parse_constant=refuse, parse_int=float)
    except ValueError as error:
        raise Refused("RECORD", f"metadata: {error}") from error
    check(isinstance(value, dict), "RECORD", "metadata that are no object")
    return value

# Section 1: flags of each type; a POSE may be of a segment, too

TYPES = {"LIMI": REQUIRED, "CLIP": REQUIRED, "ROOT": REQUIRED, "META": COPIED, "ATTR": OF_MESH,
    "BNDS": COPIED | OF_MESH | OF_SEGMENT, **dict.fromkeys(("MESH", "VMAP", "FMAP", "POSE"),
    REQUIRED | OF_MESH), **dict.fromkeys(("SEGM", "BASI", "CORR", "DIFF"), REQUIRED | OF_MESH | OF_SEGMENT)}

class Chunks:                                           # The chunks of a file by type, mesh and segment
    def __init__(self, file):
        self.all, self.found = file.chunks, {}
        for chunk in (chunk for chunk in file.chunks if chunk.type in TYPES):
            self.found.setdefault((chunk.type, chunk.mesh, chunk.segment), []).append(chunk)
    # The payloads of all chunks of a type, mesh and segment
    payloads = lambda self, *key: [chunk.payload() for chunk in self.found.get((key + (None, None))[:3], [])]
    def payload(self, *key):                            # The one of a chunk that must be there
        check((key + (None, None))[:3] in self.found, "CHUNK_MISSING", key[0])
        return self.payloads(*key)[0]
    def check_places(self, limi, order):
        """Refuses chunks that do not belong where they are; then what is missing."""
        needed = {("CLIP", None, None): True, ("ROOT", None, None): limi.root_frames}
        allowed = {("LIMI", None, None): True, ("META", None, None): True}
        for m, mesh in enumerate(limi.meshes):
            needed.update({("MESH", m, None): True, ("ATTR", m, None): mesh.attributes,
                           ("VMAP", m, None): order != FREE, ("FMAP", m, None): order == ALL})
            allowed["POSE", m, None] = True
        for s in limi.segments:
            key, layered = (s.mesh, s.number), s.kind != KEY_FRAMES
            needed.update({("SEGM",) + key: True, ("CORR",) + key: s.corrections,
                           ("DIFF",) + key: s.flags & EXACT})
            allowed.update({("BASI",) + key: layered, ("BNDS",) + key: not s.moves_attribute,
                            ("POSE",) + key: layered and not s.moves_attribute})
        for key, chunks in self.found.items():
            flags = TYPES[key[0]] | (0 if key[2] is None else OF_SEGMENT)
            right = (needed.get(key) or allowed.get(key)) and all(chunk.flags == flags for chunk in chunks)
            check(right, "INDEX_RANGE", f"{key[0]} does not belong where it is")
        for key, there in needed.items():
            check(not there or key in self.found, "CHUNK_MISSING", key[0])
