"""Findings of a validation as text."""

import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import TYPE_CHECKING

from usd2kg.cli.limits import FINDINGS_PER_RULE
from usd2kg.cli.output import count_noun, to_single_line
from usd2kg.cli.terminal import Style, paint

if TYPE_CHECKING:
    from usd2kg.validation import Finding

__all__ = ["findings_text"]

_STYLES = {"error": Style.ERROR, "warning": Style.WARNING, "note": Style.NOTE}
"""Severity → style."""


def findings_text(findings: "Sequence[Finding]", checked: int, noun: str, *, is_complete: bool) -> str:
    """Return findings as groups of lines, and a last line that counts them.

    Args:
        findings: the findings, sorted by rule.
        checked: number of items that were checked.
        noun: noun for an item, in the singular.
        is_complete: whether all findings are shown, or `FINDINGS_PER_RULE` of each rule.
    """
    limit = None if is_complete else FINDINGS_PER_RULE
    blocks = []
    for _, group in groupby(findings, key=lambda finding: (finding.severity, finding.rule)):
        same_rule = list(group)
        blocks += ["\n".join(_lines(finding)) for finding in same_rule[:limit]]
        hidden = len(same_rule) - len(same_rule[:limit])
        if hidden:
            blocks.append(f"… {hidden} more of {same_rule[0].rule} (--all shows them)")
    return "\n\n".join([*blocks, f"{_count(findings)} on {count_noun(checked, noun)}"]) + "\n"


def _lines(finding: "Finding") -> Iterator[str]:
    named = f"{to_single_line(finding.label)} {to_single_line(finding.prim_path)}".strip()
    severity = paint(str(finding.severity), _STYLES[finding.severity], sys.stdout)
    yield f"{severity} [{finding.rule}] {named or to_single_line(finding.iri) or 'the whole graph'}"
    yield f"  found:    {to_single_line(finding.found)}"
    yield f"  expected: {to_single_line(finding.expected)}"
    yield f"  do:       {to_single_line(finding.advice)}"


def _count(findings: "Sequence[Finding]") -> str:
    counts = Counter(finding.severity for finding in findings)
    parts = ", ".join(count_noun(count, severity.value) for severity, count in counts.items())
    return count_noun(len(findings), "finding") + (f" ({parts})" if parts else "")
