"""The audit: a random sample of all objects, and what its verdicts say about the suggestions."""

from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from tests.studio.conftest import Client, running_studio
from tests.studio.test_application import CUP_1, FLOOR, TABLE, THING, class_index, decide
from tests.studio.test_lessons import MORE
from usd2kg.evaluation.metrics.intervals import wilson_interval
from usd2kg.evaluation.settings import PLATT_FIT
from usd2kg.grounding import Prediction, Status
from usd2kg.grounding.model import Review
from usd2kg.studio.audit import audit_json, fit_audit, make_audit
from usd2kg.studio.object_review import ObjectReview, ReviewStatus, suggestion_of
from usd2kg.studio.open_session import open_session
from usd2kg.studio.project import ProjectSources, open_project
from usd2kg.studio.review_state import ReviewState
from usd2kg.studio.settings import AUDIT
from usd2kg.studio.verdicts import OPEN, Verdict, VerdictKind

TIME = "2026-11-27T10:00:00+00:00"
SMALL = AUDIT._replace(sample=1)
CUP, BOWL = "https://x.org/Cup", "https://x.org/Bowl"


def state(
    name: str, confidence: float | None = 0.95, verdict: Verdict = OPEN, answer: str | None = CUP
) -> ObjectReview:
    status = Status.GROUNDED if answer is not None else Status.REFUSED
    prediction = Prediction(f"/{name}", answer, confidence, status, "test", "")
    return ObjectReview(f"/{name}", ReviewStatus.SUGGESTED, answer, prediction, verdict, False)


def judged(states: list[ObjectReview]) -> ReviewState:
    """The events that give the verdicts of states, in an audit."""
    review = ReviewState()
    verdicts = {found.prim_path: found.verdict for found in states if found.verdict != OPEN}
    suggested = {found.prim_path: suggestion_of(found.prediction) for found in states}
    review.apply(review.decide(verdicts, "Ann", TIME, 0, suggested=suggested, is_audit=True))
    return review


def given(iri: str | None) -> Verdict:
    return Verdict(VerdictKind.CLASS if iri is not None else VerdictKind.NO_CLASS, iri)


def test_verdicts_calibrate_confidences_if_they_tell_enough():
    # 12 of 15 confident suggestions are right, and 3 of 15 doubtful ones.
    verdicts = [(0.95, at < 12) for at in range(15)] + [(0.5, at < 3) for at in range(15)]
    states = [state(str(n), sure, given(CUP if right else BOWL)) for n, (sure, right) in enumerate(verdicts)]
    audit = make_audit(states, judged(states).standing())
    scaling = fit_audit(audit)
    assert scaling is not None
    # Two groups and two parameters: the fit meets Platt's smoothed shares, with targets 16/17 and 1/17.
    shares = [(12 * 16 / 17 + 3 / 17) / 15, (3 * 16 / 17 + 12 / 17) / 15]
    assert [scaling(0.95), scaling(0.5)] == pytest.approx(shares, abs=1e-3)
    assert audit_json(audit)["calibrated_on"] == 30
    few = states[:10]
    assert fit_audit(make_audit(few, judged(few).standing())) is None
    inverted = [state(str(n), 1.45 - sure, given(CUP if ok else BOWL)) for n, (sure, ok) in enumerate(verdicts)]
    assert fit_audit(make_audit(inverted, judged(inverted).standing())) is None


