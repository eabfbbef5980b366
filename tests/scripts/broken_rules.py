# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Invalid files, one for each rule of the specification that a record, or the list of chunks, can break."""
import json
import re
import struct
import subprocess

import anic_file

NONE, NO_MESH = 0xFFFFFFFF, 0xFFFF


def f64(x):
    return struct.pack("<d", x)


def varint(x):
    return anic_file.varints([x])


varints = anic_file.varints


def varint_value(data):
    return sum((byte & 127) << 7 * i for i, byte in enumerate(data))


INFINITE, NAN = f64(float("inf")), f64(float("nan"))


class File:
    """A good file whose fields and chunks are changed, all checksums made right."""

    def __init__(self, command, path):
        self.data = path.read_bytes()
        self.name = path.name
        self.fields = {}
        starts = [(entry[5], i) for i, entry in enumerate(anic_file.entries(self.data))]
        for row in subprocess.run([command, "dump", "--json", path], check=True, capture_output=True, text=True).stdout.splitlines():
            field = json.loads(row)
            at, size, label = field["offset"], field["size"], field["name"]
            chunk = max(((start, i) for start, i in starts if start <= at), default=None)
            if chunk:
                self.fields.setdefault(label, []).append((chunk[1], at - chunk[0], size))

    def chunks(self):
        return anic_file.read_chunks(self.data)

    def of(self, chunks):
        """A file of these chunks that needs the same features."""
        return anic_file.write_chunks(chunks, needs=anic_file.features(self.data))

    def needing(self, features):
        """The file with other feature bits."""
        return anic_file.write_chunks(self.chunks(), needs=features)

    def field(self, label, number=0):
        """Bytes of a field; `number`: which of several of that name."""
        chunk, at, size = self.fields[label][number]
        return self.chunks()[chunk].payload[at:at + size]

    def put(self, label, new, number=0):
        """The file with other bytes in a field. `new` may be a function of the present ones."""
        chunk, at, size = self.fields[label][number]
        chunks = self.chunks()
        payload = chunks[chunk].payload
        value = new(payload[at:at + size]) if callable(new) else new
        chunks[chunk].payload = payload[:at] + value + payload[at + size:]
        return self.of(chunks)

    def put_two(self, earlier, later):
        """The file with two fields of one chunk changed."""
        first, second = ((label, *self.fields[label][0], new) for label, new in (earlier, later))
        chunks = self.chunks()
        payload = chunks[first[1]].payload
        for _, _, at, size, new in (second, first):
            value = new(payload[at:at + size]) if callable(new) else new
            payload = payload[:at] + value + payload[at + size:]
        chunks[first[1]].payload = payload
        return self.of(chunks)

    def grown(self, label, change=lambda old: old + b"\1"):
        """The file with another block of SEGM; its length stands before it."""
        chunk, at, size = self.fields[label + " length"][0]
        chunks = self.chunks()
        payload = chunks[chunk].payload
        blocks = self.fields.get(label)
        end = at + size + (blocks[0][2] if blocks else 0)
        block = change(payload[at + size:end])
        chunks[chunk].payload = payload[:at] + varint(len(block)) + block + payload[end:]
        return self.of(chunks)

    def end(self, kind, more=b"", less=0):
        """The file with more, or fewer, bytes at the end of the first chunk of a type."""
        chunks = self.chunks()
        chunk = next(c for c in chunks if c.type == kind)
        chunk.payload = chunk.payload[:len(chunk.payload) - less] + more
        return self.of(chunks)

    def without(self, kind):
        """The file without the last chunk of a type."""
        chunks = self.chunks()
        chunks.remove([c for c in chunks if c.type == kind][-1])
        return self.of(chunks)

    def twice(self, kind):
        """The file with a chunk of a type once more."""
        chunks = self.chunks()
        return self.of(chunks + [next(c for c in chunks if c.type == kind)])

    def with_chunks(self, *more):
        """The file with chunks more."""
        return self.of(self.chunks() + list(more))

    @staticmethod
    def told(text=b"{}"):
        """Metadata."""
        return anic_file.Chunk("META", anic_file.COPIED, NO_MESH, NONE, text)

    def more(self, kind, mesh=NO_MESH, segment=NONE, payload=b"\0"):
        """The file with a chunk that does not belong into it."""
        return self.of(self.chunks() + [anic_file.Chunk(kind, 1, mesh, segment, payload)])


def set_byte(at, value):
    return lambda old: old[:at] + bytes([value]) + old[at + 1:]


def set_bytes(at, value):
    return lambda old: old[:at] + value + old[at + len(value):]


