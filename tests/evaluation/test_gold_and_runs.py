"""Gold files, joining them with predictions, the summary of a run, and result files."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from tests.evaluation.records import E, grounding_of, label, small_tbox
from tests.grounding.records import make_object, make_scene
from usd2kg.errors import EvaluationError
from usd2kg.evaluation import evaluation_json, join_scores, read_gold
from usd2kg.evaluation.run import score_grounding
from usd2kg.evaluation.score import distinct_name
from usd2kg.evaluation.stored import read_run
from usd2kg.evaluation.template import gold_template
from usd2kg.grounding import Status

TBOX = small_tbox()


def _write(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "gold.csv"
    path.write_text(text, encoding="utf-8")
    return path


def test_reads_gold_with_iris_or_local_names(tmp_path: Path) -> None:
    path = _write(tmp_path, f"path,class,also\n/a,Cup,Bowl|{E}Spoon\n/b,<{E}Wall>,\n\n")
    assert read_gold(path, TBOX) == (label("/a", "Cup", "Bowl|Spoon"), label("/b", "Wall"))


def test_reads_a_path_given_as_text(tmp_path: Path) -> None:
    assert read_gold(str(_write(tmp_path, "path,class\n/a,Cup\n")), TBOX) == (label("/a", "Cup"),)


def test_reads_gold_written_by_spreadsheets(tmp_path: Path) -> None:
    path = tmp_path / "gold.csv"
    path.write_bytes(b'\xef\xbb\xbfpath,class,also,words\r\n/a, Cup ,"Cup|Bowl",a cup\r\n')
    assert read_gold(path, TBOX) == (label("/a", "Cup", "Bowl"),)


def test_reads_gold_with_empty_surplus_cells(tmp_path: Path) -> None:
    assert read_gold(_write(tmp_path, "path,class\n/a,Cup,, \n"), TBOX) == (label("/a", "Cup"),)


def test_reads_its_template_whatever_the_documentation_contains(tmp_path: Path) -> None:
    described = replace(make_object("/a"), documentation='one\u2028two\x85three\x0cfour\x0bfive\r\nsix, "seven"')
    template = gold_template(make_scene(described, make_object("/b")))
    filled = template.replace("/a,,", "/a,Cup,").replace("/b,,", "/b,Bowl,")
    path = tmp_path / "gold.csv"
    path.write_bytes(filled.encode())
    assert read_gold(path, TBOX) == (label("/a", "Cup"), label("/b", "Bowl"))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("prim,class\n/a,Cup\n", r"line 1 has the columns prim, class; expected path,class,also"),
        ("", r"line 1 has no columns"),
        ("path,class\n/a,Cup\n/b,Mug\n", r"line 3: .*'Mug' names no class of the 7 in scope"),
        ("path,class\n/a,\n", r"line 2: /a has no class"),
        ("path,class\n/a,Cup\n/a,Bowl\n", r"/a has more than one row"),
        ("path,class\n", r"contains no label"),
        ("path,class,also\n/a,Cup,Bowl|Nope\n", r"line 2: .*'Nope'"),
        ("path,class,also\n/a,Cup,Bowl,Spoon\n", r"line 2: /a has more cells than line 1 has columns; separate second"),
        ("path,class\n/a,Cup\n/b,Cup,Bowl\n", r"line 3: /b has more cells than line 1 has columns"),
        ("path,class,Also\n/a,Cup,Bowl\n", r"line 1 has the column 'Also'; expected 'also' for second labels, or"),
        ("path,class, also\n/a,Cup,Bowl\n", r"line 1 has the column ' also'; expected 'also'"),
        ("path,class,also_classes\n/a,Cup,Bowl\n", r"line 1 has the column 'also_classes'; expected 'also'"),
    ],
)
def test_rejects_malformed_gold_with_its_line(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(EvaluationError, match=said):
        read_gold(_write(tmp_path, text), TBOX)


def test_rejects_a_missing_gold_file(tmp_path: Path) -> None:
    with pytest.raises(EvaluationError, match="cannot be read as gold labels"):
        read_gold(tmp_path / "none.csv", TBOX)


def test_objects_without_a_prediction_keep_a_score() -> None:
    gold = [label("/a", "Cup"), label("/b", "Bowl"), label("/c", "Wall")]
    scores = join_scores(gold, grounding_of({"/a": "Cup", "/b": None}))
    assert [score.answer for score in scores] == [E + "Cup", None, None]
    assert [score.status for score in scores] == [Status.GROUNDED, Status.REFUSED, Status.MISSING]


def test_copies_share_a_distinct_name() -> None:
    assert distinct_name("SM_Chair_01") == distinct_name("chair_17_LOW")
    assert distinct_name("chairA") != distinct_name("stoolA")
    assert distinct_name("042") == "042", "a name without words is kept"


def test_summary_uses_the_units_of_the_study() -> None:
    gold = [
        label("/cup_1", "Cup"),
        label("/cup_2", "Cup"),
        label("/wall", "Wall", also="Bowl"),
        label("/spoon", "Spoon"),
    ]
    answers = grounding_of({"/cup_1": "Cup", "/cup_2": "Cup", "/wall": "Bowl", "/spoon": None})
    data = evaluation_json(score_grounding(answers, gold, TBOX, 0.5))
    assert (data["n"], data["names"], data["answered"]) == (4, 3, 3)
    assert data["ema"] == 50.0
    assert data["ema_also"] == 75.0
    # By name: cup is right, wall and spoon are wrong.
    assert data["ema_by_name"] == pytest.approx(100 / 3)
    # Two of four are right; the others share no superclass with the target.
    assert data["hf1"] == 0.5
    assert data["ema_interval"][0] <= 50.0 <= data["ema_interval"][1]
    assert data["misses"]["unanswered"] == 1
    json.dumps(data)


def test_intervals_have_a_width_if_all_answers_are_right() -> None:
    gold = [label("/cup_1", "Cup"), label("/cup_2", "Cup"), label("/wall", "Wall")]
    answers = grounding_of({"/cup_1": "Cup", "/cup_2": "Cup", "/wall": "Wall"})
    data = evaluation_json(score_grounding(answers, gold, TBOX, 0.5))
    # n / (n + z²): 3 objects, 2 distinct names.
    by_object, by_name = [pytest.approx(43.85, abs=0.01), 100.0], [pytest.approx(34.24, abs=0.01), 100.0]
    assert data["ema_interval"] == data["ema_also_interval"] == by_object
    assert data["ema_name_interval"] == data["ema_by_name_interval"] == by_name
    assert data["hf1_interval"] == [pytest.approx(0.4385, abs=1e-4), 1.0]
    wrong = grounding_of(dict.fromkeys(("/cup_1", "/cup_2", "/wall")))
    assert score_grounding(wrong, gold, TBOX, 0.5).summary.ema_interval == (0.0, pytest.approx(56.15, abs=0.01))


def test_missed_objects_have_no_answer_end_to_end() -> None:
    gold = [label("/a", "Cup"), label("/b", "Cup")]
    evaluation = score_grounding(grounding_of({"/a": "Cup", "/b": "Cup"}), gold, TBOX, 0.1, missed=("/b",))
    assert (evaluation.summary.ema, evaluation.end_to_end.ema) == (100.0, 50.0)
    assert [score.answer for score in evaluation.scores] == [E + "Cup"] * 2, "the scores are those on the gold's list"
    data = evaluation_json(evaluation)
    assert (data["end_to_end"]["ema"], data["end_to_end"]["answered"]) == (50.0, 1)


def test_reads_back_every_score_of_a_result_file(tmp_path: Path) -> None:
    gold = [label("/a", "Cup", also="Bowl"), label("/b", "Bowl")]
    evaluation = score_grounding(grounding_of({"/a": "Bowl", "/b": None}), gold, TBOX, 0.1)
    data = evaluation_json(evaluation)
    data["settings"] = {"regime": "opaque", "evidence": "geometry"}
    path = tmp_path / "run.json"
    path.write_text(json.dumps(data), encoding="utf-8")
    run = read_run(path)
    assert run.scores == evaluation.scores
    assert run.description == "fake, opaque names, evidence geometry"
    assert (run.scene, run.scene_hash, run.grounder, run.is_calibrated) == ("s.usda", "sha256:1", "fake", False)


@pytest.mark.parametrize("text", ["", "[]", '{"scores": []}', "not json"])
def test_rejects_a_malformed_result_file(tmp_path: Path, text: str) -> None:
    path = tmp_path / "run.json"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(EvaluationError, match="cannot be read as a run"):
        read_run(path)
