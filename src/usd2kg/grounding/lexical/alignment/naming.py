"""What a run of words names by itself: the TBox's terms first, then what the head noun is a kind of."""

from bisect import bisect_left
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cached_property, lru_cache, partial
from math import log
from operator import itemgetter
from typing import NamedTuple

from usd2kg.grounding.lexical.alignment.lexicon import Counted, Lexicon, home_names
from usd2kg.grounding.lexical.alignment.routes import Route, Routes
from usd2kg.grounding.lexical.alignment.terms import HEAD, LABEL, LENT, Anchor, Term
from usd2kg.grounding.lexical.concepts.name_classifier import likely_classes, similar_name
from usd2kg.grounding.lexical.concepts.senses import sense_weight, unmade_weight
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.grounding.lexical.reading.noun_phrase import NamePhrase, NameReader
from usd2kg.grounding.lexical.reading.word_kinds import AREAS
from usd2kg.ontology import ClassIRI, TBox, load_home_tbox
from usd2kg.words import split_identifier

__all__ = ["RULED", "Match", "Namer"]

_TERM, _COMPOUND_KIND, _KIND = 0.97, 0.88, 0.82
_HOP_DECAY = 0.965
_ROOT_SHARE, _FROM_ROOT = 0.75, 2
"""Of a root the share is less, and the decay the other way round: what is far below one is a thing of its own, which
the TBox lacks, as a wall may be; what is near, a structure or a surface, says little of what a thing is."""
_ABOUT_AS_NEAR = 1
"""Steps in the taxonomy by which a class may be farther off that tells more."""
_MUCH_SMALLER = 1.8
"""How much smaller a kind has to be, as a logarithm, that people count a thing among against the taxonomy."""
_SECOND = 0.9
"""What a likely meaning of a noun weighs at least: of made things the first and the second do, no later one."""
_FEW_THINGS = 100
"""Kinds below a noun, up to which the class of the only label that ends with it is meant."""
_PLACED = 0.95
_SHORTEST_NOUN = 3
"""Fewer letters are a code more often than a noun, but for those of the home vocabulary: a TV, a PC."""
RULED = 3.0
"""How many times likelier the class that the rules give is than by the routes to it alone."""
_SHARPNESS = 0.5
"""Power of the odds of two classes that is the quotient of their scores: squared, as in `decision`, they are shares."""
_LIKENESS = 0.5
"""How far the class of names that are alike is heard, where a name is in no list and its head or kind is."""


class Match(NamedTuple):
    """A class that a phrase may name."""

    class_iri: ClassIRI
    score: float
    """From 0 to 1; an uncalibrated guess at being right."""
    reason: Callable[[], str]
    """Gives why, whatever else the name says; of most matches nobody asks for it."""
    phrase: NamePhrase = NamePhrase(())
    """The name."""
    end: int = 0
    """Number of the word before which the phrase proper ends."""

    @property
    def explanation(self) -> str:
        """What a person is told."""
        words, corrections = self.phrase.words, self.phrase.corrections
        behind = f" (the thing in “{' '.join(words)}”)" if words[self.end :] else ""
        read = "".join(f" (“{written}” read as “{read}”)" for written, read in corrections)
        return self.reason() + behind + read


