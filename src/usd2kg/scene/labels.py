"""Semantic labels that a stage already carries, in the three encodings in use, and what is wrong with them.

- OpenUSD's own: `token[] semantics:labels:<taxonomy>`, schema `SemanticsLabelsAPI:<taxonomy>` (UsdSemantics).
- Isaac and Replicator: `semantic:<instance>:params:semanticType` and `semanticData`, schema `SemanticsAPI:<instance>`.
- Multiverse: `rel semanticTag:semanticLabels` and `semanticReports`, to class prims with `rdf:conceptName`.

Labels are evidence, not truth: shipped assets carry placeholders and leftovers, which `lint_labels` finds.
"""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any, Literal, NamedTuple

from pxr import Usd, UsdGeom

from usd2kg.scene.metadata import clean_text, texts_of
from usd2kg.scene.model import Diagnostic
from usd2kg.scene.outline import Node
from usd2kg.words import split_identifier, words_of

__all__ = ["Label", "LabelReader", "ObjectLabels", "lint_labels", "read_labels"]

Encoding = Literal["UsdSemantics", "Isaac", "Multiverse"]

_LONGEST = 200
_MOST_PARTS = 64
_USD = "semantics:labels:"
_TAGS = "semanticTag:"
_ISAAC = re.compile(r"semantic:(.+):params:semantic(Type|Data)")
_SCHEMA_OF = {"UsdSemantics": "SemanticsLabelsAPI:", "Isaac": "SemanticsAPI:", "Multiverse": "SemanticTagAPI"}
_PLACEHOLDERS = frozenset(
    """
    class wikidata_class qcode wikidata_qcode hierarchy iri semanticType semanticData semantics labels
    SemanticsAPI SemanticsLabelsAPI SemanticTagAPI
    """.split()
)
"""Names of taxonomies and schemas that turn up where a label should stand."""
_CLASS_TAXONOMIES = frozenset({"class", "wikidata_class", "iri"})
_SAME_TAXONOMY = {"qcode": "wikidata_qcode"}


@dataclass(frozen=True, slots=True)
class Label:
    """One label as the stage has it, white space and unprintable characters cleaned up."""

    prim_path: str
    """The prim that carries the label: for an inherited one, the prim above."""
    encoding: Encoding
    """How it is written on the stage."""
    taxonomy: str
    """What the value is a word of: `class`, `wikidata_qcode`… For Multiverse the ontology's namespace IRI, or the
    name of the ontology's prim where the namespace is not authored."""
    value: str
    """The label: a class name, a Wikidata item, a path of classes, whatever was authored."""
    is_inherited: bool = False
    """Whether it stands on a prim above the one asked for; UsdSemantics lets labels inherit down the namespace."""
    strength: Literal["label", "report"] = "label"
    """`report` for Multiverse's semanticReports: candidates that a tool brought up, weaker than labels."""

    @property
    def iri(self) -> str | None:
        """IRI of the class where the label states one, else None."""
        if self.encoding == "Multiverse" and self.taxonomy.endswith(("#", "/")):
            return self.taxonomy + self.value
        return self.value if self.taxonomy == "iri" else None


class ObjectLabels(NamedTuple):
    """The labels of one object, kept apart by where they stand; each set without repetitions."""

    own: tuple[Label, ...]
    """On the object's prim."""
    inherited: tuple[Label, ...]
    """On prims above it, nearest first, without those it has itself."""
    of_parts: tuple[Label, ...]
    """On prims and geometry subsets below it, nested objects left out; at most 64."""


