"""Audit: how often suggestions are right, measured on objects that are drawn at random.

The queue shows doubtful objects first, so what reviewers decide there says nothing about the rest. An audit draws from
all objects, whatever was decided about them before.
"""

import hashlib
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any

from usd2kg.errors import EvaluationError
from usd2kg.evaluation import Score
from usd2kg.evaluation.calibrate import fit_scaling
from usd2kg.evaluation.metrics.calibration import calibration_error, reliability_bins
from usd2kg.evaluation.metrics.intervals import wilson_interval
from usd2kg.grounding import PlattScaling
from usd2kg.grounding.lexical.alignment.artificial_root import NO_CLASS_IRI
from usd2kg.studio.object_review import ObjectReview
from usd2kg.studio.settings import AUDIT
from usd2kg.studio.verdicts import Event, Suggestion, VerdictKind

__all__ = ["Audit", "audit_json", "fit_audit", "make_audit"]


@dataclass(frozen=True, slots=True)
class Audit:
    """A random sample of the objects with a suggestion, and the verdicts on it."""

    population: int
    """Number of objects from which it is drawn."""
    sample: tuple[str, ...]
    """Prim paths, in the order in which they were drawn."""
    waiting: tuple[str, ...]
    """Those without a verdict in the audit."""
    unsure: int
    """Number of objects that reviewers could not tell."""
    scores: tuple[Score, ...]
    """Suggestion and current verdict of each object whose class is settled."""


def make_audit(states: Iterable[ObjectReview], standing: Iterable[Event]) -> Audit:
    """Return the audit of a scene.

    A sample in which all objects have a verdict is continued by another one of the same size.

    Args:
        states: the states of all objects.
        standing: the decisions that are not undone.
    """
    # What a person decided before the project is not a suggestion of the grounder.
    drawn = sorted((state for state in states if state.prediction.review is None), key=_draw)
    marked = {change.prim_path: change for event in standing if event.is_audit for change in event.changes}
    is_done = [state.prim_path in marked and state.verdict.kind is not VerdictKind.OPEN for state in drawn]
    first = is_done.index(False) if False in is_done else len(drawn)
    size = min(AUDIT.sample * (first // AUDIT.sample + 1), len(drawn))
    pairs = list(zip(drawn[:size], is_done, strict=False))
    judged = [state for state, done in pairs if done]
    return Audit(
        len(drawn),
        tuple(state.prim_path for state, _ in pairs),
        tuple(state.prim_path for state, done in pairs if not done),
        sum(state.verdict.kind is VerdictKind.UNSURE for state in judged),
        tuple(_score(s, marked[s.prim_path].suggested) for s in judged if s.verdict.kind is not VerdictKind.UNSURE),
    )


def _draw(state: ObjectReview) -> bytes:
    """Return the place of an object in the random order, which does not depend on the other objects."""
    return hashlib.sha256(f"{AUDIT.seed} {state.prim_path}".encode("utf-8", "surrogatepass")).digest()


def _score(state: ObjectReview, suggested: Suggestion | None) -> Score:
    """Return the comparison of the current verdict with the suggestion at the time of the audit.

    Where the grounder gave no answer, the comparison counts as wrong.
    """
    return Score(
        id=state.prim_path,
        name=state.prim_path,
        target=state.verdict.class_iri or NO_CLASS_IRI,
        also=frozenset(),
        answer=(suggested.class_iri or NO_CLASS_IRI) if suggested is not None else None,
        confidence=suggested.confidence if suggested is not None else None,
        status=state.prediction.status,
        explanation=state.prediction.explanation,
    )


def fit_audit(audit: Audit) -> PlattScaling | None:
    """Return the scaling of confidences that the verdicts suggest.

    None if the verdicts are too few, all right or all wrong, or if less confident suggestions are right more often.
    """
    try:
        scaling = fit_scaling(audit.scores, "the suggestions of this project, by a random audit")
    except EvaluationError:
        return None
    return scaling if scaling.slope > 0 else None


def audit_json(audit: Audit) -> dict[str, Any]:
    """Return the figures of an audit as the page shows them; see `web/src/api/types.ts`."""
    scores = audit.scores
    right = sum(score.is_exact for score in scores)
    scaling = fit_audit(audit)
    return {
        "population": audit.population,
        "sample": len(audit.sample),
        "waiting": len(audit.waiting),
        "unsure": audit.unsure,
        "judged": len(scores),
        "right": right,
        "interval": wilson_interval(right, len(scores)) if scores else None,
        "calibration_error": calibration_error(scores),
        "calibrated_on": 0 if scaling is None else scaling.answers,
        "with_confidence": sum(score.confidence is not None for score in scores),
        "bins": [asdict(found) for found in reliability_bins(scores)],
    }
