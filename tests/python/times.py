# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""The times that tests/rust/times.c prints, in Python: times.py CLIP.anic [ROUNDS]"""
import pathlib
import sys
import time

import anicodec
import numpy as np

data = pathlib.Path(sys.argv[1]).read_bytes()
opening = frame = float("inf")
for _ in range(int(sys.argv[2]) if len(sys.argv) > 2 else 5):
    start = time.process_time()
    clip = anicodec.open(data)
    opening = min(opening, time.process_time() - start)
    mesh = clip.meshes[0]
    out = np.empty((mesh.vertex_count, 3), np.float32)
    times = [clip.time(f) for f in range(clip.frame_count)]
    start = time.process_time()
    for seconds in times:
        mesh.at(seconds, out=out)
    frame = min(frame, (time.process_time() - start) / len(times))
print(f"{1e3 * opening:.3f} {1e3 * frame:.5f}")
