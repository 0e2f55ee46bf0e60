"""What a run of words names by itself: the TBox's terms first, then what the head noun is a kind of."""

from collections.abc import Iterator
from dataclasses import dataclass

from usd2kg.grounding.embedded.lexicon import Lexicon, sense_weight
from usd2kg.grounding.embedded.likeness import likely_classes, similar_name
from usd2kg.grounding.embedded.names import NameReader
from usd2kg.grounding.embedded.taxonomy import Taxonomy
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["Match", "Namer"]

_TERM, _COMPOUND_KIND, _KIND = 0.97, 0.88, 0.82
_HOP_DECAY = 0.965
_ROOT_SHARE = 0.75
_PLACED = 0.95
_LIKENESS = 0.5
"""How far the class of names that are alike is heard, where a name is in no list and its head or kind is."""


@dataclass(frozen=True, slots=True)
class Match:
    """A class that a phrase may name."""

    class_iri: ClassIRI
    score: float
    """From 0 to 1; an uncalibrated guess at being right."""
    explanation: str


class Namer:
    """Knows what words name in one TBox."""

    def __init__(self, tbox: TBox, lexicon: Lexicon, taxonomy: Taxonomy, reader: NameReader) -> None:
        self._tbox = tbox
        self._lexicon = lexicon
        self._taxonomy = taxonomy
        self._reader = reader
        self._roots = frozenset(tbox.roots)

    def name(self, words: tuple[str, ...], places: tuple[str, ...]) -> tuple[tuple[str, ...], list[Match]]:
        """Return the longest known run of words at the end, and what the words name, heeding what is called alike."""
        run, found = self._at_head(words, places)
        if not found or not self._lexicon.listed.issuperset(match.class_iri for match in found):
            # Of classes that the home vocabulary does not have it knows nothing like.
            return run, found
        whole = (*words[:-1], self._taxonomy.singular(words[-1]))
        is_listed = "".join((*run[:-1], whole[-1])) in self._lexicon.terms and (len(run) > 1 or len(words) == 1)
        return run, found if is_listed else self._heeding_likeness(whole, found)

    def _heeding_likeness(self, words: tuple[str, ...], found: list[Match]) -> list[Match]:
        """Return the matches of the head, mixed with what names like the whole one mean."""
        best = {match.class_iri: match for match in sorted(found, key=lambda match: match.score)}
        shares = {iri: share for iri, share in likely_classes(words) if iri in self._tbox.by_iri}
        mixed = []
        for iri in dict.fromkeys([*best, *shares]):
            own = best.get(iri)
            score = (1 - _LIKENESS) * (own.score if own else 0.0) + _LIKENESS * _TERM * shares.get(iri, 0.0)
            mixed.append(Match(iri, score, own.explanation if own else self._likeness_text(words, iri)))
        return sorted(mixed, key=lambda match: (-match.score, match.class_iri))

    def _likeness_text(self, words: tuple[str, ...], iri: ClassIRI) -> str:
        similar = similar_name(words, iri)
        like = f", like “{similar}”," if similar else ""
        return f"what is called like “{' '.join(words)}”{like} is mostly {self._label(iri)}"

    def _at_head(self, words: tuple[str, ...], places: tuple[str, ...]) -> tuple[tuple[str, ...], list[Match]]:
        """Return the longest run of words that ends with the last one and is known, and its matches."""
        is_modifier = self._reader.is_modifier(words[-1])
        for start in range(len(words)):
            run = words[start:]
            if is_modifier and len(run) == 1:
                break
            key = "".join((*run[:-1], self._taxonomy.singular(run[-1])))
            found = [*self.by_term(key), *self._by_kind(key, len(run) > 1)]
            if found:
                return run, [*self._in_place(key, run[-1], found, places), *found]
        return (), []

    def by_term(self, key: str) -> list[Match]:
        """Return the class that a term without spaces names, if any."""
        term = self._lexicon.terms.get(key)
        if term is None:
            return []
        named = "is the label of" if term.weight == 1.0 else "is a name for"
        text = f"“{term.text}” {named} {self._label(term.class_iri)}"
        return [Match(term.class_iri, _TERM * term.weight, text)]

    def _in_place(self, key: str, head: str, found: list[Match], places: tuple[str, ...]) -> Iterator[Match]:
        """Yield the class that is named after the place: a cabinet in the kitchen is a kitchen cabinet.

        A word that is a class's own label needs no place to be understood.
        """
        term = self._lexicon.terms.get(key)
        if term is not None and term.weight == 1.0:
            return
        above = {match.class_iri for match in found}
        for place in places:
            special = self._lexicon.terms.get(place + key) or self._lexicon.terms.get(place + head)
            if special is None or special.class_iri in above or special.class_iri in self._roots:
                continue
            if any(self._tbox.is_subclass(special.class_iri, iri) for iri in above):
                label = self._label(special.class_iri)
                text = f"a “{key}” in “{place}” is a {special.text}, which is {label}"
                yield Match(special.class_iri, _TERM * special.weight * _PLACED, text)
                return

    def _by_kind(self, key: str, is_compound: bool) -> Iterator[Match]:
        """Yield for each sense of a noun the nearest class above it in the taxonomy."""
        for sense in self._taxonomy.senses(key):
            for synset, hops in self._taxonomy.walk_up(sense.synset):
                anchor = self._lexicon.anchors.get(synset)
                if anchor is None:
                    continue
                score = (_COMPOUND_KIND if is_compound else _KIND) * sense_weight(sense) * _HOP_DECAY**hops
                if anchor.class_iri in self._roots:
                    score *= _ROOT_SHARE
                yield Match(
                    anchor.class_iri, score * anchor.weight, self._kinds(sense.synset, synset, anchor.class_iri)
                )
                break

    def _kinds(self, synset: int, target: int, class_iri: ClassIRI) -> str:
        names = [self._taxonomy.name(step) for step in self._taxonomy.path_up(synset, target)]
        chain = names if len(names) <= 4 else [*names[:2], "…", names[-1]]
        kinds = " is a kind of ".join(f"“{name}”" if name != "…" else name for name in chain)
        return f"{kinds}, which is {self._label(class_iri)}"

    def _label(self, class_iri: ClassIRI) -> str:
        return self._tbox.by_iri[class_iri].local_name
