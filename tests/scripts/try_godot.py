#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Plays basis textures in Godot 3, and compares its pictures with those of meshes that have the decoder's positions.

usage: try_godot.py ANICODEC [CLIP.anic]      exit status 77 without godot3 and xvfb-run (Debian: godot3 xvfb xauth)

The shader for Godot 4 with the words of Godot 3 is on the surface of `export-vat`; the other meshes are frames of
`decode`. It takes a minute, and is no part of the tests.
"""
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
FRAMES = (0, 5, 17)
WIDTH, HEIGHT = 320, 240

SCRIPT = """extends Spatial

func texture(name):
    var image = Image.new()
    if image.load("res://" + name) != OK:
        printerr("cannot load " + name)
        get_tree().quit(1)
    var made = ImageTexture.new()
    made.create_from_image(image, 0)
    return made

func surface(points, normals, places, indices):
    var arrays = []
    arrays.resize(ArrayMesh.ARRAY_MAX)
    arrays[ArrayMesh.ARRAY_VERTEX] = vectors(points)
    arrays[ArrayMesh.ARRAY_NORMAL] = vectors(normals)
    var uvs = PoolVector2Array()
    for i in range(0, places.size(), 2):
        uvs.append(Vector2(places[i], places[i + 1]))
    arrays[ArrayMesh.ARRAY_TEX_UV2] = uvs
    arrays[ArrayMesh.ARRAY_INDEX] = PoolIntArray(indices)
    var mesh = ArrayMesh.new()
    mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays, [], 0)
    return mesh

func vectors(numbers):
    var all = PoolVector3Array()
    for i in range(0, numbers.size(), 3):
        all.append(Vector3(numbers[i], numbers[i + 1], numbers[i + 2]))
    return all

func picture(node, name):
    for other in shown:
        other.visible = other == node
    yield(get_tree(), "idle_frame")
    yield(get_tree(), "idle_frame")
    VisualServer.force_draw()
    var image = get_viewport().get_texture().get_data()
    image.flip_y()
    image.save_png("res://" + name)

var shown = []

func _ready():
    var file = File.new()
    file.open("res://scene.json", File.READ)
    var scene = JSON.parse(file.get_as_text()).result
    var camera = Camera.new()
    add_child(camera)
    camera.look_at_from_position(Vector3(scene.eye[0], scene.eye[1], scene.eye[2]), Vector3(scene.centre[0], scene.centre[1], scene.centre[2]), Vector3(0, 1, 0))
    camera.far = 10 * scene.size
    camera.near = 0.01 * scene.size
    var lamp = DirectionalLight.new()
    lamp.rotation_degrees = Vector3(-40, 30, 0)
    add_child(lamp)
    var played = MeshInstance.new()
    played.mesh = surface(scene.rest, scene.normals, scene.places, scene.indices)
    played.extra_cull_margin = 16384
    var material = ShaderMaterial.new()
    material.shader = load("res://basis.shader")
    material.set_shader_param("anic_basis", texture(scene.basis))
    material.set_shader_param("anic_weights", texture(scene.weights))
    for name in scene.uniforms:
        material.set_shader_param(name, scene.uniforms[name])
    material.set_shader_param("loop", false)
    played.material_override = material
    add_child(played)
    shown.append(played)
    for i in range(scene.times.size()):
        material.set_shader_param("clip_time", scene.times[i])
        yield(picture(played, "shader_%d.png" % i), "completed")
        var plain = MeshInstance.new()
        plain.mesh = surface(scene.frames[i], scene.frame_normals[i], scene.places, scene.indices)
        var still = ShaderMaterial.new()
        still.shader = load("res://still.shader")
        plain.material_override = still
        add_child(plain)
        shown.append(plain)
        yield(picture(plain, "plain_%d.png" % i), "completed")
    get_tree().quit()
