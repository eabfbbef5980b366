#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Clips against other ways to store them, as their packages of today do: peers.py [--command ANICODEC] [--kg 0.1] [CLIP...]

Prints bytes and processor time in multiples of those of `anicodec encode --kg 0.1 -j1`, which keeps the order of vertices, at no larger
KG error: a peer that rounds gets the largest step that keeps to it. A CLIP is one of the folder $ANICODEC_DATA (classic/dance), a corpus
clip (limb), or a file with an animation to bake (Fox.glb@Survey, --fps 60); without any, the five real ones, or three of the corpus where
there is no data. Packages of PyPI and npm, all of one version, go to a folder that is removed at the end; with --packages FOLDER it is
made once and stays. Bytes, error and times of each clip go to stderr as they are found. Times are of one run: of JavaScript and Python for what exists only there, and of processes for commands.
"""
import argparse
import importlib.metadata
import io
import json
import os
import pathlib
import resource
import shutil
import statistics
import struct
import subprocess
import sys
import tempfile
import time

PYTHON = ("numpy==2.4.6", "scipy==1.17.1", "zstandard==0.25.0", "usd-core==26.11", "alembic3d==1.8.12.1", "bodycompress==0.3.0")
NODE = ("meshoptimizer@1.3.0", "gltfpack@1.3.0", "draco3d@1.5.9")
REAL = ("classic/dance", "classic/horse", "classic/chicken", "simulated/flag", "captured/face")
CORPUS = ("limb", "cloth", "face")
HERE = pathlib.Path(__file__).resolve().parent
RATE = 30  # of animations in GLB, to which gltfpack resamples
MOST_BITS = 16  # of gltfpack


# ---- packages


def install(folder):
    """A virtual environment and a folder of Node in a folder, unless they are there."""
    if not (folder / "done").exists():
        print(f"installs {', '.join(PYTHON + NODE)} into {folder}", file=sys.stderr)
        subprocess.run([sys.executable, "-m", "venv", folder / "venv"], check=True)
        subprocess.run([folder / "venv/bin/pip", "install", "--quiet", "--disable-pip-version-check", *PYTHON], check=True)
        (folder / "package.json").write_text('{"private": true, "type": "module"}', encoding="utf-8")
        subprocess.run(["npm", "install", "--silent", "--no-audit", "--no-fund", "--prefix", folder, *NODE], check=True)
        (folder / "done").touch()
    shutil.copy(HERE / "peers.mjs", folder)


def versions(folder):
    for word in NODE:
        name = word.split("@")[0]
        yield name, json.loads((folder / "node_modules" / name / "package.json").read_text(encoding="utf-8"))["version"]
    for word in PYTHON:
        name = word.split("==", maxsplit=1)[0]
        yield name, importlib.metadata.version(name)


# ---- clips and errors; numpy is there once the packages are


class Clip:
    def __init__(self, name, points, faces, files):
        import numpy as np
        self.name, self.points, self.faces, self.files = name, points, faces, files
        fans = [(face[0], face[i], face[i + 1]) for face in faces for i in range(1, len(face) - 1)]
        self.triangles = np.array(fans, dtype=np.uint32).reshape(-1, 3)
        self.frames, self.vertices = points.shape[:2]
        self.lowest = points.reshape(-1, 3).min(0).astype(np.float64)


def read_points(path):
    """Frames x vertices x 3 of a PC2."""
    import numpy as np
    data = pathlib.Path(path).read_bytes()
    vertices, frames = struct.unpack_from("<i", data, 16)[0], struct.unpack_from("<i", data, 28)[0]
    return np.frombuffer(data, "<f4", offset=32, count=frames * vertices * 3).reshape(frames, vertices, 3)


def read_faces(path):
    lines = (line.split()[1:] for line in pathlib.Path(path).read_text(encoding="utf-8").splitlines() if line.startswith("f "))
    return [[int(corner.split("/")[0]) - 1 for corner in line] for line in lines]


def find_clip(name, command, fps, folder):
    """A clip of the data, one of the corpus, or an animation of a file, baked without loss."""
    real = pathlib.Path(os.environ.get("ANICODEC_DATA", "/nonexistent"), name)
    if real.with_suffix(".pc2").exists():
        mesh, cache = real.with_suffix(".obj"), real.with_suffix(".pc2")
    else:
        mesh, cache = folder / "clip.obj", folder / "clip.pc2"
        path, _, animation = name.partition("@")
        if pathlib.Path(path).exists():
            run(command, "encode", path, *(["--clip", animation] if animation else []), "--fps", fps, "--lossless", "--effort", "fast",
                "--no-attributes", "--order", "vertices", "-f", "-o", folder / "clip.anic")
            run(command, "decode", folder / "clip.anic", "-f", "-o", cache)
            name = pathlib.Path(path).name + (f"@{animation}" if animation else "")
        else:
            run(command, "corpus", name, "-f", "-o", cache)
    return Clip(name, read_points(cache), read_faces(mesh), (mesh, cache))


def kg_error(points, back):
    """In per cent: the norm of the differences over that of the distances from each frame's mean vertex (Karni and Gotsman 2004)."""
    import numpy as np
    points = points.astype(np.float64)
    return 100 * float(np.linalg.norm(points - back) / np.linalg.norm(points - points.mean(1, keepdims=True)))


