# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Stages of USD."""
import json
import subprocess
import sys

import anic_file
import numpy as np
import pytest

import anicodec

pytest.importorskip("pxr", reason="usd-core is not installed")

from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade, UsdSkel, Vt  # noqa: E402

from anicodec import usd  # noqa: E402


@pytest.fixture
def stage(wave):
    """The sheet, below a transform that moves, with texture coordinates and two subsets; and a guest that comes and
    goes."""
    positions, faces = wave
    stage = Usd.Stage.CreateInMemory("shot.usda")
    stage.SetTimeCodesPerSecond(30)
    stage.SetStartTimeCode(101)
    stage.SetEndTimeCode(124)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    group = UsdGeom.Xform.Define(stage, "/group")
    move = group.AddTranslateOp()
    for name in ("sheet", "guest"):
        mesh = UsdGeom.Mesh.Define(stage, f"/group/{name}")
        mesh.CreateFaceVertexCountsAttr([4] * len(faces))
        mesh.CreateFaceVertexIndicesAttr(faces.ravel().tolist())
        for frame, points in enumerate(positions):
            mesh.CreatePointsAttr().Set(Vt.Vec3fArray.FromNumpy(points), 101 + frame)
            move.Set(Gf.Vec3d(frame / 10, 0, 1), 101 + frame)
    sheet = UsdGeom.Mesh(stage.GetPrimAtPath("/group/sheet"))
    st = UsdGeom.PrimvarsAPI(sheet).CreatePrimvar("st", Sdf.ValueTypeNames.TexCoord2fArray, UsdGeom.Tokens.faceVarying)
    st.Set(Vt.Vec2fArray.FromNumpy(np.ascontiguousarray(positions[0][faces.ravel(), :2])))
    UsdGeom.Subset.CreateGeomSubset(sheet, "skin", UsdGeom.Tokens.face, [0, 1, 2], "materialBind")
    guest = UsdGeom.Imageable(stage.GetPrimAtPath("/group/guest")).CreateVisibilityAttr()
    for code, token in ((101, "invisible"), (105, "inherited"), (111, "invisible")):
        guest.Set(token, code)
    return stage


def test_a_stage_becomes_a_clip(wave, stage):
    positions, _ = wave
    data = usd.encode(stage, "/group/sheet", order="all", effort="fast")
    clip = anicodec.open(data)
    assert clip.fps == 30 and clip.frame_count == 24 and clip.info["up"] == "z"
    assert clip.info["metres_per_unit"] == pytest.approx(0.01) and clip.info["start_time"] == pytest.approx(101 / 30)
    for frame in (0, 11, 23):
        moved = positions[frame] + np.float32([frame / 10, 0, 1])
        assert np.linalg.norm(clip[frame] - moved, axis=1).max() <= clip.info["max_error"] * 1.01 + 1e-6
    kinds = {attribute.kind: attribute for attribute in clip.attributes}
    assert kinds["uv"].name == "st" and kinds["uv"].domain == "corners"
    assert kinds["material"].labels == ("skin",) and (kinds["material"].values[:4] == [1, 1, 1, 0]).all()


def test_meshes_come_and_go_and_are_written_back(stage, tmp_path):
    clip = anicodec.open(usd.encode(stage, effort="fast", order="all"))
    named = {mesh.name: mesh for mesh in clip.meshes}
    assert [f for f in range(24) if named["guest"].shown_in(f)] == [4, 5, 6, 7, 8, 9]
    path = tmp_path / "back.usdc"
    usd.decode(clip, path)
    back = Usd.Stage.Open(str(path))
    assert (back.GetStartTimeCode(), back.GetEndTimeCode()) == (101, 124)
    assert back.GetTimeCodesPerSecond() == 30 and UsdGeom.GetStageUpAxis(back) == "Z"
    sheet = UsdGeom.Mesh(back.GetPrimAtPath("/group/sheet"))
    assert np.array_equal(np.array(sheet.GetPointsAttr().Get(108)), named["sheet"][7])
    assert len(sheet.GetFaceVertexCountsAttr().Get()) == 121
    assert UsdGeom.PrimvarsAPI(sheet).GetPrimvar("st").GetInterpolation() == "faceVarying"
    assert list(UsdGeom.Subset(back.GetPrimAtPath("/group/sheet/skin")).GetIndicesAttr().Get()) == [0, 1, 2]
    guest = UsdGeom.Imageable(back.GetPrimAtPath("/group/guest"))
    assert [guest.ComputeVisibility(code) for code in (101, 105, 111)] == ["invisible", "inherited", "invisible"]
    again = anicodec.open(usd.encode(str(path), effort="fast"))
    assert {mesh.name for mesh in again.meshes} == {"sheet", "guest"} and again.frame_count == 24


def test_left_handed_faces_are_turned(wave, stage):
    UsdGeom.Mesh(stage.GetPrimAtPath("/group/sheet")).CreateOrientationAttr("leftHanded")
    clip = anicodec.open(usd.encode(stage, "/group/sheet", order="all", effort="fast"))
    assert np.array_equal(clip.faces, wave[1][:, ::-1])
    uv = next(attribute for attribute in clip.attributes if attribute.kind == "uv")
    assert np.allclose(uv.values, wave[0][0][clip.faces.ravel(), :2], atol=2**-11)


def signed_volumes(clip):
    """Volumes of all meshes together, frame by frame: positive where faces point outwards. Meshes that are absent have
    none."""
    volumes = np.zeros(clip.frame_count)
    for mesh in clip.meshes:
        for frame in (frame for frame in range(clip.frame_count) if mesh.shown_in(frame)):
            a, b, c = np.moveaxis(mesh[frame].astype(np.float64)[mesh.faces], 1, 0)
            volumes[frame] += np.einsum("ij,ij->", a, np.cross(b, c)) / 6
    return volumes


