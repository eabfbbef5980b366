# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Opened clips."""
import base64
import io
import os
import pickle
import sys
import types
from concurrent.futures import ThreadPoolExecutor
from xml.etree import ElementTree

import anic_file
import numpy as np
import pytest

import anicodec


def test_frames_keep_the_promise(wave, clip):
    positions, faces = wave
    assert len(clip) == 24 and clip.name == "wave" and clip.fps == 24 and clip.frame_count == 24
    assert np.linalg.norm(clip[:] - positions, axis=2).max() <= clip.info["max_error"] * (1 + 1e-3)
    assert clip[3].shape == (144, 3) and clip[3].dtype == np.float32
    assert np.array_equal(clip[-1], clip[23])
    assert np.array_equal(clip[20:2:-3], np.stack([clip[f] for f in range(20, 2, -3)]))
    assert np.array_equal(clip[[5, 1, 5]], np.stack([clip[5], clip[1], clip[5]]))
    assert np.array_equal(np.stack(list(clip)), clip[:])
    assert clip[7:7].shape == (0, 144, 3)
    for wrong in (24, -25):
        with pytest.raises(IndexError):
            clip[wrong]
    with pytest.raises(IndexError):
        clip[[0, 24]]
    for wrong in (1.5, "walk"):
        with pytest.raises(TypeError, match=f"a frame is a number, not {wrong!r}"):
            clip[wrong]


def test_faces(wave, clip):
    assert clip.faces.shape == wave[1].shape
    assert {frozenset(face) for face in clip.faces.tolist()} == {frozenset(face) for face in wave[1].tolist()}
    assert clip.triangles.shape == (242, 3)
    mixed = anicodec.open(anicodec.encode(wave[0], [(0, 1, 2), (1, 2, 3, 4)], order="all", effort="fast"))
    offsets, corners = mixed.faces
    assert offsets.tolist() == [0, 3, 7] and corners.tolist() == [0, 1, 2, 1, 2, 3, 4]
    assert anicodec.encode(mixed[:], mixed.faces, effort="fast")


def test_times(clip):
    assert np.array_equal(clip.at(5 / 24), clip[5])
    middle = clip.at(5.5 / 24)
    assert np.allclose(middle, (clip[5] + clip[6]) / 2, atol=1e-5)
    assert np.array_equal(clip.at(5.5 / 24, sampling="step"), clip[5])
    assert np.array_equal(clip.at(25 / 24, loop=True), clip.at(1 / 24))
    assert np.array_equal(clip.at(9), clip[23])
    assert clip.time(12) == pytest.approx(0.5)
    with pytest.raises(ValueError, match="one of step, linear, cubic, not 'fast'"):
        clip.at(0, sampling="fast")
    with pytest.raises(ValueError):
        clip.at(float("nan"))


def test_out(clip):
    out = np.zeros((144, 3), np.float32)
    assert clip.frames(4, out=out) is out and np.array_equal(out, clip[4])
    assert clip.at(0.1, out=out) is out
    for wrong in (np.zeros((144, 3)), np.zeros((143, 3), np.float32), np.zeros((3, 144), np.float32).T,
                  np.zeros((144, 3), ">f4")):
        with pytest.raises(ValueError, match="out must be"):
            clip.frames(4, out=wrong)
    out.flags.writeable = False
    with pytest.raises(ValueError, match="writeable"):
        clip.frames(4, out=out)
    with pytest.raises(TypeError):
        clip.frames(4, out=[0])


def test_normals(clip):
    normals = clip.normals(3)
    assert normals.shape == (144, 3)
    assert np.allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-5)
    assert np.array_equal(clip.normals(clip[3]), normals)
    assert clip.normals(3, per_corner=True, crease=0.001).shape == (4 * 121, 3)
    with pytest.raises(ValueError, match="must be 144 x 3"):
        clip.normals(np.zeros((2, 3)))


