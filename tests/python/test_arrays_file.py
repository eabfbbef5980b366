# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Clips from files of numpy, and the command without the packages that other inputs need."""
import subprocess
import sys

import numpy as np
import pytest

import anicodec
from anicodec import _vtk_command


def run(*arguments):
    return subprocess.run([sys.executable, "-m", "anicodec", *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def test_arrays_become_a_clip(tmp_path, wave):
    positions, faces = wave
    np.save(tmp_path / "wave.npy", positions)
    np.save(tmp_path / "faces.npy", faces)
    np.savez(tmp_path / "wave.npz", points=positions.astype(np.float64), cells=faces, times=np.arange(24) * 0.25, heat=positions[:, :, 2])
    told = run("encode", tmp_path / "wave.npy", "--faces", tmp_path / "faces.npy", "-o", tmp_path / "a.anic", "--fps", 30, "--effort", "fast")
    assert told.returncode == 0 and "24 frames at 30 fps" in told.stdout and not told.stderr, told.stderr
    told = run("encode", tmp_path / "wave.npz", "-o", tmp_path / "b.anic", "--effort", "fast", "--keyframe-selection", "pivot", "--memory", "500M")
    assert told.returncode == 0, told.stderr
    clip = anicodec.open(tmp_path / "b.anic")
    assert clip.time(23) == pytest.approx(23 / 4) and [a.name for a in clip.attributes] == ["heat"] and len(clip.faces) == len(faces)
    assert np.abs(clip.attribute_at(0, clip.time(7))[:, 0] - positions[7, :, 2]).max() < 1e-3
    told = run("encode", tmp_path / "wave.npz", "-o", tmp_path / "c.anic", "--effort", "fast", "--fields", "none")
    assert told.returncode == 0 and not anicodec.open(tmp_path / "c.anic").attributes


def test_bad_arrays_are_named(tmp_path, wave, capsys):
    (tmp_path / "text.npy").write_text("no array")
    np.save(tmp_path / "flat.npy", wave[0][0])
    np.savez(tmp_path / "other.npz", x=wave[0])
    np.save(tmp_path / "objects.npy", np.array([{}]), allow_pickle=True)
    bad = wave[0].copy()
    bad[3, 5] = np.nan
    np.save(tmp_path / "nan.npy", bad)
    for name, text in (("text.npy", "numpy cannot read it"), ("flat.npy", "frames x vertices x 3, not 144 x 3"), ("no.npy", "no such file"),
                       ("other.npz", "has no array positions or points or vertices; there is x"), ("objects.npy", "numpy cannot read it"),
                       ("nan.npy", "frame 3")):
        assert _vtk_command.main(["encode", str(tmp_path / name), "-o", str(tmp_path / "x.anic")]) in (1, 2)
        told = capsys.readouterr().err
        assert name in told and text in told and len(told.splitlines()) == 1 and not (tmp_path / "x.anic").exists(), told


def test_the_command_names_the_extra():
    script = "import sys; sys.modules['vtkmodules'] = None; sys.argv = ['anicodec', 'encode', 'run.pvd', '-o', 'x.anic']; " \
             "from anicodec.__main__ import main; main()"
    result = subprocess.run([sys.executable, "-c", script], stderr=subprocess.PIPE, text=True)
    assert result.returncode == 4 and "pip install 'anicodec[vtk]'" in result.stderr, result.stderr


def test_a_clip_becomes_arrays(tmp_path, wave, capsys):
    positions, faces = wave
    mixed = [*map(list, faces[:-1]), list(faces[-1][:3])]
    for polygons in (faces, mixed):
        clip = anicodec.open(anicodec.encode(positions, polygons, fps=12, start_time=3, effort="fast", order="all",
                                             custom={"times": positions[:, :, 2:], "weight": positions[0, :, :1]}))
        (tmp_path / "wave.anic").write_bytes(clip.data)
        assert _vtk_command.main(["decode", str(tmp_path / "wave.anic"), "-o", str(tmp_path / "wave.npz"), "-f"]) == 0
        with np.load(tmp_path / "wave.npz") as stored:
            assert np.array_equal(stored["positions"], clip[:]) and stored["times"][-1] == pytest.approx(3 + 23 / 12)
            assert stored["times_"].shape == (24, 144, 1) and stored["weight"].shape == (144, 1)
        assert _vtk_command.main(["encode", str(tmp_path / "wave.npz"), "-o", str(tmp_path / "again.anic"), "-f", "--lossless", "--order", "all"]) == 0
        again = anicodec.open(tmp_path / "again.anic")
        assert np.array_equal(again[:], clip[:]) and np.array_equal(again.triangles, clip.triangles) and again.fps == 12
