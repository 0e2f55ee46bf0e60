"""WordNet's nouns for physical things: lemmas, senses in order of use, and what is a kind of what."""

import gzip
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files

__all__ = ["Sense", "Taxonomy", "load_taxonomy"]

# Morphy's detachment rules for nouns (morphy(7WN)).
_PLURALS = (("ches", "ch"), ("shes", "sh"), ("sses", "ss"), ("xes", "x"), ("zes", "z"), ("ies", "y"), ("men", "man"))
_MORE_PLURALS = (("ves", "f"), ("ves", "fe"), ("es", "e"), ("es", ""), ("s", ""))


@dataclass(frozen=True, slots=True)
class Sense:
    """One meaning of a lemma."""

    synset: int
    rank: int
    """1 for the meaning used most."""
    domain: str
    """WordNet's lexicographer file: artifact, food, plant…"""


class Taxonomy:
    """A noun hierarchy. Synsets are numbers; lemmas are lower case, compounds with or without space."""

    def __init__(self, text: str) -> None:
        adjectives, *lines = text.splitlines()
        self.adjectives = frozenset(adjectives.split())
        self._domains: list[str] = []
        self._hypernyms: list[tuple[int, ...]] = []
        self._names: list[str] = []
        self._senses: dict[str, list[tuple[int, int]]] = {}
        for synset, line in enumerate(lines):
            domain, above, lemmas = line.split("\t")
            self._domains.append(domain)
            self._hypernyms.append(tuple(map(int, above.split())))
            for entry in lemmas.split("|"):
                lemma, _, rank = entry.rpartition(":")
                self._senses.setdefault(lemma.replace(" ", "").replace("-", ""), []).append((int(rank), synset))
            self._names.append(lemmas.partition(":")[0])
        for senses in self._senses.values():
            senses.sort()

    def senses(self, lemma: str) -> list[Sense]:
        """Return the meanings of a lemma or joined compound (`flowerpot`), most used first; maybe none."""
        return [Sense(synset, rank, self._domains[synset]) for rank, synset in self._senses.get(lemma, ())]

    def __contains__(self, lemma: str) -> bool:
        return lemma in self._senses

    def name(self, synset: int) -> str:
        """Return the lemma that WordNet lists first for a synset."""
        return self._names[synset]

    def walk_up(self, synset: int) -> Iterator[tuple[int, int]]:
        """Yield (synset, hops) from a synset upwards, nearest first, itself with 0 hops."""
        seen = {synset}
        level, hops = [synset], 0
        while level:
            for current in level:
                yield current, hops
            above = [up for current in level for up in self._hypernyms[current]]
            level = [up for up in dict.fromkeys(above) if up not in seen]
            seen.update(level)
            hops += 1

    def path_up(self, synset: int, target: int) -> list[int]:
        """Return the synsets from `synset` up to `target`, both included, by a shortest way."""
        came_from: dict[int, int | None] = {synset: None}
        for current, _ in self.walk_up(synset):
            for up in self._hypernyms[current]:
                came_from.setdefault(up, current)
        path: list[int] = []
        step: int | None = target
        while step is not None:
            path.append(step)
            step = came_from[step]
        return path[::-1]

    def singular(self, word: str) -> str:
        """Return the singular of a plural noun; a word that is a noun as it stands, or unknown, unchanged.

        >>> load_taxonomy().singular("knives")
        'knife'
        """
        if word in self._senses or len(word) < 4:
            return word
        for ending, singular in (*_PLURALS, *_MORE_PLURALS):
            if word.endswith(ending) and (stem := word[: -len(ending)] + singular) in self._senses:
                return stem
        return word

    def words(self, domains: frozenset[str]) -> list[str]:
        """Return the single-word lemmas that have a meaning in one of `domains`, sorted."""
        return sorted(
            lemma
            for lemma, senses in self._senses.items()
            if lemma.isalpha() and any(self._domains[synset] in domains for _, synset in senses)
        )


@lru_cache(maxsize=1)
def load_taxonomy() -> Taxonomy:
    """Return the taxonomy that ships with the package, read once."""
    data = (files("usd2kg.grounding") / "data" / "wordnet.txt.gz").read_bytes()
    return Taxonomy(gzip.decompress(data).decode())
