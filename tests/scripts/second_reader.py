#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Compares random scenes as the command bakes them with the same scenes as another reader of their format gives them.

usage: second_reader.py [--seed N] [--count N] [--keep FOLDER] [--modules FOLDER] [--package PYTHON] FORMAT... ANICODEC
  FORMAT     gltf   by three.js in node; --modules names the folder of its node_modules
             abc    by alembic3d, which writes them, too
             fbx    by bpy (Blender), which writes them, too
             usd    by usd-core, which writes them, too; --package names a Python that has anicodec[usd]
             obj    by trimesh (and pillow)
  --keep     keeps scenes that come out otherwise, with the seed as name
Needs numpy, and the packages of the formats. Prints a line for each difference, and how many scenes were compared. Not part of the tests.
"""
import argparse
import json
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile

import numpy as np

sys.dont_write_bytecode = True

TOLERANCE = 2e-4  # of scenes about 10 long, whose keys and matrices are of float32
AFTER = 3e-7  # seconds: a step at the time of a frame shows in it


# ---- comparing -------------------------------------------------------------------------------------------------------


def solid(triangles):
    """The triangles that are no point: hidden ones collapse."""
    corners = triangles[:, :9].reshape(-1, 3, 3)
    return triangles[np.abs(corners - corners[:, :1]).max(axis=(1, 2)) > 1e-6]


def difference(ours, theirs):
    """Why two lists of triangles (x, y, z of three corners, and whether their order has a meaning) differ, or None."""
    ours, theirs = solid(ours), solid(theirs)
    if len(ours) != len(theirs):
        return f"{len(ours)} triangles, not {len(theirs)}"
    if len(ours) == 0:
        return None
    scale = max(1.0, np.abs(theirs[:, :9]).max())
    corners = theirs[:, :9].reshape(-1, 3, 3)
    turns = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0], [1, 0, 2], [0, 2, 1]]
    apart = []
    for number, turn in enumerate(turns):
        turned = corners[:, turn].reshape(-1, 9)
        d = np.abs(ours[:, None, :9] - turned[None]).max(axis=2)
        apart.append(d if number < 3 else np.where(theirs[None, :, 9] > 0, np.inf, d))
    least = np.min(apart, axis=0) / scale
    worst = max(least.min(axis=0).max(), least.min(axis=1).max())
    if worst <= TOLERANCE:
        return None
    either = np.abs(np.sort(ours[:, None, :9].reshape(len(ours), 1, 3, 3), axis=2) - np.sort(corners[None], axis=2)).max(axis=(2, 3)) / scale
    return f"{'turned: ' if either.min(axis=1).max() <= TOLERANCE else ''}{worst:.3g} of {scale:.3g}"


def differences(name, times, frames, theirs):
    """Describes the first frame of a clip that differs from a second reader's, if one does."""
    for frame, (a, b) in enumerate(zip(frames, theirs)):
        why = difference(a, np.array(list(b), float).reshape(-1, 10))
        if why:
            yield f"{name}, frame {frame} at {times[frame]:.4f} s: {why}"
            return


class Command:
    """The command under test."""

    def __init__(self, path, folder):
        self.path, self.folder = path, folder

    def run(self, *arguments):
        return subprocess.run([self.path, *map(str, arguments)], capture_output=True, text=True, check=False)

    def frames(self, file):
        """For each clip of a file its name, the times of its frames and their triangles."""
        told = json.loads(self.run("info", file, "--json").stdout)
        folder = self.folder / "decoded"
        shutil.rmtree(folder, ignore_errors=True)
        keep_axes = ["--up", told["up"]] if told["up"] in ("y", "z") else []
        done = self.run("decode", "-q", "--clip", "all", *keep_axes, file, "-o", folder / "%d.obj")
        if done.returncode:
            raise RuntimeError(done.stderr.strip())
        for clip in told["clips"] or [told | {"first_frame": 0}]:
            rate = clip["fps"][0] / clip["fps"][1]
            frames = range(clip["first_frame"], clip["first_frame"] + clip["frames"])
            yield clip["name"], [clip["start_time"] + i / rate for i in range(len(frames))], \
                [self.triangles(folder / f"{f}.obj") for f in frames]

    @staticmethod
    def triangles(path):
        """The triangles of a frame, which has no file if it shows nothing; polygons as fans."""
        lines = [line.split() for line in path.read_text().splitlines()] if path.exists() else []
        positions = np.array([line[1:4] for line in lines if line[:1] == ["v"]], float).reshape(-1, 3)
        faces = [[int(word.split("/")[0]) - 1 for word in line[1:]] for line in lines if line[:1] == ["f"]]
        corners = np.array([[face[0], face[i - 1], face[i]] for face in faces for i in range(2, len(face))], np.int64).reshape(-1, 3)
        return np.hstack([positions[corners].reshape(-1, 9), np.ones((len(corners), 1))])


