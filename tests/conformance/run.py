#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Runs a decoder on the conformance files.

usage: run.py COMMAND...      as: run.py anicodec decode -q -f {file} -o {out}.pc2

COMMAND decodes {file} to a PC2 vertex cache {out}.pc2 and its faces to {out}.obj, and succeeds (exit status 0), or
refuses the file: another exit status, without a signal. Checked are
  valid    every file, as MANIFEST hashes it, decodes; sizes and faces are right, positions within the tolerance
  invalid  every file is refused
  limit    every file is refused, and nothing takes longer than a few seconds or more than a gigabyte (--memory 0:
           whatever it takes, for decoders with a sanitizer in them)
Exit status 1 if anything is wrong.
"""
import hashlib
import pathlib
import resource
import subprocess
import sys
import tempfile

FOLDER = pathlib.Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(FOLDER.parent / "scripts"))
import clip_output  # pylint: disable=wrong-import-position

SECONDS = 60  # of a slow machine


class Decoder:
    """Runs the command."""

    def __init__(self, command, memory):
        self.command, self.memory = command, memory

    def run(self, file, out):
        """Exit status; a fault if it did not come to an end by itself."""
        def limit():
            if self.memory:
                resource.setrlimit(resource.RLIMIT_AS, (self.memory, self.memory))

        arguments = [a.replace("{file}", str(file)).replace("{out}", str(out)) for a in self.command]
        try:
            return subprocess.run(arguments, preexec_fn=limit, timeout=SECONDS, check=False,
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode
        except subprocess.TimeoutExpired:
            return -1


def check_valid(decoder, file, sizes, points, folder):
    """Faults of a file that must decode."""
    out = pathlib.Path(folder) / file.stem
    status = decoder.run(file, out)
    if status != 0:
        yield f"refused, exit status {status}"
        return
    vertices, frames, polygons, digest, tolerance = sizes
    clip, faces = clip_output.Clip(f"{out}.pc2"), clip_output.faces(f"{out}.obj")
    if (clip.vertices, len(clip.frames), len(faces)) != (int(vertices), int(frames), int(polygons)):
        yield f"{clip.vertices} vertices, {len(clip.frames)} frames, {len(faces)} polygons"
        return
    if clip_output.faces_hash(faces) != digest:
        yield "other faces"
    for frame, vertex, *expected in points:
        seen = clip.position(int(frame), int(vertex))
        if any(abs(a - float(b)) > float(tolerance) for a, b in zip(seen, expected)):
            yield f"vertex {vertex} of frame {frame} is at {seen}, not {expected}"


def main():
    arguments, memory = sys.argv[1:], 1 << 30
    if arguments[:1] == ["--memory"]:
        memory, arguments = int(arguments[1]), arguments[2:]
    if not arguments or "{file}" not in arguments:
        sys.exit(__doc__)
    decoder = Decoder(arguments, memory)
    entries = [line.split() for line in (FOLDER / "MANIFEST").read_text().splitlines()]
    faults, counts = [], {"valid": 0, "invalid": 0, "limit": 0}
    with tempfile.TemporaryDirectory() as folder:
        for kind, name, *fields in entries:
            if kind not in counts:
                continue
            counts[kind] += 1
            file = FOLDER / name
            found = []
            if hashlib.sha256(file.read_bytes()).hexdigest() != fields[0]:
                found.append("is not the file of the manifest")
            elif kind == "valid":
                sizes = next(e[2:] for e in entries if e[:2] == ["sizes", name])
                points = [e[2:] for e in entries if e[:2] == ["point", name]]
                found.extend(check_valid(decoder, file, sizes, points, folder))
            else:
                status = decoder.run(file, pathlib.Path(folder) / "refused")
                if status <= 0:
                    found.append("was accepted" if status == 0 else f"ended the decoder: {status}")
            faults.extend(f"{name}: {fault}" for fault in found)
    print("\n".join(faults) or ", ".join(f"{count} {kind} files" for kind, count in counts.items()) + ": conforms")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
