#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
#
# Draco of DracoPy 2.2.0: memory of the encoder grows with 2^bits of quantization, not with the mesh.
#
# Draco's encoder counts symbols in arrays as long as the largest difference of quantized coordinates: one for each attribute, and at
# the compression levels 9 and 10 a second one, longer, with which it chooses among parallelograms and which lives until the file is
# done. Sixty points at random take 47 MB and 0.09 s of a processor with 22 bits, and no memory that can be measured with 12: so do
# all meshes whose neighbours are far apart in steps of the quantization. The file of level 10 is four bytes larger than that of
# level 8, which takes a third of the memory: counts of symbols that are seen once each tell nothing.
#
# Output seen: "12 bits: 0 MB; 22 bits: level 8 16 MB, 1108 bytes; level 10 47 MB, 1112 bytes" (MB may differ a little).
# Exit status 1 if the memory of 22 bits is below 8 or 24 MB, or level 10 gives the smaller file.
# Way out: level 8 or less for fine quantization (EncoderOptions: prediction_scheme of the attribute); fewer bits.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check DracoPy==2.2.0 numpy==2.4.6

cat >try.py <<'P'
import resource
import sys

import DracoPy
import numpy

bits, level = map(int, sys.argv[1:])
points = numpy.random.default_rng(1).random((60, 3))
faces = numpy.arange(58, dtype=numpy.uint32)[:, None] + numpy.arange(3, dtype=numpy.uint32)
DracoPy.encode(points, faces, quantization_bits=8, compression_level=level)  # what the library takes by itself
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
file = DracoPy.encode(points, faces, quantization_bits=bits, compression_level=level)
print((resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) // 1024, len(file))
P
read -r few _ <<<"$(venv/bin/python try.py 12 10)"
read -r low low_bytes <<<"$(venv/bin/python try.py 22 8)"
read -r high high_bytes <<<"$(venv/bin/python try.py 22 10)"
echo "12 bits: $few MB; 22 bits: level 8 $low MB, $low_bytes bytes; level 10 $high MB, $high_bytes bytes"
((few < 4 && low >= 8 && high >= 24 && high_bytes >= low_bytes))
