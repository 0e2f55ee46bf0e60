"""read_schema: fixed text, choices and free texts; and the tokens inside a JSON string."""

import pytest

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.local.json_tokens import classify_tokens
from usd2kg.grounding.llm.local.skeleton import Choice, Fixed, FreeText, read_schema

CLASS = {"type": "string", "enum": ["Cup", "Knife"]}
REASONING = {"type": "string"}


def record(**properties: object) -> dict[str, object]:
    return {"type": "object", "properties": properties, "required": [*properties], "additionalProperties": False}


def test_each_property_is_a_row_with_the_preceding_text():
    rows = read_schema(record(**{"1": record(**{"class": CLASS}), "2": record(**{"class": CLASS})}))
    assert rows == [
        (Fixed('{"1": {"class": "'), Choice(("Cup", "Knife")), Fixed('"}')),
        (Fixed(', "2": {"class": "'), Choice(("Cup", "Knife")), Fixed('"}')),
    ]


def test_keeps_the_order_and_treats_plain_strings_as_free_text():
    (row,) = read_schema(record(**{"1": record(reasoning=REASONING, **{"class": CLASS})}))
    assert row == (
        Fixed('{"1": {"reasoning": "'),
        FreeText(),
        Fixed('", "class": "'),
        Choice(("Cup", "Knife")),
        Fixed('"}'),
    )


def test_accepts_nested_objects_and_top_level_strings():
    (first, second) = read_schema(record(a=CLASS, b=record(c=record(d=REASONING))))
    assert first == (Fixed('{"a": "'), Choice(("Cup", "Knife")), Fixed('"'))
    assert second == (Fixed(', "b": {"c": {"d": "'), FreeText(), Fixed('"}}'))


def test_escapes_keys_and_names_for_json():
    (row,) = read_schema(record(**{'a"b': {"type": "string", "enum": ['5" pipe', "Tür"]}}))
    assert row[:2] == (Fixed('{"a\\"b": "'), Choice(('5\\" pipe', "Tür")))


@pytest.mark.parametrize(
    "schema", [{"type": "array"}, {"type": "object"}, record(a={"type": "number"}), record(a={"$ref": "#/b"})]
)
def test_rejects_other_schema_types(schema: dict[str, object]):
    with pytest.raises(GroundingError, match=r"^schema of the answer: found .*; expected an object with properties"):
        read_schema(schema)


def test_classifies_tokens_by_their_role_in_a_string():
    pieces = [b"", b"cup", b'"', b'",', b'. "', b'\\"', b"\\", b"a\nb", b"\xc3", b"\x00", b'\\u"', b"\\n"]
    vocabulary = classify_tokens(pieces, [0])
    assert vocabulary.closers.tolist() == [2, 3]
    assert vocabulary.heads == {0: b"", 2: b"", 3: b"", 4: b". "}
    # Excluded: a backslash that escapes the closing quote, control characters, an incomplete escape.
    assert vocabulary.texts.tolist() == [0, 1, 2, 3, 4, 5, 8, 11]
