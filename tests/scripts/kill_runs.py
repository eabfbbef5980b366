#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Kills runs of the command while they replace files, and checks that nothing is lost: every output
is the old one or the new one, sets of files are whole once the next run has been there, and nothing
temporary stays.

usage: kill_runs.py ANICODEC [KILLS [SEED]]      300 kills unless told; exit status 1 if a file is lost
"""
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

# Some of the kills fall where files are renamed: into this last part of a run.
END = 0.12
STAGE = ".anicodec-stage-"
FAST = ("--effort", "fast", "-q")


def run(*command):
    subprocess.run([str(c) for c in command], check=True, stdout=subprocess.DEVNULL)


def contents(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*"))
            if p.is_file() and not any(part.startswith(".anicodec") for part in p.relative_to(folder).parts)}


class Job:
    """A command that replaces the files of a folder, once with one content and once with another."""

    def __init__(self, name, folder, commands, after):
        self.name, self.folder, self.commands, self.after = name, folder, commands, after
        self.states, self.seconds = [], 0.1
        for command in commands:
            start = time.monotonic()
            run(*command)
            self.seconds = time.monotonic() - start
            self.states.append(contents(folder))
        self.kills = 0

    def kill_one(self, chance):
        """Gives the fault that it finds, or nothing."""
        process = subprocess.Popen([str(c) for c in chance.choice(self.commands)], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        share = chance.uniform(1 - END, 1.05) if chance.random() < 0.6 else chance.random()
        start = time.monotonic()
        try:
            process.wait(share * self.seconds)
            self.seconds = min(self.seconds, time.monotonic() - start)  # the first run was a slow one
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            self.kills += process.wait() == -signal.SIGKILL
        return self.fault_of_files() or self.fault_of_set()

    def fault_of_files(self):
        found = contents(self.folder)
        for name in self.states[0]:
            if name not in found:
                return f"{name} is neither old nor new: it is gone"
            if found[name] not in [state[name] for state in self.states]:
                return f"{name} is neither old nor new"
        return None

    def fault_of_set(self):
        """The fault that the next run finds."""
        if self.after:
            run(*self.after)
            if contents(self.folder) not in self.states:
                return "the set has files of both runs"
        left = [p.name for p in self.folder.iterdir() if p.name.startswith(STAGE)]
        return f"{left[0]} stays" if self.after and left else None


def jobs(anicodec, folder):
    """Two clips of the same frames, and what is made of them."""
    clips = []
    for name, kg in (("a", "1"), ("b", "0.05")):
        run(anicodec, "corpus", "tiny", "-o", folder / "tiny.pc2", "-f")
        clips.append(folder / f"{name}.anic")
        run(anicodec, "encode", folder / "tiny.obj", folder / "tiny.pc2", "--kg", kg, *FAST, "-o", clips[-1])
    for name in ("frames", "pair", "joined", "batch", "single"):
        (folder / name).mkdir()
    parts = []
    for clip, kg in (("a", "1"), ("b", "0.05")):
        for half in ("0:4", "4:8"):
            parts.append(folder / f"{clip}{half[0]}.anic")
            run(anicodec, "encode", folder / "tiny.obj", folder / "tiny.pc2", "--kg", kg, *FAST, "--part", half,
                "-o", parts[-1])
    source = folder / "source"
    source.mkdir()
    for i in range(6):
        for kind in (".obj", ".pc2"):
            (source / f"clip{i}{kind}").write_bytes((folder / f"tiny{kind}").read_bytes())
    frames, pair = folder / "frames", folder / "pair"
    yield Job("frame set", frames,
              [[anicodec, "decode", clip, "-o", frames / "f_%02d.obj", "-f", "-q"] for clip in clips],
              [anicodec, "encode", str(frames / "f_*.obj"), "-o", folder / "x.anic", "-f", *FAST])
    yield Job("mesh and cache", pair, [[anicodec, "decode", clip, "-o", pair / "c.pc2", "-f", "-q"] for clip in clips],
              [anicodec, "encode", pair / "c.pc2", "-o", folder / "x.anic", "-f", *FAST])
    yield Job("join", folder / "joined",
              [[anicodec, "join", *parts[i:i + 2], "-o", folder / "joined/j.anic", "-f", "-q"] for i in (0, 2)], None)
    yield Job("batch", folder / "batch",
              [[anicodec, "encode", "--batch", source, "-o", folder / "batch", "--kg", kg, *FAST] for kg in ("1", "0.05")],
              None)
    yield Job("encode", folder / "single",
              [[anicodec, "encode", folder / "tiny.obj", folder / "tiny.pc2", "--kg", kg, *FAST,
                "-o", folder / "single/s.anic", "-f"] for kg in ("1", "0.05")], None)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    kills = int(sys.argv[2]) if len(sys.argv) > 2 else 300
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else random.randrange(10**9)
    chance = random.Random(seed)
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        all_jobs = list(jobs(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(folder)))
        while sum(job.kills for job in all_jobs) < kills and not faults:
            for job in all_jobs:
                if fault := job.kill_one(chance):
                    faults.append(f"{job.name}: {fault}")
        for job in all_jobs:
            run(*job.commands[0])  # what is left over by the last kill goes, and the batch is completed
            left = [p.name for p in job.folder.iterdir() if p.name.startswith(STAGE)]
            if left or contents(job.folder) != job.states[0]:
                faults.append(f"{job.name}: the next run does not complete it ({left})")
    counts = ", ".join(f"{job.name} {job.kills}" for job in all_jobs)
    print(f"seed {seed}: {sum(job.kills for job in all_jobs)} kills ({counts}), {len(faults)} faults")
    print(*faults, sep="\n", end="\n" if faults else "")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
