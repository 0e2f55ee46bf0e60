"""A decision about a concept: its open objects at once, and a row of the alignment."""

from pathlib import Path

import pytest

from tests.studio.conftest import Client, running_studio
from tests.studio.test_application import CUP_1, CUP_2, FLOOR, TABLE, class_index, decide, states
from tests.studio.test_lessons import MORE
from usd2kg.grounding import ground, make_grounder
from usd2kg.ontology import load_home_tbox
from usd2kg.scene import read_scene

pytestmark = pytest.mark.studio


def concept_index(studio: Client, label: str) -> int:
    concepts = studio.ask("api/scene").json()["concepts"]
    return next(index for index, concept in enumerate(concepts) if concept["label"] == label)


def test_a_concept_is_decided_as_one_event_and_undone(studio: Client):
    bowl, cup = class_index(studio, "Bowl"), concept_index(studio, "cup")
    reply = decide(studio, [CUP_1, CUP_2], "choose", concept=cup, **{"class": bowl})
    assert [state["class"] for state in reply["states"]] == [bowl, bowl]
    assert reply["version"] == 1
    assert studio.ask(f"api/object/{CUP_1}").json()["history"][0]["concept"] == cup
    (row,) = [line for line in lessons(studio).splitlines() if line.startswith("wn:") and "\tcup\t" in line]
    assert "soma:Bowl" in row
    assert "semapv:ManualMappingCuration" in row
    assert "\tAnn\t" in row
    assert "decided for the concept, with 2 objects" in row
    studio.ask("api/undo", {"reviewer": "Ann"})
    assert states(studio)[CUP_1] == states(studio)[CUP_2] == "suggested"
    assert "Bowl" not in lessons(studio)
    studio.ask("api/redo", {"reviewer": "Ann"})
    assert "Bowl" in lessons(studio)


def lessons(studio: Client) -> str:
    return studio.ask("api/export/lessons.sssom.tsv").body.decode()


def test_an_exception_does_not_change_what_holds_for_the_concept(studio: Client):
    bowl, glass = class_index(studio, "Bowl"), class_index(studio, "Glass")
    decide(studio, [CUP_1], "choose", **{"class": glass})
    decide(studio, [CUP_2], "choose", concept=concept_index(studio, "cup"), **{"class": bowl})
    assert "Bowl" in lessons(studio)
    assert "Glass" not in lessons(studio)


def test_the_next_scene_is_grounded_with_it_after_a_restart(tmp_path: Path):
    (tmp_path / "scene.usda").write_text(MORE)
    folder = tmp_path / "project"
    with running_studio(tmp_path / "scene.usda", folder) as studio:
        paths = studio.ask("api/scene").json()["objects"]["path"]
        cup = concept_index(studio, "cup")
        decide(studio, [paths.index("/Kitchen/Cup_2")], "choose", concept=cup, **{"class": class_index(studio, "Bowl")})
    with running_studio(tmp_path / "scene.usda", folder) as studio:
        # It decides about objects only when a person says so: the exception keeps its suggestion.
        state = studio.ask("api/states").json()["states"][paths.index("/Kitchen/Cup_1")]
        assert (state["state"], state["class"]) == ("suggested", class_index(studio, "Cup"))
        assert studio.ask(f"api/object/{paths.index('/Kitchen/Cup_2')}").json()["history"][0]["concept"] == cup
    tbox, scene = load_home_tbox(), read_scene(tmp_path / "scene.usda")
    found = ground(scene, tbox, make_grounder("lexical", alignment=folder / "lessons.sssom.tsv")).by_path
    assert {found[f"/Kitchen/{name}"].class_iri for name in ("Cup_1", "Cup_2")} == {tbox.resolve("Bowl")}
    assert found["/Kitchen/Table"].class_iri == tbox.resolve("Table")


@pytest.mark.parametrize(
    ("objects", "action", "concept", "message"),
    [
        ([CUP_1], "choose", 9999, "field concept: 9999; expected a concept"),
        ([CUP_1], "choose", -2, "field concept: -2; expected a concept"),
        ([CUP_1], "no-class", 0, "with the action choose"),
        ([CUP_1, TABLE], "choose", None, "/Kitchen/Table: has another concept"),
        ([FLOOR], "choose", "x", "field concept: found str, expected int"),
    ],
)
def test_a_concept_that_is_not_that_of_the_objects_is_refused(
    studio: Client, objects: list[int], action: str, concept: object, message: str
):
    chosen = concept_index(studio, "cup") if concept is None else concept
    body = {"objects": objects, "action": action, "concept": chosen, "class": 0, "reviewer": "Ann"}
    reply = studio.ask("api/decisions", body)
    assert reply.status == 400
    assert message in reply.json()["error"]
