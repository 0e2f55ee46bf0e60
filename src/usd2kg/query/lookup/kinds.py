"""Kinds: the classes and concepts that a noun names, and their objects."""

import re
from collections import defaultdict
from collections.abc import Iterable
from functools import cached_property

import pyoxigraph as ox

from usd2kg.graph.vocabulary import RDFS, SKOS
from usd2kg.grounding import concepts_named, hypernyms_of
from usd2kg.knowledge import word_map
from usd2kg.ontology import expand_curie
from usd2kg.query.lookup.facts import SceneFacts
from usd2kg.query.lookup.unnamed_copies import UnnamedCopies
from usd2kg.query.lookup.word_forms import name_words, singular
from usd2kg.query.settings import WORDS

__all__ = ["Kinds"]

_INTERCHANGEABLE = word_map("query", "interchangeable")
_CLASSES = "SELECT DISTINCT ?c ?l WHERE { ?c a owl:Class . OPTIONAL { ?c rdfs:label ?l } }"
_CONCEPTS = "SELECT DISTINCT ?c ?l WHERE { ?c a skos:Concept . OPTIONAL { ?c skos:prefLabel ?l } }"


class _Index:
    """Classes or concepts by the words of their names, and by IRIs that stand for them."""

    def __init__(self) -> None:
        self._by_words: defaultdict[frozenset[str], list[ox.NamedNode]] = defaultdict(list)
        self._by_iri: defaultdict[str, list[ox.NamedNode]] = defaultdict(list)

    def add(self, node: ox.NamedNode, names: Iterable[str], iris: Iterable[str]) -> None:
        for words in {name_words(name) for name in names} - {frozenset()}:
            self._by_words[words].append(node)
        for iri in iris:
            self._by_iri[iri].append(node)

    def find(self, words: frozenset[str], iris: Iterable[str]) -> list[ox.NamedNode]:
        found = [node for iri in iris for node in self._by_iri.get(iri, ())]
        return [*self._by_words.get(words, ()), *found]


class Kinds:
    """Finds classes and concepts of one graph by name."""

    def __init__(self, facts: SceneFacts) -> None:
        self._facts = facts
        self._copies = UnnamedCopies(facts)

    def find(self, name: str) -> list[ox.NamedNode]:
        """Return the classes with this label, local name, CURIE or IRI, and the concepts that the noun may mean."""
        return sorted({*self._classes_named(name), *self._concepts_named(name)}, key=lambda node: str(node.value))

    def objects(self, name: str) -> set[str]:
        """Return the objects of a kind and of all kinds below it, and their copies without a concept.

        A confident object wins over a doubtful one.
        """
        found = self._facts.members(str(kind.value) for kind in self._below(self.find(name)))
        chosen = {iri for iri, sure in found.items() if sure >= WORDS.min_confidence} or set(found)
        chosen |= self._of_class_with_other_name(name)
        return chosen | self._copies.find({iri for iri in chosen if self._facts.concept(iri)})

    @cached_property
    def used_labels(self) -> list[str]:
        """The labels of the classes of objects."""
        return self._facts.used_labels()

    @cached_property
    def names(self) -> list[tuple[ox.NamedNode, str]]:
        """All classes and concepts with each of their labels; empty for one without."""
        return [*self._classes, *self._concepts]

    def _classes_named(self, name: str) -> list[ox.NamedNode]:
        found = self._class_index.find(name_words(name), {name, self._expanded(name)})
        return [*found, *(node for one in _synonyms(name) for node in self._class_index.find(name_words(one), ()))]

    def _expanded(self, name: str) -> str:
        """Return the IRI of a CURIE of a class, whose prefix the graph may declare; other text is returned unchanged.

        The words of questions are in lower case.
        """
        if ":" not in name:
            return name
        iri = expand_curie(name, self._facts.dataset.prefixes)
        return next((node.value for node, _ in self._classes if node.value.casefold() == iri.casefold()), iri)

    def _of_class_with_other_name(self, name: str) -> set[str]:
        """Return the objects of a class with another name for a noun: trash containers are waste containers.

        What is known to be another kind of thing is left out: a microwave of the class oven is no stove.
        """
        meant = {concept for one in self._names(name)[1:] for concept in concepts_named(one)[:1]}
        classes = self._class_index.find(frozenset(), meant)
        members = self._facts.members(str(kind.value) for kind in self._below(classes)) if classes else {}
        return {iri for iri in members if not self._is_known_thing(iri)}

    def _is_known_thing(self, iri: str) -> bool:
        concept = self._facts.concept(iri)
        return concept is not None and "artifact" in hypernyms_of(self._facts.label_of(concept))

    def usual_concepts(self, name: str) -> frozenset[str]:
        """Return the IRIs of the usual concept of a noun and of its near synonym, in the graph or not."""
        return frozenset(iri for one in self._names(name) for iri in concepts_named(one)[:1])

    def _names(self, name: str) -> list[str]:
        """Return a noun, its singular, and nouns that people use for it; none for a name: rack A1, rack B."""
        if any(letter.isdigit() for letter in name) or any(len(word) == 1 for word in name.split()):
            return []
        *before, last = name.split() or [name]
        head = singular(last)
        near = [" ".join([*before, noun]) for noun in (head, *_INTERCHANGEABLE.get(head, "").split("/")) if noun]
        return [name, *near, *_synonyms(name)]

    def _concepts_named(self, name: str) -> list[ox.NamedNode]:
        iris = {name, self._expanded(name), *(iri for one in self._names(name) for iri in concepts_named(one))}
        return self._concept_index.find(name_words(name), iris)

    @cached_property
    def _class_index(self) -> "_Index":
        index = _Index()
        for node, label in self._classes:
            iris = {node.value, *(concepts_named(label)[:1] if label else ())}
            index.add(node, (label, re.split(r"[#/]", node.value)[-1]), iris)
        return index

    @cached_property
    def _concept_index(self) -> "_Index":
        index = _Index()
        for node, label in self._concepts:
            index.add(node, (label,), {node.value})
        return index

    @cached_property
    def _classes(self) -> list[tuple[ox.NamedNode, str]]:
        return self._labelled(_CLASSES)

    @cached_property
    def _concepts(self) -> list[tuple[ox.NamedNode, str]]:
        return self._labelled(_CONCEPTS)

    def _labelled(self, query: str) -> list[tuple[ox.NamedNode, str]]:
        rows = self._facts.dataset.select(query)
        named = ((row["c"], row["l"].value if row["l"] is not None else "") for row in rows)
        return [(node, label) for node, label in named if isinstance(node, ox.NamedNode)]

    def _below(self, kinds: Iterable[ox.NamedNode]) -> set[ox.NamedNode]:
        """Return kinds and everything below them."""
        found: set[ox.NamedNode] = set()
        waiting = [*kinds]
        while waiting:
            node = waiting.pop()
            if node not in found:
                found.add(node)
                for predicate in (RDFS.subClassOf, SKOS.broader):
                    waiting += [n for n in self._facts.dataset.subjects(predicate, node) if isinstance(n, ox.NamedNode)]
        return found


def _synonyms(name: str) -> list[str]:
    """Return the nouns that people use for a whole compound: an electrical appliance is an appliance."""
    *before, last = name.split() or [name]
    return [*filter(None, _INTERCHANGEABLE.get(" ".join([*before, singular(last)]), "").split("/"))] if before else []
