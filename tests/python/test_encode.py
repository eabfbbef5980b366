# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Encoding from arrays."""
import pathlib
import re
import struct
import subprocess
import sys
import threading

import numpy as np
import pytest

import anicodec
import anicodec.metrics
from anicodec import encoder


def read_pc2(path):
    data = path.read_bytes()
    vertices, frames = struct.unpack_from("<i", data, 16)[0], struct.unpack_from("<i", data, 28)[0]
    return np.frombuffer(data, "<f4", offset=32).reshape(frames, vertices, 3)


def read_faces(path):
    lines = (line.split()[1:] for line in path.read_text().splitlines() if line.startswith("f "))
    return [[int(corner.split("/")[0]) - 1 for corner in line] for line in lines]


@pytest.mark.parametrize("target", [("max_error", "0.1%"), ("kg", 0.5), ("size", "9k"), ("rmse", 0.01)])
def test_same_bytes_as_the_command(tmp_path, command, target):
    command("corpus", "limb", "-q", "--vertices", 300, "--frame-count", 20, "-o", tmp_path / "limb.pc2")
    name, value = target
    command("encode", "-q", "limb.obj", "limb.pc2", "-o", "limb.anic", "--fps", 25, "--no-attributes", "--effort", "normal",
            "--" + name.replace("_", "-"), value, cwd=tmp_path)
    data = anicodec.encode(read_pc2(tmp_path / "limb.pc2"), read_faces(tmp_path / "limb.obj"), name="limb", fps=25,
                           effort="normal", no_attributes=True, up=anicodec.open(tmp_path / "limb.anic").info["up"],
                           **{name: value})
    assert data == (tmp_path / "limb.anic").read_bytes()


def test_targets_of_motion(wave):
    for options, bound in (({"displacement": "0.1%"}, None), ({"sted": 0.05}, 0.05), ({"quality": "better"}, 0.02)):
        data = anicodec.encode(*wave, effort="fast", **options)
        clip = anicodec.open(data)
        measured = anicodec.metrics.compare(wave[0], clip, wave[1])
        assert measured["max_displacement_error"] == pytest.approx(data.measured["max_displacement_error"], rel=1e-4)
        assert clip.clips[0].max_displacement_error == data.measured["max_displacement_error"]
        if bound is None:
            assert data.measured["max_displacement_error"] <= 0.001 * data.measured["diagonal"]
        else:
            assert measured["sted"] <= bound * (1 + 1e-6)
    with pytest.raises(anicodec.InputError, match="two targets"):
        anicodec.encode(*wave, quality="good", sted=0.1)


def test_every_kind_of_array_gives_the_same_bytes(wave):
    positions, faces = wave
    expected = anicodec.encode(positions, faces, effort="fast")
    wide = np.zeros((2 * len(positions), positions.shape[1], 5))
    wide[::2, :, 1:4] = positions
    forms = [positions.astype(np.float64), positions.astype(">f4"), positions.astype(">f8"), wide[::2, :, 1:4],
             np.asfortranarray(positions), positions[::-1][::-1], positions.tolist()]
    for form in forms:
        assert anicodec.encode(form, faces, effort="fast") == expected
    frozen = positions.copy()
    frozen.flags.writeable = False
    for same in (faces.astype(np.int64), faces.tolist(), [list(face) for face in faces], faces.astype(">u2"),
                 (np.arange(0, faces.size + 1, 4), faces.ravel())):
        assert anicodec.encode(frozen, same, effort="fast", threads=1) == expected


def test_frames_by_a_function(wave):
    positions, faces = wave
    asked = []

    def frame(number):
        asked.append(number)
        return positions[number].astype(np.float64)

    data = anicodec.encode(frame, faces, vertex_count=positions.shape[1], frame_count=len(positions), effort="fast")
    assert data == anicodec.encode(positions, faces, effort="fast")
    assert asked == list(range(len(positions)))
    with pytest.raises(ZeroDivisionError):
        anicodec.encode(lambda number: 1 / 0, None, vertex_count=9, frame_count=2)
    with pytest.raises(anicodec.InputError, match="frame 0: positions must be 9 x 3, not 4 x 3"):
        anicodec.encode(lambda number: positions[0, :4], None, vertex_count=9, frame_count=2)


