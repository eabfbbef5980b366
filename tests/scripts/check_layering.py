#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Checks that every module includes only what it may: tools -> codec -> sdk -> format.

usage: check_layering.py CHECKOUT      one line for every include that is not allowed; exit status 1 if there is any
"""
import pathlib
import re
import sys

# Vectors of the machine.
SIMD = ["<immintrin.h>", "<xmmintrin.h>", "<emmintrin.h>", "<arm_neon.h>", "<wasm_simd128.h>", "<cpuid.h>"]
STREAMS = {"<iostream>", "<fstream>", "<sstream>", "<filesystem>", "<istream>", "<ostream>", "<streambuf>"}
POSIX = ["<fcntl.h>", "<glob.h>", "<spawn.h>", "<sys/stat.h>", "<sys/wait.h>", "<unistd.h>"]

# Prefixes of what a module may include beside the standard library.
ALLOWED = {
    "format": ['"format/', "<zstd.h>", "<xxhash.h>", *SIMD],
    "sdk": ["<stddef.h>", "<stdint.h>", '"sdk/', '"format/', "<anicodec/", *SIMD],
    "codec": ['"codec/', '"sdk/', '"format/', "<Eigen/", "<tbb/", "<embree3/"],
    "corpus": ['"corpus/', '"codec/', "<xxhash.h>"],
    "tools": ['"tools/', '"corpus/', '"codec/', '"sdk/', '"format/', "<anicodec/",
              "<CLI/", "<fmt/", "<nlohmann/", "<tbb/", *POSIX],
}
# One file calls Draco's decoder, one its encoder.
EXCEPTIONS = {"sdk/draco_mesh.cpp": ["<draco/"], "codec/draco_encode.cpp": ["<draco/"],
              "tools/render/image.cpp": ["<png.h>", "<gif_lib.h>"],
              "tools/render/shaded_view.cpp": ["<Eigen/", "<embree3/"],
              "tools/io/assimp_scene.cpp": ["<assimp/"],
              "tools/io/gltf_animation.cpp": ["<Eigen/"],
              "tools/io/gltf_bake.cpp": ["<Eigen/"],
              "tools/io/gltf_draco.cpp": ["<draco/"],
              "tools/io/gltf_meshopt.cpp": ["<meshoptimizer.h>"],
              "tools/peers/draco_frames.cpp": ["<draco/"],
              "tools/peers/frame_deltas.cpp": ["<meshoptimizer.h>", "<zstd.h>"],
              "tools/peers/raw_cache.cpp": ["<lzma.h>", "<zstd.h>"]}
# What a host would include, and no more.
EXAMPLES = ["<anicodec/", "<math.h>", "<stdio.h>", "<stdlib.h>"]
# Memory in, memory out; and no exceptions leave the decoder.
# One file of the decoder says that there is no memory; whoever calls the library sees a status.
# The edge of the C interface gives back what it has taken and rethrows, to where all is caught.
THROWS = {"format/memory.cpp", "sdk/api_asset.cpp", "sdk/api_interpolator.cpp",
          "sdk/api_normals.cpp", "sdk/api_objects.h"}
NO_STREAMS = {"format", "sdk", "codec"}
NO_THROW = {"format", "sdk"}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"][^>"]*[>"])', re.MULTILINE)
STANDARD = re.compile(r"^<[a-z_0-9]+>$")
THROW = re.compile(r"^[^/\"]*\bthrow\b", re.MULTILINE)


def faults(checkout):
    found_any = False
    for module, prefixes in ALLOWED.items():
        for path in sorted((checkout / module).rglob("*")):
            if path.suffix not in (".h", ".cpp", ".hpp", ".c"):
                continue
            found_any = True
            name = path.relative_to(checkout).as_posix()
            text = path.read_text(encoding="utf-8")
            allowed = prefixes + EXCEPTIONS.get(name, [])
            if name.startswith("sdk/examples/"):
                allowed = EXAMPLES
            for header in INCLUDE.findall(text):
                streams = module in NO_STREAMS and header in STREAMS
                if streams or not (STANDARD.match(header) or any(header.startswith(p) for p in allowed)):
                    yield f"{name} must not include {header}"
            if module in NO_THROW and name not in THROWS and THROW.search(text):
                yield f"{name} must not throw"
    if not found_any:
        yield f"{checkout} has no sources"


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    lines = list(faults(pathlib.Path(sys.argv[1])))
    print("\n".join(lines) if lines else "every include is allowed")
    sys.exit(1 if lines else 0)


if __name__ == "__main__":
    main()
