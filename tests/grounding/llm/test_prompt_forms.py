"""benchmarks.llm.forms and benchmarks.llm.calibration with a fake model in this process."""

import argparse
import math
import sys
from pathlib import Path

import pytest

from benchmarks.labelled_scenes import LabelledScene
from benchmarks.llm.calibration import brier_score, read_form, row_of
from benchmarks.llm.forms import FORMS, Record, ask_default_grounder, ask_form, examples_for, spaced
from benchmarks.llm.forms_table import Outcome, print_table
from tests.grounding.llm.local.fake_xllamacpp import FakeXllamacpp
from tests.grounding.records import make_class, make_object, make_scene, make_tbox
from usd2kg.evaluation.gold import GoldLabel
from usd2kg.evaluation.score import Score
from usd2kg.grounding import Status
from usd2kg.ontology import load_home_tbox

TBOX = make_tbox(make_class("Cup"), make_class("Table"), make_class("Cupboard"))
CUP, TABLE, CUPBOARD = (cls.iri for cls in TBOX.classes)
LABELS = {"mug": CUP, "desk": TABLE, "beaker": CUP, "pantry": CUPBOARD}


def labelled(name: str, *objects: str) -> LabelledScene:
    paths = [f"/{name}/{one}" for one in objects]
    gold = tuple(GoldLabel(path, LABELS[one], frozenset()) for path, one in zip(paths, objects, strict=True))
    return LabelledScene(name, make_scene(*map(make_object, paths)), gold, TBOX)


ROOM, HALL = labelled("Room", "mug", "desk", "beaker"), labelled("Hall", "desk", "pantry")


def test_asks_what_the_record_lacks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    weights = tmp_path / "model.gguf"
    weights.write_bytes(b"GGUF")
    library = FakeXllamacpp(lambda text: {"C": 0.9, '"': 0.1} if text.endswith('"class": "') else {'"': 0.9})
    monkeypatch.setitem(sys.modules, "llama_cpp", None)
    monkeypatch.setitem(sys.modules, "xllamacpp", library)
    options = argparse.Namespace(objects=2, listed_objects=None, record=tmp_path / "record.jsonl")
    record = Record(options.record)
    for outcome in ask_form(f"gguf:{weights}", "A, all classes", [ROOM], record, options):
        record.add(outcome)

    again = Record(options.record)
    outcomes = list(ask_form(f"gguf:{weights}", "A, all classes", [ROOM, HALL], again, options))

    assert again.outcomes == record.outcomes
    assert [(one.model, one.scene) for one in (*again.outcomes, *outcomes)] == [
        ("model.gguf", "Room"),
        ("model.gguf", "Hall"),
    ]
    assert again.outcomes[0].answers == {"/Room/mug": CUP, "/Room/desk": CUP}
    assert again.outcomes[0].input_tokens > again.outcomes[0].cached_tokens > 0

    (stored,) = ask_form(f"gguf:{weights}", "A, all classes", [ROOM], Record(tmp_path / "new.jsonl"), options)
    assert (stored.input_tokens, stored.answers) == (record.outcomes[0].input_tokens, record.outcomes[0].answers)
    assert math.isnan(stored.seconds), "nothing was computed"

    monkeypatch.delitem(sys.modules, "xllamacpp")
    scores = list(read_form(f"gguf:{weights}", FORMS["A, all classes"], ROOM, [ROOM, HALL], options))
    assert [(score.id, score.is_exact) for score in scores] == [("/Room/mug", True), ("/Room/desk", False)]
    assert all(0 < (score.confidence or 0) <= 1 for score in scores)


def test_a_row_has_the_accuracy_of_all_scenes(capsys: pytest.CaptureFixture[str]):
    answers = {"Room": {"/Room/mug": CUP, "/Room/desk": CUP, "/Room/beaker": CUP}, "Hall": {"/Hall/desk": None}}
    base = [Outcome("m", "A", name, 60, 20, 9, 6.0, found) for name, found in answers.items()]
    other = [Outcome("m", "B", "Room", 60, 0, 9, 6.0, answers["Room"] | {"/Room/mug": TABLE})]

    print_table([*base, *other], [ROOM, HALL], {"A": "A", "B": "A"})

    _, _, first, second = capsys.readouterr().out.splitlines()
    # 2 of 4 and 1 of 3, with Wilson's intervals.
    assert first.startswith("| m | A | 4 | 30, 10 | 3.0 | 2 of 3 | 0 of 1 | 50 (15–85) | 50 | ") and first.endswith(
        "| 0 |"
    )
    assert second.startswith("| m | B | 3 | 20, 0 | 2.0 | 1 of 3 | – | 33 (6–79) | 33 | ") and second.endswith("| 1 |")


def test_a_calibration_is_tested_on_answers_that_it_was_not_fitted_on():
    def score(number: int, *, is_right: bool, confidence: float) -> Score:
        answer = CUP if is_right else TABLE
        return Score(f"/{number}", "cup", CUP, frozenset(), answer, confidence, Status.GROUNDED, "")

    # Every second answer of a model that is always sure is right.
    others = [score(number, is_right=number % 2 == 0, confidence=0.9) for number in range(40)]
    held_out = [score(number, is_right=number % 2 == 0, confidence=0.9) for number in range(10)]
    assert brier_score(held_out) == pytest.approx((0.1**2 + 0.9**2) / 2)
    assert row_of(others, held_out, "m") == "40 | 10 | 50 | 90 | 50 | 0.40 | 0.00 | 0.41 | 0.25 | 0.25"
    assert row_of(others[:8], held_out, "m") == "8 | 10 | 50 | 90 | – | 0.40 | – | 0.41 | – | –"
    assert row_of(others, [], "m") == "40 | 0 | – | – | – | – | – | – | – | –"


def test_examples_are_of_other_scenes():
    assert {one.view.name for one in examples_for(ROOM, [ROOM, HALL], 8)} == {"desk", "pantry"}
    assert [one.class_iri for one in examples_for(HALL, [ROOM, HALL], 2)] == [TABLE, CUP]


def test_labels_are_evenly_spaced():
    assert spaced(list("abcdefg"), 3) == ["a", "c", "e"]
    assert spaced(["a", "b"], 5) == ["a", "b"]


def test_the_default_grounder_is_the_row_to_compare_with():
    tbox = load_home_tbox()
    gold = (GoldLabel("/Room/mug", tbox.resolve("Cup"), frozenset()),)
    outcome = ask_default_grounder(LabelledScene("Room", ROOM.scene, gold, tbox), 7)
    assert outcome.answers == {"/Room/mug": tbox.resolve("Cup")}


def test_each_form_is_compared_to_one_that_exists():
    assert {form.base for form in FORMS.values()} <= FORMS.keys()