# ---- glTF ------------------------------------------------------------------------------------------------------------


class Gltf:
    """A document that is put together piece by piece."""

    def __init__(self):
        self.document = {"asset": {"version": "2.0"}, "scene": 0, "bufferViews": [], "accessors": [], "nodes": [], "meshes": [],
                         "animations": []}
        self.binary = b""

    def accessor(self, values, kind, component=5126, normalized=False, stride=0, limits=False):
        values = np.ascontiguousarray(values, {5126: "<f4", 5121: "<u1", 5123: "<u2", 5125: "<u4", 5120: "<i1", 5122: "<i2"}[component])
        values = values.reshape(len(values), -1)
        self.binary += b"\0" * (-len(self.binary) % 4)
        view = {"buffer": 0, "byteOffset": len(self.binary)}
        if stride:
            view["byteStride"] = stride
            data = b"".join(row.tobytes().ljust(stride, b"\xab") for row in values)
        else:
            data = values.tobytes()
        self.binary += data
        view["byteLength"] = len(data)
        self.document["bufferViews"].append(view)
        accessor = {"bufferView": len(self.document["bufferViews"]) - 1, "componentType": component, "count": len(values), "type": kind}
        if normalized:
            accessor["normalized"] = True
        if limits:
            accessor |= {"min": values.min(axis=0).tolist(), "max": values.max(axis=0).tolist()}
        self.document["accessors"].append(accessor)
        return len(self.document["accessors"]) - 1

    def glb(self):
        document = {key: value for key, value in self.document.items() if value != []}
        binary = self.binary + b"\0" * (-len(self.binary) % 4)
        document["buffers"] = [{"byteLength": len(binary)}]
        text = json.dumps(document).encode()
        text += b" " * (-len(text) % 4)
        size = 12 + 8 + len(text) + 8 + len(binary)
        return struct.pack("<4sII", b"glTF", 2, size) + struct.pack("<I4s", len(text), b"JSON") + text + \
            struct.pack("<I4s", len(binary), b"BIN\0") + binary


def quaternion(random):
    q = random.normal(size=4)
    return q / np.linalg.norm(q)


def rotation(q):
    x, y, z, w = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def scale(random):
    """Often uneven, or of a mirror."""
    kind = random.integers(5)
    if kind == 0:
        return np.ones(3)
    s = np.full(3, random.uniform(0.3, 2)) if kind == 1 else random.uniform(0.3, 2, 3)
    return s * random.choice([-1, 1], 3) if kind > 2 else s


def gltf_node(random):
    node = {}
    if random.random() < 0.25:
        matrix = np.eye(4)  # of the kinds that three numbers of scale make, as glTF asks for
        matrix[:3, :3] = rotation(quaternion(random)) * scale(random)
        matrix[:3, 3] = random.normal(size=3)
        node["matrix"] = matrix.T.ravel().tolist()
        return node
    if random.random() < 0.8:
        node["translation"] = random.normal(size=3).tolist()
    if random.random() < 0.7:
        node["rotation"] = quaternion(random).tolist()
    if random.random() < 0.7:
        node["scale"] = scale(random).tolist()
    return node


def gltf_primitive(random, gltf, targets, joints):
    count = int(random.integers(3, 9))
    mode = int(random.choice([4, 4, 5, 6]))
    positions = random.normal(size=(count, 3))
    attributes = {}
    if random.random() < 0.2 and not targets:
        attributes["POSITION"] = gltf.accessor(random.integers(-32767, 32768, (count, 3)), "VEC3", 5122, True, 8, True)
        gltf.document["extensionsUsed"] = gltf.document["extensionsRequired"] = ["KHR_mesh_quantization"]
    else:
        attributes["POSITION"] = gltf.accessor(positions, "VEC3", stride=int(random.choice([0, 0, 12, 20])), limits=True)
    primitive = {"attributes": attributes, "mode": mode}
    indexed = mode != 4 or count % 3 or random.random() < 0.7
    if joints:
        numbers = random.integers(0, joints, (count, 4))
        weights = random.random((count, 4))
        attributes["JOINTS_0"] = gltf.accessor(numbers, "VEC4", int(random.choice([5121, 5123])))
        attributes["WEIGHTS_0"] = gltf.accessor(weights / weights.sum(axis=1, keepdims=True), "VEC4")
    if indexed:
        corners = random.permutation(count) if mode != 4 else random.integers(0, count, 3 * int(random.integers(1, 6)))
        component = int(random.choice([5121, 5123, 5125]))
        primitive["indices"] = gltf.accessor(corners[:, None], "SCALAR", component)
    if targets:
        primitive["targets"] = [{"POSITION": gltf.accessor(random.normal(size=(count, 3)) * 0.3, "VEC3", limits=True)} for _ in range(targets)]
    return primitive


