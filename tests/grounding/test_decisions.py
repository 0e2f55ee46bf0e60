"""Decisions and the review queue."""

import csv
from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest

from tests.grounding.records import make_object, make_scene
from usd2kg.errors import GroundingError
from usd2kg.grounding import (
    PERSON,
    Candidate,
    Decision,
    Grounding,
    ObjectView,
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


def test_a_decision_keeps_its_reviewer_and_the_prediction(home_tbox: TBox):
    knife, cup = home_tbox.resolve("Knife"), home_tbox.resolve("Cup")
    decision = Decision(knife, "https://orcid.org/0000-0001-2345-6789", "it cuts", "2026-07-15T12:00:00Z")
    scene = make_scene(make_object("/K/Cup"), make_object("/K/Bowl"), make_object("/K/Spoon"))
    (predicted, _, _) = ground(scene, home_tbox).predictions
    decided, other, asked = ground(
        scene, home_tbox, decisions={"/K/Cup": decision, "/K/Bowl": knife, "/elsewhere": knife}
    ).predictions
    assert decided.review == Review(
        decision.reviewer, cup, predicted.confidence, Status.GROUNDED, "it cuts", "2026-07-15T12:00:00Z"
    )
    assert (decided.class_iri, decided.confidence, decided.status) == (knife, 1.0, Status.REVIEWED)
    assert (decided.grounder, decided.candidates) == ("lexical", predicted.candidates)
    assert decided.explanation == f"decided by a person; predicted Cup: {predicted.explanation}"
    assert other.review is not None and (other.review.reviewer, other.class_iri) == ("", knife)
    assert (asked.class_iri, asked.review) == (home_tbox.resolve("Spoon"), None)


class RecordingGrounder:
    """A grounder that is not built in, whose answers may cost something."""

    name = "llm-B:scripted"
    is_calibrated = False
    settings: Mapping[str, str] = {}

    def __init__(self) -> None:
        self.asked: list[str] = []

    def ground_views(self, views: Sequence[tuple[str, ObjectView]], tbox: TBox) -> list[Prediction]:
        self.asked += [path for path, _ in views]
        return [Prediction(path, tbox.resolve("Bowl"), None, Status.GROUNDED, self.name, "") for path, _ in views]


def test_decided_objects_are_not_sent_to_a_language_model(home_tbox: TBox):
    knife, grounder = home_tbox.resolve("Knife"), RecordingGrounder()
    scene = make_scene(make_object("/K/Cup"), make_object("/K/Bowl"))
    decided, asked = ground(scene, home_tbox, grounder, decisions={"/K/Cup": Decision(knife, "Ada")}).predictions
    assert grounder.asked == ["/K/Bowl"]
    assert (decided.class_iri, decided.confidence, decided.grounder) == (knife, 1.0, PERSON)
    assert decided.review == Review("Ada", None, None, None)
    assert asked.class_iri == home_tbox.resolve("Bowl")


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
