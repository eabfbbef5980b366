# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Nothing leaks: the memory of the process stays where it is."""
import gc
import os
import pathlib

import numpy as np
import pytest

import anicodec

MOST_GROWTH = 6 << 20


def resident():
    gc.collect()
    return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def use(wave, clip):
    positions, faces = wave
    anicodec.encode(positions, faces, effort="fast", uv=positions[0, :, :2])
    anicodec.open(clip.data)[:].sum()
    clip.normals(3, crease=30)
    clip.at(0.3)
    with pytest.raises(anicodec.Cancelled):
        anicodec.encode(positions, faces, progress=lambda stage, done: False)
    with pytest.raises(ZeroDivisionError):
        anicodec.encode(positions, faces, progress=lambda stage, done: 1 / 0)
    with pytest.raises(anicodec.CorruptError):
        anicodec.open(clip.data[:-1])
    with pytest.raises(anicodec.InputError):
        anicodec.encode(np.full((9, 3000, 3), np.nan))


@pytest.mark.skipif(not pathlib.Path("/proc/self/statm").exists(), reason="there is no /proc")
def test_loops_hold_no_memory(wave, clip):
    for _ in range(8):
        use(wave, clip)
    before = resident()
    for _ in range(40):
        use(wave, clip)
    assert resident() - before < MOST_GROWTH
