"""What is wrong with the labels of single prims, by what stands on each prim alone.

Labels are evidence, not truth: shipped assets carry placeholders and leftovers.
"""

import difflib
import re
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from pxr import Usd

from usd2kg.scene.label_encodings import (
    LONGEST,
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
from usd2kg.scene.stage import UNREADABLE, error_text
from usd2kg.words import split_identifier

__all__ = ["LabelProblem", "find_problems", "lint_labels", "meant_property", "quote_labels", "stage_prims"]

_PLACEHOLDERS = frozenset(
    """
    class wikidata_class qcode wikidata_qcode hierarchy iri semanticType semanticData semantics labels
    SemanticsAPI SemanticsLabelsAPI SemanticTagAPI
    """.split()
)
"""Names of taxonomies and schemas that turn up where a label should stand."""
_WORD_TAXONOMIES = frozenset({"class", "wikidata_class", "iri"})
_OLDER_NAMES = {"wikidata_qcode": "qcode"}
_LIKE_USD = re.compile(r"semantics?[:_]?labels?:(.+)", re.IGNORECASE)
_LIKE_ISAAC = re.compile(r"semantics?:(?:(.+?):)?(?:params?:)?semantics?_?(type|data)", re.IGNORECASE)
_LIKE_TAG = re.compile(r"semantics?_?tags?:.*", re.IGNORECASE)
_ALIKE = 0.7
"""Likeness from which two names are taken for one and its misspelling."""


class LabelProblem(NamedTuple):
    """Something that is wrong with the labels of one prim."""

    rule: str
    prim_path: str
    layer: str | None
    """The layer whose opinion it is."""
    found: str
    expected: str
    """Empty where `found` says it."""
    advice: str
    """What to do about it."""

    @property
    def message(self) -> str:
        """All of it on one line."""
        return f"{self.found}{f', expected {self.expected}' if self.expected else ''}; {self.advice}"


def lint_labels(source: Any, time: Any = None) -> list[Diagnostic]:
    """Return what is wrong or stale about existing labels, prim by prim in traversal order; code `label`.

    Args:
        source: a stage, or prims. Of a stage, what instances share is reported once.
        time: time code; None for the earliest.
    """
    at = Usd.TimeCode.EarliestTime() if time is None else time
    prims = stage_prims(source) if hasattr(source, "GetPseudoRoot") else source
    problems = (problem for prim in prims for problem in find_problems(prim, at))
    return [Diagnostic("label", problem.message, problem.prim_path, problem.layer) for problem in problems]


def stage_prims(stage: Any) -> Iterator[Any]:
    """Yield the prims of a stage in traversal order; what instances share once."""
    seen = set()
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if prim.IsInstanceProxy():
            shared = prim.GetPrimInPrototype().GetPath()
            if shared in seen:
                continue
            seen.add(shared)
        yield prim


def find_problems(prim: Any, time: Any) -> list[LabelProblem]:
    """Return what is wrong with the labels of one prim at `time`."""
    try:
        return list(_lint_prim(prim, time))
    except UNREADABLE as error:
        found = f"OpenUSD cannot read its labels ({error_text(error)})"
        return [LabelProblem("unreadable", str(prim.GetPath()), None, found, "", "they were not checked")]


class _Problem(NamedTuple):
    rule: str
    about: str
    """The property, or the schema."""
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
    mistyped = {problem.about: problem for problem in _lint_types(prim, names)}
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
    for rule, about, told, expected, advice in problems:
        yield LabelProblem(rule, str(prim.GetPath()), _layer_of(prim, about, time), told, expected, advice)


def _layer_of(prim: Any, about: str, time: Any) -> str | None:
    """Return the layer with the strongest opinion on a property, or that applies a schema."""
    prop = prim.GetProperty(about)
    specs = prop.GetPropertyStack(time) if prop else [spec for spec in prim.GetPrimStack() if about in _applies(spec)]
    return str(specs[0].layer.identifier) if specs else None


def _applies(spec: Any) -> list[str]:
    return list(spec.GetInfo("apiSchemas").GetAddedOrExplicitItems()) if spec.HasInfo("apiSchemas") else []


def _lint_types(prim: Any, names: Sequence[str]) -> Iterator[_Problem]:
    """Yield labels of OpenUSD's encoding of which its own reader takes no value, because of their type."""
    for name in names:
        found = property_type(prim, name)
        if name.startswith(USD_PREFIX) and found != USD_LABEL_TYPE:
            told = f"{name} is {f'of type {found}' if found else 'a relationship'}, in which OpenUSD finds no labels"
            yield _Problem("label-type", name, told, USD_LABEL_TYPE, "author it anew with that type")


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
        elif len(value) > LONGEST:
            long = f"{where} has a value of {len(value)} characters"
            yield _Problem("label-long", where, long, f"at most {LONGEST}", "shorten it")
        elif entry.encoding != "Multiverse" and (value in _PLACEHOLDERS or value in taxonomies):
            told = f"{is_one}, a name of a taxonomy or schema and no label"
            yield _Problem("label-placeholder", where, told, "", "author the label")
        elif is_qcode and not QCODE.fullmatch(value):
            item = "a Wikidata item such as Q11422"
            yield _Problem("qcode-malformed", where, is_one, item, "correct it or remove it")
        if value and values.count(value) > 1:
            told = f"{where} lists {quote_labels([value])} {values.count(value)} times"
            yield _Problem("label-repeated", where, told, "", "keep one")


def _lint_pairs(entries: Sequence[LabelProperty], names: Sequence[str]) -> Iterator[_Problem]:
    """Yield Isaac labels of which one half is missing, or stands under a name that is spelt otherwise."""
    halves: dict[str, list[tuple[str, str]]] = {"Type": [], "Data": []}
    for entry in entries:
        instance = isaac_instance(entry.property_name) or ""
        if not entry.taxonomy:
            halves["Type"].append((instance, isaac_property(instance, "Data")))
        if not entry.values:
            halves["Data"].append((instance, isaac_property(instance, "Type")))
    lonely_types = [instance for instance, name in halves["Data"] if name in names]
    for missing, found in halves.items():
        for instance, name in found:
            other = _alike(instance, lonely_types) if missing == "Type" and name in names else None
            if other:
                lonely_types.remove(other)
                halves["Data"] = [half for half in halves["Data"] if half[0] != other]
                told = f"{name} stands alone, and so does {isaac_property(other, 'Type')}"
                yield _Problem("isaac-instance", name, told, "one instance name for both", "rename one of them")
            else:
                told = f"{name} has no semantic{missing} with text beside it"
                yield _Problem("isaac-half", name, told, "", "author both or remove both")


def _alike(name: str, others: Sequence[str]) -> str | None:
    known = {other.lower(): other for other in others}
    return next((known[match] for match in difflib.get_close_matches(name.lower(), known, 1, _ALIKE)), None)


def _lint_targets(prim: Any, name: str) -> Iterator[_Problem]:
    for target in tag_targets(prim, name):
        tagged = prim.GetStage().GetPrimAtPath(target)
        if not tagged:
            told = f"{name} points to <{target}>, which is not on the stage"
            yield _Problem("tag-target-missing", name, told, "", "add the ontology's layer")
        elif not any(clean_values(tagged, "rdf:conceptName", None)):
            told = f"{name} points to <{target}>, which has no rdf:conceptName"
            yield _Problem("tag-target-no-class", name, told, "", "point it to a class prim")


def _lint_schemas(names: list[str], schemas: list[str]) -> Iterator[_Problem]:
    """Yield schemas without their properties, and properties without their schema, which tools then do not see."""
    expected = {schema: name for name in reversed(names) if (schema := schema_of(name))}
    unused = [schema for schema in schemas if schema not in expected]
    bare = {schema: name for schema, name in sorted(expected.items()) if schema not in schemas}
    for schema, name in list(bare.items()):
        instances = [other for other in unused if other.startswith(isaac_schema(""))]
        other = _alike(schema, instances) if schema.startswith(isaac_schema("")) else None
        if other:
            unused.remove(other)
            del bare[schema]
            told = f"{name} is authored, but {other} is applied"
            yield _Problem("isaac-instance", name, told, schema, "correct the name of one of them")
    for schema in unused:
        told = f"{schema} is applied, but no label of it is authored"
        yield _Problem("schema-without-label", schema, told, "", "author the label or remove the schema")
    for schema, name in bare.items():
        told = f"{name} is authored, but {schema} is not applied, so that tools may not see it"
        yield _Problem("label-without-schema", name, told, "", "apply it")


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
            told = f"{name} says {quote_labels(values)}, but {other} says {quote_labels(other_values)}"
            yield _Problem("encodings-contradict", name, told, "", "keep the right one and remove the other")


def _by_taxonomy(found: list[LabelProperty], encoding: Encoding) -> dict[str, list[str]]:
    grouped: dict[str, list[str]] = {}
    for entry in found:
        if entry.encoding == encoding and entry.taxonomy and any(entry.values):
            grouped.setdefault(entry.taxonomy, []).extend(filter(None, entry.values))
    return grouped


def _words(values: list[str]) -> set[str]:
    return {word for value in values for word in class_words(value)}


def _lint_name(name: str) -> Iterator[_Problem]:
    """Yield a property that is no label but looks as if it was meant to be one."""
    if meant := meant_property(name):
        yield _Problem("property-misspelt", name, f"{name} is no label that any tool reads", meant, "rename it")


def meant_property(name: str) -> str | None:
    """Return the property of a label that a misspelt one was meant to be; None for labels, and for what is unlike."""
    if schema_of(name) is not None:
        return None
    if like := _LIKE_USD.fullmatch(name):
        return USD_PREFIX + like[1]
    if like := _LIKE_ISAAC.fullmatch(name):
        return isaac_property(like[1] or "Semantics", like[2].capitalize())
    return difflib.get_close_matches(name, TAGS, 1, 0)[0] if _LIKE_TAG.fullmatch(name) else None


def quote_labels(values: Sequence[str]) -> str:
    """Return up to four of the values in quotes, long ones shortened."""
    shown = (value if len(value) <= 60 else value[:59] + "…" for value in dict.fromkeys(values))
    return ", ".join(map(repr, list(shown)[:4]))
