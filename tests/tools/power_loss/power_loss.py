#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Cuts the power at every moment at which the command has changed a file, and checks what a strict file system may have
kept: each output is whole, the old one or the new one, sets of files are after the next run, and what a finished run has
written is there.

A library (file_watch.c) holds the command at each call that changes or flushes files, while this program looks at them.
For each moment it then makes the disks that may be found after it (as in Pillai et al., All File Systems Are Not Created
Equal, OSDI 2014): of a file what was there at its last fsync, nothing, zeros, or a part of what was written since; of
names, those of the last fsync of their folder, all changes since, each change alone, and all but each one. A rename is in
both folders or in none; what is appended to a file comes in order.

usage: power_loss.py ANICODEC LIBRARY [-v]      exit status 1 if a file is lost
"""
import os
import pathlib
import shutil
import socket
import struct
import subprocess
import sys
import tempfile

FAST = ("--effort", "fast", "-q", "-j", "1")
HIDDEN = ".anicodec"
JOURNAL = ".anicodec-batch"


class Watched:
    """The history of the files of a folder: (kind, details), one after the other."""

    def __init__(self, folder, store):
        self.root, self.store = folder, store
        self.names = {}  # of each folder, by its inode: name -> inode
        self.data = {}  # of each file, by its inode
        self.open_folders = []  # no inode has the number of one that is gone
        self.log = []
        self.look()
        self.first = (self.top, {n: dict(d) for n, d in self.names.items()}, dict(self.data))
        self.log = []

    def look(self, at_once=False):
        """Notes what has changed; at_once: as one change of names."""
        seen, edits = {}, []

        def visit(path):
            number = os.stat(path).st_ino
            if number not in self.names:
                self.open_folders.append(os.open(path, os.O_RDONLY))
            seen[number] = {}
            for entry in os.scandir(path):
                seen[number][entry.name] = entry.inode()
                if entry.is_dir(follow_symlinks=False):
                    visit(entry.path)
                    continue
                data = pathlib.Path(entry.path).read_bytes()
                if self.data.get(entry.inode()) != data:
                    if entry.inode() not in self.data:
                        os.link(entry.path, self.store / str(entry.inode()))
                    self.data[entry.inode()] = data
                    self.log.append(("data", entry.inode(), data))
            return number

        self.top = visit(self.root)
        for number in {**self.names, **seen}:
            before, after = self.names.get(number, {}), seen.get(number, {})
            edits += [(number, name, after.get(name)) for name in sorted({**before, **after})
                      if before.get(name) != after.get(name)]
        self.names = seen
        for change in [edits] if at_once else [[e] for e in edits]:
            if change:
                self.log.append(("names", change))

    def tell(self, message):
        if message[0] == "s":
            self.log.append(("sync", int(message[2:])))
        else:
            self.look(message[0] == "r")


def watch(command, library, folder, store, fail=0, stdin=None):
    """Runs a command. Gives what happened in the folder, and its exit status."""
    watched = Watched(folder, store)
    here, there = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    environment = dict(os.environ, LD_PRELOAD=str(library), FILE_WATCH_FD=str(there.fileno()),
                       FILE_WATCH_FAIL=str(fail))
    process = subprocess.Popen([str(c) for c in command], env=environment, pass_fds=[there.fileno()],
                               stdin=open(stdin, "rb") if stdin else subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    there.close()
    while message := here.recv(100).decode():
        watched.tell(message)
        here.send(b"k")
    here.close()
    error = process.stderr.read().decode()
    status = process.wait()
    watched.look()
    if (status != 0) != bool(fail):
        sys.exit(f"{command}: status {status}\n{error}")
    return watched


def torn(durable, latest):
    """The contents that may be found of a file that had `durable` at its last flush, None if it had none."""
    if durable == latest:
        return [latest]
    kept = durable or b""
    if latest.startswith(kept):
        half = latest[:(len(kept) + len(latest)) // 2]
        return [kept, half, latest] + ([bytes(len(latest))] if durable is None else [])
    return [kept, b"", bytes(len(latest)), latest[:len(latest) // 2], latest]


def disks(watched, moment):
    """The files that may be found when the power goes after so many changes: path -> (inode, bytes) each."""
    top, names, durable = watched.first[0], {n: dict(d) for n, d in watched.first[1].items()}, dict(watched.first[2])
    latest, pending = dict(durable), []
    for kind, *details in watched.log[:moment]:
        if kind == "data":
            latest[details[0]] = details[1]
        elif kind == "names":
            pending.append(details[0])
        elif details[0] in latest:
            durable[details[0]] = latest[details[0]]
        else:
            kept = [c for c in pending if any(e[0] == details[0] for e in c)]
            for change in kept:
                apply(change, names)
            pending = [c for c in pending if c not in kept]
    subsets = [[], pending] + [[c] for c in pending] + [[c for c in pending if c is not left] for left in pending]
    kinds = {n: torn(durable.get(n), data) for n, data in latest.items()}
    for changes in subsets:
        found = {n: dict(d) for n, d in names.items()}
        for change in changes:
            apply(change, found)
        for kind in range(max(map(len, kinds.values()), default=1)):
            tree = {}
            collect(found, top, "", {n: k[min(kind, len(k) - 1)] for n, k in kinds.items()}, tree)
            yield tree


def apply(change, names):
    for folder, name, number in change:
        if number is None:
            names.setdefault(folder, {}).pop(name, None)
        else:
            names.setdefault(folder, {})[name] = number


def collect(names, folder, path, data, tree):
    for name, number in names.get(folder, {}).items():
        if number in data:
            tree[path + name] = (number, data[number])
        else:
            tree[path + name + "/"] = (number, None)
            collect(names, number, path + name + "/", data, tree)


def contents(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*"))
            if p.is_file() and not any(part.startswith(HIDDEN) for part in p.relative_to(folder).parts)}


def put(tree, watched, folder):
    """Makes a disk: files that are as they were at the end by their own inodes, by which records name them."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    for path, (number, data) in tree.items():
        if data is None:
            (folder / path).mkdir()
        elif data == watched.data[number] and path != JOURNAL:
            os.link(watched.store / str(number), folder / path)
        else:
            (folder / path).write_bytes(data)


