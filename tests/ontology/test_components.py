"""Strongly connected components: deep and cyclic hierarchies."""

from time import process_time

from hypothesis import given, settings
from hypothesis import strategies as st

from usd2kg.ontology.components import find_components
from usd2kg.ontology.documents import read_triples
from usd2kg.ontology.scope import ancestors, nearest_parents
from usd2kg.validation.axiom_index import AxiomIndex

NAMES = st.sampled_from("abcdefgh")
HIERARCHIES = st.dictionaries(NAMES, st.sets(NAMES, max_size=3))


def test_components_are_sorted_superclasses_first():
    components = find_components({"cup": {"vessel", "mug"}, "mug": {"cup"}, "vessel": {"thing"}})
    assert [set(members) for members in components.members] == [{"thing"}, {"vessel"}, {"cup", "mug"}]
    assert components.above == (frozenset(), frozenset({0}), frozenset({1}))
    assert components.component_of["mug"] == components.component_of["cup"] == 2


@settings(deadline=None)
@given(HIERARCHIES, st.sets(NAMES))
def test_nearest_parents_match_their_definition(superclasses, scope):
    above = {iri: ancestors(superclasses, iri) & scope for iri in scope}
    strict = {iri: {up for up in ups if iri not in above[up]} for iri, ups in above.items()}
    expected = {
        iri: tuple(sorted(up for up in ups if not any(up in strict[other] for other in ups - {up})))
        for iri, ups in strict.items()
    }
    assert nearest_parents(scope, superclasses) == expected


@settings(deadline=None)
@given(HIERARCHIES)
def test_classes_of_a_component_are_mutual_subclasses(superclasses):
    components = find_components(superclasses)
    for first, number in components.component_of.items():
        for second, other in components.component_of.items():
            mutual = first in ancestors(superclasses, second) and second in ancestors(superclasses, first)
            assert (number == other) == (first == second or mutual)


def test_a_chain_of_2000_classes_is_fast(load, write_turtle):
    text = "".join(f":C{n} a owl:Class ; rdfs:subClassOf :C{n + 1} .\n" for n in range(2000))
    start = process_time()
    tbox = load(text)
    axioms = AxiomIndex(read_triples(write_turtle(text)))
    assert process_time() - start < 5
    first = "http://example.com/home#C0"
    assert tbox.by_iri[first].parents == ("http://example.com/home#C1",)
    assert len(tbox.closure(first)) == len(axioms.closure(first)) == 2001
    assert tbox.depths[first] == 2000
