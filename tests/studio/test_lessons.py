"""What decisions teach, and grounding again with it."""

from pathlib import Path

import pytest

from tests.studio.conftest import STAGE, running_studio
from usd2kg.grounding import Decision, ground, make_grounder
from usd2kg.ontology import load_home_tbox, load_tbox
from usd2kg.scene import read_scene
from usd2kg.studio.lessons import find_lessons, format_lessons

MORE = STAGE.replace(
    'def Cube "Zxqv"',
    'def Cube "Zxqv_2" (kind = "component")\n    {\n        double size = 0.2\n    }\n    def Cube "Zxqv"',
).replace('def Cylinder "Cup_2"', 'def Cylinder "Mug" (kind = "component") {}\n    def Cylinder "Cup_2"')

TABLETS = MORE.replace(
    'def Cylinder "Mug" (kind = "component") {}',
    'def Cube "Tablet_1" (kind = "component") {}\n    def Cube "Tablet_2" (kind = "component") {}',
)


def test_unanimous_decisions_teach_concepts_and_words(tmp_path: Path):
    (tmp_path / "scene.usda").write_text(MORE)
    scene, tbox = read_scene(tmp_path / "scene.usda"), load_home_tbox()
    suggestions = ground(scene, tbox)
    bowl, glass, cupboard = (tbox.resolve(name) for name in ("Bowl", "Glass", "Cupboard"))
    decisions = {
        "/Kitchen/Cup_2": Decision(bowl, "Ann"),
        "/Kitchen/Zxqv": Decision(cupboard, "Bob"),
        "/Kitchen/Floor": Decision(None, "Ann"),
    }
    lessons = find_lessons(suggestions, decisions, scene)
    assert [(lesson.label, lesson.class_iri, lesson.objects) for lesson in lessons] == [
        ("cup", bowl, 1),
        ("floor", None, 1),
        ("zxqv", cupboard, 1),
    ]
    contradiction = {"/Kitchen/Zxqv": Decision(cupboard, "Ann"), "/Kitchen/Zxqv_2": Decision(glass, "Ann")}
    assert find_lessons(suggestions, contradiction, scene) == []


def test_lessons_are_an_alignment(tmp_path: Path):
    (tmp_path / "scene.usda").write_text(MORE)
    scene, tbox = read_scene(tmp_path / "scene.usda"), load_home_tbox()
    cupboard, bowl = tbox.resolve("Cupboard"), tbox.resolve("Bowl")
    decisions = {"/Kitchen/Zxqv": Decision(cupboard, "Ann"), "/Kitchen/Cup_2": Decision(bowl, "Ann|x")}
    lessons = find_lessons(ground(scene, tbox), decisions, scene)
    (tmp_path / "lessons.tsv").write_text(format_lessons(lessons, tbox))
    again = ground(scene, tbox, make_grounder("lexical", alignment=tmp_path / "lessons.tsv")).by_path
    assert again["/Kitchen/Zxqv_2"].class_iri == cupboard
    assert again["/Kitchen/Cup_2"].class_iri == bowl
    assert again["/Kitchen/Table"].class_iri == tbox.resolve("Table")


def test_no_class_teaches_what_a_concept_is_not(tmp_path: Path):
    (tmp_path / "scene.usda").write_text(TABLETS)
    scene, tbox = read_scene(tmp_path / "scene.usda"), load_home_tbox()
    suggestions, appliance = ground(scene, tbox), tbox.resolve("Appliance")
    assert suggestions.by_path["/Kitchen/Tablet_1"].class_iri == appliance
    lessons = find_lessons(suggestions, {"/Kitchen/Tablet_2": Decision(None, "Ann")}, scene)
    assert [(lesson.label, lesson.class_iri, lesson.rejected) for lesson in lessons] == [("tablet", None, (appliance,))]
    (tmp_path / "lessons.tsv").write_text(format_lessons(lessons, tbox))
    again = ground(scene, tbox, make_grounder("lexical", alignment=tmp_path / "lessons.tsv")).by_path
    assert again["/Kitchen/Tablet_1"].class_iri != appliance
    assert again["/Kitchen/Table"].class_iri == tbox.resolve("Table")


def test_without_a_general_class_no_class_stays_no_class(tmp_path: Path):
    (tmp_path / "scene.usda").write_text(MORE)
    (tmp_path / "tbox.ttl").write_text("""
        @prefix : <http://example.org/> . @prefix owl: <http://www.w3.org/2002/07/owl#> .
        @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
        :Cup a owl:Class ; rdfs:label "cup" . :Table a owl:Class ; rdfs:label "table" .
        :Floor a owl:Class ; rdfs:label "floor" .
    """)
    scene, tbox = read_scene(tmp_path / "scene.usda"), load_tbox(tmp_path / "tbox.ttl")
    lessons = find_lessons(ground(scene, tbox), {"/Kitchen/Cup_2": Decision(None, "Ann")}, scene)
    (tmp_path / "lessons.tsv").write_text(format_lessons(lessons, tbox))
    again = ground(scene, tbox, make_grounder("lexical", alignment=tmp_path / "lessons.tsv")).by_path
    assert again["/Kitchen/Cup_1"].class_iri is None
    assert again["/Kitchen/Table"].class_iri == "http://example.org/Table"


@pytest.mark.studio
def test_the_studio_grounds_again_after_no_class_fits(tmp_path: Path):
    (tmp_path / "scene.usda").write_text(TABLETS)
    folder = tmp_path / "project"
    with running_studio(tmp_path / "scene.usda", folder) as client:
        data = client.ask("api/scene").json()
        one, two = (data["objects"]["path"].index(f"/Kitchen/Tablet_{number}") for number in (1, 2))
        client.ask("api/decisions", {"objects": [one], "action": "no-class", "reviewer": "Ann"})
        reply = client.ask("api/reground", {"reviewer": "Ann", "page": "p"})
        assert reply.status == 200, reply.body
        assert [change["object"] for change in reply.json()["changes"]] == [two]
        states = reply.json()["states"]
    with running_studio(tmp_path / "scene.usda", folder) as client:
        assert client.ask("api/states").json()["states"] == states
    assert sorted(path.name for path in folder.glob("*tried*")) == []


@pytest.mark.studio
def test_the_studio_grounds_again_what_is_open(tmp_path: Path):
    (tmp_path / "scene.usda").write_text(MORE)
    folder = tmp_path / "project"
    with running_studio(tmp_path / "scene.usda", folder) as client:
        data = client.ask("api/scene").json()
        paths = data["objects"]["path"]
        one, two = paths.index("/Kitchen/Zxqv"), paths.index("/Kitchen/Zxqv_2")
        cupboard = next(i for i, cls in enumerate(data["classes"]) if cls["name"] == "Cupboard")
        body = {"objects": [one], "action": "choose", "class": cupboard, "reviewer": "Ann"}
        before = client.ask("api/decisions", body).json()["states"][0]
        reply = client.ask("api/reground", {"reviewer": "Ann", "page": "p"}).json()
        assert [(change["object"], change["after"]) for change in reply["changes"]] == [(two, cupboard)]
        assert reply["states"][two]["class"] == cupboard
        # The decided object keeps what was suggested before, so that the correction stays one.
        assert reply["states"][one] == before
    with running_studio(tmp_path / "scene.usda", folder) as client:
        assert client.ask("api/states").json()["states"] == reply["states"]
        assert "Cupboard" in client.ask("api/export/lessons.sssom.tsv").body.decode()
