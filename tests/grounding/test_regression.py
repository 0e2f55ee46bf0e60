"""Groups of names are grounded at least as well as their floors; `regression.py` documents the lists."""

import pytest

from tests.grounding import regression
from tests.grounding.ontologies import load_ontology
from usd2kg.ontology import TBox


@pytest.mark.parametrize("group", regression.groups())
def test_share_right_stays_above_the_floor(group: str):
    cases = regression.score(group)
    wrong = [case for case in cases if not case.is_right]
    share = 100 * (1 - len(wrong) / len(cases))
    listed = "\n".join(f"  {case}" for case in wrong)
    floor = regression.floors()[group].percent_right
    assert share >= floor, f"{share:.1f} % of {len(cases)} cases right, expected at least {floor} %; wrong:\n{listed}"


def test_each_group_has_a_floor_for_its_number_of_cases():
    counted = {group: len(rows) for group, rows in regression.groups().items()}
    floors = {group: floor.cases for group, floor in regression.floors().items()}
    assert floors == counted, "run `python -m tests.grounding.regression --update`"


def test_expected_classes_are_classes_of_the_ontology():
    rows = [row for group in regression.groups().values() for row in group if "ontology" in row]
    unknown = [
        (row["name"], name)
        for row in rows
        for name in [row["expected"], *filter(None, row["also"].split("|"))]
        if name not in _names(load_ontology(row["ontology"]))
    ]
    assert unknown == []


def _names(tbox: TBox) -> set[str]:
    return {"(none)", *(cls.local_name for cls in tbox.classes)}
