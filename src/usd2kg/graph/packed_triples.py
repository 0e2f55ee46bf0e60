"""Triples in a fixed order, packed as compressed Turtle."""

import zlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import islice
from typing import TypeVar, overload

import pyoxigraph as ox

from usd2kg.graph.turtle_text import TurtleText
from usd2kg.graph.vocabulary import Triple

__all__ = ["PackedTriples", "subject_chunks"]

_CHUNK = 20_000
"""Triples that are serialised and compressed together (6 MB as objects); affects only speed and memory."""
_T = TypeVar("_T", bound=ox.Triple | Triple)


class PackedTriples(Sequence[ox.Triple]):
    """Immutable triples at 6 bytes each instead of 300 as objects; iteration recreates the objects.

    They are packed as Turtle, the usual output format, so that writing a graph does not recreate the objects.
    """

    def __init__(self, triples: Iterable[Triple], prefixes: Mapping[str, str]) -> None:
        """Pack triples, with prefixes for the text."""
        self.prefixes = dict(prefixes)
        self._count = 0
        self._packed: list[bytes] = []
        text = TurtleText(self.prefixes)
        for chunk in subject_chunks(triples, _CHUNK):
            self._count += len(chunk)
            self._packed.append(zlib.compress(text.statements(chunk).encode(), level=1))

    def __add__(self, other: "PackedTriples") -> "PackedTriples":
        """Return the concatenation; the prefixes must be equal, and `other` must start with a new subject."""
        joined = PackedTriples((), self.prefixes)
        joined._count, joined._packed = self._count + other._count, self._packed + other._packed
        return joined

    def turtle(self) -> Iterator[bytes]:
        """Yield the statements as Turtle, without prefix declarations."""
        yield from map(zlib.decompress, self._packed)

    def __len__(self) -> int:
        return self._count

    def __iter__(self) -> Iterator[ox.Triple]:
        prologue = "".join(f"@prefix {name}: <{iri}> .\n" for name, iri in self.prefixes.items()).encode()
        for statements in self.turtle():
            # The IRIs were validated when their nodes were created.
            for quad in ox.parse(prologue + statements, format=ox.RdfFormat.TURTLE, lenient=True):
                yield quad.triple

    @overload
    def __getitem__(self, index: int) -> ox.Triple: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[ox.Triple, ...]: ...
    def __getitem__(self, index: int | slice) -> ox.Triple | tuple[ox.Triple, ...]:
        return tuple(self)[index]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, PackedTriples):
            return NotImplemented
        # Equal triples may be packed in other portions.
        return self.prefixes == other.prefixes and b"".join(self.turtle()) == b"".join(other.turtle())

    __hash__ = None  # type: ignore[assignment]


def subject_chunks(triples: Iterable[_T], size: int) -> Iterator[list[_T]]:
    """Yield chunks of at least `size` triples that end where the subject changes."""
    left = iter(triples)
    following: list[_T] = []
    while chunk := [*following, *islice(left, size - len(following))]:
        following.clear()
        for triple in left:
            if triple[0] != chunk[-1][0]:
                following.append(triple)
                break
            chunk.append(triple)
        yield chunk
