# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Parts of the command line that are the package's: inputs and outputs that need other packages of Python."""
from __future__ import annotations

import argparse
import json
import os
import sys
from typing import Any, Callable, Dict, Iterator, List, NoReturn, Optional, Sequence, Tuple

from ._options import COMMAND
from .clip import Clip, open as open_clip
from .errors import AbsentError, CorruptError, UnsupportedError

#: Options of the command that the package has under the same names, and their types.
_OPTIONS: Dict[str, Any] = {**COMMAND, "name": str, "threads": int}

#: Options whose value may look like the name of such a file.
_OF_TEXT = ("--meta", "--name", "--event", "--clip", "--clips", "--field-error", "--field-unit")


class Fault(Exception):
    """A line for the user, and the exit status."""

    def __init__(self, text: str, status: int):
        super().__init__(text)
        self.status = status


class Parser(argparse.ArgumentParser):
    """The arguments that every such input has, and every such output."""

    def __init__(self, command: str, kind: str, formats: Sequence[str], **others: Any):
        super().__init__(prog=f"anicodec {command}", allow_abbrev=False, **others)
        self._kind = kind
        encodes = command == "encode"
        self.add_argument("-o", "--output", required=True, help="the .anic file; - for the standard output" if encodes
                          else f"a file of {', '.join(formats)}; with --format the folder of the files")
        self.add_argument("-f", "--force", action="store_true", help="replace the output")
        self.add_argument("-q", "--quiet", action="store_true", help="print nothing but errors")
        self.add_argument("--json", action="store_true", help="print the result as JSON")
        if encodes:
            self._add_encoding()
            return
        self.add_argument("input", metavar="FILE.anic", nargs="+", help="clips; - for the standard input")
        self.add_argument("--format", choices=[suffix[1:] for suffix in formats], help="write each clip to the folder OUTPUT, by its name")
        self.add_argument("--quality", help="share of the components to use, above 0 to 1", type=float, default=1.0)

    def _add_encoding(self) -> None:
        self.add_argument("-v", "--verbose", action="store_true", help="print what is being done")
        self.add_argument("--topology-changes", choices=("refuse", "keep"), help="of frames whose faces differ (default: refuse)")
        self.add_argument("--origin", help="auto, none or X,Y,Z")
        self.add_argument("--memory", help="bytes, or 500M or 2G")
        self.add_argument("--meta", action="append", default=[], metavar="KEY=VALUE")
        self.add_argument("--meta-file", metavar="FILE.json")
        self.add_argument("--event", action="append", default=[], metavar="NAME=SECONDS")
        self.add_argument("--field-error", action="append", default=[], metavar="NAME=X|exact")
        self.add_argument("--field-unit", action="append", default=[], metavar="NAME=TEXT")
        self.add_argument("-j", dest="threads", type=int)
        for name, kind in _OPTIONS.items():
            if kind is bool:
                self.add_argument("--" + name, action="store_true", default=None)
            else:
                self.add_argument("--" + name, type=kind)

    def error(self, message: str) -> NoReturn:
        raise Fault(f"{message}; `{self.prog} --help` of {self._kind} lists what there is", 1)


def is_meant(arguments: Sequence[str], suffixes: Sequence[str]) -> bool:
    """Whether the command line reads or writes files with one of the suffixes."""
    if list(arguments[:1]) not in (["encode"], ["decode"]):
        return False
    asked = " ".join(arguments).replace("=", " ").split("--format ")[1:]
    names = [text for before, text in zip(arguments, arguments[1:]) if before not in _OF_TEXT and text.split("=")[0] not in _OF_TEXT]
    return any(text.lower().endswith(tuple(suffixes)) for text in names) or any("." + text.split(" ")[0] in suffixes for text in asked)


def refuse(arguments: Sequence[str], of_others: Dict[str, str]) -> None:
    """Refuses options of the command that such files have no use for, by the reasons given."""
    for text in arguments:
        reason = of_others.get(text.split("=")[0])
        if reason:
            raise Fault(f"{text.split('=')[0]}: {reason}", 1)


def _pair(text: str, option: str) -> List[str]:
    name, sign, value = text.partition("=")
    if not sign or not name:
        raise Fault(f"{option} is NAME=VALUE, not {text!r}", 1)
    return [name, value]


def _metadata(meta: List[str], file: Optional[str]) -> Dict[str, Any]:
    found: Dict[str, Any] = {}
    if file is not None:
        with open(file, encoding="utf-8") as opened:
            found = json.load(opened)
        if not isinstance(found, dict):
            raise Fault(f"{file}: is no JSON object", 2)
    return {**found, **dict(_pair(text, "--meta") for text in meta)}


def _bytes_of(text: str) -> int:
    units = {"k": 10**3, "M": 10**6, "G": 10**9}
    try:
        return int(float(text[:-1]) * units[text[-1]]) if text[-1:] in units else int(text)
    except ValueError:
        raise Fault(f"--memory is bytes, or 500M or 2G, not {text!r}", 1) from None


def _encoding_options(given: Dict[str, Any]) -> Dict[str, Any]:
    """The rest of the arguments, as functions of the package take it."""
    metadata = _metadata(given.pop("meta"), given.pop("meta_file"))
    events = [_pair(text, "--event") for text in given.pop("event")]
    bounds, units = (dict(_pair(text, "--" + name.replace("_", "-")) for text in given.pop(name)) for name in ("field_error", "field_unit"))
    options = {name: value for name, value in given.items() if value is not None}
    if "memory" in options:
        options["max_bytes"] = _bytes_of(options.pop("memory"))
    if options.get("origin") not in (None, "auto", "none"):
        options["origin"] = options["origin"].split(",")
    options.update({name: value for name, value in (("field_errors", bounds), ("field_units", units)) if value})
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
    """The report that --json prints of any other input, as far as it is known here."""
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