def test_attributes_of_corners_and_polygons_that_move(wave):
    positions, faces = wave
    frames, turns = np.arange(len(positions))[:, None, None], np.arange(faces.size)[:, None] % 3
    uv = (np.random.default_rng(1).random((faces.size, 2)) + 0.01 * frames + 0.02 * turns * np.sin(frames)).astype(np.float32)
    pressure = (np.sin(0.2 * np.arange(len(faces))[:, None] + 0.1 * frames) * [1, 2, 3, 4]).astype(np.float32)
    clip = anicodec.open(anicodec.encode(positions, faces, uv=uv, custom={"pressure": pressure}, order="all", effort="fast"))
    for number, values in enumerate((uv, pressure)):
        attribute = clip.attributes[number]
        assert attribute.moves and attribute.domain == ("corners", "polygons")[number]
        for frame in (0, 7, 11):
            off = np.abs(clip.attribute_at(number, frame / 24) - values[frame]).max()
            assert off <= 0.0011 * (values.max(axis=(0, 1)) - values.min(axis=(0, 1))).max()


def test_moving_attribute(wave):
    positions, faces = wave
    colours = np.clip(positions * [1, 1, 5] * 0.5 + 0.25, 0, 1)
    clip = anicodec.open(anicodec.encode(positions, faces, colours=colours, effort="fast"))
    assert clip.attributes[0].moves
    assert np.abs(clip.attribute_at(0, 7 / 24) - colours[7]).max() < 0.01
    with pytest.raises(ValueError):
        clip.attribute_at(1, 0)


def test_opens_anything(tmp_path, clip):
    path = tmp_path / "wave.anic"
    path.write_bytes(clip.data)
    for source in (path, str(path), clip.data, bytearray(clip.data), memoryview(clip.data), io.BytesIO(clip.data),
                   np.frombuffer(clip.data, np.uint8)):
        assert np.array_equal(anicodec.open(source)[2], clip[2])
    with open(path, "rb") as file:
        assert anicodec.open(file).data == clip.data
    with pytest.raises(FileNotFoundError):
        anicodec.open(tmp_path / "none.anic")
    with open(path, encoding="latin-1") as file, pytest.raises(TypeError):
        anicodec.open(file)
    clip.verify()


def test_pickle_and_repr(clip):
    again = pickle.loads(pickle.dumps(clip))
    assert np.array_equal(again[5], clip[5])
    assert repr(clip) == f"<anicodec.Clip 'wave': 144 vertices, 24 frames at 24 per second, {len(clip.data)} bytes>"
    assert repr(clip.mesh) == "<anicodec.Mesh: 144 vertices, 121 polygons>"
    with pytest.raises(AttributeError):
        clip.colour


def test_damaged_files(clip):
    data = clip.data
    with pytest.raises(anicodec.CorruptError, match="^offset "):
        anicodec.open(data[:-3])
    with pytest.raises(ValueError):
        anicodec.open(b"")
    with pytest.raises(ValueError):
        anicodec.open(b"no clip at all" * 9)
    for place in range(0, len(data), 37):
        damaged = bytearray(data)
        damaged[place] ^= 0x55
        with pytest.raises(anicodec.AnicodecError):
            anicodec.open(damaged)
            anicodec.read_bounds(damaged)  # which no opening looks at
    with pytest.raises(MemoryError):
        anicodec.open(data, max_bytes=100)
    with pytest.raises(ValueError):
        anicodec.open(data, quality=2)


@pytest.fixture(scope="module")
def moves(wave):
    """Two clips of one mesh: 14 frames at 24 a second, and 10 at 60."""
    return anicodec.encode(*wave, clips=[anicodec.SourceClip("walk", 14), anicodec.SourceClip("run", 10, fps=60)],
                           fps=24, effort="fast")


def test_clips_of_a_file(moves):
    clip = anicodec.open(moves)
    walk, run = clip.clips
    assert clip[run.frames].shape == (10, 144, 3)
    for chosen in ("run", 1):
        assert np.array_equal(clip.at(3 / 60, clip=chosen), clip[17])
    assert np.array_equal(clip.at(3 / 24), clip[3]), "the first clip again"
    with pytest.raises(anicodec.InputError, match="no clip 'swim': the file has walk, run"):
        clip.at(0, clip="swim")
    with pytest.raises(anicodec.AbsentError):
        anicodec.open(moves, clips=["swim"])