def test_attributes_and_labels_come_back(wave):
    positions, faces = wave
    uv = positions[0, :, :2]
    colours = np.broadcast_to(uv[None, :, :1], (len(positions), len(uv), 3))
    materials = (["skin", "cloth"], np.arange(len(faces)) % 3 - 1)
    data = anicodec.encode(positions, faces, uv=uv, colours={"tint": colours}, materials=materials, order="all",
                           custom={"heat": positions[0, :, :1]}, effort="fast")
    by_kind = {attribute.kind: attribute for attribute in anicodec.open(data).attributes}
    assert np.abs(by_kind["uv"].values - uv).max() < 2**-12
    assert by_kind["colour"].name == "tint" and not by_kind["colour"].moves
    assert by_kind["custom"].name == "heat" and by_kind["custom"].values.shape == (len(uv), 1)
    assert by_kind["material"].labels == ("skin", "cloth")
    assert np.array_equal(by_kind["material"].values, np.arange(len(faces)) % 3)
    corners = np.random.default_rng(1).random((faces.size, 2))
    found = anicodec.open(anicodec.encode(positions, faces, uv=corners, order="all", effort="fast")).attributes[0]
    assert found.domain == "corners" and np.abs(found.values - corners).max() < 2**-12


def test_several_meshes(wave):
    positions, faces = wave
    guest = anicodec.SourceMesh(positions[:6] + 2, faces, name="guest", runs=[(3, 4), (10, 2)])
    data = anicodec.encode_meshes([anicodec.SourceMesh(positions, faces, name="host"), guest], fps="30000/1001")
    clip = anicodec.open(data)
    assert [mesh.name for mesh in clip.meshes] == ["host", "guest"]
    assert clip.fps.numerator == 30000 and clip.fps.denominator == 1001
    assert [f for f in range(24) if clip.meshes[1].shown_in(f)] == [3, 4, 5, 6, 10, 11]
    assert np.abs(clip.meshes[1][10] - positions[4] - 2).max() < 0.01
    with pytest.raises(anicodec.AbsentError):
        clip.meshes[1][0]
    with pytest.raises(anicodec.InputError, match="2 meshes"):
        clip[0]
    with pytest.raises(anicodec.InputError, match="shared out"):
        anicodec.encode_meshes([guest, guest], frame_count=24, size=4000)


def test_several_clips(tmp_path, command, wave):
    command("corpus", "limb", "-q", "--vertices", 300, "--frame-count", 30, "-o", tmp_path / "limb.pc2")
    positions, faces = read_pc2(tmp_path / "limb.pc2"), read_faces(tmp_path / "limb.obj")
    head = (tmp_path / "limb.pc2").read_bytes()[:28]
    for name, frames in (("walk", positions[:18]), ("run", positions[18:])):
        (tmp_path / f"{name}.pc2").write_bytes(head + struct.pack("<i", len(frames)) + frames.tobytes())
    command("encode", "-q", "limb.obj", "walk.pc2", "run.pc2", "-o", "limb.anic", "--fps", 25, "--no-attributes",
            "--effort", "normal", cwd=tmp_path)
    clips = [anicodec.SourceClip("walk", 18), anicodec.SourceClip("run", 12)]
    same = anicodec.encode(positions, faces, clips=clips, fps=25, effort="normal", no_attributes=True,
                           up=anicodec.open(tmp_path / "limb.anic").info["up"])
    assert same == (tmp_path / "limb.anic").read_bytes()

    positions, faces = wave
    clips = [anicodec.SourceClip("walk", 14, loop=True), anicodec.SourceClip("run", 10, fps=60, start_time=2)]
    walk, run = anicodec.open(anicodec.encode(positions, faces, clips=clips, fps=25, effort="fast")).clips
    assert (walk.name, walk.frame_count, walk.fps, walk.loop, walk.start_time) == ("walk", 14, 25, True, 0)
    assert (run.name, run.first_frame, run.fps, run.loop, run.start_time) == ("run", 14, 60, False, 2)
    assert run.duration == pytest.approx(9 / 60) and run.max_error > 0

    def refused(text, *clips, **options):
        with pytest.raises(anicodec.InputError, match=text):
            anicodec.encode(positions, faces, clips=clips, **options)

    refused("clips have 14 frames, the positions 24", clips[0])
    refused("'still' has no frame", anicodec.SourceClip("still", 0), anicodec.SourceClip("all", 24))
    refused("two clips have the name 'a'", anicodec.SourceClip("a", 14), anicodec.SourceClip("a", 10))
    refused("those of each clip", *clips, name="all")
    refused("times must be 14 seconds, not 2", anicodec.SourceClip("a", 14, times=[0, 1]), anicodec.SourceClip("b", 10))


