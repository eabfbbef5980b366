# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Captures that are encoded while they go on."""
import math
import subprocess
import sys
import threading

import numpy as np
import pytest

import anicodec

FACES = [(i, i + 1, i + 2) for i in range(58)]
VERTICES, FRAMES = 60, 25


def frame(f):
    x = np.linspace(0, 6, VERTICES)
    return np.stack([x, np.sin(2 * x + 0.3 * f), 0 * x], axis=1)


def begin(**options):
    return anicodec.encode_live(FACES, vertex_count=VERTICES, fps=10, effort="fast", threads=1,
                                **{"max_error": 0.001, **options})


def played(pieces, tmp_path):
    """The clip that the files make."""
    path = tmp_path / "take.anic"
    path.write_bytes(b"".join(pieces))
    joined = tmp_path / "clip.anic"
    subprocess.run([sys.executable, "-m", "anicodec", "join", path, "-o", joined, "-q"], check=True)
    return anicodec.open(joined)


def test_frames_in_pieces_out(tmp_path):
    with begin(key_every=2, name="strip", up="y") as live:
        assert live.take() is None and live.info.piece_frames == 10
        for f in range(FRAMES):
            live.push(frame(f))
        live.end()
        pieces = list(live)
        assert live.info.ended and live.info.pushed_frames == FRAMES and live.info.waiting_frames == 0
        assert live.take() is None
        with pytest.raises(anicodec.InputError, match="ended"):
            live.push(frame(0))
    assert [(p.first_frame, p.frame_count, p.key, p.has_mesh) for p in pieces] == \
        [(0, 10, True, True), (10, 10, False, False), (20, 5, True, False)]
    assert all(p.max_error <= 0.001 and p.encode_seconds > 0 for p in pieces) and pieces[2].start_time == 2
    clip = played(pieces, tmp_path)
    assert len(clip) == FRAMES and clip.info["up"] == "y"
    for f in range(FRAMES):
        assert np.abs(clip[f] - frame(f)).max() <= 0.001
    with pytest.raises(anicodec.InputError, match="closed"):
        live.take()


def test_attributes_that_move(tmp_path):
    def heat(f):
        return np.cos(0.1 * np.arange(VERTICES) + 0.2 * f)[:, None]

    live = begin(custom={"heat": anicodec.Moving("vertices", 1)}, uv=np.zeros((VERTICES, 2)),
                 colours=anicodec.Moving("polygons", 3), attribute_error=0.01)
    colours = np.full((len(FACES), 3), 0.25)
    for f in range(20):
        live.push(frame(f), custom={"heat": heat(f)}, colours=colours + 0.02 * f)
    for wrong in ({}, {"custom": {"heat": heat(0)}}, {"custom": {"heat": heat(0)[1:]}, "colours": colours},
                  {"custom": {"heat": heat(0)}, "colours": colours, "uv": np.zeros((VERTICES, 2))}):
        with pytest.raises(anicodec.InputError):
            live.push(frame(0), **wrong)
    live.end()
    pieces = list(live)
    assert live.info.pushed_frames == 20 and [p.has_mesh for p in pieces] == [True, False]
    clip = played(pieces, tmp_path)
    names = [(a.kind, a.name) for a in clip.meshes[0].attributes]
    assert sorted(names) == [("colour", ""), ("custom", "heat"), ("uv", "")]
    for f in (0, 7, 19):
        values = clip.meshes[0].attribute_at(names.index(("custom", "heat")), f / 10)
        assert np.abs(values - heat(f)).max() <= 0.01
    with pytest.raises(anicodec.InputError, match="live"):
        anicodec.encode(np.stack([frame(0)]), FACES, custom={"heat": anicodec.Moving("vertices", 1)})


def test_two_threads_and_room():
    live = begin(most_waiting=10, piece=0.5)
    taken = []
    taker = threading.Thread(target=lambda: taken.extend(live))
    taker.start()
    for f in range(40):
        live.push(frame(f), wait=60)
        assert live.info.waiting_frames <= 10
    live.end()
    taker.join()
    assert sum(p.frame_count for p in taken) == 40


TAKES = """
live = anicodec.encode_live([(0, 1, 2)], vertex_count=3, fps=30)
work = lambda: [None for _ in live]
"""
ENCODES = """
import numpy as np
positions = np.random.default_rng(1).normal(size=(200, 3000, 3))
work = lambda: anicodec.encode(positions, [(0, 1, 2)], max_error="0.01%", progress=lambda *_: None)
"""


@pytest.mark.parametrize("work", (TAKES, ENCODES))
def test_a_program_ends_beside_a_daemon_thread(work):
    program = "import threading, time, anicodec\n" + work + "threading.Thread(target=work, daemon=True).start(); time.sleep(0.3)\n"
    for _ in range(3):
        ended = subprocess.run([sys.executable, "-c", program], capture_output=True, check=False, timeout=100)
        assert (ended.returncode, ended.stderr) == (0, b"")


def test_what_cannot_be():
    live = begin(most_waiting=10)
    with pytest.raises(anicodec.InputError, match="60 x 3"):
        live.push(frame(0)[1:])
    bad = frame(0)
    bad[3, 1] = math.nan
    with pytest.raises(anicodec.InputError, match="frame 0: vertex 3"):
        live.push(bad)
    with pytest.raises(anicodec.LimitError, match="behind"):
        for f in range(100000):
            live.push(frame(f % 20))
    for options in ({"size": 1000, "max_error": None}, {"lossless": True, "max_error": None}, {"keyframes": 3}, {"piece": -1}, {"box": math.inf},
                    {"most_waiting": 3}, {"massage": "on"}, {"origin": "auto"}, {"up": "x"}):
        with pytest.raises(anicodec.InputError):
            begin(**options)
    with pytest.raises(TypeError, match="colour"):
        begin(colour=1)
    end = begin(max_error=1e-12)
    end.push(frame(0))
    end.push(frame(1))
    end.end()
    with pytest.raises(anicodec.InputError, match="the frames from 0 on"):
        list(end)
