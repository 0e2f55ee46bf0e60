"""The studio's server over HTTP."""

import csv
import io
import json
import threading
import time
import urllib.request
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pyoxigraph as ox
import pytest
import trimesh
from pxr import Usd

from tests.studio.conftest import HOSTILE, KEY, Client, Studio, needs_page, running_studio
from usd2kg.endpoint.app_files import read_app_files
from usd2kg.errors import OutputError
from usd2kg.grounding import read_decisions
from usd2kg.ontology import load_home_tbox
from usd2kg.query import load_graph

pytestmark = pytest.mark.studio
FLOOR, TABLE, CUP_1, CUP_2, THING = range(5)


def decide(studio: Client, objects: list[int], action: str, reviewer: str = "Ann", **more: Any) -> Any:
    body = {"objects": objects, "action": action, "reviewer": reviewer, **more}
    reply = studio.ask("api/decisions", body)
    assert reply.status == 200, reply.body
    return reply.json()


def class_index(studio: Client, name: str) -> int:
    classes = studio.ask("api/scene").json()["classes"]
    return next(index for index, cls in enumerate(classes) if cls["name"] == name)


def states(studio: Client) -> list[str]:
    return [state["state"] for state in studio.ask("api/states").json()["states"]]


def next_event(stream: Any, name: str) -> Any:
    """Return the data of the next event with a name."""
    while stream.readline().decode() != f"event: {name}\n":
        pass
    return json.loads(stream.readline().removeprefix(b"data: "))


def test_the_scene_is_what_the_stage_holds(shared: Client):
    scene = shared.ask("api/scene").json()
    assert scene["title"] == "kitchen.usda"
    assert scene["reviewer"] == "Ann"
    objects = scene["objects"]
    assert objects["path"] == [f"/Kitchen/{name}" for name in ("Floor", "Table", "Cup_1", "Cup_2", "Zxqv")]
    assert objects["name"][CUP_1] == HOSTILE
    assert objects["box"][TABLE] == pytest.approx([-0.6, -0.4, 0, 0.6, 0.4, 0.7])
    assert {len(column) for name, column in objects.items() if name not in {"rooms", "assets"}} == {5}
    assert len(scene["classes"]) == 102
    found = shared.ask("api/states").json()
    assert [found["states"][index]["class"] for index in (TABLE, CUP_2)] == [
        class_index(shared, "Table"),
        class_index(shared, "Cup"),
    ]


@pytest.mark.parametrize("color", ["", "color3f[] primvars:displayColor = [(1, 0, 0)]"])
def test_the_scene_says_whether_anything_has_a_colour(color: str, tmp_path: Path):
    stage = tmp_path / "cup.usda"
    stage.write_text(f'#usda 1.0\ndef Cube "Cup" (kind = "component")\n{{\n{color}\n}}\n')
    with running_studio(stage, tmp_path / "project") as client:
        assert client.ask("api/scene").json()["has_colors"] is bool(color)


def test_decisions_undo_and_redo(studio: Client):
    reply = decide(studio, [CUP_1, CUP_2], "confirm", comment="has a handle")
    assert [state["state"] for state in reply["states"]] == ["confirmed", "confirmed"]
    assert (reply["version"], reply["can_undo"], reply["can_redo"]) == (1, True, False)
    decide(studio, [TABLE], "choose", **{"class": class_index(studio, "Cupboard")})
    decide(studio, [FLOOR], "no-class")
    decide(studio, [THING], "unsure")
    assert states(studio) == ["no-class", "corrected", "confirmed", "confirmed", "unsure"]
    for _ in range(3):
        assert studio.ask("api/undo", {"reviewer": "Ann"}).status == 200
    assert states(studio)[:4] == ["suggested", "suggested", "confirmed", "confirmed"]
    assert studio.ask("api/redo", {"reviewer": "Ann"}).json()["states"][0]["state"] == "corrected"
    page = studio.ask(f"api/object/{TABLE}").json()
    assert [(entry["action"], entry["verdict"]) for entry in page["history"]] == [
        ("decide", "class"),
        ("undo", "open"),
        ("redo", "class"),
    ]
    assert studio.ask("api/undo", {"reviewer": "Bob"}).json() == {"error": "Bob has no decision to undo"}


