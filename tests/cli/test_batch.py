"""usd2kg batch: graphs of many scenes, through crashes and failures."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.cli.conftest import Run
from usd2kg.batch.folder import open_batch_folder
from usd2kg.query import load_graph
from usd2kg.stores import open_store

Scenes = Callable[..., Path]


@pytest.fixture
def scenes(room: Path, tmp_path: Path) -> Scenes:
    """Return a function that writes copies of the room, and returns their folder."""

    def write(*names: str) -> Path:
        for name in names:
            file = tmp_path / "scenes" / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(room.read_bytes())
        return tmp_path / "scenes"

    return write


def records(out: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in (out / "manifest.jsonl").read_text().splitlines()]


def graphs(out: Path) -> list[str]:
    return sorted(path.relative_to(out).as_posix() for path in out.rglob("*.ttl"))


def test_each_scene_has_a_graph_and_a_record(run: Run, scenes: Scenes, tmp_path: Path):
    folder, out = scenes("a/room.usda", "b/room.usda"), tmp_path / "out"
    done = run("batch", folder, "-o", out, "--json", "--workers", 2)
    assert done.code == 0, done.err
    assert graphs(out) == ["a/room.ttl", "b/room.ttl"]
    summary = json.loads(done.out)
    assert (summary["scenes"], summary["built"], summary["failed"]) == (2, 2, {})
    first = next(record for record in records(out) if record["scene"] == "a/room.usda")
    assert (first["status"], first["output"], first["attempts"]) == ("done", "a/room.ttl", 1)
    assert first["summary"]["objects"] == summary["objects"] / 2
    # The same as a build, but for the namespace, in which scenes of one name differ.
    run("build", folder / "a/room.usda", "-o", tmp_path / "one.ttl", "--base", "https://example.org/a/room/")
    one, of_batch = (
        load_graph(path).sparql("SELECT ?o ?c { ?o u2k:primPath ?p ; a ?c } ORDER BY ?o ?c").rows
        for path in (tmp_path / "one.ttl", out / "a/room.ttl")
    )
    assert one == of_batch != ()


def test_what_is_finished_is_not_built_again(run: Run, scenes: Scenes, tmp_path: Path):
    folder, out = scenes("a.usda", "b.usda", "c.usda"), tmp_path / "out"
    assert run("batch", folder, "-o", out).code == 0
    again = run("batch", folder, "-o", out, "--json")
    assert (json.loads(again.out)["built"], json.loads(again.out)["finished_before"]) == (0, 3)
    # A changed scene, a damaged graph, and a new scene.
    os.utime(folder / "a.usda", ns=(1, 1))
    (out / "b.ttl").write_text("damaged")
    scenes("d.usda")
    built = json.loads(run("batch", folder, "-o", out, "--json").out)
    assert (built["built"], built["finished_before"]) == (3, 1)
    assert "u2k:" in (out / "b.ttl").read_text()
    for option in (("--profile", "plain"), ("--again",)):
        assert json.loads(run("batch", folder, "-o", out, "--json", *option).out)["built"] == 4


def test_a_scene_is_built_again_when_a_layer_that_it_uses_has_changed(run: Run, room: Path, tmp_path: Path):
    folder, out, asset = tmp_path / "scenes", tmp_path / "out", tmp_path / "assets" / "room.usda"
    for file in (asset, folder / "alone.usda"):
        file.parent.mkdir()
        file.write_bytes(room.read_bytes())
    for name in ("a.usda", "b.usda"):
        (folder / name).write_text(
            '#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = "Z"\n)\n'
            'def "Hall" (\n    prepend references = @../assets/room.usda@</Room>\n)\n{\n}\n'
        )

    def built() -> int:
        done = run("batch", folder, "-o", out, "--json")
        assert done.code == 0, done.err
        return int(json.loads(done.out)["built"])

    assert [built(), built()] == [3, 0]
    layers = {record["scene"]: record["layers"] for record in records(out)}
    assert layers["alone.usda"] == []
    (layer,) = layers["a.usda"]
    assert (layer["path"], layer["bytes"]) == ("../assets/room.usda", asset.stat().st_size)
    # A later time alone is no change.
    os.utime(asset, ns=(1, 1))
    assert built() == 0
    text = asset.read_text()
    asset.write_text(text.replace("Apple", "Lemon"))
    assert asset.stat().st_size == layer["bytes"]
    assert [built(), built()] == [2, 0]
    # What is moved as a whole stays finished.
    moved = tmp_path / "elsewhere"
    moved.mkdir()
    for place in (folder, asset.parent):
        place.rename(moved / place.name)
    folder = moved / "scenes"
    assert built() == 0
    (moved / "assets" / "room.usda").unlink()
    assert built() == 2


def test_a_bad_scene_stops_no_other(run: Run, scenes: Scenes, tmp_path: Path):
    folder, out = scenes("a.usda", "b.usda"), tmp_path / "out"
    (folder / "broken.usda").write_text("#usda 1.0\ndef Xform {")
    (folder / "empty.usdc").write_bytes(b"")
    done = run("batch", folder, "-o", out)
    assert done.code == 1
    assert graphs(out) == ["a.ttl", "b.ttl"]
    assert "failed: broken.usda: " in done.err and "failed: empty.usdc: " in done.err
    assert "4 scenes: 2 built" in done.err and ", 2 failed" in done.err
    failed = {record["scene"]: record for record in records(out) if record["status"] == "failed"}
    assert {record["output"] for record in failed.values()} == {""}
    # Only what failed is tried again.
    (folder / "broken.usda").unlink()
    assert json.loads(run("batch", folder, "-o", out, "--json").out)["finished_before"] == 2


def test_graphs_are_loaded_into_a_store(run: Run, scenes: Scenes, tmp_path: Path):
    folder, out, store = scenes("a/room.usda", "b/room.usda"), tmp_path / "out", tmp_path / "store"
    assert run("batch", folder, "-o", out, "--store", store, "--base", "https://my.lab/").code == 0
    assert sorted(graph.iri for graph in open_store(str(store)).graphs()) == [
        "https://my.lab/a/room",
        "https://my.lab/b/room",
    ]


def test_finished_graphs_are_loaded_into_a_store_that_lacks_them(run: Run, scenes: Scenes, tmp_path: Path):
    folder, out, store = scenes("a.usda", "b.usda"), tmp_path / "out", tmp_path / "store"
    assert run("batch", folder, "-o", out).code == 0
    done = run("batch", folder, "-o", out, "--store", store)
    assert (done.code, "2 scenes of 2 already finished" in done.err) == (0, True)
    assert "2 finished graphs loaded into" in done.err
    assert len(open_store(str(store)).graphs()) == 2
    assert "loaded into" not in run("batch", folder, "-o", out, "--store", store).err
    # Another store has none of them, nor has one that was deleted.
    shutil.rmtree(store)
    for place in (store, tmp_path / "other"):
        assert "2 finished graphs loaded into" in run("batch", folder, "-o", out, "--store", place).err
        assert len(open_store(str(place)).graphs()) == 2


def test_other_formats_and_options_of_a_build(run: Run, scenes: Scenes, tmp_path: Path):
    folder, out = scenes("my room%.usda"), tmp_path / "out"
    done = run("batch", f"{folder}/*.usda", "-o", out, "--format", "nq.gz", "--relation-kinds", "on", "--merge-imports")
    assert done.code == 0, done.err
    graph = load_graph(out / "my room%.nq.gz")
    assert graph.sparql("ASK { <https://example.org/my%20room%25/Room.Apple> a ?c }").rows == (("true",),)
    assert graph.sparql("ASK { ?a u2k:nextTo|soma:isNextTo ?b }").rows == (("false",),)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("nowhere/*.usd", "-o", "out"), "no scene found"),
        (("../scenes", "-o", "out", "--format", "pdf"), "'.pdf' names no graph format"),
        (("../scenes", "-o", "out", "--base", "no IRI"), "expected an absolute IRI"),
        (("../scenes", "-o", "out", "--queue", "q.csv"), "are for one scene"),
        (("../scenes", "-o", "file"), "cannot be used as a folder"),
        (("../scenes", "-o", "out", "--evidence", "smell"), "smell"),
    ],
)
def test_wrong_usage_is_said_before_anything_is_built(
    run: Run, scenes: Scenes, arguments: tuple[str, ...], message: str
):
    scenes("a.usda")
    Path("file").touch()
    done = run("batch", *arguments)
    assert (done.code, message in done.err) == (2, True), done.err
    assert not list(Path().rglob("*.ttl"))


def test_two_batches_do_not_share_a_folder(run: Run, scenes: Scenes, tmp_path: Path):
    folder, out = scenes("a.usda"), tmp_path / "out"
    with open_batch_folder(out, 1):
        done = run("batch", folder, "-o", out)
    assert (done.code, "another batch may be writing there" in done.err) == (2, True)


def test_a_graph_that_a_store_refuses_is_a_failure(run: Run, scenes: Scenes, tmp_path: Path):
    out = tmp_path / "out"
    done = run("batch", scenes("a.usda"), "-o", out, "--store", tmp_path / "store", "--format", "graphml")
    assert (done.code, "failed: a.usda: " in done.err) == (1, True)
    assert records(out)[0]["status"] == "failed"


def start(folder: Path, out: Path) -> "subprocess.Popen[str]":
    command = [sys.executable, "-m", "usd2kg", "batch", str(folder), "-o", str(out), "--workers", "2"]
    return subprocess.Popen(command, stderr=subprocess.PIPE, text=True, start_new_session=True)


def wait_for_records(out: Path, count: int) -> None:
    for _ in range(600):
        if (out / "manifest.jsonl").exists() and len((out / "manifest.jsonl").read_bytes().splitlines()) >= count:
            return
        time.sleep(0.05)
    raise AssertionError("no scene was finished in 30 s")


def workers_of(process: int) -> Iterator[int]:
    """Yield the processes whose group is that of a batch, without it."""
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit() and int(entry.name) != process:
            try:
                if os.getpgid(int(entry.name)) == process:
                    yield int(entry.name)
            except ProcessLookupError:
                continue


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="needs /proc")
@pytest.mark.parametrize(
    "sent", [signal.SIGKILL, *(pytest.param(sent, marks=pytest.mark.slow) for sent in (signal.SIGINT, signal.SIGTERM))]
)
def test_what_was_finished_survives_a_kill(run: Run, scenes: Scenes, tmp_path: Path, sent: signal.Signals):
    folder, out = scenes(*(f"{number}.usda" for number in range(60))), tmp_path / "out"
    with start(folder, out) as process:
        wait_for_records(out, 5)
        process.send_signal(sent)
        _, said = process.communicate(timeout=30)
    if sent != signal.SIGKILL:
        assert process.returncode == 130
        assert "the same command resumes from there" in said
    for _ in range(100):
        if not [*workers_of(process.pid)]:
            break
        time.sleep(0.1)
    assert [*workers_of(process.pid)] == [], "the workers end with the batch"
    finished = len(records(out))
    assert 5 <= finished < 60
    # Graphs are whole or absent: every file parses, recorded or not.
    for graph in out.rglob("*.ttl"):
        assert load_graph(graph).sparql("ASK { ?o u2k:primPath ?p }").rows == (("true",),)
    done = json.loads(run("batch", folder, "-o", out, "--json").out)
    assert (done["built"], done["finished_before"]) == (60 - finished, finished)


@pytest.mark.slow
def test_a_ray_cluster_builds_the_same(run: Run, scenes: Scenes, tmp_path: Path):
    pytest.importorskip("ray")
    folder, out = scenes("a.usda", "b.usda", "c.usda"), tmp_path / "out"
    (folder / "broken.usda").write_text("#usda 1.0\ndef Xform {")
    done = run("batch", folder, "-o", out, "--ray", "--workers", 2)
    assert (done.code, graphs(out)) == (1, ["a.ttl", "b.ttl", "c.ttl"])
    assert run("batch", folder, "-o", tmp_path / "local").code == 1
    for name in graphs(out):
        assert (
            load_graph(out / name).sparql("SELECT * { ?o u2k:primPath ?p } ORDER BY ?p").rows
            == load_graph(tmp_path / "local" / name).sparql("SELECT * { ?o u2k:primPath ?p } ORDER BY ?p").rows
        )
