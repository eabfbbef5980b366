#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Encodes random clips and measures, by a comparison of its own, whether each file keeps what it promises.

usage: check_promise.py ANICODEC [--clips N] [--seed S]
Clip i of seed S is the one of seed S + i, so that `--clips 1 --seed K` repeats a single one. Checked are: the error
asked for against the frames that come back, what the file says it measured, and `anicodec verify`. A clip that the
encoder refuses is counted with its reason. Exit status 1 if a promise is broken, or something ends by a signal.
"""
import argparse
import array
import collections
import concurrent.futures
import json
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import clip_output  # pylint: disable=wrong-import-position
import compare  # pylint: disable=wrong-import-position
import random_clip  # pylint: disable=wrong-import-position

ROUNDING = 1e-5  # of the error, or of float32 at the largest coordinate: what two ways of measuring may differ by


def run(*command):
    """Outcome of a command that may fail, but not die."""
    result = subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=600, check=False)
    if result.returncode < 0 or result.returncode == 5:
        raise RuntimeError(f"{' '.join(map(str, command))}: status {result.returncode}: {result.stderr.strip()}")
    return result


def faults_of(command, seed):
    """(refusal or None, faults) of one clip."""
    clip = random_clip.RandomClip(seed)
    options = clip.options()
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        inputs = clip.write(folder / "clip")
        file, back = folder / "clip.anic", folder / "back.pc2"
        encoded = run(command, "encode", "-q", "-j1", *inputs, "-o", file, *options)
        if encoded.returncode != 0:
            return encoded.stderr.strip().rsplit(": ", 1)[-1], []
        if (verified := run(command, "verify", "-q", file)).returncode != 0:
            return None, [f"verify: {verified.stderr.strip()}"]
        said = json.loads(run(command, "info", "--json", file).stdout)
        if (decoded := run(command, "decode", "-q", file, "-o", back)).returncode != 0:
            return None, [f"decode: {decoded.stderr.strip()}"]
        seen = clip_output.Clip(back)
    faults = []
    counts = len(clip.vertices), len(clip.frames)
    if (seen.vertices, len(seen.frames)) != counts:
        return None, [f"{seen.vertices} vertices x {len(seen.frames)} frames came back, not {counts}"]
    flat, shown = array.array("f"), array.array("f")
    for frame, other in zip(clip.frames, seen.frames):
        flat.extend(frame)
        shown.extend(other)
    measured = compare.compare(flat, shown, *counts)
    slack = 1e-7 * max(map(abs, flat))
    for name, key in (("max_error", "max_error"), ("kg", "kg_percent"), ("rmse", "rmse")):
        if name == "kg" and slack > 1e-6 * measured["diagonal"]:
            continue  # far from the origin, the metric's own sums are rounded
        if abs(said[name] - measured[key]) > ROUNDING * measured[key] + (slack if name != "kg" else 1e-6):
            faults.append(f"{name} is {measured[key]:.9g}, the file says {said[name]:.9g}")
    values = dict(zip(options[::2], options[1::2]))
    if "--max-error" in values or "--kg" not in values:
        limit = float(values.get("--max-error", "0.05%").rstrip("%")) / 100 * measured["diagonal"]
        if measured["max_error"] > limit * (1 + ROUNDING) + slack:
            faults.append(f"largest error {measured['max_error']:.9g}, asked {limit:.9g}")
    if "--kg" in values and measured["kg_percent"] > float(values["--kg"]) * (1 + ROUNDING):
        faults.append(f"KG error {measured['kg_percent']:.9g}, asked {values['--kg']}")
    return None, [f"{fault} ({' '.join(options)})" for fault in faults]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("anicodec", type=pathlib.Path)
    parser.add_argument("--clips", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    command = arguments.anicodec.resolve()
    broken, refusals = 0, collections.Counter()

    def check(seed):
        try:
            return seed, *faults_of(command, seed)
        except (RuntimeError, subprocess.TimeoutExpired) as error:
            return seed, None, [str(error)]

    with concurrent.futures.ThreadPoolExecutor() as pool:
        for seed, refusal, faults in pool.map(check, range(arguments.seed, arguments.seed + arguments.clips)):
            if refusal:
                refusals[refusal] += 1
            for fault in faults:
                print(f"seed {seed}: {fault}")
            broken += bool(faults)
    for reason, count in refusals.most_common():
        print(f"{count} refused: {reason}")
    print(f"seeds {arguments.seed} to {arguments.seed + arguments.clips - 1}: {broken} broken, "
          f"{sum(refusals.values())} refused, {arguments.clips - broken - sum(refusals.values())} kept")
    sys.exit(1 if broken else 0)


if __name__ == "__main__":
    main()