@needs_page
def test_a_killed_studio_goes_on_where_it_was(stage: Path, tmp_path: Path):
    folder = tmp_path / "project"
    first = Studio(str(stage), "--project", str(folder))
    decide(first, [CUP_1], "confirm", "Ann")
    decide(first, [TABLE], "no-class", "Bob")
    first.kill()
    second = Studio(str(folder))
    try:
        assert states(second) == ["suggested", "no-class", "confirmed", "suggested", "suggested"]
        assert second.ask("api/undo", {"reviewer": "Ann"}).json()["states"][0]["object"] == CUP_1
    finally:
        second.stop()


@needs_page
def test_files_follow_the_decisions(stage: Path, tmp_path: Path):
    folder = tmp_path / "project"
    studio = Studio(str(stage), "--project", str(folder))
    decide(studio, [THING], "choose", "Ann", **{"class": class_index(studio, "Cupboard")})
    decide(studio, [CUP_1], "no-class", "Ann")
    studio.stop()
    tbox = load_home_tbox()
    cupboard = tbox.resolve("Cupboard")
    decisions = read_decisions(folder / "decisions.sssom.tsv", tbox)
    assert {path: made.class_iri for path, made in decisions.items()} == {
        "/Kitchen/Zxqv": cupboard,
        "/Kitchen/Cup_1": None,
    }
    graph = load_graph(folder / "graph.ttl")
    found = graph.sparql('SELECT ?c { ?o u2k:primPath "/Kitchen/Zxqv" ; a ?c . ?c a owl:Class }')
    assert (cupboard,) in found.rows
    labels = Usd.Stage.Open(str(folder / "labels.usda"))
    prim = labels.GetPrimAtPath("/Kitchen/Zxqv")
    assert prim.GetAttribute("semantics:labels:class").Get()[0] == "Cupboard"
    mapping = (folder / "mapping.sssom.tsv").read_text()
    assert "sssom:NoTermFound" in mapping
    assert next(line for line in mapping.splitlines() if "Zxqv" in line).split("\t")[7] == "Ann"


def test_exports_are_current(studio: Client):
    decide(studio, [THING], "choose", **{"class": class_index(studio, "Cupboard")})
    turtle = studio.ask("api/export/graph.ttl")
    assert turtle.headers["content-disposition"] == 'attachment; filename="graph.ttl"'
    store = ox.Store()
    store.load(turtle.body, format=ox.RdfFormat.TURTLE)
    assert store.query(
        "ASK { ?o <https://w3id.org/usd2kg#primPath> \"/Kitchen/Zxqv\" ; a ?c . FILTER(STRENDS(STR(?c), '#Cupboard')) }"
    )
    for name in ("mapping.sssom.tsv", "decisions.sssom.tsv", "labels.usda", "objects.csv", "grounding.json"):
        assert "Cupboard" in studio.ask(f"api/export/{name}").body.decode(), name
    assert studio.ask("api/export/..%2f..%2fproject.json").status == 404


def test_the_confidence_of_a_decision_is_not_that_of_the_suggestion(studio: Client):
    def confidences() -> tuple[float | None, str]:
        rows = csv.DictReader(io.StringIO(studio.ask("api/export/objects.csv").body.decode()))
        row = next(row for row in rows if row["path"] == "/Kitchen/Zxqv")
        return studio.ask("api/states").json()["states"][THING]["confidence"], row["confidence"]

    suggested = confidences()
    decide(studio, [THING], "choose", **{"class": class_index(studio, "Cupboard")})
    assert confidences() == (1.0, "1.0000") != suggested
    decide(studio, [THING], "no-class")
    assert confidences() == (None, "")