def test_a_clip_opened_alone_is_all_there_is(moves):
    clip, alone = anicodec.open(moves), anicodec.open(moves, clips=["run"])
    for run in (alone, pickle.loads(pickle.dumps(alone))):
        assert [info.name for info in run.clips] == ["run"] and run.name == "run"
        assert len(run) == run.frame_count == 10 and run.fps == 60 and run.duration == pytest.approx(9 / 60)
        assert run.clips[0].frames == slice(0, 10) and run.info["max_error"] == clip.clips[1].max_error
        assert np.array_equal(run[:], clip[14:]) and np.array_equal(np.stack(list(run)), clip[14:])
        assert np.array_equal(run.normals(2), clip.normals(16)) and run.time(3) == pytest.approx(3 / 60)
        assert np.array_equal(run.at(3 / 60), clip[17]) and np.array_equal(run.at(3 / 60, clip=0), clip[17])
        with pytest.raises(anicodec.FrameError, match="there is no frame 10 of 10"):
            run[10]
        with pytest.raises(anicodec.InputError, match="no clip 'walk': of the file were opened run"):
            run.at(0, clip="walk")


def test_several_of_many_clips(wave):
    names = ["a", "b", "c"]
    data = anicodec.encode(*wave, clips=[anicodec.SourceClip(name, 8) for name in names], fps=24, effort="fast")
    clip, some = anicodec.open(data), anicodec.open(data, clips=["c", "a"])
    assert [(info.name, info.first_frame) for info in some.clips] == [("a", 0), ("c", 8)]
    assert np.array_equal(some[:], np.concatenate([clip[:8], clip[16:]]))
    assert np.array_equal(some.at(2 / 24, clip="c", blend=("a", 0, 0.5)), clip.at(2 / 24, clip="c", blend=("a", 0, 0.5)))


def test_names_that_are_not_utf8(wave):
    """As programs write them that know only the code page of their machine."""
    data = anicodec.encode(*wave, name="M\xfctze", events=[("Fu\xdf", 0.1)], effort="fast")
    chunks = anic_file.read_chunks(data)
    for chunk in chunks:
        for letter in "\xfc\xdf":
            chunk.payload = chunk.payload.replace(letter.encode(), letter.encode("latin-1") + b"!")
    clip = anicodec.open(anic_file.write_chunks(chunks))
    assert clip.name == "M\ufffd!tze" and clip.clips[0].events[0][0] == "Fu\ufffd!"
    assert np.array_equal(clip[5], anicodec.open(data)[5])


def test_clips_are_blended(moves):
    clip = anicodec.open(moves)
    a, b = clip[2], clip[17]
    for weight in (0, 0.25, 1):
        mixed = clip.at(2 / 24, blend=("run", 3 / 60, weight))
        assert np.allclose(mixed, (1 - weight) * a + weight * b, atol=2 * clip.info["max_error"]), weight
    around = clip.at(2 / 24, blend=("run", (10 + 3) / 60, 1), blend_wrap="loop")
    assert np.array_equal(around, clip.at((10 + 3) / 60, clip="run", loop=True))
    with pytest.raises(anicodec.InputError):
        clip.at(0, blend=("run", 0, 1.5))


def test_threads_share_a_clip(clip):
    expected = [clip.at(f / 50) for f in range(40)]
    with ThreadPoolExecutor(4) as pool:
        for found, wanted in zip(pool.map(lambda f: clip.at(f / 50), range(40)), expected):
            assert np.array_equal(found, wanted)


@pytest.fixture
def page(clip):
    return clip.page()


def test_page_holds_the_clip(clip, page):
    assert base64.b64encode(clip.data).decode() in page and 'data-name="wave.anic"' in page
    assert clip.page(against=clip).count(base64.b64encode(clip.data).decode()) == 2


def test_show_opens_the_browser(clip, page, monkeypatch):
    opened = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    path = clip.show()
    try:
        assert opened == ["file://" + path]
        with open(path, encoding="utf-8") as file:
            assert file.read() == page
    finally:
        os.remove(path)


