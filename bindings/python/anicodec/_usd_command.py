# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""`anicodec encode shot.usd`: the part of the command line that reads USD."""
from __future__ import annotations

import argparse
import os
import sys
from typing import List, Optional

SUFFIXES = (".usd", ".usda", ".usdc", ".usdz")


def is_meant(arguments: List[str]) -> bool:
    """Whether the command line encodes a stage."""
    return arguments[:1] == ["encode"] and any(text.lower().endswith(SUFFIXES) for text in arguments[1:])


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="anicodec encode", description="Encodes a USD stage; `anicodec encode "
                                     "--help` explains the options.", allow_abbrev=False)
    parser.add_argument("stage")
    parser.add_argument("-o", "--output", required=True)
    parser.add_argument("-f", "--force", action="store_true", help="replace the output")
    parser.add_argument("-q", "--quiet", action="store_true")
    parser.add_argument("-j", "--threads", type=int)
    parser.add_argument("--mesh", help="path of a prim")
    for name in ("max-error", "rmse", "kg", "displacement", "sted", "quality", "size", "bpfv", "fps", "basis", "order", "unit", "up", "topology-changes",
                 "keyframe-selection", "interpolation", "keyframe-coder", "attribute-error"):
        parser.add_argument("--" + name)
    for name in ("effort", "keyframes", "uv-bits", "colour-bits"):
        parser.add_argument("--" + name, type=int)
    parser.add_argument("--store-normals", type=float)
    parser.add_argument("--origin", help="auto, none or X,Y,Z")
    parser.add_argument("--no-attributes", action="store_true", default=None)
    parser.add_argument("--lossless", action="store_true", default=None)
    parser.add_argument("--loop", action="store_true", default=None)
    return parser


def _write(path: str, data: bytes) -> None:
    beside = path + ".part"
    with open(beside, "wb") as file:
        file.write(data)
    os.replace(beside, path)


def main(arguments: List[str]) -> int:
    """Encodes as the arguments behind `encode` say; the exit status of the command."""
    options = vars(_parser().parse_args(arguments))
    stage, output = options.pop("stage"), options.pop("output")
    force, quiet = options.pop("force"), options.pop("quiet")
    prim: Optional[str] = options.pop("mesh")
    options = {name: value for name, value in options.items() if value is not None}
    if options.get("origin") not in (None, "auto", "none"):
        options["origin"] = options["origin"].split(",")
    try:
        from . import usd
    except ImportError as error:
        print(f"anicodec: {stage}: {error}", file=sys.stderr)
        return 4
    if os.path.exists(output) and not force:
        print(f"anicodec: {output}: exists (-f replaces it)", file=sys.stderr)
        return 1
    try:
        data = usd.encode(stage, prim, **options)
        _write(output, data)
    except (OSError, ValueError, MemoryError) as error:
        print(f"anicodec: {stage}: {error}", file=sys.stderr)
        return 2
    if not quiet:
        for note in data.notes:
            print(f"{stage}: {note}", file=sys.stderr)
        print(f"{output}: {len(data)} bytes, max error {data.measured['max_error']:.4g}, "
              f"KG {data.measured['kg']:.3g} %")
    return 0
