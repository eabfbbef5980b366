#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Encodes random clips in random ways and measures, by a comparison of its own, whether each file keeps its promises.

usage: check_promise.py ANICODEC [--clips N] [--seed S] [--jobs N]
Combination i of seed S is the one of seed S + i, so that `--clips 1 --seed K` repeats a single one. A clip becomes a
file by `encode`, as several clips, by `add`, by `join` of parts, or by `encode --live`. Checked are: every target asked for
against the frames that come back, what the file says it measured, bits of `--lossless`, texture coordinates, how far
Mesh Massage moves the surface, and `anicodec verify`. Refusals of the encoder are counted with their reasons. Exit
status 1 if a promise is broken, something ends by a signal, or a sanitizer that ANICODEC is built with reports.
"""
import argparse
import array
import collections
import concurrent.futures
import json
import pathlib
import random
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "conformance"))
import clip_output  # pylint: disable=wrong-import-position
import compare  # pylint: disable=wrong-import-position
import random_clip  # pylint: disable=wrong-import-position
import surface_distance  # pylint: disable=wrong-import-position

ROUNDING = 1e-5  # of the error, or of float32 at the largest coordinate: what two ways of measuring may differ by
QUALITIES = {"good": 0.05, "better": 0.02, "best": 0.01}
#: The --max-error of a command without a target.
USUAL = "0.05%"
#: In reports of sanitizers, whose exit status is that of a refusal.
SANITIZER = re.compile("Sanitizer|runtime error:")


class Refused(Exception):
    """The encoder says why it cannot."""


class Combination:
    """A random clip, and a way to make a file of it."""

    def __init__(self, command, seed, folder):
        self.command, self.folder = command, folder
        self.origin = [0.0, 0.0, 0.0]  # that the file's positions count from
        self.clip = random_clip.RandomClip(seed)
        self.chance = random.Random(f"way {seed}")
        count = len(self.clip.frames)
        ways = ["encode"] * 4 + (["clips", "add", "join", "live"] if count > 2 and not self.clip.times else [])
        self.way = self.chance.choice(ways)
        cut = self.chance.randint(1, count - 1) if self.way in ("clips", "add", "join") else count
        self.runs = [(0, cut), (cut, count)] if cut < count else [(0, count)]
        self.options = self._options()
        self.file = folder / "made.anic"

    def _options(self):
        options = self.clip.options()
        if self.way == "live":
            return options[:2] if options[:1] == ["--max-error"] else []
        if self.chance.random() < 0.5:
            return options
        diagonal = compare.diagonal(self._flat((0, len(self.clip.frames))))
        length = f"{diagonal * 10 ** self.chance.uniform(-4, -2) or 1:.6g}"
        targets = [("--max-error", length), ("--rmse", length), ("--displacement", length),
                   ("--sted", f"{10 ** self.chance.uniform(-2.5, -1):.4g}"),
                   ("--quality", self.chance.choice(list(QUALITIES)))]
        if self.way == "encode":
            targets += [("--lossless",), ("--size", str(self.chance.randint(500, 20000))),
                        ("--bpfv", f"{self.chance.uniform(1, 60):.4g}")]
        target = list(self.chance.choice(targets))
        options = target + ["--effort", self.chance.choice(("fast", "fast", "normal"))]
        if self.way == "encode" and target != ["--lossless"] and self.chance.random() < 0.3:
            options += ["--massage", "on"]
        return options

    def run(self, *words, data=None):
        """Outcome of a command that may fail, but not die."""
        result = subprocess.run([str(w) for w in (self.command, *words)], capture_output=True, input=data, timeout=600,
                                check=False)
        text = result.stderr.decode(errors="replace").strip()
        if result.returncode < 0 or result.returncode == 5 or SANITIZER.search(text):
            raise RuntimeError(f"{' '.join(map(str, words))}: status {result.returncode}: {text}")
        if result.returncode != 0 and words[0] in ("encode", "add", "join"):
            raise Refused(text.rsplit(": ", 1)[-1])
        if result.returncode != 0:
            raise RuntimeError(f"{words[0]}: {text}")
        return result.stdout

    def make(self):
        """Makes the file; raises Refused."""
        clip = self.clip
        mesh, cache = clip.write(self.folder / "clip")
        encode = ("encode", "-q", "-j1")
        if self.way == "encode":
            return self.run(*encode, mesh, cache, "-o", self.file, *self.options)
        if self.way == "live":
            data = b"".join(clip.ordered(frame, "little") for frame in clip.frames)
            return self.run("encode", "-q", "--live", "--piece", "0.2", mesh, "-o", self.file, *self.options, data=data)
        if self.way == "join":
            parts = []
            for number, (first, end) in enumerate(self.runs):
                parts.append(self.folder / f"part{number}.anic")
                self.run(*encode, mesh, cache, "--part", f"{first}:{end}", "-o", parts[-1], *self.options)
            return self.run("join", "-q", *parts, "-o", self.file)
        caches, frames = [], clip.frames
        for number, (first, end) in enumerate(self.runs):
            clip.frames = frames[first:end]
            caches.append(clip.write(self.folder / f"take{number}")[1])
        clip.frames = frames
        if self.way == "clips":
            return self.run(*encode, mesh, *caches, "-o", self.file, *self.options)
        self.run(*encode, mesh, caches[0], "--name", "first", "-o", self.file, *self.options)
        before = self.decoded("before", "first")
        targets = [word for pair in self._targets() for word in pair]
        self.run("add", "-q", "-j1", self.file, mesh, caches[1], *targets)
        if self.decoded("after", "first").frames != before.frames:
            raise RuntimeError("add changes the clip that was there")
        return None

    def decoded(self, name, clip="all"):
        self.run("decode", "-q", "--clip", clip, self.file, "-o", self.folder / f"{name}.pc2")
        return clip_output.Clip(self.folder / f"{name}.pc2")

    def faults(self):
        """Promises that the file breaks."""
        self.run("verify", "-q", self.file)
        said = json.loads(self.run("info", "--json", self.file))
        self.origin = said["origin"]
        seen = self.decoded("back")
        counts = len(self.clip.vertices), len(self.clip.frames)
        if (seen.vertices, len(seen.frames)) != counts:
            return [f"{seen.vertices} vertices x {len(seen.frames)} frames came back, not {counts}"]
        found = []
        whole = self.way in ("encode", "live", "join")
        for number, run in enumerate([(0, counts[1])] if whole else self.runs):
            shown = array.array("f")
            for frame in seen.frames[slice(*run)]:
                shown.extend(frame)
            check = self._massage_faults if said["massaged"] else self._clip_faults
            found += check(said if said["massaged"] else said["clips"][number], self._flat(run), shown, run)
        if "--size" in self.options and self.file.stat().st_size > int(self._value("--size")):
            found.append(f"{self.file.stat().st_size} bytes")
        if "--bpfv" in self.options and \
                8 * self.file.stat().st_size > float(self._value("--bpfv")) * counts[0] * counts[1] * (1 + ROUNDING):
            found.append(f"{self.file.stat().st_size} bytes")
        return found + self._uv_faults()

    def _clip_faults(self, said, flat, shown, run):
        counts = len(self.clip.vertices), run[1] - run[0]
        measured = compare.compare(flat, shown, *counts)
        slack = 1e-7 * max(map(abs, flat))
        found = []
        if "--lossless" in self.options and array.array("f", flat).tobytes() != shown.tobytes():
            found.append("--lossless: other bits")
        for name, key in (("max_error", "max_error"), ("kg", "kg_percent"), ("rmse", "rmse")):
            if name == "kg" and slack > 1e-6 * measured["diagonal"]:
                continue  # far from the origin, the metric's own sums are rounded
            if abs(said[name] - measured[key]) > ROUNDING * measured[key] + (slack if name != "kg" else 1e-6):
                found.append(f"{name} is {measured[key]:.9g}, the file says {said[name]:.9g}")
        moves = compare.displacement(flat, shown, *counts)
        if moves > said["max_displacement_error"] * (1 + ROUNDING) + 4 * slack:
            found.append(f"moves are {moves:.9g} off, the file says {said['max_displacement_error']:.9g}")
        for option, value in self._targets():
            if option == "--max-error":
                of_whole = self.way == "join"  # parts are of the whole clip
                diagonal = compare.diagonal(self._flat((0, len(self.clip.frames)))) if of_whole \
                    else measured["diagonal"]
                limit = float(value.rstrip("%")) / 100 * diagonal if value.endswith("%") else float(value)
                error = measured["max_error"]
            elif option in ("--kg", "--rmse"):
                error, limit = measured["kg_percent" if option == "--kg" else "rmse"], float(value)
            elif option == "--displacement":
                error, limit = moves, float(value)
            else:
                error = compare.sted(flat, shown, *counts, self.clip.polygons)
                limit = QUALITIES.get(value) or float(value)
            # Parts are within the limit each; of a motion joined at a seam nothing is promised.
            if self.way == "join" and option not in ("--max-error", "--rmse"):
                continue
            if error > limit * (1 + ROUNDING) + 4 * slack:
                found.append(f"{option} is {error:.9g}, asked {limit:.9g}")
        return found

    def _massage_faults(self, said, flat, shown, _):
        """No vertex is further from the source's surface than the surface error and that of coding together."""
        limit = (said["surface_error"] + said["max_error"]) * (1 + ROUNDING) + 1e-6 * max(map(abs, flat))
        n = 3 * len(self.clip.vertices)
        triangles = surface_distance.triangles(self.clip.polygons)
        used = sorted({v for triangle in triangles for v in triangle})
        for first in range(0, len(flat), n):
            source = surface_distance.Surface(flat[first:first + n], triangles)
            for v in used[::max(1, len(used) // 40)]:
                if (away := source.distance(shown[first + 3 * v:first + 3 * v + 3], limit)) > limit:
                    return [f"vertex {v} is {away:.9g} from the surface, the file says {limit:.9g}"]
        return []

    def _uv_faults(self):
        """Texture coordinates are within half a step of 12 bits."""
        if not self.clip.uv:
            return []
        mesh = self.folder / "back.obj"
        if self.clip.times or not mesh.exists():
            return []
        places, found = [], []
        for line in mesh.read_text(encoding="ascii").splitlines():
            words = line.split()
            if words[:1] == ["vt"]:
                places.append(tuple(map(float, words[1:3])))
            for corner in words[1:] if words[:1] == ["f"] else ():
                v, t = (int(w) - 1 for w in corner.split("/")[:2])
                away = max(abs(a - b) for a, b in zip(places[t], self.clip.uv[v]))
                if away > 0.5 / 4096 + 2e-6:
                    found = [f"a texture coordinate is {away:.6g} off"]
        return found

    def _targets(self):
        pairs = [pair for pair in zip(self.options, self.options[1:])
                 if pair[0] in ("--max-error", "--kg", "--rmse", "--displacement", "--sted", "--quality")]
        other = {"--lossless", "--size", "--bpfv"} & set(self.options)
        return pairs or ([] if other else [("--max-error", USUAL)])

    def _value(self, option):
        return self.options[self.options.index(option) + 1]

    def _flat(self, run):
        flat = array.array("f")
        for frame in self.clip.frames[slice(*run)]:
            flat.extend(frame)
        if any(self.origin):
            return array.array("d", (x - self.origin[i % 3] for i, x in enumerate(flat)))
        return flat


def outcome(command, seed):
    """Way, reason of a refusal or None, and faults."""
    with tempfile.TemporaryDirectory() as folder:
        combination = Combination(command, seed, pathlib.Path(folder))
        way = combination.way + "".join(f" {o}" for o in ("--lossless", "--massage") if o in combination.options)
        try:
            combination.make()
            faults = combination.faults()
        except Refused as refused:
            return way, str(refused), []
        except (RuntimeError, subprocess.TimeoutExpired) as error:
            faults = [str(error)]
    return way, None, [f"{fault} ({way}: {' '.join(combination.options)})" for fault in faults]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("anicodec", type=pathlib.Path)
    parser.add_argument("--clips", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=None, help="combinations at a time")
    arguments = parser.parse_args()
    command = arguments.anicodec.resolve()
    broken, refusals, kept = 0, collections.Counter(), collections.Counter()
    seeds = range(arguments.seed, arguments.seed + arguments.clips)
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for seed, (way, refusal, faults) in zip(seeds, pool.map(lambda seed: outcome(command, seed), seeds)):
            if refusal:
                refusals[refusal] += 1
            for fault in faults:
                print(f"seed {seed}: {fault}", flush=True)
            broken += bool(faults)
            kept[way] += not refusal and not faults
    for reason, count in refusals.most_common():
        print(f"{count} refused: {reason}")
    print("kept: " + ", ".join(f"{count} {way}" for way, count in kept.most_common() if count))
    print(f"seeds {seeds[0]} to {seeds[-1]}: {broken} broken, {sum(refusals.values())} refused, "
          f"{sum(kept.values())} kept")
    sys.exit(1 if broken else 0)


if __name__ == "__main__":
    main()