def key_times(random, rate):
    """On the frames of a rate, or anywhere."""
    count = int(random.integers(1, 7))
    if random.random() < 0.7:
        return np.sort(random.choice(24, count, replace=False)) / rate
    return np.sort(random.choice(41, count, replace=False)) / 41.3


def gltf_animation(random, gltf, rate, name):
    document = gltf.document
    channels, samplers = [], []
    nodes = [n for n, node in enumerate(document["nodes"]) if "matrix" not in node]
    for number in random.permutation(nodes)[:random.integers(1, 4)] if nodes else []:
        node = document["nodes"][number]
        paths = ["translation", "rotation", "scale"]
        targets = 0
        # three.js moves the weights of the first node alone if several show a mesh, and none of a mesh at a joint.
        if "mesh" in node and [other.get("mesh") for other in document["nodes"]].count(node["mesh"]) == 1 and \
                not any(number in skin["joints"] for skin in document.get("skins", ())):
            targets = len(document["meshes"][node["mesh"]]["primitives"][0].get("targets", ()))
            paths += ["weights"] * bool(targets)
        for path in random.permutation(paths)[:random.integers(1, len(paths) + 1)]:
            times = key_times(random, rate)
            kind = str(random.choice(["LINEAR", "LINEAR", "STEP", "CUBICSPLINE"]))
            rows = len(times) * (3 if kind == "CUBICSPLINE" else 1)
            if path == "rotation":
                values = np.array([quaternion(random) for _ in range(rows)])
            elif path == "scale":
                values = np.array([scale(random) for _ in range(rows)])
            elif path == "weights":
                values = random.random((rows * targets, 1))
            else:
                values = random.normal(size=(rows, 3))
            kinds = {"rotation": "VEC4", "weights": "SCALAR"}
            samplers.append({"input": gltf.accessor(times[:, None], "SCALAR", limits=True), "interpolation": kind,
                             "output": gltf.accessor(values, kinds.get(path, "VEC3"))})
            channels.append({"sampler": len(samplers) - 1, "target": {"node": int(number), "path": str(path)}})
    if channels:
        document["animations"].append({"name": name, "channels": channels, "samplers": samplers})


def gltf_scene(random, rate):
    gltf = Gltf()
    document = gltf.document
    count = int(random.integers(1, 7))
    roots = []
    for number in range(count):
        document["nodes"].append(gltf_node(random) | {"name": f"node{number}"})
        parent = int(random.integers(-1, number)) if number else -1
        if parent < 0:
            roots.append(number)
        else:
            document["nodes"][parent].setdefault("children", []).append(number)
    document["scenes"] = [{"nodes": roots}]
    joints = 0
    if count > 1 and random.random() < 0.3:
        chosen = random.permutation(count)[:random.integers(1, count)]
        joints = len(chosen)
        matrices = np.tile(np.eye(4), (joints, 1, 1))
        matrices[:, :3] += random.normal(size=(joints, 3, 4)) * 0.3
        document["skins"] = [{"joints": chosen.tolist(), "inverseBindMatrices": gltf.accessor(matrices.transpose(0, 2, 1).reshape(joints, 16), "MAT4")}]
    for number in range(int(random.integers(1, 4))):
        targets = int(random.choice([0, 0, 1, 2]))
        skinned = joints if random.random() < 0.5 else 0
        mesh = {"name": f"mesh{number}", "primitives": [gltf_primitive(random, gltf, targets, skinned) for _ in range(random.integers(1, 3))]}
        if targets and random.random() < 0.5:
            mesh["weights"] = random.random(targets).tolist()
        document["meshes"].append(mesh)
        for node in random.permutation(count)[:random.integers(1, 3)]:
            if "mesh" not in document["nodes"][node]:
                document["nodes"][node]["mesh"] = number
                if skinned:
                    document["nodes"][node]["skin"] = 0
    if all("mesh" not in node for node in document["nodes"]):
        document["nodes"][0]["mesh"] = 0
    for number in range(int(random.integers(0, 4))):
        gltf_animation(random, gltf, rate, f"take{number}")
    return gltf


