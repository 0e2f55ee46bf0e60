"""Graphs in parts."""

import pyoxigraph as ox

from usd2kg.stores.chunking import group_by_blank_nodes, split_triples

P = ox.NamedNode("urn:p")


def triple(subject: str, value: str) -> ox.Triple:
    a, b = (ox.BlankNode(name[2:]) if name.startswith("_:") else ox.NamedNode(name) for name in (subject, value))
    return ox.Triple(a, P, b)


def test_nodes_that_are_tied_go_together_even_by_a_triple_that_comes_last():
    given = [triple("_:a", "urn:1"), triple("urn:x", "urn:y"), triple("_:b", "urn:2"), triple("_:a", "_:b")]
    assert group_by_blank_nodes(given) == [[given[0], given[2], given[3]], [given[1]]]


def test_a_blank_node_within_a_quoted_triple_counts():
    quoted = ox.Triple(ox.BlankNode("r"), P, triple("_:a", "urn:x"))
    assert group_by_blank_nodes([quoted, triple("_:a", "urn:y")]) == [[quoted, triple("_:a", "urn:y")]]


def test_parts_have_the_size_asked_for_unless_a_group_is_larger():
    plain = [triple(f"urn:{i}", "urn:o") for i in range(5)]
    tied = [triple("_:a", f"urn:{i}") for i in range(4)]
    assert [len(part) for part in split_triples([*plain, *tied], 3)] == [3, 2, 4]
    assert [t for part in split_triples([*plain, *tied], 3) for t in part] == [*plain, *tied]
    assert list(split_triples([], 3)) == []