def test_transforms_that_mirror_turn_faces():
    stage = Usd.Stage.CreateInMemory()
    stage.SetStartTimeCode(1)
    stage.SetEndTimeCode(4)
    parent = UsdGeom.Xform.Define(stage, "/parent")
    mesh = UsdGeom.Mesh.Define(stage, "/parent/tetrahedron")
    mesh.CreatePointsAttr([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])
    mesh.CreateFaceVertexCountsAttr([3] * 4)
    mesh.CreateFaceVertexIndicesAttr([0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3])
    uv = UsdGeom.PrimvarsAPI(mesh).CreatePrimvar("st", Sdf.ValueTypeNames.TexCoord2fArray, UsdGeom.Tokens.faceVarying)
    corners = np.array(mesh.GetFaceVertexIndicesAttr().Get())
    uv.Set([(float(corner), 0.0) for corner in corners])
    scale = parent.AddScaleOp()
    for factors, meshes in (((1, 1, 1), 1), ((-1, 1, 1), 1), ((-1, -1, 1), 1)):
        scale.Set(Gf.Vec3f(*factors))
        clip = anicodec.open(usd.encode(stage, max_error=1e-5))
        assert np.allclose(signed_volumes(clip), 1 / 6, atol=1e-3) and len(clip.meshes) == meshes, factors
        values = next(attribute for attribute in clip.attributes if attribute.kind == "uv").values
        place = clip[0] * factors  # vertex 1 is at x, 2 at y, 3 at z
        assert np.allclose(values[:, 0], (place @ [1, 2, 3])[clip.faces.ravel()], atol=1e-3), factors
    for code, x in ((1, 1), (2, -1), (3, -1), (4, 1)):
        scale.Set(Gf.Vec3f(x, 1, 1), code)
    clip = anicodec.open(usd.encode(stage, max_error=1e-5))
    assert len(clip.meshes) == 2 and np.allclose(signed_volumes(clip), 1 / 6, atol=1e-3)
    mesh.CreateOrientationAttr("leftHanded")
    assert np.allclose(signed_volumes(anicodec.open(usd.encode(stage, max_error=1e-5))), -1 / 6, atol=1e-3)


def test_faces_that_are_holes_are_left_out(wave, stage):
    mesh = UsdGeom.Mesh(stage.GetPrimAtPath("/group/sheet"))
    mesh.CreateHoleIndicesAttr([1, 7])
    clip = anicodec.open(usd.encode(stage, "/group/sheet", order="all", effort="fast"))
    kept = np.delete(np.arange(121), [1, 7])
    assert np.array_equal(clip.polygons[1].reshape(-1, 4), wave[1][kept])
    kinds = {attribute.kind: attribute for attribute in clip.attributes}
    assert np.allclose(kinds["uv"].values, wave[0][0][clip.polygons[1], :2], atol=2**-11)
    assert (kinds["material"].values[:3] == [1, 1, 0]).all()


def add_skin(stage):
    """A strip whose upper half turns about the x axis."""
    root = UsdSkel.Root.Define(stage, "/skin")
    skeleton = UsdSkel.Skeleton.Define(stage, "/skin/bones")
    skeleton.CreateJointsAttr(["low", "low/high"])
    rest = [Gf.Matrix4d(1), Gf.Matrix4d(1).SetTranslate(Gf.Vec3d(0, 1, 0))]
    skeleton.CreateBindTransformsAttr(rest)
    skeleton.CreateRestTransformsAttr(rest)
    motion = UsdSkel.Animation.Define(stage, "/skin/motion")
    motion.CreateJointsAttr(["low", "low/high"])
    motion.CreateTranslationsAttr([Gf.Vec3f(0, 0, 0), Gf.Vec3f(0, 1, 0)])
    motion.CreateScalesAttr([Gf.Vec3h(1, 1, 1)] * 2)
    for code, angle in ((1, 0), (9, 90)):
        turn = Gf.Quatf(Gf.Rotation(Gf.Vec3d(1, 0, 0), angle).GetQuat())
        motion.CreateRotationsAttr().Set([Gf.Quatf(1), turn], code)
    UsdSkel.BindingAPI.Apply(root.GetPrim()).CreateSkeletonRel().SetTargets([skeleton.GetPath()])
    UsdSkel.BindingAPI.Apply(skeleton.GetPrim()).CreateAnimationSourceRel().SetTargets([motion.GetPath()])
    mesh = UsdGeom.Mesh.Define(stage, "/skin/strip")
    mesh.CreatePointsAttr([(x, y, 0) for y in (0, 1, 2) for x in (0, 1)])
    mesh.CreateFaceVertexCountsAttr([4, 4])
    mesh.CreateFaceVertexIndicesAttr([0, 1, 3, 2, 2, 3, 5, 4])
    binding = UsdSkel.BindingAPI.Apply(mesh.GetPrim())
    binding.CreateJointIndicesPrimvar(False, 1).Set([0, 0, 0, 0, 1, 1])
    binding.CreateJointWeightsPrimvar(False, 1).Set([1.0] * 6)


def test_skins_are_baked():
    stage = Usd.Stage.CreateInMemory()
    stage.SetStartTimeCode(1)
    stage.SetEndTimeCode(9)
    stage.SetTimeCodesPerSecond(30)
    stage.SetFramesPerSecond(24)  # as stages have that name none; baking has samples at these, which are no frames
    add_skin(stage)
    clip = anicodec.open(usd.encode(stage, max_error=0.001))
    assert clip.frame_count == 9 and clip.fps == 30
    assert np.allclose(clip[0][5], [1, 2, 0], atol=0.002)
    assert np.allclose(clip[8][5], [1, 1, 1], atol=0.002)
    assert np.allclose(clip[4][5], [1, 1 + np.sqrt(0.5), np.sqrt(0.5)], atol=0.01)
    hide = UsdGeom.Xformable(stage.GetPrimAtPath("/skin")).AddScaleOp()
    for code, size in ((1, 0), (2, 1)):
        hide.Set(Gf.Vec3f(size), code)
    clip = anicodec.open(usd.encode(stage, max_error=0.001))
    assert np.allclose(clip[0], 0, atol=0.002) and np.allclose(clip[8][5], [1, 1, 1], atol=0.002)


