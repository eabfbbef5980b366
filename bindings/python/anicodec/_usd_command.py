# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""`anicodec encode shot.usd` and `anicodec decode clip.anic -o shot.usd`: the parts of the command line that read and write USD."""
from __future__ import annotations

import argparse
import json
import os
import sys
import tempfile
from typing import Any, Dict, List, NoReturn, Optional

from . import _usd_batch
from ._usd_batch import SUFFIXES
from .clip import Clip, open as open_clip
from .errors import AbsentError, CorruptError, UnsupportedError

_FORMATS = tuple(suffix[1:] for suffix in SUFFIXES)
_ENCODE_USAGE = "%(prog)s STAGE -o FILE.anic [options]\n       %(prog)s --batch DIR|LIST -o DIR [options]"
_DECODE_USAGE = "%(prog)s FILE.anic -o STAGE [options]\n       %(prog)s FILE.anic... --format usdc -o DIR [options]"
#: Options of the command that the package has under the same names, and their types.
_OPTIONS: Dict[str, Any] = {
    **dict.fromkeys(("max-error", "rmse", "kg", "displacement", "sted", "quality", "size", "bpfv", "fps", "basis", "order", "unit", "up",
                     "name", "keyframe-selection", "interpolation", "keyframe-coder", "attribute-error", "massage", "massage-tolerance"), str),
    **dict.fromkeys(("effort", "keyframes", "uv-bits", "colour-bits", "threads"), int),
    **dict.fromkeys(("massage-strength", "store-normals"), float)}
_SWITCHES = ("no-attributes", "lossless", "loop", "smallest", "root-motion")
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
_RENAMED = {"keyframe_selection": "selection", "store_normals": "normal_error", "memory": "max_bytes"}


class _Fault(Exception):
    """A line for the user, and the exit status."""

    def __init__(self, text: str, status: int):
        super().__init__(text)
        self.status = status


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        raise _Fault(f"{message}; `{self.prog} --help` of a stage lists what there is", 1)


def is_meant(arguments: List[str]) -> bool:
    """Whether the command line reads or writes a stage."""
    if arguments[:1] not in (["encode"], ["decode"]):
        return False
    if arguments[0] == "encode" and any(text.split("=")[0] == "--batch" for text in arguments):
        return _usd_batch.is_meant(arguments[1:])
    asked = " ".join(arguments).replace("=", " ").split("--format ")[1:]
    return any(text.lower().endswith(SUFFIXES) for text in arguments[1:]) or any(text.split(" ")[0] in _FORMATS for text in asked)


