"""CascadeGrounder with two fake grounders."""

from collections.abc import Mapping, Sequence

import pytest

from usd2kg.errors import GroundingError
from usd2kg.grounding import CascadeGrounder, ObjectView, Prediction, Status
from usd2kg.ontology import TBox

CUP, BOWL = "http://example.org/Cup", "http://example.org/Bowl"


class FixedGrounder:
    """A fake grounder with one class and a confidence per prim, which records its calls."""

    is_calibrated = True
    settings: Mapping[str, str] = {}

    def __init__(self, name: str, class_iri: str | None, sure: Mapping[str, float]) -> None:
        self.name, self.class_iri, self.sure = name, class_iri, sure
        self.calls: list[str] = []

    def ground_views(self, views: Sequence[tuple[str, ObjectView]], tbox: TBox) -> list[Prediction]:
        self.calls += [path for path, _ in views]
        status = Status.GROUNDED if self.class_iri else Status.UNREADABLE
        return [
            Prediction(path, self.class_iri, self.sure.get(path), status, self.name, f"{self.name} decided")
            for path, _ in views
        ]


VIEWS = [(f"/{letter}", ObjectView(name=letter)) for letter in "abc"]
FIRST = {"/a": 0.9, "/b": 0.5, "/c": 0.89999}


def classes(predictions: Sequence[Prediction]) -> dict[str, str | None]:
    return {found.prim_path: found.class_iri for found in predictions}


def test_second_grounder_gets_only_uncertain_objects(home_tbox: TBox):
    second = FixedGrounder("second", BOWL, {})
    cascade = CascadeGrounder(FixedGrounder("first", CUP, FIRST), second, 0.9)
    assert classes(cascade.ground_views(VIEWS, home_tbox)) == {"/a": CUP, "/b": BOWL, "/c": BOWL}
    assert second.calls == ["/b", "/c"]
    assert (cascade.report.sure, cascade.report.decided, cascade.report.kept) == (1, 2, 0)


def test_keeps_the_first_prediction_if_the_second_has_no_class(home_tbox: TBox):
    cascade = CascadeGrounder(FixedGrounder("first", CUP, FIRST), FixedGrounder("second", None, {}), 0.8)
    found = cascade.ground_views(VIEWS, home_tbox)
    assert classes(found) == {"/a": CUP, "/b": CUP, "/c": CUP}
    assert found[1].explanation == "first decided; second: second decided"
    assert found[1].confidence == 0.5
    assert (cascade.report.sure, cascade.report.decided, cascade.report.kept) == (2, 0, 1)


def test_does_not_call_the_second_grounder_if_all_are_certain(home_tbox: TBox):
    second = FixedGrounder("second", BOWL, {})
    CascadeGrounder(FixedGrounder("first", CUP, FIRST), second, 0.0).ground_views(VIEWS, home_tbox)
    assert second.calls == []


def test_a_prediction_without_confidence_is_uncertain(home_tbox: TBox):
    second = FixedGrounder("second", BOWL, {})
    CascadeGrounder(FixedGrounder("first", CUP, {}), second, 0.01).ground_views(VIEWS, home_tbox)
    assert second.calls == ["/a", "/b", "/c"]


@pytest.mark.parametrize("confidence", [-0.1, 1.1, float("nan")])
def test_rejects_a_confidence_outside_0_to_1(confidence: float):
    with pytest.raises(GroundingError, match="expected a number from 0 to 1"):
        CascadeGrounder(FixedGrounder("first", CUP, {}), FixedGrounder("second", CUP, {}), confidence)
