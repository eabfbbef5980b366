# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Tests of the add-on, run by Blender or by a Python with bpy: in_blender.py SITE_PACKAGES ADDONS WORK

Prints a line for each test; the first that fails ends it with exit status 1."""
import pathlib
import sys
import time
import traceback

arguments = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else sys.argv[1:]
sys.path[:0] = arguments[1:2]
sys.path.append(arguments[0])

import bpy  # noqa: E402
import numpy as np  # noqa: E402

import anicodec  # noqa: E402
import anicodec_blender  # noqa: E402
from anicodec_blender import looks as blender_looks, meshes  # noqa: E402

WORK = pathlib.Path(arguments[2])
FRAMES = 12


def empty_scene():
    bpy.ops.wm.read_homefile(use_empty=True)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end, scene.render.fps = 1, FRAMES, 30
    return scene


def add_grid(name="Sheet", side=20):
    """A grid with texture coordinates, two materials, a hard edge and a modifier that moves it, under a moving
    parent."""
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=side, y_subdivisions=side, size=2, calc_uvs=True)
    item = bpy.context.object
    item.name = name
    for material in ("skin", "cloth"):
        item.data.materials.append(bpy.data.materials.new(material))
    item.data.polygons.foreach_set("material_index", np.arange(len(item.data.polygons), dtype=np.int32) % 2)
    wave = item.modifiers.new("wave", "WAVE")
    wave.height, wave.speed, wave.time_offset = 0.3, 0.1, -40
    item.location = (1, 0, 0)
    item.keyframe_insert("location", frame=1)
    item.location = (1, 2, 1)
    item.keyframe_insert("location", frame=FRAMES)
    return item


def evaluated(item, frame, subframe=0.0):
    bpy.context.scene.frame_set(frame, subframe=subframe)
    owner = item.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = owner.to_mesh()
    matrix = np.array(owner.matrix_world, np.float64)
    positions = meshes.positions_of(mesh) @ matrix[:3, :3].T + matrix[:3, 3]
    owner.to_mesh_clear()
    return positions


def export(path, **options):
    return bpy.ops.export_scene.anic(filepath=str(path), effort="fast", **options)


def bring_in(path, **options):
    """The object that an import adds."""
    before = set(bpy.data.objects)
    assert bpy.ops.import_scene.anic(filepath=str(path), **options) == {"FINISHED"}
    return [item for item in bpy.data.objects if item not in before]


def round_trip():
    """A clip of the sheet, and its positions in the world."""
    empty_scene()
    sheet = add_grid()
    expected = [evaluated(sheet, frame) for frame in range(1, FRAMES + 1)]
    path = WORK / "sheet.anic"
    assert export(path) == {"FINISHED"}
    return sheet, expected, path


def test_export_keeps_the_promise():
    sheet, expected, path = round_trip()
    clip = anicodec.open(path)
    assert clip.frame_count == FRAMES and clip.fps == 30 and clip.info["up"] == "z"
    for frame in range(FRAMES):
        off = np.linalg.norm(clip[frame] - expected[frame], axis=1).max()
        assert off <= 0.0005 * clip.info["diagonal"] * 1.001, (frame, off)
    kinds = {attribute.kind: attribute for attribute in clip.attributes}
    assert kinds["uv"].name == "UVMap" and kinds["material"].labels == ("skin", "cloth")


def volume(clip, frame):
    """The signed volume of all meshes that are there: positive where faces point outwards."""
    total = 0.0
    for mesh in clip.meshes:
        if mesh.shown_in(frame):
            a, b, c = np.moveaxis(mesh[frame].astype(np.float64)[mesh.triangles], 1, 0)
            total += np.einsum("ij,ij->", a, np.cross(b, c)) / 6
    return total


def test_mirrored_objects_turn_their_faces():
    scene = empty_scene()
    scene.frame_end = 4
    bpy.ops.mesh.primitive_cube_add(size=1, calc_uvs=True)
    item = bpy.context.object
    path = WORK / "mirrored.anic"
    item.scale = (-1, 1, 1)
    bpy.context.view_layer.update()
    assert export(path) == {"FINISHED"}
    clip = anicodec.open(path)
    assert abs(volume(clip, 0) - 1) < 0.01 and len(clip.meshes) == 1
    layer = item.data.uv_layers[0].data  # eighths
    expected = set()
    for loop in item.data.loops:
        x, y, z = np.sign(item.data.vertices[loop.vertex_index].co)
        expected.add((-x, y, z, *np.round(8 * np.array(layer[loop.index].uv))))
    uv = next(attribute for attribute in clip.attributes if attribute.kind == "uv")
    corners = clip.polygons[1]
    assert uv.domain == "corners"
    found = {(*np.sign(place), *np.round(8 * value)) for place, value in zip(clip[0][corners], uv.values)}
    assert expected == found, (expected, found)
    assert export(path, space="OBJECT") == {"FINISHED"}
    assert abs(volume(anicodec.open(path), 0) - 1) < 0.01, "as it is in its own space"
    for frame, x in ((1, 1), (2, -1), (3, -1), (4, 1)):
        item.scale = (x, 1, 1)
        item.keyframe_insert("scale", frame=frame)
    assert export(path) == {"FINISHED"}
    clip = anicodec.open(path)
    assert len(clip.meshes) == 2 and all(abs(volume(clip, frame) - 1) < 0.01 for frame in range(4))


def test_import_follows_the_timeline():
    _, expected, path = round_trip()
    empty_scene()
    item, = bring_in(path)
    scene = bpy.context.scene
    assert (scene.frame_start, scene.frame_end, scene.render.fps) == (1, FRAMES, 30)
    bound = anicodec.open(path).info["max_error"] * 1.01 + 1e-6
    for frame in (5, 12, 1, 7):
        assert np.linalg.norm(evaluated(item, frame) - expected[frame - 1], axis=1).max() <= bound, frame
    middle = evaluated(item, 5, 0.5)
    assert np.allclose(middle, anicodec.open(path).at(4.5 / 30), atol=1e-5), "parts of a frame"
    # Corrections of single frames are not applied between them.
    assert np.allclose(middle, (evaluated(item, 5) + evaluated(item, 6)) / 2, atol=bound), "half way"
    settings = item.data.anicodec
    settings.wrap, settings.start, settings.speed = "loop", 3, 2
    assert np.allclose(evaluated(item, 5), expected[4], atol=bound)
    assert np.allclose(evaluated(item, 3 + FRAMES // 2), expected[0], atol=bound), "goes round"
    assert len(item.data.uv_layers) == 1 and [m.name for m in item.data.materials] == ["skin", "cloth"]


def test_clips_are_chosen_and_faded():
    empty_scene()
    sheet = add_grid()
    frames = np.stack([evaluated(sheet, frame) for frame in range(1, FRAMES + 1)])
    clips = [anicodec.SourceClip("walk", 7), anicodec.SourceClip("run", FRAMES - 7, fps=60)]
    polygons = meshes.polygon_starts(sheet.data), meshes.corners_of(sheet.data).astype(np.uint32)
    path = WORK / "moves.anic"
    path.write_bytes(anicodec.encode(frames, polygons, clips=clips, fps=30, effort="fast", up="z"))
    bound = max(info.max_error for info in anicodec.open(path).clips) * 1.01 + 1e-6

    scene = empty_scene()
    item, = bring_in(path, clip="run")
    assert (scene.frame_end, scene.render.fps) == (FRAMES - 7, 60)
    assert np.allclose(evaluated(item, 3), frames[7 + 2], atol=bound)
    settings = item.data.anicodec
    assert settings.clip == "run"
    settings.clip = "walk"
    assert np.allclose(evaluated(item, 5), anicodec.open(path).at(4 / 60, clip="walk"), atol=1e-5)
    settings.fade_clip, settings.fade_start = "run", 5
    for frame, fade in ((5, 0.0), (7, 1.0)):
        settings.fade = fade
        settings.keyframe_insert("fade", frame=frame)
    assert np.allclose(evaluated(item, 5), anicodec.open(path).at(4 / 60), atol=1e-5), "not yet"
    middle = evaluated(item, 6)
    walk, run = anicodec.open(path).at(5 / 60), anicodec.open(path).at(1 / 60, clip="run")
    assert np.allclose(middle, (walk + run) / 2, atol=2 * bound), "half way"
    assert np.allclose(evaluated(item, 7), anicodec.open(path).at(2 / 60, clip="run"), atol=1e-5), "done"
    for method in ("SHAPE_KEYS", "CACHE"):
        empty_scene()
        item, = bring_in(path, method=method, clip="run")
        assert np.allclose(evaluated(item, 2), frames[7 + 1], atol=bound), method
    try:
        bring_in(path, clip="swim")
    except RuntimeError as error:
        assert "no clip 'swim'" in str(error), error
    else:
        raise AssertionError("accepted")


def test_looks_of_materials_come_back():
    empty_scene()
    sheet = add_grid()
    skin, cloth = sheet.data.materials
    if not skin.use_nodes:
        skin.use_nodes = True
    shader = skin.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (0.25, 0.5, 0.75, 1)
    shader.inputs["Metallic"].default_value, shader.inputs["Roughness"].default_value = 0.5, 0.125
    skin.use_backface_culling = True
    cloth_has_nodes = cloth.use_nodes
    cloth.diffuse_color, cloth.roughness = (1, 0.5, 0.25, 1), 0.75
    path = WORK / "looks.anic"
    assert export(path) == {"FINISHED"}
    looks = {label: look for attribute in anicodec.open(path).attributes if attribute.kind == "material"
             for label, look in zip(attribute.labels, attribute.looks)}
    assert looks["skin"].base_colour == (0.25, 0.5, 0.75, 1) and not looks["skin"].double_sided
    assert (looks["skin"].metallic, looks["skin"].roughness, looks["skin"].emissive) == (0.5, 0.125, (0, 0, 0))
    if not cloth_has_nodes:  # as all materials do from Blender 5 on
        assert (looks["cloth"].base_colour, looks["cloth"].roughness) == ((1, 0.5, 0.25, 1), 0.75)
    empty_scene()
    item, = bring_in(path)
    for material in item.data.materials:
        assert blender_looks.look_of(material) == looks[material.name], material.name


def test_settings_survive_save_and_reload():
    _, expected, path = round_trip()
    empty_scene()
    item, = bring_in(path)
    other = bpy.data.objects.new("again", item.data)
    bpy.context.collection.objects.link(other)
    blend = WORK / "sheet.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(blend))
    bpy.ops.wm.open_mainfile(filepath=str(blend))
    for name in (item_name for item_name in bpy.data.objects.keys()):
        assert np.allclose(evaluated(bpy.data.objects[name], 9), expected[8], atol=0.01), name


def test_a_packed_clip_needs_no_file():
    _, expected, path = round_trip()
    empty_scene()
    bring_in(path, pack=True)
    blend = WORK / "packed.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(blend))
    path.unlink()
    bpy.ops.wm.open_mainfile(filepath=str(blend))
    item = bpy.data.objects[0]
    assert np.allclose(evaluated(item, 6), expected[5], atol=0.01)
    bpy.ops.wm.read_homefile(use_empty=True)
    with bpy.data.libraries.load(str(blend)) as (source, target):
        target.objects = source.objects
    bpy.context.collection.objects.link(target.objects[0])
    bpy.context.scene.render.fps = 30
    assert np.allclose(evaluated(target.objects[0], 6), expected[5], atol=0.01), "appended"


def test_shape_keys_and_mesh_cache():
    _, expected, path = round_trip()
    for method in ("SHAPE_KEYS", "CACHE"):
        empty_scene()
        item, = bring_in(path, method=method)
        for frame in (1, 4, 12):
            off = np.linalg.norm(evaluated(item, frame) - expected[frame - 1], axis=1).max()
            assert off < 0.01, (method, frame, off)


def test_hidden_objects_are_absent():
    empty_scene()
    add_grid("Sheet")
    guest = add_grid("Guest", 5)
    for frame, hidden in ((1, True), (4, False), (8, True)):
        guest.hide_render = hidden
        guest.keyframe_insert("hide_render", frame=frame)
    path = WORK / "guests.anic"
    assert export(path, selected=False) == {"FINISHED"}
    clip = anicodec.open(path)
    named = {mesh.name: mesh for mesh in clip.meshes}
    assert [f for f in range(FRAMES) if named["Guest"].shown_in(f)] == [3, 4, 5, 6]
    empty_scene()
    items = {item.name.partition(".")[0]: item for item in bring_in(path)}
    for frame, hidden in ((2, True), (5, False), (9, True)):
        bpy.context.scene.frame_set(frame)
        assert items["Guest"].hide_render == hidden, frame
    assert not items["Sheet"].hide_render


def test_changing_faces_are_named_and_become_segments():
    empty_scene()
    sheet = add_grid("Sheet", 6)
    decimate = sheet.modifiers.new("fewer", "DECIMATE")
    decimate.ratio = 1.0
    decimate.keyframe_insert("ratio", frame=6)
    decimate.ratio = 0.3
    decimate.keyframe_insert("ratio", frame=7)
    path = WORK / "fewer.anic"
    try:
        export(path)
    except RuntimeError as error:
        assert "Sheet: the faces change in frame 7" in str(error), error
    else:
        raise AssertionError("accepted")
    assert not path.exists()
    assert export(path, segments=True) == {"FINISHED"}
    assert len(anicodec.open(path).meshes) >= 2


def test_faults_are_reported():
    empty_scene()
    path = WORK / "bad.anic"
    path.write_bytes(b"nothing of the kind")
    for call, text in ((lambda: bpy.ops.import_scene.anic(filepath=str(path)), "bad.anic"),
                       (lambda: export(WORK / "none.anic"), "no mesh is selected")):
        try:
            call()
        except RuntimeError as error:
            assert text in str(error), error
        else:
            raise AssertionError(text)


def test_a_frame_costs_little():
    empty_scene()
    add_grid("Sheet", 84)  # 7225 vertices
    path = WORK / "large.anic"
    assert export(path) == {"FINISHED"}
    empty_scene()
    item, = bring_in(path)
    scene = bpy.context.scene
    start = time.process_time()
    for turn in range(50):
        scene.frame_set(1 + turn % FRAMES)
    spent = (time.process_time() - start) / 50
    print(f"  {1000 * spent:.2f} ms a frame of {len(item.data.vertices)} vertices")
    assert spent < 0.02


def test_renders_agree_with_the_viewport():
    if "CYCLES" not in [getattr(engine, "bl_idname", "") for engine in bpy.types.RenderEngine.__subclasses__()]:
        print("  without Cycles: not tried")
        return
    round_trip()
    path = WORK / "sheet.anic"

    def render(name, animation, blur=False):
        scene = bpy.context.scene
        camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
        scene.collection.objects.link(camera)
        camera.location = (1, 1, 8)
        scene.camera = camera
        scene.render.engine = "CYCLES"
        scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.device = 1, False, "CPU"
        scene.render.resolution_x = scene.render.resolution_y = 24
        scene.render.use_motion_blur, scene.render.motion_blur_shutter = blur, 2.0
        sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
        sun.data.energy = 3
        scene.collection.objects.link(sun)
        scene.frame_start = scene.frame_end = 8
        scene.frame_set(8 if not animation else 1)
        scene.render.filepath = str(WORK / name)
        bpy.ops.render.render(animation=animation, write_still=True)
        files = sorted(WORK.glob(name + "*.png"))
        image = bpy.data.images.load(str(files[-1]))
        return np.array(image.pixels[:])

    still = render("original", False)
    empty_scene()
    bring_in(path)
    moved = render("clip", False)
    empty_scene()
    bring_in(path)
    animated = render("animated", True)
    empty_scene()
    item, = bring_in(path)
    blurred = render("blurred", False, True)
    assert not np.array_equal(moved, blurred) and np.abs(moved - blurred).mean() < 0.2, "parts of a frame are shown"
    assert np.allclose(evaluated(item, 8), anicodec.open(path)[7], atol=1e-5), "and the frame is back"
    assert still.reshape(-1, 4)[:, 0].std() > 0.1, "shows something"
    assert np.abs(still - moved).mean() < 0.02, np.abs(still - moved).mean()
    assert np.array_equal(moved, animated)


def main():
    anicodec_blender.register()
    print(f"Blender {bpy.app.version_string}")
    for name, test in sorted(globals().items()):
        if name.startswith("test_"):
            start = time.perf_counter()
            test()
            print(f"{name}: {time.perf_counter() - start:.1f} s", flush=True)
    anicodec_blender.unregister()


if __name__ == "__main__":
    try:
        main()
    except BaseException:
        traceback.print_exc()
        sys.stdout.flush()
        sys.exit(1)
