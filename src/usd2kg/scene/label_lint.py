"""Lint semantic labels prim by prim.

Labels are evidence, not truth: published assets carry placeholders and leftovers.
"""

import difflib
import re
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from pxr import Usd

from usd2kg.knowledge import word_set
from usd2kg.scene.label_encodings import (
    QCODE,
    TAG_LABELS,
    TAGS,
    USD_LABEL_TYPE,
    USD_PREFIX,
    LabelProperty,
    applied_schemas,
    class_words,
    clean_values,
    find_labels,
    isaac_instance,
    isaac_property,
    isaac_schema,
    property_type,
    schema_of,
    semantic_names,
    tag_targets,
)
from usd2kg.scene.model import Diagnostic, Encoding
from usd2kg.scene.settings import LABELS, LIMITS
from usd2kg.scene.stage import UNREADABLE, error_text
from usd2kg.words import split_identifier

__all__ = ["LabelProblem", "find_problems", "lint_labels", "meant_property", "quote_labels", "stage_prims"]

_PLACEHOLDERS = word_set("scene", "label_placeholders")
_WORD_TAXONOMIES = frozenset({"class", "wikidata_class", "iri"})
_OLDER_NAMES = {"wikidata_qcode": "qcode"}
_LIKE_USD = re.compile(r"semantics?[:_]?labels?:(.+)", re.IGNORECASE)
_LIKE_ISAAC = re.compile(r"semantics?:(?:(.+?):)?(?:params?:)?semantics?_?(type|data)", re.IGNORECASE)
_LIKE_TAG = re.compile(r"semantics?_?tags?:.*", re.IGNORECASE)
_MAX_QUOTED = 4
_MAX_QUOTED_LENGTH = 60
"""Number of values that a message quotes, and characters of each."""


class LabelProblem(NamedTuple):
    """A problem of the labels of one prim."""

    rule: str
    prim_path: str
    layer: str | None
    """The layer with the strongest opinion."""
    found: str
    expected: str
    """Empty if `found` implies it."""
    advice: str

    @property
    def message(self) -> str:
        """What was found, what was expected and what to do, on one line."""
        return f"{self.found}{f', expected {self.expected}' if self.expected else ''}; {self.advice}"


def lint_labels(source: Any, time: Any = None) -> list[Diagnostic]:
    """Return diagnostics with code `label` for wrong or stale labels, in traversal order.

    Args:
        source: a stage, or prims. On a stage, problems that instances share are reported once.
        time: time code; None for the earliest.
    """
    at = Usd.TimeCode.EarliestTime() if time is None else time
    prims = stage_prims(source) if hasattr(source, "GetPseudoRoot") else source
    problems = (problem for prim in prims for problem in find_problems(prim, at))
    return [Diagnostic("label", problem.message, problem.prim_path, problem.layer) for problem in problems]


def stage_prims(stage: Any) -> Iterator[Any]:
    """Yield the prims of a stage in traversal order, prims shared by instances only once."""
    seen = set()
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if prim.IsInstanceProxy():
            shared = prim.GetPrimInPrototype().GetPath()
            if shared in seen:
                continue
            seen.add(shared)
        yield prim


def find_problems(prim: Any, time: Any) -> list[LabelProblem]:
    """Return the problems of the labels of one prim at `time`."""
    try:
        return list(_lint_prim(prim, time))
    except UNREADABLE as error:
        found = f"OpenUSD cannot read its labels ({error_text(error)})"
        return [LabelProblem("unreadable", str(prim.GetPath()), None, found, "", "they were not checked")]


class _Problem(NamedTuple):
    rule: str
    subject: str
    """The property or schema."""
    found: str
    expected: str
    advice: str


def _lint_prim(prim: Any, time: Any) -> Iterator[LabelProblem]:
    names = semantic_names(prim)
    schemas = applied_schemas(prim)
    if not names and not schemas:
        return
    found = find_labels(prim, names, time)
    taxonomies = {entry.taxonomy for entry in found}
    mistyped = {problem.subject: problem for problem in _lint_types(prim, names)}
    readable = [entry for entry in found if any(entry.values) or entry.property_name not in mistyped]
    problems = [
        *mistyped.values(),
        *(problem for entry in readable for problem in _lint_values(entry, taxonomies)),
        *_lint_pairs([entry for entry in found if entry.encoding == "Isaac"], names),
        *(problem for name in TAGS if name in names for problem in _lint_targets(prim, name)),
        *_lint_schemas(names, schemas),
        *_lint_contradictions(found),
        *(problem for name in names for problem in _lint_name(name)),
    ]
    for rule, subject, statement, expected, advice in problems:
        yield LabelProblem(rule, str(prim.GetPath()), _layer_of(prim, subject, time), statement, expected, advice)