class LabelReader:
    """Reads the labels of objects at one time; what stands above several objects is read once."""

    def __init__(self, time: Any) -> None:
        self._time = time
        self._above: dict[str, tuple[Label, ...]] = {}

    def read(self, nodes: list[Node]) -> ObjectLabels:
        """Return the labels of the object whose own nodes are `nodes`, its prim first."""
        own = read_labels(nodes[0].prim, self._time)
        told = {_key(label) for label in own}
        inherited = [label for label in self._inherited(nodes[0].prim.GetParent()) if _key(label) not in told]
        below = (label for prim in _parts(nodes) for label in read_labels(prim, self._time))
        return ObjectLabels(own, tuple(inherited), _distinct(below)[:_MOST_PARTS])

    def _inherited(self, prim: Any) -> tuple[Label, ...]:
        if not prim or prim.IsPseudoRoot():
            return ()
        path = str(prim.GetPath())
        if path not in self._above:
            here = (replace(label, is_inherited=True) for label in read_labels(prim, self._time))
            self._above[path] = _distinct([*here, *self._inherited(prim.GetParent())])
        return self._above[path]


def _parts(nodes: list[Node]) -> Iterator[Any]:
    for node in nodes:
        if node is not nodes[0]:
            yield node.prim
        if node.is_gprim:
            yield from (subset.GetPrim() for subset in UsdGeom.Subset.GetAllGeomSubsets(UsdGeom.Imageable(node.prim)))


def _key(label: Label) -> tuple[str, str, str]:
    return (label.encoding, label.taxonomy, label.value)


def _distinct(labels: Iterable[Label]) -> tuple[Label, ...]:
    first: dict[tuple[str, str, str], Label] = {}
    for label in labels:
        first.setdefault(_key(label), label)
    return tuple(first.values())


def read_labels(prim: Any, time: Any) -> tuple[Label, ...]:
    """Return the labels that stand on `prim` itself at `time`, in all encodings, applied schema or not.

    Blank values and values beyond 200 characters are left out; `lint_labels` reports them. A Multiverse class prim
    that does not exist still gives the name in its path.
    """
    names = _semantic_names(prim)
    return _labels(str(prim.GetPath()), _find(prim, names, time)) if names else ()


def _labels(path: str, found: list["_Found"]) -> tuple[Label, ...]:
    return _distinct(
        Label(path, entry.encoding, entry.taxonomy, value, strength=entry.strength)
        for entry in found
        for value in map(clean_text, entry.values)
        if value and len(value) <= _LONGEST and entry.taxonomy
    )


class _Found(NamedTuple):
    """What one property says, as authored."""

    encoding: Encoding
    taxonomy: str
    values: tuple[str, ...]
    property_name: str
    instance: str = ""
    """Instance of the schema that the property belongs to; empty for Multiverse."""
    strength: Literal["label", "report"] = "label"


def _semantic_names(prim: Any) -> list[str]:
    return [name for name in prim.GetAuthoredPropertyNames() if name.startswith("semantic")]


def _find(prim: Any, names: list[str], time: Any) -> list[_Found]:
    found = []
    for name in names:
        if name.startswith(_USD):
            taxonomy = name.removeprefix(_USD)
            found.append(_Found("UsdSemantics", taxonomy, texts_of(prim, name, time), name, taxonomy))
    for instance in dict.fromkeys(match[1] for name in names if (match := _ISAAC.fullmatch(name))):
        stem = f"semantic:{instance}:params:semantic"
        kinds, values = texts_of(prim, f"{stem}Type", time), texts_of(prim, f"{stem}Data", time)
        taxonomy = clean_text(kinds[0]) if kinds else ""
        found.append(_Found("Isaac", taxonomy, values, f"{stem}Data", instance))
    found += [_tag(prim, target, "Labels", "label") for target in _targets(prim, "Labels")]
    # Multiverse repeats its labels among the reports; _distinct keeps the stronger one, which comes first.
    return found + [_tag(prim, target, "Reports", "report") for target in _targets(prim, "Reports")]


def _targets(prim: Any, kind: str) -> list[Any]:
    relationship = prim.GetRelationship(f"{_TAGS}semantic{kind}")
    return list(relationship.GetTargets()) if relationship else []


def _tag(prim: Any, target: Any, kind: str, strength: Literal["label", "report"]) -> _Found:
    path = target.GetPrimPath()
    tagged = prim.GetStage().GetPrimAtPath(path)
    concept = texts_of(tagged, "rdf:conceptName", None) if tagged else ()
    namespace = texts_of(tagged, "rdf:namespace", None) if tagged else ()
    taxonomy = clean_text(namespace[0]) if namespace else path.GetParentPath().name
    value = concept or (path.name.removeprefix("_class_"),)
    return _Found("Multiverse", taxonomy or "unknown", value, f"{_TAGS}semantic{kind}", strength=strength)


