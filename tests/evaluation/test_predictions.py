"""Answers of other methods, read from files."""

from pathlib import Path

import pytest

from tests.evaluation.records import E, grounding_of, label, small_tbox
from tests.grounding.records import make_object, make_scene
from usd2kg.errors import EvaluationError, GroundingError
from usd2kg.evaluation import evaluation_json, read_predictions, score_grounding
from usd2kg.grounding import Status, format_mapping

TBOX = small_tbox()
SCENE = make_scene(make_object("/a"), make_object("/b"))
SSSOM = (
    "#curie_map:\n#  t: http://example.org/t#\n"
    "prim_path\tpredicate_id\tobject_id\tmapping_justification\tconfidence\tpredicate_modifier\n"
    "/a\trdf:type\tt:Cup\tsemapv:LexicalMatching\t0.7\t\n"
    "/a\trdf:type\tt:Wall\tsemapv:LexicalMatching\t0.7\tNot\n"
    "/b\trdf:type\tsssom:NoTermFound\tsemapv:LexicalMatching\t\t\n"
)


def _write(tmp_path: Path, text: str, name: str = "mine.csv") -> Path:
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("mine.csv", f"path,class,confidence\n/a,Cup,0.7\n/b,,\n,Cup,\n/c,<{E}Bowl>,\n"),
        ("mine.tsv", SSSOM + "/c\trdf:type\tt:Bowl\tsemapv:LexicalMatching\t\t\n"),
    ],
)
def test_reads_answers_with_confidences(tmp_path: Path, name: str, text: str) -> None:
    found = read_predictions(str(_write(tmp_path, text, name)), SCENE, TBOX)
    assert [(p.prim_path, p.class_iri, p.confidence, p.status) for p in found.predictions] == [
        ("/a", E + "Cup", 0.7, Status.GROUNDED),
        ("/b", None, None, Status.REFUSED),
        ("/c", E + "Bowl", None, Status.GROUNDED),
    ]
    assert (found.grounder, found.scene_hash, found.ontology_hash) == (name, SCENE.content_hash, TBOX.content_hash)
    assert {p.grounder for p in found.predictions} == {name}


def test_reads_the_json_of_a_grounding(tmp_path: Path) -> None:
    text = format_mapping(grounding_of({"/a": "Cup", "/b": None}), TBOX, "json")
    found = read_predictions(_write(tmp_path, text, "mine.json"), SCENE, TBOX)
    assert [(p.class_iri, p.confidence, p.grounder) for p in found.predictions] == [
        (E + "Cup", 0.8, "mine.json"),
        (None, None, "mine.json"),
    ]
    with pytest.raises(
        EvaluationError, match=r"the class .*Cup of /a is not in scope; give the ontology of the answers"
    ):
        read_predictions(_write(tmp_path, text.replace("t#Cup", "u#Cup"), "mine.json"), SCENE, TBOX)
    with pytest.raises(GroundingError, match="cannot be read as a grounding"):
        read_predictions(_write(tmp_path, "{}", "mine.json"), SCENE, TBOX)


def test_objects_without_a_row_count_as_wrong(tmp_path: Path) -> None:
    found = read_predictions(_write(tmp_path, "path,class\n/a,Cup\n"), SCENE, TBOX)
    data = evaluation_json(score_grounding(found, [label("/a", "Cup"), label("/b", "Bowl")], TBOX))
    assert (data["ema"], data["answered"], data["seconds"]) == (50.0, 1, None)
    assert [score["status"] for score in data["scores"]] == ["grounded", "missing"]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("prim,class\n/a,Cup\n", r"line 1 has the columns prim, class; expected CSV with the columns path and class"),
        ("", r"line 1 has the columns nothing"),
        (
            "path,class\n/a,Mug\n",
            r"line 2: .*'Mug' names no class of the 7 in scope.*; leave the cell empty for no answer",
        ),
        ("path,class,confidence\n/a,Cup,70\n", r"line 2: the confidence is '70'; expected a number from 0 to 1, or an"),
        ("path,class,confidence\n/a,Cup,high\n", r"line 2: the confidence is 'high'"),
        ("path,class\n/a,Cup\n/a,Bowl\n", r"/a has more than one row; expected one row per prim"),
    ],
)
def test_rejects_malformed_answers_with_their_line(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(EvaluationError, match=said):
        read_predictions(_write(tmp_path, text), SCENE, TBOX)


def test_rejects_a_missing_file(tmp_path: Path) -> None:
    with pytest.raises(EvaluationError, match=r"none\.csv: cannot be read as answers"):
        read_predictions(tmp_path / "none.csv", SCENE, TBOX)
