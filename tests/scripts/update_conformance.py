#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Makes tests/conformance/ and the listing of spec/A-examples.md anew, after the format has changed.

usage: update_conformance.py ANICODEC      (the built command, as build/release/tools/anicodec)
"""
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
VECTORS = [
    ("triangle.anic", "one_triangle", "--kg 0.1 --order free --basis keyframes --mesh-coder plain"),
    ("nonmanifold_keyframes.anic", "nonmanifold", "--kg 0.5 --basis keyframes"),
    ("polygons_all.anic", "polygons", "--kg 0.2 --order all --basis eigenshapes"),
    ("quad_box_corrected.anic", "quad_box", "--kg 1 --max-error 0.5% --basis eigentrajectories"),
    ("soup_plain.anic", "soup", "--kg 0.5 --mesh-coder plain --basis eigentrajectories"),
    ("limb_effort9.anic", "limb", "--kg 0.2 --effort 9 --basis eigenshapes"),
]
LINE = re.compile(r"([0-9a-f]{8}) +(\d+)  (.*)")


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


def main():
    command = str(pathlib.Path(sys.argv[1]).resolve())
    folder = ROOT / "tests" / "conformance"
    with tempfile.TemporaryDirectory() as name:
        for file, clip, options in VECTORS:
            cache = pathlib.Path(name) / (pathlib.Path(file).stem + ".pc2")
            subprocess.run([command, "corpus", clip, "-q", "-f", "-o", cache], check=True)
            subprocess.run([command, "encode", "-q", "-f", cache.with_suffix(".obj"), cache, "-o",
                            folder / file] + options.split(), check=True)
    page = ROOT / "spec" / "A-examples.md"
    text = page.read_text()
    begin = text.index("```\n0000  ") + 4
    end = text.index("\n```", begin)
    page.write_text(text[:begin] + listing(command, folder / "triangle.anic") + text[end:])


main()
