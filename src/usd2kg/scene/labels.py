"""Semantic labels that a stage already carries, in the three encodings in use, and what is wrong with them.

- OpenUSD's own: `token[] semantics:labels:<taxonomy>`, schema `SemanticsLabelsAPI:<taxonomy>` (UsdSemantics).
- Isaac and Replicator: `semantic:<instance>:params:semanticType` and `semanticData`, schema `SemanticsAPI:<instance>`.
- Multiverse: `rel semanticTag:semanticLabels` and `semanticReports`, to class prims with `rdf:conceptName`.

Labels are evidence, not truth: shipped assets carry placeholders and leftovers, which `lint_labels` finds.
"""

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import Any, NamedTuple

from pxr import Usd, UsdGeom

from usd2kg.scene.metadata import clean_text, texts_of
from usd2kg.scene.model import NO_LABELS, Diagnostic, Encoding, Label, ObjectLabels, Strength
from usd2kg.scene.outline import Node
from usd2kg.scene.stage import UNREADABLE, error_text, read_targets
from usd2kg.words import split_identifier, words_of

__all__ = ["LabelReader", "lint_labels", "read_labels"]

_LONGEST = 200
_MOST_PARTS = 64
_USD = "semantics:labels:"
_ISAAC = re.compile(r"semantic:(.+):params:semantic(?:Type|Data)")
_TAGS: dict[str, Strength] = {"semanticTag:semanticLabels": "label", "semanticTag:semanticReports": "report"}
_SCHEMAS = ("SemanticsLabelsAPI:", "SemanticsAPI:", "SemanticTagAPI")
_PLACEHOLDERS = frozenset(
    """
    class wikidata_class qcode wikidata_qcode hierarchy iri semanticType semanticData semantics labels
    SemanticsAPI SemanticsLabelsAPI SemanticTagAPI
    """.split()
)
"""Names of taxonomies and schemas that turn up where a label should stand."""
_CLASS_TAXONOMIES = frozenset({"class", "wikidata_class", "iri"})
_OLDER_NAMES = {"wikidata_qcode": "qcode"}
_QCODE = re.compile("Q[0-9]+")


class LabelReader:
    """Reads the labels of objects at one time; what stands above several objects is read once."""

    def __init__(self, time: Any) -> None:
        self._time = time
        self._above: dict[str, tuple[Label, ...]] = {}

    def read(self, nodes: list[Node]) -> ObjectLabels:
        """Return the labels of the object whose own nodes are `nodes`, its prim first."""
        own = read_labels(nodes[0].prim, self._time) if nodes[0].is_labelled else ()
        inherited = _distinct([*own, *self._inherited(nodes[0].parent)])[len(own) :]
        below = [label for prim in _parts(nodes) for label in read_labels(prim, self._time)]
        if not (own or inherited or below):
            return NO_LABELS
        return ObjectLabels(own, inherited, _distinct(below)[:_MOST_PARTS])

    def _inherited(self, node: Node | None) -> list[Label]:
        found: list[Label] = []
        while node is not None:
            if node.is_labelled:
                if node.path not in self._above:
                    here = read_labels(node.prim, self._time)
                    self._above[node.path] = tuple(replace(label, is_inherited=True) for label in here)
                found += self._above[node.path]
            node = node.parent
        return found


def _parts(nodes: list[Node]) -> Iterator[Any]:
    for node in nodes:
        if node.is_labelled and node is not nodes[0]:
            yield node.prim
        if node.has_subsets:
            yield from (subset.GetPrim() for subset in UsdGeom.Subset.GetAllGeomSubsets(UsdGeom.Imageable(node.prim)))


def _distinct(labels: Iterable[Label]) -> tuple[Label, ...]:
    first: dict[tuple[str, str, str], Label] = {}
    for label in labels:
        first.setdefault((label.encoding, label.taxonomy, label.value), label)
    return tuple(first.values())


def read_labels(prim: Any, time: Any) -> tuple[Label, ...]:
    """Return the labels that stand on `prim` itself at `time`, in all encodings, applied schema or not.

    Blank values and values beyond 200 characters are left out; `lint_labels` reports them. A Multiverse class prim
    that does not exist still gives the name in its path.
    """
    names = _semantic_names(prim)
    if not names:
        return ()
    path = str(prim.GetPath())
    return _distinct(
        Label(path, entry.encoding, entry.taxonomy, value, strength=entry.strength)
        for entry in _find(prim, names, time)
        for value in entry.values
        if value and len(value) <= _LONGEST and (entry.taxonomy or entry.encoding != "Isaac")
    )


class _Found(NamedTuple):
    """What one property says, its texts cleaned up."""

    property_name: str
    encoding: Encoding
    taxonomy: str
    values: tuple[str, ...]
    strength: Strength = "label"