def chunk_rules(files):
    """(status, name, file, what) for spec/06, section 1."""
    triangle, corrected, painted, moved = (files(name) for name in ("triangle", "quad_box_corrected", "painted_box", "heated"))
    for file, kinds in ((triangle, ("CLIP", "MESH", "SEGM")), (corrected, ("VMAP", "POSE", "BASI", "CORR")),
                        (painted, ("FMAP", "ATTR"))):
        for kind in kinds:
            yield 26, f"no_{kind.lower()}", file.without(kind), f"no {kind}, or one layer less"
            if kind != "BASI":
                yield 25, f"two_{kind.lower()}", file.twice(kind), f"two {kind} of the same mesh and segment"
    yield 25, "two_limi", triangle.twice("LIMI"), "two LIMI"
    yield 44, "vmap_of_free_order", triangle.more("VMAP", 0), "VMAP although the order is free"
    yield 44, "fmap_of_vertices", corrected.more("FMAP", 0), "FMAP although the order is that of vertices"
    yield 44, "mesh_beyond", triangle.more("MESH", 1), "MESH of a mesh that LIMI does not have"
    yield 44, "pose_of_attribute", moved.more("POSE", 0, 1), "POSE of a segment of an attribute"
    yield 44, "mesh_of_segment", triangle.more("MESH", 0, 0), "MESH with a segment"
    yield 44, "segm_beyond", triangle.more("SEGM", 0, 1), "SEGM of a segment that LIMI does not have"
    yield 44, "pose_of_keyframes", triangle.more("POSE", 0, 0), "POSE of a segment of key-frames"
    yield 44, "basi_of_keyframes", triangle.more("BASI", 0, 0), "BASI of a segment of key-frames"
    yield 44, "corr_not_announced", triangle.more("CORR", 0, 0), "CORR although LIMI says no corrections"
    yield 44, "attr_not_announced", triangle.more("ATTR", 0), "ATTR although LIMI says no attributes"
    chunks = moved.chunks()
    next(c for c in chunks if c.type == "SEGM").mesh = 1
    yield 44, "segm_of_other_mesh", anic_file.write_chunks(chunks), "SEGM of a segment with another mesh"
    for file, kind, what in ((triangle, "MESH", "clear"), (painted, "ATTR", "set")):
        chunks = file.chunks()
        next(c for c in chunks if c.type == kind).flags ^= 1
        yield 44, f"required_{kind.lower()}", anic_file.write_chunks(chunks), f"{kind} with the flag required {what}"
    chunks = triangle.chunks()
    chunks[1].flags |= anic_file.COPIED
    yield 44, "copied_clip", anic_file.write_chunks(chunks), "CLIP with the flag *copied*"
    for kind, place in (("META", (NO_MESH, NONE)), ("BNDS", (0, 0))):
        name = kind.lower()
        if kind == "META":
            yield 25, "two_meta", triangle.with_chunks(triangle.told(), triangle.told()), "two META"
        else:
            yield 25, "two_bnds", triangle.twice(kind), "two BNDS of one segment"
        for what, flags, where in (("required", anic_file.REQUIRED | anic_file.COPIED, place), ("not_copied", 0, place),
                                   ("place", anic_file.COPIED, (0, NONE))):
            chunk = triangle.told() if kind == "META" else next(c for c in triangle.chunks() if c.type == kind)
            chunk.flags, (chunk.mesh, chunk.segment) = flags, where
            yield 44, f"{what}_{name}", triangle.of([c for c in triangle.chunks() if c.type != kind] + [chunk]), \
                f"{kind} {'of a mesh' if what == 'place' else 'with the flags ' + format(flags, 'd')}"
    chunk = next(c for c in moved.chunks() if c.type == "BNDS")
    chunk.segment = next(i for i in range(9) if f"LIMI segment {i} attribute" in moved.fields)
    yield 44, "attribute_bnds", moved.with_chunks(chunk), "BNDS of a segment that moves an attribute"
    chunks = triangle.chunks()
    chunks[1].flags |= 16
    yield 21, "reserved_flag", anic_file.write_chunks(chunks), "a reserved flag of a chunk is set"
    chunks = triangle.chunks()
    table = b"".join(map(anic_file.entry, chunks))
    yield 21, "table_rest", anic_file.write_table(chunks, table + b"\0"), "a byte behind the last entry of the table"
    yield 21, "table_short", anic_file.write_table(chunks, table[:-1]), "a table that ends inside an entry"
    long_size = anic_file.entry(chunks[-1], 0)[:-1] + bytes([len(chunks[-1].payload) | 0x80, 0])
    yield 21, "table_varint", anic_file.write_table(chunks, b"".join(map(anic_file.entry, chunks[:-1])) + long_size), \
        "a size that is not in its shortest form"
    chunks[-1].mesh = 0x10000
    yield 21, "table_mesh", anic_file.write_chunks(chunks), "a mesh beyond 2^16"
    count = struct.unpack_from("<I", triangle.data, 12)[0]
    yield 21, "table_count", anic_file.checked_header(triangle.data[:12] + struct.pack("<I", count + 1000) + triangle.data[16:]), \
        "more chunks than the table has room for"
    yield 21, "table_beyond", triangle.data[:36] + struct.pack("<I", 1 << 20) + triangle.data[40:], \
        "a table of more bytes than the file has"
    chunks = triangle.chunks()
    table = b"".join(map(anic_file.entry, chunks[:-1])) + anic_file.entry(chunks[-1], (1 << 64) - 1)
    yield 23, "chunk_beyond", anic_file.write_table(chunks, table), "a chunk of 2^64 - 1 bytes"


