# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Clips as layers of USD, by the plug-in of bindings/usd."""
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import threading

import numpy as np
import pytest

import anicodec
from anicodec import _usd_plugin

pytest.importorskip("pxr", reason="usd-core is not installed")
if not _usd_plugin.releases():
    pytest.skip("this build has no plug-in for USD", allow_module_level=True)

from pxr import Gf, Sdf, Tf, Usd, UsdGeom, UsdShade, UsdUtils  # noqa: E402

if _usd_plugin.fault(Usd.GetVersion()):
    pytest.skip(_usd_plugin.fault(Usd.GetVersion()), allow_module_level=True)

from anicodec import usd  # noqa: E402

CONFORMANCE = pathlib.Path(__file__).resolve().parents[1] / "conformance"


@pytest.fixture(scope="module")
def sheet(wave, tmp_path_factory):
    """A file with the sheet, which rests nowhere, with texture coordinates and materials, and a guest in frames 4 to 9."""
    positions, faces = wave
    corners = positions[0][faces.ravel(), :2]
    numbers = np.where(np.arange(121) < 3, 0, -1)
    look = anicodec.Material(base_colour=(0.5, 0.25, 1, 1), roughness=0.75)
    meshes = [anicodec.SourceMesh(positions, faces, name="sheet", uv=corners, materials=(["skin"], numbers, [look])),
              anicodec.SourceMesh(positions[4:10], faces, name="guest", runs=[(4, 6)])]
    path = tmp_path_factory.mktemp("usd") / "sheet.anic"
    path.write_bytes(anicodec.encode_meshes(meshes, fps=30, start_time=101 / 30, unit=0.01, up="z", name="shot", order="all", effort="fast"))
    return str(path)


def points(stage, path, code):
    return np.array(UsdGeom.Mesh(stage.GetPrimAtPath(path)).GetPointsAttr().Get(code))


def test_a_clip_is_a_layer(sheet):
    clip = anicodec.open(sheet)
    stage = Usd.Stage.Open(sheet)
    assert (stage.GetStartTimeCode(), stage.GetEndTimeCode(), stage.GetTimeCodesPerSecond()) == (101, 124, 30)
    assert UsdGeom.GetStageMetersPerUnit(stage) == 0.01 and UsdGeom.GetStageUpAxis(stage) == "Z"
    assert stage.GetDefaultPrim().GetPath() == "/shot"
    mesh = UsdGeom.Mesh(stage.GetPrimAtPath("/shot/sheet"))
    assert mesh.GetPointsAttr().GetTimeSamples() == list(range(101, 125))
    assert mesh.GetPointsAttr().GetBracketingTimeSamples(104.5) == (104, 105)
    for frame in (0, 7, 23):
        assert np.array_equal(points(stage, "/shot/sheet", 101 + frame), clip.meshes[0][frame])
        low, high = np.array(mesh.GetExtentAttr().Get(101 + frame))
        assert (low <= clip.meshes[0][frame] + 1e-6).all() and (clip.meshes[0][frame] <= high + 1e-6).all()
        assert np.allclose(mesh.GetNormalsAttr().Get(101 + frame), clip.meshes[0].normals(frame))
    middle = (clip.meshes[0][3] + clip.meshes[0][4]) / 2
    assert np.allclose(points(stage, "/shot/sheet", 104.5), middle, atol=1e-6)
    assert np.array_equal(points(stage, "/shot/sheet", 999), clip.meshes[0][23])
    assert list(mesh.GetFaceVertexIndicesAttr().Get()) == clip.meshes[0].polygons[1].tolist()
    st = UsdGeom.PrimvarsAPI(mesh).GetPrimvar("st")
    assert st.GetInterpolation() == "faceVarying" and np.allclose(st.Get(), clip.meshes[0].attributes[0].values)
    subset = UsdGeom.Subset(stage.GetPrimAtPath("/shot/sheet/skin"))
    assert list(subset.GetIndicesAttr().Get()) == [0, 1, 2]
    material = UsdShade.MaterialBindingAPI(subset.GetPrim()).ComputeBoundMaterial()[0]
    surface = material.ComputeSurfaceSource()[0]
    assert surface.GetInput("diffuseColor").Get() == Gf.Vec3f(0.5, 0.25, 1) and surface.GetInput("roughness").Get() == 0.75
    guest = UsdGeom.Imageable(stage.GetPrimAtPath("/shot/guest"))
    assert [guest.ComputeVisibility(code) for code in (101, 105, 110, 111)] == ["invisible", "inherited", "inherited", "invisible"]
    attribute = UsdGeom.Mesh(guest.GetPrim()).GetPointsAttr()
    assert attribute.GetTimeSamples() == [101, 105, 106, 107, 108, 109, 110, 111] and attribute.Get(102) is None