def test_looks_of_materials(wave):
    positions, faces = wave
    glass = anicodec.Material(base_colour=(0.25, 0.5, 1, 0.5), metallic=0.5, roughness=0.25, emissive=(0, 1, 2),
                              alpha="mask", alpha_cutoff=0.75, double_sided=True, normal_texture="bumps.png")
    names, numbers = ["glass", "unknown"], np.arange(len(faces)) % 2
    data = anicodec.encode(positions, faces, materials=(names, numbers, [glass, None]), effort="fast")
    material, = (attribute for attribute in anicodec.open(data).attributes if attribute.kind == "material")
    assert material.labels == ("glass", "unknown") and material.looks == (glass, None)
    for looks, text in (([glass], "1 looks of 2 materials"), ([glass._replace(alpha="some"), None], "not 'some'"),
                        ([glass._replace(metallic=float("nan")), None], "not finite"),
                        ([glass._replace(base_colour=(1, 1)), None], "4 numbers")):
        with pytest.raises(anicodec.InputError, match=text):
            anicodec.encode(positions, faces, materials=(names, numbers, looks))


def test_progress_and_cancelling(wave):
    seen = []
    anicodec.encode(*wave, effort="fast", progress=lambda stage, done: seen.append((stage, done)))
    assert {stage for stage, _ in seen} == {"reading", "encoding"}
    assert all(0 <= done <= 1 for _, done in seen)
    with pytest.raises(anicodec.Cancelled):
        anicodec.encode(*wave, progress=lambda stage, done: stage == "reading")

    def fail(stage, done):
        raise KeyError(stage)

    with pytest.raises(KeyError, match="reading"):
        anicodec.encode(*wave, progress=fail)


def test_other_threads_run_while_it_encodes(wave):
    worker = threading.Thread(target=anicodec.encode, args=wave, kwargs={"effort": "best"})
    worker.start()
    turns = 0
    while worker.is_alive():
        turns += 1
    assert turns > 1000


NAN = np.full((3, 4, 3), 0.5)
NAN[2, 1, 0] = np.nan
HUGE = np.full((1, 1, 3), 1e300)
GOOD = np.random.default_rng(2).random((3, 4, 3))


