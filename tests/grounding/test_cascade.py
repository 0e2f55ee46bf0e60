"""A quick grounder, and another for what it is unsure of."""

from collections.abc import Mapping, Sequence

import pytest

from usd2kg.errors import GroundingError
from usd2kg.grounding import CascadeGrounder, ObjectView, Prediction, Status
from usd2kg.ontology import TBox

CUP, BOWL = "http://example.org/Cup", "http://example.org/Bowl"


class Says:
    """A grounder that gives one class, with a confidence by name, and notes what it was asked."""

    is_calibrated = True
    settings: Mapping[str, str] = {}

    def __init__(self, name: str, class_iri: str | None, sure: Mapping[str, float]) -> None:
        self.name, self.class_iri, self.sure = name, class_iri, sure
        self.asked: list[str] = []

    def ground_views(self, views: Sequence[tuple[str, ObjectView]], tbox: TBox) -> list[Prediction]:
        self.asked += [path for path, _ in views]
        status = Status.GROUNDED if self.class_iri else Status.UNREADABLE
        return [
            Prediction(path, self.class_iri, self.sure.get(path), status, self.name, f"{self.name} says so")
            for path, _ in views
        ]


VIEWS = [(f"/{letter}", ObjectView(name=letter)) for letter in "abc"]
FIRST = {"/a": 0.9, "/b": 0.5, "/c": 0.89999}


def classes(predictions: Sequence[Prediction]) -> dict[str, str | None]:
    return {found.prim_path: found.class_iri for found in predictions}


def test_the_second_is_asked_only_where_the_first_is_unsure(home_tbox: TBox):
    second = Says("second", BOWL, {})
    cascade = CascadeGrounder(Says("first", CUP, FIRST), second, 0.9)
    assert classes(cascade.ground_views(VIEWS, home_tbox)) == {"/a": CUP, "/b": BOWL, "/c": BOWL}
    assert second.asked == ["/b", "/c"]
    assert (cascade.report.sure, cascade.report.decided, cascade.report.kept) == (1, 2, 0)


def test_what_the_second_has_no_class_for_stays_and_says_why(home_tbox: TBox):
    cascade = CascadeGrounder(Says("first", CUP, FIRST), Says("second", None, {}), 0.8)
    found = cascade.ground_views(VIEWS, home_tbox)
    assert classes(found) == {"/a": CUP, "/b": CUP, "/c": CUP}
    assert found[1].explanation == "first says so; second: second says so"
    assert found[1].confidence == 0.5
    assert (cascade.report.sure, cascade.report.decided, cascade.report.kept) == (2, 0, 1)


def test_nobody_is_asked_when_all_are_sure(home_tbox: TBox):
    second = Says("second", BOWL, {})
    CascadeGrounder(Says("first", CUP, FIRST), second, 0.0).ground_views(VIEWS, home_tbox)
    assert second.asked == []


def test_an_answer_without_confidence_is_unsure(home_tbox: TBox):
    second = Says("second", BOWL, {})
    CascadeGrounder(Says("first", CUP, {}), second, 0.01).ground_views(VIEWS, home_tbox)
    assert second.asked == ["/a", "/b", "/c"]


@pytest.mark.parametrize("confidence", [-0.1, 1.1, float("nan")])
def test_a_confidence_that_is_none_is_refused(confidence: float):
    with pytest.raises(GroundingError, match="expected a number from 0 to 1"):
        CascadeGrounder(Says("first", CUP, {}), Says("second", CUP, {}), confidence)