def test_the_queue_groups_what_one_decision_settles(studio: Client):
    queue = studio.ask("api/queue").json()
    groups = {tuple(group["objects"]): group for group in queue["groups"]}
    assert (CUP_1, CUP_2) in groups or (CUP_2, CUP_1) in groups
    gains = [group["gain"] for group in queue["groups"]]
    assert gains == sorted(gains, reverse=True)
    assert queue["groups"][0]["objects"] == [THING]
    decide(studio, [THING], "unsure")
    decide(studio, [CUP_1, CUP_2], "confirm")
    queue = studio.ask("api/queue?order=confidence").json()
    assert (queue["open"], queue["decided"], len(queue["groups"])) == (3, 2, 3)
    assert "expected one of gain" in studio.ask("api/queue?order=x").json()["error"]


def test_meshes_lie_where_the_objects_are(shared: Client):
    manifest = shared.ask("api/geometry").json()
    assert manifest["triangles"] == manifest["source_triangles"] > 12
    boxes = shared.ask("api/scene").json()["objects"]["box"]
    content = shared.ask("api/geometry/0.glb").body
    scene = trimesh.load(trimesh.util.wrap_as_stream(content), file_type="glb")
    length = int.from_bytes(content[12:16], "little")
    nodes = [node for node in json.loads(content[20 : 20 + length])["nodes"] if "mesh" in node]
    seen = {}
    for node in nodes:
        matrix, name = scene.graph[node["name"]]
        mesh = scene.geometry[name].copy()
        mesh.apply_transform(matrix)
        seen[node["extras"]["object"]] = mesh.bounds.reshape(-1).tolist()
    assert seen == {index: pytest.approx(box, abs=2e-3) for index, box in enumerate(boxes)}
    # The cups are one mesh, and the floor and the table, which are cubes of one size before they are scaled.
    assert len({node["mesh"] for node in nodes}) == 3
    assert shared.ask("api/geometry/1.glb").status == 404


def test_pictures_and_pages_of_objects(shared: Client):
    assert shared.ask(f"api/thumbnail/{CUP_1}.png").body.startswith(b"\x89PNG")
    assert shared.ask("api/thumbnail/99.png").status == 404
    page = shared.ask(f"api/object/{CUP_2}").json()
    assert page["candidates"][0]["class"] == class_index(shared, "Cup")
    evidence = {each["group"]: each for each in page["candidates"][0]["evidence"]}
    assert "“cup” is the label of Cup" in evidence["name"]["explanation"]
    assert evidence["size"]["likelihood_ratio"] > 1
    assert page["concept"]["label"] == "cup"
    relations = {(r["kind"], r["anchor"]) for r in page["relations"] if r["target"] == CUP_2}
    assert ("on", TABLE) in relations
    assert ("on", CUP_2) in {(r["kind"], r["target"]) for r in shared.ask("api/relations?kind=on").json()["relations"]}


def test_decisions_and_object_pages_do_not_wait_for_questions(studio: Client, monkeypatch: pytest.MonkeyPatch):
    """More questions than `asyncio.to_thread` has threads."""
    count = 40
    are_let_go, waiting = threading.Event(), threading.Semaphore(0)

    def wait(*_: object) -> dict[str, str]:
        waiting.release()
        are_let_go.wait(30)
        return {}

    monkeypatch.setattr("usd2kg.studio.questions.Questions.ask", wait)
    with ThreadPoolExecutor(count) as pool:
        asked = [pool.submit(studio.ask, "api/ask", {"question": "what is on the table?"}) for _ in range(count)]
        try:
            assert waiting.acquire(timeout=20)
            start = time.perf_counter()
            decide(studio, [TABLE], "confirm")
            assert studio.ask(f"api/object/{TABLE}").json()["history"][0]["verdict"] == "class"
            assert studio.ask("api/undo", {"reviewer": "Ann"}).status == 200
            assert time.perf_counter() - start < 10
        finally:
            are_let_go.set()
        assert {reply.result().status for reply in asked} == {200}


