"""From a noun phrase to classes: the TBox's terms first, then what the head noun is a kind of."""

from collections.abc import Iterator
from dataclasses import dataclass

from usd2kg.grounding.embedded.lexicon import Lexicon, sense_weight
from usd2kg.grounding.embedded.names import NamePhrase, NameReader
from usd2kg.grounding.embedded.taxonomy import Taxonomy
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.words import split_identifier

__all__ = ["Match", "Matcher"]

_TERM, _COMPOUND_KIND, _KIND = 0.97, 0.88, 0.82
_HOP_DECAY = 0.965
_ROOT_SHARE = 0.75
_FORMER_HEAD = 0.55
_BEFORE_CODE = 0.8
_RESPELLED = 0.9
_WEAK = 0.5
_EPITHET = 0.8
_PLACED = 0.95
_WHOLE = 0.75
"""A term of several words that stands before the head, as a share of what it would be in its place."""


@dataclass(frozen=True, slots=True)
class Match:
    """A class that a phrase may name."""

    class_iri: ClassIRI
    score: float
    """From 0 to 1; an uncalibrated guess at being right."""
    explanation: str


class Matcher:
    """Finds the classes for the phrases of one TBox."""

    def __init__(self, tbox: TBox, lexicon: Lexicon, taxonomy: Taxonomy, reader: NameReader) -> None:
        self._tbox = tbox
        self._lexicon = lexicon
        self._taxonomy = taxonomy
        self._reader = reader
        self._roots = frozenset(tbox.roots)

    def match(self, phrase: NamePhrase, parents: tuple[str, ...]) -> list[Match]:
        """Return the classes a phrase may name, best first; none if no word of it is known."""
        best: dict[ClassIRI, Match] = {}
        for match in self._matches(phrase, parents):
            if match.class_iri not in best or best[match.class_iri].score < match.score:
                best[match.class_iri] = match
        return sorted(best.values(), key=lambda match: (-match.score, match.class_iri))

    def heads(self, phrase: NamePhrase) -> list[tuple[tuple[str, ...], list[Match]]]:
        """Return (words, classes) of each run of words at the beginning that may be the whole name, longest first."""
        found = []
        for end in range(len(phrase.words), 0, -1):
            for start in range(end if not self._reader.is_modifier(phrase.words[end - 1]) else 0):
                key = "".join((*phrase.words[start : end - 1], self._taxonomy.singular(phrase.words[end - 1])))
                matches = [*self._by_term(key), *self._by_kind(key, is_compound=end - start > 1)]
                if matches:
                    found.append((phrase.words[start:end], sorted(matches, key=lambda match: -match.score)))
                    break
        return found

    def _matches(self, phrase: NamePhrase, parents: tuple[str, ...]) -> Iterator[Match]:
        share = _RESPELLED if phrase.corrections else 1.0
        note = "".join(f" (“{written}” read as “{read}”)" for written, read in phrase.corrections)
        for head in range(len(phrase.words), 0, -1):
            if self._names_contents(phrase.words[:head]):
                continue
            found = self._at_head(phrase.words[:head], (*phrase.context, *_words_above(parents)))
            for match in found:
                yield Match(match.class_iri, match.score * share, match.explanation + note)
            is_weak = max((match.score for match in found), default=0.0) < _WEAK
            if found and not (is_weak and self._reader.is_epithet(phrase.words[head - 1])):
                yield from self._as_a_whole(phrase.words[: head - 1], share, note)
                return
            if found:
                share *= _EPITHET
            elif not self._reader.is_modifier(phrase.words[head - 1]):
                # The word that should say what it is means nothing here: what stands before it says less. A word that
                # is no English noun is the code of a make or a place.
                share *= _FORMER_HEAD if self._reader.is_noun(phrase.words[head - 1]) else _BEFORE_CODE

    def _as_a_whole(self, words: tuple[str, ...], share: float, note: str) -> Iterator[Match]:
        """Yield the class that several words at the beginning name together: `coffeeMachine_cafeLine`."""
        for end in range(len(words), 1, -1):
            for start in range(end - 1):
                for match in self._by_term("".join(words[start:end])):
                    yield Match(match.class_iri, match.score * share * _WHOLE, match.explanation + note)
                    return

    def _names_contents(self, words: tuple[str, ...]) -> bool:
        """Return whether the last word says what a thing before it is made of or holds: `can_tomato`, `sink_steel`.

        A compound that is known as a whole (`wine glass`) says what it says.
        """
        *before, last = words
        if not before or not self._reader.is_stuff(last) or not self._reader.is_thing(before[-1]):
            return False
        compounds = ("".join(words[start:]) for start in range(len(words) - 1))
        return not any(key in self._lexicon.terms or key in self._taxonomy for key in compounds)

    def _at_head(self, words: tuple[str, ...], places: tuple[str, ...]) -> list[Match]:
        """Return the matches of the longest run of words that ends with the last one and is known."""
        is_modifier = self._reader.is_modifier(words[-1])
        for start in range(len(words)):
            run = words[start:]
            if is_modifier and len(run) == 1:
                return []
            key = "".join((*run[:-1], self._taxonomy.singular(run[-1])))
            found = [*self._by_term(key), *self._by_kind(key, len(run) > 1)]
            if found:
                return [*self._in_place(key, run[-1], found, places), *found]
        return []

    def _by_term(self, key: str) -> list[Match]:
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


def _words_above(parents: tuple[str, ...]) -> tuple[str, ...]:
    """Return the words of the names above, nearest first."""
    return tuple(word.lower() for parent in reversed(parents) for word in split_identifier(parent))