def test_layers_move_scale_and_stack(sheet, tmp_path):
    clip = anicodec.open(sheet)
    shot = tmp_path / "shot.usda"
    shot.write_text(f"""#usda 1.0
( timeCodesPerSecond = 30
  subLayers = [@{sheet}@ (offset = -100)] )
def Xform "a" ( references = @{sheet}@ (offset = 1000; scale = 2) ) {{
    double3 xformOp:translate = (5, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
def Xform "b" ( payload = @{sheet}@ ) {{ }}
""")
    stage = Usd.Stage.Open(str(shot))
    assert np.array_equal(points(stage, "/a/sheet", 1000 + 2 * 104), clip.meshes[0][3])
    assert UsdGeom.XformCache(0).GetLocalToWorldTransform(stage.GetPrimAtPath("/a/sheet")).ExtractTranslation() == Gf.Vec3d(5, 0, 0)
    assert np.array_equal(points(stage, "/b/sheet", 104), clip.meshes[0][3])
    assert np.array_equal(points(stage, "/shot/sheet", 4), clip.meshes[0][3])
    box = UsdGeom.BBoxCache(104, ["default"]).ComputeWorldBound(stage.GetPrimAtPath("/b")).ComputeAlignedRange()
    assert box.Contains(Gf.Range3d(*(Gf.Vec3d(*corner.tolist()) for corner in (clip.meshes[0][3].min(0) + 1e-5, clip.meshes[0][3].max(0) - 1e-5))))
    assert UsdUtils.CreateNewUsdzPackage(str(shot), str(tmp_path / "shot.usdz"))
    packed = Usd.Stage.Open(str(tmp_path / "shot.usdz"))
    assert np.array_equal(points(packed, "/b/sheet", 104), clip.meshes[0][3])
    stage.Flatten().Export(str(tmp_path / "flat.usdc"))
    assert np.array_equal(points(Usd.Stage.Open(str(tmp_path / "flat.usdc")), "/b/sheet", 104), clip.meshes[0][3])


def test_layers_are_read_only_and_reload(sheet):
    layer = Sdf.Layer.FindOrOpen(sheet)
    assert not layer.GetFileFormat().SupportsWriting() and not layer.GetFileFormat().SupportsEditing()
    assert "def Mesh \"sheet\"" in layer.ExportToString()
    layer.Reload(force=True)
    assert len(layer.ListTimeSamplesForPath("/shot/sheet.points")) == 24
    copy = Sdf.Layer.OpenAsAnonymous(sheet)
    assert len(copy.GetAttributeAtPath("/shot/sheet.points").GetInfo("timeSamples")) == 24


def world(stage, prim, code):
    matrix = np.array(UsdGeom.XformCache(code).GetLocalToWorldTransform(prim))
    return np.array(UsdGeom.Mesh(prim).GetPointsAttr().Get(code), float) @ matrix[:3, :3] + matrix[3, :3]


@pytest.mark.parametrize("name", ["walk", "walk_y_up", "clips", "placed", "exact_moving", "limb_default"])
def test_clips_are_variants_and_the_whole_moves(name):
    path = str(CONFORMANCE / f"{name}.anic")
    clip = anicodec.open(path)
    stage = Usd.Stage.Open(path)
    stage.SetEditTarget(stage.GetSessionLayer())
    root = stage.GetDefaultPrim()
    for number, info in enumerate(clip.clips):
        if len(clip.clips) > 1:
            names = root.GetVariantSet("clip").GetVariantNames()
            assert len(names) == len(clip.clips)
            root.GetVariantSet("clip").SetVariantSelection(Tf.MakeValidIdentifier(info.name))
        prims = [prim for prim in stage.Traverse() if prim.IsA(UsdGeom.Mesh)]
        for prim, mesh in zip(prims, clip.meshes):
            codes = UsdGeom.Mesh(prim).GetPointsAttr().GetTimeSamples()
            there = [frame for frame in range(clip.frame_count)[info.frames] if mesh.shown_in(frame)]
            if not codes:  # it rests
                codes = [Usd.TimeCode.Default()] * len(there)
            assert len(codes) == len(there)
            size = np.abs(mesh[there[0]]).max()
            for code, frame in list(zip(codes, there))[::3]:
                assert np.allclose(world(stage, prim, code), mesh[frame] + np.array(clip.info["origin"]), atol=2e-6 * size)
                extent = UsdGeom.Mesh(prim).GetExtentAttr().Get(code)
                local = np.array(UsdGeom.Mesh(prim).GetPointsAttr().Get(code))
                assert extent is None or (extent[0] <= local + 1e-5 * size).all() and (local - 1e-5 * size <= extent[1]).all()