def lint_labels(source: Any, time: Any = None) -> list[Diagnostic]:
    """Return what is wrong or stale about existing labels, prim by prim in traversal order; code `label`.

    Args:
        source: a stage, or prims. Of a stage, what instances share is reported once.
        time: time code; None for the earliest.
    """
    at = Usd.TimeCode.EarliestTime() if time is None else time
    prims = _stage_prims(source) if hasattr(source, "GetPseudoRoot") else source
    return [note for prim in prims for note in _lint_prim(prim, at)]


def _stage_prims(stage: Any) -> Iterator[Any]:
    seen = set()
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if prim.IsInstanceProxy():
            shared = prim.GetPrimInPrototype().GetPath()
            if shared in seen:
                continue
            seen.add(shared)
        yield prim


def _lint_prim(prim: Any, time: Any) -> Iterator[Diagnostic]:
    names = _semantic_names(prim)
    # Not GetAppliedSchemas: it leaves out the schemas that OpenUSD does not know, Isaac's and Multiverse's.
    schemas = [schema for schema in prim.GetPrimTypeInfo().GetAppliedAPISchemas() if schema.startswith("Semantic")]
    if not names and not schemas:
        return
    found = _find(prim, names, time)
    problems = [
        *(problem for entry in found for problem in _lint_values(entry, {other.taxonomy for other in found})),
        *_lint_pairs(found, names),
        *_lint_targets(prim),
        *_lint_schemas(names, schemas),
        *_lint_contradictions(found),
    ]
    for property_name, message in problems:
        yield Diagnostic("label", message, str(prim.GetPath()), _layer(prim, property_name, time))


def _layer(prim: Any, property_name: str, time: Any) -> str | None:
    prop = prim.GetProperty(property_name)
    specs = prop.GetPropertyStack(time) if prop else prim.GetPrimStack()
    return str(specs[0].layer.identifier) if specs else None


_Problem = tuple[str, str]
"""Name of the property it is about, message."""


def _lint_values(entry: _Found, taxonomies: set[str]) -> Iterator[_Problem]:
    where, values = entry.property_name, [clean_text(value) for value in entry.values]
    if entry.encoding != "Multiverse" and not any(values):
        if entry.encoding == "UsdSemantics" or entry.values:
            yield where, f"{where} holds no label (empty, blank or not text), expected one; author it or remove it"
        return
    if not all(values):
        yield where, f"{where} has a blank value among {len(values)}; remove it"
    for value in sorted({value for value in values if value and values.count(value) > 1}):
        yield where, f"{where} lists {_quote(value)} {values.count(value)} times; keep one"
    is_qcode = split_identifier(entry.taxonomy.lower())[-1:] == ("qcode",)
    for value in dict.fromkeys(values):
        if len(value) > _LONGEST:
            yield where, f"{where} has a value of {len(value)} characters, expected at most {_LONGEST}; shorten it"
        elif value and entry.encoding != "Multiverse" and value in _PLACEHOLDERS | taxonomies:
            yield where, f"{where} is {_quote(value)}, a name of a taxonomy or schema and no label; author the label"
        elif value and is_qcode and not re.fullmatch("Q[0-9]+", value):
            yield where, f"{where} is {_quote(value)}, expected a Wikidata item such as Q11422; correct or remove it"


def _lint_pairs(found: list[_Found], names: list[str]) -> Iterator[_Problem]:
    for entry in found:
        if entry.encoding == "Isaac":
            type_name = entry.property_name.removesuffix("Data") + "Type"
            if not entry.taxonomy:
                what = "has no semanticType" if type_name not in names else "has a semanticType without text"
                yield entry.property_name, f"{entry.property_name} {what} beside it; author both or remove both"
            if entry.property_name not in names or not entry.values:
                yield type_name, f"{type_name} has no semanticData beside it; author both or remove both"


