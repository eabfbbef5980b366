#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Has Newton simulate bodies and cloth, and its ViewerUSD write stages: for compare_stages.py.

usage: stages_of_newton.py FOLDER [COUNT [SEED]]      in a Python with newton, usd-core and pillow

The first run compiles kernels for minutes; no graphics card is needed.
"""
import pathlib
import random
import sys

import newton
import numpy as np
import warp as wp

CORNERS = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], np.float32)
FACES = np.array([0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3], np.int32)


def add_body(builder, numbers):
    place = wp.transform((numbers.uniform(-2, 2), numbers.uniform(-2, 2), numbers.uniform(2, 4)),
                         wp.quat_rpy(numbers.uniform(-3, 3), numbers.uniform(-3, 3), 0.1))
    body = builder.add_body(xform=place)
    kind = numbers.choice(("box", "sphere", "capsule", "mesh"))
    if kind == "box":
        builder.add_shape_box(body, hx=0.3, hy=0.2, hz=0.4)
    elif kind == "sphere":
        builder.add_shape_sphere(body, radius=0.3)
    elif kind == "capsule":
        builder.add_shape_capsule(body, radius=0.2, half_height=0.4)
    else:
        builder.add_shape_mesh(body, mesh=newton.Mesh(CORNERS, FACES))


def write_one(path, numbers):
    builder = newton.ModelBuilder(up_axis=numbers.choice(("Z", "Y")))
    for _ in range(numbers.randint(1, 4)):
        add_body(builder, numbers)
    if numbers.random() < 0.5:
        builder.add_ground_plane()
    if numbers.random() < 0.7:
        builder.add_cloth_grid(pos=wp.vec3(0, 0, 2), rot=wp.quat_identity(), vel=wp.vec3(0, 0, 0), dim_x=numbers.randint(4, 12),
                               dim_y=numbers.randint(4, 12), cell_x=0.1, cell_y=0.1, mass=0.1, fix_left=True)
    model = builder.finalize(device="cpu")
    solver, now, after = newton.solvers.SolverXPBD(model, iterations=2), model.state(), model.state()
    control, fps = model.control(), numbers.choice((24, 30, 60))
    viewer = newton.viewer.ViewerUSD(str(path), fps=fps, up_axis=builder.up_axis.name, num_frames=None,
                                     scaling=numbers.choice((1.0, 1.0, 100.0)), points_as_spheres=numbers.random() < 0.5)
    viewer.set_model(model)
    crowd = np.array([[x, 0, 0, 0, 0, 0, 1] for x in range(3)], np.float32)
    viewer.log_mesh("crowd/one", wp.array(CORNERS, dtype=wp.vec3, device="cpu"), wp.array(FACES, dtype=wp.int32, device="cpu"))
    for frame in range(numbers.randint(4, 12)):
        viewer.begin_frame(frame / fps)
        viewer.log_state(now)
        crowd[:, 2] += 0.1
        viewer.log_instances_point_instancer("crowd/all", "crowd/one", wp.array(crowd, dtype=wp.transform, device="cpu"), None, None, None)
        viewer.end_frame()
        for _ in range(4):
            now.clear_forces()
            solver.step(now, after, control, None, 1 / fps / 4)
            now, after = after, now
    viewer.close()


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    count, seed = (int(text) for text in (sys.argv[2:4] + ["30", "1"][len(sys.argv) - 2:]))
    for number in range(seed, seed + count):
        write_one(folder / f"{number}.usdc", random.Random(number))


if __name__ == "__main__":
    main()