class Namer:
    """Knows what words name in one TBox."""

    def __init__(
        self, tbox: TBox, lexicon: Lexicon, taxonomy: Taxonomy, reader: NameReader, *, heeds_routes: bool = True
    ) -> None:
        """Begin; `heeds_routes` is whether the rules are mixed with the fitted weights of `routes`."""
        self._tbox = tbox
        self._lexicon = lexicon
        self._taxonomy = taxonomy
        self._reader = reader
        self._general = lexicon.general
        self._has_own = not lexicon.listed.issuperset(tbox.by_iri)
        # Of the classes of the home vocabulary more is known than the routes to them tell.
        is_foreign = lexicon.listed.isdisjoint(tbox.by_iri)
        self._routes = Routes(tbox, lexicon, taxonomy) if heeds_routes and is_foreign else None
        # What words name depends on nothing else, and names say the same words over and over.
        self._known = lru_cache(maxsize=4096)(self._naming)
        self._places_above = lru_cache(maxsize=4096)(self._telling_words_above)

    def is_fallback(self, iri: ClassIRI | None) -> bool:
        """Return whether a class is the one of all that another ontology than the home TBox has no class for."""
        return self._has_own and iri == self._lexicon.default

    def places(self, context: tuple[str, ...], parents: tuple[str, ...]) -> tuple[str, ...]:
        """Return the words of a name and of the names above that may be a place of something, nearest first."""
        if not context:
            return self._places_above(parents) if parents else ()
        return (*filter(self._begins_term, context), *self._places_above(parents))

    def whole_of(self, words: tuple[str, ...], whole: tuple[str, ...]) -> tuple[str, ...]:
        """Return the words of what a thing is part of that make a term of several with its own; mostly none.

        They are the last ones, or those before a last one that is unknown or an area: a fork in the `diningArea` is a
        dining fork.
        """
        if not whole:
            return ()
        *before, last = words
        key = "".join(before) + self._taxonomy.singular(last)
        may_drop_last = len(whole) > 1 and (whole[-1] in AREAS or not self._reader.kinds.is_known(whole[-1]))
        for end in range(len(whole), len(whole) - 1 - may_drop_last, -1):
            head = self._taxonomy.singular(whole[end - 1])
            for start in range(end):
                term = self._lexicon.terms.get("".join((*whole[start : end - 1], head)) + key)
                # A name that is only lent to a class does not stand against the class's own.
                if term is not None and " " in term.text and term.weight > LENT:
                    return whole[start:end]
        return ()

    def name(self, words: tuple[str, ...], places: tuple[str, ...]) -> tuple[tuple[str, ...], tuple[Match, ...]]:
        """Return the longest known run of words at the end, and what the words name.

        Classes of the home vocabulary heed what is called alike, those of other ontologies all routes to them.
        """
        run, found = self._at_head(words, places)
        if self._routes is not None and found:
            return run, self._heeding_routes(run, found)
        if not found or not self._lexicon.listed.issuperset([match.class_iri for match in found]):
            # Of classes that the home vocabulary does not have it knows nothing like.
            return run, found
        whole = (*words[:-1], self._taxonomy.singular(words[-1]))
        is_listed = "".join((*run[:-1], whole[-1])) in self._lexicon.terms and (len(run) > 1 or len(words) == 1)
        return run, found if is_listed else self._heeding_likeness(whole, found)

    def name_compound(self, run: tuple[str, str]) -> tuple[Match, ...]:
        """Return what two words name as a term, or in another ontology as a noun; nothing if they are not known so."""
        if not self._has_own:
            return self.by_term("".join(run))
        known, found = self.name(run, ())
        return found if len(known) > 1 else ()

    def _heeding_likeness(self, words: tuple[str, ...], found: Iterable[Match]) -> tuple[Match, ...]:
        """Return the matches of the head, mixed with what names like the whole one mean."""
        best = {match.class_iri: match for match in sorted(found, key=lambda match: match.score)}
        shares = {iri: share for iri, share in likely_classes(words) if iri in self._tbox.by_iri}
        mixed = []
        for iri in dict.fromkeys([*best, *shares]):
            own = best.get(iri)
            score = (1 - _LIKENESS) * (own.score if own else 0.0) + _LIKENESS * _TERM * shares.get(iri, 0.0)
            mixed.append(Match(iri, score, own.reason if own else partial(self._likeness_text, words, iri)))
        return tuple(sorted(mixed, key=lambda match: (-match.score, match.class_iri)))

    def _heeding_routes(self, run: tuple[str, ...], found: tuple[Match, ...]) -> tuple[Match, ...]:
        """Return the matches by the rules, mixed with how likely each class is by the routes to it."""
        assert self._routes is not None
        weighed, ruled = self._routes.weigh(run), _best(found)
        if ruled not in weighed:
            # No route leads to it: the place tells it, or the home vocabulary lends it.
            return found
        shares = {iri: share * (RULED if iri == ruled else 1.0) for iri, (share, _) in weighed.items()}
        likeliest = min(shares, key=lambda iri: (-shares[iri], iri))
        by_rules = {match.class_iri: match for match in sorted(found, key=lambda match: match.score)}
        if likeliest == ruled:
            most = by_rules[ruled].score
        else:
            # What the rules doubted is believed as much as a noun is whose class is clear.
            most = (_KIND if len(run) == 1 else _COMPOUND_KIND) * (_ROOT_SHARE if likeliest in self._general else 1.0)
        mixed = [
            Match(
                iri,
                most * (share / shares[likeliest]) ** _SHARPNESS,
                by_rules[iri].reason if iri in by_rules else self._route_reason(weighed[iri][1]),
            )
            for iri, share in shares.items()
        ]
        untold = [match for iri, match in by_rules.items() if iri not in shares]
        return tuple(sorted([*mixed, *untold], key=lambda match: (-match.score, match.class_iri)))

    def _route_reason(self, route: Route) -> Callable[[], str]:
        if isinstance(route.origin, Term):
            return partial(self._term_text, route.origin)
        return partial(self._kinds_text, *route.origin)

    def _at_head(self, words: tuple[str, ...], places: tuple[str, ...]) -> tuple[tuple[str, ...], tuple[Match, ...]]:
        """Return the longest run of words that ends with the last one and is known, and its matches."""
        *before, last = words
        singular = self._taxonomy.singular(last)
        starts = range(len(before) if self._reader.kinds.is_modifier(last) else len(words))
        keys = {start: "".join(before[start:]) + singular for start in starts}
        run, found = self._known_run(words, keys, places)
        if self._lexicon.borrowed and all(match.class_iri == self._lexicon.default for match in found):
            # That it is some appliance says more than the class of all things.
            borrowed = {start: self._lexicon.borrowed.get(key) for start, key in keys.items()}
            start = next((start for start, term in borrowed.items() if term is not None), None)
            if start is not None:
                return words[start:], (*self._named_by(borrowed[start]), *found)
        return run, found

    def _known_run(
        self, words: tuple[str, ...], keys: Mapping[int, str], places: tuple[str, ...]
    ) -> tuple[tuple[str, ...], tuple[Match, ...]]:
        """Return the longest of the runs that is known, and its matches; `keys` are by the word they start at."""
        longest: tuple[tuple[str, ...], tuple[Match, ...]] = ((), ())
        longest_key = ""
        for start, key in keys.items():
            if key not in self._lexicon.terms and key not in self._taxonomy:
                continue
            found = self._known(key, words[-1], start < len(words) - 1, places)
            if longest[1] and found and self._suits_better(_best(found), _best(longest[1])):
                # A sofa cushion is an artifact at home; where there are cushions, it is a cushion.
                return words[start:], found
            if longest[1] and found and self._tells_more(key, found, longest_key, longest[1]):
                return longest[0], found
            if not longest[1]:
                longest, longest_key = (words[start:], found), key
            is_listed = longest_key in self._lexicon.terms
            if longest[1] and is_listed and not self._is_general(_best(longest[1])):
                break
        return longest if longest[1] else ((), ())

    def _tells_more(self, key: str, found: tuple[Match, ...], longer: str, general: tuple[Match, ...]) -> bool:
        """Return whether a noun says more than a longer one that ends with it: a side plate is a plate.

        The home vocabulary lists so many names that there the longer one has to be of the kind by the taxonomy too.
        """
        special, above = _best(found), _best(general)
        if longer in self._lexicon.terms or not self._is_below(special, above):
            return False
        if self._has_own:
            return above not in self._general
        kinds = {up for sense in self._taxonomy.senses(longer) for up, _ in self._taxonomy.walk_up(sense.synset)}
        return key in self._lexicon.terms and any(sense.synset in kinds for sense in self._taxonomy.senses(key))

    def _naming(self, key: str, head: str, is_compound: bool, places: tuple[str, ...]) -> tuple[Match, ...]:
        kinds = tuple(self._by_kind(key, is_compound))
        found = [*self._special_head(key, kinds), *self._unless_special(self.by_term(key), kinds), *kinds]
        return (*self._in_place(key, head, found, places), *found) if found else ()

    def _special_head(self, key: str, kinds: tuple[Match, ...]) -> tuple[Match, ...]:
        """Return the class of the only label that ends with a word which means few things, below what these are.

        Where there are kick scooters among the vehicles, a scooter is one of them; a machine may be any.
        """
        term = self._lexicon.terms.get(key)
        if not self._has_own or term is None or term.weight != HEAD or not 0 < self._things_called(key) <= _FEW_THINGS:
            return ()
        if not any(
            self._is_below(term.class_iri, kind.class_iri) and kind.class_iri not in self._general for kind in kinds
        ):
            return ()
        return (Match(term.class_iri, _TERM * LENT, partial(self._term_text, term)),)

    def _things_called(self, key: str) -> int:
        """Return how many things a noun means at most, as something made."""
        made = (sense.synset for sense in self._taxonomy.senses(key) if sense.domain == "artifact")
        return max(map(self._taxonomy.size, made), default=0)

    def _unless_special(self, terms: tuple[Match, ...], kinds: tuple[Match, ...]) -> tuple[Match, ...]:
        """Return the classes that a term names, unless it is no label and a class of the TBox's own suits better.

        That is one below them, and any but those above them where the term is one of a general class: the home
        vocabulary calls an artifact what it has no class for, as another ontology may have.
        """
        return tuple(
            match
            for match in terms
            if match.score == _TERM or not any(self._suits_better(kind.class_iri, match.class_iri) for kind in kinds)
        )

    def _suits_better(self, own: ClassIRI, listed: ClassIRI) -> bool:
        if listed not in self._lexicon.listed or own in self._lexicon.listed:
            return False
        return self._tbox.is_subclass(own, listed) or (
            self._is_general(listed) and own not in self._tbox.closure(listed)
        )

    def _is_general(self, iri: ClassIRI) -> bool:
        """Return whether the TBox has classes of its own and this is one of the home TBox with others below."""
        return self._has_own and iri in self._lexicon.listed and bool(load_home_tbox().children[iri])

    def by_term(self, key: str) -> tuple[Match, ...]:
        """Return the class that a term without spaces names, if any."""
        return self._named_by(self._lexicon.terms.get(key))

    def _named_by(self, term: Term | None) -> tuple[Match, ...]:
        return () if term is None else (Match(term.class_iri, _TERM * term.weight, partial(self._term_text, term)),)

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
            if special is None or special.class_iri in above or special.class_iri in self._general:
                continue
            if any(self._tbox.is_subclass(special.class_iri, iri) for iri in above):
                reason = partial(self._place_text, key, place, special)
                yield Match(special.class_iri, _TERM * special.weight * _PLACED, reason)
                return

    def _by_kind(self, key: str, is_compound: bool) -> Iterator[Match]:
        """Yield for each sense of a noun the nearest class above it in the taxonomy."""
        if len(key) < _SHORTEST_NOUN and key not in _short_names():
            # The EL of an asset's path is no elevated railway.
            return
        senses = self._taxonomy.senses(key)
        usual = max(senses, key=sense_weight, default=None)
        is_lacking = usual is not None and self._is_default(self._nearest_above(usual.synset))
        for sense in senses:
            found = self._nearest_above(sense.synset)
            if found is not None:
                synset, hops, anchor = found
                score = _COMPOUND_KIND if is_compound else _KIND
                weight = sense_weight(sense)
                if self._has_own and hops == 0 and anchor.weight == LABEL and weight >= _SECOND:
                    # An ontology with post boxes means one by its mailboxes, which may be letter boxes too.
                    score *= LABEL
                elif not is_lacking or sense is usual:
                    score *= weight
                elif sense.domain in self._lexicon.kingdoms:
                    # An ontology with trees means one by its oaks and birches, rather than a rod.
                    score *= unmade_weight(sense)
                else:
                    # Where there are no boxes, a box is not for that the compartment that it may be too.
                    score *= _ROOT_SHARE * weight
                if anchor.class_iri in self._general:
                    score *= _ROOT_SHARE * _HOP_DECAY ** max(0, _FROM_ROOT - hops)
                else:
                    score *= _HOP_DECAY**hops
                reason = partial(self._kinds_text, sense.synset, synset, anchor)
                yield Match(anchor.class_iri, score * anchor.weight, reason)

    def _is_default(self, found: tuple[int, int, Anchor] | None) -> bool:
        return found is not None and found[2].class_iri == self._lexicon.default

    def _nearest_above(self, synset: int) -> tuple[int, int, Anchor] | None:
        """Return the nearest synset above that has a class, its hops and the class; special classes go first.

        The home vocabulary has a teddy among the artifacts; an ontology with toys below the artifacts means those. Of
        classes that are about as near, the one with most above it says most: a range hood is a kitchen appliance
        rather than a covering.
        """
        nearest: tuple[int, int, Anchor] | None = None
        for up, hops in self._taxonomy.walk_up(synset):
            anchor = self._lexicon.anchors.get(up)
            if anchor is None or (nearest is not None and anchor.class_iri == self._lexicon.default):
                continue
            if nearest is None or self._is_own_below(anchor.class_iri, nearest[2].class_iri):
                nearest = up, hops, anchor
                if not self._has_own:
                    break
            elif self._is_below(anchor.class_iri, nearest[2].class_iri) or (
                hops <= nearest[1] + _ABOUT_AS_NEAR
                and self._depth(anchor) > self._depth(nearest[2])
                and all(up != above for above, _ in self._taxonomy.walk_up(nearest[0]))
            ):
                nearest = up, hops, anchor
        return self._counted_among(synset, nearest) or nearest if self._has_own else nearest

    def _counted_among(self, synset: int, nearest: tuple[int, int, Anchor] | None) -> tuple[int, int, Anchor] | None:
        """Return the same for a class that people count a thing among, where that says more; mostly None."""
        general = None if nearest is None or nearest[2].class_iri in self._general else nearest

        def tells_more(counted: Counted, size: float) -> bool:
            if general is None:
                return True
            iri, (target, hops, anchor) = counted.anchor.class_iri, general
            # A lamp is furniture to WordNet: where there are lights, it is sooner one of them.
            is_smaller = hops > 0 and size < log(self._taxonomy.size(target)) + hops - _MUCH_SMALLER
            return self._is_below(iri, anchor.class_iri) or (
                is_smaller and not self._tbox.is_subclass(anchor.class_iri, iri)
            )

        found = [
            (size, up, hops + 1, counted.anchor)
            for up, hops in self._taxonomy.walk_up(synset)
            for counted in self._lexicon.counted.get(up, ())
            if tells_more(counted, size := log(counted.things) + hops)
        ]
        # The smaller a kind, and the nearer, the more it tells.
        return min(found, key=itemgetter(0))[1:] if found else None

    def _depth(self, anchor: Anchor) -> int:
        return len(self._tbox.closure(anchor.class_iri))

    def _is_below(self, special: ClassIRI, general: ClassIRI | None) -> bool:
        return general is not None and special != general and self._tbox.is_subclass(special, general)

    def _is_own_below(self, special: ClassIRI, general: ClassIRI) -> bool:
        """Return whether a class is one that the home vocabulary does not know, below one that it does."""
        is_own = general in self._lexicon.listed and special not in self._lexicon.listed
        return is_own and self._tbox.is_subclass(special, general)

    def _likeness_text(self, words: tuple[str, ...], iri: ClassIRI) -> str:
        similar = similar_name(words, iri)
        like = f", like “{similar}”," if similar else ""
        return f"what is called like “{' '.join(words)}”{like} is mostly {self._label(iri)}"

    def _term_text(self, term: Term) -> str:
        named = "is the label of" if term.weight == 1.0 else "is a name for"
        return f"“{term.text}” {named} {self._label(term.class_iri)}"

    def _place_text(self, key: str, place: str, special: Term) -> str:
        return f"a “{key}” in “{place}” is a {special.text}, which is {self._label(special.class_iri)}"

    def _kinds_text(self, synset: int, target: int, anchor: Anchor) -> str:
        names = [self._taxonomy.name(step) for step in self._taxonomy.path_up(synset, target)]
        chain = names if len(names) <= 4 else [*names[:2], "…", names[-1]]
        kinds = " is a kind of ".join(f"“{name}”" if name != "…" else name for name in chain)
        is_of_it = self._lexicon.anchors.get(target) == anchor
        link = ", which is" if is_of_it else " counts as" if len(chain) == 1 else ", which counts as"
        return f"{kinds}{link} {self._label(anchor.class_iri)}"

    def _label(self, class_iri: ClassIRI) -> str:
        return self._tbox.by_iri[class_iri].readable_name

    def _telling_words_above(self, parents: tuple[str, ...]) -> tuple[str, ...]:
        words = (word.lower() for parent in reversed(parents) for word in split_identifier(parent))
        return tuple(filter(self._begins_term, words))

    def _begins_term(self, word: str) -> bool:
        at = bisect_left(self._term_keys, word)
        return at < len(self._term_keys) and self._term_keys[at].startswith(word)

    @cached_property
    def _term_keys(self) -> list[str]:
        return sorted(self._lexicon.terms)


@lru_cache(maxsize=1)
def _short_names() -> frozenset[str]:
    return frozenset(name.lower() for names in home_names().values() for name in names if len(name) < _SHORTEST_NOUN)


def _best(matches: tuple[Match, ...]) -> ClassIRI:
    return max(matches, key=lambda match: match.score).class_iri
