"""Deep hierarchies are read in time, and cyclic ones as the definitions say."""

from time import process_time

from hypothesis import given, settings
from hypothesis import strategies as st

from usd2kg.ontology.documents import read_triples
from usd2kg.ontology.levels import level
from usd2kg.ontology.scope import ancestors, nearest_parents
from usd2kg.validation.axioms import Axioms

NAMES = st.sampled_from("abcdefgh")
HIERARCHIES = st.dictionaries(NAMES, st.sets(NAMES, max_size=3))


def test_groups_come_after_those_above_them():
    levels = level({"cup": {"vessel", "mug"}, "mug": {"cup"}, "vessel": {"thing"}})
    assert [set(group) for group in levels.groups] == [{"thing"}, {"vessel"}, {"cup", "mug"}]
    assert levels.above == (frozenset(), frozenset({0}), frozenset({1}))
    assert levels.group_of["mug"] == levels.group_of["cup"] == 2


@settings(deadline=None)
@given(HIERARCHIES, st.sets(NAMES))
def test_nearest_parents_are_those_of_the_definition(superclasses, scope):
    above = {iri: ancestors(superclasses, iri) & scope for iri in scope}
    strict = {iri: {up for up in ups if iri not in above[up]} for iri, ups in above.items()}
    expected = {
        iri: tuple(sorted(up for up in ups if not any(up in strict[other] for other in ups - {up})))
        for iri, ups in strict.items()
    }
    assert nearest_parents(scope, superclasses) == expected


@settings(deadline=None)
@given(HIERARCHIES)
def test_classes_of_a_group_are_below_each_other(superclasses):
    levels = level(superclasses)
    for first, number in levels.group_of.items():
        for second, other in levels.group_of.items():
            mutual = first in ancestors(superclasses, second) and second in ancestors(superclasses, first)
            assert (number == other) == (first == second or mutual)


def test_a_chain_of_2000_classes_is_read_in_time(load, write_turtle):
    text = "".join(f":C{n} a owl:Class ; rdfs:subClassOf :C{n + 1} .\n" for n in range(2000))
    start = process_time()
    tbox = load(text)
    axioms = Axioms(read_triples(write_turtle(text)))
    assert process_time() - start < 5
    first = "http://example.com/home#C0"
    assert tbox.by_iri[first].parents == ("http://example.com/home#C1",)
    assert len(tbox.closure(first)) == len(axioms.closure(first)) == 2001
    assert tbox.depths[first] == 2000
