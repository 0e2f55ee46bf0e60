"""A lexicon as JSON, so that a later process need not build it."""

from collections.abc import Iterable, Iterator, Mapping
from functools import partial
from typing import Any, TypeVar

from usd2kg.grounding.lexical.alignment.lexicon import CategoryMember, Lexicon, general_classes_of
from usd2kg.grounding.lexical.alignment.terms import AlignedClass, Term, TermKind
from usd2kg.ontology import TBox

__all__ = ["lexicon_as_json", "lexicon_of_json"]


def lexicon_as_json(lexicon: Lexicon) -> dict[str, Any]:
    """Return a lexicon as values that `json` writes; classes are numbers, columns are parallel lists."""
    terms, senses = lexicon.terms.values(), lexicon.sense_classes
    # Many synsets have one class with one weight.
    aligned = list(dict.fromkeys(senses.values()))
    places = {one: place for place, one in enumerate(aligned)}
    members = [
        (synset, *one.aligned, one.synset_count) for synset, all_ in lexicon.category_members.items() for one in all_
    ]
    numbers = {iri: number for number, iri in enumerate(sorted(_named_classes(lexicon)))}
    return {
        "classes": list(numbers),
        "terms": {
            "keys": list(lexicon.terms),
            "classes": [numbers[term.class_iri] for term in terms],
            "texts": [term.text for term in terms],
            "kinds": [term.kind.value for term in terms],
        },
        "senses": {
            "synsets": list(senses),
            "aligned": [places[one] for one in senses.values()],
            "classes": [numbers[one.class_iri] for one in aligned],
            "weights": [one.weight for one in aligned],
        },
        "vocabulary": dict(lexicon.vocabulary),
        "members": [(synset, numbers[iri], weight, count) for synset, iri, weight, count in members],
        "default": lexicon.default_class,
        "home": sorted(lexicon.home_classes),
        "curated": sorted(lexicon.curated_synsets),
        "listed": sorted(lexicon.listed_synsets),
        "excluded": [
            (synset, sorted(map(numbers.__getitem__, iris))) for synset, iris in lexicon.excluded_classes.items()
        ],
    }


def lexicon_of_json(found: Mapping[str, Any], tbox: TBox) -> Lexicon:
    """Return the lexicon of a TBox that `lexicon_as_json` wrote.

    Raises:
        KeyError, TypeError, ValueError, IndexError: the values are damaged.
    """
    classes, kinds = found["classes"], {kind.value: kind for kind in TermKind}
    terms, senses = found["terms"], found["senses"]
    members: dict[int, list[CategoryMember]] = {}
    for synset, number, weight, count in found["members"]:
        members.setdefault(synset, []).append(CategoryMember(AlignedClass(classes[number], weight), count))
    columns = (map(classes.__getitem__, terms["classes"]), terms["texts"], map(kinds.__getitem__, terms["kinds"]))
    aligned = list(_records(AlignedClass, map(classes.__getitem__, senses["classes"]), senses["weights"]))
    return Lexicon(
        terms=dict(zip(terms["keys"], _records(Term, *columns), strict=True)),
        sense_classes=dict(zip(senses["synsets"], map(aligned.__getitem__, senses["aligned"]), strict=True)),
        vocabulary=dict(found["vocabulary"]),
        default_class=found["default"],
        general_classes=general_classes_of(tbox, found["default"]),
        home_classes=frozenset(found["home"]),
        category_members={synset: sorted(some) for synset, some in members.items()},
        curated_synsets=frozenset(found["curated"]),
        listed_synsets=frozenset(found["listed"]),
        excluded_classes={
            synset: frozenset(classes[number] for number in numbers) for synset, numbers in found["excluded"]
        },
    )


_Record = TypeVar("_Record", bound=tuple[Any, ...])


def _records(record: type[_Record], *columns: Iterable[Any]) -> Iterator[_Record]:
    """Yield named tuples; their own constructor is Python code, which takes five times as long."""
    return map(partial(tuple.__new__, record), zip(*columns, strict=True))


def _named_classes(lexicon: Lexicon) -> set[str]:
    named = {term.class_iri for term in lexicon.terms.values()}
    named.update(aligned.class_iri for aligned in lexicon.sense_classes.values())
    named.update(one.aligned.class_iri for all_ in lexicon.category_members.values() for one in all_)
    return named.union(*lexicon.excluded_classes.values())