def test_faults_name_the_prim(stage, tmp_path):
    with pytest.raises(anicodec.InputError, match="no prim /group/none"):
        usd.encode(stage, "/group/none")
    mesh = UsdGeom.Mesh(stage.GetPrimAtPath("/group/sheet"))
    mesh.GetFaceVertexCountsAttr().Set([4] * 120, 110)
    with pytest.raises(anicodec.InputError, match="/group/sheet: faceVertexCounts do not fit"):
        usd.encode(stage)
    mesh.GetFaceVertexIndicesAttr().Set([0, 1, 13, 12] * 120, 110)
    mesh.GetFaceVertexCountsAttr().Set([4] * 119, 101)
    mesh.GetFaceVertexIndicesAttr().Set([0, 1, 13, 12] * 119, 101)
    with pytest.raises(anicodec.InputError, match="/group/sheet: the faces change at time code"):
        usd.encode(stage, "/group/sheet")
    assert len(anicodec.open(usd.encode(stage, "/group/sheet", topology_changes="keep", effort="fast")).meshes) == 2
    with pytest.raises(FileNotFoundError):
        usd.encode(tmp_path / "none.usda")
    (tmp_path / "bad.usda").write_text("no stage")
    with pytest.raises(anicodec.InputError, match="bad.usda"):
        usd.encode(tmp_path / "bad.usda")


def test_the_command_says_what_is_missing(tmp_path):
    script = "import sys; sys.modules['pxr'] = None; sys.argv = ['anicodec', 'encode', 'shot.usd', '-o', 'x.anic']; " \
             "from anicodec.__main__ import main; main()"
    result = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, capture_output=True, text=True)
    assert result.returncode == 4 and "pip install 'anicodec[usd]'" in result.stderr, result.stderr


def run_command(*arguments):
    return subprocess.run([sys.executable, "-m", "anicodec", *map(str, arguments)], capture_output=True, text=True)


def test_the_command_reads_and_writes_stages(stage, tmp_path):
    UsdGeom.Camera.Define(stage, "/eye")
    stage.Export(str(tmp_path / "shot.usda"))
    encode = ("encode", tmp_path / "shot.usda", "-o", tmp_path / "clips" / "shot.anic", "--effort", "fast")
    told = run_command(*encode, "-v", "--meta", "author=me", "--event", "jump=0.5")
    assert told.returncode == 0 and " : 1, " in told.stdout and "24 frames at 30 fps (source)" in told.stdout, told.stderr
    assert "not kept: 1 Camera" in told.stderr and len(told.stderr.splitlines()) > 2
    clip = anicodec.open(tmp_path / "clips" / "shot.anic")
    assert len(clip.meshes) == 2 and clip.metadata["author"] == "me" and clip.clips[0].events == (("jump", 0.5),)
    again = run_command(*encode)
    assert again.returncode == 1 and "exists" in again.stderr
    report = json.loads(run_command(*encode, "-f", "--json").stdout)
    assert (report["frames"], report["vertices"], report["fps_from"]) == (24, 288, "source") and "1 Camera" in report["notes"][0]
    for suffix in ("usda", "usdc", "usdz"):
        output = tmp_path / "back" / f"shot.{suffix}"
        told = run_command("decode", tmp_path / "clips" / "shot.anic", "-o", output)
        assert told.returncode == 0 and "24 frames of 2 meshes" in told.stdout, told.stderr
        back = Usd.Stage.Open(str(output))
        assert np.array_equal(np.array(UsdGeom.Mesh(back.GetPrimAtPath("/group/sheet")).GetPointsAttr().Get(108)), clip.meshes[0][7])
    assert sorted(path.name for path in (tmp_path / "back").iterdir()) == ["shot.usda", "shot.usdc", "shot.usdz"]
    (tmp_path / "bad.anic").write_bytes((tmp_path / "clips" / "shot.anic").read_bytes()[:-9])
    for arguments, status, text in ((("encode", tmp_path / "none.usda", "-o", tmp_path / "x.anic"), 1, "none.usda"),
                                    ((*encode, "-f", "--part", "0:2"), 1, "--part"), ((*encode, "-f", "--fps", "no"), 2, "fps must be"),
                                    (("decode", tmp_path / "bad.anic", "-o", tmp_path / "x.usdc"), 3, "bad.anic"),
                                    (("encode", tmp_path / "shot.usda", "-o", tmp_path / "x.pc2"), 1, "an .anic file"),
                                    (("decode", tmp_path / "clips" / "shot.anic", "-o", tmp_path / "x.usdc", "--frames", "99"), 1, "24 frames"),
                                    (("decode", tmp_path / "clips" / "shot.anic", "-o", tmp_path / "x.usdc", "--hold"), 1, "--hold"),
                                    (("decode", tmp_path / "shot.usda", "-o", tmp_path / "x.pc2"), 2, "no .anic file")):
        told = run_command(*arguments)
        assert told.returncode == status and text in told.stderr and len(told.stderr.splitlines()) == 1, told.stderr