def _layer_of(prim: Any, subject: str, time: Any) -> str | None:
    """Return the layer with the strongest opinion on a property, or the layer that applies a schema."""
    prop = prim.GetProperty(subject)
    specs = (
        prop.GetPropertyStack(time) if prop else [spec for spec in prim.GetPrimStack() if subject in _api_schemas(spec)]
    )
    return str(specs[0].layer.identifier) if specs else None


def _api_schemas(spec: Any) -> list[str]:
    return list(spec.GetInfo("apiSchemas").GetAddedOrExplicitItems()) if spec.HasInfo("apiSchemas") else []


def _lint_types(prim: Any, names: Sequence[str]) -> Iterator[_Problem]:
    """Yield a problem for each label in OpenUSD's encoding that OpenUSD ignores because of its type."""
    for name in names:
        found = property_type(prim, name)
        if name.startswith(USD_PREFIX) and found != USD_LABEL_TYPE:
            statement = (
                f"{name} is {f'of type {found}' if found else 'a relationship'}; OpenUSD reads no labels from it"
            )
            yield _Problem("label-type", name, statement, USD_LABEL_TYPE, "author it again with that type")


def _lint_values(entry: LabelProperty, taxonomies: set[str]) -> Iterator[_Problem]:
    where, values = entry.property_name, entry.values
    if not any(values):
        if values or entry.encoding == "UsdSemantics":
            nothing = f"{where} holds no label (empty, blank or not text)"
            yield _Problem("label-empty", where, nothing, "one", "author it or remove it")
        return
    is_qcode = split_identifier(entry.taxonomy.lower())[-1:] == ("qcode",)
    for value in dict.fromkeys(values):
        is_one = f"{where} is {quote_labels([value])}"
        if not value:
            yield _Problem("label-empty", where, f"{where} has a blank value among {len(values)}", "", "remove it")
        elif len(value) > LIMITS.max_text_length:
            long = f"{where} has a value of {len(value)} characters"
            yield _Problem("label-long", where, long, f"at most {LIMITS.max_text_length}", "shorten it")
        elif entry.encoding != "Multiverse" and (value in _PLACEHOLDERS or value in taxonomies):
            statement = f"{is_one}, a name of a taxonomy or schema and no label"
            yield _Problem("label-placeholder", where, statement, "", "author the label")
        elif is_qcode and not QCODE.fullmatch(value):
            item = "a Wikidata item such as Q11422"
            yield _Problem("qcode-malformed", where, is_one, item, "correct it or remove it")
        if value and values.count(value) > 1:
            statement = f"{where} lists {quote_labels([value])} {values.count(value)} times"
            yield _Problem("label-repeated", where, statement, "", "keep one")


def _lint_pairs(entries: Sequence[LabelProperty], names: Sequence[str]) -> Iterator[_Problem]:
    """Yield a problem for each Isaac label with one half missing, or with halves whose instance names are misspelt."""
    halves: dict[str, list[tuple[str, str]]] = {"Type": [], "Data": []}
    for entry in entries:
        instance = isaac_instance(entry.property_name) or ""
        if not entry.taxonomy:
            halves["Type"].append((instance, isaac_property(instance, "Data")))
        if not entry.values:
            halves["Data"].append((instance, isaac_property(instance, "Type")))
    unpaired_types = [instance for instance, name in halves["Data"] if name in names]
    for missing, found in halves.items():
        for instance, name in found:
            other = _similar(instance, unpaired_types) if missing == "Type" and name in names else None
            if other:
                unpaired_types.remove(other)
                halves["Data"] = [half for half in halves["Data"] if half[0] != other]
                statement = f"{name} stands alone, and so does {isaac_property(other, 'Type')}"
                yield _Problem("isaac-instance", name, statement, "one instance name for both", "rename one of them")
            else:
                statement = f"{name} has no semantic{missing} with text beside it"
                yield _Problem("isaac-half", name, statement, "", "author both or remove both")


def _similar(name: str, others: Sequence[str]) -> str | None:
    """Return the name that `name` is probably a misspelling of; None if there is none."""
    known = {other.lower(): other for other in others}
    matches = difflib.get_close_matches(name.lower(), known, 1, LABELS.min_similarity)
    return known[matches[0]] if matches else None


