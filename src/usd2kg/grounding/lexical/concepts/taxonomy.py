"""WordNet's nouns for physical objects: lemmas, their senses by frequency, and hypernyms."""

import re
import sys
from array import array
from bisect import bisect_left
from collections.abc import Callable, Collection, Iterator
from functools import cached_property, lru_cache
from typing import NamedTuple
from urllib.parse import quote, unquote

import numpy as np
import numpy.typing as npt

from usd2kg.grounding.lexical.concepts.taxonomy_file import TaxonomyColumns, parse_taxonomy
from usd2kg.knowledge import read_compressed
from usd2kg.ontology.namespaces import CONCEPT, WORDNET

__all__ = ["Sense", "Taxonomy", "load_taxonomy"]

_OFFSET_DIGITS = 8
_PREFIX_LETTERS = 2
_LAST_LETTER = chr(sys.maxunicode)

# Morphy's detachment rules for nouns (morphy(7WN)).
_PLURALS = (("ches", "ch"), ("shes", "sh"), ("sses", "ss"), ("xes", "x"), ("zes", "z"), ("ies", "y"), ("men", "man"))
_MORE_PLURALS = (("ves", "f"), ("ves", "fe"), ("es", "e"), ("es", ""), ("s", ""))


class Sense(NamedTuple):
    """One sense of a lemma."""

    synset: int
    rank: int
    """1 for the most frequent sense."""
    domain: str
    """WordNet's lexicographer file, such as artifact, food or plant."""


class _Cells:
    """The cells of a column, decoded on access: 100,000 strings take ten times the memory."""

    def __init__(self, column: bytes) -> None:
        self._column = column
        tabs = np.flatnonzero(np.frombuffer(column, np.uint8) == ord("\t")) + 1
        self._starts = array("i", [0])
        self._starts.frombytes(tabs.astype(np.intc).tobytes())
        self._starts.append(len(column) + 1)

    def __getitem__(self, at: int) -> str:
        return self._column[self._starts[at] : self._starts[at + 1] - 1].decode()

    def between(self, start: int, end: int) -> list[str]:
        """Return the cells from `start` up to `end`."""
        return self._column[self._starts[start] : self._starts[end] - 1].decode().split("\t") if start < end else []

    def __len__(self) -> int:
        return len(self._starts) - 1

    def __iter__(self) -> Iterator[str]:
        return iter(self._column.decode().split("\t"))


class _Lemmas(_Cells):
    """The sorted lemmas, indexed by their first letters on demand: a scene needs a few dozen of 124,000."""

    def __init__(self, column: bytes) -> None:
        super().__init__(column)
        self._row_by_prefix: dict[str, dict[str, int]] = {}

    def find(self, lemma: str) -> int | None:
        """Return the row of a lemma; None if it is unknown."""
        prefix = lemma[:_PREFIX_LETTERS]
        rows = self._row_by_prefix.get(prefix)
        if rows is None:
            start, end = bisect_left(self, prefix), bisect_left(self, prefix + _LAST_LETTER)
            rows = dict(zip(self.between(start, end), range(start, end), strict=True))
            self._row_by_prefix[prefix] = rows
        return rows.get(lemma)

    def __contains__(self, lemma: str) -> bool:
        return self.find(lemma) is not None