class GltfFormat:
    """By three.js."""

    def __init__(self, arguments):
        script = pathlib.Path(__file__).with_name("three_reader.mjs")
        self.node = subprocess.Popen(["node", script, arguments.modules], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def faults(self, random, path, command):
        rate = random.choice([24, 30, 60, 30000 / 1001, 12.5, 7, 25])
        gltf = gltf_scene(random, rate)
        file = path.with_suffix(".glb")
        file.write_bytes(gltf.glb())
        encoded = path.with_suffix(".anic")
        animations = gltf.document["animations"]
        fps = {30000 / 1001: "30000/1001", 12.5: "25/2"}.get(rate, str(int(rate)))
        options = ["--clips", "all"] if animations else []
        arguments = ["encode", "-q", "-f", "--lossless", "--effort", "fast", "--order", "vertices", "--fps", fps, file, "-o", encoded]
        done = command.run(*arguments, *options)
        if "no animation moves anything" in done.stderr:  # then the pose is that of the first
            done = command.run(*arguments)
        if done.returncode:
            yield done.stderr.strip()
            return
        names = {animation["name"]: number for number, animation in enumerate(animations)}
        for name, times, frames in command.frames(encoded):
            number = names.get(name, 0) if animations else None
            print(json.dumps({"file": str(file), "animation": number, "times": [t + AFTER for t in times]}), file=self.node.stdin, flush=True)
            yield from differences(name, times, frames, json.loads(self.node.stdout.readline()))


# ---- Alembic ---------------------------------------------------------------------------------------------------------


def soup(random):
    """Vertices, and corners of triangles, each once: importers drop those that come again."""
    count = int(random.integers(3, 9))
    triangles = [random.permutation(count)[:3] for _ in range(random.integers(1, 6))]
    once = {tuple(sorted(triangle)): triangle for triangle in triangles}
    return random.normal(size=(count, 3)), np.concatenate(list(once.values()))


def any_matrix(random):
    """Sheared; every second mirrors."""
    matrix = np.eye(4)
    matrix[:3, :3] = random.normal(size=(3, 3))
    matrix[:3, 3] = random.normal(size=3) * 2
    return matrix


class AbcFormat:
    """By alembic3d, the bindings of the reference library."""

    def __init__(self, _arguments):
        import alembic3d.Abc  # pylint: disable=import-outside-toplevel
        import alembic3d.AbcGeom  # pylint: disable=import-outside-toplevel
        import imath  # pylint: disable=import-outside-toplevel
        self.abc, self.geometry, self.core, self.imath = alembic3d.Abc, alembic3d.AbcGeom, alembic3d.AbcCoreAbstract, imath

    def array(self, kind, values):
        array = kind(len(values))
        for i, value in enumerate(values):
            array[i] = value
        return array

    def sample(self, random, kinds, inherits):
        """A sample of an Xform: operations, the same in all samples, or a matrix."""
        geometry, imath = self.geometry, self.imath
        sample = geometry.XformSample()
        sample.setInheritsXforms(inherits)
        if kinds is None:
            matrix = imath.M44d()
            for i, row in enumerate(any_matrix(random).T):
                for k, x in enumerate(row):
                    matrix[i][k] = x
            sample.setMatrix(matrix)
            return sample
        for kind in kinds:
            vector = imath.V3d(*(random.normal(size=3) if kind != 2 else scale(random)))
            if kind == 0:
                sample.addOp(geometry.XformOp(geometry.XformOperationType.kTranslateOperation, 0), vector)
            elif kind == 1:
                sample.addOp(geometry.XformOp(geometry.XformOperationType.kRotateOperation, 0), vector, float(random.uniform(-360, 360)))
            else:
                sample.addOp(geometry.XformOp(geometry.XformOperationType.kScaleOperation, 0), vector)
        return sample

    def write(self, random, path, rate):
        geometry, imath = self.geometry, self.imath
        archive = self.abc.OArchive(str(path))
        count = int(random.integers(1, 9))
        number = archive.addTimeSampling(self.core.TimeSampling(1 / rate, float(random.choice([0, 1 / rate, 0.2, -0.5]))))
        parents = [archive.getTop()]
        for i in range(int(random.integers(1, 7))):
            xform = geometry.OXform(parents[random.integers(len(parents))], f"x{i}", number)
            kinds = None if random.random() < 0.4 else list(random.integers(0, 3, random.integers(0, 5)))
            inherits = random.random() < 0.9
            for _ in range(count if random.random() < 0.6 else 1):
                xform.getSchema().set(self.sample(random, kinds, inherits))
            if random.random() < 0.3:
                shown = geometry.CreateVisibilityProperty(xform, number)
                for _ in range(count):
                    shown.setValue(int(random.choice([-1, 0, 1])))
            parents.append(xform)
        for i in range(int(random.integers(1, 4))):
            mesh = geometry.OPolyMesh(parents[random.integers(len(parents))], f"m{i}", number)
            positions, corners = soup(random)
            for _ in range(count if random.random() < 0.5 else 1):
                moved = positions + random.normal(size=positions.shape) * 0.2
                mesh.getSchema().set(geometry.OPolyMeshSchemaSample(
                    self.array(imath.V3fArray, [imath.V3f(*map(float, p)) for p in moved]),
                    self.array(imath.IntArray, [int(c) for c in corners]), self.array(imath.IntArray, [3] * (len(corners) // 3))))

    def triangles(self, parent, world, time):
        """The triangles of all objects below an object, whose world matrix is for row vectors."""
        geometry, at = self.geometry, self.abc.ISampleSelector(time, self.abc.ISampleSelector.TimeIndexType.kNearIndex)
        for i in range(parent.getNumChildren()):
            child = parent.getChild(i)
            if geometry.IXform.matches(child.getHeader()):
                sample = geometry.IXform(parent, child.getName()).getSchema().getValue(at)
                matrix = np.array([[sample.getMatrix()[r][k] for k in range(4)] for r in range(4)])
                yield from self.triangles(child, matrix @ world if sample.getInheritsXforms() else matrix, time)
            elif geometry.IPolyMesh.matches(child.getHeader()) and not geometry.IsAncestorInvisible(child, at):
                mesh = geometry.IPolyMesh(parent, child.getName()).getSchema().getValue(at)
                points = np.array([[p.x, p.y, p.z, 1] for p in mesh.getPositions()]) @ world
                corners = np.array(list(mesh.getFaceIndices())).reshape(-1, 3)[:, ::-1]  # clockwise
                if np.linalg.det(world[:3, :3]) < 0:
                    corners = corners[:, ::-1]
                yield from np.hstack([points[corners][:, :, :3].reshape(-1, 9), np.ones((len(corners), 1))])

    def faults(self, random, path, command):
        rate = float(random.choice([24, 25, 60, 30000 / 1001, 12.5]))
        file, encoded = path.with_suffix(".abc"), path.with_suffix(".anic")
        self.write(random, file, rate)
        archive = self.abc.IArchive(str(file))
        done = command.run("encode", "-q", "-f", "--lossless", "--effort", "fast", file, "-o", encoded)
        if done.returncode:
            if "no frame shows" not in done.stderr:
                yield done.stderr.strip()
            return
        for name, times, frames in command.frames(encoded):
            yield from differences(name, times, frames, (self.triangles(archive.getTop(), np.eye(4), t) for t in times))


# ---- FBX -------------------------------------------------------------------------------------------------------------


class FbxFormat:
    """By Blender, which writes them, too: its importer in Python."""

    def __init__(self, _arguments):
        import bpy  # pylint: disable=import-outside-toplevel
        self.bpy = bpy

    def build(self, random, rate):
        bpy = self.bpy
        bpy.ops.wm.read_factory_settings(use_empty=True)
        scene = bpy.context.scene
        scene.render.fps, scene.render.fps_base = rate
        scene.frame_start, scene.frame_end = 1, int(random.integers(1, 12))
        made = []
        for i in range(int(random.integers(1, 6))):
            mesh = None
            if i == 0 or random.random() < 0.7:
                positions, corners = soup(random)
                mesh = bpy.data.meshes.new(f"mesh{i}")
                mesh.from_pydata(positions.tolist(), [], corners.reshape(-1, 3).tolist())
            item = bpy.data.objects.new(f"object{i}", mesh)
            scene.collection.objects.link(item)
            if made and random.random() < 0.7:
                item.parent = made[random.integers(len(made))]
                if random.random() < 0.3:
                    item.matrix_parent_inverse.translation = random.normal(size=3).tolist()
            item.rotation_mode = str(random.choice(["XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX", "QUATERNION"]))
            turn = "rotation_quaternion" if item.rotation_mode == "QUATERNION" else "rotation_euler"
            values = {"location": lambda: random.normal(size=3), "scale": lambda: scale(random),
                      turn: lambda: quaternion(random) if turn == "rotation_quaternion" else random.normal(size=3)}
            for path, value in values.items():
                setattr(item, path, value().tolist())
                for frame in random.permutation(scene.frame_end)[:random.integers(0, 4)] + 1 if random.random() < 0.5 else []:
                    setattr(item, path, value().tolist())
                    item.keyframe_insert(path, frame=int(frame))
            if mesh and random.random() < 0.3:
                item.shape_key_add(name="Basis")
                key = item.shape_key_add(name="Key")
                for point in key.data:
                    point.co = (np.array(point.co) + random.normal(size=3) * 0.3).tolist()
                for frame in random.permutation(scene.frame_end)[:2] + 1:
                    key.value = float(random.random())
                    key.keyframe_insert("value", frame=int(frame))
            made.append(item)

    def triangles(self, time):
        """In metres, with Y up."""
        bpy = self.bpy
        scene = bpy.context.scene
        frame = time * scene.render.fps  # where its importer puts keys, whatever fps_base is
        scene.frame_set(int(np.floor(frame)), subframe=float(frame - np.floor(frame)))
        graph = bpy.context.evaluated_depsgraph_get()
        for item in scene.objects:
            if item.type != "MESH":
                continue
            shown = item.evaluated_get(graph)
            world = np.array(shown.matrix_world)
            points = np.array([v.co for v in shown.data.vertices]) @ world[:3, :3].T + world[:3, 3]
            points = points[:, [0, 2, 1]] * [1, 1, -1]
            corners = np.array([p.vertices for p in shown.data.polygons])
            if np.linalg.det(world[:3, :3]) < 0:
                corners = corners[:, ::-1]
            yield from np.hstack([points[corners].reshape(-1, 9), np.ones((len(corners), 1))])

    def faults(self, random, path, command):
        bpy = self.bpy
        rate = [(24, 1.0), (25, 1.0), (30, 1.001), (60, 1.0)][random.integers(4)]
        self.build(random, rate)
        file, encoded = path.with_suffix(".fbx"), path.with_suffix(".anic")
        bpy.ops.export_scene.fbx(filepath=str(file), bake_anim_simplify_factor=0, add_leaf_bones=False,
                                 bake_anim_use_all_actions=False, bake_anim_use_nla_strips=False,
                                 apply_unit_scale=bool(random.integers(2)), global_scale=float(random.choice([1, 0.01])),
                                 use_space_transform=bool(random.integers(2)))
        done = command.run("encode", "-q", "-f", "--lossless", "--effort", "fast", "--order", "vertices",
                           "--fps", "30000/1001" if rate[1] != 1 else str(rate[0]), file, "-o", encoded)
        if done.returncode:
            yield done.stderr.strip()
            return
        unit = json.loads(command.run("info", encoded, "--json").stdout)["metres_per_unit"]
        clips = list(command.frames(encoded))
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.context.scene.render.fps, bpy.context.scene.render.fps_base = rate
        bpy.ops.import_scene.fbx(filepath=str(file), anim_offset=0)
        for name, times, frames in clips:
            for ours in frames:
                ours[:, :9] *= unit
            yield from differences(name, times, frames, map(self.triangles, times))


# ---- USD -------------------------------------------------------------------------------------------------------------


class UsdFormat:
    """By usd-core, which writes them, too."""

    def __init__(self, arguments):
        from pxr import Gf, Usd, UsdGeom, Vt  # pylint: disable=import-outside-toplevel
        self.gf, self.usd, self.geom, self.vt, self.package = Gf, Usd, UsdGeom, Vt, arguments.package

    def move(self, random, prim, codes):
        """A random stack of operations, some of which have samples."""
        Gf, geom = self.gf, self.geom
        xform = geom.Xformable(prim)

        def set_all(op, value):
            for code in sorted(random.permutation(codes)[:random.integers(1, len(codes) + 1)]) if random.random() < 0.6 else [None]:
                op.Set(value(), *([] if code is None else [float(code)]))

        if random.random() < 0.3:
            def matrix():
                return Gf.Matrix4d(*any_matrix(random).T.ravel().tolist())
            set_all(xform.AddTransformOp(), matrix)
            return
        if random.random() < 0.7:
            set_all(xform.AddTranslateOp(), lambda: Gf.Vec3d(*random.normal(size=3).tolist()))
        if random.random() < 0.4:
            pivot = xform.AddTranslateOp(opSuffix="pivot")
            pivot.Set(Gf.Vec3d(*random.normal(size=3).tolist()))
        else:
            pivot = None
        kind = random.integers(4)
        if kind == 0:
            def turn():
                x, y, z, w = quaternion(random).tolist()
                return Gf.Quatf(w, x, y, z)
            set_all(xform.AddOrientOp(), turn)
        elif kind == 1:
            set_all(getattr(xform, f"AddRotate{random.choice(['X', 'Y', 'Z'])}Op")(), lambda: float(random.uniform(-400, 400)))
        elif kind == 2:
            order = random.choice(["XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"])
            set_all(getattr(xform, f"AddRotate{order}Op")(), lambda: Gf.Vec3f(*random.uniform(-200, 200, 3).tolist()))
        if random.random() < 0.7:
            set_all(xform.AddScaleOp(), lambda: Gf.Vec3f(*scale(random).tolist()))
        if pivot:
            xform.AddTranslateOp(opSuffix="pivot", isInverseOp=True)
        if random.random() < 0.1:
            xform.SetResetXformStack(True)

    def write(self, random, path):
        geom, vt = self.geom, self.vt
        stage = self.usd.Stage.CreateNew(str(path))
        rate = float(random.choice([24, 25, 30, 60, 12.5]))
        first, count = int(random.choice([0, 1, 101, -3])), int(random.integers(1, 9))
        codes = np.arange(first, first + count)
        stage.SetTimeCodesPerSecond(rate)
        stage.SetFramesPerSecond(rate)
        stage.SetStartTimeCode(first)
        stage.SetEndTimeCode(first + count - 1)
        geom.SetStageUpAxis(stage, str(random.choice(["Y", "Z"])))
        paths = [""]
        for i in range(int(random.integers(1, 6))):
            prim = geom.Xform.Define(stage, f"{random.choice(paths)}/x{i}")
            paths.append(str(prim.GetPath()))
            self.move(random, prim, codes)
            if random.random() < 0.3:
                for code in codes:
                    prim.CreateVisibilityAttr().Set(str(random.choice(["inherited", "inherited", "invisible"])), float(code))
        for i in range(int(random.integers(1, 4))):
            mesh = geom.Mesh.Define(stage, f"{random.choice(paths)}/m{i}")
            positions, corners = soup(random)
            mesh.CreateFaceVertexCountsAttr(vt.IntArray([3] * (len(corners) // 3)))
            mesh.CreateFaceVertexIndicesAttr(vt.IntArray(corners.tolist()))
            for code in codes if random.random() < 0.5 else [None]:
                moved = (positions + random.normal(size=positions.shape) * 0.2).astype(np.float32)
                mesh.CreatePointsAttr().Set(vt.Vec3fArray.FromNumpy(moved), *([] if code is None else [float(code)]))
            if random.random() < 0.3:
                mesh.CreateOrientationAttr(geom.Tokens.leftHanded)
            if random.random() < 0.4:
                self.move(random, mesh, codes)
        stage.GetRootLayer().Save()
        return stage

    def triangles(self, stage, code):
        geom = self.geom
        cache = geom.XformCache(code)
        for prim in stage.Traverse():
            mesh = geom.Mesh(prim)
            if not mesh or mesh.ComputeVisibility(code) == geom.Tokens.invisible:
                continue
            world = np.array(cache.GetLocalToWorldTransform(prim))
            points = np.array(mesh.GetPointsAttr().Get(code), float) @ world[:3, :3] + world[3, :3]
            corners = np.array(mesh.GetFaceVertexIndicesAttr().Get(code)).reshape(-1, 3)
            if (mesh.GetOrientationAttr().Get() == geom.Tokens.leftHanded) != (np.linalg.det(world[:3, :3]) < 0):
                corners = corners[:, ::-1]
            yield from np.hstack([points[corners].reshape(-1, 9), np.ones((len(corners), 1))])

    def faults(self, random, path, command):
        file, encoded = path.with_suffix(".usda"), path.with_suffix(".anic")
        stage = self.write(random, file)
        done = subprocess.run([self.package, "-m", "anicodec", "encode", str(file), "-o", str(encoded), "--lossless", "--effort", "fast"],
                              capture_output=True, text=True, check=False)
        if done.returncode:
            if "no mesh that is visible" not in done.stderr:
                yield done.stderr.strip()
            return
        per_second = stage.GetTimeCodesPerSecond()
        for name, times, frames in command.frames(encoded):
            yield from differences(name, times, frames, (self.triangles(stage, round(t * per_second, 6)) for t in times))


# ---- OBJ -------------------------------------------------------------------------------------------------------------


class ObjFormat:
    """By trimesh."""

    def __init__(self, _arguments):
        import trimesh  # pylint: disable=import-outside-toplevel
        self.trimesh = trimesh

    @staticmethod
    def text(random, positions, faces, style):
        """In one of the ways to write the same: numbers from the end, with texture coordinates or normals, groups."""
        lines = ["# frame", "o thing"]
        for p in positions:
            lines.append("v " + " ".join(str(random.choice([f"{x:.7g}", f"{x:.9e}", f"{x:+.6f}"])) for x in p))
        lines += [f"vt {x:.4f} {y:.4f}" for x, y in random.random((4, 2))] + ["vn 0 0 1"]
        for number, face in enumerate(faces):
            if random.random() < 0.2:
                lines.append(str(random.choice(["g part", "s 1", "s off", "usemtl red", "", "# comment"])))
            words = []
            for v in face:
                at = v - len(positions) if style["negative"] else v + 1
                words.append(str(at) + {"plain": "", "uv": "/1", "both": "/2/1", "normal": "//1"}[style["corner"]])
            lines.append("f " + " ".join(words) + ("  " if number % 3 == 0 else ""))
        return style["end"].join(lines) + style["end"]

    def triangles(self, file):
        """The triangles of a frame: nine coordinates, and 1 for an order that has a meaning."""
        mesh = self.trimesh.load(file, process=False, force="mesh", skip_materials=True)
        return np.hstack([np.array(mesh.triangles).reshape(-1, 9), np.ones((len(mesh.faces), 1))])

    def faults(self, random, path, command):
        count, frames = int(random.integers(4, 12)), int(random.integers(1, 6))
        faces = [random.permutation(count)[:random.choice([3, 3, 4])].tolist() for _ in range(random.integers(1, 9))]
        style = {"negative": bool(random.integers(2)), "corner": str(random.choice(["plain", "uv", "both", "normal"])),
                 "end": str(random.choice(["\n", "\r\n"]))}
        files = []
        scale_of = 10 ** random.uniform(-2, 2)
        for f in range(frames):
            files.append(path.with_name(f"frame_{f + 8}.obj"))
            files[-1].write_bytes(self.text(random, random.normal(size=(count, 3)) * scale_of, faces, style).encode())
        encoded = path.with_suffix(".anic")
        done = command.run("encode", "-q", "-f", "--lossless", "--effort", "fast", "--order", "all", path.with_name("frame_*.obj"), "-o", encoded)
        if done.returncode:
            yield done.stderr.strip()
            return
        for name, times, frames in command.frames(encoded):
            yield from differences(name, times, frames, map(self.triangles, files))


FORMATS = {"gltf": GltfFormat, "abc": AbcFormat, "fbx": FbxFormat, "usd": UsdFormat, "obj": ObjFormat}


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--keep")
    parser.add_argument("--modules", default="node_modules")
    parser.add_argument("--package", default=sys.executable)
    parser.add_argument("formats", nargs="+", choices=FORMATS)
    parser.add_argument("command")
    arguments = parser.parse_args()
    wrong = 0
    for name in arguments.formats:
        form = FORMATS[name](arguments)
        for seed in range(arguments.seed, arguments.seed + arguments.count):
            with tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder) / f"{name}{seed}"
                faults = list(form.faults(np.random.default_rng(seed), path, Command(arguments.command, pathlib.Path(folder))))
                for fault in faults:
                    print(f"{name} {seed}: {fault}")
                if faults:
                    wrong += 1
                    if arguments.keep:
                        shutil.copytree(folder, pathlib.Path(arguments.keep) / path.name, dirs_exist_ok=True)
        print(f"{name}: {arguments.count} scenes compared")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