def _lint_targets(prim: Any, name: str) -> Iterator[_Problem]:
    for target in tag_targets(prim, name):
        tagged = prim.GetStage().GetPrimAtPath(target)
        if not tagged:
            statement = f"{name} points to <{target}>, which is not on the stage"
            yield _Problem("tag-target-missing", name, statement, "", "add the ontology's layer")
        elif not any(clean_values(tagged, "rdf:conceptName", None)):
            statement = f"{name} points to <{target}>, which has no rdf:conceptName"
            yield _Problem("tag-target-no-class", name, statement, "", "point it to a class prim")


def _lint_schemas(names: list[str], schemas: list[str]) -> Iterator[_Problem]:
    """Yield problems of schemas without their properties and of properties without their schema, which tools ignore."""
    expected = {schema: name for name in reversed(names) if (schema := schema_of(name))}
    unused = [schema for schema in schemas if schema not in expected]
    bare = {schema: name for schema, name in sorted(expected.items()) if schema not in schemas}
    for schema, name in list(bare.items()):
        instances = [other for other in unused if other.startswith(isaac_schema(""))]
        other = _similar(schema, instances) if schema.startswith(isaac_schema("")) else None
        if other:
            unused.remove(other)
            del bare[schema]
            statement = f"{name} is authored, but {other} is applied"
            yield _Problem("isaac-instance", name, statement, schema, "correct the name of one of them")
    for schema in unused:
        statement = f"{schema} is applied, but no label of it is authored"
        yield _Problem("schema-without-label", schema, statement, "", "author the label or remove the schema")
    for schema, name in bare.items():
        statement = f"{name} is authored, but {schema} is not applied, so that tools may not see it"
        yield _Problem("label-without-schema", name, statement, "", "apply it")


def _lint_contradictions(found: list[LabelProperty]) -> Iterator[_Problem]:
    usd, isaac = _by_taxonomy(found, "UsdSemantics"), _by_taxonomy(found, "Isaac")
    pairs = []
    for taxonomy, values in sorted(usd.items()):
        older = taxonomy if taxonomy in isaac else _OLDER_NAMES.get(taxonomy, "")
        pairs.append((USD_PREFIX + taxonomy, values, f"the older {older} in semantic:*:params", isaac.get(older, [])))
    tags = [value for entry in found if entry.property_name == TAG_LABELS for value in entry.values]
    for encoding, labels in (("UsdSemantics", usd), ("Isaac", isaac)):
        classes = [value for taxonomy in sorted(_WORD_TAXONOMIES & labels.keys()) for value in labels[taxonomy]]
        pairs.append((TAG_LABELS, tags, f"the {encoding} class", [c for c in classes if not QCODE.fullmatch(c)]))
    for name, values, other, other_values in pairs:
        if values and other_values and _words(values).isdisjoint(_words(other_values)):
            statement = f"{name} says {quote_labels(values)}, but {other} says {quote_labels(other_values)}"
            yield _Problem("encodings-contradict", name, statement, "", "keep the right one and remove the other")


def _by_taxonomy(found: list[LabelProperty], encoding: Encoding) -> dict[str, list[str]]:
    grouped: dict[str, list[str]] = {}
    for entry in found:
        if entry.encoding == encoding and entry.taxonomy and any(entry.values):
            grouped.setdefault(entry.taxonomy, []).extend(filter(None, entry.values))
    return grouped


def _words(values: list[str]) -> set[str]:
    return {word for value in values for word in class_words(value)}


def _lint_name(name: str) -> Iterator[_Problem]:
    """Yield a problem if the name of a property is a misspelling of a label property."""
    if meant := meant_property(name):
        yield _Problem("property-misspelt", name, f"{name} is not a label that any tool reads", meant, "rename it")


def meant_property(name: str) -> str | None:
    """Return the label property that a name is a misspelling of; None for label properties and unrelated names."""
    if schema_of(name) is not None:
        return None
    if like := _LIKE_USD.fullmatch(name):
        return USD_PREFIX + like[1]
    if like := _LIKE_ISAAC.fullmatch(name):
        return isaac_property(like[1] or "Semantics", like[2].capitalize())
    return difflib.get_close_matches(name, TAGS, 1, 0)[0] if _LIKE_TAG.fullmatch(name) else None


def quote_labels(values: Sequence[str]) -> str:
    """Return up to four distinct values in quotes, long ones shortened."""
    longest = _MAX_QUOTED_LENGTH
    shown = (value if len(value) <= longest else value[: longest - 1] + "…" for value in dict.fromkeys(values))
    return ", ".join(map(repr, list(shown)[:_MAX_QUOTED]))
