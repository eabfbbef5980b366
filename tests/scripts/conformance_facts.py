# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""The facts that tests/conformance/run.py compares a decoder's output with, made from the output of a decoder."""
import json
import math
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "conformance"))
import clip_output  # pylint: disable=wrong-import-position

POINTS = 24  # of each mesh
SAMPLES = 12  # of each attribute
MESH_KEYS = ("name", "low", "high")
ATTRIBUTE_KEYS = ("kind", "domain", "name", "components", "labels", "moves", "groups", "looks")


class Places:
    """Numbers that look random, the same in every run."""

    def __init__(self):
        self.state = 1

    def below(self, count):
        """One of 0 .. count - 1."""
        self.state = self.state * 1103515245 + 12345 & 0x7FFFFFFF
        return (self.state >> 8) % count


def _largest(numbers):
    return max((abs(x) for x in numbers if math.isfinite(x)), default=0.0)


def _mesh(stem, told, exact):
    clip, faces = clip_output.Clip(f"{stem}.pc2"), clip_output.faces(f"{stem}.obj")
    places = Places()
    tolerance = 0.0 if exact else 2e-5 * max(_largest(frame) for frame in clip.frames)
    points = []
    for _ in range(POINTS):
        frame, vertex = places.below(len(clip.frames)), places.below(clip.vertices)
        points.append([frame, vertex] + [None if math.isnan(x) else float(f"{x:.9g}")
                                         for x in clip.position(frame, vertex)])
    attributes = []
    for attribute in told["attributes"]:
        sizes = [len(frame) for frame in attribute["values"]]
        samples = []
        for _ in range(SAMPLES if sizes[0] else 0):
            frame = places.below(len(sizes))
            index = places.below(sizes[frame])
            samples.append([frame, index, attribute["values"][frame][index]])
        attributes.append({key: attribute[key] for key in ATTRIBUTE_KEYS} |
                          {"sizes": sizes, "samples": samples,
                           "tolerance": 2e-5 * max(_largest(frame) for frame in attribute["values"])})
    boxes = told.get("boxes", [])
    frames = sorted({0, len(boxes) // 2, len(boxes) - 1}) if boxes else []
    return {key: told[key] for key in MESH_KEYS} | {"boxes": [[frame, boxes[frame]] for frame in frames]} | {
        "counts": [clip.vertices, len(clip.frames), len(faces)], "faces": clip_output.faces_hash(faces),
        "tolerance": float(f"{tolerance:.3g}"), "points": points, "attributes": attributes}


def facts_of(out):
    """From OUT.pc2, OUT.obj, OUT.1.pc2 ... and OUT.json."""
    told = json.loads(pathlib.Path(f"{out}.json").read_text(encoding="utf-8"))
    exact = all(clip["asked"] == 2 and clip["asked_value"] == 0 for clip in told["clips"])
    meshes = [_mesh(out if number == 0 else f"{out}.{number}", mesh, exact) for number, mesh in enumerate(told["meshes"])]
    return {"clip": {key: value for key, value in told.items() if key != "meshes"}, "meshes": meshes}


def _rounded(value):
    """Numbers to nine digits, which tell any binary32; the origin has more."""
    if isinstance(value, float):
        return float(f"{value:.9g}")
    if isinstance(value, list):
        return [_rounded(x) for x in value]
    if isinstance(value, dict):
        return {key: x if key == "origin" else _rounded(x) for key, x in value.items()}
    return value


def write(facts, path):
    """One line for each entry of a list or an object that is not short, so that changes can be read."""
    facts = _rounded(facts)
    lines = ["{", f' "clip": {json.dumps(facts["clip"], sort_keys=True)},', ' "meshes": [']
    for number, mesh in enumerate(facts["meshes"]):
        entries = ",\n   ".join(f"{json.dumps(key)}: {json.dumps(mesh[key], sort_keys=True)}" for key in sorted(mesh))
        lines.append("  {" + entries + "}" + ("," if number + 1 < len(facts["meshes"]) else ""))
    lines += [" ]", "}"]
    pathlib.Path(path).write_text("\n".join(lines) + "\n", encoding="utf-8")
