# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""`anicodec encode run.pvd` and `anicodec decode clip.anic -o run.pvd`: the parts of the command line for results of simulations."""
from __future__ import annotations

import functools
from typing import Any, Dict, List, Tuple, Union

from . import _arrays_file, _package_command
from ._package_command import Fault, Parser

#: Of files that VTK reads; here, as its package may be missing.
_READ = (".vtk", ".vtp", ".vtu", ".vts", ".vtr", ".vti", ".vtm", ".pvtp", ".pvtu", ".pvts", ".pvtr", ".pvti", ".pvd", ".series",
         ".vtkhdf", ".xdmf", ".xmf", ".case", ".e", ".exo", ".ex2")
_ENCODE_USAGE = "%(prog)s STEPS... -o FILE.anic [options]"


def is_meant(arguments: List[str]) -> bool:
    """Whether the command line reads or writes results of simulations, or arrays."""
    return _package_command.is_meant(arguments, (*_READ, *_arrays_file.SUFFIXES))


def _parser(command: str) -> Parser:
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


def main(arguments: List[str]) -> int:
    """Encodes or decodes as the arguments say; the exit status of the command."""
    return _package_command.main(lambda: _encode(vars(_parser(arguments[0]).parse_args(arguments[1:]))))