def told_rules(files):
    """The same for optional fields, section 1, BNDS and META, sections 13 and 14."""
    triangle, boxes = files("triangle"), files("boxes_and_metadata")
    good = anic_file.field(5, b"value")
    for kind in ("LIMI", "CLIP", "SEGM", "BNDS"):
        for what, bytes_, text in (("zero", anic_file.field(0, b""), "the tag 0"), ("twice", good + good, "one tag twice"),
                                   ("falls", good + anic_file.field(4, b""), "tags that do not ascend"),
                                   ("beyond", b"\5\2x", "a value that goes beyond the record"),
                                   ("large", varint(1 << 32) + b"\0", "a tag of 2^32"), ("tag_alone", b"\5", "a tag and no more")):
            yield 40, f"{kind.lower()}_field_{what}", boxes.end(kind, bytes_), f"{kind} with {text}"
    yield 40, "limi_hash_short", triangle.end("LIMI", anic_file.field(1, bytes(7))), "a mesh hash of 7 bytes"
    yield 40, "limi_hash_long", triangle.end("LIMI", anic_file.field(1, bytes(9))), "a mesh hash of 9 bytes"
    place = struct.pack("<3d", 1, 2, 3)
    for name, value, what in (("short", place[:23], "of 23 bytes"), ("long", place + b"\0", "of 25 bytes"), ("empty", b"", "of no bytes"),
                              ("nan", place[:16] + struct.pack("<d", float("nan")), "that is not a number"),
                              ("infinite", struct.pack("<d", float("-inf")) + place[8:], "that is not finite")):
        yield 40, f"clip_origin_{name}", triangle.end("CLIP", anic_file.field(1, value)), f"an origin {what}"
    for name, label, value in (("every", "frames of a box", b"\x09"), ("low", "low y", struct.pack("<f", float("nan"))),
                               ("high", "high z", struct.pack("<f", float("inf"))), ("turned", "high x", struct.pack("<f", -1e30))):
        yield 40, f"bnds_{name}", boxes.put(f"BNDS {label}", value), f"BNDS {label} that is out of range"
    yield 40, "bnds_short", boxes.end("BNDS", less=1), "BNDS with half a box"
    for name, text, what in (("empty", b"", "no byte"), ("deep", b'{"":' + b"[" * 32 + b"]" * 32 + b"}", "33 arrays and objects in one another"),
                             ("utf8", b'{"title":"\xc0\x80"}', "a character that is not in its shortest form"),
                             ("long", b'{"title":"\xf0\x8f\xbf\xbf"}', "four bytes where three do"),
                             ("surrogate", b'{"title":"\xed\xa0\x80"}', "a surrogate"), ("cut", b'{"title":"\xe4\xb8"}', "half a character")):
        yield 40, f"meta_{name}", triangle.with_chunks(triangle.told(text)), f"META of {what}"