def on_grid(points, origin, step):
    """Integers, and the float32 positions that they stand for."""
    import numpy as np
    integers = np.rint((points.astype(np.float64) - origin) / step)
    return integers, (origin + step * integers).astype(np.float32)


def step_at_kg(points, origin, kg):
    """Nearly the largest step of a cubic grid through `origin` whose KG error is at most `kg`."""
    import numpy as np
    flat = points.reshape(-1, 3)
    step, best = float(np.linalg.norm(flat.max(0) - flat.min(0))) * kg / 100, 0
    for _ in range(16):
        error = kg_error(points, on_grid(points, origin, step)[1])
        ratio = kg / error if error > 0 else 2
        if error <= kg:
            best = max(best, step)
            if ratio < 1.002:
                break
        step *= min(ratio, 2.0) * 0.9995
    if not best:
        raise ValueError(f"no grid has a KG error of {kg} %")
    return best


def same_trajectories(points, packed, used):
    """The vertex of `packed` with the nearest trajectory, for each vertex, among candidates that are near along some random directions;
    -1 for a vertex without faces."""
    import numpy as np
    from scipy.spatial import cKDTree
    frames = len(points)
    directions = np.random.default_rng(1).standard_normal((3 * frames, min(16, 3 * frames)))
    flat, others = (x.transpose(1, 0, 2).reshape(-1, 3 * frames).astype(np.float64) for x in (points, packed))
    near = cKDTree(others @ directions).query(flat @ directions, k=min(4, len(others)))[1].reshape(len(flat), -1)
    distances = np.stack([np.linalg.norm(flat - others[column], axis=1) for column in near.T], 1)
    found = near[np.arange(len(flat)), distances.argmin(1)]
    found[~used] = -1
    return found


def morph_glb(clip):
    """A mesh with a morph target per frame, which is the difference to the first, and an animation that plays them."""
    import numpy as np
    views, accessors, chunks = [], [], []

    def add(array, kind, component, target=None, bounds=False):
        data = np.ascontiguousarray(array).tobytes()
        views.append({"buffer": 0, "byteOffset": sum(map(len, chunks)), "byteLength": len(data), **({"target": target} if target else {})})
        chunks.append(data)
        rows = array.reshape(-1, 3 if kind == "VEC3" else 1)
        extent = {"min": rows.min(0).tolist(), "max": rows.max(0).tolist()} if bounds else {}
        accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": len(rows), "type": kind, **extent})
        return len(accessors) - 1

    points = clip.points.astype(np.float32)
    base = add(points[0], "VEC3", 5126, 34962, True)
    indices = add(clip.triangles.astype(np.uint32).ravel(), "SCALAR", 5125, 34963)
    targets = [{"POSITION": add(points[f] - points[0], "VEC3", 5126, 34962, True)} for f in range(1, clip.frames)]
    times = add(np.arange(clip.frames, dtype=np.float32) / np.float32(RATE), "SCALAR", 5126, None, True)
    weights = add(np.eye(clip.frames, clip.frames - 1, -1, dtype=np.float32), "SCALAR", 5126)
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": base}, "indices": indices, "targets": targets}], "weights": [0] * len(targets)}],
        "animations": [{"samplers": [{"input": times, "output": weights}], "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}]}],
        "buffers": [{"byteLength": sum(map(len, chunks))}], "bufferViews": views, "accessors": accessors}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    binary = b"".join(chunks)
    return (struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(binary)) + struct.pack("<II", len(text), 0x4E4F534A) + text +
            struct.pack("<II", len(binary), 0x004E4942) + binary)


