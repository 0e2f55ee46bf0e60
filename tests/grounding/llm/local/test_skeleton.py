"""Schemas of answers as what is certain and what is chosen."""

import pytest

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.local.json_tokens import classify_tokens
from usd2kg.grounding.llm.local.skeleton import Choice, Fixed, FreeText, read_schema

CLASS = {"type": "string", "enum": ["Cup", "Knife"]}
REASONING = {"type": "string"}


def record(**properties: object) -> dict[str, object]:
    return {"type": "object", "properties": properties, "required": [*properties], "additionalProperties": False}


def test_each_property_is_a_row_with_what_stands_before_it():
    rows = read_schema(record(**{"1": record(**{"class": CLASS}), "2": record(**{"class": CLASS})}))
    assert rows == [
        (Fixed('{"1": {"class": "'), Choice(("Cup", "Knife")), Fixed('"}')),
        (Fixed(', "2": {"class": "'), Choice(("Cup", "Knife")), Fixed('"}')),
    ]


def test_properties_keep_their_order_and_strings_without_a_list_are_free():
    (row,) = read_schema(record(**{"1": record(reasoning=REASONING, **{"class": CLASS})}))
    assert row == (
        Fixed('{"1": {"reasoning": "'),
        FreeText(),
        Fixed('", "class": "'),
        Choice(("Cup", "Knife")),
        Fixed('"}'),
    )


def test_objects_may_stand_at_any_depth_and_strings_at_the_top():
    (first, second) = read_schema(record(a=CLASS, b=record(c=record(d=REASONING))))
    assert first == (Fixed('{"a": "'), Choice(("Cup", "Knife")), Fixed('"'))
    assert second == (Fixed(', "b": {"c": {"d": "'), FreeText(), Fixed('"}}'))


def test_keys_and_names_are_written_as_json_has_them():
    (row,) = read_schema(record(**{'a"b': {"type": "string", "enum": ['5" pipe', "Tür"]}}))
    assert row[:2] == (Fixed('{"a\\"b": "'), Choice(('5\\" pipe', "Tür")))


@pytest.mark.parametrize(
    "schema", [{"type": "array"}, {"type": "object"}, record(a={"type": "number"}), record(a={"$ref": "#/b"})]
)
def test_what_else_a_schema_may_hold_is_refused(schema: dict[str, object]):
    with pytest.raises(GroundingError, match=r"^schema of the answer: found .*; expected an object with properties"):
        read_schema(schema)


def test_tokens_inside_a_string_are_told_apart():
    pieces = [b"", b"cup", b'"', b'",', b'. "', b'\\"', b"\\", b"a\nb", b"\xc3", b"\x00", b'\\u"', b"\\n"]
    vocabulary = classify_tokens(pieces, [0])
    assert vocabulary.closers.tolist() == [2, 3]
    assert vocabulary.heads == {0: b"", 2: b"", 3: b"", 4: b". "}
    # Not: a backslash that would change the quote behind it, control characters, an escape cut short.
    assert vocabulary.texts.tolist() == [0, 1, 2, 3, 4, 5, 8, 11]
