#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Checks that every module includes only what it may (tools -> codec -> sdk -> format), that rooms,
the folders of a module, use one another in one direction only, and of the modules below the rooms that they name,
that each room is described and small, and that no two units share a name.

usage: check_layering.py CHECKOUT      one line for every fault; exit status 1 if there is any
"""
import pathlib
import re
import sys

# Vectors of the machine.
SIMD = ["<immintrin.h>", "<xmmintrin.h>", "<emmintrin.h>", "<arm_neon.h>", "<wasm_simd128.h>", "<cpuid.h>"]
STREAMS = {"<iostream>", "<fstream>", "<sstream>", "<filesystem>", "<istream>", "<ostream>", "<streambuf>"}
POSIX = ["<dlfcn.h>", "<fcntl.h>", "<glob.h>", "<poll.h>", "<spawn.h>", "<sys/file.h>", "<sys/prctl.h>", "<sys/resource.h>",
         "<sys/stat.h>", "<sys/wait.h>", "<unistd.h>"]

MODULES = ("format", "sdk", "codec", "corpus", "tools", "bindings")
# Prefixes of what a module may include beside the standard library.
ALLOWED = {
    "format": ['"format/', "<zstd.h>", "<xxhash.h>", *SIMD],
    "sdk": ["<stddef.h>", "<stdint.h>", "<string.h>", '"sdk/', '"format/', "<anicodec/", *SIMD],
    "codec": ['"codec/', '"sdk/', '"format/', "<anicodec/", "<Eigen/", "<unsupported/Eigen/BVH>"],
    # All parallel work: nobody calls TBB past it, which leaves out bodies without a word.
    "codec/parallel": ['"codec/parallel/', '"sdk/base/', "<tbb/"],
    # Frames that the memory does not hold lie in files.
    "codec/sequence": ['"codec/sequence/', '"sdk/', '"format/', "<fcntl.h>", "<sys/mman.h>", "<unistd.h>"],
    "corpus": ['"corpus/', '"codec/', "<xxhash.h>"],
    "tools": ['"tools/', '"corpus/', '"codec/', '"sdk/', '"format/', "<anicodec/",
              "<fmt/", "<nlohmann/", *POSIX],
    # Importers and exporters need no encoder: of codec/, only what a mesh in motion is,
    # and the threads.
    "tools/io": ['"tools/io/', '"codec/sequence/', '"codec/parallel/', '"sdk/', '"format/', "<fmt/", "<nlohmann/", *POSIX],
    "bindings/python": ['"bindings/python/', '"codec/', '"tools/commands/command_line.h"', "<anicodec/", "<nanobind/", "<dlfcn.h>"],
    "bindings/usd": ['"bindings/usd/', "<anicodec/", "<pxr/", "<dlfcn.h>", "<link.h>", "<unistd.h>"],
    "bindings/web": ['"bindings/web/', "<anicodec/", "<stddef.h>", "<stdlib.h>", "<string.h>"],
    "bindings/engines/ogre": ['"bindings/engines/ogre/', "<anicodec/", "<Ogre"],
    # By names alone, as Unreal's modules find headers.
    "bindings/engines/unreal": ['"', "<anicodec/"],
}
# Rooms, each with the rooms of its module that it may include: only rooms that stand above it, so that all
# arrows point one way. A folder with sources is a room and has a README.md.
ROOMS = {
    "format": [],
    "format/coding": ["format"],
    "sdk/base": [],
    "sdk/mesh": ["sdk/base"],
    "sdk/msgi": ["sdk/base", "sdk/mesh"],
    "sdk/prediction": ["sdk/base"],
    "sdk/pose": ["sdk/base", "sdk/mesh"],
    "sdk/segment": ["sdk/base", "sdk/mesh", "sdk/msgi", "sdk/pose", "sdk/prediction"],
    "sdk/exact": ["sdk/base", "sdk/mesh", "sdk/segment"],
    "sdk/play": ["sdk/base", "sdk/mesh", "sdk/segment"],
    "sdk/clip": ["sdk/base", "sdk/mesh", "sdk/msgi", "sdk/pose", "sdk/prediction", "sdk/segment", "sdk/exact",
                 "sdk/play"],
    "sdk/api": ["sdk/base", "sdk/mesh", "sdk/msgi", "sdk/play", "sdk/clip"],
    "codec/sequence": [],
    "codec/parallel": [],
    "codec/algebra": ["codec/sequence", "codec/parallel"],
    "codec/surface": ["codec/sequence", "codec/parallel"],
    "codec/metrics": ["codec/sequence", "codec/parallel", "codec/surface"],
    "codec/connectivity": ["codec/sequence"],
    "codec/massage": ["codec/sequence", "codec/parallel", "codec/algebra", "codec/surface", "codec/connectivity"],
    "codec/transfer": ["codec/sequence", "codec/parallel", "codec/algebra", "codec/surface", "codec/metrics",
                       "codec/massage"],
    "codec/remesh": ["codec/sequence", "codec/surface", "codec/connectivity", "codec/transfer"],
    "codec/interpolation": ["codec/sequence", "codec/parallel", "codec/algebra", "codec/surface"],
    "codec/keyframes": ["codec/sequence", "codec/parallel", "codec/algebra", "codec/interpolation"],
    "codec/studies": ["codec/sequence", "codec/algebra", "codec/surface", "codec/connectivity",
                      "codec/interpolation", "codec/keyframes"],
    "codec/motion": ["codec/sequence", "codec/parallel", "codec/algebra"],
    "codec/segment": ["codec/sequence", "codec/parallel", "codec/surface", "codec/algebra", "codec/connectivity",
                      "codec/keyframes", "codec/motion"],
    "codec/plan": ["codec/sequence", "codec/connectivity", "codec/keyframes", "codec/massage", "codec/motion", "codec/segment"],
    "codec/file": ["codec/sequence", "codec/connectivity", "codec/segment", "codec/plan"],
    "codec/search": ["codec/sequence", "codec/parallel", "codec/algebra", "codec/metrics", "codec/connectivity",
                     "codec/keyframes", "codec/motion",
                     "codec/segment", "codec/plan", "codec/file"],
    "codec": ["codec/sequence", "codec/parallel", "codec/algebra", "codec/connectivity", "codec/metrics",
              "codec/massage", "codec/segment",
              "codec/plan", "codec/file", "codec/search"],
    "codec/api": ["codec/sequence", "codec/parallel", "codec/plan", "codec"],
    "tools/io/base": [],
    "tools/words": [],
    "tools/options": ["tools/words"],
    "tools/listing": ["tools/words", "tools/io/base"],
    "tools/program": ["tools/words", "tools/options", "tools/io/base"],
    "tools/io/files": ["tools/io/base"],
    "tools/io/formats": ["tools/io/base", "tools/io/files"],
    "tools/io/guard": [],
    "tools/io/gltf": ["tools/io/base", "tools/io/files", "tools/io/guard"],
    "tools/io/alembic": ["tools/io/base", "tools/io/files"],
    "tools/io/fbx": ["tools/io/base", "tools/io/files", "tools/io/guard", "tools/io/gltf"],
    "tools/io/assimp": ["tools/io/base", "tools/io/files", "tools/io/guard", "tools/io/gltf"],
    "tools/io": ["tools/io/base", "tools/io/files", "tools/io/formats", "tools/io/gltf", "tools/io/alembic",
                 "tools/io/assimp", "tools/io/fbx"],
    "tools/peers": [],
    "tools/render": ["tools/io/base", "tools/io/files"],
    "tools/textures": ["tools/words", "tools/io/gltf"],
    "tools/inputs": ["tools/words", "tools/options", "tools/io", "tools/io/base", "tools/io/files", "tools/io/gltf"],
    "tools/report": ["tools/words", "tools/io/base", "tools/peers", "tools/render", "tools/inputs"],
    "tools/encoding": ["tools/words", "tools/program", "tools/io", "tools/io/base", "tools/io/files", "tools/inputs"],
    "tools/commands": ["tools/words", "tools/options", "tools/program", "tools/listing", "tools/io", "tools/io/base", "tools/io/files",
                       "tools/io/gltf", "tools/render", "tools/textures", "tools/inputs", "tools/report", "tools/encoding"],
    "tools": ["tools/commands"],
    "bindings/engines/ogre": [],
    "bindings/usd": [],
}
# Rooms of lower modules that a room, or one file of it, may use; not the rooms inside them.
# Commands play through the C interface; what looks into a file is named.
REACH = {
    "codec/sequence": ["format", "sdk/mesh", "sdk/play"],
    "codec/parallel": ["sdk/base"],
    "codec/algebra": ["format", "sdk/base"],
    "codec/surface": ["sdk/mesh", "sdk/msgi"],
    "codec/metrics": ["sdk/mesh"],
    "codec/connectivity": ["format", "sdk/clip", "sdk/mesh"],
    "codec/interpolation": ["sdk/msgi"],
    "codec/keyframes": ["sdk/msgi"],
    "codec/motion": ["format"],
    "codec/segment": ["format", "format/coding", "sdk/base", "sdk/exact", "sdk/mesh", "sdk/play", "sdk/pose", "sdk/prediction",
                      "sdk/segment"],
    "codec/plan": ["format"],
    "codec/file": ["format", "format/coding", "sdk/clip", "sdk/mesh", "sdk/pose"],
    "codec/search": ["format", "format/coding", "sdk/clip", "sdk/prediction"],
    "codec": ["format"],
    "codec/check_file.cpp": ["sdk/api"],  # plays what was made, and goes on learning
    "codec/encode_mesh.cpp": ["sdk/clip"],
    "codec/encode_live.h": ["sdk/clip"],
    "codec/api": ["sdk/api"],
    "corpus": ["codec/sequence", "codec/surface"],
    "tools/io/base": ["codec/sequence", "format"],
    "tools/words": ["codec/sequence", "codec/transfer", "format"],
    "tools/options": ["codec/sequence"],
    "tools/listing": ["format"],
    "tools/program": ["codec/sequence", "codec/parallel"],
    "tools/io/files": ["codec/sequence", "format"],
    "tools/io/formats": ["codec/sequence", "format"],
    "tools/io/guard": ["codec/sequence"],
    "tools/io/gltf": ["codec/sequence", "codec/parallel", "format"],
    "tools/io/alembic": ["codec/sequence", "format"],
    "tools/io/fbx": ["codec/sequence", "format"],
    "tools/io/assimp": ["codec/sequence", "format"],
    "tools/io": ["codec/sequence", "format"],
    "tools/peers": ["codec/sequence", "codec/metrics"],
    "tools/render": ["codec/sequence", "codec/parallel"],
    "tools/textures": ["codec/sequence", "codec/algebra"],
    "tools/inputs": ["codec/sequence", "codec/surface", "codec/transfer", "codec/remesh", "codec/plan", "codec/file", "codec", "format"],
    "tools/inputs/stream_input.h": ["sdk/clip"],
    "tools/inputs/stream_input.cpp": ["sdk/clip"],
    "tools/report": ["codec/sequence", "codec/parallel", "codec/algebra", "codec/surface", "codec/metrics", "codec/massage",
                     "codec/interpolation", "codec/keyframes", "codec/studies", "codec/plan", "codec/file", "codec", "format"],
    "tools/encoding": ["codec/sequence", "codec/parallel", "codec/plan", "codec/file", "codec", "format"],
    "tools/commands": ["codec/sequence", "codec/surface", "codec/metrics", "codec/massage", "codec/transfer", "codec/remesh",
                       "codec/interpolation", "codec/studies", "codec/plan", "codec/file", "codec", "corpus"],
    "tools/commands/command_dump.cpp": ["format"],
    "tools/commands/command_info.cpp": ["format", "sdk/clip"],
    "tools/commands/command_verify.cpp": ["format", "sdk/clip"],
    "bindings/python/binding": ["codec/sequence", "codec/metrics", "codec/massage", "tools/commands"],
}
# A unit is a header, a source, or both of one name. A room of more is a hall, to be divided.
MAX_UNITS = 20
# Folders that hold no room: the public headers, programs that use them, stand-ins, and what is installed.
NOT_ROOMS = {"codec/include/anicodec", "codec/examples", "sdk/include/anicodec", "sdk/examples", "sdk/package",
             "bindings/python/binding", "bindings/web/binding", "sdk/draco_headers", "bindings/engines/ogre/example",
             *(f"bindings/engines/unreal/Source/{folder}" for folder in ("Anicodec/Public", "Anicodec/Private", "AnicodecEditor/Private")),
             "bindings/usd/stand_ins/pxr/tf"}
# One file calls Draco's decoder, one its encoder. OpenMesh changes connectivity and does nothing else.
EXCEPTIONS = {"sdk/mesh/draco_poses.cpp": ["<draco/"], "sdk/mesh/draco_corners.h": ["<draco/"],
              "codec/connectivity/draco_encode.cpp": ["<draco/"],
              "sdk/examples/gl_sample.h": ["<GL/", "<stddef.h>", "<time.h>"],
              "sdk/examples/gl_sample.c": ['"gl_sample.h"'],
              "sdk/examples/gl_window.h": ["<SDL2/"],
              "sdk/examples/gl_window.c": ['"gl_window.h"', '"gl_sample.h"'],
              "sdk/examples/card_clip.h": ['"gl_sample.h"'],
              "sdk/examples/card_clip.c": ['"card_clip.h"', '"anicodec_play.inc"', "<string.h>"],
              "sdk/examples/draw.c": ['"card_clip.h"', '"gl_window.h"'],
              "sdk/examples/crowd.c": ['"card_clip.h"', '"gl_window.h"', "<string.h>"],
              "sdk/examples/buffers.c": ["<time.h>"],
              "bindings/engines/ogre/ogre_shader.h": ['"anicodec_play.inc"'],
              "sdk/api/open.cpp": ["<malloc.h>"],
              "codec/file/metadata_json.cpp": ["<nlohmann/"],
              "codec/remesh/decimate.cpp": ["<OpenMesh/"],
              "codec/remesh/isotropic.cpp": ["<OpenMesh/"],
              "codec/remesh/subdivide.cpp": ["<OpenMesh/"],
              "tools/options/parse_options.cpp": ["<CLI/"],
              "tools/render/image.cpp": ["<png.h>", "<gif_lib.h>"],
              "tools/render/shaded_view.cpp": ["<Eigen/"],
              "tools/textures/basis_textures.cpp": ["<Eigen/"],
              "tools/textures/data_texture.cpp": ["<png.h>", "<tinyexr.h>"],
              "tools/textures/vat_shaders.cpp": ['"anicodec_vat_shaders.inc"'],
              "tools/io/assimp/assimp_import.cpp": ["<assimp/"],
              "tools/io/fbx/fbx_scene.h": ["<ufbx.h>"],
              "tools/io/fbx/fbx_material.h": ["<ufbx.h>"],
              "tools/io/alembic/abc_xform.h": ["<Eigen/"],
              "tools/io/alembic/abc_xform.cpp": ["<Eigen/"],
              "tools/io/alembic/alembic_bake.cpp": ["<Eigen/"],
              "tools/io/gltf/gltf_animation.cpp": ["<Eigen/"],
              "tools/io/gltf/gltf_bake.cpp": ["<Eigen/"],
              "tools/io/gltf/gltf_draco.cpp": ["<draco/"],
              "tools/io/gltf/gltf_meshopt.cpp": ["<meshoptimizer.h>"],
              "tools/peers/draco_frames.cpp": ["<draco/"],
              "tools/peers/frame_deltas.cpp": ["<meshoptimizer.h>", "<zstd.h>"],
              "tools/peers/raw_cache.cpp": ["<lzma.h>", "<zstd.h>"]}
# Headers that a host would include, and no more.
EXAMPLES = ["<anicodec/", "<math.h>", "<stdio.h>", "<stdlib.h>"]
# Memory in, memory out; and no exceptions leave the decoder.
# One file of the decoder says that there is no memory; whoever calls the library sees a status.
# The edge of the C interface gives back what it has taken and rethrows, to where all is caught.
THROWS = {"format/memory.cpp", "sdk/api/open.cpp", "sdk/api/morpher.cpp",
          "sdk/api/normals.cpp", "sdk/api/objects.h", "sdk/api/render_vertices.cpp"}
NO_STREAMS = {"format", "sdk", "codec"}
NO_THROW = {"format", "sdk"}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"][^>"]*[>"])', re.MULTILINE)
STANDARD = re.compile(r"^<[a-z_0-9]+>$")
# Extensions of compilers stand in one header.
EXTENSION = re.compile(r"__builtin_\w+|__attribute__")
EXTENDS = {"format/compiler.h", "sdk/include/anicodec/play.h"}
NO_EXTENSIONS = {"format", "sdk", "codec"}
THROW = re.compile(r"^[^/\"]*\bthrow\b", re.MULTILINE)


def sources(folder):
    return [path for path in sorted(folder.rglob("*"))
            if path.suffix in (".h", ".cpp", ".hpp", ".c") and not {"node_modules", "target"} & {*path.parts}]  # others' and built ones


def module_of(name):
    """The longest key of ALLOWED that the file's folders begin with."""
    return max((m for m in ALLOWED if name.startswith(m + "/")), key=len)


