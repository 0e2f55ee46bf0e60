"""Graphs are split into chunks without splitting a blank node."""

import pyoxigraph as ox

from usd2kg.stores.chunking import group_by_blank_nodes, split_triples

P = ox.NamedNode("urn:p")


def triple(subject: str, value: str) -> ox.Triple:
    a, b = (ox.BlankNode(name[2:]) if name.startswith("_:") else ox.NamedNode(name) for name in (subject, value))
    return ox.Triple(a, P, b)


def test_groups_nodes_that_a_later_triple_connects():
    given = [triple("_:a", "urn:1"), triple("urn:x", "urn:y"), triple("_:b", "urn:2"), triple("_:a", "_:b")]
    assert group_by_blank_nodes(given) == [[given[0], given[2], given[3]], [given[1]]]


def test_finds_blank_nodes_in_quoted_triples():
    quoted = ox.Triple(ox.BlankNode("r"), P, triple("_:a", "urn:x"))
    assert group_by_blank_nodes([quoted, triple("_:a", "urn:y")]) == [[quoted, triple("_:a", "urn:y")]]


def test_chunks_exceed_the_size_only_for_a_larger_group():
    plain = [triple(f"urn:{i}", "urn:o") for i in range(5)]
    connected = [triple("_:a", f"urn:{i}") for i in range(4)]
    assert [len(chunk) for chunk in split_triples([*plain, *connected], 3)] == [3, 2, 4]
    assert [t for chunk in split_triples([*plain, *connected], 3) for t in chunk] == [*plain, *connected]
    assert list(split_triples([], 3)) == []
