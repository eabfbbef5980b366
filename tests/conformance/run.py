#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Runs a decoder on the conformance files.

usage: run.py [--any-code] [--without PART]... [--memory BYTES] [--folder FOLDER] [--stop] COMMAND...
       as: run.py --any-code --without streams --without bounds --without metadata --without origin anicodec decode -q -f --clip all {file} -o {out}.pc2

COMMAND decodes {file}, or refuses it with the code of spec/12-errors.md as its exit status, without a signal. For a file that it decodes it writes
  {out}.pc2, {out}.obj      positions and faces of the first mesh
  {out}.1.pc2, {out}.1.obj  of the second, and so on; not-a-number where a mesh is not there. May be left out: then
                            positions of files with several meshes are not compared
  {out}.json                all else that the file holds, as README.md says. May be left out
Checked are
  valid    every file, as MANIFEST hashes it, decodes to what facts/NAME.json says, positions within the tolerance
  invalid  every file is refused with its code, or with --any-code by any exit status other than 0; so is every live stream of
           invalid_stream
  stream   every live stream decodes as one clip to what facts/NAME.json says
  limit    every file is refused, and nothing takes longer than a few seconds or more than a gigabyte (--memory 0:
           whatever it takes, for decoders with a sanitizer in them)
--without PART, once for each: what the decoder lacks, which a decoder may
  draco, interpolation, learning
                            files that need them are refused with FEATURE
  attributes, exact         attributes, exact positions: stay closed. Files with exact positions are skipped, and of attributes
                            facts and what is wrong
  bounds, metadata, origin  are not read: facts, and files that are wrong in nothing else, are skipped
  hashes                    are not compared: files that are wrong in nothing else are skipped
  streams                   live streams are skipped