def test_the_figures_are_those_of_a_hand_calculation():
    states = [
        state("a", 0.95, given(CUP)),
        state("b", 0.95, given(BOWL)),
        state("c", 0.65, given(CUP)),
        # A refusal is right if no class fits, and has no confidence.
        state("d", None, given(None), answer=None),
        state("e", 0.95, Verdict(VerdictKind.UNSURE)),
        state("f", 0.95),
    ]
    figures = audit_json(make_audit(states, judged(states).standing()))
    counts = {key: figures[key] for key in ("population", "sample", "waiting", "unsure", "judged", "right")}
    assert counts == {"population": 6, "sample": 6, "waiting": 1, "unsure": 1, "judged": 4, "right": 3}
    # Two of three in 0.9 to 1.0 with half right: 2/3 · |0.5 - 0.95| + 1/3 · |1 - 0.65| = 0.3 + 0.11667.
    assert figures["calibration_error"] == pytest.approx(0.416667, abs=1e-6)
    assert figures["with_confidence"] == 3
    bins = [(found["lower"], found["count"], found["accuracy"]) for found in figures["bins"]]
    assert bins == [(0.6, 1, 1.0), (0.9, 2, 0.5)]
    # 3 of 4: z² = 3.84146, centre (0.75 + 0.48018) / 1.96036 = 0.62753, half width 0.32689.
    assert figures["interval"] == pytest.approx((0.30064, 0.95441), abs=1e-4)


@pytest.mark.parametrize(
    ("right", "total", "expected"),
    # Of none right, the upper end is z² / (n + z²) = 3.84146 / 13.84146.
    [(8, 10, (0.49016, 0.94332)), (0, 10, (0.0, 0.27753)), (10, 10, (0.72247, 1.0)), (27, 30, (0.74379, 0.96540))],
)
def test_wilson_intervals(right: int, total: int, expected: tuple[float, float]):
    assert wilson_interval(right, total) == pytest.approx(expected, abs=1e-4)


def test_an_interval_needs_samples():
    with pytest.raises(ValueError, match="of no samples"):
        wilson_interval(0, 0)


def test_a_call_that_failed_is_wrong():
    found = state("a", None, given(None), answer=None)
    failed = replace(found, prediction=replace(found.prediction, status=Status.FAILED))
    figures = audit_json(make_audit([failed], judged([failed]).standing()))
    assert (figures["judged"], figures["right"], figures["calibration_error"]) == (1, 0, None)


def test_a_full_sample_is_continued_in_the_same_random_order():
    states = [state(f"object_{number}") for number in range(100)]
    first = make_audit(states, [])
    assert (first.population, len(first.sample), len(first.waiting)) == (100, 30, 30)
    assert first.sample != tuple(sorted(first.sample))
    # Other objects do not change the order, and neither does that of the scene.
    fewer = make_audit(reversed(states[:50]), [])
    order = [path for path in first.sample if path in set(fewer.sample)]
    assert [path for path in fewer.sample if path in set(first.sample)] == order
    done = [replace(s, verdict=given(CUP)) if s.prim_path in first.sample else s for s in states]
    second = make_audit(done, judged(done).standing())
    assert second.sample[:30] == first.sample
    assert (len(second.sample), len(second.waiting), len(second.scores)) == (60, 30, 30)


def test_what_a_person_decided_before_is_no_suggestion():
    before = state("a")
    reviewed = replace(before.prediction, review=Review("Ann", CUP, 0.9, Status.GROUNDED))
    assert make_audit([replace(before, prediction=reviewed), state("b")], []).sample == ("/b",)


def audit(studio: Client) -> Any:
    return studio.ask("api/queue").json()["audit"]