def test_the_command_takes_stages_of_a_folder_and_some_frames(tmp_path):
    folder = tmp_path / "in"
    (folder / "props").mkdir(parents=True)
    stage = timed_stage(1, 5, 24)
    triangle(stage, "/a", range(1, 6))
    stage.Export(str(folder / "props" / "a.usda"))
    (folder / "shot.usda").write_text("#usda 1.0\n(subLayers = [@./props/a.usda@])\n")
    (folder / "bad.usdc").write_bytes(b"no stage")
    assert run_command("corpus", "limb", "-o", folder / "limb.pc2", "--vertices", 300, "--frame-count", 3).returncode == 0
    batch = ("encode", "--batch", folder, "-o", tmp_path / "out", "--effort", "fast", "-j", 1)
    told = run_command(*batch)
    assert told.returncode == 2 and "1 stage of" in told.stdout and "bad: FAILED: " in told.stdout, told.stdout + told.stderr
    assert sorted(path.name for path in (tmp_path / "out").glob("*.anic")) == ["limb.anic", "shot.anic"]
    (folder / "bad.usdc").unlink()
    assert run_command(*batch).stdout.count("0 encoded, 1 done before, 0 failed") == 2
    triangle(stage, "/b", range(1, 6))
    stage.Export(str(folder / "props" / "a.usda"))  # a layer below counts, too
    assert "1 encoded, 0 done before, 0 failed" in run_command(*batch).stdout
    clips = [tmp_path / "out" / name for name in ("limb.anic", "shot.anic")]
    told = run_command("decode", *clips, "--format", "usda", "-o", tmp_path / "back", "--frames", "0:5:2")
    assert told.returncode == 0 and "3 frames of 2 meshes" in told.stdout, told.stderr
    back = Usd.Stage.Open(str(tmp_path / "back" / "shot.usda"))
    assert (back.GetStartTimeCode(), back.GetEndTimeCode()) == (1, 5)
    assert UsdGeom.Mesh(back.GetPrimAtPath("/a")).GetPointsAttr().GetTimeSamples() == [1, 3, 5]


def test_a_stage_far_from_zero_keeps_its_digits(stage, tmp_path):
    UsdGeom.Xform(stage.GetPrimAtPath("/group")).AddTranslateOp(opSuffix="place").Set(Gf.Vec3d(500000.125, 4649776.25, -7))
    clip = anicodec.open(usd.encode(stage, "/group/sheet", effort="fast", order="all"))
    assert max(clip.info["origin"]) > 4e6
    back = usd.decode(clip, tmp_path / "back.usdc")
    for code in (101, 124):
        worlds = []
        for file in (stage, back):
            mesh = next(UsdGeom.Mesh(prim) for prim in file.Traverse() if prim.IsA(UsdGeom.Mesh) and prim.GetName() == "sheet")
            world = np.array(UsdGeom.XformCache(code).GetLocalToWorldTransform(mesh.GetPrim()))
            worlds.append(np.array(mesh.GetPointsAttr().Get(code), float) @ world[:3, :3] + world[3, :3])
        assert np.linalg.norm(worlds[0] - worlds[1], axis=1).max() <= clip.info["max_error"] * 1.01 + 1e-6


def triangle(stage, path, codes=(None,)):
    """Its first vertex is at as many units on z as the code says."""
    mesh = UsdGeom.Mesh.Define(stage, path)
    for code in codes:
        mesh.CreatePointsAttr().Set([(0, 0, code or 0), (1, 0, 0), (0, 1, 0)], *([] if code is None else [code]))
    mesh.CreateFaceVertexCountsAttr([3])
    mesh.CreateFaceVertexIndicesAttr([0, 1, 2])
    mesh.CreateSubdivisionSchemeAttr("none")
    return mesh


def timed_stage(start, end, per_second):
    stage = Usd.Stage.CreateInMemory()
    stage.SetStartTimeCode(start)
    stage.SetEndTimeCode(end)
    stage.SetTimeCodesPerSecond(per_second)
    return stage


@pytest.mark.parametrize("per_second, frames_per_second, codes, fps", [
    (24, None, [1, 1.5, 2, 2.5, 3, 3.5, 4], 48), (1, 24, [frame / 24 for frame in range(49)], 24), (24, 12, [1, 2, 3], 24)])
def test_samples_between_time_codes_are_frames(per_second, frames_per_second, codes, fps):
    stage = timed_stage(codes[0], codes[-1], per_second)
    if frames_per_second:
        stage.SetFramesPerSecond(frames_per_second)
    triangle(stage, "/a", codes)
    clip = anicodec.open(usd.encode(stage, lossless=True, effort="fast"))
    assert clip.fps == fps and clip.frame_count == len(codes)
    assert clip[:][:, 0, 2] == pytest.approx(codes)


def test_each_instance_of_an_instancer_is_a_mesh():
    stage = timed_stage(1, 2, 24)
    instancer = UsdGeom.PointInstancer.Define(stage, "/group/many")
    UsdGeom.Xform(UsdGeom.Xform.Get(stage, "/group") or UsdGeom.Xform.Define(stage, "/group")).AddTranslateOp().Set((0, 100, 0))
    UsdGeom.Xform.Define(stage, "/group/many/thing").AddTranslateOp().Set((0, 0, 10))
    triangle(stage, "/group/many/thing/part").AddTranslateOp().Set((1000, 0, 0))
    instancer.CreatePrototypesRel().AddTarget("/group/many/thing")
    instancer.CreateProtoIndicesAttr([0, 0])
    for code, places in ((1, [(0, 0, 0), (5, 0, 0)]), (2, [(0, 0, 1), (5, 0, 2)])):
        instancer.CreatePositionsAttr().Set(places, code)
    instancer.CreateInvisibleIdsAttr().Set([1], 1)
    instancer.CreateInvisibleIdsAttr().Set([], 2)
    data = usd.encode(stage, lossless=True, effort="fast")
    clip = anicodec.open(data)
    assert [mesh.name for mesh in clip.meshes] == ["part_0", "part_1"] and list(data.notes) == []
    assert clip.meshes[0][0][0].tolist() == [1000, 100, 10] and clip.meshes[0][1][0].tolist() == [1000, 100, 11]
    assert not clip.meshes[1].shown_in(0) and clip.meshes[1][1][0].tolist() == [1005, 100, 12]