def _lint_targets(prim: Any) -> Iterator[_Problem]:
    for kind in ("Labels", "Reports"):
        where = f"{_TAGS}semantic{kind}"
        for target in _targets(prim, kind):
            tagged = prim.GetStage().GetPrimAtPath(target.GetPrimPath())
            if not tagged:
                yield where, f"{where} points to <{target}>, which is not on the stage; add the ontology's layer"
            elif not texts_of(tagged, "rdf:conceptName", None):
                yield where, f"{where} points to <{target}>, which has no rdf:conceptName; point it to a class prim"


def _lint_schemas(names: list[str], schemas: list[str]) -> Iterator[_Problem]:
    """Yield schemas without their properties, and properties without their schema, which tools then do not see."""
    expected: dict[str, str] = {}
    for name in names:
        isaac = _ISAAC.fullmatch(name)
        if name.startswith(_USD):
            expected[_SCHEMA_OF["UsdSemantics"] + name.removeprefix(_USD)] = name
        elif isaac:
            expected.setdefault(_SCHEMA_OF["Isaac"] + isaac[1], name)
        elif name.startswith(_TAGS):
            expected.setdefault(_SCHEMA_OF["Multiverse"], name)
    for schema in schemas:
        if schema.startswith(tuple(_SCHEMA_OF.values())) and schema not in expected:
            yield "", f"{schema} is applied, but no label of it is authored; author the label or remove the schema"
    for schema, name in expected.items():
        if schema not in schemas:
            yield name, f"{name} is authored, but {schema} is not applied, so that tools may not see it; apply it"


def _lint_contradictions(found: list[_Found]) -> Iterator[_Problem]:
    usd = _by_taxonomy(found, "UsdSemantics")
    isaac = _by_taxonomy(found, "Isaac")
    for taxonomy in sorted(usd.keys() & isaac.keys()):
        new, old = usd[taxonomy], isaac[taxonomy]
        if {_normalized(value) for value in new}.isdisjoint(map(_normalized, old)):
            message = f"{_USD}{taxonomy} says {_list(new)}, the older semantic:*:params says {_list(old)}"
            yield _USD + taxonomy, f"{message}; keep the right one and remove the other"
    tags = [value for entry in found if (entry.encoding, entry.strength) == ("Multiverse", "label") for value in entry.values]
    for encoding, labels in (("UsdSemantics", usd), ("Isaac", isaac)):
        classes = [value for taxonomy in sorted(_CLASS_TAXONOMIES & labels.keys()) for value in labels[taxonomy]]
        if tags and classes and _words(tags).isdisjoint(_words(classes)):
            message = f"{_TAGS}semanticLabels says {_list(tags)}, the {encoding} class is {_list(classes)}"
            yield f"{_TAGS}semanticLabels", f"{message}; check which is right"


def _by_taxonomy(found: list[_Found], encoding: Encoding) -> dict[str, list[str]]:
    grouped: dict[str, list[str]] = {}
    for entry in found:
        values = [value for value in map(clean_text, entry.values) if value]
        if entry.encoding == encoding and values and entry.taxonomy:
            grouped.setdefault(_SAME_TAXONOMY.get(entry.taxonomy, entry.taxonomy), []).extend(values)
    return grouped


def _normalized(value: str) -> tuple[str, ...]:
    return tuple(part.lower() for part in split_identifier(value)) or (value,)


def _words(values: list[str]) -> set[str]:
    """Return the words of class names: of an IRI its local name, of `drawer.n.wn.artifact` (WordNet) the lemma."""
    lemmas = [re.split(r"\.[nvasr]\.", re.split(r"[#/]", value)[-1])[0] for value in values]
    return {word for lemma in lemmas for word in words_of(lemma) or (lemma.lower(),)}


def _list(values: list[str]) -> str:
    return ", ".join(map(_quote, dict.fromkeys(values[:4])))


def _quote(value: str) -> str:
    return repr(value if len(value) <= 60 else value[:59] + "…")