def test_the_layer_says_what_decode_writes(sheet, tmp_path):
    layer = Usd.Stage.Open(sheet)
    written = usd.decode(sheet, tmp_path / "back.usdc")
    assert layer.GetDefaultPrim().GetPath() == written.GetDefaultPrim().GetPath()
    for prim in written.Traverse():
        other = layer.GetPrimAtPath(prim.GetPath())
        assert other and other.GetTypeName() == prim.GetTypeName(), prim
        for attribute in prim.GetAuthoredAttributes():
            twin = other.GetAttribute(attribute.GetName())
            assert twin.GetTypeName() == attribute.GetTypeName() and twin.GetTimeSamples() == attribute.GetTimeSamples(), attribute
            if attribute.GetName() != "extent":  # the file keeps one for many frames
                for code in attribute.GetTimeSamples() or [Usd.TimeCode.Default()]:
                    assert np.array_equal(np.array(twin.Get(code)), np.array(attribute.Get(code))), attribute


@pytest.mark.parametrize("rate, codes", [(24 / float(np.float32(1.001)), range(1001, 1005)), (24 / float(np.float32(1.001)), [1001, 1001.5, 1002, 1002.9995, 1003, 1005]), (6000, range(0, 1001, 250)), (25, [-2, -1, 0.25, 1])])
def test_codes_are_those_of_the_stage(rate, codes, tmp_path):
    stage = Usd.Stage.CreateInMemory()
    stage.SetTimeCodesPerSecond(rate)
    stage.SetFramesPerSecond(24 if rate == 6000 else rate)
    mesh = UsdGeom.Mesh.Define(stage, "/a")
    mesh.CreateFaceVertexCountsAttr([3])
    mesh.CreateFaceVertexIndicesAttr([0, 1, 2])
    for code in codes:
        mesh.CreatePointsAttr().Set([(0, 0, code), (1, 0, 0), (0, 1, 0)], code)
    path = tmp_path / "a.anic"
    path.write_bytes(usd.encode(stage, lossless=True, effort="fast"))
    layer = Usd.Stage.Open(str(path))
    assert layer.GetTimeCodesPerSecond() == rate
    found = UsdGeom.Mesh(layer.GetPrimAtPath("/a")).GetPointsAttr()
    assert set(codes) <= set(found.GetTimeSamples()) and [found.Get(code)[0][2] for code in codes] == pytest.approx(list(codes))


def test_the_layer_fits_over_its_stage(wave, tmp_path):
    positions, faces = wave
    stage = Usd.Stage.CreateNew(str(tmp_path / "shot.usda"))
    stage.SetStartTimeCode(-3)
    stage.SetEndTimeCode(20)
    UsdGeom.Xform.Define(stage, "/shot/cloth_xf").AddTranslateOp().Set(Gf.Vec3d(0, 7, 0))
    UsdGeom.Camera.Define(stage, "/shot/cloth_xf/eye")
    mesh = UsdGeom.Mesh.Define(stage, "/shot/cloth_xf/cloth")
    mesh.CreateFaceVertexCountsAttr([4] * len(faces))
    mesh.CreateFaceVertexIndicesAttr(faces.ravel().tolist())
    for frame, here in enumerate(positions):
        mesh.CreatePointsAttr().Set(here, frame - 3)
    mesh.AddRotateXOp().Set(90.0)
    stage.Save()
    data = usd.encode(stage, lossless=True, effort="fast")
    (tmp_path / "cloth.anic").write_bytes(data)
    over = Sdf.Layer.FindOrOpen(str(tmp_path / "cloth.anic"), args={"over": "true"})
    written = usd.decode(data, tmp_path / "over.usda", over=True)
    before = world(stage, mesh.GetPrim(), 4)
    for layer in (over, written.GetRootLayer()):
        top = Usd.Stage.CreateInMemory()
        top.GetRootLayer().subLayerPaths = [layer.identifier, stage.GetRootLayer().identifier]
        prim = top.GetPrimAtPath("/shot/cloth_xf/cloth")
        assert np.allclose(world(top, prim, 4), before, atol=1e-6)
        assert UsdGeom.Mesh(prim).GetPointsAttr().GetTimeSamples() == list(range(-3, 21))
        eye = UsdGeom.XformCache(4).GetLocalToWorldTransform(top.GetPrimAtPath("/shot/cloth_xf/eye"))
        assert eye.ExtractTranslation() == Gf.Vec3d(0, 7, 0)


