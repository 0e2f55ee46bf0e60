"""Dataset: the graphs of a store that queries run on."""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import pyoxigraph as ox

from usd2kg.graph.vocabulary import PREFIXES, SHACL, named_node
from usd2kg.ontology import PREFIX_NAME
from usd2kg.query.dataset_clause import names_dataset

__all__ = [
    "FUNCTION_NAMESPACE",
    "INDEX_NAME",
    "QUERY_PREFIXES",
    "Dataset",
    "term_list",
    "with_prefixes",
]

FUNCTION_NAMESPACE = "https://w3id.org/usd2kg/function#"
"""Prefix `u2kf:` in queries."""
QUERY_PREFIXES = {**PREFIXES, "u2kf": FUNCTION_NAMESPACE}
"""Prefixes that are predefined in queries."""
INDEX_NAME = "index"
"""Subfolder of `Dataset.folder` with the files of the engine."""


def with_prefixes(sparql: str, prefixes: Mapping[str, str] | None = None) -> str:
    """Return a query with declarations of the given or predefined prefixes that it uses and does not declare.

    >>> print(with_prefixes("ASK { ?s u2k:primPath ?p }"))
    PREFIX u2k: <https://w3id.org/usd2kg#>
    ASK { ?s u2k:primPath ?p }
    """
    declared = {name.lower() for name in re.findall(r"PREFIX\s+([\w-]*)\s*:", sparql, flags=re.IGNORECASE)}
    known = QUERY_PREFIXES if prefixes is None else prefixes
    used = [n for n in known if n not in declared and re.search(rf"(?<![\w-]){n}:", sparql)]
    return "".join(f"PREFIX {name}: <{known[name]}>\n" for name in used) + sparql.strip()


def term_list(nodes: Iterable[ox.NamedNode]) -> str:
    """Return nodes in SPARQL syntax, for VALUES.

    Nodes come from the store and are escaped by their serialisation, so no text of a user or a stage becomes part of a
    query.
    """
    return " ".join(str(node) for node in nodes)


@dataclass(frozen=True)
class Dataset:
    """Graphs of a store, queried as their union unless a query names others with FROM or FROM NAMED."""

    store: ox.Store
    graphs: tuple[ox.NamedNode, ...] | None = None
    """None for all graphs."""
    folder: Path | None = None
    """Folder in the cache, where tables that are computed from the graphs are kept; has the index of a large file."""

    @property
    def index(self) -> Path | None:
        """The files of the engine; None in memory and for a store of the user."""
        index = None if self.folder is None else self.folder / INDEX_NAME
        return index if index is not None and index.is_dir() else None

    @cached_property
    def prefixes(self) -> dict[str, str]:
        """The predefined prefixes, and those that the graphs declare for the user's ontology.

        A prefix that several scenes declare for different namespaces is left out: it would mean one of them at random.
        """
        own: dict[str, set[str]] = {}
        for node, name in self.quads(SHACL.prefix):
            for space in self.objects(node, SHACL["namespace"]):
                if not (isinstance(name, ox.Literal) and isinstance(space, ox.Literal)):
                    continue
                if PREFIX_NAME.fullmatch(name.value) and named_node(space.value) is not None:
                    own.setdefault(name.value, set()).add(space.value)
        return {**{prefix: iris.pop() for prefix, iris in own.items() if len(iris) == 1}, **QUERY_PREFIXES}

    def __len__(self) -> int:
        """Return the number of triples; those of several graphs count each time."""
        if self.graphs is None:
            return len(self.store)
        return sum(1 for graph in self.graphs for _ in self.store.quads_for_pattern(None, None, None, graph))

    def objects(self, subject: ox.NamedNode | ox.BlankNode, predicate: ox.NamedNode) -> list[Any]:
        """Return the values of a property of a node, each once."""
        return list(dict.fromkeys(quad.object for quad in self._quads(subject, predicate, None)))

    def subjects(self, predicate: ox.NamedNode, value: ox.NamedNode | ox.Literal) -> list[Any]:
        """Return the nodes that have a value of a property, each once."""
        return list(dict.fromkeys(quad.subject for quad in self._quads(None, predicate, value)))

    def triples(self) -> Iterator[ox.Triple]:
        """Yield all triples; one of several graphs occurs each time."""
        for graph in (None,) if self.graphs is None else self.graphs:
            yield from (quad.triple for quad in self.store.quads_for_pattern(None, None, None, graph))

    def quads(self, predicate: ox.NamedNode) -> Iterator[tuple[Any, Any]]:
        """Yield the subjects and values of a property; a pair of several graphs occurs each time."""
        return ((quad.subject, quad.object) for quad in self._quads(None, predicate, None))

    def pairs(self, predicate: ox.NamedNode) -> Iterator[tuple[str, str]]:
        """Yield the named subjects and the values of a property as text."""
        return (
            (subject.value, value.value)
            for subject, value in self.quads(predicate)
            if isinstance(subject, ox.NamedNode) and not isinstance(value, ox.Triple)
        )

    def _quads(self, subject: Any, predicate: ox.NamedNode, value: Any) -> Iterator[ox.Quad]:
        # A pattern takes microseconds, a query that is parsed and planned for it some hundred.
        for graph in (None,) if self.graphs is None else self.graphs:
            yield from self.store.quads_for_pattern(subject, predicate, value, graph)

    def query(self, sparql: str, **options: Any) -> ox.QuerySolutions | ox.QueryBoolean | ox.QueryTriples:
        """Return the result of a query; the prefixes of the package and of the graphs are predefined.

        FROM and FROM NAMED choose among all graphs of the store.

        Args:
            sparql: the query.
            options: further arguments of `pyoxigraph.Store.query`.
        """
        return self.store.query(sparql, prefixes=self.prefixes, **self._graphs_of(sparql), **options)

    def _graphs_of(self, sparql: str) -> Mapping[str, Any]:
        # The engine ignores FROM and FROM NAMED where a dataset is passed with the query.
        if names_dataset(sparql):
            return {}
        return {"use_default_graph_as_union": True} if self.graphs is None else {"default_graph": [*self.graphs]}

    def select(self, sparql: str, **options: Any) -> list[Any]:
        """Return the rows of a SELECT query."""
        rows = self.query(sparql, **options)
        assert isinstance(rows, ox.QuerySolutions)
        return list(rows)
