"""read_decision: the decision in the body of a request, checked."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from usd2kg.ontology import OntologyClass
from usd2kg.studio.page_indices import PageIndices
from usd2kg.studio.request_body import BadRequestError, field
from usd2kg.studio.session import StudioSession
from usd2kg.studio.settings import SERVER
from usd2kg.studio.verdicts import Verdict, VerdictKind

__all__ = ["RequestedDecision", "read_decision"]

_KINDS = {"unsure": VerdictKind.UNSURE, "no-class": VerdictKind.NO_CLASS, "clear": VerdictKind.OPEN}


@dataclass(frozen=True, slots=True)
class RequestedDecision:
    """What a page asks to record."""

    action: str
    verdicts: Mapping[str, Verdict]
    """Prim path → verdict."""
    concept: str
    """IRI of the concept, if the decision is about all its objects; empty otherwise."""
    is_audit: bool
    """Whether the objects were drawn at random."""


def read_decision(
    body: dict[str, Any], paths: Sequence[str], session: StudioSession, indices: PageIndices
) -> RequestedDecision:
    """Return the decision of a request.

    Args:
        body: the request.
        paths: prim paths of its objects.
        session: the scene under review.
        indices: numbers of classes and concepts.

    Raises:
        BadRequestError: a field is missing or wrong.
    """
    action = field(body, "action", str)
    comment, proposal = field(body, "comment", str, ""), _proposal(body, action, session)
    concept = _concept(body, action, paths, session, indices)
    return RequestedDecision(
        action, _verdicts(body, action, paths, session, comment, proposal), concept, _is_audit(body, paths, session)
    )


def _verdicts(
    body: dict[str, Any], action: str, paths: Sequence[str], session: StudioSession, comment: str, proposal: str
) -> Mapping[str, Verdict]:
    if action in _KINDS:
        return dict.fromkeys(paths, Verdict(_KINDS[action], comment=comment))
    if action == "choose":
        index = field(body, "class", int)
        if not 0 <= index < len(session.tbox.classes):
            raise BadRequestError(f"field class: {index} is not a class")
        iri = session.tbox.classes[index].iri
        return dict.fromkeys(paths, Verdict(VerdictKind.CLASS, iri, comment=comment, proposal=proposal))
    if action != "confirm":
        raise BadRequestError(
            f"field action: {action[:40]!r} is unknown; expected confirm, choose, unsure, no-class or clear"
        )
    suggested = {path: session.predictions[path].class_iri for path in paths}
    if without := next((path for path, iri in suggested.items() if iri is None), None):
        raise BadRequestError(f"{without}: has no suggestion to confirm; choose a class")
    return {path: Verdict(VerdictKind.CLASS, iri, comment=comment) for path, iri in suggested.items()}


def _concept(
    body: dict[str, Any], action: str, paths: Sequence[str], session: StudioSession, indices: PageIndices
) -> str:
    """Return the concept that all objects of a decision have; empty if the decision is about objects only."""
    index = field(body, "concept", int, -1)
    if index == -1:
        return ""
    if action != "choose" or not 0 <= index < len(indices.concept_iris):
        raise BadRequestError(f"field concept: {index}; expected a concept, with the action choose")
    iri = indices.concept_iris[index]
    if other := next((path for path in paths if session.predictions[path].concept != iri), None):
        raise BadRequestError(f"{other}: has another concept; expected objects of {iri}")
    return iri


def _proposal(body: dict[str, Any], action: str, session: StudioSession) -> str:
    """Return the label of a subclass that a request proposes; empty if it proposes none."""
    label = field(body, "proposal", str, "").strip()
    if not label:
        return ""
    if action != "choose":
        raise BadRequestError("field proposal: expected the action choose, with the superclass")
    if not label.isprintable() or len(label) > SERVER.max_label or not re.search(r"[^\W_]", label):
        raise BadRequestError(f"field proposal: expected letters, at most {SERVER.max_label} characters, on one line")
    known = next((cls for cls in session.tbox.classes if label.casefold() in _names(cls)), None)
    if known is not None:
        raise BadRequestError(f"field proposal: the ontology has the class {known.readable_name}; choose it")
    return label


def _is_audit(body: dict[str, Any], paths: Sequence[str], session: StudioSession) -> bool:
    """Return whether a request is about objects of the random sample, all of them."""
    if not field(body, "audit", bool, False):
        return False
    sample = set(session.audit().sample)
    if other := next((path for path in paths if path not in sample), None):
        raise BadRequestError(f"field audit: {other} is not in the random sample")
    return True


def _names(cls: OntologyClass) -> set[str]:
    return {cls.label.casefold(), cls.local_name.casefold()}
