"""Reading the class of each prim from mappings, queues, gold labels and graphs."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from tests.graph.records import build_graph
from tests.grounding.records import make_object, make_scene
from tests.labels.conftest import SOMA
from tests.scene.usda import METRES, component, cube
from tests.validation.broken import ROOM
from usd2kg.errors import GroundingError
from usd2kg.graph import GraphOptions, format_sssom, instantiate, write_graph
from usd2kg.graph.vocabulary import U2K
from usd2kg.grounding import format_mapping, ground
from usd2kg.labels import read_prim_classes
from usd2kg.ontology import load_places_tbox
from usd2kg.scene import read_scene


@pytest.fixture
def read_csv(tmp_path, home_tbox):
    """A function that writes a CSV file and reads it: path → (class, confidence, is reviewed, status)."""

    def run(text):
        path = tmp_path / "run.csv"
        path.write_text(text, encoding="utf-8")
        classes = read_prim_classes(path, home_tbox)
        return {e.prim_path: (e.class_iri, e.confidence, e.is_reviewed, e.status) for e in classes.entries}

    return run


def test_reads_a_mapping(read_csv):
    found = read_csv(
        "path,class,label,confidence,status,grounder\n"
        f"/Cup,{SOMA}Cup,cup,0.9,grounded,lexical\n/X,,,,refused,llm\n/B,soma:Bottle,bottle,1.0,reviewed,person\n"
    )
    assert found == {
        "/Cup": (f"{SOMA}Cup", 0.9, False, "grounded"),
        "/X": (None, None, False, "refused"),
        "/B": (f"{SOMA}Bottle", 1.0, True, "reviewed"),
    }


def test_reads_sssom(tmp_path, home_tbox):
    grounding = ground(make_scene(make_object("/Cup"), make_object("/B")), home_tbox, "lexical")
    first, second = grounding.predictions
    decided = replace(grounding, predictions=(first, second.reviewed(f"{SOMA}Bottle", "Ada", confidence=1.0)))
    path = tmp_path / "run.sssom.tsv"
    path.write_text(format_sssom(decided, home_tbox, {}), encoding="utf-8")
    cup, bottle = read_prim_classes(path, home_tbox).entries
    assert (cup.prim_path, cup.class_iri, cup.is_reviewed, cup.concept) == ("/Cup", f"{SOMA}Cup", False, "cup")
    assert cup.confidence == pytest.approx(first.confidence, abs=1e-4)
    assert (bottle.class_iri, bottle.status, bottle.is_reviewed) == (f"{SOMA}Bottle", "reviewed", True)


def test_reads_gold_labels(read_csv):
    assert read_csv("path,class,also\n/Cup,Cup,Bottle\n") == {"/Cup": (f"{SOMA}Cup", None, False, "grounded")}


def test_reads_decisions_of_a_queue_without_the_confidence_of_the_answer(read_csv):
    queue = "path,decision,answer,confidence\n/Cup,Cup,Bottle,0.3\n/B,,Bottle,0.4\n"
    assert read_csv(queue) == {"/Cup": (f"{SOMA}Cup", None, True, "reviewed"), "/B": (None, None, False, "undecided")}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("path,klass\n/A,Cup\n", "line 1 has the columns path, klass; expected CSV"),
        ("", "line 1 has the columns nothing"),
        ("path,class\n/A,Spoonish\n", "line 2: built-in home TBox: 'Spoonish' names no class"),
        ("path,class\n/A,Cup\n/A,Bottle\n", "line 3: /A has two classes; keep one"),
        ("path,class,confidence\n/A,Cup,high\n", "line 2: /A has the confidence 'high', expected a number from 0 to 1"),
        ("path,class,confidence\n/A,Cup,nan\n", "line 2: /A has the confidence 'nan', expected a number"),
        ("path,class,confidence\n/A,Cup,7\n", "line 2: /A has the confidence '7', expected a number"),
        ("path,class,confidence\n/A,Cup,-0.1\n", "line 2: /A has the confidence '-0.1', expected a number"),
    ],
)
def test_rejects_a_bad_mapping_with_its_line(read_csv, text, message):
    with pytest.raises(GroundingError) as error:
        read_csv(text)
    assert message in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("annotations", ["owl", "rdf12"])
@pytest.mark.parametrize("profile", ["soma", "plain"])
def test_reads_a_graph(home_tbox, tmp_path, profile, annotations):
    path = tmp_path / "room.ttl"
    write_graph(build_graph(home_tbox, ROOM, profile=profile, options=GraphOptions(annotations)), path)
    entries = read_prim_classes(path, home_tbox).entries
    expected = {obj.prim_path: home_tbox.resolve(name) for obj, name in ROOM}
    assert {entry.prim_path: entry.class_iri for entry in entries} == expected
    assert all(entry.confidence is not None and entry.status == "grounded" for entry in entries)


def test_a_graph_of_another_ontology_is_an_error(home_tbox, tmp_path):
    path = tmp_path / "room.ttl"
    write_graph(build_graph(load_places_tbox(), [(ROOM[0][0], "Pallet")]), path)
    with pytest.raises(
        GroundingError, match=r"Pallet, which the ontology .* lacks; give the ontology of these classes"
    ):
        read_prim_classes(path, home_tbox)


GRAPH = """@prefix owl: <http://www.w3.org/2002/07/owl#> . @prefix rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#> .
@prefix sssom: <https://w3id.org/sssom/> . @prefix u2k: <{u2k}> .
<urn:a> a <{soma}Cup> ; u2k:primPath {path} .
[] a owl:Axiom ; owl:annotatedSource <urn:a> ; owl:annotatedProperty rdf:type ; owl:annotatedTarget <{soma}Cup> ;
  sssom:confidence {confidence} .