def test_threads_share_a_layer(sheet):
    clip = anicodec.open(sheet)
    stage = Usd.Stage.Open(sheet)
    attribute = UsdGeom.Mesh(stage.GetPrimAtPath("/shot/sheet")).GetPointsAttr()
    wrong = []

    def run(seed):
        numbers = random.Random(seed)
        for _ in range(100):
            frame = numbers.randrange(24)
            if not np.array_equal(np.array(attribute.Get(101 + frame)), clip.meshes[0][frame]):
                wrong.append(frame)

    threads = [threading.Thread(target=run, args=(seed,)) for seed in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def run_python(script, *arguments, **environment):
    result = subprocess.run([sys.executable, "-c", script, *map(str, arguments)], capture_output=True, text=True,
                            env={**os.environ, **environment})
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout + result.stderr


# Opens each file, and asks all attributes for a few samples. A refusal is an exception of a line.
OPEN_ALL = """
import pathlib, sys
from pxr import Sdf, Tf, Usd
opened, refused = 0, 0
for path in sorted(pathlib.Path(sys.argv[1]).rglob("*.anic")):
    try:
        stage = Usd.Stage.Open(str(path))
        opened += 1
    except Tf.ErrorException as error:
        told = str(error).strip().splitlines()
        assert len(told) == 2 and f"{path}: " in told[0], told
        refused += 1
        continue
    for prim in stage.Traverse():
        for attribute in prim.GetAuthoredAttributes():
            codes = attribute.GetTimeSamples()
            for code in codes[:1] + codes[len(codes) // 2:][:1] + codes[-1:]:
                attribute.Get(code)
print(opened, refused)
"""


def test_damaged_files_are_refused_and_the_host_lives():
    told = run_python(OPEN_ALL, CONFORMANCE, PXR_PLUGINPATH_NAME=str(_usd_plugin.folder()))
    opened, refused = map(int, told.split()[-2:])
    assert opened > 40 and refused > 50


def test_the_plug_in_is_found_three_ways(sheet):
    opens = "import sys; from pxr import Usd; print(Usd.Stage.Open(sys.argv[1]).GetDefaultPrim().GetPath())"
    assert run_python("import anicodec.usd\n" + opens, sheet).strip() == "/shot"
    assert run_python(opens, sheet, PXR_PLUGINPATH_NAME=str(_usd_plugin.folder())).strip() == "/shot"
    command = [sys.executable, "-m", "anicodec", "usd-plugin"]
    subprocess.run([*command, "install"], check=True, stdout=subprocess.PIPE)
    try:
        assert run_python(opens, sheet).strip() == "/shot"
        assert run_python("import anicodec.usd\n" + opens, sheet).strip() == "/shot"
    finally:
        subprocess.run([*command, "remove"], check=True)
    told = subprocess.run([*command, "path"], check=True, stdout=subprocess.PIPE, text=True).stdout
    assert told.strip() == str(_usd_plugin.folder())
    late = "from pxr import Usd; Usd.Stage.CreateInMemory(); import anicodec.usd"
    assert "a stage was opened before anicodec.usd was imported" in run_python(late)


def test_other_releases_are_named():
    assert re.search(r"built for usd-core .*26\.8.*, not 25\.5", _usd_plugin.fault((0, 25, 5)))


@pytest.mark.skipif(not shutil.which("nm"), reason="binutils are not installed")
def test_one_plug_in_serves_all_pythons():
    stable = {"PyBool_FromLong", "PyFloat_FromDouble", "PyLong_FromLong", "PyUnicode_FromStringAndSize", "_Py_Dealloc"}
    for library in _usd_plugin.folder().glob("anicodec_usd_*.so"):
        told = subprocess.run(["nm", "-D", "-u", library], check=True, stdout=subprocess.PIPE, text=True).stdout
        assert set(re.findall(r" U (_?Py\w+)", told)) <= stable
