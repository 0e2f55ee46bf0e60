"""docs/validation.md documents each rule and each threshold."""

from pathlib import Path

from usd2kg.validation import read_rules
from usd2kg.validation.shacl import compile_shapes

DOCUMENT = (Path(__file__).parents[2] / "docs" / "validation.md").read_text("utf-8")
CLASHES = ("disjoint-classes", "domain-clash", "range-clash", "class-deprecated", "class-unknown")


def test_documents_each_rule():
    shapes = {rule.id for profile in ("soma", "plain") for rule in compile_shapes(profile)}
    rules = {*shapes, *CLASHES, *read_rules()}
    assert [rule for rule in sorted(rules) if f"`{rule}`" not in DOCUMENT] == []


def test_documents_each_threshold():
    common = {"enabled", "severity", "advice"}
    keys = {key for rule in read_rules().values() for key in rule.settings} - common
    assert [key for key in sorted(keys) if f"`{key}`" not in DOCUMENT] == []
