"""read_answer_rows: rows of completions and the spans of their classes."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from usd2kg.grounding.llm.answer_rows import read_answer_rows


def spans(text: str, *numbers: str) -> dict[str, str | None]:
    """Return number → text in the class span of the row."""
    rows = read_answer_rows(text, numbers)
    return {number: text[slice(*row.class_span)] if row.class_span else None for number, row in rows.items()}


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ('{"1": {"class": "Cup"}, "2": {"class": "Fork"}}', {"1": "Cup", "2": "Fork"}),
        ('{ "1" :\n{ "class"\t:  "Cup" , "why": "{}" } ,"2":{"class":"Fork"}}', {"1": "Cup", "2": "Fork"}),
        ('{"1": "Cup", "2": "Fork"}', {"1": "Cup", "2": "Fork"}),
        ('{"1": {"reasoning": "a \\"class\\": \\"Fork\\", no", "class": "Cup"}, "2": {}}', {"1": "Cup", "2": None}),
        ('{"1": {"class": null}, "2": {"class": 7}}', {"1": "null", "2": "7"}),
        ('{"1": {"class": "Fork", "class": "Cup"}, "2": {"class": "x"}, "2": {"class": "y"}}', {"1": "Cup", "2": "y"}),
        ('I think: ```json\n{"1": {"class": "Cup"}}\n``` or so', {"1": "Cup"}),
        ('{"1": {"class": "Cup"}} no: {"1": {"class": "Fork"}}', {"1": "Fork"}),
        ('{"1": {"class": "Cup"}, "2": {"class": "Fo', {"1": "Cup"}),
        ('{"1": "Cup", "2": {"class"', {"1": "Cup"}),
        ('{"1": {"class": "Caf\\u00e9"}}', {"1": "Caf\\u00e9"}),
        ('{"1": {"class": ""}}', {"1": ""}),
        ("no rows", {}),
    ],
)
def test_finds_the_class_span_of_each_row(text: str, expected: dict[str, str | None]):
    assert spans(text, "1", "2") == expected


def test_accepts_a_row_without_number_for_a_single_object():
    assert spans('{"reasoning": "Cup?", "class": "Cup"}', "1") == {"1": "Cup"}
    assert spans('{"class": "Cup"}', "1", "2") == {}


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.sampled_from(["class", "1", 'a"b', ""]), inner),
    max_leaves=8,
)


@given(
    rows=st.dictionaries(st.sampled_from("123"), JSON), indent=st.none() | st.integers(0, 2), before=st.text(max_size=9)
)
def test_spans_contain_the_decoded_classes(rows: dict, indent: int | None, before: str):
    text = before.replace("{", "") + json.dumps(rows, indent=indent)
    found = read_answer_rows(text, ("1", "2", "3"))
    assert {number: row.value for number, row in found.items()} == rows
    for number, row in found.items():
        value = rows[number]
        if isinstance(value, dict) and "class" not in value:
            assert row.class_span is None
            continue
        start, end = row.class_span
        expected = value["class"] if isinstance(value, dict) else value
        quotes = 1 if isinstance(expected, str) else 0
        assert json.loads(text[start - quotes : end + quotes]) == expected