@pytest.mark.studio
def test_verdicts_of_an_audit_are_marked_and_undone(stage: Path, tmp_path: Path):
    folder = tmp_path / "project"
    with running_studio(stage, folder) as studio:
        decide(studio, [FLOOR], "confirm")
        queue = studio.ask("api/queue?order=audit").json()
        assert sorted(group["objects"][0] for group in queue["groups"]) == [0, 1, 2, 3, 4]
        assert {group["confidence"] for group in queue["groups"]} == {None}
        decide(studio, [TABLE], "confirm", audit=True)
        decide(studio, [THING], "choose", audit=True, **{"class": class_index(studio, "Cupboard")})
        decide(studio, [CUP_1], "confirm")
        found = audit(studio)
        assert (found["judged"], found["right"], found["waiting"]) == (2, 1, 3)
    with running_studio(stage, folder) as studio:
        assert audit(studio) == found
        left = studio.ask("api/queue?order=audit").json()["groups"]
        in_order = [group["objects"][0] for group in queue["groups"]]
        assert [group["objects"][0] for group in left] == [i for i in in_order if i not in {TABLE, THING}]
        # Ann undoes the decision about the cup, then that about the thing.
        for _ in range(2):
            studio.ask("api/undo", {"reviewer": "Ann"})
        assert (audit(studio)["judged"], audit(studio)["right"]) == (1, 1)
        # A later verdict outside the audit corrects the truth.
        decide(studio, [TABLE], "no-class", "Bob")
        assert (audit(studio)["judged"], audit(studio)["right"]) == (1, 0)


@pytest.mark.studio
def test_the_suggestion_of_that_time_counts_after_grounding_again(tmp_path: Path):
    (tmp_path / "scene.usda").write_text(MORE)
    folder = tmp_path / "project"
    with running_studio(tmp_path / "scene.usda", folder) as studio:
        paths = studio.ask("api/scene").json()["objects"]["path"]
        one, two = paths.index("/Kitchen/Zxqv"), paths.index("/Kitchen/Zxqv_2")
        cupboard = {"class": class_index(studio, "Cupboard")}
        decide(studio, [one], "choose", audit=True, **cupboard)
        assert studio.ask("api/reground", {"reviewer": "Ann", "page": "p"}).status == 200
        decide(studio, [two], "confirm", audit=True)
        found = audit(studio)
        assert (found["judged"], found["right"]) == (2, 1)
    with running_studio(tmp_path / "scene.usda", folder) as studio:
        assert audit(studio) == found


@pytest.mark.studio
def test_an_audit_is_about_its_sample(studio: Client, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr("usd2kg.studio.audit.AUDIT", SMALL)
    (first,) = studio.ask("api/queue?order=audit").json()["groups"]
    other = next(index for index in range(5) if index not in first["objects"])
    body = {"objects": [other], "action": "unsure", "audit": True, "reviewer": "Ann"}
    assert "is not in the random sample" in studio.ask("api/decisions", body).json()["error"]
    assert "found str, expected bool" in studio.ask("api/decisions", {**body, "audit": "yes"}).json()["error"]
    assert studio.ask("api/decisions", {**body, "objects": first["objects"]}).status == 200
    assert studio.ask("api/queue?order=audit").json()["groups"] != [first]


def test_written_files_have_calibrated_confidences(stage: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr("usd2kg.evaluation.calibrate.PLATT_FIT", PLATT_FIT._replace(min_answers=2))
    with (
        open_project(tmp_path / "project", ProjectSources(stage)) as project,
        closing(open_session(project)) as session,
    ):
        raw = {path: prediction.confidence for path, prediction in session.predictions.items()}
        sure, doubtful = max(raw, key=lambda path: raw[path] or 0.0), min(raw, key=lambda path: raw[path] or 1.0)
        cupboard = next(iri for iri in session.tbox.by_iri if iri.endswith("Cupboard"))
        session.decide({sure: given(session.predictions[sure].class_iri)}, "Ann", 0, is_audit=True)
        session.decide({doubtful: given(cupboard)}, "Ann", 1, is_audit=True)
        scaling = fit_audit(session.audit())
        assert scaling is not None
        written = session.grounding()
        assert written.is_calibrated
        for path, prediction in written.by_path.items():
            confidence = raw[path]
            assert confidence is not None
            assert prediction.confidence == (1.0 if path in {sure, doubtful} else scaling(confidence))
        # On the page, suggestions keep the confidences by which they are sorted.
        assert {path: p.confidence for path, p in session.predictions.items()} == raw
        session.undo("Ann")
        assert {p.confidence for p in session.grounding().predictions} <= {1.0, *raw.values()}
