# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""`anicodec encode shot.usd` and `anicodec decode clip.anic -o shot.usd`: the parts of the command line that read and write USD."""
from __future__ import annotations

import functools
import os
import tempfile
from typing import Any, Dict, List, Optional

from . import _package_command, _usd_batch
from ._package_command import Fault, Parser
from ._usd_batch import SUFFIXES

_ENCODE_USAGE = "%(prog)s STAGE -o FILE.anic [options]\n       %(prog)s --batch DIR|LIST -o DIR [options]"
_DECODE_USAGE = "%(prog)s FILE.anic -o STAGE [options]\n       %(prog)s FILE.anic... --format usdc -o DIR [options]"
#: Options of the command that stages have no use for, and why.
_OF_OTHERS: Dict[str, Dict[str, str]] = {
    "encode": {"--part": "meshes of a stage are stored apart, as by --split-objects, which goes without --part",
               **dict.fromkeys(("--clip", "--clips"), "a stage has one time line; which variants it shows is chosen in the stage"),
               **dict.fromkeys(("--live", "--piece", "--key-every", "--box"), "of captures, not of stages"),
               "--no-weld": "of STL files, not of stages",
               "--allow-outside": "USD finds the layers of a stage, wherever they are"},
    "decode": {"--up": "a stage says which axis is up", "--textures": "a stage names the images of its materials",
               "--normals": "a stage has them unless --no-normals leaves them out",
               **dict.fromkeys(("--start", "--ascii"), "of files for each frame, not of stages"), "--hold": "of GLB, not of stages"}}


def is_meant(arguments: List[str]) -> bool:
    """Whether the command line reads or writes a stage."""
    if arguments[:1] == ["encode"] and _is_batch(arguments):
        return _usd_batch.is_meant(arguments[1:])
    return _package_command.is_meant(arguments, SUFFIXES)


def _is_batch(arguments: List[str]) -> bool:
    return any(text.split("=")[0] == "--batch" for text in arguments)


def _parser(command: str) -> Parser:
    encodes = command == "encode"
    parser = Parser(command, "a stage", SUFFIXES, usage=_ENCODE_USAGE if encodes else _DECODE_USAGE,
                    description="Encodes the meshes of a USD stage; `anicodec encode --help` explains the options that other inputs have, too."
                    if encodes else "Writes a clip as a USD stage.")
    if encodes:
        parser.add_argument("input", metavar="STAGE", help="a stage")
        parser.add_argument("--mesh", help="path of a prim; its meshes and all below it")
        parser.add_argument("--split-objects", action="store_true", help="what stages do anyway: each mesh is stored apart")
    else:
        parser.add_argument("--frames", metavar="A:B[:STEP]", help="frames A to B - 1, every STEP-th (default: all)")
        parser.add_argument("--over", action="store_true", help="to be layered over the stage that was encoded")
        parser.add_argument("--no-normals", action="store_true", help="leave out normals, which programs then take for flat faces")
        parser.add_argument("--clip", help="the clip to write, of a file that has several (default: all, as variants)")
    return parser


def _encode(given: Dict[str, Any]) -> None:
    from . import usd

    stage, prim = given.pop("input"), given.pop("mesh")
    del given["split_objects"]
    _package_command.encode(given, stage, functools.partial(usd.encode, stage, prim))


def _decode(given: Dict[str, Any]) -> None:
    for source, output in _package_command.outputs(given, SUFFIXES, "a stage"):
        _decode_one(source, output, given)


def _decode_one(source: str, output: str, given: Dict[str, Any]) -> None:
    from pxr import UsdUtils

    from . import usd

    if not output.lower().endswith(SUFFIXES):
        raise Fault(f"{output}: a stage is one of {', '.join(SUFFIXES)}", 1)
    clip, frames = _package_command.opened(source, output, given)
    folder = os.path.dirname(output) or "."
    os.makedirs(folder, exist_ok=True)
    stem, suffix = os.path.splitext(os.path.basename(output))
    with tempfile.TemporaryDirectory(dir=folder) as work:  # so that the output is whole or not there
        path = os.path.join(work, stem + (".usdc" if suffix.lower() == ".usdz" else suffix))
        usd.decode(clip, path, over=given["over"], normals=not given["no_normals"], frames=frames)
        if suffix.lower() == ".usdz":
            packed = os.path.join(work, stem + ".usdz")
            if not UsdUtils.CreateNewUsdzPackage(path, packed):
                raise Fault(f"{output}: cannot be packed", 2)
            path = packed
        os.replace(path, output)
    _package_command.report_decoded(given, output, clip, frames, os.path.getsize(output))


def main(arguments: List[str]) -> int:
    """Encodes or decodes as the arguments say; the exit status of the command."""
    command, batch = arguments[0], _is_batch(arguments)

    def work() -> Optional[int]:
        _package_command.refuse(arguments[1:], _OF_OTHERS[command])
        given = {} if batch else vars(_parser(command).parse_args(arguments[1:]))
        try:
            from . import usd  # noqa: F401
        except ImportError as error:
            place = "--batch" if batch else given["input"] if command == "encode" else given["output"]
            raise Fault(f"{place}: {error}", 4) from None
        if batch:
            return _usd_batch.main(arguments[1:])
        return (_encode if command == "encode" else _decode)(given)

    return _package_command.main(work)
