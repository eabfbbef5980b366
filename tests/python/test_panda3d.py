# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Clips in Panda3D, drawn by its software renderer."""
import pathlib
import subprocess
import sys

import numpy as np
import pytest

pytest.importorskip("panda3d", reason="panda3d is not installed")

from panda3d.core import (AmbientLight, ClockObject, DirectionalLight, FrameBufferProperties, Geom,  # noqa: E402
                          GraphicsEngine, GraphicsPipe, GraphicsPipeSelection, NodePath, PerspectiveLens, PNMImage,
                          WindowProperties, Camera, load_prc_file_data)

import anicodec  # noqa: E402
from anicodec.panda3d import ClipActor  # noqa: E402

TESTS = pathlib.Path(__file__).resolve().parent.parent
FILES = TESTS / "conformance"
sys.path.insert(0, str(TESTS / "engines"))
import picture  # noqa: E402

load_prc_file_data("", "load-display p3tinydisplay\naux-display\nnotify-level-display fatal\n")


def shown(actor, mesh=0, array=0):
    data = actor._data[mesh]
    return np.frombuffer(memoryview(data.get_array(array)).cast("B").cast("f"), np.float32).reshape(-1, 3).copy()


def expected(actor, seconds):
    """Positions of vertices at a time, as the package gives them, for each vertex of the engine."""
    vertices = actor._surfaces[0].plan.info()["vertices"]
    return actor.clip.at(seconds, loop=True)[vertices]


def test_shows_what_the_clip_shows(clip):
    actor = ClipActor(clip)
    actor.loop()
    for _ in range(3):
        actor.update(0.1)
    assert actor.get_time() == pytest.approx(0.3)
    np.testing.assert_array_equal(shown(actor), expected(actor, actor.get_time()))
    normals = shown(actor, array=1)
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-5)
    np.testing.assert_allclose(normals, clip.normals(expected_source(actor), source_edges=True, crease=60)[
        actor._surfaces[0].plan.info()["vertices"]], atol=1e-5)


def expected_source(actor):
    return actor.clip.at(actor.get_time(), loop=True)


def test_plays_as_an_actor_does(clip):
    actor = ClipActor(clip)
    actor.set_play_rate(2)
    actor.play()
    actor.update(0.1)
    assert actor.get_time() == pytest.approx(0.2)
    actor.stop()
    actor.update(0.1)
    assert actor.get_time() == pytest.approx(0.2)
    actor.pose(None, 5)
    np.testing.assert_array_equal(shown(actor), clip[5][actor._surfaces[0].plan.info()["vertices"]])
    actor.play()
    actor.update(1000)
    np.testing.assert_allclose(shown(actor), clip[-1][actor._surfaces[0].plan.info()["vertices"]], atol=1e-6)


def test_fades_between_clips_of_a_file():
    actor = ClipActor(str(FILES / "clips.anic"))
    names = actor.get_anim_names()
    assert len(names) > 1 and actor.clip.clips[1].first_frame == actor.clip.clips[0].frame_count
    actor.loop(names[0])
    before = shown(actor)
    actor.cross_fade(names[1], 0.5)
    actor.update(0.25)
    between = shown(actor)
    actor.update(0.3)
    assert actor._fade is None and actor.get_time() == pytest.approx(0.55)
    other = ClipActor(actor)
    assert other.clip is actor.clip
    other.loop(names[1])
    other.update(0.55)
    np.testing.assert_array_equal(shown(actor), shown(other))
    assert not np.array_equal(before, between) and not np.array_equal(between, shown(actor))
    with pytest.raises(anicodec.InputError, match="no clip 'nothing'"):
        actor.loop("nothing")


def test_moves_its_root():
    clip = anicodec.open(str(FILES / "walk.anic"), in_place=True)
    actor = ClipActor(clip)
    actor.root = actor
    actor.set_scale(3)
    actor.loop("turn")
    for _ in range(10):
        actor.update(0.05)
    step = clip.root_step(0, 0.5, "turn")
    assert np.linalg.norm(step.move) > 0.01 and abs(step.turn) > 0.01
    np.testing.assert_allclose(np.array(actor.get_pos()) / 3, step.move, atol=1e-4)
    assert np.radians(actor.get_h()) == pytest.approx(step.turn, abs=1e-4)
    actor.set_play_rate(-1)
    actor.update(0.5)
    np.testing.assert_allclose(actor.get_pos(), (0, 0, 0), atol=1e-3)


