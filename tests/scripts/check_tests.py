#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Checks that every unit is tested: by a suite of its own, by a test that includes its header, or through
another unit, which THROUGH names; and that a suite named for a unit stands in that unit's file.

usage: check_tests.py CHECKOUT      one line for every fault; exit status 1 if there is any
"""
import pathlib
import re
import sys

MODULES = ("format", "sdk", "codec", "corpus", "tools", "bindings")
# A unit, or a folder of units: the tests that run it, and the reason that they stand elsewhere.
THROUGH = {
    "format/attribute_record": ("tests/api/attribute_values_test.cpp", "a record is read where a file is opened"),
    "format/coding/mixing": ("tests/format/coding/binary_coder_test.cpp", "tables of the coders that use it"),
    "format/status": ("tests/api/asset_test.cpp", "texts that the C interface returns"),
    "format/zstd_block": ("tests/format/container_test.cpp", "one way to store a chunk"),
    "sdk/api": ("tests/api", "the C interface is tested from outside, as hosts call it"),
    "sdk/clip": ("tests/api", "what an opened file holds, seen through the C interface"),
    "sdk/exact": ("tests/codec/segment/exact_encode_test.cpp", "what the encoder writes comes back"),
    "sdk/mesh": ("tests/sdk/mesh", "coders of parts of a mesh, run by those of the whole mesh"),
    "sdk/msgi": ("tests/sdk/msgi/msgi_test.cpp", "steps of one setup"),
    "sdk/play": ("tests/sdk/play/play_test.cpp", "kernels for different machines that must give the same bits"),
    "sdk/pose": ("tests/sdk/pose/pose_coding_test.cpp", "steps of one coder"),
    "sdk/prediction": ("tests/sdk/prediction_reference_test.cpp",
                       "kernels for different machines that must give the integers of plain code"),
    "sdk/segment": ("tests/api/stream_test.cpp", "a segment becomes resident while a file arrives"),
    "codec/api": ("tests/api/encoder_test.cpp", "the C interface of the encoder, from outside"),
    "codec/check_file": ("tests/codec/encode_test.cpp", "every encode checks its file"),
    "codec/connectivity": ("tests/codec/connectivity/mesh_layout_test.cpp", "steps of laying out a mesh"),
    "codec/file": ("tests/codec/encode_test.cpp", "parts of every file that is written"),
    "codec/interpolation": ("tests/codec/interpolation/interpolation_test.cpp", "methods behind one function"),
    "codec/keyframes": ("tests/codec/keyframes/keyframe_weights_test.cpp", "methods behind one function"),
    "codec/massage": ("tests/codec/massage/massage_test.cpp", "steps of the massage"),
    "codec/search": ("tests/codec/encode_test.cpp", "steps of the search, run by every encode"),
    "codec/segment": ("tests/codec/encode_test.cpp", "segments are written by every encode"),
    "codec/transfer": ("tests/codec/transfer/registration_test.cpp", "the linear system of the registration"),
    "corpus": ("tests/corpus/manifest_test.cpp", "every clip's hash stands in the manifest"),
    "tools/commands": ("tests/tools/commands", "a command is tested as a process"),
    "tools/encoding": ("tests/tools/commands/encode_command_test.cpp", "what `encode` prints of a file"),
    "tools/inputs": ("tests/tools/commands", "what commands read, tested with them"),
    "tools/io/alembic": ("tests/tools/io/alembic", "parts of one reader and one writer"),
    "tools/io/assimp": ("tests/tools/topology_test.cpp", "files of formats that assimp reads, through the command"),
    "tools/io/base": ("tests/tools/io/formats", "parts that all readers of text share"),
    "tools/io/fbx": ("tests/tools/io/fbx/fbx_test.cpp", "steps of one reader, in a process of its own"),
    "tools/io/files": ("tests/tools/io/files", "steps of writing a set of files"),
    "tools/io/gltf": ("tests/tools/io/gltf/gltf_test.cpp", "parts of one reader and one writer"),
    "tools/listing": ("tests/tools/commands/inspect_command_test.cpp", "what `dump` prints"),
    "tools/main": ("tests/tools/commands/command_line_test.cpp", "the process itself"),
    "tools/program": ("tests/tools/commands/command_line_test.cpp", "what every command does, tested with them"),
    "tools/render": ("tests/tools/commands/render_command_test.cpp", "pictures that `render` writes"),
    "tools/report": ("tests/tools/report/report_test.cpp", "parts of one page"),
    "tools/words": ("tests/tools/commands/command_line_test.cpp", "what the command prints"),
}

SUITE = re.compile(r"^TEST(?:_F|_P)?\(\s*(\w+),", re.MULTILINE)
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
# Programs and libraries that are tested as a whole.
WHOLE = ("bindings/python/", "bindings/rust/", "bindings/usd/", "bindings/engines/", "sdk/examples/", "codec/examples/")


def units_without_a_suite(checkout):
    included = set()
    for path in (checkout / "tests").rglob("*"):
        if path.suffix in (".h", ".c", ".cpp"):
            included.update(INCLUDE.findall(path.read_text(encoding="utf-8")))
    for module in MODULES:
        for path in sorted((checkout / module).rglob("*.cpp")):
            unit = path.relative_to(checkout).as_posix().removesuffix(".cpp")
            if not unit.startswith(WHOLE) and unit + ".h" not in included \
                    and not (checkout / "tests" / (unit + "_test.cpp")).is_file():
                yield unit


def suites_in_other_files(checkout):
    """(file, suite) of suites that are named for a unit and stand in another one's file."""
    units = {path.stem for module in MODULES for path in (checkout / module).rglob("*.h")}
    for path in sorted((checkout / "tests").rglob("*_test.cpp")):
        for suite in dict.fromkeys(SUITE.findall(path.read_text(encoding="utf-8"))):
            unit = re.sub(r"(?<!^)(?=[A-Z])", "_", suite.removeprefix("Slow")).lower()
            if unit in units and path.stem != unit + "_test":
                yield path.relative_to(checkout).as_posix(), suite


def faults(checkout):
    for file, suite in suites_in_other_files(checkout):
        yield f"{file} has {suite}, the suite of another unit"
    used = set()
    for unit in units_without_a_suite(checkout):
        row = unit if unit in THROUGH else unit.rpartition("/")[0]
        if row in THROUGH:
            used.add(row)
        else:
            yield f"{unit} has no test: add tests/{unit}_test.cpp"
    for row, (test, _) in THROUGH.items():
        if not (checkout / test).exists():
            yield f"{row} names {test}, which does not exist"
        if row not in used and (checkout / "tests").is_dir():
            yield f"{row} has tests of its own: take out its row"


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    lines = list(faults(pathlib.Path(sys.argv[1])))
    print("\n".join(lines) if lines else "every unit is tested")
    sys.exit(1 if lines else 0)


if __name__ == "__main__":
    main()