"""

PROJECT = f"""config_version=4
[application]
config/name="textures"
run/main_scene="res://main.tscn"
[display]
window/size/width={WIDTH}
window/size/height={HEIGHT}
"""

SCENE = """[gd_scene load_steps=2 format=2]
[ext_resource path="res://main.gd" type="Script" id=1]
[node name="main" type="Spatial"]
script = ExtResource( 1 )
"""


def glb(path):
    """{attribute: floats} and the indices of the first primitive."""
    data = path.read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    document, binary = json.loads(data[20:20 + length]), data[28 + length:]
    kinds = {5121: "B", 5123: "H", 5125: "I", 5126: "f"}

    def numbers(index):
        accessor = document["accessors"][index]
        view = document["bufferViews"][accessor["bufferView"]]
        count = accessor["count"] * {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[accessor["type"]]
        return list(struct.unpack_from(f"<{count}{kinds[accessor['componentType']]}", binary,
                                       view.get("byteOffset", 0) + accessor.get("byteOffset", 0)))

    primitive = document["meshes"][0]["primitives"][0]
    return {name: numbers(index) for name, index in primitive["attributes"].items()}, numbers(primitive["indices"])


def words_of_godot_3(shader):
    shader = shader.replace(": source_color", ": hint_color").replace("uniform sampler2D albedo_texture : hint_color",
                                                                      "uniform sampler2D albedo_texture : hint_albedo")
    return re.sub(r"(uniform sampler2D anic_\w+) :[^;]*;", r"\1;", shader)


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    missing = [name for name in ("godot3", "xvfb-run") if not shutil.which(name)]
    if missing:
        print(f"skipped: there is no {' and no '.join(missing)}")
        sys.exit(77)
    command = pathlib.Path(sys.argv[1]).resolve()
    clip = pathlib.Path(sys.argv[2]).resolve() if len(sys.argv) == 3 else None
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)

        def run(*options):
            return subprocess.run([command, *map(str, options)], cwd=folder, check=True, text=True, capture_output=True).stdout

        if clip is None:
            clip = folder / "limb.anic"
            run("corpus", "limb", "-o", "limb.pc2")
            run("encode", "-q", "limb.obj", "limb.pc2", "-o", clip, "--kg", "0.1")
        result = json.loads(run("export-vat", clip, "-o", ".", "--json", "--rmse", "0.05%"))
        description = json.loads((folder / f"{result['name']}_basis.json").read_text())
        attributes, indices = glb(folder / description["mesh"])
        # Godot has clockwise fronts.
        indices = [i for t in range(0, len(indices), 3) for i in (indices[t], indices[t + 2], indices[t + 1])]
        box, rate = description["box"], description["clips"][0]["rate"]
        centre = [(a + b) / 2 for a, b in zip(box["min"], box["max"])]
        size = max(b - a for a, b in zip(box["min"], box["max"]))
        frames, frame_normals = [], []
        for frame in FRAMES:
            run("decode", "-q", "-f", clip, "-o", "frame.glb", "--frames", frame)
            own, _ = glb(folder / "frame.glb")
            if len(own["POSITION"]) != len(attributes["POSITION"]):
                sys.exit(f"{clip}: seams have vertices of their own here; choose a clip without")
            frames.append(own["POSITION"])
            frame_normals.append(normals_of(own["POSITION"], indices))
        (folder / "scene.json").write_text(json.dumps({
            "eye": [centre[0] + 0.4 * size, centre[1] + 0.3 * size, centre[2] + size], "centre": centre, "size": size,
            "rest": attributes["POSITION"], "normals": attributes["NORMAL"], "places": attributes["TEXCOORD_1"],
            "indices": indices, "basis": description["basis"], "weights": description["weights"],
            "times": [frame / rate for frame in FRAMES], "frames": frames, "frame_normals": frame_normals,
            "uniforms": {"rows": description["rows"], "position_layers": description["position_layers"],
                         "normal_layers": description["normal_layers"], "rate": rate,
                         "frame_count": description["clips"][0]["frame_count"]}}))
        shader = words_of_godot_3((ROOT / "bindings/shaders/anicodec_basis.gdshader").read_text())
        (folder / "basis.shader").write_text(shader)
        (folder / "still.shader").write_text(re.sub(r"void vertex\(\) \{.*?\n\}\n", "", shader, flags=re.DOTALL))
        (folder / "main.gd").write_text(SCRIPT)
        (folder / "main.tscn").write_text(SCENE)
        (folder / "project.godot").write_text(PROJECT)
        done = subprocess.run(["xvfb-run", "-a", "-s", "-screen 0 640x480x24", "godot3", "--path", folder, "--video-driver", "GLES3",
                               "--audio-driver", "Dummy"], text=True, capture_output=True, timeout=300,
                              env={**os.environ, "HOME": name, "LANG": "en_US.UTF-8"})
        if done.returncode or re.search("SHADER ERROR|SCRIPT ERROR|cannot load|Parse Error", done.stdout + done.stderr):
            sys.exit(f"Godot failed:\n{done.stdout}{done.stderr}")
        print(next(line for line in done.stdout.splitlines() if line.startswith("Godot")), "by",
              next(line for line in done.stdout.splitlines() if "OpenGL" in line))
        for i, frame in enumerate(FRAMES):
            compare(folder, i, frame)


def normals_of(points, indices):
    """Normals of vertices, by the areas of their triangles."""
    sums = [0.0] * len(points)
    for t in range(0, len(indices), 3):
        a, c, b = (points[3 * v:3 * v + 3] for v in indices[t:t + 3])
        p, q = ([y - x for x, y in zip(a, end)] for end in (b, c))
        n = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
        for v in indices[t:t + 3]:
            for k in range(3):
                sums[3 * v + k] += n[k]
    for v in range(0, len(sums), 3):
        length = sum(x * x for x in sums[v:v + 3]) ** 0.5 or 1
        sums[v:v + 3] = [x / length for x in sums[v:v + 3]]
    return sums


def compare(folder, number, frame):
    """Prints, for a pair of pictures, the share of pixels that differ."""
    ours, theirs = (pixels(folder / f"{kind}_{number}.png") for kind in ("shader", "plain"))
    background = theirs[0]
    lit = sum(p != background for p in theirs)
    off = sum(max(abs(a - b) for a, b in zip(p, q)) > 24 for p, q in zip(ours, theirs))
    print(f"frame {frame}: {lit} pixels of the surface, {off} differ")
    if lit < 1000 or off > 0.05 * lit:
        keep = pathlib.Path(tempfile.mkdtemp())
        for path in folder.glob("*.png"):
            shutil.copy(path, keep)
        sys.exit(f"the pictures differ: {keep}")


def pixels(path):
    """The pixels of a PNG of 8 bits without interlacing."""
    import zlib
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, _, colour = struct.unpack_from(">IIBB", body)
        elif kind == b"IDAT":
            packed += body
        at += 12 + length
    step = {2: 3, 6: 4}[colour]
    raw, rows, before = zlib.decompress(packed), [], bytes(step * width)
    for y in range(height):
        start = y * (step * width + 1)
        kind, line = raw[start], bytearray(raw[start + 1:start + 1 + step * width])
        for i, x in enumerate(line):
            left = line[i - step] if i >= step else 0
            corner = before[i - step] if i >= step else 0
            guess = left + before[i] - corner
            paeth = min((left, before[i], corner), key=lambda p: abs(guess - p))
            line[i] = x + (0, left, before[i], (left + before[i]) // 2, paeth)[kind] & 255
        before = bytes(line)
        rows += [tuple(line[i:i + 3]) for i in range(0, len(line), step)]
    return rows


if __name__ == "__main__":
    main()
