#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Makes the files of tests/conformance/ that MANIFEST does not list yet, with their facts and traces.

usage: update_conformance.py BUILD
  a folder that all has been built in, as build/dev
Files that MANIFEST lists stay as they are: the format is frozen. Facts come from spec/reference, those of the optional profile,
which it lacks, from the SDK.
"""
import ctypes
import hashlib
import json
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

import anic_file
import broken_rules
import conformance_facts
import traces
from conformance_parts import features_of, needs, parts_of

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = ROOT / "tests" / "conformance"
sys.path.insert(0, str(FOLDER))
import reference  # pylint: disable=wrong-import-position
VECTORS = [
    ("triangle.anic", "one_triangle", "--kg 0.1 --order free --basis keyframes"),
    ("nonmanifold_keyframes.anic", "nonmanifold", "--kg 0.5 --basis keyframes --keyframe-coder draco"),
    ("polygons_all.anic", "polygons", "--kg 0.2 --order all --basis eigenshapes"),
    ("quad_box_corrected.anic", "quad_box", "--kg 1 --max-error 0.5% --basis eigentrajectories"),
    ("turned_keyframes.anic", "moebius", "--kg 0.5 --basis keyframes --keyframe-coder draco"),
    ("soup.anic", "soup", "--kg 0.5 --basis eigentrajectories"),
    ("limb_effort9.anic", "limb", "--kg 0.2 --effort best --basis eigenshapes"),
    ("limb_small.anic", "limb --vertices 100 --frame-count 8", "--kg 0.5 --effort best --basis eigenshapes"),
    ("far_rigid.anic", "far", "--keyframes 1"),
    ("uneven_times.anic", "uneven", "--kg 0.5 --basis eigentrajectories"),
    ("leftovers.anic", "leftovers", "--kg 0.5 --order all --basis keyframes --keyframe-coder draco"),
    ("one_frame.anic", "one_frame", "--kg 0.5"),
    ("one_vertex.anic", "one_vertex", "--kg 0.5"),
    ("nonmanifold_interpolated.anic", "nonmanifold", "--keyframes 3 --interpolation msgi"),
    ("limb_default.anic", "limb --vertices 200 --frame-count 12", ""),
    ("limb_native.anic", "limb --vertices 200 --frame-count 12", "--keyframes 4"),
    ("exact_keyframes.anic", "limb --vertices 100 --frame-count 6", "--lossless --basis keyframes --keyframe-coder draco"),
    ("exact_interpolated.anic", "limb --vertices 100 --frame-count 6", "--lossless --basis keyframes --interpolation msgi"),
    ("exact_moving.anic", "limb --vertices 100 --frame-count 8", "--lossless --root-motion --up z"),
    ("lossless.anic", "limb --vertices 100 --frame-count 8", "--lossless --basis eigenshapes"),
    ("painted_box.anic", "painted_box", "--kg 0.5 --order all --basis keyframes"),
    ("heated.anic", "heated", "--kg 0.5 --fps 24 --basis eigenshapes --effort fast"),
]
# Clips whose attributes move: they go by PLY frames.
MOVING = ["heated"]
# Clips whose frames have times: they go by MDD.
TIMED = ["uneven"]
ABSENT = 5  # the status of what a file does not have
MESHES, SEGMENT_MISSING = 50, 51  # which damage to a single byte does not cause
LINE = re.compile(r"([0-9a-f]{8}) +(\d+)  (.*)")
# Codes that a file can cause, with the names of spec/12-errors.md.
CODES = dict(re.findall(r"^\| (\d+) \| ([A-Z_]+) \|", (ROOT / "spec" / "12-errors.md").read_text(), re.M))


# Live streams: clip, frames in a second, which are a file, and options, more of which make a second stream of the same
# frames that follows: a file with meshes, which are others, in the midst of a stream.
STREAM = ("streams/live.anic", "limb --vertices 100 --frame-count 20", 8, "--kg 0.5 --effort normal --key-every 0")
TWO_BASES = ("streams/two_bases.anic", "limb --vertices 100 --frame-count 14", 8, "--kg 0.5 --effort normal --key-every 0",
             "--kg 0.2 --order all --key-every 0")
LEARNING = ("streams/goes_on.anic", "limb --vertices 100 --frame-count 32", 8, "--kg 0.2 --effort normal --key-every 3")
# Rules that only decoders of a part can find broken, by the beginning of their names; a decoder MAY lack it.
OPTIONAL_RULES = {"attr_": "attributes", "attr_not_announced": "", "look_": "attributes", "attribute_unknown": "attributes",
                  "attribute_component": "attributes", "stream_heated_attr": "attributes", "diff_hash": "exact,hashes",
                  "hash": "hashes", "diff_axes": "exact", "diff_errs": "exact", "diff_noise": "exact", "diff_origin": "exact",
                  "diff_step": "exact", "diff_points": "exact", "diff_many_points": "exact", "diff_more": "exact",
                  "diff_short": "exact", "bnds_": "bounds", "meta_": "metadata", "clip_origin": "origin"}


def listing(command, path):
    """Every field of a file: offset, bytes (eight to a line), what it is."""
    data = path.read_bytes()
    lines = []
    for row in subprocess.run([command, "dump", path], check=True, capture_output=True,
                              text=True).stdout.splitlines():
        offset, size, text = LINE.fullmatch(row.rstrip()).groups()
        start, end = int(offset, 16), int(offset, 16) + int(size)
        text = re.sub(r"\s{2,}", "  ", text)
        for at in range(start, end, 8):
            part = data[at:min(end, at + 8)].hex(" ") + " "
            lines.append(f"{at:04x}  {part:<24} {text if at == start else ''}".rstrip(" ")
                         if at == start else f"{at:04x}  {part:<24} ...")
    return "\n".join(lines)


def parts_of_rule(name, data):
    """The parts that a decoder needs to see the fault."""
    rule = max((beginning for beginning in OPTIONAL_RULES if name.startswith(beginning)), key=len, default="")
    return features_of(data) + [part for part in OPTIONAL_RULES.get(rule, "").split(",") if part]


class Library:
    """Tells what the library makes of a file."""

    class Failure(ctypes.Structure):
        """anic_failure"""
        _fields_ = [("struct_size", ctypes.c_size_t), ("status", ctypes.c_int32), ("chunk", ctypes.c_char * 8),
                    ("offset", ctypes.c_uint64), ("detail", ctypes.c_char_p)]

    def __init__(self, path):
        self.functions = ctypes.CDLL(str(path))
        self.functions.anic_verify_asset.argtypes = [ctypes.c_void_p]
        self.functions.anic_close_asset.argtypes = [ctypes.c_void_p]
        self.functions.anic_read_metadata.argtypes = [ctypes.c_char_p, ctypes.c_size_t, ctypes.c_void_p, ctypes.c_void_p]
        self.functions.anic_read_bounds.argtypes = [ctypes.c_char_p, ctypes.c_size_t, ctypes.c_uint32, ctypes.c_uint32,
                                                    ctypes.c_uint32, ctypes.c_void_p]

    def status(self, data):
        """Status and what it says of the place."""
        asset, failure = ctypes.c_void_p(), self.Failure(struct_size=ctypes.sizeof(self.Failure))
        status = self.functions.anic_open_asset(data, ctypes.c_size_t(len(data)), None, ctypes.byref(asset),
                                                ctypes.byref(failure))
        if status == 0:
            status = self.functions.anic_verify_asset(asset)
            self.functions.anic_close_asset(asset)
        if status == 0:
            status = self.status_unopened(data)
        return status, (failure.detail or b"").decode()


    def status_unopened(self, data):
        """That of metadata and boxes, which opening does not read."""
        text, size, box = ctypes.c_char_p(), ctypes.c_size_t(), (ctypes.c_float * 6)()
        seen = (self.functions.anic_read_metadata(data, len(data), ctypes.byref(text), ctypes.byref(size)),
                self.functions.anic_read_bounds(data, len(data), 0, 0, 0, box))
        return next((status for status in seen if status not in (0, ABSENT)), 0)


def grown_file():
    """One of a later minor version, with optional fields, and with chunks of types that nobody knows."""
    chunks = anic_file.read_chunks((FOLDER / "limb_small.anic").read_bytes())
    for chunk in chunks:
        if chunk.type == "LIMI":  # without meaning in a file that is no continuation
            chunk.payload += anic_file.field(1, bytes(range(8)))
        if chunk.type in ("LIMI", "CLIP", "SEGM", "BNDS"):
            chunk.payload += anic_file.field(77, b"seventy-seven") + anic_file.field(78, b"") + anic_file.field((1 << 32) - 1, b"\xff")
    none, segment = (anic_file.NO_MESH, anic_file.NO_SEGMENT), (0, 0)
    unknown = [anic_file.Chunk(kind, flags, *place, kind.encode() * size) for kind, flags, place, size in (
        ("NEWS", anic_file.COPIED, none, 3), ("NEWS", anic_file.COPIED, none, 0), ("news", 0, none, 1),
        ("x0Yz", anic_file.COPIED, (0, anic_file.NO_SEGMENT), 5), ("x0Yz", 0, (40, anic_file.NO_SEGMENT), 2),
        ("seg1", anic_file.COPIED, segment, 20), ("seg2", 0, (0, 3000), 1))]
    return anic_file.write_chunks(chunks[:2] + unknown[:1] + chunks[2:4] + unknown[1:5] + chunks[4:] + unknown[5:], version=(1, 7))


def told_file():
    """One with metadata at its limits, and a box for every three frames."""
    chunks = [c for c in anic_file.read_chunks((FOLDER / "limb_small.anic").read_bytes()) if c.type != "BNDS"]
    mesh = json.loads((FOLDER / "facts" / "limb_small.json").read_text(encoding="utf-8"))["meshes"][0]
    margins = [(high - low) / 4 for low, high in zip(mesh["low"], mesh["high"])]
    sides = [x - m for x, m in zip(mesh["low"], margins)] + [x + m for x, m in zip(mesh["high"], margins)]
    boxes = bytes(1 + (7 * i) % 40 for i in range(18))  # at most 40 / 255 of 1.5 times the box: less than the margin
    text = '{"title":"\u00e9\u4e00\U0001f41f \\"[{\\"","author":"","deep":' + "[" * 31 + "1e-3" + "]" * 31 + "}"
    told = [anic_file.Chunk("META", anic_file.COPIED, anic_file.NO_MESH, anic_file.NO_SEGMENT, text.encode()),
            anic_file.Chunk("BNDS", anic_file.COPIED, 0, 0, b"\3" + struct.pack("<6f", *sides) + boxes)]
    return anic_file.write_chunks(chunks[:2] + told + chunks[2:])


def placed_file():
    """One whose positions count from an origin, with a field that nobody knows behind it."""
    chunks = anic_file.read_chunks((FOLDER / "limb_small.anic").read_bytes())
    fields = anic_file.field(1, struct.pack("<3d", 4649776.0625, -0.1, 1e-300)) + anic_file.field(2, b"\0")
    next(chunk for chunk in chunks if chunk.type == "CLIP").payload += fields
    return anic_file.write_chunks(chunks)


def unusual_files():
    """(name, file, parts of its fields) of good ones that no encoder writes, made of others."""
    yield "grown", grown_file()
    yield "boxes_and_metadata", told_file()
    yield "placed", placed_file(), "origin"
    chunks = anic_file.read_chunks((FOLDER / "limb_small.anic").read_bytes())
    first = next(i for i, chunk in enumerate(chunks) if chunk.type == "BASI")
    empty = anic_file.Chunk("BASI", 1, chunks[first].mesh, chunks[first].segment, b"\0\0")
    yield "empty_layers", anic_file.write_chunks(chunks[:first] + [empty] + chunks[first:] + [empty])


def with_meshes(first, continuation):
    """The file that a continuation stands for."""
    none = anic_file.NO_SEGMENT
    meshes = [c for c in anic_file.read_chunks(first) if c.mesh != anic_file.NO_MESH and c.segment == none]
    chunks = anic_file.read_chunks(continuation)
    return anic_file.write_chunks([c for c in chunks if c.segment == none] + meshes + [c for c in chunks if c.segment != none],
                                  needs=anic_file.features(continuation) & ~1)


def broken_streams(stream, two_bases, learning):
    """(status, name, stream, what) of live streams that are refused, though each of their files is good."""
    def continued(change):
        first, second = anic_file.split_stream(stream)[:2]
        chunks = anic_file.read_chunks(second)
        limits = next(c for c in chunks if c.type == "LIMI")
        limits.payload = change(limits.payload[:-len(anic_file.field(1, bytes(8)))], limits.payload[-8:])
        return first + anic_file.write_chunks(chunks, needs=anic_file.features(second))

    bases = anic_file.split_stream(two_bases)
    yield 50, "other_meshes", bases[0] + bases[-1], "a continuation of a file with other meshes"
    yield 50, "wrong_hash", continued(lambda limits, hash_: limits + anic_file.field(1, bytes([hash_[0] ^ 1]) + hash_[1:])), \
        "a continuation with another hash of the meshes"
    yield 40, "no_hash", continued(lambda limits, hash_: limits), "a continuation that does not say which meshes it continues"
    yield 40, "short_hash", continued(lambda limits, hash_: limits + anic_file.field(1, hash_[:7])), "a hash of 7 bytes"
    first, second, third, last = anic_file.split_stream(learning)
    yield SEGMENT_MISSING, "lost", first + third + last, "a file that continues one that was lost"
    yield SEGMENT_MISSING, "other_order", first + third + second + last, "a file before the one that it continues"
    yield 29, "trailing", stream + b"\0", "a byte that begins no file"
    yield 24, "checksum", stream[:-1] + bytes([stream[-1] ^ 1]), "a last chunk with another checksum"


def broken_containers(data):
    """(status, file) for the rules of spec/05, section 5: a good file with one thing changed."""
    def with_bytes(at, new, checked=True):
        changed = data[:at] + new + data[at + len(new):]
        return anic_file.checked_header(changed) if checked else changed

    chunks = anic_file.read_chunks(data)
    *_, offset, size = list(anic_file.entries(data))[1]
    table = b"".join(map(anic_file.entry, chunks[:-1]))
    yield 10, with_bytes(1, b"ANJ", False)
    yield 11, with_bytes(8, struct.pack("<HH", 2, 0))
    yield 12, with_bytes(16, struct.pack("<Q", 1 << 63))
    yield 20, data[:-1]
    yield 21, with_bytes(8 + anic_file.HEADER_BYTES, b"\x80")
    yield 22, with_bytes(40, b"X", False)
    yield 23, anic_file.write_table(chunks, table + anic_file.entry(chunks[-1], len(chunks[-1].payload) + 1))
    yield 24, with_bytes(offset + size - 1, bytes([data[offset + size - 1] ^ 1]), False)
    yield 25, anic_file.write_chunks(chunks + [chunks[-1]])
    yield 26, anic_file.write_chunks(chunks[:-1])
    yield 27, anic_file.write_chunks(chunks + [anic_file.Chunk("WHAT", 1, 0xFFFF, 0xFFFFFFFF, b"?")])
    yield 29, data + b"\0"
    yield 30, with_bytes(24, struct.pack("<Q", len(data) + 1)) + b"\0"


def broken_payloads(files, library, wanted):
    """(status, file, what) for codes of payloads: the first single byte whose change causes each."""
    wanted = set(wanted)
    for name, data in files:
        chunks = anic_file.read_chunks(data)
        for chunk in chunks:
            good = chunk.payload
            for at, old in enumerate(good):
                for new in dict.fromkeys((old ^ 1, old ^ 0x80, 0, 0x7F, 0xFF)):
                    chunk.payload = good[:at] + bytes([new]) + good[at + 1:]
                    changed = anic_file.write_chunks(chunks, needs=anic_file.features(data))
                    status, _ = library.status(changed)
                    if status in wanted:
                        wanted.discard(status)
                        yield status, changed, f"{name}: byte {at} of {chunk.type} is {new}, not {old}"
                    if not wanted:
                        return
            chunk.payload = good


def read_varints(data, at, count):
    """So many varints from a place on, and the place behind them."""
    numbers = []
    for _ in range(count):
        number, shift = 0, 0
        while True:
            byte = data[at]
            at += 1
            number |= (byte & 0x7F) << shift
            shift += 7
            if byte < 0x80:
                break
        numbers.append(number)
    return numbers, at


def greedy_files(data):
    """(name, file): small ones that announce as much as their fields can say."""
    chunks = anic_file.read_chunks(data)
    limits = next(c for c in chunks if c.type == "LIMI")
    good = limits.payload
    # Feature bits; meshes, segments and frames; a mesh; a segment.
    huge = {
        "vertices": (0, (1, 1, 4), (2**31 - 1, 2**31 - 1, 1, 1, 3, 0), (0, 0, 0, 0, 0, 4, 2, 0, 0)),
        "frames": (0, (1, 1, 2**24 - 1), (3, 3, 1, 1, 3, 0), (0, 0, 0, 0, 0, 2**24 - 1, 2**20, 0, 0)),
        "components": (0, (1, 1, 4), (2**20, 2**20, 1, 1, 3, 0), (0, 2, 0, 0, 0, 4, 2**20, 2**20, 0)),
        "triangles": (0, (1, 1, 4), (3, 3, (2**32 - 1) // 3, 1, 3, 0), (0, 0, 0, 0, 0, 4, 2, 0, 0)),
        "corners": (0, (1, 1, 4), (3, 3, 1, 2**31 - 1, 2**32 - 1, 0), (0, 0, 0, 0, 0, 4, 2, 0, 0)),
        "attributes": (0, (1, 1, 4), (3, 3, 1, 1, 3, 256, 2**32 - 1, 2**32 - 1, 2**46), (0, 0, 0, 0, 0, 4, 2, 0, 0)),
        "draco": (2, (1, 1, 4), (3, 3, 1, 1, 3, 0), (0, 0, 0, 8, 0, 4, 2, 0, 0, 2**32 - 1, 2**32 - 1)),
        "msgi": (4, (1, 1, 4), (2**20, 2**20, 2**21, 1, 3, 0), (0, 0, 1, 0, 0, 4, 2**20, 0, 0)),
        "corrections": (0, (1, 1, 4), (3, 3, 1, 1, 3, 0), (0, 0, 0, 0, 0, 4, 2, 0, 2**32 - 1)),
    }
    for name, (needs, counts, mesh, segment) in huge.items():
        limits.payload = anic_file.varints((1, *counts, *mesh, *segment, 0))
        yield name, anic_file.write_chunks(chunks, needs=needs)
    limits.payload = good


class Suite:
    """The files, and their lines in MANIFEST."""
    KINDS = ("valid", "stream", "invalid", "invalid_stream", "limit")

    def __init__(self, decoder):
        self.decoder = decoder
        lines = (FOLDER / "MANIFEST").read_text(encoding="utf-8").splitlines()
        self.lines = {line.split(" ", 2)[1]: line for line in lines}

    def lists(self, name):
        """Whether a file is there already."""
        return name in self.lines

    def add(self, kind, name, *fields):
        """A file that was made just now."""
        self.lines[name] = " ".join([kind, name, hashlib.sha256((FOLDER / name).read_bytes()).hexdigest(), *fields])

    def add_decoded(self, kind, name, parts):
        """The same, with its facts."""
        path = FOLDER / name
        (FOLDER / "facts").mkdir(exist_ok=True)
        with tempfile.TemporaryDirectory() as scratch:
            out = pathlib.Path(scratch) / "decoded"
            if subprocess.run(reference.decoder(path, out), check=False, capture_output=True).returncode != 0:
                subprocess.run([self.decoder, path, out], check=True)
            conformance_facts.write(conformance_facts.facts_of(out), FOLDER / "facts" / f"{path.stem}.json")
        self.add(kind, name, *needs(parts))

    def add_refused(self, kind, folder, status, what, data, parts, text):
        """One that is refused, unless it is there."""
        name = f"{folder}/{status}_{what}.anic" if kind != "limit" else f"{folder}/{what}.anic"
        if not self.lists(name):
            (FOLDER / name).parent.mkdir(parents=True, exist_ok=True)
            (FOLDER / name).write_bytes(data)
            self.add(kind, name, str(status), CODES[str(status)], *needs(parts), text)

    def write(self):
        """MANIFEST."""
        lines = sorted(self.lines.values(), key=lambda line: self.KINDS.index(line.split(" ", 1)[0]))
        (FOLDER / "MANIFEST").write_text("\n".join(lines) + "\n", encoding="utf-8")


def make_encoded(command, path, clip, options):
    """A file that the encoder makes of a clip of the corpus."""
    with tempfile.TemporaryDirectory() as scratch:
        cache = pathlib.Path(scratch) / (path.stem + (".mdd" if clip in TIMED else ".pc2"))
        inputs = [cache.with_suffix(".obj"), cache]
        if clip in MOVING:
            cache, inputs = pathlib.Path(scratch) / (clip + "_%03d.ply"), [pathlib.Path(scratch) / (clip + "_*.ply")]
        subprocess.run([command, "corpus", *clip.split(), "-q", "-f", "-o", cache], check=True)
        subprocess.run([command, "encode", "-q", "-f", *inputs, "-o", path, *options.split()], check=True)


def make_stream(command, path, clip, frames, all_options):
    """A live stream; with several options one stream after the other."""
    with tempfile.TemporaryDirectory() as scratch:
        cache, part = pathlib.Path(scratch) / "live.pc2", pathlib.Path(scratch) / "part.anic"
        subprocess.run([command, "corpus", *clip.split(), "-q", "-f", "-o", cache], check=True)
        stream = b""
        for options in all_options:
            subprocess.run([command, "encode", "-q", "-f", "--live", cache.with_suffix(".obj"), "--fps", str(frames), "-o", part,
                            *options.split()], check=True, input=cache.read_bytes()[32:])
            stream += part.read_bytes()
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(stream)


def add_good(suite, command, special):
    """Files that decode."""
    for name, clip, options in VECTORS:
        if not suite.lists(name):
            make_encoded(command, FOLDER / name, clip, options)
            suite.add_decoded("valid", name, parts_of((FOLDER / name).read_bytes()))
    for what in subprocess.run([special], check=True, capture_output=True, text=True).stdout.split():
        if not suite.lists(f"{what}.anic"):
            subprocess.run([special, what, FOLDER / f"{what}.anic"], check=True)
            suite.add_decoded("valid", f"{what}.anic", parts_of((FOLDER / f"{what}.anic").read_bytes()))
    for what, data, *parts in unusual_files():
        if not suite.lists(f"{what}.anic"):
            (FOLDER / f"{what}.anic").write_bytes(data)
            suite.add_decoded("valid", f"{what}.anic", parts_of(data, *parts))
    for name, clip, frames, *all_options in (STREAM, TWO_BASES, LEARNING):
        if not suite.lists(name):
            make_stream(command, FOLDER / name, clip, frames, all_options)
            suite.add_decoded("stream", name, features_of((FOLDER / name).read_bytes()) + ["streams"])
    if not suite.lists("learning.anic"):
        subprocess.run([command, "join", "-q", "-f", FOLDER / LEARNING[0], "-o", FOLDER / "learning.anic"], check=True)
        suite.add_decoded("valid", "learning.anic", parts_of((FOLDER / "learning.anic").read_bytes()))


def add_bad(suite, command, library):
    """Files that are refused."""
    def add(status, what, data, text):
        seen, detail = library.status(data)
        if seen != status:
            sys.exit(f"{what} is answered with {seen}: {detail}")
        suite.add_refused("invalid", "invalid", status, what, data, parts_of_rule(what, data), text or detail)

    files = [(name, (FOLDER / name).read_bytes()) for name, _, _ in VECTORS]
    for status, data in broken_containers(files[0][1]):
        add(status, CODES[str(status)].lower(), data, "")
    rest = {int(code) for code in CODES if 10 <= int(code) < 60 and int(code) not in (MESHES, SEGMENT_MISSING) and
            not suite.lists(f"invalid/{code}_{CODES[code].lower()}.anic")}
    for status, data, what in broken_payloads(sorted(files, key=lambda f: len(f[1])), library, rest) if rest else ():
        add(status, CODES[str(status)].lower(), data, what)
        rest.discard(status)
    if rest:
        print("no single byte causes " + ", ".join(CODES[str(code)] for code in sorted(rest)))
    stream = (FOLDER / STREAM[0]).read_bytes()
    second = stream[anic_file.file_size(stream):]
    chunks = anic_file.read_chunks(files[0][1])
    add(11, "draft", anic_file.write_chunks(chunks, version=(0, 9)), "")
    add(11, "largest", anic_file.write_chunks(chunks, version=(65535, 0)), "")
    learning = (FOLDER / LEARNING[0]).read_bytes()
    add(SEGMENT_MISSING, "segment_missing", with_meshes(*anic_file.split_stream(learning)[:2]),
        "a file with its meshes whose segment continues one of another file")
    add(12, "continuation", second[:anic_file.file_size(second)], "a continuation without the file that it continues")
    for status, what, data, text in broken_rules.broken_rules(command, FOLDER, lambda file: library.status(file)[0]):
        add(status, what, data, text)
    for status, what, data, text in broken_streams(stream, (FOLDER / TWO_BASES[0]).read_bytes(), learning):
        suite.add_refused("invalid_stream", "invalid/streams", status, what, data, features_of(data) + ["streams"], text)
    for what, data in greedy_files(files[0][1]):
        status, detail = library.status(data)
        suite.add_refused("limit", "limits", status, what, data, [], detail)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    build = pathlib.Path(sys.argv[1]).resolve()
    command, library = str(build / "tools/anicodec"), Library(build / "sdk/package/libanicodec.so")
    suite = Suite(build / "tests/sdk_decoder")
    add_good(suite, command, build / "tests/special_vectors")
    add_bad(suite, command, library)
    suite.write()
    traces.write(build / "tests/trace_decoder", FOLDER)

    page = ROOT / "spec" / "A-examples.md"
    text = page.read_text()
    begin = text.index("```\n0000  ") + 4
    end = text.index("\n```", begin)
    page.write_text(text[:begin] + listing(command, FOLDER / "triangle.anic") + text[end:])


if __name__ == "__main__":
    main()