def _progress() -> Callable[[str, float], bool]:
    last = [""]

    def progress(stage: str, _: float) -> bool:
        if stage != last[0]:
            print(f"  {stage}", file=sys.stderr)
            last[0] = stage
        return True

    return progress


def encode(given: Dict[str, Any], source: str, encoded: Callable[..., Any]) -> None:
    """Writes and reports what encoded(**options) gives; what `given` holds beside the arguments of Parser goes to it, too."""
    output = given.pop("output")
    force, quiet, as_json, verbose = (given.pop(name) for name in ("force", "quiet", "json", "verbose"))
    options = _encoding_options(given)
    if output != "-" and not output.lower().endswith(".anic"):
        raise Fault(f"{output}: the output is an .anic file, or -", 1)
    if output != "-" and os.path.exists(output) and not force:
        raise Fault(f"{output}: exists (-f replaces it)", 1)
    if verbose:
        options["progress"] = _progress()
    try:
        data = encoded(**options)
    except (ValueError, MemoryError) as error:
        text = str(error)
        raise Fault(text if text.startswith(source) else f"{source}: {text}", 2) from None
    if output == "-":
        sys.stdout.buffer.write(data)
        return
    _write(output, data)
    report = _report(output, data, "fps" in options)
    if as_json:
        print(json.dumps(report, separators=(",", ":"), ensure_ascii=False))
    elif not quiet:
        for note in data.notes:
            print(f"{source}: {note}", file=sys.stderr)
        print(f"{output}: {len(data)} bytes, {report['ratio']:.3g} : 1, {report['bpfv']:.6g} bpfv; {report['frames']} frames at "
              f"{report['fps']:.6g} fps ({report['fps_from']}); max error {report['max_error']:.4g} ({report['max_error_percent']:.3g} %), "
              f"KG {report['kg']:.3g} %")


def outputs(given: Dict[str, Any], suffixes: Sequence[str], kind: str) -> Iterator[Tuple[str, str]]:
    """The clips to decode, each with its output."""
    sources, output, suffix = given["input"], given["output"], given["format"]
    if suffix is None and len(sources) > 1:
        raise Fault(f"{sources[1]}: several files need --format", 1)
    for source in sources:
        if source.lower().endswith(tuple(suffixes)):
            raise Fault(f"{source}: {kind} is no .anic file", 2)
    for source in sources:
        name = os.path.splitext(os.path.basename(source))[0] if source != "-" else "clip"
        yield source, os.path.join(output, f"{name}.{suffix}") if suffix else output


def opened(source: str, output: str, given: Dict[str, Any]) -> Tuple[Clip, slice]:
    """The clip to decode and the frames asked for, where the output may be written."""
    if os.path.exists(output) and not given["force"]:
        raise Fault(f"{output}: exists (-f replaces it)", 1)
    try:
        if source == "-":
            data = sys.stdin.buffer.read()
        else:
            with open(source, "rb") as file:
                data = file.read()
        clip = Clip(data, quality=given["quality"], clips=[given["clip"]] if given["clip"] not in (None, "all") else ())
    except (CorruptError, UnsupportedError) as error:
        raise Fault(f"{source}: {error}", 3 if isinstance(error, CorruptError) else 4) from None
    except (ValueError, MemoryError, AbsentError) as error:
        raise Fault(f"{source}: {error}", 2) from None
    frames = _frames(given["frames"]) if given.get("frames") else slice(None)
    if not range(len(clip))[frames]:
        raise Fault(f"{source}: --frames {given['frames']}: it has {len(clip)} frames", 1)
    return clip, frames


def _frames(text: str) -> slice:
    try:
        parts = [int(part) if part else None for part in text.split(":")]
        if not 1 <= len(parts) <= 3 or any(part is not None and part < 0 for part in parts) or parts[2:] == [0]:
            raise ValueError
    except ValueError:
        raise Fault(f"--frames is A:B or A:B:STEP, not {text!r}", 1) from None
    return slice(*parts) if len(parts) > 1 else slice(parts[0], (parts[0] or 0) + 1)


def report_decoded(given: Dict[str, Any], output: str, clip: Clip, frames: slice, size: int, notes: Sequence[str] = ()) -> None:
    """Tells what was written."""
    meshes, count = len(clip.meshes), len(range(len(clip))[frames])
    if given["json"]:
        print(json.dumps({"file": output, "frames": count, "meshes": meshes, "bytes": size, "notes": list(notes)}, separators=(",", ":")))
    elif not given["quiet"]:
        for note in notes:
            print(f"{output}: {note}", file=sys.stderr)
        print(f"{output}: {count} frames of {meshes} {'mesh' if meshes == 1 else 'meshes'}, {size} bytes")


def main(work: Callable[[], Optional[int]]) -> int:
    """Does some work; the exit status of the command."""
    try:
        status = work()
    except Fault as fault:
        print(f"anicodec: {fault}", file=sys.stderr)
        return fault.status
    except OSError as error:
        print(f"anicodec: {error.filename or ''}: {error.strerror or error}", file=sys.stderr)
        return 1
    return status or 0
