#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# alembic3d 1.8.12.1 (PyPI), the Python bindings of Alembic itself: ISampleSelector of a whole number.
#
# In C++ ISampleSelector(3) selects sample 3, and its documentation in Python names an (int)requestedIndex. There it selects the time of
# 3 seconds: Boost.Python tries the last constructor that was declared first, and that one takes a float, which an int becomes. A loop over
# the samples of a mesh at 24 per second gets the first once and then always the last, without an error.
#
# Output seen: "selector 0 4 4 4 4, keyword 0 1 2 3 4, number 0 1 2 3 4". Exit status 1 if it is another.
# Way out: ISampleSelector(requestedIndex=3), or the number itself.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"${PYTHON:-python3}" -m venv pip >/dev/null
pip/bin/pip install --quiet --disable-pip-version-check alembic3d==1.8.12.1

cat >samples.py <<'P'
import imath
from alembic3d import Abc, AbcCoreAbstract, AbcGeom

archive = Abc.OArchive("moving.abc")
times = archive.addTimeSampling(AbcCoreAbstract.TimeSampling(1 / 24, 0.0))
mesh = AbcGeom.OPolyMesh(archive.getTop(), "mesh", times)
corners, counts = imath.IntArray(3), imath.IntArray(1)
counts[0] = 3
for corner in range(3):
    corners[corner] = corner
for sample in range(5):
    points = imath.V3fArray(3)
    for point in range(3):
        points[point] = imath.V3f(sample, point % 2, point // 2)
    mesh.getSchema().set(AbcGeom.OPolyMeshSchemaSample(points, corners, counts))
del mesh, archive

schema = AbcGeom.IPolyMesh(Abc.IArchive("moving.abc").getTop(), "mesh").getSchema()
ways = {"selector": Abc.ISampleSelector, "keyword": lambda number: Abc.ISampleSelector(requestedIndex=number), "number": lambda number: number}
for name, way in ways.items():
    seen = [int(schema.getValue(way(sample)).getPositions()[0].x) for sample in range(schema.getNumSamples())]
    ways[name] = " ".join(map(str, seen))
print(", ".join(f"{name} {seen}" for name, seen in ways.items()))
P
seen=$(pip/bin/python samples.py)
echo "$seen"
[[ $seen == "selector 0 4 4 4 4, keyword 0 1 2 3 4, number 0 1 2 3 4" ]]
