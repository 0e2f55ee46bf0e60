"""Decisions and the review queue."""

import csv
from pathlib import Path

import pytest

from tests.grounding.records import make_object, make_scene
from usd2kg.errors import GroundingError
from usd2kg.grounding import (
    PERSON,
    Candidate,
    Decision,
    Grounding,
    Prediction,
    Review,
    Status,
    find_uncertain,
    format_queue,
    ground,
    read_decisions,
)
from usd2kg.ontology import TBox


def prediction(path: str, iri: str | None, confidence: float | None, *others: str, why: str = "so") -> Prediction:
    status = Status.GROUNDED if iri else Status.FAILED
    candidates = tuple(Candidate(other, 0.5) for other in ((iri, *others) if iri else ()))
    return Prediction(path, iri, confidence, status, "lexical", why, candidates=candidates)


def grounding_of(*predictions: Prediction) -> Grounding:
    return Grounding("s", "h", "o", "h", "lexical", {}, True, "0", predictions)


def test_reads_a_completed_queue_as_decisions(home_tbox: TBox, tmp_path: Path):
    cup, bowl, box = (home_tbox.resolve(name) for name in ("Cup", "Bowl", "Box"))
    found = grounding_of(
        prediction("/a", cup, 0.95),
        prediction("/b", bowl, 0.4, cup, box, why="=HYPERLINK(evil)"),
        prediction("/c", None, None),
        prediction("/d", box, 0.1),
        Prediction("/gone", None, None, Status.MISSING, "lexical", "there is no such prim"),
    )
    queue = find_uncertain(found, 0.6)
    assert [p.prim_path for p in queue] == ["/c", "/d", "/b"]
    text = format_queue(queue, home_tbox)
    rows = list(csv.DictReader(text.splitlines()))
    assert rows[2] == {
        "path": "/b",
        "decision": "",
        "reviewer": "",
        "comment": "",
        "answer": "Bowl",
        "confidence": "0.4000",
        "alternatives": "Cup|Box",
        "explanation": "'=HYPERLINK(evil)",
    }
    assert rows[0]["answer"] == rows[0]["confidence"] == ""
    file = tmp_path / "queue.csv"
    file.write_text(text.replace("/c,,,", "/c,Plate,Ada,it is flat").replace("/b,,", f"/b,{cup},"), "utf-8")
    assert read_decisions(file, home_tbox) == {
        "/c": Decision(home_tbox.resolve("Plate"), "Ada", "it is flat"),
        "/b": Decision(cup),
    }


def test_a_decision_keeps_its_reviewer(home_tbox: TBox):
    knife = home_tbox.resolve("Knife")
    decision = Decision(knife, "https://orcid.org/0000-0001-2345-6789", "it cuts", "2026-07-15T12:00:00Z")
    scene = make_scene(make_object("/K/Cup"), make_object("/K/Bowl"))
    decided, other = ground(scene, home_tbox, decisions={"/K/Cup": decision, "/K/Bowl": knife}).predictions
    assert decided.review == Review(decision.reviewer, None, None, None, "it cuts", "2026-07-15T12:00:00Z")
    assert other.review is None


def test_decided_objects_are_not_passed_to_the_grounder(home_tbox: TBox):
    knife = home_tbox.resolve("Knife")
    scene = make_scene(make_object("/K/Cup"), make_object("/K/Bowl"))
    found = ground(scene, home_tbox, decisions={"/K/Cup": knife, "/elsewhere": knife})
    assert [p.prim_path for p in found.predictions] == ["/K/Cup", "/K/Bowl"]
    decided, asked = found.predictions
    assert (decided.class_iri, decided.confidence, decided.grounder) == (knife, 1.0, PERSON)
    assert asked.class_iri == home_tbox.resolve("Bowl")
    assert asked.grounder == "lexical"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("prim,class\n/a,Cup\n", "line 1 has the columns prim, class"),
        ("path,decision\n/a,Cups\n", "line 2: .*Cups"),
        ("path,class\n/a,Cup\n/a,Bowl\n", "line 3: /a has two decisions"),
        ("", "line 1 has the columns nothing"),
    ],
)
def test_reports_invalid_files_with_the_line(home_tbox: TBox, tmp_path: Path, text: str, message: str):
    file = tmp_path / "decisions.csv"
    file.write_text(text, "utf-8")
    with pytest.raises(GroundingError, match=message):
        read_decisions(file, home_tbox)


def test_reports_a_missing_file(home_tbox: TBox, tmp_path: Path):
    with pytest.raises(GroundingError, match="cannot be read as decisions"):
        read_decisions(tmp_path / "none.csv", home_tbox)
