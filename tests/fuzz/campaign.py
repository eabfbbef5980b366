#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Fuzzes by libFuzzer for hours or days, and tells what was reached.

usage: campaign.py FOLDER [--seconds N | --runs N] [--targets NAMES] [--jobs N] [--coverage]
Builds the targets twice by clang: with AddressSanitizer and UndefinedBehaviorSanitizer (preset fuzz), and without them, which
executes many times as many inputs. Runs one target after the other without, round after round, and what reached something new
under the sanitizers after each turn; every eighth round runs under them. It ends when so many seconds have gone by or so many
inputs have been executed in all. FOLDER, outside the checkout, keeps each target's corpus for the next time, the
number of executions, and in found/ each input that stopped a target. With --coverage the corpora are then run in a
build that counts (llvm-cov): what is printed are the lines of format/ and sdk/ that were executed, and those that never
were. Exit status 1 if an input stopped a target.

The targets: those that decode, unless told; `encode`, and importers, too: --targets encode,gltf,alembic,md3
"""
import argparse
import concurrent.futures
import functools
import itertools
import json
import pathlib
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
DECODING = ("api", "stream", "clip", "learning", "chunk", "faces", "pose", "entropy")
#: Files beside the seeds that the build makes.
MORE_SEEDS = {"api": ["tests/conformance"], "stream": ["tests/conformance"], "clip": ["tests/conformance"],
              "learning": ["tests/conformance/streams"]}
ROUND = 300  # seconds that a target runs before the next has its turn
SANITIZED = 8  # of so many rounds one is under the sanitizers
AT_ONCE = 100  # inputs of a run under them
LONGEST = 24576  # bytes of an input
SLOW = 120  # seconds of the clock, on a busy machine, that an input may take
OTHER = ["-S", ROOT, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=RelWithDebInfo", "-DCMAKE_C_COMPILER=clang", "-DCMAKE_CXX_COMPILER=clang++"]
# Calls of libFuzzer at every comparison take half of the time; the mutator knows the numbers that tell.
QUICK = "-fno-sanitize-coverage=trace-cmp,indirect-calls,stack-depth"
BUILDS = {"fuzz": ["--preset", "fuzz", f"-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -g1 -DNDEBUG {QUICK}"],
          "fast": [*OTHER, "-B", ROOT / "build/fast", "-DANICODEC_BUILD_FUZZERS=ON", "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O2 -g1 -DNDEBUG",
                   f"-DCMAKE_CXX_FLAGS=-fsanitize=fuzzer-no-link {QUICK}"],
          "coverage": [*OTHER, "-B", ROOT / "build/coverage", "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -g1 -DNDEBUG",
                       "-DCMAKE_CXX_FLAGS=-fprofile-instr-generate -fcoverage-mapping"]}
OPTIONS = ["-DANICODEC_LANES=8", "-DCMAKE_UNITY_BUILD=ON", "-DANICODEC_INSTALL=OFF", "-DCMAKE_EXE_LINKER_FLAGS=-fuse-ld=lld"]


def built(kind, targets, jobs):
    """Folder of the programs."""
    folder = ROOT / "build" / kind
    if not (folder / "build.ninja").exists():
        subprocess.run(["cmake", *BUILDS[kind], *OPTIONS], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["ninja", "-C", folder, f"-j{jobs}", *(f"{name}_fuzz" for name in targets)], check=True,
                   stdout=subprocess.DEVNULL)
    return folder / "tests/fuzz"


def seeds(programs, name):
    folders = [programs / "seeds" / name, ROOT / "tests/fuzz/seeds" / name, *(ROOT / more for more in MORE_SEEDS.get(name, ()))]
    return [folder for folder in folders if folder.is_dir()]


class Campaign:
    """The runs so far, in a folder."""

    def __init__(self, folder, targets):
        self.folder, self.targets = folder, targets
        self.count_file = folder / "executions.json"
        self.counts = json.loads(self.count_file.read_text()) if self.count_file.exists() else {}
        self.found = 0
        (folder / "found").mkdir(parents=True, exist_ok=True)

    def corpus(self, name):
        folder = self.folder / "corpus" / name
        folder.mkdir(parents=True, exist_ok=True)
        return folder

    def take_seeds(self, programs, name):
        """Puts into the corpus what reaches more than it does."""
        subprocess.run([programs / f"{name}_fuzz", "-merge=1", f"-max_len={LONGEST}", self.corpus(name), *seeds(programs, name)],
                       check=True, capture_output=True)

    def run(self, programs, name, seconds, runs):
        """Executions of a turn."""
        options = [f"-max_total_time={seconds}", f"-max_len={LONGEST}", "-entropic=0", *([f"-runs={runs}"] if runs else [])]
        return self.execute(programs, name, [self.corpus(name), *options])

    def check_new(self, programs, name):
        """Runs what the corpus has more than the last time; returns the number."""
        list_file = self.folder / f"checked_{name}"
        known = set(list_file.read_text().split()) if list_file.exists() else set()
        new = sorted(path for path in self.corpus(name).iterdir() if path.name not in known)
        for first in range(0, len(new), AT_ONCE):
            some = new[first:first + AT_ONCE]
            self.execute(programs, name, some, len(some))
            with list_file.open("a") as file:
                file.writelines(f"{path.name}\n" for path in some)
        return len(new)

    def execute(self, programs, name, arguments, executions=0):
        """Executions of a run, as it tells unless they are given."""
        command = [programs / f"{name}_fuzz", *arguments, "-print_final_stats=1", f"-timeout={SLOW}", "-rss_limit_mb=2048",
                   f"-artifact_prefix={self.folder / 'found'}/{name}-"]
        result = subprocess.run(command, capture_output=True, check=False)
        text = result.stderr.decode(errors="replace")
        done = executions or (int(found.group(1)) if (found := re.search(r"number_of_executed_units: (\d+)", text)) else 0)
        if result.returncode != 0:
            self.found += 1
            log = self.folder / "found" / f"{name}-{time.strftime('%H%M%S')}.log"
            log.write_text(text)
            print(f"{name}: stopped: {log}", flush=True)
        self.counts[name] = self.counts.get(name, 0) + done
        self.count_file.write_text(json.dumps(self.counts, indent=1) + "\n")
        return done

    def run_all(self, sanitized, fast, seconds, runs, jobs):
        """`sanitized`, `fast`: folders of programs."""
        def turn_of(name, turn, runs, number):
            programs = sanitized if number % SANITIZED == SANITIZED - 1 else fast
            return self.run(programs, name, turn, runs) + self.check_new(sanitized, name)

        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            list(pool.map(lambda name: self.take_seeds(fast, name), self.targets))
            start, total = time.monotonic(), 0
            for number in itertools.count():
                left = seconds - (time.monotonic() - start)
                if left <= 0 or 0 < runs <= total:
                    break
                turn = max(1, int(min(ROUND, left * jobs / len(self.targets))))
                left_runs = runs - total if runs else 0
                total += sum(pool.map(functools.partial(turn_of, turn=turn, runs=left_runs, number=number), self.targets))
                spent = time.monotonic() - start
                print(f"{spent:.0f} s: {total:,} executions, {total / spent:.0f} a second; with earlier ones "
                      f"{sum(self.counts.values()):,}: " + ", ".join(f"{n} {c:,}" for n, c in sorted(self.counts.items())),
                      flush=True)

    def coverage(self, jobs):
        """Prints what the corpora and seeds reach."""
        programs, work = built("coverage", self.targets, jobs), self.folder / "coverage"
        work.mkdir(exist_ok=True)
        profiles = []
        for name in self.targets:
            profiles.append(work / f"{name}.profraw")
            subprocess.run([programs / f"{name}_fuzz", "0", self.corpus(name), *seeds(programs, name)], check=True,
                           env={"LLVM_PROFILE_FILE": str(profiles[-1])}, stdout=subprocess.DEVNULL)
        merged = work / "all.profdata"
        subprocess.run(["llvm-profdata", "merge", "-o", merged, *profiles], check=True)
        objects = [word for name in self.targets for word in ("-object", programs / f"{name}_fuzz")][1:]
        text = subprocess.run(["llvm-cov", "export", "-format=lcov", f"-instr-profile={merged}", *objects, "-skip-expansions"],
                              check=True, capture_output=True, text=True).stdout
        report(text)


def report(lcov):
    """Prints lines reached of each file, and runs of lines that were not."""
    files, lines = {}, {}
    for line in lcov.splitlines():
        if line.startswith("SF:"):
            # A compiler cache makes paths relative to the folder of the build.
            path = re.search(r"(?:^|/)((?:format|sdk)/[a-z0-9_/]+\.(?:cpp|h))$", line[3:])
            lines = files.setdefault(path.group(1), {}) if path and (ROOT / path.group(1)).exists() else {}
        elif line.startswith("DA:"):
            number, count = map(int, line[3:].split(",")[:2])
            lines[number] = lines.get(number, 0) + count
    rooms, missed = {}, {}
    for path, lines in files.items():
        room = rooms.setdefault(str(pathlib.PurePath(path).parent), [0, 0])
        room[0] += sum(count > 0 for count in lines.values())
        room[1] += len(lines)
        if not all(lines.values()):
            missed[path] = sorted(number for number, count in lines.items() if count == 0)
    for name, (reached, all_lines) in sorted(rooms.items()):
        print(f"{name}: {reached} of {all_lines} lines, {100 * reached / all_lines:.1f} %")
    for module in ("format", "sdk"):
        sums = [sum(counts[i] for name, counts in rooms.items() if name.split("/")[0] == module) for i in (0, 1)]
        print(f"{module} in all: {sums[0]} of {sums[1]} lines, {100 * sums[0] / max(1, sums[1]):.1f} %")
    print("never reached:")
    for path, numbers in sorted(missed.items()):
        runs = []
        for number in numbers:
            if runs and number <= runs[-1][1] + 1:
                runs[-1][1] = number
            else:
                runs.append([number, number])
        print(f"  {path}: " + ", ".join(str(a) if a == b else f"{a}-{b}" for a, b in runs))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--seconds", type=float, default=None)
    parser.add_argument("--runs", type=int, default=0)
    parser.add_argument("--targets", default=",".join(DECODING))
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--coverage", action="store_true")
    arguments = parser.parse_args()
    folder = arguments.folder.resolve()
    if folder.is_relative_to(ROOT):
        parser.error(f"{folder} is inside the checkout")
    campaign = Campaign(folder, arguments.targets.split(","))
    seconds = arguments.seconds if arguments.seconds is not None else float("inf") if arguments.runs else 0
    if seconds:
        programs = [built(kind, campaign.targets, arguments.jobs) for kind in ("fuzz", "fast")]
        campaign.run_all(*programs, seconds, arguments.runs, arguments.jobs)
    if arguments.coverage:
        campaign.coverage(arguments.jobs)
    sys.exit(1 if campaign.found else 0)


if __name__ == "__main__":
    main()
