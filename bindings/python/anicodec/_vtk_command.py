# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""`anicodec encode run.pvd` and `anicodec decode clip.anic -o run.pvd`: the parts of the command line for results of simulations."""
from __future__ import annotations

import functools
import os
import shutil
import tempfile
from typing import Any, Dict, List, Tuple, Union

from . import _arrays_file, _package_command
from ._package_command import Fault, Parser

#: Suffixes that VTK reads; here, as its package may be missing.
_READ = (".vtk", ".vtp", ".vtu", ".vts", ".vtr", ".vti", ".vtm", ".pvtp", ".pvtu", ".pvts", ".pvtr", ".pvti", ".pvd", ".series",
         ".vtkhdf", ".xdmf", ".xmf", ".case", ".e", ".exo", ".ex2")
_WRITTEN = (".pvd", ".vtkhdf", ".xdmf", ".npz")
_ENCODE_USAGE = "%(prog)s STEPS... -o FILE.anic [options]"
_DECODE_USAGE = "%(prog)s FILE.anic -o STEPS [options]\n       %(prog)s FILE.anic... --format vtkhdf -o DIR [options]"


def is_meant(arguments: List[str]) -> bool:
    """Whether the command line reads or writes results of simulations, or arrays."""
    return _package_command.is_meant(arguments, (*_READ, *_arrays_file.SUFFIXES))


def _parser(command: str) -> Parser:
    if command == "decode":
        parser = Parser(command, "results of simulations", _WRITTEN, usage=_DECODE_USAGE,
                        description="Writes the frames of a clip, with its fields, as .pvd with a folder of .vtp files, as .vtkhdf, as .xdmf with "
                        "an .h5 file, or one mesh as .npz.")
        parser.add_argument("--clip", help="the clip to write, of a file that has several")
        return parser
    parser = Parser(command, "results of simulations", (), usage=_ENCODE_USAGE,
                    description="Encodes a series of steps that VTK reads, or arrays of numpy; `anicodec encode --help` explains the options "
                    "that other inputs have, too.")
    parser.add_argument("input", metavar="STEPS", nargs="+", help="a file with times, a quoted pattern ('run_*.vtu'), or a file for each step")
    parser.add_argument("--fields", help="names of fields to keep, with commas, or none (default: all)")
    parser.add_argument("--warp", metavar="NAME[:SCALE]", help="move the points by a vector field")
    parser.add_argument("--all-points", action="store_true", default=None, help="keep points that no face has")
    parser.add_argument("--faces", metavar="FILE.npy", help="polygons x corners, for positions in a .npy file")
    return parser


def _warp_of(text: str) -> Union[str, Tuple[str, float]]:
    name, sign, scale = text.rpartition(":")
    if not sign:
        return text
    try:
        return name, float(scale)
    except ValueError:  # a name with a colon
        return text


def _encode(given: Dict[str, Any]) -> None:
    inputs, faces = given.pop("input"), given.pop("faces")
    if given["warp"] is not None:
        given["warp"] = _warp_of(given["warp"])
    if inputs[0].lower().endswith(_arrays_file.SUFFIXES):
        if len(inputs) > 1:
            raise Fault(f"{inputs[1]}: arrays are in one file; --faces names that of the faces", 1)
        return _package_command.encode(given, inputs[0], functools.partial(_arrays_file.encode, inputs[0], faces))
    if faces is not None:
        raise Fault(f"{inputs[0]}: --faces goes with positions in a .npy file", 1)
    try:
        from . import vtk
    except ImportError as error:
        raise Fault(f"{inputs[0]}: {error}", 4) from None
    _package_command.encode(given, inputs[0], functools.partial(vtk.encode, inputs))


def _decode(given: Dict[str, Any]) -> None:
    for source, output in _package_command.outputs(given, (*_READ, *_arrays_file.SUFFIXES), "a result of a simulation"):
        _decode_one(source, output, given)


def _decode_one(source: str, output: str, given: Dict[str, Any]) -> None:
    suffix = os.path.splitext(output)[1].lower()
    if suffix not in _WRITTEN:
        raise Fault(f"{output}: is not written; {', '.join(_WRITTEN)} are", 1)
    clip, frames = _package_command.opened(source, output, given)
    try:
        if suffix == ".npz":
            write: Any = _arrays_file.decode
        else:
            from .vtk import decode as write
        folder = os.path.dirname(output) or "."
        os.makedirs(folder, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=folder) as work:  # so that the output is whole or not there
            notes = write(clip, os.path.join(work, os.path.basename(output)))
            # The file that names the others comes last.
            for name in sorted(os.listdir(work), key=lambda name: name == os.path.basename(output)):
                _replace(os.path.join(work, name), os.path.join(folder, name), given["force"])
    except ImportError as error:
        raise Fault(f"{output}: {error}", 4) from None
    except (ValueError, MemoryError) as error:
        raise Fault(f"{source}: {error}", 2) from None
    size = sum(_size(path) for path in (output, os.path.splitext(output)[0], os.path.splitext(output)[0] + ".h5") if os.path.exists(path))
    _package_command.report_decoded(given, output, clip, frames, size, notes)


def _replace(source: str, target: str, force: bool) -> None:
    if os.path.exists(target) and not force:
        raise Fault(f"{target}: exists (-f replaces it)", 1)
    if os.path.isdir(target):
        shutil.rmtree(target)
    os.replace(source, target)


def _size(path: str) -> int:
    return sum(os.path.getsize(os.path.join(path, name)) for name in os.listdir(path)) if os.path.isdir(path) else os.path.getsize(path)


def main(arguments: List[str]) -> int:
    """Encodes or decodes as the arguments say; the exit status of the command."""
    work = _encode if arguments[0] == "encode" else _decode
    return _package_command.main(lambda: work(vars(_parser(arguments[0]).parse_args(arguments[1:]))))
