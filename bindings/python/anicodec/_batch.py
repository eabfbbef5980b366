# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Many clips on many machines, by dask. Needs the extra: pip install 'anicodec[dask]'."""
from __future__ import annotations

import glob
import hashlib
import json
import os
import pathlib
import struct
import subprocess
import sys
from dataclasses import dataclass
from typing import Any, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Union

from ._anicodec import version
from .errors import AnicodecError, InputError

#: Workers that declare this resource, in bytes, are given no more clips at once than fit.
MEMORY = "ANICODEC_MEMORY"
_COPIES = 3  # of its positions that encoding a clip holds
RECORDS = ".anicodec"  # folder of what was done, in the folder of the results

Inputs = Union[str, os.PathLike, Sequence[Union[str, os.PathLike]]]


class ClipFailed(AnicodecError, RuntimeError):
    """The command could not encode a clip, for no fault of its input: its line."""


@dataclass(frozen=True)
class _Refused:
    """The result of a task for a clip whose input or options are at fault: dask logs a traceback of whatever a task
    raises."""

    line: str


@dataclass(frozen=True)
class Result:
    """The outcome for a clip."""

    name: str
    path: str
    status: str  #: "done", "kept" (it was done before) or "failed"
    size: int = 0  #: bytes of the file
    error: str = ""  #: of a failed one


def batch(clips: Union[Iterable[Inputs], Mapping[str, Inputs]], out: Union[str, os.PathLike], *, client: Any = None,
          part_frames: Optional[int] = None, retries: int = 1, **options: Any) -> List[Result]:
    """Encodes many clips to a folder, each to NAME.anic, on the workers of a dask client.

    clips: inputs as of `anicodec encode`, one path or several for each clip, by name or with the name of the last path.
    client: a dask.distributed.Client, whose workers see the same files; default one on this machine. part_frames:
    vertex caches of more frames are encoded in parts of as many, side by side, and joined. retries: of a task whose
    worker failed, or had no memory; a clip whose input is at fault is listed at once. options: those of the command, as
    max_error="0.1%" or no_attributes=True.

    Clips are left alone that were done before, by the content of inputs and result. Workers with the resource
    ANICODEC_MEMORY, in bytes, take no more at once than fit. Returns a Result for each clip, in order; raises
    InputError for names that are not unique, and nothing for clips that fail.
    """
    try:
        from dask.distributed import Client, LocalCluster
    except ImportError as error:
        raise ImportError("dask needs the extra of the package: pip install 'anicodec[dask]'") from error
    jobs = _jobs(clips, pathlib.Path(out).resolve())
    (pathlib.Path(out) / RECORDS).mkdir(parents=True, exist_ok=True)
    arguments = _arguments(options)
    if client is not None:
        return _run(client, jobs, arguments, part_frames, retries)
    memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 2
    cores = os.cpu_count() or 1
    with LocalCluster(n_workers=1, threads_per_worker=cores, processes=False, dashboard_address=":0",
                      resources={MEMORY: memory}) as cluster, Client(cluster) as own:
        return _run(own, jobs, [*arguments, "-j", "1"], part_frames, retries)


@dataclass(frozen=True)
class Job:
    name: str
    inputs: Tuple[str, ...]
    output: str

    @property
    def record(self) -> pathlib.Path:
        return pathlib.Path(self.output).parent / RECORDS / (self.name + ".json")


def _jobs(clips: Any, out: pathlib.Path) -> List[Job]:
    named = list(clips.items()) if isinstance(clips, Mapping) else [(None, inputs) for inputs in clips]
    jobs: List[Job] = []
    for name, inputs in named:
        paths = [inputs] if isinstance(inputs, (str, os.PathLike)) else list(inputs)
        if not paths:
            raise InputError("a clip has no inputs")
        texts = tuple(os.path.abspath(os.fspath(path)) for path in paths)
        name = name or pathlib.Path(texts[-1]).stem
        if os.sep in name or name in (".", ".."):
            raise InputError(f"{name!r} is no name of a file")
        jobs.append(Job(name, texts, str(out / (name + ".anic"))))
    twice = {job.name for job in jobs if sum(other.name == job.name for other in jobs) > 1}
    if twice:
        raise InputError(f"several clips have the name {sorted(twice)[0]!r}: give each its own")
    return jobs


def _arguments(options: Mapping[str, Any]) -> List[str]:
    result = []
    for name, value in sorted(options.items()):
        if value is True:
            result.append("--" + name.replace("_", "-"))
        elif value is not None and value is not False:
            result += ["--" + name.replace("_", "-"), str(value)]
    return result


def _run(client: Any, jobs: List[Job], arguments: List[str], part_frames: Optional[int], retries: int) -> List[Result]:
    workers = client.scheduler_info(n_workers=-1)["workers"].values()
    limits = [worker.get("resources", {}).get(MEMORY) for worker in workers]
    limit = max(limits) if limits and all(limits) else None  # of the largest worker

    def submit(function: Any, job: Job, *rest: Any, memory: int) -> Any:
        resources = {MEMORY: min(memory, limit)} if limit else None
        return client.submit(function, job, *rest, retries=retries, pure=False, resources=resources)

    futures = []
    for job in jobs:
        frames, size = _frames_and_size(job.inputs)
        if not part_frames or frames <= part_frames:
            futures.append(submit(_encode_clip, job, arguments, part_frames, memory=_COPIES * size))
            continue
        if is_done(job, key_of(job, arguments, part_frames)):
            futures.append(submit(_encode_clip, job, arguments, part_frames, memory=0))
            continue
        parts = []
        for first in range(0, frames, part_frames):
            end = min(first + part_frames, frames)
            memory = size + (_COPIES - 1) * size * (end - first) // frames  # every part reads the whole clip
            parts.append(submit(_encode_part, job, arguments, first, end, memory=memory))
        futures.append(submit(_join_parts, job, arguments, part_frames, parts, memory=0))
    return [_result(job, future) for job, future in zip(jobs, futures)]


