"""Find the objects and kinds that a user names: by prim path, label, class, concept, words or IRI."""

import re
from collections.abc import Callable, Iterable
from functools import cached_property
from typing import NamedTuple

import pyoxigraph as ox
from rapidfuzz import fuzz, process

from usd2kg.errors import GraphError
from usd2kg.grounding import concepts_named
from usd2kg.ontology import expand_curie
from usd2kg.query.dataset import Dataset
from usd2kg.query.query_templates import KIND_OF
from usd2kg.query.settings import LOOKUP
from usd2kg.query.staging import list_found_first
from usd2kg.words import split_identifier

__all__ = ["Lookup", "NamedObject", "term_list"]

# Joined here: the engine takes ten times as long for one query with both.
_PATHS = "SELECT ?o ?p WHERE { ?o u2k:primPath ?p }"
_LABELS = "SELECT ?o ?l WHERE { ?o rdfs:label ?l }"

_AT_PATH = "SELECT ?o WHERE {{ ?o u2k:primPath {text} }}"

_LABELLED = """
SELECT DISTINCT ?o ?p WHERE {{
  VALUES ?l {{ {texts} }}
  ?o rdfs:label ?l ; u2k:primPath ?p .
}} ORDER BY ?p"""

_ASSETS = "SELECT DISTINCT ?o ?a ?p WHERE { ?o u2k:primPath ?p ; u2k:asset ?a } ORDER BY ?p"

_MEMBERS = """
SELECT DISTINCT ?o ?p WHERE {{
  {{ SELECT DISTINCT ?o {{ VALUES ?wanted {{ {kinds} }} ?o {predicate} ?wanted }} }}
  ?o u2k:primPath ?p .
}} ORDER BY ?p"""

_CLASSES = "SELECT DISTINCT ?c ?l WHERE { ?c a owl:Class . OPTIONAL { ?c rdfs:label ?l } }"

_CONCEPTS = "SELECT DISTINCT ?c ?l WHERE { ?c a skos:Concept . OPTIONAL { ?c skos:prefLabel ?l } }"

_USED_LABELS = "SELECT DISTINCT ?l WHERE { ?o u2k:primPath [] ; a ?c . ?c rdfs:label ?l } ORDER BY ?l"


class NamedObject(NamedTuple):
    """An object of a graph with one of its labels."""

    node: ox.NamedNode
    prim_path: str
    label: str