def test_instances_come_and_go_by_their_ids():
    stage = timed_stage(1, 2, 24)
    instancer = UsdGeom.PointInstancer.Define(stage, "/many")
    for name in ("a", "b"):
        triangle(stage, f"/many/{name}")
        instancer.CreatePrototypesRel().AddTarget(f"/many/{name}")
    for code, ids, numbers, places in ((1, [7, 9], [0, 1], [(0, 0, 0), (5, 0, 0)]), (2, [9], [1], [(6, 0, 0)])):
        instancer.CreateIdsAttr().Set(ids, code)
        instancer.CreateProtoIndicesAttr().Set(numbers, code)
        instancer.CreatePositionsAttr().Set(places, code)
    clip = anicodec.open(usd.encode(stage, lossless=True, effort="fast"))
    assert [mesh.name for mesh in clip.meshes] == ["a_7", "b_9"]
    assert [[mesh.shown_in(frame) for frame in (0, 1)] for mesh in clip.meshes] == [[True, False], [True, True]]
    assert clip.meshes[1][:][:, 0, 0].tolist() == [5, 6]
    instancer.CreateProtoIndicesAttr().Set([4], 2)
    with pytest.raises(anicodec.InputError, match="/many: an instance has no prototype 4"):
        usd.encode(stage)


def test_what_a_stage_has_besides_is_named():
    stage = timed_stage(1, 3, 24)
    mesh = triangle(stage, "/group/a", [1, 2, 3])
    UsdGeom.Camera.Define(stage, "/eye")
    for number in range(2):
        UsdGeom.Sphere.Define(stage, f"/ball{number}")
    mesh.CreateCreaseIndicesAttr([0, 1])
    mesh.CreateSubdivisionSchemeAttr("catmullClark")
    UsdGeom.Mesh(triangle(stage, "/guide")).CreatePurposeAttr("guide")
    choices = mesh.GetPrim().GetVariantSets().AddVariantSet("detail")
    for name in ("high", "low"):
        choices.AddVariant(name)
    choices.SetVariantSelection("high")
    primvars = UsdGeom.PrimvarsAPI(mesh)
    primvars.CreatePrimvar("label", Sdf.ValueTypeNames.StringArray, UsdGeom.Tokens.vertex).Set(["a", "b", "c"])
    primvars.CreatePrimvar("heat", Sdf.ValueTypeNames.FloatArray, UsdGeom.Tokens.vertex).Set([1, 2, 3])
    material = UsdShade.Material.Define(stage, "/paint")
    material.CreateSurfaceOutput()
    UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(material)
    UsdGeom.Subset.CreateGeomSubset(mesh, "cut", UsdGeom.Tokens.face, [0], "fracture")
    data = usd.encode(stage, effort="fast")
    assert list(data.notes) == [
        "/group/a: variant detail=high is encoded, not low",
        "not kept: 1 Camera, 2 Sphere, 1 Mesh of purpose guide, 1 subdivision (catmullClark) of a mesh, 'creaseIndices' of meshes, "
        "values of materials, GeomSubsets of faces, family 'fracture', primvar 'label'"]
    assert [attribute.name for attribute in anicodec.open(data).attributes] == ["heat", ""]


def test_numbers_above_meshes_are_inherited():
    stage = timed_stage(1, 1, 24)
    group = UsdGeom.Xform.Define(stage, "/group").GetPrim()
    colour = UsdGeom.PrimvarsAPI(group).CreatePrimvar("displayColor", Sdf.ValueTypeNames.Color3fArray, "constant")
    colour.Set([(1, 0, 0.5)])
    triangle(stage, "/group/a")
    attribute, = (each for each in anicodec.open(usd.encode(stage, effort="fast")).attributes if each.kind == "colour")
    assert np.allclose(attribute.values, (1, 0, 0.5), atol=0.01)


def test_instancers_in_prototypes_are_followed():
    stage = timed_stage(1, 2, 24)
    outer = UsdGeom.PointInstancer.Define(stage, "/outer")
    inner = UsdGeom.PointInstancer.Define(stage, "/outer/plant/leaves")
    UsdGeom.Xform.Define(stage, "/outer/plant").AddScaleOp().Set((2, 2, 2))
    triangle(stage, "/outer/plant/leaves/leaf").AddTranslateOp().Set((0, 0, 1))
    for instancer, prototype, places in ((outer, "/outer/plant", [(0, 0, 0), (100, 0, 0)]), (inner, "/outer/plant/leaves/leaf", [(10, 0, 0), (20, 0, 0)])):
        instancer.CreatePrototypesRel().SetTargets([prototype])
        instancer.CreateProtoIndicesAttr([0, 0])
        instancer.CreatePositionsAttr().Set(places, 1)
        instancer.CreatePositionsAttr().Set([(x, 1, 0) for x, _, _ in places], 2)
    inner.CreateInvisibleIdsAttr().Set([], 1)
    inner.CreateInvisibleIdsAttr().Set([1], 2)
    clip = anicodec.open(usd.encode(stage, lossless=True, effort="fast"))
    firsts = {mesh.name: mesh[0][0].tolist() for mesh in clip.meshes}
    assert firsts == {"leaf_0_0": [20, 0, 2], "leaf_0_1": [40, 0, 2], "leaf_1_0": [120, 0, 2], "leaf_1_1": [140, 0, 2]}
    assert clip.meshes[2][1][0].tolist() == [120, 3, 2] and not clip.meshes[3].shown_in(1)
    inner.GetPrototypesRel().SetTargets(["/outer"])
    with pytest.raises(anicodec.InputError, match="/outer: the instancer is in its own prototype"):
        usd.encode(stage)