@pytest.mark.parametrize("positions, faces, options, text", [
    (GOOD[0], None, {}, "frames x vertices x 3, not 4 x 3"),
    (GOOD[:, :, :2], None, {}, "frames x vertices x 3, not 3 x 4 x 2"),
    (GOOD[:0], None, {}, "no frame"),
    (GOOD[:, :0], None, {}, "no vertex"),
    (GOOD.astype(complex), None, {}, "must be numbers, not complex128"),
    (np.full((1, 1, 3), "x"), None, {}, "must be numbers"),
    (NAN, None, {}, "frame 2, vertex 1: the position is not finite"),
    (HUGE, None, {}, "frame 0, vertex 0: the position is not finite"),
    (GOOD, [(0, 1, 4)], {}, "face 0 uses vertex 4 of 4"),
    (GOOD, [(0, 1, -1)], {}, "-1 is out of range"),
    (GOOD, np.array([[0.5, 1, 2]]), {}, "must be integers, not float64"),
    (GOOD, np.array([0, 1, 2]), {}, "polygons x corners, not 3"),
    (GOOD, None, {"max_error": 0}, "greater than 0"),
    (GOOD, None, {"max_error": "a lot"}, "'0.05%', not 'a lot'"),
    (GOOD, None, {"kg": 1, "size": 2}, "two targets"),
    (GOOD, None, {"kg": float("nan")}, "greater than 0"),
    (GOOD, None, {"size": "4x"}, "'40k', not '4x'"),
    (GOOD, None, {"effort": 10}, "not 10"),
    (GOOD, None, {"basis": "magic"}, "not 'magic'"),
    (GOOD, None, {"keyframes": 4}, "than the clip has frames"),
    (GOOD, None, {"fps": 0}, "fps must be greater than 0"),
    (GOOD, None, {"fps": "fast"}, "fps must be a number or a text as '30000/1001', not 'fast'"),
    (GOOD, None, {"fps": [24]}, "fps must be a number"),
    (GOOD, None, {"unit": "parsec"}, "not 'parsec'"),
    (GOOD, None, {"up": "x"}, "not 'x'"),
    (GOOD, None, {"uv": GOOD[0]}, "uv must be 4 vertices, 0 corners or 0 polygons x 2, not 4 x 3"),
    (GOOD, None, {"times": [0, 2, 1]}, "ascend"),
    (GOOD, [(0, 1, 2)], {"materials": (["a"], [1])}, "label 2 of 1"),
])
def test_bad_input_is_named(positions, faces, options, text):
    with pytest.raises(ValueError) as caught:
        anicodec.encode(positions, faces, **options)
    assert isinstance(caught.value, anicodec.InputError)
    assert text in str(caught.value)


def test_limits_and_types():
    with pytest.raises(MemoryError):
        anicodec.encode(GOOD, max_bytes=100)
    for wrong, text in (("sise", "no option 'sise'; did you mean size"), ("nothing", "no option 'nothing'$"),
                        ("selection", "did you mean keyframe_selection"), ("normal_error", "no option")):
        with pytest.raises(TypeError, match=text):
            anicodec.encode(GOOD, **{wrong: 3})


def test_fields_have_bounds_of_their_own():
    frames, vertices = np.mgrid[0:12, 0:GOOD.shape[1]]
    heat = 300 + 50 * np.sin(0.3 * frames + 0.2 * vertices)
    phase = (heat > 320).astype(np.int32)
    clip = anicodec.Clip(anicodec.encode(
        np.repeat(GOOD[:1], 12, 0), custom={"heat": heat[..., None], "phase": phase[..., None], "other": heat[..., None]},
        field_errors={"heat": 0.5}, field_units={"heat": "K"}, fields=["heat", "phase"], effort="fast"))
    first, second = clip.attributes
    assert (first.name, first.unit, first.whole) == ("heat", "K", False)
    assert (second.name, second.unit, second.whole) == ("phase", "", True)
    for f in range(12):
        assert np.abs(clip.attribute_at(0, f / 24)[:, 0] - heat[f]).max() <= 0.5
        assert np.array_equal(clip.attribute_at(1, f / 24)[:, 0], phase[f])
    assert clip.field("heat") == {"unit": "K"} and clip.field("nothing") == {}


def test_fields_that_make_no_sense_are_refused():
    values = np.zeros((*GOOD.shape[:2], 1))
    for options, text in (({"field_errors": {"cold": 1}}, "there is no attribute 'cold', but heat"),
                          ({"field_errors": {"heat": "-1%"}}, "must be greater than 0"),
                          ({"field_errors": {"heat": "some"}}, "the error of heat must be a number or a text"),
                          ({"fields": ["cold"]}, "fields: there is no attribute 'cold'"),
                          ({"fields": "heat"}, "names in a list"),
                          ({"field_units": {"cold": "K"}}, "field_units")):
        with pytest.raises(anicodec.InputError, match=text):
            anicodec.encode(GOOD, custom={"heat": values}, **options)
    values[2, 1] = np.nan
    with pytest.raises(anicodec.InputError, match="heat: frame 2, vertex 1: the value is not finite"):
        anicodec.encode(GOOD, custom={"heat": values})