class Job:
    """A command that writes files into a folder, {} of its words."""

    def __init__(self, name, command, before=(), reader=None, fail=0, stdin=None, pieces=None, again=False):
        self.name, self.command, self.before = name, command, before
        self.fail, self.stdin, self.pieces = fail, stdin, pieces
        self.next_run, self.is_set = reader or (command if again else None), bool(reader)

    def run(self, library, folder):
        """Gives the faults that it finds, and how many disks it looked at."""
        disk, live, store = folder / "disk", folder / "live", folder / "store"
        for one in (live, store, disk):
            shutil.rmtree(one, ignore_errors=True)
            one.mkdir()
        for command in self.before:
            run(command, live)
        old = contents(live)
        watched = watch([word(c, live) for c in self.command], library, live, store, self.fail, self.stdin)
        end = contents(live)
        states = [old, end]
        if self.fail:
            run(self.command, live)
            states[1] = contents(live)
            if end != old:
                return [f"{self.name}: a run that failed has changed files"], 0
        seen, ran, faults = set(), set(), []
        for moment in range(len(watched.log) + 1):
            for tree in disks(watched, moment):
                key = tuple(sorted(tree.items()))
                if key in seen and moment < len(watched.log):
                    continue
                seen.add(key)
                fault = self.fault_of_files(tree, states, end if moment == len(watched.log) else None)
                # One run is enough for disks that differ in the bytes of outputs alone.
                found = tuple((p, n, data if HIDDEN in p else b"") for p, (n, data) in sorted(tree.items()))
                if not fault and self.next_run and found not in ran:
                    ran.add(found)
                    put(tree, watched, disk)
                    fault = self.fault_of_next_run(disk, states)
                if fault:
                    faults.append(f"{self.name}, after {moment} of {len(watched.log)} changes: {fault}")
                    break
        return faults, len(seen)

    def fault_of_files(self, tree, states, end):
        shown = {p: data for p, (_, data) in tree.items()
                 if data is not None and not any(part.startswith(HIDDEN) for part in pathlib.Path(p).parts)}
        for name in sorted({**states[0], **states[1]}):
            kept = [state.get(name) for state in states]
            if end and shown.get(name) != end[name]:
                return f"{name}: the run has ended, and its file is lost"
            if shown.get(name) not in kept and not self.has_pieces(shown.get(name), kept[1]):
                return f"{name} is neither old nor new: " + ("torn" if name in shown else "gone")
        return None

    def has_pieces(self, found, whole):
        """Whether it is the begin of a stream, at least its first piece."""
        return bool(self.pieces and found and whole.startswith(found) and len(found) >= self.pieces)

    def fault_of_next_run(self, disk, states):
        ended = run(self.next_run, disk, check=False)
        if self.is_set and contents(disk) not in states:
            return "the set has files of both runs"
        if self.is_set and not contents(disk):
            return None  # to read
        if ended.returncode != 0:
            return "the next run fails: " + ended.stderr.decode()
        if not self.is_set and contents(disk) != states[1]:
            return "the next run does not complete it"
        left = [p.name for p in disk.rglob(HIDDEN + "-stage-*")]
        return f"{left[0]} stays" if left else None