def test_show_plays_in_a_notebook(clip, page, monkeypatch):
    display = types.SimpleNamespace(HTML=lambda text: text)
    shell = types.SimpleNamespace(get_ipython=lambda: types.SimpleNamespace(kernel=None), display=display)
    monkeypatch.setitem(sys.modules, "IPython", shell)
    monkeypatch.setitem(sys.modules, "IPython.display", display)
    frame = ElementTree.fromstring(clip.show(height=300).replace(' allow="fullscreen"', ""))
    assert frame.get("srcdoc").split() == page.split() and "height: 300px" in frame.get("style")


def test_root_motion_and_events(tmp_path):
    frames, vertices = 20, 30
    rng = np.random.default_rng(3)
    shape = rng.normal(size=(vertices, 3)).astype(np.float32)
    positions = np.stack([shape * [1, 1 + 0.02 * f, 1] + [0.3 * f, 0, -0.1 * f] for f in range(frames)])
    faces = [(v, (v + 1) % vertices, (v + 2) % vertices) for v in range(vertices)]
    data = anicodec.encode(positions, faces, fps=10, up="y", root_motion=True, events=[("step", 0.4), ("end", 1.9)])
    clip, still = anicodec.open(data), anicodec.open(data, in_place=True)
    assert clip.clips[0].events == (("step", 0.4), ("end", 1.9))
    motion = clip.root_motion(1.0)
    step = clip.root_step(0.0, 1.0)
    first = np.vstack([clip.root_motion(0.0).matrix, [0, 0, 0, 1]])
    np.testing.assert_allclose(first @ np.vstack([step.matrix, [0, 0, 0, 1]]), np.vstack([motion.matrix, [0, 0, 0, 1]]), atol=1e-5)
    assert np.allclose(motion.move, (3, 0, -1), atol=1e-3)
    moved = still.at(1.0) @ motion.matrix[:, :3].T + motion.matrix[:, 3]
    assert np.allclose(clip.at(1.0), moved, atol=1e-4)
    assert np.abs(still.at(1.0)[:, 0] - positions[10][:, 0]).max() > 1
    with pytest.raises(anicodec.InputError):
        anicodec.encode(positions, faces, events=[("late", 1000.0)])


def test_frames_that_memory_does_not_hold_are_refused(clip):
    small = anicodec.open(clip.data, max_bytes=10**7)
    assert len(small[:]) == len(small)
    with pytest.raises(anicodec.LimitError, match="frames take"):
        small.frames([0] * (10**7 // (12 * small.vertex_count) + 1))


def test_points_of_the_surface(clip):
    triangle = clip.triangles[40].tolist()
    a, b, c = clip.at(0.31)[triangle]
    normal = np.cross(b - a, c - a)
    frame = clip.surface_frame(triangle, (0.25, 0.25, 0.5), 0.31)
    assert np.allclose(frame.position, (a + b + 2 * c) / 4, atol=1e-5)
    assert np.allclose(frame.normal, normal / np.linalg.norm(normal), atol=1e-5)
    assert np.allclose(frame.tangent, (b - a) / np.linalg.norm(b - a), atol=1e-5)
    assert np.linalg.det(frame.matrix[:, :3]) == pytest.approx(1, abs=1e-5)
    above = frame.position + 0.01 * frame.normal
    hit = clip.intersect_ray(above, -frame.normal, 0.31, side="front")
    assert hit.triangle == 40 and hit.vertices == tuple(triangle) and hit.side == "front"
    assert hit.distance == pytest.approx(0.01, abs=1e-4) and hit.weights == pytest.approx((0.25, 0.25, 0.5), abs=1e-3)
    assert np.allclose(clip.surface_frame(hit.vertices, hit.weights, 0.31).position, frame.position, atol=1e-4)
    assert clip.intersect_ray(above, -frame.normal, 0.31, farthest=0.005) is None
    assert clip.intersect_ray(above, -frame.normal, 0.31, farthest=0.02, side="back") is None
    for wrong in (lambda: clip.surface_frame((0, 1, 144), (1, 0, 0), 0), lambda: clip.surface_frame((0, 1), (1, 0, 0), 0),
                  lambda: clip.surface_frame((0, 1, 2), (np.nan, 0, 0), 0), lambda: clip.intersect_ray(above, (0, 0, 0), 0),
                  lambda: clip.intersect_ray(above, (0, 0, 1), 0, side="left")):
        with pytest.raises(ValueError):
            wrong()