# Work in parallel by other means than codec/parallel: the standard's algorithms, or compilers' own.
PAST_PARALLEL = re.compile(r"\btbb::|\bstd::execution\b|#\s*pragma\s+omp\b")


def include_faults(checkout):
    found_any = False
    for module in MODULES:
        for path in sources(checkout / module):
            found_any = True
            name = path.relative_to(checkout).as_posix()
            text = path.read_text(encoding="utf-8")
            allowed = ALLOWED[module_of(name)] + EXCEPTIONS.get(name, [])
            if name.startswith(("codec/examples/", "sdk/examples/")):
                allowed = EXAMPLES + EXCEPTIONS.get(name, [])
            room = name.rpartition("/")[0]
            for header in INCLUDE.findall(text):
                streams = module in NO_STREAMS and header in STREAMS
                target = header[1:-1].rpartition("/")[0]
                back = room in ROOMS and target in ROOMS and target != room and \
                    target.split("/")[0] == module and target not in ROOMS[room]
                far = target.partition("/")[0] in MODULES and target.partition("/")[0] != module and \
                    module in ("codec", "corpus", "tools", "bindings") and target not in REACH.get(room, []) + REACH.get(name, [])
                if streams or back or far or not (STANDARD.match(header) or any(header.startswith(p) for p in allowed)):
                    yield f"{name} must not include {header}"
            if not name.startswith("codec/parallel/") and PAST_PARALLEL.search(text):
                yield f"{name} must work in parallel by codec/parallel"
            if module in NO_EXTENSIONS and name not in EXTENDS and (found := EXTENSION.search(text)):
                yield f"{name} must leave {found.group()} to format/compiler.h"
            if module in NO_THROW and name not in THROWS and THROW.search(text):
                yield f"{name} must not throw"
    if not found_any:
        yield f"{checkout} has no sources"