class Lookup:
    """Finds objects and kinds of one graph by name. A kind is a class, or a concept that objects have."""

    def __init__(self, dataset: Dataset, source: str) -> None:
        self._dataset = dataset
        self._source = source

    @cached_property
    def objects(self) -> list[NamedObject]:
        """All objects with each of their labels, in the order of prim paths."""
        labels: dict[ox.NamedNode, list[str]] = {}
        for node, label in self._dataset.select(_LABELS):
            labels.setdefault(node, []).append(label.value)
        paths = sorted((path.value, node.value, node) for node, path in self._dataset.select(_PATHS))
        return [NamedObject(node, path, label) for path, _, node in paths for label in sorted(labels.get(node, ()))]

    def find(self, thing: str) -> list[ox.NamedNode]:
        """Return the objects that match a name, by the first criterion with a match.

        Criteria in order: prim path; label, as written, in lower case or capitalised; class or concept, with
        everything below it; label in any case; all words in the label; all words in the asset's name.

        Raises:
            GraphError: no object matches.
        """
        thing = re.sub(r"^(the|a|an)\s+", "", thing.strip(), flags=re.IGNORECASE)
        wanted = _words(thing)
        criteria: tuple[Callable[[], list[ox.NamedNode]], ...] = (
            # The index has the first three. The others read all objects.
            lambda: self._nodes(_AT_PATH.format(text=ox.Literal(thing))),
            lambda: self._nodes(_LABELLED.format(texts=_literals({thing, thing.lower(), thing.capitalize()}))),
            lambda: self._members(self._find_kinds(thing)),
            lambda: [node for node, _, label in self.objects if label.lower() == thing.lower()],
            lambda: [node for node, _, label in self.objects if wanted and wanted <= _words(label)],
            lambda: [row["o"] for row in self._dataset.select(_ASSETS) if wanted and wanted <= _words(row["a"].value)],
        )
        for criterion in criteria:
            if found := criterion():
                return found
        raise GraphError(
            f"{self._source}: nothing is named {thing!r}{self._suggest(thing)}; expected a label, a class, a noun or a "
            "prim path; usd2kg query GRAPH all of KIND lists objects"
        )

    def _suggest(self, thing: str) -> str:
        labels = list(dict.fromkeys(label for _, _, label in self.objects))
        similar = process.extract(
            thing,
            labels,
            scorer=fuzz.WRatio,
            processor=str.lower,
            score_cutoff=LOOKUP.min_label_similarity,
            limit=LOOKUP.max_suggestions,
        )
        return f" (did you mean {' or '.join(repr(label) for label, _, _ in similar)}?)" if similar else ""

    def kinds(self, name: str) -> list[ox.NamedNode]:
        """Return the classes with this label, local name, CURIE or IRI; without one, the concepts the noun may mean.

        A class comes first, since the ontology says what belongs to it.

        Raises:
            GraphError: there is none; the message lists the classes of the graph's objects.
        """
        found = self._find_kinds(name)
        if not found:
            known = ", ".join(row["l"].value for row in self._dataset.select(_USED_LABELS))
            raise GraphError(
                f"{self._source}: no class or concept is named {name!r}; expected a noun that is a concept of an "
                f"object, or one of the classes {known}"
            )
        return found

    def _find_kinds(self, name: str) -> list[ox.NamedNode]:
        wanted, iri = _words(name), expand_curie(name)
        classes = {
            row["c"]
            for row in self._dataset.select(_CLASSES)
            if row["c"].value in {name, iri}
            or _words(re.split(r"[#/]", row["c"].value)[-1]) == wanted
            or (row["l"] is not None and _words(row["l"].value) == wanted)
        }
        return sorted(classes or self._find_concepts(name), key=lambda node: node.value)

    def _find_concepts(self, name: str) -> set[ox.NamedNode]:
        wanted = _words(name)
        iris = {*concepts_named(name), name, expand_curie(name)}
        return {
            row["c"]
            for row in self._dataset.select(_CONCEPTS)
            if row["c"].value in iris or (row["l"] is not None and _words(row["l"].value) == wanted)
        }

    def _members(self, kinds: list[ox.NamedNode]) -> list[ox.NamedNode]:
        if not kinds:
            return []
        return self._nodes(_MEMBERS.format(kinds=term_list(kinds), predicate=KIND_OF))

    def _nodes(self, query: str) -> list[ox.NamedNode]:
        staged = list_found_first(query, self._dataset.select, LOOKUP.max_listed)
        return [row["o"] for row in self._dataset.select(staged)]


def term_list(nodes: Iterable[ox.NamedNode]) -> str:
    """Return nodes in SPARQL syntax, for VALUES.

    Nodes come from the store and are escaped by their serialisation, so no text of a user or a stage becomes part of a
    query.
    """
    return " ".join(str(node) for node in nodes)


def _literals(texts: Iterable[str]) -> str:
    """Return texts as SPARQL literals, escaped."""
    return " ".join(str(ox.Literal(text)) for text in sorted(texts))


def _words(text: str) -> frozenset[str]:
    return frozenset(_singular(word.lower()) for word in split_identifier(text))


def _singular(word: str) -> str:
    """Return an approximate singular; errors cancel out, since both sides of a comparison are stemmed."""
    for ending, singular in (("ves", "f"), ("ies", "y"), ("sses", "ss"), ("xes", "x"), ("fe", "f"), ("s", "")):
        if word.endswith(ending) and len(word) > len(ending) + 2 and not word.endswith("ss"):
            return word.removesuffix(ending) + singular
    return word