def _semantic_names(prim: Any) -> list[str]:
    return [name for name in prim.GetAuthoredPropertyNames() if name.startswith("semantic")]


def _find(prim: Any, names: list[str], time: Any) -> list[_Found]:
    found = []
    for name in names:
        if name.startswith(_USD):
            found.append(_Found(name, "UsdSemantics", name.removeprefix(_USD), _clean(prim, name, time)))
    for instance in dict.fromkeys(match[1] for name in names if (match := _ISAAC.fullmatch(name))):
        stem = f"semantic:{instance}:params:semantic"
        taxonomy = next(iter(_clean(prim, f"{stem}Type", time)), "")
        found.append(_Found(f"{stem}Data", "Isaac", taxonomy, _clean(prim, f"{stem}Data", time)))
    # Multiverse repeats its labels among the reports; _distinct keeps the stronger one, which comes first.
    return found + [_tag(prim, name, target) for name in _TAGS for target in _targets(prim, name)]


def _clean(prim: Any, name: str, time: Any) -> tuple[str, ...]:
    return tuple(map(clean_text, texts_of(prim, name, time)))


def _targets(prim: Any, name: str) -> list[Any]:
    return [target.GetPrimPath() for target in read_targets(prim, name)]


def _tag(prim: Any, name: str, target: Any) -> _Found:
    tagged = prim.GetStage().GetPrimAtPath(target)
    concepts, namespaces = (_clean(tagged, rdf, None) if tagged else () for rdf in ("rdf:conceptName", "rdf:namespace"))
    taxonomy = next(filter(None, namespaces), target.GetParentPath().name)
    value = next(filter(None, concepts), target.name.removeprefix("_class_"))
    return _Found(name, "Multiverse", taxonomy, (value,), _TAGS[name])


def lint_labels(source: Any, time: Any = None) -> list[Diagnostic]:
    """Return what is wrong or stale about existing labels, prim by prim in traversal order; code `label`.

    Args:
        source: a stage, or prims. Of a stage, what instances share is reported once.
        time: time code; None for the earliest.
    """
    at = Usd.TimeCode.EarliestTime() if time is None else time
    prims = _stage_prims(source) if hasattr(source, "GetPseudoRoot") else source
    return [note for prim in prims for note in _lint_readable(prim, at)]


def _stage_prims(stage: Any) -> Iterator[Any]:
    seen = set()
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if prim.IsInstanceProxy():
            shared = prim.GetPrimInPrototype().GetPath()
            if shared in seen:
                continue
            seen.add(shared)
        yield prim


def _lint_readable(prim: Any, time: Any) -> list[Diagnostic]:
    try:
        return list(_lint_prim(prim, time))
    except UNREADABLE as error:
        message = f"OpenUSD cannot read its labels ({error_text(error)}); they were not checked"
        return [Diagnostic("label", message, str(prim.GetPath()))]


def _lint_prim(prim: Any, time: Any) -> Iterator[Diagnostic]:
    names = _semantic_names(prim)
    # Not GetAppliedSchemas: it leaves out the schemas that OpenUSD does not know, Isaac's and Multiverse's.
    schemas = [schema for schema in prim.GetPrimTypeInfo().GetAppliedAPISchemas() if schema.startswith(_SCHEMAS)]
    if not names and not schemas:
        return
    found = _find(prim, names, time)
    taxonomies = {entry.taxonomy for entry in found}
    problems = [
        *(problem for entry in found for problem in _lint_values(entry, taxonomies)),
        *(problem for entry in found if entry.encoding == "Isaac" for problem in _lint_pair(entry)),
        *(problem for name in _TAGS for target in _targets(prim, name) for problem in _lint_target(prim, name, target)),
        *_lint_schemas(names, schemas),
        *_lint_contradictions(found),
    ]
    for property_name, message in problems:
        prop = prim.GetProperty(property_name) if property_name else None
        specs = prop.GetPropertyStack(time) if prop else prim.GetPrimStack()
        layer = str(specs[0].layer.identifier) if specs else None
        yield Diagnostic("label", message, str(prim.GetPath()), layer)


_Problem = tuple[str, str]
"""Name of the property it is about, empty for the prim; message."""