def test_hides_meshes_that_are_not_there():
    actor = ClipActor(str(FILES / "scene.anic"))
    hidden = set()
    for frame in range(actor.clip.frame_count):
        actor.pose(None, frame)
        hidden |= {(frame, m) for m, node in enumerate(actor._nodes) if node.is_hidden()}
    assert hidden == {(f, m) for f in range(actor.clip.frame_count) for m in range(len(actor.clip.meshes))
                      if not actor.clip.meshes[m].shown_in(f)}


def test_has_a_node_for_each_material():
    actor = ClipActor(str(FILES / "painted_box.anic"))
    looks = next(a for a in actor.clip.attributes if a.kind == "material")
    for name, look in zip(looks.labels, looks.looks):
        material = actor.find(f"**/{name}").get_material()
        assert look is None or tuple(material.get_base_color()) == pytest.approx(look.base_colour)
        assert look is None or material.get_roughness() == pytest.approx(look.roughness)


def test_plays_coarser(clip):
    actor, other = ClipActor(clip), ClipActor(anicodec.open(clip.data, quality=0.3))
    actor.set_quality(0.3)
    for one in (actor, other):
        one.loop()
        one.update(0.2)
    np.testing.assert_array_equal(shown(actor), shown(other))


def test_a_program_ends_silently():
    """With a node that it never gave back."""
    script = f"""
import builtins
from anicodec.panda3d import ClipActor
builtins.actor = ClipActor({str(FILES / "clips.anic")!r})
builtins.actor.clip.me = builtins.actor
"""
    result = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert (result.returncode, result.stdout, result.stderr) == (0, "", "")


class Tasks:
    """As much of a task manager as start() needs."""

    def add(self, function, name, sort):
        self.function, self.cont = function, 1
        return self

    def remove(self):
        self.function = None


def test_goes_on_with_the_clock(clip):
    tasks = Tasks()
    actor = ClipActor(clip)
    actor.loop()
    actor.start(tasks)
    clock = ClockObject.get_global_clock()
    clock.mode, clock.dt = ClockObject.M_non_real_time, 0.125
    clock.tick()
    assert tasks.function(tasks) == 1 and actor.get_time() == pytest.approx(0.125)
    actor.cleanup()
    assert tasks.function is None and actor.is_empty()


def test_draws_a_scene(tmp_path):
    pipe = GraphicsPipeSelection.get_global_ptr().make_module_pipe("p3tinydisplay")
    if pipe is None:
        pytest.skip("Panda3D has no software renderer here")
    engine = GraphicsEngine(pipe)
    properties = FrameBufferProperties()
    properties.set_rgb_color(True)
    properties.set_depth_bits(16)
    window = engine.make_output(pipe, "test", 0, properties, WindowProperties.size(480, 270), GraphicsPipe.BF_refuse_window)
    root = NodePath("root")
    for i, name in enumerate(("limb_default", "painted_box", "limb_effort9")):
        actor = ClipActor(str(FILES / f"{name}.anic"))
        low, high = actor.get_tight_bounds()
        scale = 1.8 / max(high - low)
        actor.reparent_to(root)
        actor.set_scale(scale)
        actor.set_pos((low + high) * (-scale / 2))
        actor.set_x(actor.get_x() + 2.2 * (i - 1))
        actor.set_color((0.9, 0.6, 0.4, 1) if i % 2 else (0.4, 0.6, 0.9, 1))
        actor.loop()
        actor.update(0.2)
        assert all(isinstance(geom, Geom) for node in actor.find_all_matches("**/+GeomNode") for geom in node.node().get_geoms())
    for light, colour in ((AmbientLight("ambient"), (0.3, 0.3, 0.3, 1)), (DirectionalLight("sun"), (0.8, 0.8, 0.8, 1))):
        light.set_color(colour)
        node = root.attach_new_node(light)
        node.set_hpr(-30, -50, 0)
        root.set_light(node)
    camera = root.attach_new_node(Camera("camera", PerspectiveLens(50, 29)))
    camera.set_pos(0, -8.5, 2.2)
    camera.look_at(0, 0, 0)
    region = window.make_display_region()
    region.camera = camera
    window.set_clear_color((0.6, 0.75, 0.9, 1))
    for _ in range(2):
        engine.render_frame()
    image = PNMImage()
    assert window.get_screenshot(image)
    path = tmp_path / "panda3d.ppm"
    assert image.write(str(path))
    assert picture.compare(path, "panda3d") is None
    engine.remove_all_windows()
