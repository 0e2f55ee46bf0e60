"""Cohen's kappa of two reviewers."""

import pytest

from usd2kg.studio.reviewer_agreement import find_agreement
from usd2kg.studio.verdicts import OPEN, Verdict, VerdictKind


def verdict(name: str) -> Verdict:
    return {
        "-": OPEN,
        "none": Verdict(VerdictKind.NO_CLASS),
    }.get(name, Verdict(VerdictKind.CLASS, f"https://x.org/{name}"))


def given(**columns: str) -> dict[str, dict[str, Verdict]]:
    rows = {who: text.split() for who, text in columns.items()}
    count = len(next(iter(rows.values())))
    return {f"/O{i}": {who: verdict(names[i]) for who, names in rows.items()} for i in range(count)}


def test_kappa_by_hand():
    # Of 10, 7 are the same; by chance (6 × 5 + 4 × 5) / 100 = 0.5.
    (found,) = find_agreement(
        given(Ann="Cup Cup Cup Cup Cup Cup Bowl Bowl Bowl Bowl", Bob="Cup Cup Cup Cup Bowl Bowl Bowl Bowl Bowl Cup")
    )
    assert (found.reviewers, found.objects, found.same) == (("Ann", "Bob"), 10, 7)
    assert found.kappa == pytest.approx((0.7 - 0.5) / 0.5)


def test_open_objects_do_not_count():
    (found,) = find_agreement(given(Ann="Cup Bowl none -", Bob="Cup Bowl none Cup"))
    assert (found.objects, found.same, found.kappa) == (3, 3, pytest.approx(1.0))


def test_kappa_is_undefined_for_one_verdict():
    (found,) = find_agreement(given(Ann="Cup Cup", Bob="Cup Cup"))
    assert found.kappa is None


def test_reviewers_without_an_object_in_common_are_left_out():
    assert find_agreement({"/A": {"Ann": verdict("Cup")}, "/B": {"Bob": verdict("Cup")}}) == []