def test_materials_keep_values_and_names_of_textures(tmp_path):
    (tmp_path / "shared").mkdir()
    (tmp_path / "shared" / "skin.png").write_bytes(b"")
    library = Usd.Stage.CreateNew(str(tmp_path / "shared" / "library.usda"))
    mesh = triangle(library, "/a")
    library.SetDefaultPrim(mesh.GetPrim())
    mesh.CreateFaceVertexCountsAttr([3, 3])
    mesh.CreateFaceVertexIndicesAttr([0, 1, 2, 2, 1, 0])
    mesh.CreateDoubleSidedAttr(True)
    UsdGeom.PrimvarsAPI(mesh).CreatePrimvar("map", Sdf.ValueTypeNames.TexCoord2fArray, "vertex").Set([(0, 0), (1, 0), (0, 1)])
    looks = []
    for number, parent in enumerate(("/a/one", "/a/two")):
        material = UsdShade.Material.Define(library, parent + "/paint")
        surface = UsdShade.Shader.Define(library, parent + "/paint/shader")
        surface.CreateIdAttr("UsdPreviewSurface")
        material.CreateSurfaceOutput().ConnectToSource(surface.ConnectableAPI(), "surface")
        subset = UsdGeom.Subset.CreateGeomSubset(mesh, f"set{number}", UsdGeom.Tokens.face, [number], "materialBind")
        UsdShade.MaterialBindingAPI.Apply(subset.GetPrim()).Bind(material)
        looks.append(surface)
    looks[0].CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set((0.25, 0.5, 1))
    looks[0].CreateInput("opacity", Sdf.ValueTypeNames.Float).Set(0.5)
    looks[0].CreateInput("clearcoat", Sdf.ValueTypeNames.Float).Set(0.5)
    looks[0].CreateInput("ior", Sdf.ValueTypeNames.Float).Set(1.5)
    for name, output, links in (("skin", "rgb", ("diffuseColor",)), ("bumps", "rgb", ("normal",)), ("orm", "g", ("roughness",)), ("orm", "b", ("metallic",))):
        texture = UsdShade.Shader.Define(library, f"/a/two/paint/{name}")
        texture.CreateIdAttr("UsdUVTexture")
        texture.CreateInput("file", Sdf.ValueTypeNames.Asset).Set(Sdf.AssetPath(f"./{name}.png"))
        texture.CreateOutput(output, Sdf.ValueTypeNames.Float3)
        for link in links:
            looks[1].CreateInput(link, Sdf.ValueTypeNames.Float).ConnectToSource(texture.ConnectableAPI(), output)
    library.Save()
    (tmp_path / "shot.usda").write_text('#usda 1.0\ndef "a" (references = @./shared/library.usda@) {}\n')
    data = usd.encode(tmp_path / "shot.usda", lossless=True, effort="fast", order="all")
    assert list(data.notes) == ["not kept: 'clearcoat' of materials"]
    (tmp_path / "shot.anic").write_bytes(data)
    usd.decode(data, tmp_path / "back.usda")
    for path in (None, "back.usda", "shot.anic"):
        if path == "shot.anic" and "anic" not in Sdf.FileFormat.FindAllFileFormatExtensions():
            continue
        again = anicodec.open(data if path is None else usd.encode(tmp_path / path, effort="fast", order="all"))
        material = next(attribute for attribute in again.attributes if attribute.kind == "material")
        assert material.labels == ("paint", "paint_1") and material.values.ravel().tolist() == [1, 2]
        plain, textured = material.looks
        assert plain.base_colour == (0.25, 0.5, 1, 0.5) and (plain.alpha, plain.double_sided, plain.roughness) == ("blend", True, 0.5)
        assert textured.base_colour == (1, 1, 1, 1) and textured.base_colour_texture == "shared/skin.png"
        assert (textured.normal_texture, textured.metallic_roughness_texture) == ("./bumps.png", "./orm.png")
        assert (textured.metallic, textured.roughness, textured.emissive_texture) == (1, 1, "")


def test_names_of_textures_are_paths_that_usd_takes(tmp_path):
    look = anicodec.Material(base_colour_texture="wood\x01\n\x7f\x85.png", normal_texture="\u00e4.png")
    mesh = anicodec.SourceMesh([[(0, 0, 0), (1, 0, 0), (0, 1, 0)]], [(0, 1, 2)], name="a", uv=[(0, 0), (1, 0), (0, 1)],
                               materials=(["paint"], [0], [look]))
    data = anicodec.encode_meshes([mesh], effort="fast")
    cut = anic_file.read_chunks(data)
    for chunk in cut:
        chunk.payload = chunk.payload.replace("\u00e4".encode(), b"\xff\xfe")
    (tmp_path / "a.anic").write_bytes(anic_file.write_chunks(cut))
    stages = [usd.decode(tmp_path / "a.anic", Usd.Stage.CreateInMemory())]
    if "anic" in Sdf.FileFormat.FindAllFileFormatExtensions():
        stages.append(Usd.Stage.Open(str(tmp_path / "a.anic")))
    for stage in stages:
        files = [UsdShade.Shader(prim).GetInput("file").Get() for prim in stage.Traverse() if prim.GetTypeName() == "Shader"]
        assert sorted(file.path for file in files if file) == ["wood\ufffd\ufffd\ufffd\ufffd.png", "\ufffd\ufffd.png"]


def test_parts_come_back():
    positions = [[(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, z)] for z in (0, 1)]
    mesh = anicodec.SourceMesh(positions, [(0, 1, 2), (1, 3, 2)], name="a", parts=(["left", "right"], [1, 0]))
    back = usd.decode(anicodec.encode_meshes([mesh], effort="fast", order="all"), Usd.Stage.CreateInMemory())
    parts, = (attribute for attribute in anicodec.open(usd.encode(back, effort="fast", order="all")).attributes if attribute.kind == "part")
    assert [parts.labels[label - 1] for label in parts.values.ravel()] == ["right", "left"]


def test_samples_that_no_rate_meets_are_frames():
    stage = timed_stage(1, 3, 24)
    triangle(stage, "/a", [1, 2, 2.03, 3])
    clip = anicodec.open(usd.encode(stage, lossless=True, effort="fast"))
    assert clip[:][:, 0, 2] == pytest.approx([1, 2, 2.03, 3]) and clip.time(2) == pytest.approx(1.03 / 24)
    data = usd.encode(stage, fps=24, effort="fast")
    assert data.notes[0] == "1 time samples of the stage stand between the frames; without fps= each is a frame"
    back = usd.decode(clip, Usd.Stage.CreateInMemory())
    assert UsdGeom.Mesh(back.GetPrimAtPath("/a")).GetPointsAttr().GetTimeSamples() == pytest.approx([1, 2, 2.03, 3])


