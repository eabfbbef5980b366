# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The anicodec authors
"""Many clips by dask."""
import pytest

import anicodec

distributed = pytest.importorskip("dask.distributed", reason="dask is not installed")


@pytest.fixture(scope="module")
def client():
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0",
                                  resources={"ANICODEC_MEMORY": 1e9}) as cluster:
        with distributed.Client(cluster) as own:
            yield own


@pytest.fixture
def clips(tmp_path, command):
    for name in ("one", "two"):
        command("corpus", "limb", "-q", "--vertices", 200, "--frame-count", 24, "-o", tmp_path / f"{name}.pc2")
    return [[tmp_path / f"{name}.obj", tmp_path / f"{name}.pc2"] for name in ("one", "two")]


def test_clips_are_done_once(client, clips, tmp_path, command):
    out = tmp_path / "out"
    first = anicodec.batch(clips, out, client=client, effort="fast", max_error="0.1%")
    assert [(result.name, result.status) for result in first] == [("one", "done"), ("two", "done")]
    command("encode", "-q", *clips[0], "-o", tmp_path / "alone.anic", "--effort", "fast", "--max-error", "0.1%")
    assert anicodec.open(out / "one.anic")[5].tolist() == anicodec.open(tmp_path / "alone.anic")[5].tolist()
    assert {result.status for result in anicodec.batch(clips, out, client=client, effort="fast", max_error="0.1%")} == \
        {"kept"}
    (out / "one.anic").write_bytes(b"spoilt")
    clips[1][0].write_text("# another input\n" + clips[1][0].read_text())
    again = anicodec.batch(clips, out, client=client, effort="fast", max_error="0.1%")
    assert [result.status for result in again] == ["done", "done"]
    other = anicodec.batch(clips[:1], out, client=client, effort="fast", max_error="0.2%")
    assert other[0].status == "done" and other[0].size < first[0].size


def test_parts_are_joined(client, clips, tmp_path):
    out = tmp_path / "out"
    result, = anicodec.batch({"long": clips[0]}, out, client=client, part_frames=10, effort="fast")
    assert result.status == "done" and result.path == str(out / "long.anic")
    clip = anicodec.open(result.path)
    assert clip.frame_count == 24 and clip.info["segment_count"] >= 3
    assert [path.name for path in (out / ".anicodec").iterdir()] == ["long.json"]
    assert anicodec.batch({"long": clips[0]}, out, client=client, part_frames=10, effort="fast")[0].status == "kept"


def test_failures_are_listed(client, clips, tmp_path, caplog):
    bad = tmp_path / "bad.pc2"
    bad.write_bytes(b"POINTCACHE2\0")
    results = anicodec.batch([clips[0], [clips[0][0], bad], tmp_path / "none.glb"], tmp_path / "out", client=client,
                             effort="fast")
    assert [result.status for result in results] == ["done", "failed", "failed"]
    assert "bad.pc2" in results[1].error and "none.glb" in results[2].error
    parts, = anicodec.batch({"long": [tmp_path / "none.obj", clips[0][1]]}, tmp_path / "out", client=client, part_frames=10)
    assert parts.status == "failed" and "none.obj" in parts.error
    assert "Traceback" not in caplog.text and not caplog.records
    with pytest.raises(anicodec.InputError, match="several clips have the name 'one'"):
        anicodec.batch([clips[0], clips[0]], tmp_path / "out", client=client)


def test_without_a_client(clips, tmp_path):
    assert anicodec.batch(clips[:1], tmp_path / "out", effort="fast")[0].status == "done"
