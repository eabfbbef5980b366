#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Calls the Python package in odd ways: each call does what it is asked to, or raises one of the package's exceptions, or a
TypeError or ValueError for what is no such value. None ends the interpreter.

usage: python_calls.py FILE.anic... [--seconds N | --count N] [--seed S]
Program i of seed S is the one of seed S + i: `--count 1 --seed K` repeats one. Run it in an environment that has the
package, or under AddressSanitizer with a module built so and the sanitizer's library in LD_PRELOAD. The last seed is
printed when a signal ends it. Exit status 1 if a call raised anything else.
"""
import argparse
import collections
import faulthandler
import math
import pathlib
import pickle
import random
import sys
import threading
import time
import traceback

import numpy as np

import anicodec
from anicodec import metrics

NUMBERS = (0, 1, -1, 2, 3, 255, 65536, 2**31, 2**32, 2**63, -2**63, 2**64, 0.5, -0.0, 1e-300, 1e20, 1e300, math.inf, -math.inf,
           math.nan, True, None, "1", "0.1%", "50%", "-1%", "nan%", "", "\ud800", b"x", 1j, (), [], {}, object(), np.float16(2), np.int8(-3))
TEXTS = ("", "a", "\u00e4", "a\0b", "\ud800", "x" * 70000, None, 7)
FLOATS = (0.0, -0.0, 1.0, 1e-40, 1e10, 1e20, -1e30, 3.4e38, 1e39, 1e300, math.inf, math.nan)
TYPES = ("float32", "float64", "float16", ">f4", ">f8", "int8", "uint16", "int64", "uint64", "bool", "complex64", "object", "U3")
OPTIONS = {"max_error": (0.01, "1%", "0.01%", 1e-9), "kg": (1, 0.01), "rmse": (0.1, 1e-4), "size": (500, "10k"), "bpfv": (2, 20),
           "displacement": (0.01,), "sted": (0.05,), "quality": ("good", "best"), "lossless": (True, False),
           "basis": ("auto", "keyframes", "eigenshapes", "eigentrajectories"), "keyframes": (1, 2, 5),
           "keyframe_selection": ("pivot", "gas", "uniform"), "interpolation": ("linear", "msgi", "auto"),
           "keyframe_coder": ("native", "draco", "auto"), "massage": ("off", "on", "auto"), "massage_strength": (0.5,),
           "massage_tolerance": (0.1,), "order": ("vertices", "free", "all"), "effort": ("fast", "normal"), "smallest": (True,),
           "uv_bits": (8, 12), "colour_bits": (8,), "attribute_error": (0.1, "1%"), "store_normals": (5, 30), "no_attributes": (True,),
           "threads": (0, 1, 2), "max_bytes": (10**6, 10**8), "fps": (24, "30000/1001", 29.97), "start_time": (1.5,), "name": ("walk",),
           "up": ("y", "z"), "unit": ("cm", 0.1), "loop": (True,), "origin": ("auto", "none", (1, 2, 3)), "root_motion": (True,),
           "metadata": ({"a": [1, {}]}, {}), "fields": (["heat"], []), "field_errors": ({"heat": 0.1}, {"heat": "exact"}),
           "field_units": ({"heat": "K"},), "events": ([("step", 0.1)],)}
#: Exceptions that a call may raise.
FAIR = (anicodec.AnicodecError, TypeError, ValueError, OverflowError, MemoryError, AttributeError, LookupError)
MOST_FRAMES, MOST_BYTES = 400, 50_000_000


class Program:
    """Some calls, by chance."""

    def __init__(self, seed, files):
        self.chance = random.Random(seed)
        self.arrays = np.random.default_rng(seed)
        self.files = files

    def one_in(self, count):
        return self.chance.randrange(count) == 0

    def odd(self, value):
        """The value, or now and then one that is none."""
        return self.chance.choice(NUMBERS + TEXTS) if self.one_in(24) else value

    def array(self, *shape, low=-1.0, high=1.0):
        """Numbers of any kind and stride, a few of them odd, now and then of another shape."""
        shape = [max(0, n + (self.chance.choice((-1, 1)) if self.one_in(40) else 0)) for n in shape]
        if self.one_in(40):
            shape.append(self.chance.randrange(3))
        values = self.arrays.uniform(low, high, shape)
        while values.size and self.one_in(6):
            values.flat[self.chance.randrange(values.size)] = self.chance.choice(FLOATS)
        if self.one_in(5):
            with np.errstate(all="ignore"):
                values = values.astype(self.chance.choice(TYPES))
        else:
            values = values.astype("float32")
        form = self.chance.randrange(8)
        if form == 0 and values.ndim:
            values = np.repeat(values, 2, axis=-1)[..., ::2]
        elif form == 1 and values.ndim:
            values = values[::-1]
        elif form == 2:
            values = np.asfortranarray(values)
        elif form == 3:
            values.flags.writeable = False
        elif form == 4 and values.ndim:
            values = np.broadcast_to(values[:1], values.shape)
        elif form == 5:
            values = values.tolist()
        return values

    def faces(self, vertices):
        count = self.chance.randrange(30)
        sides = [self.chance.choice((3, 3, 3, 4, 4, 5, 2, 0)) if self.one_in(3) else 3 for _ in range(count)]
        below = vertices + self.one_in(60)
        polygons = [[self.chance.randrange(below) for _ in range(n)] for n in sides]
        form = self.chance.randrange(6)
        if form == 0:
            return self.odd(None)
        if form == 1:
            offsets = np.cumsum([0, *sides])
            corners = np.array([v for polygon in polygons for v in polygon], dtype=self.chance.choice(("uint32", "int64", "uint8")))
            return self.odd(offsets), self.odd(corners)
        if form == 2:
            return np.array([[self.chance.randrange(below) for _ in range(3)] for _ in range(count)] or np.empty((0, 3)), dtype=int)
        return polygons

    def options(self):
        chosen = self.chance.sample(list(OPTIONS), self.chance.randrange(5))
        options = {name: self.odd(self.chance.choice(OPTIONS[name])) for name in chosen}
        options.setdefault("effort", "fast")
        options.setdefault("max_bytes", MOST_BYTES)
        if self.one_in(30):
            options[self.chance.choice(("speed", "", "max_errors"))] = 1
        if self.one_in(12):
            left = self.chance.randrange(20)

            def progress(*_):
                nonlocal left
                left -= 1
                if left == 0:
                    raise KeyError("of the host")
                return self.chance.choice((None, True)) if left > -20 else False

            options["progress"] = progress
        return options

    def details(self, frames, vertices):
        """Attributes, most of them as they should be."""
        given = {}
        if self.one_in(3):
            given["uv"] = self.odd(self.array(*([frames] if self.one_in(3) else []), vertices, 2))
        if self.one_in(4):
            given["colours"] = self.odd(self.array(vertices, self.chance.choice((3, 4)), low=0.0))
        if self.one_in(4):
            given["normals"] = self.odd(self.array(vertices, 3))
        if self.one_in(3):
            given["custom"] = self.odd({"heat": self.odd(self.array(*([frames] if self.one_in(2) else []), vertices, 1))})
        return given

    def encode(self):
        vertices, frames = self.chance.randrange(1, 30), self.chance.randrange(1, 12)
        faces, details, options = self.faces(vertices), self.details(frames, vertices), self.options()
        positions = self.odd(self.array(frames, vertices, 3))
        form = self.chance.randrange(5)
        if form == 0:
            source = self.array(frames, vertices, 3)
            data = anicodec.encode(lambda frame: source[frame], faces, vertex_count=self.odd(vertices),
                                   frame_count=self.odd(frames), **details, **options)
        elif form == 1:
            meshes = [anicodec.SourceMesh(self.array(frames, n, 3), self.faces(n), self.odd(f"mesh {n}"), runs=runs)
                      for n, runs in ((vertices, ()), (3, self.odd([(0, frames)])), (5, ()))]
            data = anicodec.encode_meshes(meshes, **options)
        elif form == 2:
            first = self.chance.randrange(frames + 1)
            clips = [anicodec.SourceClip(self.odd("a"), self.odd(first)), anicodec.SourceClip("b", frames - first, fps=self.odd(25))]
            data = anicodec.encode(positions, faces, clips=clips, **details, **options)
        elif form == 3:
            return self.live(vertices, frames)
        else:
            data = anicodec.encode(positions, faces, **details, **options)
        return self.play(anicodec.open(data))

    def live(self, vertices, frames):
        moving = self.one_in(2)
        custom = {"heat": anicodec.Moving("vertices", self.odd(1))} if moving else None
        with anicodec.encode_live(self.faces(vertices), vertex_count=self.odd(vertices), fps=self.odd(30), piece=self.odd(0.1),
                                  key_every=self.odd(0.2), most_waiting=self.odd(0), custom=custom, effort="fast") as live:
            thread = threading.Thread(target=lambda: [None for _ in live]) if self.one_in(2) else None
            if thread:
                thread.daemon = True
                thread.start()
            for _ in range(frames):
                values = {"custom": {"heat": self.array(vertices, 1)}} if moving else {}
                live.push(self.odd(self.array(vertices, 3)), **values)
            if not self.one_in(5):
                live.end()
            if not thread:
                for _ in range(frames):
                    if live.take(self.chance.choice((0, 0.1))) is None:
                        break
            elif not self.one_in(5):
                thread.join(20)

    def open(self):
        data = bytearray(self.chance.choice(self.files))
        for _ in range(self.chance.randrange(3)):
            at = self.chance.randrange(len(data))
            if self.one_in(3):
                del data[at:at + self.chance.randrange(1, 40)]
            else:
                data[at] ^= 1 << self.chance.randrange(8)
            if not data:
                break
        options = {name: self.odd(value) for name, value in (("quality", 0.5), ("clips", []), ("in_place", True), ("inexact", True))
                   if self.one_in(4)}
        self.play(anicodec.open(bytes(data), max_bytes=self.odd(MOST_BYTES), **options))

    def play(self, clip):
        for _ in range(6):
            mesh = self.chance.choice(clip.meshes)
            self.attempt(self.chance.choice((self.frames, self.moment, self.numbers, self.whole)), clip, mesh)

    def frames(self, _, mesh):
        count = min(len(mesh), MOST_FRAMES)
        choice = self.chance.choice((self.chance.randrange(count), -1, slice(0, count, self.chance.choice((1, 2, -1))), [0, count - 1], [],
                                     np.arange(count)[::-1], slice(None, 3)))
        frames = self.odd(choice)
        if isinstance(frames, str):
            return
        out = self.odd(None)
        if self.one_in(6):
            shape = (mesh.vertex_count, 3) if np.ndim(choice) == 0 and not isinstance(choice, slice) else (count, mesh.vertex_count, 3)
            out = np.full(shape, 7, self.chance.choice(("float32", "float64", ">f4")))
            out = self.chance.choice((out, out[::-1], out[..., ::2]))
        shown = mesh.frames(frames, out=out)
        assert np.isfinite(np.asarray(shown, dtype=float)).all()

    def moment(self, clip, mesh):
        at = self.odd(self.chance.uniform(-1, 3))
        words = {name: self.odd(value) for name, value in (("sampling", self.chance.choice(("step", "linear", "cubic"))), ("loop", True),
                                                           ("wrap", self.chance.choice(("clamp", "loop", "ping-pong"))), ("clip", 0))
                 if self.one_in(3)}
        call = self.chance.randrange(5)
        if call == 0:
            mesh.at(at, **words)
        elif call == 1:
            mesh.attribute_at(self.odd(0), at, **words)
        elif call == 2:
            mesh.surface_frame([self.odd(0), self.odd(0), self.odd(0)], [self.odd(0.2), 0.3, self.odd(0.5)], at)
        elif call == 3:
            mesh.intersect_ray([self.odd(0), 0, -5], [0, self.odd(0), 1], at)
        else:
            clip.root_motion(at)
            clip.root_step(at, self.odd(1))

    def numbers(self, clip, mesh):
        mesh.normals(self.odd(0), crease=self.odd(30), per_corner=self.odd(self.one_in(2)))
        mesh.normals(self.array(mesh.vertex_count, 3))
        clip.time(self.odd(0))
        if len(mesh) <= MOST_FRAMES:
            metrics.compare(mesh[:], self.odd(mesh[:]), self.odd(mesh.polygons))

    def whole(self, clip, mesh):
        again = pickle.loads(pickle.dumps(clip))
        again.verify()
        for part in (repr(clip), repr(mesh), clip.metadata, clip.duration, mesh.faces, mesh.triangles, mesh.attributes):
            assert part is not None
        anicodec.read_metadata(clip.data)
        anicodec.read_bounds(clip.data, mesh=self.odd(0), first_frame=self.odd(0), frames=self.odd(1))

    @staticmethod
    def attempt(call, *arguments):
        try:
            call(*arguments)
        except anicodec.InternalError:
            raise
        except FAIR as error:
            return type(error).__name__
        except KeyError:
            return "KeyError"
        return "done"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", type=pathlib.Path, nargs="+")
    parser.add_argument("--seconds", type=float, default=math.inf)
    parser.add_argument("--count", type=int, default=10**9)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    faulthandler.enable()
    files = [path.read_bytes() for path in arguments.files]
    end, faults, outcomes, seed = time.monotonic() + arguments.seconds, 0, collections.Counter(), arguments.seed
    while time.monotonic() < end and seed < arguments.seed + arguments.count:
        print(f"\rseed {seed}", end="", file=sys.stderr, flush=True)
        program = Program(seed, files)
        call = program.encode if seed % 2 else program.open
        try:
            outcomes[call.__name__, program.attempt(call)] += 1
        except Exception:  # pylint: disable=broad-except
            faults += 1
            print(f"\nseed {seed}:\n{traceback.format_exc()}", flush=True)
        seed += 1
    print(f"\n{seed - arguments.seed} programs: " + ", ".join(f"{count} {call} {outcome}" for (call, outcome), count in sorted(outcomes.items())) +
          f"; {faults} faults")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
