"""CURIEs and IRIs."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from usd2kg.ontology import compact_iri, expand_curie
from usd2kg.ontology.model import local_name
from usd2kg.ontology.prefixes import PREFIXES


@pytest.mark.parametrize(
    ("curie", "iri"),
    [
        ("soma:Cup", "http://www.ease-crc.org/ont/SOMA.owl#Cup"),
        ("SOMA:Cup", "http://www.ease-crc.org/ont/SOMA.owl#Cup"),
        ("usd:Prim", "https://ease-crc.org/ont/USD.owl#Prim"),  # https without www, unlike SOMA
        ("obo:BFO_0000040", "http://purl.obolibrary.org/obo/BFO_0000040"),
        ("unknown:Cup", "unknown:Cup"),
        ("Cup", "Cup"),
        ("soma", "soma"),
        ("http://example.com/a:b", "http://example.com/a:b"),
    ],
)
def test_expand_curie(curie, iri):
    assert expand_curie(curie) == iri


@pytest.mark.parametrize(
    ("iri", "curie"),
    [
        ("http://www.ontologydesignpatterns.org/ont/dul/DUL.owl#Design", "dul:Design"),
        ("http://www.ease-crc.org/ont/SOMA.owl#", "http://www.ease-crc.org/ont/SOMA.owl#"),
        ("https://www.ease-crc.org/ont/SOMA.owl#Cup", "https://www.ease-crc.org/ont/SOMA.owl#Cup"),
        ("http://example.com/Cup", "http://example.com/Cup"),
    ],
)
def test_compact_iri(iri, curie):
    assert compact_iri(iri) == curie


@given(st.sampled_from(sorted(PREFIXES)), st.from_regex(r"[A-Za-z0-9_]+", fullmatch=True))
def test_compacting_and_expanding_are_inverse(prefix, name):
    iri = PREFIXES[prefix] + name
    assert compact_iri(iri) == f"{prefix}:{name}"
    assert expand_curie(compact_iri(iri)) == iri


@pytest.mark.parametrize(
    ("iri", "name"),
    [
        ("http://x.org/home#Cup", "Cup"),
        ("http://x.org/home/Cup", "Cup"),
        ("http://x.org/home/Cup/", "Cup"),
        ("http://x.org/a/b#c/Cup", "Cup"),
        ("urn:home:Cup", "Cup"),
        ("Cup", "Cup"),
    ],
)
def test_local_name(iri, name):
    assert local_name(iri) == name
