"""Reading the classes of a run from mappings, queues and graphs."""

import json
from pathlib import Path

import pytest

from tests.graph.records import build_graph
from tests.scene.usda import METRES, component, cube
from tests.validation.broken import ROOM
from usd2kg.errors import GroundingError
from usd2kg.graph import GraphOptions, write_graph
from usd2kg.graph.vocabulary import U2K
from usd2kg.grounding import format_mapping, ground
from usd2kg.labels import read_prim_classes
from usd2kg.scene import read_scene

SOMA = "http://www.ease-crc.org/ont/SOMA.owl#"


@pytest.fixture
def rows(tmp_path, home_tbox):
    """A function that writes a CSV file and reads it as a run: path → (class, confidence, reviewed)."""

    def run(text):
        path = tmp_path / "run.csv"
        path.write_text(text, encoding="utf-8")
        return {
            a.prim_path: (a.class_iri, a.confidence, a.is_reviewed, a.status)
            for a in read_prim_classes(path, home_tbox).entries
        }

    return run


def test_a_mapping(rows):
    found = rows(
        "path,class,label,confidence,status,grounder\n"
        f"/Cup,{SOMA}Cup,cup,0.9,grounded,lexical\n/X,,,,refused,llm\n/B,soma:Bottle,bottle,1.0,reviewed,person\n"
    )
    assert found == {
        "/Cup": (f"{SOMA}Cup", 0.9, False, "grounded"),
        "/X": (None, None, False, "refused"),
        "/B": (f"{SOMA}Bottle", 1.0, True, "reviewed"),
    }


def test_gold_labels_and_a_queue(rows):
    assert rows("path,class,also\n/Cup,Cup,Bottle\n") == {"/Cup": (f"{SOMA}Cup", None, False, "grounded")}
    queue = "path,decision,answer,confidence\n/Cup,Cup,Bottle,0.3\n/B,,Bottle,0.4\n"
    assert rows(queue) == {"/Cup": (f"{SOMA}Cup", None, True, "reviewed"), "/B": (None, None, False, "undecided")}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("path,klass\n/A,Cup\n", "line 1 has the columns path, klass; expected CSV"),
        ("", "line 1 has the columns nothing"),
        ("path,class\n/A,Spoonish\n", "line 2: built-in home TBox: 'Spoonish' names no class"),
        ("path,class\n/A,Cup\n/A,Bottle\n", "line 3: /A has two classes; leave one"),
        ("path,class,confidence\n/A,Cup,high\n", "line 2: /A has the confidence 'high', expected a number"),
        ("path,class,confidence\n/A,Cup,nan\n", "line 2: /A has the confidence 'nan', expected a number from 0 to 1"),
        ("path,class,confidence\n/A,Cup,7\n", "line 2: /A has the confidence '7', expected a number from 0 to 1"),
        ("path,class,confidence\n/A,Cup,-0.1\n", "line 2: /A has the confidence '-0.1', expected a number"),
    ],
)
def test_bad_mappings_are_told_in_one_line(rows, text, message):
    with pytest.raises(GroundingError) as error:
        rows(text)
    assert message in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("annotations", ["owl", "rdf12"])
@pytest.mark.parametrize("profile", ["soma", "plain"])
def test_a_graph(home_tbox, tmp_path, profile, annotations):
    path = tmp_path / "room.ttl"
    write_graph(build_graph(home_tbox, ROOM, profile=profile, options=GraphOptions(annotations)), path)
    run = read_prim_classes(path, home_tbox)
    expected = {thing.prim_path: home_tbox.resolve(name) for thing, name in ROOM}
    assert {a.prim_path: a.class_iri for a in run.entries} == expected
    assert all(a.confidence is not None and a.status == "grounded" for a in run.entries)


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
        ('"/Cup"', '"NaN"', "room.ttl: /Cup has the confidence 'NaN', expected a number from 0 to 1"),
        ('"/Cup"', "7", "room.ttl: /Cup has the confidence '7', expected a number from 0 to 1"),
        ("<urn:p>", "0.5", 'room.ttl: <urn:a> has the prim path <urn:p>, expected a text such as "/World/Mug"'),
    ],
)
def test_odd_values_in_a_graph_are_told(home_tbox, tmp_path, monkeypatch, path, confidence, message):
    monkeypatch.chdir(tmp_path)
    Path("room.ttl").write_text(GRAPH.format(u2k=U2K.iri, soma=SOMA, path=path, confidence=confidence))
    with pytest.raises(GroundingError) as error:
        read_prim_classes(Path("room.ttl"), home_tbox)
    assert str(error.value) == message


def test_a_grounding_with_an_impossible_confidence(home_tbox, tmp_path, write_stage):
    path = tmp_path / "run.json"
    scene = read_scene(write_stage(METRES + component("Cup", cube("g"))))
    data = json.loads(format_mapping(ground(scene, home_tbox), home_tbox, "json"))
    data["predictions"][0]["confidence"] = 7
    path.write_text(json.dumps(data))
    with pytest.raises(GroundingError, match="has the confidence 7, expected a number from 0 to 1"):
        read_prim_classes(path, home_tbox)


def test_json_that_is_no_grounding(home_tbox, tmp_path):
    path = tmp_path / "run.json"
    path.write_text(json.dumps({"format": "other"}))
    with pytest.raises(GroundingError, match="cannot be read as a grounding"):
        read_prim_classes(path, home_tbox)