def limit_rules(files):
    """The same for LIMI, section 2."""
    triangle, corrected, scene, moved, clips, shapes, draco, msgi, learning = (
        files(name) for name in ("triangle", "quad_box_corrected", "scene", "heated", "clips", "polygons_all",
                                 "nonmanifold_keyframes", "nonmanifold_interpolated", "learning"))
    yield 40, "limi_clip_frames", clips.put("LIMI clip 1 frames", b"\0"), "a clip without a frame"
    yield 40, "limi_clips_frames", clips.put("LIMI clip 1 frames", varint((1 << 24) - 1)), \
        "clips of more than 2^24 - 1 frames together"
    for name, label, value, status in (
            ("frames", "clip 0 frames", 0, 40), ("clips", "clips", 0, 40), ("many_clips", "clips", 2000, 40),
            ("meshes", "meshes", 0, 40), ("segments", "segments", 0, 40),
            ("many_meshes", "meshes", 65536, 40), ("many_segments", "segments", 3000, 40),
            ("many_frames", "clip 0 frames", 1 << 24, 40), ("source_vertices", "mesh 0 source vertices", 0, 40),
            ("coded_vertices", "mesh 0 coded vertices", 0, 40), ("more_coded", "mesh 0 coded vertices", 4, 40),
            ("triangles", "mesh 0 triangles", (1 << 32) // 3 + 1, 40), ("segment_mesh", "segment 0 mesh", 1, 40),
            ("first_frame", "segment 0 first frame", 5, 40), ("segment_frames", "segment 0 frames", 0, 40),
            ("past_the_end", "segment 0 frames", 6, 40), ("components", "segment 0 components", (1 << 20) + 1, 40),
            ("wide", "segment 0 wide components", 3, 40), ("basis", "segment 0 basis", 3, 12),
            ("reconstruction", "segment 0 reconstruction", 2, 12), ("segment_flags", "segment 0 flags", 16, 12),
            ("attributes", "mesh 0 attributes", 257, 40)):
        yield status, f"limi_{name}", triangle.put(f"LIMI {label}", varint(value)), f"LIMI {label} {value}"
    yield 48, "limi_no_keyframe", triangle.put("LIMI segment 0 components", b"\0"), "key-frames without a key-frame"
    yield 40, "limi_points", draco.put("LIMI segment 0 Draco points", b"\0"), "bytes of Draco without points"
    yield 40, "limi_draco_bytes", draco.put("LIMI segment 0 Draco bytes", b"\0"), "Draco without bytes"
    yield 12, "limi_draco_of_shapes", shapes.put("LIMI segment 0 flags", b"\x08"), "eigenshapes by Draco"
    yield 12, "limi_shapes_interpolated", shapes.put("LIMI segment 0 reconstruction", b"\1"), "eigenshapes by geometry interpolation"
    yield 12, "limi_attribute_learns", moved.put("LIMI segment 1 flags", b"\x14"), "an attribute that learns"
    for name, file, bit in (("draco", draco, 2), ("msgi", msgi, 4), ("learning", learning, 8)):
        yield 40, f"{name}_not_announced", file.needing(0), f"the feature bit of {name} is clear, and LIMI uses it"
        yield 40, f"{name}_not_used", triangle.needing(bit), f"the feature bit of {name} is set, and LIMI does not use it"
    yield 12, "first_feature", triangle.needing(16), "the first feature bit that is not assigned"
    of_attribute = "LIMI segment 1 "
    yield 12, "limi_domain", moved.put(of_attribute + "domain", b"\3"), "a domain that does not exist"
    yield 40, "limi_no_entries", moved.put(of_attribute + "entries", b"\0"), "an attribute without an entry"
    yield 40, "limi_many_entries", moved.put(of_attribute + "entries", varint(1 << 14)), "more entries than vertices"
    yield 44, "limi_other_domain", moved.put(of_attribute + "domain", b"\1"), "an attribute of vertices moved as one of corners"
    yield 44, "limi_fewer_entries", moved.put(of_attribute + "entries", b"\7"), "fewer entries than the attribute has"
    yield 40, "limi_shared_frame", scene.put("LIMI segment 2 first frame", scene.field("LIMI segment 1 first frame")), \
        "two segments of a mesh share frames"
    for label in ("labels", "bytes before the values", "numbers"):
        for file in (moved, files("painted_box")):
            yield 40, f"limi_{label.split()[0]}_{file.name.split('.')[0]}", \
                file.put(f"LIMI mesh 0 {label}", lambda old: varint(varint_value(old) + 1)), f"LIMI {label} that are not those of the attributes"
    yield 40, "limi_attribute_head", triangle.put("LIMI mesh 0 attributes", varints((2, 0, 7, 2))), \
        "two attributes in seven bytes"
    yield 40, "limi_more", triangle.end("LIMI", b"\0"), "a byte after the last field"
    yield 40, "limi_short", triangle.end("LIMI", less=1), "LIMI that ends early"
    yield 40, "limi_long_varint", triangle.put("LIMI clip 0 frames", b"\x85\0"), "a varint that is not the shortest"
    cut = files("regions")
    yield 40, "limi_one_region", cut.put("LIMI segment 0 regions", b"\1"), "regions of which there is one"
    yield 40, "limi_many_regions", cut.put("LIMI segment 0 regions", b"\x09"), "nine regions"
    yield 12, "limi_regions_of_shapes", cut.put("LIMI segment 0 basis", b"\1"), "eigenshapes in regions"
    yield 12, "limi_regions_of_attribute", cut.put("LIMI segment 0 flags", b"\6"), "an attribute in regions"
    moving = [label.removesuffix(" attribute") for label in moved.fields if re.fullmatch("LIMI segment \\d+ attribute", label)]
    first, second = moving[:2]
    for name, basis in (("keyframes", 0), ("shapes", 1)):
        yield 12, f"attribute_{name}", moved.put(f"{first} basis", bytes([basis])), f"an attribute by {name}"
    yield 40, "attribute_number", moved.put(f"{first} attribute", varint(256)), "a segment of attribute 256"
    yield 40, "attribute_unknown", moved.put(f"{first} attribute", moved.field("LIMI mesh 0 attributes")), \
        "a segment of one attribute more than there are"
    yield 44, "attribute_component", moved.put(f"{first} three components", b"\5"), "a segment of components 15 to 17"
    yield 40, "attribute_twice", moved.put_two(*((f"{second} {field}", moved.field(f"{first} {field}")) for field in
                                                 ("attribute", "three components"))), "two segments of one attribute share frames"
    yield 41, "limi_fewer_corrections", corrected.put("LIMI segment 0 corrections", lambda old: varint(1)), \
        "more corrections than announced"


def clip_rules(files):
    """The same for CLIP, section 3."""
    triangle, timed, moved, special, clips = (
        files(name) for name in ("triangle", "uneven_times", "heated", "vertex_order", "clips"))
    yield 40, "clip_of_many_rate", clips.put("CLIP clip 5 rate numerator", b"\0"), "the last of several clips has no rate"
    yield 40, "clip_of_many_time", clips.put("CLIP clip 2 time of frame 3", NAN), "a time of a clip that is not a number"
    for name, label, value in (
            ("rate", "rate numerator", b"\0"), ("rate_denominator", "rate denominator", b"\0"), ("flags", "flags", b"\x80"),
            ("up", "up axis", b"\3"), ("order", "order", b"\3"), ("start", "start time", INFINITE),
            ("metres", "metres per unit", struct.pack("<f", -1)), ("asked", "asked", b"\x08"),
            ("asked_value", "asked value", NAN), ("max_error", "max error", f64(-1)), ("rmse", "RMSE", INFINITE),
            ("kg", "KG", NAN), ("displacement", "max displacement error", f64(-1)), ("diagonal", "diagonal", f64(-1))):
        yield 40, f"clip_{name}", triangle.put(f"CLIP {label}", value), f"CLIP {label} that is out of range"
    yield 40, "clip_name", triangle.put("CLIP name", lambda old: b"\xff\x7f" + old[1:]), "a name longer than the record"
    yield 40, "clip_more", triangle.end("CLIP", b"\0"), "a byte after the last field"
    yield 40, "clip_short", triangle.end("CLIP", less=1), "CLIP that ends early"
    yield 40, "clip_times_fall", timed.put("CLIP time of frame 3", f64(0.01)), "a time before that of the frame before"
    yield 40, "clip_time", timed.put("CLIP time of frame 3", NAN), "a time that is not a number"
    yield 40, "clip_errors", moved.put("CLIP error 1 attribute", b"\0"), "two errors of one attribute"
    yield 40, "clip_attribute_error", moved.put("CLIP error 1 RMSE", NAN), "an error that is not a number"
    yield 40, "clip_no_errors", moved.put("CLIP attributes with an error", b"\0"), "a list of no errors"
    yield 40, "clip_surface_error", special.put("CLIP surface error", f64(-1)), "a surface error below 0"


def root_rules(files):
    """The same for ROOT and events, sections 2, 3 and 11."""
    walk, triangle = files("walk"), files("triangle")
    yield 40, "clip_event_time", walk.put("CLIP clip 0 event 1 time", NAN), "a time of an event that is not a number"
    yield 40, "clip_event_falls", walk.put("CLIP clip 0 event 1 time", f64(0.05)), "an event before the one before it"
    yield 40, "clip_event_below", walk.put("CLIP clip 0 event 0 time", f64(-1)), "an event before the clip"
    yield 40, "clip_no_events", walk.put("CLIP clip 0 events", b"\0"), "a list of no events"
    yield 40, "clip_many_events", walk.put("CLIP clip 0 events", b"\x7f"), "more events than bytes"
    yield 40, "limi_root_frames", walk.put("LIMI frames with root motion", b"\x0f"), "root frames that are not those of the clips"
    yield 44, "limi_no_root_frames", walk.put("LIMI frames with root motion", b"\0"), "ROOT although LIMI says no root frames"
    yield 40, "limi_many_root_frames", walk.put("LIMI frames with root motion", b"\x7f"), "more root frames than frames"
    yield 26, "root_missing", walk.without("ROOT"), "root frames without ROOT"
    yield 25, "root_twice", walk.twice("ROOT"), "ROOT twice"
    yield 44, "root_of_none", triangle.more("ROOT"), "ROOT without root frames"
    yield 44, "root_of_mesh", walk.more("ROOT", mesh=0), "ROOT of a mesh"
    yield 40, "root_holds", walk.put("ROOT clip 0 holds", b"\4"), "ROOT that holds what does not exist"
    yield 40, "root_holds_nothing", walk.put("ROOT clip 0 holds", b"\0"), "a clip that holds nothing of its root frames"
    yield 45, "root_pivot", walk.put("ROOT clip 0 pivot b", INFINITE), "a pivot that is infinite"
    yield 45, "root_step", walk.put("ROOT clip 0 step", f64(0)), "a step of 0"
    yield 45, "root_turn_step", walk.put("ROOT clip 0 turn step", NAN), "a step of turns that is not a number"
    yield 46, "root_far", walk.put("ROOT clip 0 step", f64(1e300)), "moves that are infinite in binary32"
    yield 46, "root_pivot_far", walk.put("ROOT clip 0 pivot a", f64(3e38)), "a pivot whose double is infinite in binary32"
    yield 41, "root_more", walk.end("ROOT", b"\1"), "bytes after the series"


def exact_rules(files):
    """The same for DIFF, section 12."""
    exact, triangle = files("exact"), files("triangle")
    yield 12, "limi_exact_attribute", exact.put("LIMI segment 0 flags", b"\5"), "exact positions of an attribute"
    yield 44, "diff_not_announced", triangle.more("DIFF", 0, 0), "DIFF although LIMI says no exact positions"
    yield 26, "diff_missing", exact.without("DIFF"), "exact positions without DIFF"
    yield 25, "diff_twice", exact.twice("DIFF"), "DIFF twice"
    yield 49, "diff_hash", exact.put("DIFF hash of the positions", bytes(8)), "positions of another hash"
    for name, label, value, status in (
            ("axes", "lattices of axes", b"\x40", 40), ("errs", "lattices of axes", b"\x10", 40), ("noise", "variance of errors", f64(0), 45),
            ("noise_no_number", "variance of errors", NAN, 45), ("origin", "lattice x origin", INFINITE, 45),
            ("step", "lattice x step", f64(0), 45), ("points", "lattice x points", b"\0", 40),
            ("many_points", "lattice x points", varint((1 << 31) - 1), 40)):
        yield status, f"diff_{name}", exact.put(f"DIFF {label}", value), f"DIFF {label} that is out of range"
    yield 41, "diff_more", exact.end("DIFF", b"\1"), "bytes after the positions"
    yield 41, "diff_short", exact.end("DIFF", less=20), "positions that end early"
    data = exact.chunks()
    next(c for c in data if c.type == "DIFF").payload = b"\0"
    yield 40, "diff_short_record", anic_file.write_chunks(data), "DIFF that ends inside its record"


def mesh_rules(files):
    """The same for MESH, VMAP, FMAP, POSE and ATTR, sections 4 to 6 and 10."""
    triangle, corrected, painted, moved, polygons = (
        files(name) for name in ("triangle", "quad_box_corrected", "painted_box", "heated", "polygons_all"))
    yield 40, "mesh_name", triangle.put("MESH name", b"\x7f"), "a name longer than the record"
    yield 43, "faces_triangles", triangle.put("LIMI mesh 0 triangles", b"\2"), "fewer triangles than announced"
    yield 43, "faces_polygons", triangle.put("LIMI mesh 0 polygons", b"\2"), "fewer polygons than announced"
    yield 43, "faces_corners", triangle.put("LIMI mesh 0 corners", b"\2"), "more corners than announced"
    yield 43, "faces_repeated", files("leftovers").put("LIMI mesh 0 corners", lambda old: varint(varint_value(old) - 3)), \
        "more repeated faces than there are corners for"
    wild = files("wild_pose").chunks()
    poses = [c for c in wild if c.type == "POSE"]
    poses[1].payload = poses[0].payload
    yield 45, "pose_far", anic_file.write_chunks(wild), "a pose beyond 2^21 under coefficients"
    yield 41, "faces_more", triangle.end("MESH", b"\1"), "bytes that no encoder writes after the faces"
    yield 41, "faces_zero", triangle.end("MESH", b"\0"), "a zero byte after the faces, which no encoder writes"
    yield 41, "vmap_more", corrected.end("VMAP", b"\1"), "bytes after the order of the vertices"
    yield 41, "fmap_more", polygons.end("FMAP", b"\1"), "bytes after the order of the polygons"
    for name, label, value in (("origin", "origin y", NAN), ("step", "step", f64(0)), ("step_below", "step", f64(-1)),
                               ("step_infinite", "step", INFINITE)):
        yield 45, f"pose_{name}", corrected.put(f"POSE {label}", value), f"POSE {label} that is out of range"
    yield 41, "pose_more", corrected.end("POSE", b"\1"), "bytes after the pose"
    yield 41, "pose_short", corrected.end("POSE", less=20), "a pose that ends early"
    yield 12, "attr_kind", painted.put("ATTR attribute 0 kind", b"\7"), "a kind of attribute that does not exist"
    yield 12, "attr_domain", painted.put("ATTR attribute 0 domain", b"\3"), "a domain that does not exist"
    yield 40, "attr_kind_of_domain", painted.put("ATTR attribute 0 kind", b"\5"), "a material of each corner"
    yield 40, "attr_components", painted.put("ATTR attribute 0 components", b"\x11"), "17 components"
    yield 40, "attr_no_components", moved.put("ATTR attribute 0 components", b"\0"), "vertices without components"
    yield 45, "attr_origin", painted.put("ATTR attribute 0 origin 0", NAN), "an origin that is not a number"
    yield 45, "attr_scale", painted.put("ATTR attribute 0 scale 0", f64(0)), "a scale of 0"
    yield 40, "attr_name", painted.put("ATTR attribute 0 name", lambda old: b"\xff\x7f" + old[1:]), "a name longer than the record"
    look = "ATTR look 0"
    yield 40, "attr_looks", painted.put("ATTR attribute 3 looks", b"\2"), "looks that are neither there nor not"
    yield 40, "look_flags", painted.put(f"{look} flags", b"\x17"), "a reserved flag of a material"
    yield 40, "look_alpha", painted.put(f"{look} flags", b"\x0f"), "an alpha that does not exist"
    yield 40, "look_unknown", painted.put("ATTR look 1 flags", b"\2"), "flags of an unknown material"
    yield 40, "look_number", painted.put(f"{look} roughness", struct.pack("<f", -1)), "a roughness below 0"
    yield 40, "look_not_finite", painted.put(f"{look} red", struct.pack("<f", float("nan"))), "a colour that is not a number"
    yield 40, "look_textures", painted.put(f"{look} textures", b"\x25"), "an image for a purpose that does not exist"
    yield 40, "look_image", painted.put(f"{look} base_colour", b"\0"), "an image without a name"
    yield 40, "attr_more_labels", painted.put("ATTR attribute 3 labels", b"\x7f"), "more names than LIMI announces"
    yield 41, "attr_more", painted.end("ATTR", b"\1"), "bytes after the values"


def segment_rules(files):
    """The same for SEGM, BASI and CORR, sections 7 to 9, and the parameters of spec/09a."""
    triangle, far, corrected, shapes, msgi = (
        files(name) for name in ("triangle", "far_rigid", "quad_box_corrected", "polygons_all", "nonmanifold_interpolated"))
    yield 40, "segm_more", triangle.end("SEGM", b"\0"), "a byte after the last block"
    yield 40, "segm_short", triangle.end("SEGM", less=1), "a block longer than the record"
    learning, identity = files("learning"), bytes(range(8))
    for name, file, status, value, what in (
            ("not_announced", corrected, 40, identity, "a segment that continues another, and does not learn"),
            ("short", learning, 40, identity[1:], "7 bytes for what a segment continues"),
            ("none", learning, 40, bytes(8), "a segment that continues 0"),
            ("nothing", learning, 51, identity, "a first segment that continues another")):
        yield status, f"continued_{name}", file.end("SEGM", anic_file.field(1, value)), what
    parameters = "SEGM parameters"
    yield 48, "learning_anew", learning.put(parameters, lambda old: bytes([old[0] | 4]) + old[1:]), "a segment that learns, with models anew"
    yield 48, "learning_neighbours", learning.put(parameters, set_byte(17, 20)), "a segment that learns, with 20 neighbours"
    yield 45, "parameters_run_step", files("clips").put(parameters, set_byte(25, 65)), "a run step of 65"
    for name, file, status, change, what in (
            ("flags", triangle, 40, set_byte(0, 4), "a reserved flag"),
            ("origin", triangle, 45, set_bytes(1, NAN), "an origin that is not a number"),
            ("step", triangle, 45, set_bytes(25, f64(0)), "a step of 0"),
            ("weight_bits", triangle, 45, set_byte(33, 25), "25 bits of weights"),
            ("frame", triangle, 40, set_byte(34, 5), "a key-frame from a frame that is not there"),
            ("parent", triangle, 40, set_byte(37, 2), "a key-frame coded against itself"),
            ("rotation_bits", far, 45, set_byte(34, 28), "28 bits of rotations"),
            ("translation_step", far, 45, set_bytes(35, f64(-1)), "a step of translations below 0"),
            ("sum", msgi, 48, lambda old: bytes([old[0] & ~1]) + old[1:], "geometry interpolation by weights of any sum"),
            ("leaf", msgi, 40, set_byte(43 if msgi.field(parameters)[0] & 2 else 34, 0), "patches of no face"),
            ("linear_flags", corrected, 40, set_byte(0, 16), "a reserved flag of eigentrajectories"),
            ("basis_step", corrected, 45, set_bytes(1, f64(0)), "a basis step of 0"),
            ("weight_step", corrected, 45, set_bytes(9, INFINITE), "a weight step that is infinite"),
            ("neighbours", corrected, 45, set_byte(17, 9), "9 neighbours"),
            ("passes", corrected, 45, set_byte(18, 9), "9 parts of a level"),
            ("radius", corrected, 45, set_byte(19, 0), "a radius of 0"),
            ("schedule", corrected, 45, set_byte(20, 3), "a schedule that does not exist"),
            ("alike", files("alike"), 45, set_byte(21, 0), "motion that weighs nothing in a prior")):
        yield status, f"parameters_{name}", file.put(parameters, change), f"parameters with {what}"
    yield 40, "layer_components", corrected.put("BASI components", b"\x7f"), "a layer of more components than are left"
    yield 40, "layer_weights", corrected.put("BASI weight bytes", varint(1 << 40)), "weights of more bytes than the layer"
    yield 41, "layer_more", corrected.put("BASI coefficients", lambda old: old + b"\1"), "half a word after the coefficients of a layer"
    weights = len(corrected.field("BASI weights"))
    yield 41, "layer_more_weights", corrected.put_two(
        ("BASI weight bytes", varint(weights + 1)), ("BASI weights", lambda old: old + b"\1")), "bytes after the weights of a layer"
    layers = files("layers")
    last = len(layers.fields["BASI coefficients"]) - 1
    yield 41, "layers_more", layers.put("BASI coefficients", lambda old: old + b"\1\0", last), \
        "a word after the coefficients of a layer"
    yield 41, "layers_state", layers.put("BASI coefficients", set_bytes(0, b"\xff\xff\0\0")), "a state below its range"
    yield 41, "coefficients_state", files("quiet").put("BASI coefficients", set_byte(12, 1)), \
        "a state that no decision uses, which is not that of the end"
    yield 45, "corrections_step", corrected.put("CORR data", set_bytes(0, f64(0))), "corrections with a step of 0"
    yield 45, "corrections_not_finite", corrected.put("CORR data", set_bytes(0, NAN)), "corrections with a step that is no number"
    yield 26, "corrections_empty", corrected.put("CORR data", b""), "corrections without a byte"
    yield 41, "corrections_more", corrected.end("CORR", b"\1"), "bytes after the corrections"
    yield 41, "weights_more", far.grown("SEGM weights"), "bytes after the weights"
    yield 41, "weights_without_base", shapes.grown("SEGM weights"), "weights of a base that is not affine"
    yield 41, "motions_more", far.grown("SEGM motion"), "bytes after the motions"
    yield 40, "motion_of_shapes", shapes.grown("SEGM motion"), "eigenshapes with a motion"
    cut = files("regions")
    yield 41, "regions_more", cut.grown("SEGM pose"), "bytes after the regions"
    yield 41, "regions_missing", cut.grown("SEGM pose", lambda old: b""), "no stream of regions"
    yield 40, "regions_not_announced", corrected.grown("SEGM pose"), "a stream of regions where there is one"
    yield 41, "keyframes_more", triangle.grown("SEGM pose"), "bytes after native key-frames"
    loose = files("leftovers")
    draco = varint_value(loose.field("LIMI segment 0 Draco bytes"))
    for name, change, what in (
            ("trailing", lambda old: old + b"\0", "a byte after the frame"),
            ("skippable", lambda old: b"\x50\x2a\x4d\x18\0\0\0\0", "a skippable frame"),
            ("empty", lambda old: b"", "no frame")):
        yield 42, f"keyframes_{name}", loose.grown("SEGM pose", lambda old, c=change: old[:draco] + c(old[draco:])), \
            f"vertices that Draco does not hold with {what}"


def stream_rules(files, status_of):
    """(status, name, file, what) of streams whose symbols make no sense: bytes whose change causes it."""
    for name, kind, status, count, *flip in (("polygons_all", "FMAP", 44, 22), ("polygons_all", "VMAP", 44, 12), ("tangle", "FMAP", 44, 6), ("tangle", "VMAP", 44, 3),
                                      ("tangle", "MESH", 43, 3), ("tangle", "MESH", 44, 2), ("heated", "ATTR", 41, 1),
                                      ("quad_box_corrected", "BASI", 41, 1), ("quad_box_corrected", "CORR", 41, 2),
                                      ("limb_small", "POSE", 41, 1), ("soup", "SEGM", 41, 1), ("regions", "SEGM", 41, 3), ("regions", "SEGM", 45, 1),
                                      ("self_meeting", "MESH", 43, 9, 2)):
        chunks, found = files(name).chunks(), []
        chunk = next(c for c in chunks if c.type == kind)
        good = chunk.payload
        for part in range(count):  # spread over the stream
            for at in range(len(good) * part // count, len(good)):
                chunk.payload = good[:at] + bytes([good[at] ^ (flip[0] if flip else 1)]) + good[at + 1:]
                data = files(name).of(chunks)
                if status_of(data) == status and data not in found:
                    found.append(data)
                    yield status, f"stream_{name}_{kind.lower()}_{len(found)}", data, f"byte {at} of {kind} of {name}.anic changed"
                    break
        chunk.payload = good


def broken_rules(command, folder, status_of):
    """(status, name, file, what) of all of them. `folder` holds the valid files, status_of tells what opening gives."""
    opened = {}

    def files(name):
        if name not in opened:
            opened[name] = File(command, folder / f"{name}.anic")
        return opened[name]

    for rules in (chunk_rules, told_rules, limit_rules, clip_rules, root_rules, exact_rules, mesh_rules, segment_rules):
        yield from rules(files)
    yield from stream_rules(files, status_of)
