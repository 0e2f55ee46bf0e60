"""Verdicts, undo and redo, and conflicts between reviewers."""

import pytest

from usd2kg.errors import GroundingError
from usd2kg.grounding import Decision
from usd2kg.studio.review_state import ReviewState
from usd2kg.studio.verdicts import OPEN, Verdict, VerdictKind

TIME = "2026-11-27T10:00:00.000+00:00"
CUP, BOWL = (Verdict(VerdictKind.CLASS, f"https://x.org/{name}") for name in ("Cup", "Bowl"))


def decide(review: ReviewState, who: str, verdict: Verdict, *paths: str, seen: int | None = None) -> None:
    review.apply(review.decide(dict.fromkeys(paths, verdict), who, TIME, review.version if seen is None else seen))


def classes(review: ReviewState, *paths: str) -> list[str]:
    verdicts = [review.verdict(path) for path in paths]
    return [v.class_iri.rpartition("/")[2] if v.class_iri else v.kind.value for v in verdicts]


def test_undo_and_redo_are_unlimited():
    review = ReviewState()
    decide(review, "Ann", CUP, "/A", "/B")
    decide(review, "Ann", BOWL, "/A")
    decide(review, "Ann", Verdict(VerdictKind.NO_CLASS), "/B")
    seen = [classes(review, "/A", "/B")]
    while review.can_undo("Ann"):
        review.apply(review.undo("Ann", TIME))
        seen.append(classes(review, "/A", "/B"))
    assert seen == [["Bowl", "no-class"], ["Bowl", "Cup"], ["Cup", "Cup"], ["open", "open"]]
    while review.can_redo("Ann"):
        review.apply(review.redo("Ann", TIME))
    assert classes(review, "/A", "/B") == seen[0]


def test_a_new_decision_ends_redo():
    review = ReviewState()
    decide(review, "Ann", CUP, "/A")
    review.apply(review.undo("Ann", TIME))
    decide(review, "Ann", BOWL, "/B")
    assert not review.can_redo("Ann")
    with pytest.raises(GroundingError, match="Ann has no decision to make again"):
        review.redo("Ann", TIME)


def test_undo_takes_back_ones_own_decision_only():
    review = ReviewState()
    decide(review, "Ann", CUP, "/A", "/B")
    decide(review, "Bob", BOWL, "/A")
    assert not review.can_undo("Cy")
    review.apply(review.undo("Ann", TIME))
    assert classes(review, "/A", "/B") == ["Bowl", "open"]


def test_undo_restores_the_verdict_of_somebody_else_in_his_name():
    review = ReviewState()
    decide(review, "Ann", CUP, "/A")
    decide(review, "Bob", BOWL, "/A")
    review.apply(review.undo("Bob", TIME))
    assert review.verdict("/A").reviewer == "Ann"
    assert not review.is_conflict("/A")


def test_decisions_are_settled_verdicts():
    review = ReviewState()
    decide(review, "Ann", CUP, "/A")
    decide(review, "Ann", Verdict(VerdictKind.NO_CLASS, comment="a toy"), "/B")
    decide(review, "Ann", Verdict(VerdictKind.UNSURE), "/C")
    decide(review, "Ann", OPEN, "/D")
    assert review.decisions() == {
        "/A": Decision(CUP.class_iri, "Ann", "", TIME),
        "/B": Decision(None, "Ann", "a toy", TIME),
    }


def test_different_verdicts_conflict_unless_the_second_reviewer_had_seen_the_first():
    review = ReviewState()
    decide(review, "Ann", CUP, "/A", "/B", "/C")
    decide(review, "Bob", BOWL, "/A", seen=0)
    decide(review, "Bob", BOWL, "/B", seen=1)
    decide(review, "Bob", CUP, "/C", seen=0)
    assert [review.is_conflict(path) for path in ("/A", "/B", "/C")] == [True, False, False]
    decide(review, "Ann", BOWL, "/A")
    assert not review.is_conflict("/A")


def test_history_lists_what_was_decided():
    review = ReviewState()
    decide(review, "Ann", CUP, "/A")
    decide(review, "Bob", BOWL, "/A")
    review.apply(review.undo("Bob", TIME))
    assert [(e.reviewer, e.action.value, v.class_iri) for e, v in review.history("/A")] == [
        ("Ann", "decide", CUP.class_iri),
        ("Bob", "decide", BOWL.class_iri),
        ("Bob", "undo", CUP.class_iri),
    ]