def room_faults(checkout):
    above = set()
    for room, uses in ROOMS.items():
        for used in uses:
            if used not in above:
                yield f"{room} may not use {used}, which does not stand above it"
        above.add(room)
    units = {}
    for module in ("sdk", "codec", "tools", "bindings"):
        for path in sources(checkout / module):
            folder, _, base = path.relative_to(checkout).as_posix().rpartition("/")
            units.setdefault(folder, set()).add(base.partition(".")[0])
    for folder, names in units.items():
        if folder.split("/", 2)[:2] == ["sdk", "draco_headers"] or folder in NOT_ROOMS:
            continue
        if folder not in ROOMS:
            yield f"{folder} is not among the rooms"
        elif not (checkout / folder / "README.md").is_file():
            yield f"{folder} has no README.md"
        if len(names) > MAX_UNITS:
            yield f"{folder} has {len(names)} units, more than {MAX_UNITS}"


def name_faults(checkout):
    """Base names that stand in two folders: whoever reads an include or an object's name would not know which."""
    folders = {}
    for module in MODULES:
        for path in sources(checkout / module):
            folder, _, base = path.relative_to(checkout).as_posix().rpartition("/")
            if folder not in NOT_ROOMS and not folder.startswith("sdk/draco_headers"):
                folders.setdefault(base.partition(".")[0], set()).add(folder)
    for base, where in sorted(folders.items()):
        if len(where) > 1:
            yield f"{base} is the name of a unit in {' and in '.join(sorted(where))}"


def faults(checkout):
    yield from include_faults(checkout)
    yield from room_faults(checkout)
    yield from name_faults(checkout)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    lines = list(faults(pathlib.Path(sys.argv[1])))
    print("\n".join(lines) if lines else "every include is allowed")
    sys.exit(1 if lines else 0)


if __name__ == "__main__":
    main()