def word(text, folder):
    return str(text).replace("{}", str(folder))


def run(command, folder, check=True):
    return subprocess.run([word(c, folder) for c in command], check=check, stdout=subprocess.DEVNULL,
                          stderr=None if check else subprocess.PIPE)


def write_clip(obj, turn):
    """A tetrahedron that moves for three frames, as OBJ and PC2. Gives the PC2."""
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    obj.write_text("".join("v {} {} {}\n".format(*p) for p in points) + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
    values = [x + turn * frame * (i + 1) * (axis - 1.5) for frame in range(3)
              for i, p in enumerate(points) for axis, x in enumerate(p)]
    pc2 = obj.with_suffix(".pc2")
    pc2.write_bytes(struct.pack("<12siiffi", b"POINTCACHE2", 1, len(points), 0, 1, 3) +
                    struct.pack(f"<{len(values)}f", *values))
    return pc2


def jobs(anicodec, folder):
    """Two clips of one mesh, and what is made of them."""
    clips, parts = [], []
    for name, turn in (("a", 0.1), ("b", 0.23)):
        (folder / name).mkdir()
        for clip in ("x", "y"):
            pc2 = write_clip(folder / name / f"{clip}.obj", turn)
        clips.append(folder / f"{name}.anic")
        run([anicodec, "encode", pc2.with_suffix(".obj"), pc2, *FAST, "-o", clips[-1]], folder)
        for half in ("0:2", "2:3"):
            parts.append(folder / f"{name}{half[0]}.anic")
            run([anicodec, "encode", pc2.with_suffix(".obj"), pc2, *FAST, "--part", half, "-o", parts[-1]], folder)

    def encode(name):
        return [anicodec, "encode", folder / name / "x.obj", folder / name / "x.pc2", *FAST, "-f", "-o", "{}/s.anic"]

    def decode(clip, output):
        return [anicodec, "decode", clip, "-f", "-q", "-o", output]

    def batch(name):
        return [anicodec, "encode", "--batch", folder / name, "-o", "{}", *FAST]

    def join(first):
        return [anicodec, "join", *parts[first:first + 2], "-f", "-q", "-o", "{}/s.anic"]

    def compare(files):
        return [anicodec, "compare", files, files, "--no-sted"]

    live = [anicodec, "encode", "--live", folder / "a/x.obj", "--fps", 1, *FAST, "-f", "-o", "{}/s.anic"]
    frames, piece = folder / "frames", folder / "piece.anic"
    frames.write_bytes((folder / "a/x.pc2").read_bytes()[32:])
    with open(frames, "rb") as file:
        subprocess.run([str(c) for c in live[:-1]] + [str(piece)], input=file.read()[:48], check=True)
    stream = {"stdin": frames, "pieces": piece.stat().st_size}
    objs, more = decode(clips[0], "{}/f_%d.obj"), folder / "b/y.pc2"
    yield Job("encode", encode("a"))
    yield Job("encode to new folders", [*encode("a")[:-1], "{}/new/deep/s.anic"])
    yield Job("encode over a file", encode("a"), [encode("b")], again=True)
    yield Job("add in place", [anicodec, "add", "{}/s.anic", more, "--name", "more", *FAST, "-f"], [encode("a")])
    yield Job("join over a file", join(0), [join(2)], again=True)
    yield Job("batch", batch("a"), again=True)
    yield Job("batch over files", batch("a"), [batch("b")], again=True)
    yield Job("live", live, **stream)
    yield Job("live over a file", live, [encode("b")], **stream)
    over = [decode(clips[1], "{}/f_%d.obj")]
    yield Job("frames", objs, reader=compare("{}/f_*.obj"))
    yield Job("frames over files", objs, over, compare("{}/f_*.obj"))
    yield Job("frames over files, the last rename fails", objs, over, compare("{}/f_*.obj"), fail=4)
    yield Job("mesh and cache over files", decode(clips[0], "{}/f.pc2"), [decode(clips[1], "{}/f.pc2")],
              compare("{}/f.pc2"))


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    anicodec, library = (pathlib.Path(p).resolve() for p in sys.argv[1:3])
    faults = []
    memory = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None  # flushing costs nothing there
    with tempfile.TemporaryDirectory(dir=memory) as folder:
        for number, job in enumerate(jobs(anicodec, pathlib.Path(folder))):
            work = pathlib.Path(folder) / f"job{number}"
            work.mkdir()
            found, count = job.run(library, work)
            faults += found
            print(f"{job.name}: {count} disks, {len(found)} faults")
            if "-v" in sys.argv:
                print(*found, sep="\n", end="\n" if found else "")
    print(f"{len(faults)} faults", *faults[:20], sep="\n")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