"""


@pytest.mark.parametrize(
    ("path", "confidence", "message"),
    [
        ('"/Cup"', '"high"', "room.ttl: /Cup has the confidence 'high', expected a number from 0 to 1"),
        ("<urn:p>", "0.5", 'room.ttl: <urn:a> has the prim path <urn:p>, expected a text such as "/World/Mug"'),
    ],
)
def test_rejects_bad_values_in_a_graph(home_tbox, tmp_path, monkeypatch, path, confidence, message):
    monkeypatch.chdir(tmp_path)
    Path("room.ttl").write_text(GRAPH.format(u2k=U2K.iri, soma=SOMA, path=path, confidence=confidence))
    with pytest.raises(GroundingError) as error:
        read_prim_classes(Path("room.ttl"), home_tbox)
    assert str(error.value) == message


def test_rejects_an_impossible_confidence_in_a_grounding(home_tbox, tmp_path, write_stage):
    path = tmp_path / "run.json"
    scene = read_scene(write_stage(METRES + component("Cup", cube("g"))))
    data = json.loads(format_mapping(ground(scene, home_tbox), home_tbox, "json"))
    data["predictions"][0]["confidence"] = 7
    path.write_text(json.dumps(data))
    with pytest.raises(GroundingError, match="has the confidence 7, expected a number from 0 to 1"):
        read_prim_classes(path, home_tbox)


def test_rejects_json_that_is_not_a_grounding(home_tbox, tmp_path):
    path = tmp_path / "run.json"
    path.write_text(json.dumps({"format": "other"}))
    with pytest.raises(GroundingError, match="cannot be read as a grounding"):
        read_prim_classes(path, home_tbox)


@pytest.mark.parametrize("ending", ["csv", "json", "ttl"])
def test_reads_concepts(tmp_path, home_tbox, ending):
    scene = make_scene(make_object("/Room/couch_3"), make_object("/Room/Cube_7"))
    found = ground(scene, home_tbox)
    path = tmp_path / f"run.{ending}"
    if ending == "ttl":
        write_graph(instantiate(scene, home_tbox, found), path)
    else:
        path.write_text(format_mapping(found, home_tbox, ending), encoding="utf-8")
    classes = read_prim_classes(path, home_tbox)
    assert {entry.prim_path: entry.concept for entry in classes.entries} == {
        "/Room/couch_3": "sofa",
        "/Room/Cube_7": "",
    }