def test_questions_and_queries_name_objects(studio: Client):
    reply = studio.ask("api/ask", {"question": "what is on the table?"}).json()
    assert sorted(reply["objects"]) == [CUP_1, CUP_2]
    assert "on the table" in reply["sentence"]
    refused = studio.ask("api/ask", {"question": "what is on the zeppelin?"})
    assert refused.status == 422
    assert "zeppelin" in refused.json()["error"]
    query = 'SELECT ?o ?c { ?o u2k:primPath "/Kitchen/Table" ; a ?c . ?c a owl:Class }'
    table = studio.ask("api/sparql", {"query": query}).json()
    assert table["columns"] == ["o", "c"]
    assert set(table["objects"]) == {TABLE}
    decide(studio, [TABLE], "choose", **{"class": class_index(studio, "Cupboard")})
    again = studio.ask("api/sparql", {"query": query}).json()
    assert any(row[1].endswith("#Cupboard") for row in again["rows"])
    update = studio.ask("api/sparql", {"query": "DELETE WHERE { ?s ?p ?o }"})
    assert update.status == 422
    assert len(studio.ask("api/examples").json()) > 5


def test_reviewers_see_each_other(studio: Client):
    request = urllib.request.Request(f"{studio.address}api/events?since=0")
    request.add_header("Authorization", f"Bearer {KEY}")
    with urllib.request.urlopen(request, timeout=30) as stream:
        assert stream.headers["content-type"].startswith("text/event-stream")
        assert stream.readline() == b": connected\n"
        threading.Timer(0.2, lambda: decide(studio, [TABLE], "confirm", "Bob", page="p1")).start()
        change = next_event(stream, "change")
    assert (change["reviewer"], change["page"], change["version"]) == ("Bob", "p1", 1)
    assert (change["can_undo"], change["can_redo"]) == (True, False)
    assert change["states"][0]["state"] == "confirmed"
    # Ann has not seen it: a conflict, until somebody decides who has.
    assert decide(studio, [TABLE], "no-class", "Ann", seen=0)["states"][0]["is_conflict"]
    assert not decide(studio, [TABLE], "confirm", "Bob", seen=2)["states"][0]["is_conflict"]


def test_a_page_that_missed_changes_gets_all_states(studio: Client):
    decide(studio, [TABLE], "confirm")
    request = urllib.request.Request(f"{studio.address}api/events?since=0")
    request.add_header("Authorization", f"Bearer {KEY}")
    with urllib.request.urlopen(request, timeout=30) as stream:
        lines = [stream.readline().decode() for _ in range(3)]
    assert len(json.loads(lines[1].removeprefix("data: "))["states"]) == 5


@pytest.mark.parametrize(
    ("body", "status", "message"),
    [
        (b"{", 400, "the body is not JSON"),
        (b"[]", 400, "the body is not a JSON object"),
        ({"objects": [], "action": "confirm", "reviewer": "A"}, 400, "has 0 entries"),
        ({"objects": [99], "action": "confirm", "reviewer": "A"}, 400, "'99' is not an object"),
        ({"objects": [True], "action": "confirm", "reviewer": "A"}, 400, "'True' is not an object"),
        ({"objects": ["0"], "action": "confirm", "reviewer": "A"}, 400, "is not an object"),
        ({"objects": [0], "action": "explode", "reviewer": "A"}, 400, "'explode' is unknown"),
        ({"objects": [0], "action": "choose", "reviewer": "A"}, 400, "field class: found NoneType"),
        ({"objects": [0], "action": "choose", "reviewer": "A", "class": 102}, 400, "102 is not a class"),
        ({"objects": [0], "action": "confirm", "reviewer": " "}, 400, "expected a name"),
        ({"objects": [0], "action": "confirm", "reviewer": "A\nB"}, 400, "expected a name"),
        ({"objects": [0], "action": "unsure", "reviewer": "A", "comment": "x" * 3000}, 400, "at most 2000"),
        (b'{"x": "' + b"y" * 5_000_000 + b'"}', 413, "larger than"),
        (b"[" * 100_000, 400, "the body is not JSON"),
    ],
)
def test_bad_requests_are_refused(shared: Client, body: Any, status: int, message: str):
    reply = shared.ask("api/decisions", body)
    assert reply.status == status
    assert message in reply.json()["error"]
    assert shared.ask("api/states").json()["version"] == 0


