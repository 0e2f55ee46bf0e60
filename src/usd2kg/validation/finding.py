"""A finding: what is wrong with a graph, in words that a person can act on."""

from dataclasses import dataclass
from enum import StrEnum

__all__ = ["Finding", "Severity", "sort_findings"]


class Severity(StrEnum):
    """How serious a finding is."""

    ERROR = "error"
    """The graph is malformed or contradicts its ontology: programs that read it fail or conclude nonsense."""
    WARNING = "warning"
    """The graph is well formed and most likely wrong about the object."""
    NOTE = "note"
    """Worth a look."""


_ORDER = {severity: rank for rank, severity in enumerate(Severity)}


@dataclass(frozen=True, slots=True)
class Finding:
    """What one rule found on one object."""

    severity: Severity
    rule: str
    """Id of the rule: of a shape, of a clash with the ontology, or of the table of plausibility."""
    label: str
    """The object's label; empty if it has none, or the finding is about no object."""
    prim_path: str
    """The object's path on the stage, or a joint's; empty in the same way."""
    iri: str
    """The node that the finding is about: the object, or its box, joint…; a blank node's name, a literal's text."""
    found: str
    """With numbers and their units."""
    expected: str
    advice: str
    """What to do about it."""


def sort_findings(findings: list[Finding]) -> tuple[Finding, ...]:
    """Return findings most serious first, those of one rule together, in the order of prim paths."""
    return tuple(
        sorted(findings, key=lambda f: (_ORDER[f.severity], f.rule, f.prim_path, f.iri, f.found)),
    )