def test_codes_that_are_ticks_are_no_frames():
    stage = timed_stage(0, 2500, 6000)
    stage.SetFramesPerSecond(24)
    triangle(stage, "/a", range(0, 2501, 250))
    clip = anicodec.open(usd.encode(stage, lossless=True, effort="fast"))
    assert clip.frame_count == 11 and clip.fps == 24
    back = usd.decode(clip, Usd.Stage.CreateInMemory())
    assert (back.GetTimeCodesPerSecond(), back.GetFramesPerSecond()) == (6000, 24)
    assert UsdGeom.Mesh(back.GetPrimAtPath("/a")).GetPointsAttr().GetTimeSamples() == list(range(0, 2501, 250))


def test_rates_of_television_are_exact():
    stage = timed_stage(1001, 1004, 24 / float(np.float32(1.001)))
    triangle(stage, "/a", range(1001, 1005))
    clip = anicodec.open(usd.encode(stage, lossless=True, effort="fast"))
    assert (clip.fps.numerator, clip.fps.denominator) == (24000, 1001)
    back = usd.decode(clip, Usd.Stage.CreateInMemory())
    assert UsdGeom.Mesh(back.GetPrimAtPath("/a")).GetPointsAttr().GetTimeSamples() == [1001, 1002, 1003, 1004]
    assert back.GetTimeCodesPerSecond() == stage.GetTimeCodesPerSecond()


def test_splines_are_followed():
    if not hasattr(Usd.Attribute, "SetSpline"):
        pytest.skip("this release has no splines")
    from pxr import Ts

    stage = Usd.Stage.CreateInMemory()
    mesh = triangle(stage, "/a", [1, 2, 3])
    spline = Ts.Spline()
    for code, value in ((1, 0.0), (11, 10.0)):
        spline.SetKnot(Ts.Knot(time=code, value=value, nextInterp=Ts.InterpLinear))
    mesh.AddTranslateXOp().GetAttr().SetSpline(spline)
    clip = anicodec.open(usd.encode(stage, lossless=True, effort="fast"))
    assert clip[:][:, 0, 0].tolist() == list(range(11)) and clip[:][:, 0, 2].tolist() == [1, 2] + 9 * [3]


def test_normals_say_which_edges_are_hard():
    corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    quads = [0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3]
    flat = np.repeat([(-1, 0, 0), (1, 0, 0), (0, -1, 0), (0, 1, 0), (0, 0, -1), (0, 0, 1)], 1, axis=0)
    vertex = (np.array(corners) - 0.5) / np.sqrt(0.75)
    for values, interpolation, scheme, hard in (
            (flat, "uniform", "none", True), (np.repeat(flat, 4, axis=0), "faceVarying", "none", True),
            (vertex, "vertex", "none", False), (vertex, "varying", "none", False), (vertex[:1], "constant", "none", False),
            (None, "vertex", "none", True), (None, "vertex", "catmullClark", False)):
        stage = Usd.Stage.CreateInMemory()
        mesh = UsdGeom.Mesh.Define(stage, "/box")
        mesh.CreatePointsAttr(corners)
        mesh.CreateFaceVertexCountsAttr([4] * 6)
        mesh.CreateFaceVertexIndicesAttr(quads)
        mesh.CreateSubdivisionSchemeAttr(scheme)
        if values is not None:
            mesh.CreateNormalsAttr([tuple(map(float, normal)) for normal in values])
            mesh.SetNormalsInterpolation(interpolation)
        clip = anicodec.open(usd.encode(stage, order="all", effort="fast", max_error=1e-4))
        shown = clip.normals(0, per_corner=True, source_edges=True)
        assert np.allclose(shown, np.repeat(flat, 4, axis=0) if hard else vertex[quads], atol=1e-2), (interpolation, scheme)
        back = usd.decode(clip, Usd.Stage.CreateInMemory())
        normals = UsdGeom.Mesh(back.GetPrimAtPath("/box"))
        assert normals.GetNormalsInterpolation() == ("faceVarying" if hard else "vertex")
        assert np.allclose(normals.GetNormalsAttr().Get(), shown if hard else vertex, atol=1e-2)


def test_one_level_of_detail_is_read():
    stage = timed_stage(1, 1, 24)
    root = stage.DefinePrim("/tree")
    root.SetMetadata("apiSchemas", Sdf.TokenListOp.Create(prependedItems=["LODRootAPI"]))
    for name in ("fine", "coarse"):
        triangle(stage, f"/tree/{name}")
    if "LODRootAPI" not in root.GetAppliedSchemas():
        pytest.skip("this release has no levels of detail")
    data = usd.encode(stage, effort="fast")
    assert len(anicodec.open(data).meshes) == 1
    assert list(data.notes) == ["not kept: 1 level of detail beside /tree/fine"]


def test_velocities_move_points_between_samples():
    stage = timed_stage(1, 3, 24)
    mesh = triangle(stage, "/a", [1, 3])
    for code in (1, 3):
        mesh.CreateVelocitiesAttr().Set([(24, 0, 0)] * 3, code)
    clip = anicodec.open(usd.encode(stage, lossless=True, effort="fast"))
    assert clip[:][:, 0, 0].tolist() == [0, 1, 0] and clip[:][:, 0, 2].tolist() == [1, 1, 3]


def test_numbers_of_many_components_come_back():
    stage = timed_stage(1, 2, 24)
    mesh = triangle(stage, "/a", [1, 2])
    primvars = UsdGeom.PrimvarsAPI(mesh)
    for code in (1, 2):
        primvars.CreatePrimvar("six", Sdf.ValueTypeNames.FloatArray, "vertex", 6).Set([i / 2 + code for i in range(18)], code)
        primvars.CreatePrimvar("displayColor", Sdf.ValueTypeNames.Color3fArray, "constant").Set([(code / 2, 0, 0)], code)
    clip = anicodec.open(usd.encode(stage, effort="fast", attribute_error=1e-4, colour_bits=12))
    decoded = usd.decode(clip, Usd.Stage.CreateInMemory())
    back = UsdGeom.PrimvarsAPI(decoded.GetPrimAtPath("/a"))
    six = back.GetPrimvar("six")
    assert six.GetElementSize() == 6 and six.GetTimeSamples() == [1, 2]
    assert np.allclose(six.Get(2), [i / 2 + 2 for i in range(18)], atol=1e-3)
    assert np.allclose(back.GetPrimvar("displayColor").Get(1)[2], (0.5, 0, 0), atol=1e-2)


