"""Finding: one problem of a graph, with advice."""

from dataclasses import dataclass
from enum import StrEnum

__all__ = ["Finding", "Severity", "sort_findings"]


class Severity(StrEnum):
    """How serious a finding is."""

    ERROR = "error"
    """The graph is malformed or contradicts its ontology: programs that read it can fail or draw false conclusions."""
    WARNING = "warning"
    """The graph is well-formed and probably wrong about the object."""
    NOTE = "note"
    """Worth checking."""


_ORDER = {severity: rank for rank, severity in enumerate(Severity)}


@dataclass(frozen=True, slots=True)
class Finding:
    """A violation of one rule by one node."""

    severity: Severity
    rule: str
    """Id of a shape, of a contradiction with the ontology, or of a plausibility rule."""
    label: str
    """Label of the object; empty if it has none, or the finding is not about an object."""
    prim_path: str
    """Prim path of the object or joint; empty if there is none."""
    iri: str
    """The node: IRI of the object, its box, joint…; label of a blank node; text of a literal. Empty for a finding
    about the whole scene."""
    found: str
    """What was found, with units."""
    expected: str
    advice: str
    """How to correct it."""


def sort_findings(findings: list[Finding]) -> tuple[Finding, ...]:
    """Return findings by severity (most serious first), rule and prim path."""
    return tuple(sorted(findings, key=lambda f: (_ORDER[f.severity], f.rule, f.prim_path, f.iri, f.found)))
