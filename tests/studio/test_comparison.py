"""A scene compared with another version, another graph and other mappings, over HTTP."""

import json
from pathlib import Path
from typing import Any

import pytest

from tests.studio.conftest import KEY, STAGE, Client, Studio, needs_page, running_studio
from usd2kg.graph import format_sssom, write_graph
from usd2kg.grounding import format_mapping
from usd2kg.pipeline import build

pytestmark = pytest.mark.studio
FLOOR, TABLE, CUP_1, CUP_2, THING = range(5)

EARLIER = (
    # Cup_2 was 0.3 m to the left, a plate lay on the table, and there was no Zxqv.
    STAGE.replace("(-0.2, 0, 0.75)", "(-0.2, 0.3, 0.75)")
    .replace('"Zxqv"', '"Plate"')
    .replace("(1.5, 1.5, 0.15)", "(-1.5, -1.5, 0.15)")
    .replace("double size = 0.3", "double size = 0.4")
)


@pytest.fixture(scope="module")
def earlier(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("earlier") / "kitchen.usda"
    path.write_text(EARLIER)
    return path


def comparison(client: Client) -> Any:
    reply = client.ask("api/comparison")
    assert reply.status == 200, reply.body
    return reply.json()


def by_path(found: Any) -> dict[str, Any]:
    return {change["path"]: change for change in found["changes"]}


@pytest.mark.parametrize("form", ["usda", "ttl", "nq"])
def test_two_versions_of_a_scene(stage: Path, earlier: Path, form: str, tmp_path: Path):
    other = earlier
    if form != "usda":
        other = tmp_path / f"earlier.{form}"
        write_graph(build(earlier).graph, other)
    with running_studio(stage, tmp_path / "project", compared=other) as client:
        assert client.ask("api/scene").json()["has_comparison"]
        found = comparison(client)
        changes = by_path(found)
        assert found["source"] == ("stage" if form == "usda" else "graph")
        assert found["counts"] == {"appeared": 1, "disappeared": 1, "moved": 1}
        assert found["unchanged"] == 3
        gone = changes["/Kitchen/Plate"]
        assert (gone["kinds"], gone["object"], gone["after"]) == (["disappeared"], -1, None)
        assert gone["box_before"] == pytest.approx([-1.7, -1.7, -0.05, -1.3, -1.3, 0.35], abs=1e-4)
        assert gone["before"]["label"] == "plate"
        assert 0 < gone["before"]["confidence"] <= 1
        moved = changes["/Kitchen/Cup_2"]
        assert (moved["kinds"], moved["object"]) == (["moved"], CUP_2)
        assert moved["distance_m"] == pytest.approx(0.3, abs=1e-4)
        assert moved["box_before"][1::3] == pytest.approx([0.26, 0.34], abs=1e-4)
        new = changes["/Kitchen/Zxqv"]
        assert (new["kinds"], new["object"], new["before"]) == (["appeared"], THING, None)


def test_decisions_are_compared_too(stage: Path, tmp_path: Path):
    same = tmp_path / "same.ttl"
    write_graph(build(stage).graph, same)
    with running_studio(stage, tmp_path / "project", compared=same) as client:
        assert comparison(client)["counts"] == {}
        classes = client.ask("api/scene").json()["classes"]
        plate = next(index for index, cls in enumerate(classes) if cls["name"] == "Plate")
        body = {"objects": [CUP_1], "action": "choose", "class": plate, "reviewer": "Ann"}
        assert client.ask("api/decisions", body).status == 200
        found = comparison(client)
        assert found["version"] == 1
        change = by_path(found)["/Kitchen/Cup_1"]
        assert "class" in change["kinds"]
        assert (change["before"]["label"], change["before"]["is_decided"]) == ("cup", False)
        assert change["after"] == {"class": plate, "label": "plate", "confidence": None, "is_decided": True}
        assert client.ask("api/undo", {"reviewer": "Ann"}).status == 200
        assert "class" not in comparison(client)["counts"]


@pytest.mark.parametrize("form", ["json", "sssom.tsv"])
def test_the_mapping_of_another_run(stage: Path, form: str, tmp_path: Path):
    built = build(stage, grounder="dictionary")
    mapping = tmp_path / f"mapping.{form}"
    if form == "json":
        data = json.loads(format_mapping(built.grounding, built.tbox, "json"))
    else:
        rows = format_sssom(built.grounding, built.tbox, {}).splitlines(keepends=True)
        mapping.write_text("".join(row for row in rows if "/Kitchen/Cup_2" not in row))
    wrong = built.tbox.resolve("Plate")
    if form == "json":
        data["predictions"][TABLE] |= {"class_iri": wrong, "confidence": 0.4, "status": "grounded"}
        data["predictions"].append({**data["predictions"][TABLE], "prim_path": "/Kitchen/Elsewhere"})
        mapping.write_text(json.dumps(data))
    with running_studio(stage, tmp_path / "project", compared=mapping) as client:
        found = comparison(client)
        assert found["source"] == "mapping"
        assert {"appeared", "disappeared", "moved"}.isdisjoint(found["counts"])
        if form == "json":
            table = by_path(found)["/Kitchen/Table"]
            assert (table["kinds"], table["object"]) == (["class"], TABLE)
            assert (table["before"]["label"], table["before"]["confidence"]) == ("plate", 0.4)
            assert table["after"]["label"] == "table"
            assert found["notes"] == ["Rows of the mapping about prims that are not objects of this scene: 1"]
        else:
            assert found["notes"] == ["Not compared, since the mapping has no row for them: 1"]
            assert "/Kitchen/Cup_2" not in by_path(found)


def test_a_journal_of_decisions_is_a_mapping(stage: Path, tmp_path: Path):
    with running_studio(stage, tmp_path / "first") as client:
        body = {"objects": [CUP_1], "action": "no-class", "reviewer": "Bob"}
        assert client.ask("api/decisions", body).status == 200
        assert client.ask("api/decisions", {**body, "objects": [CUP_2], "action": "unsure"}).status == 200
    with running_studio(stage, tmp_path / "second", compared=tmp_path / "first" / "decisions.sssom.tsv") as client:
        found = comparison(client)
        assert found["counts"] == {"class": 1}
        change = by_path(found)["/Kitchen/Cup_1"]
        assert change["before"] == {"class": -1, "label": "", "confidence": None, "is_decided": True}
        assert change["after"]["label"] == "cup"


def test_without_compare_there_is_no_comparison(studio: Client):
    assert not studio.ask("api/scene").json()["has_comparison"]
    assert studio.ask("api/comparison").status == 404


@needs_page
def test_the_command_compares(stage: Path, earlier: Path, tmp_path: Path):
    studio = Studio(str(stage), "--project", str(tmp_path / "p"), "--compare", str(earlier), key=KEY)
    try:
        assert comparison(studio)["counts"]["disappeared"] == 1
    finally:
        studio.stop()