# ---- processes


def run(*command):
    """Runs a command; seconds of processor time."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    result = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    if result.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}:\n{result.stdout.decode(errors='replace')}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def in_node(peer, packages, folder, task, **arrays):
    for name, array in arrays.items():
        (folder / name).write_bytes(array.tobytes())
    (folder / "task.json").write_text(json.dumps(task), encoding="utf-8")
    result = subprocess.run(["node", "peers.mjs", peer, str(folder)], cwd=packages, stdout=subprocess.PIPE, check=True)
    return json.loads(result.stdout)


def timed(function):
    begin = time.process_time()
    result = function()
    return result, time.process_time() - begin


# ---- peers: bytes, KG error, seconds to encode and to decode all frames


def ours(clip, kg, command, folder):
    path, cache = folder / "ours.anic", folder / "ours.pc2"
    encoding = run(command, "encode", *clip.files, "--kg", kg, "-j1", "-f", "-o", path)
    decoding = run(command, "decode", path, "-f", "-o", cache)
    return path.stat().st_size, kg_error(clip.points, read_points(cache)), encoding, decoding


def draco(clip, step, packages, folder):
    """Every frame a mesh, speed 0, on one cubic grid, whose step is not bound to powers of two as Draco's own bits are."""
    import numpy as np
    from scipy.spatial import cKDTree
    integers, rounded = on_grid(clip.points, clip.lowest, step)
    task = {"origin": clip.lowest.tolist(), "step": step, "bits": max(2, int(integers.max()).bit_length()), "vertices": clip.vertices,
            "frames": clip.frames}
    result = in_node("draco", packages, folder, task, points=clip.points, triangles=clip.triangles)
    decoded = np.fromfile(folder / "decoded", np.float32).reshape(-1, 3)
    back = rounded.copy()
    used = np.unique(clip.triangles)
    for frame, points in enumerate(np.split(decoded, np.cumsum(result["counts"])[:-1])):
        distance, nearest = cKDTree(points).query(rounded[frame, used])
        if (distance > 0.01 * step).mean() > 0.01:  # in float32 some are rounded the other way
            raise ValueError("Draco gives other points back")
        back[frame, used] = points[nearest]
    return result["bytes"], kg_error(clip.points, back), result["encodeSeconds"], result["decodeSeconds"]


def meshopt(clip, step, packages, folder):
    """Frame deltas on a cubic grid through the vertex codec and zstd -19: the variant of four that zstd -3 makes smallest."""
    import numpy as np
    import zstandard
    integers, rounded = on_grid(clip.points, clip.lowest, step)
    task = {"vertices": clip.vertices, "frames": clip.frames, "largest": int(integers.max())}
    variants = in_node("meshopt", packages, folder, task, grid=integers.astype(np.uint32), triangles=clip.triangles)["variants"]
    files = {variant["name"]: (folder / variant["name"]).read_bytes() for variant in variants}
    best = min(variants, key=lambda variant: len(zstandard.compress(files[variant["name"]], 3)))
    packed, encoding = timed(lambda: zstandard.compress(files[best["name"]], 19))
    _, decoding = timed(lambda: zstandard.decompress(packed))
    return len(packed), kg_error(clip.points, rounded), best["encodeSeconds"] + encoding, best["decodeSeconds"] + decoding


