"""The order by disagreement with a second grounder, and its answers on the pages of objects."""

from dataclasses import replace
from pathlib import Path

import pytest

from tests.studio.conftest import Client, running_studio
from tests.studio.test_application import CUP_1, CUP_2, FLOOR, TABLE, THING, class_index, decide
from usd2kg.errors import GroundingError
from usd2kg.grounding import Prediction, Status, format_mapping, ground
from usd2kg.ontology import load_home_tbox
from usd2kg.scene import read_scene
from usd2kg.studio import ProjectSources, open_project
from usd2kg.studio.open_session import open_session

pytestmark = pytest.mark.studio


def write_second(stage: Path, target: Path) -> Path:
    """Write a mapping in which the cups are bowls, the table has no class, and the call about the floor failed."""
    tbox = load_home_tbox()
    found = ground(read_scene(stage), tbox)
    bowl = tbox.resolve("Bowl")

    def change(prediction: Prediction) -> Prediction:
        name = prediction.prim_path.rpartition("/")[2]
        if name.startswith("Cup"):
            return replace(prediction, class_iri=bowl, confidence=0.5, candidates=(), explanation="it is round")
        if name in {"Table", "Floor"}:
            status = Status.REFUSED if name == "Table" else Status.FAILED
            return replace(prediction, class_iri=None, confidence=None, status=status, candidates=())
        return prediction

    second = replace(found, grounder="other", predictions=tuple(map(change, found.predictions)))
    target.write_text(format_mapping(second, tbox, "json"))
    return target


def test_the_queue_begins_with_the_largest_disputed_group(stage: Path, tmp_path: Path):
    folder = tmp_path / "project"
    with running_studio(stage, folder, second=write_second(stage, tmp_path / "second.json")) as studio:
        assert studio.ask("api/scene").json()["second_grounder"] == "other"
        groups = studio.ask("api/queue?order=disagreement").json()["groups"]
        bowl = class_index(studio, "Bowl")
        found = [(sorted(group["objects"]), group["is_disputed"], group["second"]) for group in groups]
        assert found[:2] == [([CUP_1, CUP_2], True, bowl), ([TABLE], True, -1)]
        # A failed call is not an answer; the rest is in the order of expected gain.
        assert [row for row in found[2:] if row[1]] == []
        assert found[2][0] == [THING]
        second = studio.ask(f"api/object/{CUP_1}").json()["second"]
        assert second == {
            "grounder": "other",
            "class": bowl,
            "confidence": 0.5,
            "explanation": "it is round",
            "is_disputed": True,
        }
        assert not studio.ask(f"api/object/{FLOOR}").json()["second"]["is_disputed"]
        decide(studio, [CUP_1, CUP_2], "confirm")
        left = studio.ask("api/queue?order=disagreement").json()["groups"]
        assert left[0]["objects"] == [TABLE]
    # The project remembers it.
    with open_project(folder) as project:
        assert project.sources.second_mapping == tmp_path / "second.json"


def test_without_a_second_mapping_there_is_no_such_order(studio: Client):
    assert studio.ask("api/scene").json()["second_grounder"] == ""
    assert studio.ask(f"api/object/{CUP_1}").json()["second"] is None
    reply = studio.ask("api/queue?order=disagreement")
    assert reply.status == 400
    assert "order 'disagreement' is unknown" in reply.json()["error"]


def test_a_second_mapping_of_another_scene_is_refused(stage: Path, tmp_path: Path):
    second = write_second(stage, tmp_path / "second.json")
    second.write_text(second.read_text().replace("/Kitchen/Cup_1", "/Kitchen/Pot"))
    sources = ProjectSources(stage, second_mapping=second)
    with (
        open_project(tmp_path / "p", sources) as project,
        pytest.raises(GroundingError, match="no row for /Kitchen/Cup_1"),
    ):
        open_session(project)