def _parser(command: str) -> argparse.ArgumentParser:
    encodes = command == "encode"
    parser = _Parser(prog=f"anicodec {command}", usage=_ENCODE_USAGE if encodes else _DECODE_USAGE, allow_abbrev=False,
                     description="Encodes the meshes of a USD stage; `anicodec encode --help` explains the options that other inputs have, too."
                     if encodes else "Writes a clip as a USD stage.")
    parser.add_argument("input", metavar="STAGE" if encodes else "FILE.anic", nargs=None if encodes else "+",
                        help="a stage" if encodes else "clips; - for the standard input")
    parser.add_argument("-o", "--output", required=True, help="the .anic file; - for the standard output" if encodes
                        else "the stage: .usd, .usda, .usdc or .usdz; with --format the folder of the stages")
    parser.add_argument("-f", "--force", action="store_true", help="replace the output")
    parser.add_argument("-q", "--quiet", action="store_true", help="print nothing but errors")
    parser.add_argument("--json", action="store_true", help="print the result as JSON")
    if not encodes:
        parser.add_argument("--format", choices=_FORMATS, help="write each clip to the folder OUTPUT, by its name")
        parser.add_argument("--frames", metavar="A:B[:STEP]", help="frames A to B - 1, every STEP-th (default: all)")
        parser.add_argument("--over", action="store_true", help="to be layered over the stage that was encoded")
        parser.add_argument("--no-normals", action="store_true", help="leave out normals, which programs then take for flat faces")
        parser.add_argument("--clip", help="the clip to write, of a file that has several (default: all, as variants)")
        parser.add_argument("--quality", help="share of the components to use, above 0 to 1", type=float, default=1.0)
        return parser
    parser.add_argument("-v", "--verbose", action="store_true", help="print what is being done")
    parser.add_argument("--mesh", help="path of a prim; its meshes and all below it")
    parser.add_argument("--split-objects", action="store_true", help="what stages do anyway: each mesh is stored apart")
    parser.add_argument("--topology-changes", choices=("refuse", "keep"), help="of frames whose faces differ (default: refuse)")
    parser.add_argument("--origin", help="auto, none or X,Y,Z")
    parser.add_argument("--memory", help="bytes, or 500M or 2G")
    parser.add_argument("--meta", action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument("--meta-file", metavar="FILE.json")
    parser.add_argument("--event", action="append", default=[], metavar="NAME=SECONDS")
    parser.add_argument("-j", dest="threads", type=int)
    for name, kind in _OPTIONS.items():
        parser.add_argument("--" + name, type=kind)
    for name in _SWITCHES:
        parser.add_argument("--" + name, action="store_true", default=None)
    return parser


def _frames(text: str) -> slice:
    try:
        parts = [int(part) if part else None for part in text.split(":")]
        if not 1 <= len(parts) <= 3 or any(part is not None and part < 0 for part in parts) or parts[2:] == [0]:
            raise ValueError
    except ValueError:
        raise _Fault(f"--frames is A:B or A:B:STEP, not {text!r}", 1) from None
    return slice(*parts) if len(parts) > 1 else slice(parts[0], (parts[0] or 0) + 1)


def _pair(text: str, option: str) -> List[str]:
    name, sign, value = text.partition("=")
    if not sign or not name:
        raise _Fault(f"{option} is NAME=VALUE, not {text!r}", 1)
    return [name, value]


def _metadata(meta: List[str], file: Optional[str]) -> Dict[str, Any]:
    found: Dict[str, Any] = {}
    if file is not None:
        with open(file, encoding="utf-8") as opened:
            found = json.load(opened)
        if not isinstance(found, dict):
            raise _Fault(f"{file}: is no JSON object", 2)
    return {**found, **dict(_pair(text, "--meta") for text in meta)}


def _bytes_of(text: str) -> int:
    units = {"k": 10**3, "M": 10**6, "G": 10**9}
    try:
        return int(float(text[:-1]) * units[text[-1]]) if text[-1:] in units else int(text)
    except ValueError:
        raise _Fault(f"--memory is bytes, or 500M or 2G, not {text!r}", 1) from None


def _encoding_options(given: Dict[str, Any]) -> Dict[str, Any]:
    """What is left of the arguments, as usd.encode() takes it."""
    metadata = _metadata(given.pop("meta"), given.pop("meta_file"))
    events = [_pair(text, "--event") for text in given.pop("event")]
    options = {_RENAMED.get(name, name): value for name, value in given.items() if value is not None}
    if "max_bytes" in options:
        options["max_bytes"] = _bytes_of(options["max_bytes"])
    if options.get("origin") not in (None, "auto", "none"):
        options["origin"] = options["origin"].split(",")
    if "massage_tolerance" in options:
        options["massage_tolerance"] = float(options["massage_tolerance"])
    if metadata:
        options["metadata"] = metadata
    if events:
        options["events"] = [(name, float(seconds)) for name, seconds in events]
    return options


def _write(path: str, data: bytes) -> None:
    os.makedirs(os.path.dirname(path) or ".", exist_ok=True)
    beside = path + ".part"
    with open(beside, "wb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())
    os.replace(beside, path)


def _report(path: str, data: Any, asked: bool) -> Dict[str, Any]:
    """What --json prints of any other input, as far as it is known here."""
    clip = open_clip(bytes(data))
    measured = data.measured
    vertices = sum(mesh.vertex_count for mesh in clip.meshes)
    shown = sum(mesh.vertex_count * sum(map(mesh.shown_in, range(len(clip)))) for mesh in clip.meshes)
    return {"file": path, "bytes": len(data), "ratio": 12 * shown / len(data), "bpfv": 8 * len(data) / max(shown, 1), "vertices": vertices,
            "faces": sum(len(mesh.polygons[0]) - 1 for mesh in clip.meshes), "frames": len(clip), "fps": float(clip.fps),
            "fps_from": "asked" if asked else "source", "components": measured["components"], "kg": measured["kg"],
            "rmse": measured["rmse"], "max_displacement_error": measured["max_displacement_error"], "max_error": measured["max_error"],
            "max_error_percent": 100 * measured["max_error"] / measured["diagonal"] if measured["diagonal"] else 0,
            "diagonal": measured["diagonal"], "massaged": measured["massaged"], "surface_error": measured["surface_error"],
            "notes": list(data.notes)}


def _encode(given: Dict[str, Any]) -> None:
    from . import usd

    stage, output, prim = given.pop("input"), given.pop("output"), given.pop("mesh")
    force, quiet, as_json, verbose = (given.pop(name) for name in ("force", "quiet", "json", "verbose"))
    del given["split_objects"]
    options = _encoding_options(given)
    if output != "-" and not output.lower().endswith(".anic"):
        raise _Fault(f"{output}: the output is an .anic file, or -", 1)
    if output != "-" and os.path.exists(output) and not force:
        raise _Fault(f"{output}: exists (-f replaces it)", 1)
    if verbose:
        last = [""]

        def progress(stage_of_work: str, _: float) -> bool:
            if stage_of_work != last[0]:
                print(f"  {stage_of_work}", file=sys.stderr)
                last[0] = stage_of_work
            return True

        options["progress"] = progress
    try:
        data = usd.encode(stage, prim, **options)
    except (ValueError, MemoryError) as error:
        text = str(error)
        raise _Fault(text if text.startswith(stage) else f"{stage}: {text}", 2) from None
    if output == "-":
        sys.stdout.buffer.write(data)
        return
    _write(output, data)
    report = _report(output, data, "fps" in options)
    if as_json:
        print(json.dumps(report, separators=(",", ":"), ensure_ascii=False))
    elif not quiet:
        for note in data.notes:
            print(f"{stage}: {note}", file=sys.stderr)
        print(f"{output}: {len(data)} bytes, {report['ratio']:.3g} : 1, {report['bpfv']:.6g} bpfv; {report['frames']} frames at "
              f"{report['fps']:.6g} fps ({report['fps_from']}); max error {report['max_error']:.4g} ({report['max_error_percent']:.3g} %), "
              f"KG {report['kg']:.3g} %")


def _opened(source: str, given: Dict[str, Any]) -> Clip:
    try:
        if source == "-":
            data = sys.stdin.buffer.read()
        else:
            with open(source, "rb") as file:
                data = file.read()
        return Clip(data, quality=given["quality"], clips=[given["clip"]] if given["clip"] not in (None, "all") else ())
    except (CorruptError, UnsupportedError) as error:
        raise _Fault(f"{source}: {error}", 3 if isinstance(error, CorruptError) else 4) from None
    except (ValueError, MemoryError, AbsentError) as error:
        raise _Fault(f"{source}: {error}", 2) from None


def _decode(given: Dict[str, Any]) -> None:
    sources, output, suffix = given["input"], given["output"], given["format"]
    if suffix is None and len(sources) > 1:
        raise _Fault(f"{sources[1]}: several files need --format", 1)
    for source in sources:
        if source.lower().endswith(SUFFIXES):
            raise _Fault(f"{source}: a stage is no .anic file", 2)
    if suffix is None:
        _decode_one(sources[0], output, given)
    for source in sources if suffix else []:
        name = os.path.splitext(os.path.basename(source))[0] if source != "-" else "clip"
        _decode_one(source, os.path.join(output, f"{name}.{suffix}"), given)


def _decode_one(source: str, output: str, given: Dict[str, Any]) -> None:
    from pxr import UsdUtils

    from . import usd

    if not output.lower().endswith(SUFFIXES):
        raise _Fault(f"{output}: a stage is one of {', '.join(SUFFIXES)}", 1)
    if os.path.exists(output) and not given["force"]:
        raise _Fault(f"{output}: exists (-f replaces it)", 1)
    clip = _opened(source, given)
    frames = _frames(given["frames"]) if given["frames"] else slice(None)
    count = len(range(len(clip))[frames])
    if not count:
        raise _Fault(f"{source}: --frames {given['frames']}: it has {len(clip)} frames", 1)
    folder = os.path.dirname(output) or "."
    os.makedirs(folder, exist_ok=True)
    stem, suffix = os.path.splitext(os.path.basename(output))
    with tempfile.TemporaryDirectory(dir=folder) as work:  # so that the output is whole or not there
        path = os.path.join(work, stem + (".usdc" if suffix.lower() == ".usdz" else suffix))
        usd.decode(clip, path, over=given["over"], normals=not given["no_normals"], frames=frames)
        if suffix.lower() == ".usdz":
            packed = os.path.join(work, stem + ".usdz")
            if not UsdUtils.CreateNewUsdzPackage(path, packed):
                raise _Fault(f"{output}: cannot be packed", 2)
            path = packed
        os.replace(path, output)
    meshes = len(clip.meshes)
    if given["json"]:
        print(json.dumps({"file": output, "frames": count, "meshes": meshes, "bytes": os.path.getsize(output)}, separators=(",", ":")))
    elif not given["quiet"]:
        print(f"{output}: {count} frames of {meshes} {'mesh' if meshes == 1 else 'meshes'}, {os.path.getsize(output)} bytes")


def main(arguments: List[str]) -> int:
    """Encodes or decodes as the arguments say; the exit status of the command."""
    command, batch = arguments[0], any(text.split("=")[0] == "--batch" for text in arguments)
    try:
        for text in arguments[1:]:
            reason = _OF_OTHERS[command].get(text.split("=")[0])
            if reason:
                raise _Fault(f"{text.split('=')[0]}: {reason}", 1)
        given = {} if batch else vars(_parser(command).parse_args(arguments[1:]))
        try:
            from . import usd  # noqa: F401
        except ImportError as error:
            place = "--batch" if batch else given["input"] if command == "encode" else given["output"]
            raise _Fault(f"{place}: {error}", 4) from None
        if batch:
            return _usd_batch.main(arguments[1:])
        (_encode if command == "encode" else _decode)(given)
    except _Fault as fault:
        print(f"anicodec: {fault}", file=sys.stderr)
        return fault.status
    except OSError as error:
        print(f"anicodec: {error.filename or ''}: {error.strerror or error}", file=sys.stderr)
        return 1
    return 0