def test_strangers_are_refused(shared: Client):
    for path in ("api/export/graph.ttl", "api/events", "api/nothing"):
        assert shared.ask(path, key=None).status == 401, path
    assert shared.ask("api/scene", key="wrong-horse-battery").status == 401
    assert shared.ask("api/scene", headers={"Host": "evil.example"}).status == 403
    assert shared.ask("api/undo", {"reviewer": "A"}, headers={"Origin": "https://evil.example"}).status == 403


def test_the_page_runs_only_its_own_code(shared: Client):
    page = shared.ask("", key=None)
    policy = page.headers["content-security-policy"]
    assert "script-src 'self'" in policy
    assert "unsafe" not in policy
    assert page.headers["x-frame-options"] == "DENY"
    assert KEY not in page.body.decode()
    for path in ("..%2f..%2fpyproject.toml", "../../errors.py", "app_files.py", "%2e%2e/session.py"):
        assert shared.ask(path, key=None).status == 404, path


@pytest.fixture(scope="module")
def shared(stage: Path, tmp_path_factory: pytest.TempPathFactory) -> Any:
    with running_studio(stage, tmp_path_factory.mktemp("shared") / "project") as client:
        yield client


def test_a_page_that_is_not_built_is_an_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr("usd2kg.endpoint.app_files.files", lambda _: tmp_path)
    with pytest.raises(OutputError, match=r"index\.html is not built; install usd2kg from a wheel, or run make web"):
        read_app_files("index.html")


def test_one_decision_about_several_classes_is_undone_as_one(studio: Client):
    decide(studio, [TABLE, CUP_1, CUP_2], "confirm")
    assert states(studio) == ["suggested", "confirmed", "confirmed", "confirmed", "suggested"]
    assert studio.ask("api/states").json()["version"] == 1
    studio.ask("api/undo", {"reviewer": "Ann"})
    assert set(states(studio)) == {"suggested"}


def test_other_pages_hear_that_objects_were_grounded_again(studio: Client):
    decide(studio, [THING], "choose", **{"class": class_index(studio, "Cupboard")})
    request = urllib.request.Request(f"{studio.address}api/events?since=1")
    request.add_header("Authorization", f"Bearer {KEY}")
    with urllib.request.urlopen(request, timeout=30) as stream:
        assert stream.readline() == b": connected\n"
        threading.Timer(0.2, lambda: studio.ask("api/reground", {"reviewer": "Ann", "page": "p"})).start()
        assert next_event(stream, "suggestions") == {"reviewer": "Ann", "page": "p"}


def test_pages_hear_that_the_graph_was_written(studio: Client):
    cupboard = {"class": class_index(studio, "Cupboard")}
    request = urllib.request.Request(f"{studio.address}api/events?since=0")
    request.add_header("Authorization", f"Bearer {KEY}")
    with urllib.request.urlopen(request, timeout=60) as stream:
        assert stream.readline() == b": connected\n"
        threading.Timer(0.2, lambda: decide(studio, [TABLE], "choose", **cupboard)).start()
        outputs = next_event(stream, "outputs")
    assert outputs == studio.ask("api/states").json()["outputs"]
    assert "Cupboard" in studio.ask(f"api/object/{TABLE}").json()["turtle"]