--stop ends at the first fault. Exit status 1 if anything is wrong.
"""
import argparse
import hashlib
import json
import math
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import clip_output  # pylint: disable=wrong-import-position

SECONDS = 60  # of a slow machine
FEATURE = 12  # the code
PARTS = ("draco", "interpolation", "learning", "attributes", "exact", "bounds", "metadata", "origin", "hashes", "streams")
TOLD_PARTS = {"attributes", "bounds", "metadata", "origin"}  # without them all else of a valid file is compared
REFUSED_PARTS = {"draco", "interpolation", "learning"}  # they are features of the header
EXACT = {"origin"}  # it has the digits that positions have no room for
ROUNDING = 1e-6  # of numbers that are printed in decimal, relative


class Decoder:
    """Runs the command."""

    def __init__(self, command, memory):
        self.command, self.memory = command, memory

    def run(self, file, out):
        """Exit status; -1 if it did not come to an end by itself."""
        def limit():
            import resource  # pylint: disable=import-outside-toplevel  # Windows lacks it
            resource.setrlimit(resource.RLIMIT_AS, (self.memory, self.memory))

        arguments = [a.replace("{file}", str(file)).replace("{out}", str(out)) for a in self.command]
        try:
            return subprocess.run(arguments, preexec_fn=limit if self.memory else None, timeout=SECONDS, check=False,
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode
        except subprocess.TimeoutExpired:
            return -1


def close(seen, expected, tolerance=0.0):
    """Whether values agree: numbers within a tolerance, all else exactly; null is not-a-number."""
    if isinstance(expected, bool) or isinstance(seen, bool) or isinstance(expected, str):
        return seen == expected
    if expected is None:
        return seen is None or isinstance(seen, float) and math.isnan(seen)
    if isinstance(expected, (int, float)):
        return isinstance(seen, (int, float)) and \
            abs(seen - expected) <= max(tolerance, ROUNDING * abs(expected))
    if isinstance(expected, list):
        return isinstance(seen, list) and len(seen) == len(expected) and \
            all(close(a, b, tolerance) for a, b in zip(seen, expected))
    return isinstance(seen, dict) and all(close(seen.get(key), value, tolerance) for key, value in expected.items())


def mesh_faults(out, number, mesh):
    """Faults of positions and faces."""
    stem = f"{out}" if number == 0 else f"{out}.{number}"
    clip, faces = clip_output.Clip(f"{stem}.pc2"), clip_output.faces(f"{stem}.obj")
    seen = [clip.vertices, len(clip.frames), len(faces)]
    if seen != mesh["counts"]:
        yield f"mesh {number}: {seen} vertices, frames, polygons, not {mesh['counts']}"
        return
    if clip_output.faces_hash(faces) != mesh["faces"]:
        yield f"mesh {number}: other faces"
    for frame, vertex, *expected in mesh["points"]:
        at = list(clip.position(frame, vertex))
        if not close(at, expected, mesh["tolerance"]):
            yield f"mesh {number}: vertex {vertex} of frame {frame} is at {at}, not {expected}"


def fact_faults(seen, facts, without):
    """Faults of what is not positions or faces."""
    for key, value in facts["clip"].items():
        agrees = seen.get(key) == value if key in EXACT else close(seen.get(key), value)
        if key not in without and not agrees:
            yield f"{key} is {seen.get(key)}, not {value}"
    if len(seen.get("meshes", ())) != len(facts["meshes"]):
        yield f"{len(seen.get('meshes', ()))} meshes, not {len(facts['meshes'])}"
        return
    for number, (mesh, expected) in enumerate(zip(seen["meshes"], facts["meshes"])):
        for key in ("name", "low", "high"):
            if not close(mesh.get(key), expected[key], expected["tolerance"]):
                yield f"mesh {number}: {key} is {mesh.get(key)}, not {expected[key]}"
        if "bounds" not in without:
            yield from box_faults(mesh.get("boxes"), number, expected.get("boxes", ()))
        if "attributes" in without:
            continue
        if len(mesh["attributes"]) != len(expected["attributes"]):
            yield f"mesh {number}: {len(mesh['attributes'])} attributes, not {len(expected['attributes'])}"
            continue
        for which, (attribute, wanted) in enumerate(zip(mesh["attributes"], expected["attributes"])):
            for key in ("kind", "domain", "name", "components", "labels", "moves", "groups", "looks"):
                if attribute.get(key) != wanted[key]:
                    yield f"mesh {number}: attribute {which}: {key} is {attribute.get(key)}, not {wanted[key]}"
            sizes = [len(frame) for frame in attribute["values"]]
            if sizes != wanted["sizes"]:
                yield f"mesh {number}: attribute {which}: {sizes} values, not {wanted['sizes']}"
                continue
            for frame, index, value in wanted["samples"]:
                if not close(attribute["values"][frame][index], value, wanted["tolerance"]):
                    yield (f"mesh {number}: attribute {which}: value {index} of frame {frame} is "
                           f"{attribute['values'][frame][index]}, not {value}")


def box_faults(seen, number, boxes):
    """Faults of the boxes of frames."""
    for frame, expected in boxes:
        if seen is None or not close(seen[frame], expected):
            yield f"mesh {number}: the box of frame {frame} is {seen and seen[frame]}, not {expected}"


def check_valid(decoder, file, facts, folder, without):
    """Faults of a file that must decode."""
    out = pathlib.Path(folder) / file.stem
    status = decoder.run(file, out)
    if status != 0:
        yield f"refused, exit status {status}"
        return
    try:
        meshes = facts["meshes"]
        if len(meshes) > 1 and not pathlib.Path(f"{out}.1.pc2").exists():
            meshes = []  # all of them may be shown as one
        for number, mesh in enumerate(meshes):
            yield from mesh_faults(out, number, mesh)
        if (told := pathlib.Path(f"{out}.json")).exists():
            yield from fact_faults(json.loads(told.read_text(encoding="utf-8")), facts, without)
    except (OSError, ValueError, KeyError, TypeError) as error:
        yield f"what was written cannot be read: {error}"


class Entry:
    """A line of the manifest."""

    def __init__(self, line):
        self.kind, self.name, self.digest, *rest = line.split()
        self.code = int(rest[0]) if self.kind in ("invalid", "invalid_stream", "limit") else None
        needs = next((word for word in rest[:3] if word.startswith("needs=")), "needs=")
        self.needs = {part for part in needs[len("needs="):].split(",") if part}
        if unknown := self.needs - set(PARTS):
            sys.exit(f"{self.name} needs parts that do not exist: {', '.join(sorted(unknown))}")

    def skipped(self, without):
        """Whether nothing is to be learnt from it about a decoder without some parts."""
        lacking = self.needs & without - REFUSED_PARTS
        return bool(lacking - TOLD_PARTS if self.kind == "valid" else lacking)


def faults_of(decoder, folder, entry, without, any_code, scratch):
    """Faults of one file of the manifest."""
    file = folder / entry.name
    if hashlib.sha256(file.read_bytes()).hexdigest() != entry.digest:
        yield "is not the file of the manifest"
        return
    lacks_feature = entry.needs & without & REFUSED_PARTS
    if entry.kind in ("valid", "stream") and not lacks_feature:
        facts = json.loads((folder / "facts" / f"{file.stem}.json").read_text(encoding="utf-8"))
        yield from check_valid(decoder, file, facts, scratch, without)
        return
    status = decoder.run(file, pathlib.Path(scratch) / "refused")
    codes = {entry.code, FEATURE} if lacks_feature else {entry.code}
    if status <= 0:
        yield "was accepted" if status == 0 else f"ended the decoder: {status}"
    elif entry.kind != "limit" and not any_code and status not in codes:
        yield f"was refused with {status}, not {' or '.join(str(code) for code in codes if code)}"


def conforms(decoder, folder, without, any_code=False, stop=False):
    """Whether a decoder does right by all files of a folder; prints its faults, with `stop` the first one."""
    entries = [Entry(line) for line in (folder / "MANIFEST").read_text(encoding="utf-8").splitlines()]
    right, skipped, counts = True, 0, dict.fromkeys(("valid", "stream", "invalid", "invalid_stream", "limit"), 0)
    with tempfile.TemporaryDirectory() as scratch:
        for entry in entries:
            if entry.skipped(without):
                skipped += 1
                continue
            counts[entry.kind] += 1
            for fault in faults_of(decoder, folder, entry, without, any_code, scratch):
                right = False
                print(f"{entry.name}: {fault}", flush=True)
                if stop:
                    return False
    if right:
        told = ", ".join(f"{count} {kind.replace('_', ' ')} files" for kind, count in counts.items())
        print(f"{told}{f', {skipped} skipped' if skipped else ''}: conforms")
    return right


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--any-code", action="store_true")
    parser.add_argument("--without", action="append", choices=PARTS, default=[])
    parser.add_argument("--memory", type=int, default=1 << 30)
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent)
    parser.add_argument("--stop", action="store_true")
    parser.add_argument("command", nargs=argparse.REMAINDER)
    arguments = parser.parse_args()
    if not any("{file}" in word for word in arguments.command):
        parser.error("COMMAND names no {file}")
    decoder = Decoder(arguments.command, arguments.memory)
    sys.exit(0 if conforms(decoder, arguments.folder, set(arguments.without), arguments.any_code, arguments.stop) else 1)


if __name__ == "__main__":
    main()
