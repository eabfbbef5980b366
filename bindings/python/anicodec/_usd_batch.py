# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""`anicodec encode --batch FOLDER -o OUT` with stages of USD among the clips."""
from __future__ import annotations

import argparse
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
from typing import Any, Dict, List, Optional, Tuple

from . import _anicodec
from ._batch import Job, is_done, key_of, note

SUFFIXES = (".usd", ".usda", ".usdc", ".usdz")
#: Files of other kinds that are clips, alone or as one of several frames.
_OTHERS = (".obj", ".ply", ".off", ".stl", ".pc2", ".mdd", ".gltf", ".glb", ".fbx", ".md3", ".abc", ".dae", ".md2", ".3ds", ".b3d", ".ms3d", ".smd",
           ".x", ".lwo")


def _arguments(arguments: List[str]) -> Tuple[argparse.Namespace, List[str]]:
    """The options of the batch, and the options of each clip."""
    parser = argparse.ArgumentParser(prog="anicodec encode", add_help=False, allow_abbrev=False)
    parser.add_argument("--batch")
    parser.add_argument("-o", "--output")
    parser.add_argument("-j", "--threads", type=int)
    for names in (("-f", "--force"), ("-q", "--quiet"), ("-v", "--verbose"), ("--json",), ("--split-objects",)):
        parser.add_argument(*names, action="store_true")
    return parser.parse_known_args(arguments)


def is_meant(arguments: List[str]) -> bool:
    """Whether stages are among the clips."""
    try:
        return bool(_clips(_arguments(arguments)[0].batch or "")[0])
    except (OSError, SystemExit):
        return False  # which the command explains


def _clips(source: str) -> Tuple[Dict[str, str], List[str]]:
    """Stages by name, and lines of others, of a list; or the folder, where other clips may be in it."""
    stages: Dict[str, str] = {}
    others: List[str] = []
    if os.path.isdir(source):
        for path in sorted(pathlib.Path(source).rglob("*")):
            if path.name.lower().endswith(SUFFIXES):
                stages[str(path.relative_to(source).with_suffix(""))] = str(path)
            elif path.name.lower().endswith(_OTHERS):
                others = [source]
    elif os.path.exists(source):
        for line in pathlib.Path(source).read_text(encoding="utf-8", errors="surrogateescape").splitlines():
            if line.lower().endswith(SUFFIXES) and not line.startswith("#"):
                stages[pathlib.Path(line).stem] = line
            elif line and not line.startswith("#"):
                others.append(line)
    return stages, others


def _used_by_others(stages: Dict[str, str]) -> Dict[str, str]:
    """Layers that a stage of the batch has, and so are no clips of their own."""
    from pxr import Sdf, UsdUtils

    used: Dict[str, str] = {}
    for path in stages.values():
        try:
            layers = UsdUtils.ComputeAllDependencies(Sdf.AssetPath(path))[0]
        except Exception:  # encoding it says what is wrong
            continue
        used.update({os.path.realpath(layer.realPath): path for layer in layers if os.path.realpath(layer.realPath) != os.path.realpath(path)})
    return used


