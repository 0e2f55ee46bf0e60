"""Findings as text: groups of lines, and a last line that counts them."""

from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import TYPE_CHECKING

from usd2kg.cli.output import printable

if TYPE_CHECKING:
    from usd2kg.validation import Finding

__all__ = ["MOST_OF_A_RULE", "findings_text"]

MOST_OF_A_RULE = 20
"""Findings of one rule that are shown unless all are wanted."""


def findings_text(findings: "Sequence[Finding]", count: int, thing: str, most: int | None = None) -> str:
    """Return findings, sorted by rule, as groups of lines, and a last line that counts them all.

    Args:
        findings: what was found.
        count: things that were looked at.
        thing: what they are, in the singular; the plural has an s more, or es.
        most: findings of one rule that are shown; None for all.
    """
    blocks = []
    for _, group in groupby(findings, key=lambda finding: (finding.severity, finding.rule)):
        alike = list(group)
        blocks += ["\n".join(_lines(finding)) for finding in alike[:most]]
        rest = len(alike) - len(alike[:most])
        if rest:
            blocks.append(f"… {rest} more of {alike[0].rule} (--all shows them)")
    return "\n\n".join([*blocks, f"{_count(findings)} on {_counted(count, thing)}"]) + "\n"


def _lines(finding: "Finding") -> Iterator[str]:
    who = f"{_line(finding.label)} {_line(finding.prim_path)}".strip() or _line(finding.iri)
    yield f"{finding.severity} [{finding.rule}] {who}".rstrip()
    yield f"  found:    {_line(finding.found)}"
    yield f"  expected: {_line(finding.expected)}"
    yield f"  do:       {_line(finding.advice)}"


def _line(text: str) -> str:
    return printable(" ".join(text.split()))


def _count(findings: "Sequence[Finding]") -> str:
    counts = Counter(finding.severity for finding in findings)
    parts = ", ".join(_counted(n, severity.value) for severity, n in counts.items())
    return f"{_counted(len(findings), 'finding')}{f' ({parts})' if parts else ''}"


def _counted(count: int, thing: str) -> str:
    """Return a number with the word for so many.

    >>> _counted(2, "class")
    '2 classes'
    """
    return f"{count} {thing}{'' if count == 1 else 'es' if thing.endswith('s') else 's'}"