class Taxonomy:
    """A noun hierarchy. Synsets are numbers; lemmas are lower case, compounds without space or hyphen.

    Cells are parsed on first access, since a scene needs few of them.
    """

    def __init__(
        self,
        columns: TaxonomyColumns,
        read_offsets: Callable[[], str] = str,
        read_labels: Callable[[], bytes] | None = None,
    ) -> None:
        """Index the columns of a taxonomy file.

        Args:
            columns: the columns.
            read_offsets: returns WordNet's offsets of the first synsets, 8 digits each; WordNet lacks the others.
            read_labels: returns the usual noun of each synset, empty where that is its name; default: all are empty.
        """
        self.adjectives = frozenset(columns.adjectives.decode().split("\t"))
        domains = columns.domains.decode().split("\t")
        self._domains = {chr(ord("a") + at): domain for at, domain in enumerate(domains)}
        self._above_texts = _Cells(columns.synset_hypernyms)
        self._names = _Cells(columns.synset_names)
        self._sizes = _Cells(columns.synset_hyponym_counts)
        self._lemmas = _Lemmas(columns.lemmas)
        self._kinds = _Cells(columns.lemma_kinds)
        self._synsets = _Cells(columns.lemma_synsets)
        self._is_one_word = columns.lemma_is_one_word.decode()
        self._senses: dict[str, tuple[Sense, ...]] = {}
        self._above: dict[int, tuple[int, ...]] = {}
        self._singular = lru_cache(maxsize=16384)(self._find_singular)
        self._synset_at = lru_cache(maxsize=16384)(self._find_synset)
        self._read_offsets = read_offsets
        self._read_labels = read_labels

    def senses(self, lemma: str) -> tuple[Sense, ...]:
        """Return the senses of a lemma or joined compound (`flowerpot`), most frequent first; none if it is unknown."""
        found = self._senses.get(lemma)
        if found is None:
            row = self._lemmas.find(lemma)
            if row is None:
                return ()
            synsets, kinds = self._synsets[row].split(), self.parse_kinds(self._kinds[row])
            pairs = zip(synsets, kinds, strict=True)
            found = self._senses[lemma] = tuple(Sense(int(synset), *kind) for synset, kind in pairs)
        return found

    def kinds(self, lemma: str) -> str:
        """Return rank and domain of a lemma's senses as text for `parse_kinds`; empty for an unknown lemma.

        Many lemmas share one text, which callers use as a cache key.
        """
        row = self._lemmas.find(lemma)
        return "" if row is None else self._kinds[row]

    def parse_kinds(self, kinds: str) -> list[tuple[int, str]]:
        """Return (rank, domain) of each sense in a text from `kinds`, most frequent first."""
        return [(int(kind[1:]), self._domains[kind[0]]) for kind in kinds.split()]

    @property
    def lemmas(self) -> Collection[str]:
        """All lemmas, sorted."""
        return list(self._lemmas)

    def __contains__(self, lemma: str) -> bool:
        return lemma in self._lemmas

    def is_phrase(self, lemma: str) -> bool:
        """Return whether a lemma is a compound of several written words: `ctscanner` is “CT scanner”."""
        row = self._lemmas.find(lemma)
        return row is not None and self._is_one_word[row] == "0"

    def phrases(self) -> list[str]:
        """Return the compounds of several written words, joined."""
        return [lemma for lemma, is_one_word in zip(self._lemmas, self._is_one_word, strict=True) if is_one_word == "0"]

    def name(self, synset: int) -> str:
        """Return the first lemma of a synset, with its spaces."""
        return self._names[synset]

    def concept_iri(self, synset: int) -> str:
        """Return the IRI of a synset: from WordNet 3.1, or from this project for nouns missing from WordNet."""
        at = synset * _OFFSET_DIGITS
        if offset := self._offsets[at : at + _OFFSET_DIGITS]:
            return f"{WORDNET}{offset}-n"
        return CONCEPT + quote(self.name(synset).replace(" ", "_"), safe="")

    def find_concept(self, iri: str) -> int | None:
        """Return the synset with an IRI; None if there is none."""
        if found := re.fullmatch(re.escape(WORDNET) + r"(\d{8})-n", iri):
            return self._synset_at(int(found[1]))
        if not iri.startswith(CONCEPT):
            return None
        name = unquote(iri.removeprefix(CONCEPT)).replace("_", " ")
        key = name.replace(" ", "").replace("-", "")
        return next((s.synset for s in self.senses(key) if self.concept_iri(s.synset) == iri), None)

    @cached_property
    def _offsets(self) -> str:
        # Read on first use: only concepts in results need IRIs.
        return self._read_offsets()

    def _find_synset(self, offset: int) -> int | None:
        found = np.flatnonzero(self._offset_numbers == offset)
        return int(found[-1]) if len(found) else None

    @cached_property
    def _offset_numbers(self) -> npt.NDArray[np.int32]:
        digits = np.frombuffer(self._offsets.encode(), np.uint8).reshape(-1, _OFFSET_DIGITS) - ord("0")
        return digits @ 10 ** np.arange(_OFFSET_DIGITS, dtype=np.int32)[::-1]

    def label(self, synset: int) -> str:
        """Return the noun that names use for a synset most often, with its spaces: trash can, not ashcan."""
        return (self._labels[synset] if self._labels is not None else "") or self.name(synset)

    @cached_property
    def _labels(self) -> _Cells | None:
        return _Cells(self._read_labels()) if self._read_labels is not None else None

    def size(self, synset: int) -> int:
        """Return the number of hyponyms of a synset, itself included."""
        return int(self._sizes[synset])

    @property
    def synset_count(self) -> int:
        """The number of synsets."""
        return len(self._names)

    def above(self, synset: int) -> tuple[int, ...]:
        """Return the direct hypernyms of a synset."""
        found = self._above.get(synset)
        if found is None:
            found = self._above[synset] = tuple(map(int, self._above_texts[synset].split()))
        return found

    def walk_up(self, synset: int) -> Iterator[tuple[int, int]]:
        """Yield (hypernym, steps) of a synset, nearest first, itself with 0 steps."""
        steps = {synset: 0}
        pending = [synset]
        for current in pending:
            yield current, steps[current]
            for up in self.above(current):
                if up not in steps:
                    steps[up] = steps[current] + 1
                    pending.append(up)

    def below(self, names: frozenset[str]) -> Callable[[int], bool]:
        """Return a predicate: whether a synset or a hypernym has one of these names."""
        known: dict[int, bool] = {}

        def is_below(synset: int) -> bool:
            if synset not in known:
                known[synset] = self._names[synset] in names or any(is_below(up) for up in self.above(synset))
            return known[synset]

        return is_below

    def path_up(self, synset: int, target: int) -> list[int]:
        """Return a shortest path of hypernyms from `synset` up to `target`, both included."""
        came_from: dict[int, int | None] = {synset: None}
        for current, _ in self.walk_up(synset):
            for up in self.above(current):
                came_from.setdefault(up, current)
        path: list[int] = []
        step: int | None = target
        while step is not None:
            path.append(step)
            step = came_from[step]
        return path[::-1]

    def singular(self, word: str) -> str:
        """Return the singular of a plural noun; a known lemma or an unknown word unchanged.

        >>> load_taxonomy().singular("knives")
        'knife'
        """
        return word if word in self._lemmas or len(word) < 4 else self._singular(word)

    def _find_singular(self, word: str) -> str:
        for ending, singular in (*_PLURALS, *_MORE_PLURALS):
            if word.endswith(ending) and (stem := word[: -len(ending)] + singular) in self._lemmas:
                return stem
        return word

    def words(self, domains: frozenset[str]) -> list[str]:
        """Return the single-word lemmas with a sense in one of `domains`, sorted."""
        others = frozenset(letter for letter, domain in self._domains.items() if domain in domains).isdisjoint
        return sorted(
            [
                lemma
                for lemma, kinds, is_one_word in zip(self._lemmas, self._kinds, self._is_one_word, strict=True)
                if is_one_word == "1" and lemma.isalpha() and not others(kinds)
            ]
        )


@lru_cache(maxsize=1)
def load_taxonomy() -> Taxonomy:
    """Return the taxonomy of the package, read once."""
    columns = parse_taxonomy(read_compressed("wordnet.txt.gz"))
    return Taxonomy(
        columns,
        lambda: read_compressed("wordnet_offsets.txt.gz").decode(),
        lambda: read_compressed("wordnet_labels.txt.gz"),
    )