def _lint_values(entry: _Found, taxonomies: set[str]) -> Iterator[_Problem]:
    where, values = entry.property_name, entry.values
    if not any(values):
        if values or entry.encoding == "UsdSemantics":
            yield where, f"{where} holds no label (empty, blank or not text), expected one; author it or remove it"
        return
    is_qcode = split_identifier(entry.taxonomy.lower())[-1:] == ("qcode",)
    for value in dict.fromkeys(values):
        quoted = _quote([value])
        if not value:
            yield where, f"{where} has a blank value among {len(values)}; remove it"
        elif len(value) > _LONGEST:
            yield where, f"{where} has a value of {len(value)} characters, expected at most {_LONGEST}; shorten it"
        elif entry.encoding != "Multiverse" and (value in _PLACEHOLDERS or value in taxonomies):
            yield where, f"{where} is {quoted}, a name of a taxonomy or schema and no label; author the label"
        elif is_qcode and not _QCODE.fullmatch(value):
            yield where, f"{where} is {quoted}, expected a Wikidata item such as Q11422; correct it or remove it"
        if value and values.count(value) > 1:
            yield where, f"{where} lists {quoted} {values.count(value)} times; keep one"


def _lint_pair(entry: _Found) -> Iterator[_Problem]:
    data, kind = entry.property_name, entry.property_name.removesuffix("Data") + "Type"
    for name, has_other, other in ((data, entry.taxonomy, "semanticType"), (kind, entry.values, "semanticData")):
        if not has_other:
            yield name, f"{name} has no {other} with text beside it; author both or remove both"


def _lint_target(prim: Any, name: str, target: Any) -> Iterator[_Problem]:
    tagged = prim.GetStage().GetPrimAtPath(target)
    if not tagged:
        yield name, f"{name} points to <{target}>, which is not on the stage; add the ontology's layer"
    elif not any(_clean(tagged, "rdf:conceptName", None)):
        yield name, f"{name} points to <{target}>, which has no rdf:conceptName; point it to a class prim"


def _lint_schemas(names: list[str], schemas: list[str]) -> Iterator[_Problem]:
    """Yield schemas without their properties, and properties without their schema, which tools then do not see."""
    expected = {schema: name for name in reversed(names) if (schema := _schema_of(name))}
    for schema in schemas:
        if schema not in expected:
            yield "", f"{schema} is applied, but no label of it is authored; author the label or remove the schema"
    for schema, name in sorted(expected.items()):
        if schema not in schemas:
            yield name, f"{name} is authored, but {schema} is not applied, so that tools may not see it; apply it"


def _schema_of(property_name: str) -> str | None:
    if property_name.startswith(_USD):
        return "SemanticsLabelsAPI:" + property_name.removeprefix(_USD)
    isaac = _ISAAC.fullmatch(property_name)
    return f"SemanticsAPI:{isaac[1]}" if isaac else "SemanticTagAPI" if property_name in _TAGS else None


def _lint_contradictions(found: list[_Found]) -> Iterator[_Problem]:
    usd, isaac = _by_taxonomy(found, "UsdSemantics"), _by_taxonomy(found, "Isaac")
    pairs = []
    for taxonomy, values in sorted(usd.items()):
        older = taxonomy if taxonomy in isaac else _OLDER_NAMES.get(taxonomy, "")
        pairs.append((_USD + taxonomy, values, f"the older {older} in semantic:*:params", isaac.get(older, [])))
    name = "semanticTag:semanticLabels"
    tags = [value for entry in found if entry.property_name == name for value in entry.values]
    for encoding, labels in (("UsdSemantics", usd), ("Isaac", isaac)):
        classes = [value for taxonomy in sorted(_CLASS_TAXONOMIES & labels.keys()) for value in labels[taxonomy]]
        pairs.append((name, tags, f"the {encoding} class", [c for c in classes if not _QCODE.fullmatch(c)]))
    for name, values, other, other_values in pairs:
        if values and other_values and _words(values).isdisjoint(_words(other_values)):
            message = f"{name} says {_quote(values)}, but {other} says {_quote(other_values)}"
            yield name, f"{message}; keep the right one and remove the other"


def _by_taxonomy(found: list[_Found], encoding: Encoding) -> dict[str, list[str]]:
    grouped: dict[str, list[str]] = {}
    for entry in found:
        if entry.encoding == encoding and entry.taxonomy and any(entry.values):
            grouped.setdefault(entry.taxonomy, []).extend(filter(None, entry.values))
    return grouped


def _words(values: list[str]) -> set[str]:
    """Return the words of class names: of an IRI its local name, of `drawer.n.wn.artifact` (WordNet) the lemma."""
    lemmas = [re.split(r"\.[nvasr]\.", re.split(r"[#/]", value)[-1])[0] for value in values]
    return {word for lemma in lemmas for word in words_of(lemma) or (lemma.lower(),)}


def _quote(values: list[str]) -> str:
    shown = (value if len(value) <= 60 else value[:59] + "…" for value in dict.fromkeys(values))
    return ", ".join(map(repr, list(shown)[:4]))