def test_value_clips_are_followed(tmp_path):
    for number in (1, 2):
        part = Usd.Stage.CreateNew(str(tmp_path / f"part.{number}.usda"))
        triangle(part, "/a", [number])
        part.Save()
    stage = Usd.Stage.CreateNew(str(tmp_path / "all.usda"))
    stage.SetStartTimeCode(1)
    stage.SetEndTimeCode(2)
    mesh = triangle(stage, "/a", [])
    clips = Usd.ClipsAPI(mesh.GetPrim())
    clips.SetClipAssetPaths([Sdf.AssetPath(f"./part.{number}.usda") for number in (1, 2)])
    clips.SetClipPrimPath("/a")
    clips.SetClipActive([(1, 0), (2, 1)])
    clips.SetClipTimes([(1, 1), (2, 2)])
    clip = anicodec.open(usd.encode(stage, lossless=True, effort="fast"))
    assert clip[:][:, 0, 2].tolist() == [1, 2]


def test_what_rests_is_written_once_and_units_come_back(wave):
    stage = timed_stage(1001, 1004, 25)
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    triangle(stage, "/shot/xf/still")
    triangle(stage, "/shot/xf/moving", range(1001, 1005))
    back = usd.decode(usd.encode(stage, lossless=True, effort="fast"), Usd.Stage.CreateInMemory())
    assert UsdGeom.GetStageMetersPerUnit(back) == 0.01 and (back.GetStartTimeCode(), back.GetEndTimeCode()) == (1001, 1004)
    still = UsdGeom.Mesh(back.GetPrimAtPath("/shot/xf/still"))
    assert still.GetPointsAttr().GetNumTimeSamples() == 0 and len(still.GetPointsAttr().Get()) == 3
    assert UsdGeom.Mesh(back.GetPrimAtPath("/shot/xf/moving")).GetPointsAttr().GetTimeSamples() == [1001, 1002, 1003, 1004]


def test_doubts_about_stages_are_notes(tmp_path):
    stage = timed_stage(1, 2, 24)
    stage.SetMetadata("upAxis", "X")
    add_skin(stage)
    stage.GetPrimAtPath("/skin").SetTypeName("Xform")
    mesh = triangle(stage, "/clips", [])
    clips = Usd.ClipsAPI(mesh.GetPrim())
    part = Usd.Stage.CreateNew(str(tmp_path / "one.usda"))
    triangle(part, "/a", [1])
    part.Save()
    clips.SetClipAssetPaths([Sdf.AssetPath(str(tmp_path / name)) for name in ("one.usda", "none.usda")])
    clips.SetClipPrimPath("/a")
    clips.SetClipActive([(1, 0), (2, 1)])
    clips.SetClipTimes([(1, 1), (2, 2)])
    paint = UsdShade.Material.Define(stage, "/paint")
    shader = UsdShade.Shader.Define(stage, "/paint/surface")
    shader.CreateIdAttr("UsdPreviewSurface")
    shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.String).Set("red")
    paint.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
    UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(paint)
    notes = "\n".join(usd.encode(stage, effort="fast").notes)
    for text in ("the up axis X is taken for Y", "/skin/strip: the skin has no SkelRoot above it", "none.usda", "values of /paint, which are none"):
        assert text in notes, notes


def test_faults_of_stages_are_told(tmp_path):
    stage = timed_stage(1, 2, 24)
    with pytest.raises(anicodec.InputError, match="the stage has no mesh"):
        usd.encode(stage)
    mesh = triangle(stage, "/a", [1])
    mesh.GetPointsAttr().Set([(float("nan"), 0, 0), (1, 0, 0), (0, 1, 0)], 2)
    with pytest.raises(anicodec.InputError, match="/a: .*not finite.* time code 2"):
        usd.encode(stage)
    mesh.GetFaceVertexIndicesAttr().Set([0, 1, 9])
    mesh.GetPointsAttr().ClearAtTime(2)
    with pytest.raises(anicodec.InputError, match="/a: a face has a vertex that is not of the 3 points"):
        usd.encode(stage)
    UsdGeom.PrimvarsAPI(mesh).CreatePrimvar("heat", Sdf.ValueTypeNames.FloatArray, "vertex").Set([1, float("nan"), 3])
    mesh.GetFaceVertexIndicesAttr().Set([0, 1, 2])
    with pytest.raises(anicodec.InputError, match="/a: a value of primvar 'heat' is not finite"):
        usd.encode(stage)
    stage.SetEndTimeCode(float("inf"))
    with pytest.raises(anicodec.InputError, match="the stage has no frames from 1 to inf"):
        usd.encode(stage)
    stage.SetTimeCodesPerSecond(0)
    with pytest.raises(anicodec.InputError, match="the stage has 0 time codes per second"):
        usd.encode(stage)
    for body, fault in (('(subLayers = [@none.usda@])', "none.usda"), ('(subLayers = [@shot.usda@])', "shot.usda.*cycle"),
                        ('def "b" (references = @none.usda@) {}', "none.usda"),
                        ('def "b" (references = </b/c>) {\ndef "c" (references = </b>) {}\n}', "cycle|ancestor|itself")):
        (tmp_path / "shot.usda").write_text(f'#usda 1.0\n{body}\ndef Mesh "a" {{\npoint3f[] points = [(0, 0, 0)]\n}}\n')
        with pytest.raises(anicodec.InputError, match=f"(?i)shot.usda: .*({fault})"):
            usd.encode(tmp_path / "shot.usda")
