# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Clips that the tests share."""
import pathlib
import subprocess
import sys

import numpy as np
import pytest

import anicodec

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scripts"))  # anic_file


@pytest.fixture(scope="session")
def wave():
    """Positions and faces of a sheet that waves: 24 frames of 12 x 12 vertices, quads."""
    side, frames = 12, 24
    y, x = np.mgrid[0:side, 0:side] / (side - 1)
    t = np.arange(frames)[:, None, None]
    z = 0.1 * np.sin(6 * x + 2 * y + 0.3 * t)
    positions = np.stack(np.broadcast_arrays(x, y, z), axis=3).reshape(frames, -1, 3).astype(np.float32)
    corner = np.arange(side * side).reshape(side, side)
    faces = np.stack([corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:], corner[1:, :-1]], axis=2).reshape(-1, 4)
    return positions, faces


@pytest.fixture(scope="session")
def clip(wave):
    return anicodec.open(anicodec.encode(*wave, fps=24, name="wave", effort="fast"))


@pytest.fixture(scope="session")
def command():
    """Runs the command of the package; its standard output."""
    def run(*arguments, cwd=None):
        return subprocess.run([sys.executable, "-m", "anicodec", *map(str, arguments)], check=True, cwd=cwd,
                              stdout=subprocess.PIPE, text=True).stdout
    return run