def _result(job: Job, future: Any) -> Result:
    error = future.exception()
    if error is not None:
        return Result(job.name, job.output, "failed", 0, str(error) or type(error).__name__)
    outcome = future.result()
    if isinstance(outcome, _Refused):
        return Result(job.name, job.output, "failed", 0, outcome.line)
    return Result(job.name, job.output, *outcome)


def _files(inputs: Sequence[str]) -> List[str]:
    """The files that inputs name, patterns among them, and layers of stages."""
    found = [path for text in inputs for path in (sorted(glob.glob(text)) if glob.has_magic(text) else [text])]
    return [file for path in found for file in (_layers(path) if path.lower().endswith((".usd", ".usda", ".usdc")) else [path])]


def _layers(stage: str) -> List[str]:
    """The files of a stage that say what its meshes are."""
    try:
        from pxr import Sdf, UsdUtils

        layers = UsdUtils.ComputeAllDependencies(Sdf.AssetPath(stage))[0]
    except Exception:  # the command says what is wrong
        return [stage]
    return [stage, *sorted({layer.realPath for layer in layers} - {stage, os.path.realpath(stage), ""})]


def _frames_and_size(inputs: Sequence[str]) -> Tuple[int, int]:
    """Frames, 0 if they are not known beforehand, and about the bytes of positions."""
    files = _files(inputs)
    size = sum(os.path.getsize(path) for path in files if os.path.exists(path))
    try:
        if inputs[-1].lower().endswith(".pc2"):
            with open(inputs[-1], "rb") as file:
                return struct.unpack_from("<i", file.read(32), 28)[0], size
        if inputs[-1].lower().endswith(".mdd"):
            with open(inputs[-1], "rb") as file:
                return struct.unpack_from(">i", file.read(8))[0], size
    except (OSError, struct.error):
        pass  # the command says what is wrong with it
    return 0, size


def _hash(paths: Sequence[str]) -> str:
    digest = hashlib.sha256()
    for path in paths:
        digest.update(os.path.basename(path).encode() + b"\0")
        with open(path, "rb") as file:
            for piece in iter(lambda: file.read(1 << 20), b""):
                digest.update(piece)
    return digest.hexdigest()


def key_of(job: Job, arguments: Sequence[str], part_frames: Optional[int]) -> str:
    """All that the result depends on."""
    try:
        content = _hash(_files(job.inputs))
    except OSError:
        return ""  # the command says what is wrong
    options = list(arguments)
    if options[-2:-1] == ["-j"]:
        options = options[:-2]
    text = json.dumps([version, content, options, part_frames])
    return hashlib.sha256(text.encode()).hexdigest()


def is_done(job: Job, key: str) -> bool:
    try:
        record = json.loads(job.record.read_text(encoding="utf-8"))
        return bool(key) and record["key"] == key and record["file"] == _hash([job.output])
    except (OSError, ValueError, KeyError):
        return False


def note(job: Job, key: str) -> Tuple[str, int]:
    text = json.dumps({"key": key, "file": _hash([job.output])})
    beside = job.record.with_suffix(".part")
    beside.write_text(text, encoding="utf-8")
    os.replace(beside, job.record)
    return "done", os.path.getsize(job.output)


def _command(*arguments: str) -> Optional[_Refused]:
    """Runs the command of the package. Raises ClipFailed where another try may succeed."""
    result = subprocess.run([sys.executable, "-m", "anicodec", *arguments], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True, errors="replace")
    if result.returncode != 0:
        lines = result.stderr.strip().splitlines()
        line = lines[-1] if lines else f"exit status {result.returncode}"
        if not 1 <= result.returncode <= 4:
            raise ClipFailed(line)
        return _Refused(line)
    return None


def _encode_clip(job: Job, arguments: Sequence[str], part_frames: Optional[int]) -> Union[Tuple[str, int], _Refused]:
    key = key_of(job, arguments, part_frames)
    if is_done(job, key):
        return "kept", os.path.getsize(job.output)
    return _command("encode", "-q", "-f", *job.inputs, "-o", job.output, *arguments) or note(job, key)


def _part_path(job: Job, first: int) -> str:
    return str(job.record.with_name(f"{job.name}.{first}.anic"))


def _encode_part(job: Job, arguments: Sequence[str], first: int, end: int) -> Union[str, _Refused]:
    path = _part_path(job, first)
    return _command("encode", "-q", "-f", *job.inputs, "-o", path, "--part", f"{first}:{end}", *arguments) or path


def _join_parts(job: Job, arguments: Sequence[str], part_frames: int,
                parts: Sequence[Union[str, _Refused]]) -> Union[Tuple[str, int], _Refused]:
    paths = [part for part in parts if isinstance(part, str)]
    refused = next((part for part in parts if isinstance(part, _Refused)), None)
    refused = refused or _command("join", "-q", "-f", *paths, "-o", job.output)
    for path in paths:
        os.remove(path)
    return refused or note(job, key_of(job, arguments, part_frames))


def summary(results: Sequence[Result]) -> Dict[str, int]:
    """How many clips were done, kept and failed."""
    return {status: sum(result.status == status for result in results) for status in ("done", "kept", "failed")}