def gltfpack(clip, kg, step, packages, folder):
    """A morph target per frame, `-cz` with the fewest bits; once as it is, once more through zstd -19."""
    import numpy as np
    import zstandard
    source, packed = folder / "clip.glb", folder / "packed.glb"
    source.write_bytes(morph_glb(clip))
    used = np.zeros(clip.vertices, bool)
    used[clip.triangles.ravel()] = True
    flat = clip.points.reshape(-1, 3)
    extent = float((flat.max(0) - flat.min(0)).max())
    task = {"frames": clip.frames, "interval": 1 / RATE}

    def at(bits):
        encoding = run("node", packages / "node_modules/gltfpack/cli.js", "-i", source, "-o", packed, "-cz", "-vp", bits)
        result = in_node("gltf", packages, folder, task)
        own = np.fromfile(folder / "decoded", np.float32).reshape(clip.frames, -1, 3)
        back = clip.points.copy()
        back[:, used] = own[:, same_trajectories(clip.points, own, used)[used]]
        data = packed.read_bytes()
        more, zstd = timed(lambda: zstandard.compress(data, 19))
        error = kg_error(clip.points, back)
        return [(size, error, encoding + seconds, result["decodeSeconds"]) for size, seconds in ((len(data), 0), (len(more), zstd))]

    bits = min(MOST_BITS, max(1, int(extent / step).bit_length()))
    best = at(bits)
    while best[0][1] > kg:
        bits += 1
        if bits > MOST_BITS:
            return [None, None]
        best = at(bits)
    while bits > 1 and (fewer := at(bits - 1))[0][1] <= kg:
        bits, best = bits - 1, fewer
    return best


def bodycompress(clip, step, folder):
    """Multiples of one step, whatever its name says of millimetres. It has no faces."""
    import numpy as np
    from bodycompress import BodyCompressor, BodyDecompressor
    path = folder / "clip.xz"

    def write():
        with BodyCompressor(str(path), quantization_mm=1.0, compression_level=9, vertex_order=None) as file:
            for frame in clip.points:
                file.append(vertices=(frame - clip.lowest) / step)

    _, encoding = timed(write)
    frames, decoding = timed(lambda: [frame["vertices"] for frame in BodyDecompressor(str(path))])
    return path.stat().st_size, kg_error(clip.points, clip.lowest + step * np.array(frames)), encoding, decoding


def npz(clip, kg):
    """Float16 as it is, with the faces."""
    import numpy as np
    stream = io.BytesIO()
    _, encoding = timed(lambda: np.savez_compressed(stream, points=clip.points.astype(np.float16), faces=clip.triangles))
    stream.seek(0)
    back, decoding = timed(lambda: np.load(stream)["points"])
    error = kg_error(clip.points, back.astype(np.float32))
    return (len(stream.getvalue()), error, encoding, decoding) if error <= kg else None


def usdc(clip, folder):
    import numpy as np
    from pxr import Usd, UsdGeom, Vt
    path = folder / "clip.usdc"

    def write():
        stage = Usd.Stage.CreateNew(str(path))
        mesh = UsdGeom.Mesh.Define(stage, "/mesh")
        mesh.CreateFaceVertexCountsAttr([len(face) for face in clip.faces])
        mesh.CreateFaceVertexIndicesAttr(Vt.IntArray([corner for face in clip.faces for corner in face]))
        mesh.CreateSubdivisionSchemeAttr("none")
        attribute = mesh.CreatePointsAttr()
        for frame, points in enumerate(clip.points):
            attribute.Set(Vt.Vec3fArray.FromNumpy(points), frame)
        stage.Save()

    def read():
        stage = Usd.Stage.Open(str(path))
        points = UsdGeom.Mesh(stage.GetPrimAtPath("/mesh")).GetPointsAttr()
        return np.array([points.Get(frame) for frame in range(clip.frames)])

    path.unlink(missing_ok=True)
    _, encoding = timed(write)
    size = path.stat().st_size
    back, decoding = timed(read)
    return size, kg_error(clip.points, back), encoding, decoding


def alembic(clip, folder):
    import imath
    import numpy as np
    from alembic3d import Abc, AbcCoreAbstract, AbcGeom
    path = str(folder / "clip.abc")

    def integers(values):
        return imath.IntArrayFromBuffer(np.array(values, dtype=np.int32))

    def write():
        archive = Abc.OArchive(path)
        times = archive.addTimeSampling(AbcCoreAbstract.TimeSampling(1 / RATE, 0.0))
        schema = AbcGeom.OPolyMesh(archive.getTop(), "mesh", times).getSchema()
        corners, counts = integers([corner for face in clip.faces for corner in face]), integers([len(face) for face in clip.faces])
        for points in clip.points:
            schema.set(AbcGeom.OPolyMeshSchemaSample(imath.V3fArrayFromBuffer(np.ascontiguousarray(points)), corners, counts))

    def read():
        schema = AbcGeom.IPolyMesh(Abc.IArchive(path).getTop(), "mesh").getSchema()
        samples = [schema.getValue(Abc.ISampleSelector(requestedIndex=frame)).getPositions() for frame in range(clip.frames)]
        return samples

    _, encoding = timed(write)
    samples, decoding = timed(read)
    back = np.array([np.array(sample) for sample in samples], dtype=np.float32).reshape(clip.points.shape)
    return os.path.getsize(path), kg_error(clip.points, back), encoding, decoding