class _Batch:
    """Encodes stages side by side, each in a process of its own."""

    def __init__(self, given: argparse.Namespace, options: List[str], stages: Dict[str, str]):
        self._given, self._options = given, options
        self._jobs = [Job(name, (os.path.abspath(path),), os.path.join(given.output, name + ".anic")) for name, path in stages.items()]
        self._count = {"encoded": 0, "done_before": 0, "failed": 0, "bytes": 0}
        self._lock, self._finished, self.status = threading.Lock(), 0, 0

    def run(self) -> None:
        cores = os.cpu_count() or 1
        side_by_side = min(self._given.threads or cores, len(self._jobs)) or 1
        threads = ["-j", str(max(1, cores // side_by_side))]
        with concurrent.futures.ThreadPoolExecutor(side_by_side) as pool:
            for _ in pool.map(lambda job: self._tell(job, *self._encode(job, threads)), self._jobs):
                pass
        told = {**self._count, "folder": self._given.output}
        print(json.dumps(told, separators=(",", ":")) if self._given.json else
              f"{told['encoded']} encoded, {told['done_before']} done before, {told['failed']} failed; {told['bytes']} bytes in {told['folder']}")

    def _encode(self, job: Job, threads: List[str]) -> Tuple[int, Optional[Dict[str, Any]], str]:
        """Exit status, what is known of the clip, and a fault."""
        key = key_of(job, self._options, None)
        if is_done(job, key):
            return 0, {"bytes": os.path.getsize(job.output), "done_before": True, "notes": []}, ""
        force = ["-f"] if self._given.force or job.record.exists() else []
        command = [sys.executable, "-m", "anicodec", "encode", job.inputs[0], "-o", job.output, "--json", *force, *threads, *self._options]
        result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, errors="replace")
        if result.returncode != 0:
            return result.returncode, None, ([f"exit status {result.returncode}"] + result.stderr.strip().splitlines())[-1]
        job.record.parent.mkdir(parents=True, exist_ok=True)
        note(job, key)
        return 0, {**json.loads(result.stdout), "done_before": False}, ""

    def _tell(self, job: Job, status: int, report: Optional[Dict[str, Any]], fault: str) -> None:
        with self._lock:
            self._finished += 1
            self._count["failed" if report is None else "done_before" if report["done_before"] else "encoded"] += 1
            self._count["bytes"] += report["bytes"] if report else 0
            self.status = self.status or status
            if self._given.json:
                print(json.dumps({"clip": job.name, "error": fault, "status": status} if report is None else
                                 {"clip": job.name, **report, "file": job.output}, ensure_ascii=False, separators=(",", ":")), flush=True)
                return
            if report is None:
                text = f"FAILED: {fault.removeprefix('anicodec: ')}"
            elif report["done_before"]:
                text = f"{report['bytes']} bytes, done before"
            else:
                text = (f"{report['bytes']} bytes, {report['ratio']:.1f} : 1, {report['vertices']} vertices x {report['frames']} frames, "
                        f"max error {report['max_error']:.4g}, KG {report['kg']:.3g} %")
            if report is None or not self._given.quiet:
                print(f"[{self._finished}/{len(self._jobs)}] {job.name}: {text}")
                for line in report["notes"] if report else []:
                    print(f"  {line}")
                sys.stdout.flush()


def main(arguments: List[str]) -> int:
    """Encodes the stages, then all others; the exit status."""
    given, options = _arguments(arguments)
    if not given.output:
        print("anicodec: --output is required", file=sys.stderr)
        return 1
    stages, others = _clips(given.batch)
    used = _used_by_others(stages)
    left = {name: path for name, path in stages.items() if os.path.realpath(path) not in used}
    if len(left) < len(stages) and not given.quiet and not given.json:
        count = len(stages) - len(left)
        print(f"{count} {'stage' if count == 1 else 'stages'} of {given.batch} that others are made of {'is' if count == 1 else 'are'} left out")
    batch = _Batch(given, options, left)
    batch.run()
    if not others:
        return batch.status
    sys.stdout.flush()
    with tempfile.NamedTemporaryFile("w", suffix=".txt", encoding="utf-8", errors="surrogateescape") as rest:
        rest.write("\n".join(others) + "\n")
        rest.flush()
        source = others[0] if os.path.isdir(given.batch) else rest.name
        flags = [flag for flag, on in (("-f", given.force), ("-q", given.quiet), ("--json", given.json), ("--split-objects", given.split_objects)) if on]
        threads = ["-j", str(given.threads)] if given.threads else []
        command = ["anicodec", "encode", "--batch", source, "-o", given.output, *flags, *threads, *options]
        status = _anicodec.run_command([os.fsencode(text) for text in command])
    return batch.status or status
