"""Findings as lines that a person can act on."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from typing import TYPE_CHECKING

from usd2kg.cli.output import printable

if TYPE_CHECKING:
    from usd2kg.graph.validation import Finding

__all__ = ["MOST_SHOWN", "findings_text"]

MOST_SHOWN = 20
"""Findings of one rule that are shown, unless all are asked for."""


def findings_text(
    findings: "Sequence[Finding]", counts: Mapping[str, int], checked: str, most: int | None = None
) -> str:
    """Return findings as groups of lines, and a last line that counts them all.

    Args:
        findings: those of one rule together.
        counts: severity → number of findings.
        checked: what was looked at: `12 objects`.
        most: how many of each rule are shown; None for all.
    """
    blocks = []
    for _, group in groupby(findings, key=lambda finding: (finding.severity, finding.rule)):
        alike = list(group)
        blocks += ["\n".join(_lines(finding)) for finding in alike[:most]]
        rest = len(alike) - len(alike[:most])
        if rest:
            blocks.append(f"… {rest} more of {alike[0].rule} (--all shows them)")
    return "\n\n".join([*blocks, _count(len(findings), counts, checked)]) + "\n"


def _lines(finding: "Finding") -> Iterator[str]:
    who = f"{_line(finding.label)} {_line(finding.prim_path)}".strip() or _line(finding.iri)
    yield f"{finding.severity} [{finding.rule}] {who}"
    yield f"  found:    {_line(finding.found)}"
    yield f"  expected: {_line(finding.expected)}"
    yield f"  do:       {_line(finding.advice)}"


def _line(text: str) -> str:
    return printable(" ".join(text.split()))


def _count(total: int, counts: Mapping[str, int], checked: str) -> str:
    parts = ", ".join(f"{n} {name}{'' if n == 1 else 's'}" for name, n in counts.items() if n)
    return f"{total} {'finding' if total == 1 else 'findings'}{f' ({parts})' if parts else ''} on {checked}"