# ---- tables


def measured(clip, kg, packages, folder):
    """Name of each peer: what it makes of the clip, None for what it cannot."""
    step = step_at_kg(clip.points, clip.lowest, kg)
    packed = gltfpack(clip, kg, step, packages, folder)
    return {
        "meshopt": meshopt(clip, step, packages, folder),
        "gltfpack -cz": packed[0],
        "-cz, zstd -19": packed[1],
        "Draco": draco(clip, step, packages, folder),
        "bodycompress": bodycompress(clip, step, folder),
        "float16 .npz": npz(clip, kg),
        "usdc": usdc(clip, folder),
        "Alembic": alembic(clip, folder),
    }


def ratio(value):
    return "" if value is None else f"{value:.0f}" if value >= 99.95 else f"{value:.1f}" if value >= 9.995 else f"{value:.2f}"


def table(title, rows, column, decimals):
    """Rows of (clip, ours, peers): a column of ours and of each peer in multiples of it, and geometric means."""
    names = list(rows[0][2])
    print(f"| {title} | ours | {' | '.join(names)} |\n|---|---|{'---|' * len(names)}")
    ratios = {name: [] for name in names}
    for clip, own, peers in rows:
        for name, peer in peers.items():
            ratios[name].append(peer and peer[column] / own[column])
        print(f"| {clip.name} | {own[column]:.{decimals}f} | {' | '.join(ratio(ratios[name][-1]) for name in names)} |")
    means = [statistics.geometric_mean(found) if (found := [x for x in ratios[name] if x is not None]) else None for name in names]
    print(f"| geometric mean | | {' | '.join(map(ratio, means))} |\n")


def print_tables(rows, kg):
    table(f"bytes, KG error {kg:g} %", rows, 0, 0)
    names = list(rows[0][2])
    print(f"| KG error, % | ours | {' | '.join(names)} |\n|---|---|{'---|' * len(names)}")
    for clip, own, peers in rows:
        print(f"| {clip.name} | {' | '.join('' if x is None or x[1] is None else f'{x[1]:.4f}' for x in (own, *peers.values()))} |")
    print()
    table("encoding, CPU s", rows, 2, 2)
    table("decoding all frames, CPU s", rows, 3, 3)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("clips", nargs="*", metavar="CLIP")
    parser.add_argument("--command", default="anicodec")
    parser.add_argument("--kg", type=float, default=0.1)
    parser.add_argument("--fps", default="30")
    parser.add_argument("--packages", type=pathlib.Path, metavar="FOLDER")
    parser.add_argument("--inside", action="store_true", help=argparse.SUPPRESS)  # in the Python that has the packages
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as made:
        if not asked.inside:
            packages = (asked.packages or pathlib.Path(made)).resolve()
            packages.mkdir(parents=True, exist_ok=True)
            install(packages)
            rest = [word for option in ("command", "kg", "fps") for word in (f"--{option}", str(getattr(asked, option)))]
            sys.exit(subprocess.run([packages / "venv/bin/python", __file__, "--inside", "--packages", packages, *rest, *asked.clips],
                                    check=False).returncode)
        clips = asked.clips
        if not clips:
            clips = REAL if os.environ.get("ANICODEC_DATA") else CORPUS
            if clips is CORPUS:
                print("ANICODEC_DATA names no folder of real clips: clips of the corpus\n")
        print(", ".join(f"{name} {version}" for name, version in versions(asked.packages)) + "; others in multiples of ours.\n", flush=True)
        rows = []
        for name in clips:
            folder = pathlib.Path(made)
            clip = find_clip(name, asked.command, asked.fps, folder)
            rows.append((clip, ours(clip, asked.kg, asked.command, folder), measured(clip, asked.kg, asked.packages, folder)))
            print(f"{clip.name}, {clip.vertices} x {clip.frames}: {json.dumps(rows[-1][1:])}", file=sys.stderr, flush=True)
        print_tables(rows, asked.kg)


if __name__ == "__main__":
    main()