def test_options_are_those_of_the_command(command):
    """Words and values; those for arrays and files apart."""
    arrays = {"positions", "faces", "uv", "colours", "normals", "custom", "materials", "parts", "vertex_count", "frame_count",
              "times", "start_time", "clips", "progress", "meshes", "options"}
    others = {"metadata": "meta", "events": "event", "max_bytes": "memory", "field_errors": "field-error",
              "field_units": "field-unit"}
    text = command("encode", "--help")
    values = dict(re.findall(r"^  --([a-z-]+) ([a-z0-9|]+)\s", text, re.M))
    for name in encoder.option_names():
        if name not in arrays:
            assert re.search(rf"  (-\w,)?--{others.get(name, name).replace('_', '-')}\b", text), name
    for name, (_, words) in encoder.CHOICES.items():
        assert set(values[name.replace("_", "-")].split("|")) == set(words), name


def test_the_page_runs(tmp_path):
    page = pathlib.Path(__file__).parents[2] / "bindings" / "python" / "README.md"
    script = "".join(part.partition("```")[0] for part in page.read_text(encoding="utf-8").split("```python\n")[1:])
    result = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, capture_output=True, text=True)
    assert result.returncode == 0 and result.stderr == "", result.stderr
    assert result.stdout.startswith("<anicodec.Clip: 100 vertices, 60 frames at 30 per second, ")


def test_a_script_ends_silently(tmp_path):
    script = """
import anicodec
import anicodec.metrics
from anicodec import encoder
import numpy as np
positions = np.random.default_rng(0).random((4, 5, 3))
open("a.anic", "wb").write(anicodec.encode(positions, [(0, 1, 2)]))
print(anicodec.open("a.anic"))
"""
    result = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, capture_output=True, text=True)
    assert result.returncode == 0 and result.stderr == "", result.stderr
    assert result.stdout.startswith("<anicodec.Clip: 5 vertices, 4 frames at 24 per second, ")


def test_broadcast_arrays_are_refused_before_they_are_converted():
    faces = np.broadcast_to(np.arange(3), (2**31 - 1, 3))
    with pytest.raises(anicodec.LimitError, match="faces take"):
        anicodec.encode(GOOD, faces, max_bytes=10**9)
    with pytest.raises(anicodec.InputError, match="too many corners"):
        anicodec.encode(GOOD, faces)
    with pytest.raises(anicodec.LimitError, match="positions take"):
        anicodec.encode(np.broadcast_to(np.int8(1), (2**20, 2**20, 3)), max_bytes=10**9)
    with pytest.raises(anicodec.LimitError, match="uv take"):
        anicodec.encode(GOOD, uv=np.broadcast_to(np.int8(1), (2**30, 2)), max_bytes=10**9)


@pytest.mark.parametrize("threads", [1, 2, 4])
def test_no_coordinates_end_the_interpreter(threads):
    corners = np.array([[0, 0, 0], [1e20, 0, 0], [0, 1e20, 3]], np.float32)
    for scale in (1, 1e18, np.nan, np.inf):
        for _ in range(25):
            with pytest.raises(anicodec.InputError):
                anicodec.encode(corners[None] * np.float32(scale), [[0, 1, 2]], threads=threads)


def test_positions_count_from_an_origin_where_they_are_far_from_zero(wave):
    positions, faces = wave
    place = np.array([500000, 4649776, 120])
    far = positions.astype(np.float64) + place
    data = anicodec.encode(far, faces, effort="fast")
    clip = anicodec.open(data)
    origin = np.array(clip.info["origin"])
    assert np.abs(origin - place).max() < 2 * clip.info["diagonal"]
    assert np.linalg.norm(clip[3] + origin - far[3], axis=1).max() <= clip.info["max_error"] * 1.01 + 1e-6
    assert anicodec.open(anicodec.encode(far, faces, effort="fast", origin=(500000, 4649776, 100))).info["origin"] == (500000, 4649776, 100)
    assert anicodec.open(anicodec.encode(positions, faces, effort="fast")).info["origin"] == (0, 0, 0)
    with pytest.raises(anicodec.InputError, match="the maximum error is below what float32 keeps"):
        anicodec.encode(far, faces, effort="fast", origin="none")
    for origin in ("here", (1, 2), 5):
        with pytest.raises(anicodec.InputError, match="origin is"):
            anicodec.encode(far, faces, origin=origin)
