"""Match the words up to a head noun with classes, by terms of the TBox, then by hypernyms of the head noun."""

import sys
from bisect import bisect_left
from collections.abc import Callable, Iterator, Mapping
from functools import cached_property, lru_cache, partial

from usd2kg.grounding.lexical.alignment.lexicon import Lexicon
from usd2kg.grounding.lexical.alignment.terms import AlignedClass, Term, TermKind
from usd2kg.grounding.lexical.concepts.home_names import home_words
from usd2kg.grounding.lexical.concepts.name_classifier import likely_classes, similar_name
from usd2kg.grounding.lexical.concepts.senses import sense_weight, usual_sense
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.grounding.lexical.matching.head_matching import HeadMatches, Match
from usd2kg.grounding.lexical.matching.routes import Route, Routes
from usd2kg.grounding.lexical.reading.noun_phrase import NameReader
from usd2kg.grounding.lexical.reading.word_kinds import AREAS
from usd2kg.grounding.lexical.settings import MATCHING, READING
from usd2kg.ontology import ClassIRI, TBox, load_home_tbox
from usd2kg.words import split_identifier

__all__ = ["TermMatcher"]

_NO_MATCHES = HeadMatches((), ())
_NAMED_BY_KIND = {
    TermKind.LABEL: "is the label of",
    TermKind.CURATED: "is in the alignment file a name for",
    TermKind.LISTED: "is in the list of usd2kg a name for",
    TermKind.MODEL: "is for the language model a name for",
}

_LISTED_KINDS = frozenset([TermKind.LISTED, TermKind.MODEL, TermKind.CURATED])
"""Terms that a list of what belongs to a class, or a person, names."""


class TermMatcher:
    """Matches nouns and compounds with the classes of one TBox."""

    def __init__(
        self, tbox: TBox, lexicon: Lexicon, taxonomy: Taxonomy, reader: NameReader, *, use_routes: bool = True
    ) -> None:
        """Create a matcher; `use_routes` is whether `Routes` ranks the classes of an ontology without home classes."""
        self._tbox = tbox
        self._lexicon = lexicon
        self._taxonomy = taxonomy
        self._reader = reader
        self._has_foreign = not lexicon.home_classes.issuperset(tbox.by_iri)
        is_foreign = lexicon.home_classes.isdisjoint(tbox.by_iri)
        self._routes = Routes(tbox, lexicon, taxonomy) if use_routes and is_foreign else None
        # Names repeat the same words.
        self._match_noun = lru_cache(maxsize=4096)(self._compute_noun)
        self._places_of_parents = lru_cache(maxsize=4096)(self._find_places_of_parents)
        self._rests_of_terms = lru_cache(maxsize=4096)(self._find_rests_of_terms)

    def is_subclass(self, special: ClassIRI, general: ClassIRI) -> bool:
        """Return whether a class is a subclass of another, or the same."""
        return self._tbox.is_subclass(special, general)

    def is_fallback(self, iri: ClassIRI | None) -> bool:
        """Return whether a class is the default class of a TBox with classes that the home TBox lacks."""
        return self._has_foreign and iri == self._lexicon.default_class

    def place_words(
        self, words: tuple[str, ...], context: tuple[str, ...], parents: tuple[str, ...]
    ) -> tuple[str, ...]:
        """Return the words of a name's context and of the names above that begin a term which ends like the name."""
        places = self._places_of_parents(parents) if parents else ()
        places = (*filter(self._begins_term, context), *places)
        if not places:
            return ()
        endings = (*words, *map(self._taxonomy.singular, words))
        return tuple(place for place in places if any(rest.endswith(endings) for rest in self._rests_of_terms(place)))

    def whole_words(self, words: tuple[str, ...], whole: tuple[str, ...]) -> tuple[str, ...]:
        """Return the last words of the name of a whole that form a term with the words of its part.

        An unknown word or an area may follow: a fork in the `diningArea` is a dining fork.
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
                if term is not None and " " in term.text and term.kind in {TermKind.LABEL, TermKind.SYNONYM}:
                    return whole[start:end]
        return ()

    def match(self, words: tuple[str, ...], places: tuple[str, ...]) -> HeadMatches:
        """Return the longest known compound that ends with the last word, and the classes that it may mean.

        Classes of the home vocabulary are ranked with a classifier of names, those of other ontologies by routes.
        """
        found = self._match_head(words, places)
        if not found.matches or self._is_curated(found.words):
            return found
        if self._routes is not None:
            return found._replace(matches=self._rank_by_routes(found))
        if not self._lexicon.home_classes.issuperset([match.class_iri for match in found.matches]):
            return found
        *modifiers, last = words
        head = self._taxonomy.singular(last)
        is_whole = len(found.words) > 1 or len(words) == 1
        if is_whole and "".join((*found.words[:-1], head)) in self._lexicon.terms:
            return found
        return found._replace(matches=self._mix_with_classifier((*modifiers, head), found.matches))

    def _is_curated(self, words: tuple[str, ...]) -> bool:
        """Return whether a model or a person chose the class of a noun, or a person that of its nearest hypernym."""
        *before, last = words
        key = "".join(before) + self._taxonomy.singular(last)
        term = self._lexicon.terms.get(key)
        if term is not None:
            return term.kind in _LISTED_KINDS
        if not self._lexicon.curated_synsets or (usual := usual_sense(key, self._taxonomy)) is None:
            return False
        nearest = self._nearest_class(usual.synset)
        return nearest is not None and nearest[0] in self._lexicon.curated_synsets

    def match_compound(self, words: tuple[str, str]) -> tuple[Match, ...]:
        """Return the classes of a compound of two words; none if it is not known as a compound."""
        if not self._has_foreign:
            return self._match_term(self._lexicon.terms.get("".join(words)))
        found = self.match(words, ())
        return found.matches if len(found.words) > 1 else ()

    def _mix_with_classifier(self, words: tuple[str, ...], matches: tuple[Match, ...]) -> tuple[Match, ...]:
        """Return the matches of a head noun mixed with the classifier's predictions for the whole name."""
        best = _best_by_class(matches)
        shares = {iri: share for iri, share in likely_classes(words) if iri in self._tbox.by_iri}
        weight = MATCHING.classifier_weight
        mixed = []
        for iri in dict.fromkeys([*best, *shares]):
            own = best.get(iri)
            score = (1 - weight) * (own.score if own else 0.0) + weight * MATCHING.term_score * shares.get(iri, 0.0)
            mixed.append(Match(iri, score, own.reason if own else partial(self._explain_classifier, words, iri)))
        return _sorted(mixed)

    def _rank_by_routes(self, found: HeadMatches) -> tuple[Match, ...]:
        """Return the matches ordered by the share of the routes to each class; the best keeps its score."""
        assert self._routes is not None
        ranked, matched = self._routes.rank(found.words), _best_by_class(found.matches)
        if _best_class(found.matches) not in ranked:
            # It is named after a place or lent by the home vocabulary.
            return found.matches
        first = min(ranked, key=lambda iri: (-ranked[iri][0], iri))
        if first in matched:
            highest = matched[first].score
        else:
            highest = MATCHING.noun_score if len(found.words) == 1 else MATCHING.compound_score
            highest *= MATCHING.general_factor if first in self._lexicon.general_classes else 1.0
        by_routes = [
            Match(
                iri,
                highest * (share / ranked[first][0]) ** MATCHING.share_power,
                matched[iri].reason if iri in matched else self._route_reason(route),
                is_listed=matched[iri].is_listed if iri in matched else self._is_listed_route(route),
            )
            for iri, (share, route) in ranked.items()
        ]
        return _sorted([*by_routes, *(match for iri, match in matched.items() if iri not in ranked)])

    def _is_listed_route(self, route: Route) -> bool:
        if isinstance(route.origin, Term):
            return route.origin.kind in _LISTED_KINDS
        return self._is_listed(route.origin[1], route.origin[2])

    def _is_listed(self, synset: int, aligned: AlignedClass) -> bool:
        """Return whether a list, or a person, put a synset in a class."""
        is_decided = synset in self._lexicon.listed_synsets or synset in self._lexicon.curated_synsets
        return is_decided and self._lexicon.sense_classes.get(synset) == aligned

    def _route_reason(self, route: Route) -> Callable[[], str]:
        if isinstance(route.origin, Term):
            return partial(self._explain_term, route.origin)
        return partial(self._explain_hypernym, *route.origin)

    def _match_head(self, words: tuple[str, ...], places: tuple[str, ...]) -> HeadMatches:
        """Return the longest known compound at the end of some words, and its matches by terms and hypernyms."""
        *before, last = words
        singular = self._taxonomy.singular(last)
        starts = range(len(before) if self._reader.kinds.is_modifier(last) else len(words))
        keys = {start: "".join(before[start:]) + singular for start in starts}
        return self._match_longest(words, keys, places)

    def _match_longest(self, words: tuple[str, ...], keys: Mapping[int, str], places: tuple[str, ...]) -> HeadMatches:
        """Return the longest known compound and its matches.

        A shorter one wins if its class is more specific: a sofa cushion is an artifact in the home vocabulary, but a
        cushion where the ontology has a class of cushions.

        Args:
            words: the words, the head noun last.
            keys: index of the first word → key of the compound from there, longest first.
            places: words of the names above.
        """
        longest, is_term = _NO_MATCHES, False
        for start, key in keys.items():
            if key not in self._lexicon.terms and key not in self._taxonomy:
                continue
            matches = self._match_noun(key, words[-1], start < len(words) - 1, places)
            if not longest.matches:
                longest, is_term = HeadMatches(words[start:], matches), key in self._lexicon.terms
            elif matches and self._is_more_specific(_best_class(matches), _best_class(longest.matches)):
                return HeadMatches(words[start:], matches)
            if longest.matches and is_term and not self._is_general_home_class(_best_class(longest.matches)):
                break
        return longest if longest.matches else _NO_MATCHES

    def _compute_noun(self, key: str, head: str, is_compound: bool, places: tuple[str, ...]) -> tuple[Match, ...]:
        by_hypernym = tuple(self._match_hypernyms(key, is_compound))
        by_term = self._match_term(self._lexicon.terms.get(key))
        if by_term and by_term[0].score < MATCHING.term_score:
            # A synonym yields to a more specific foreign class that is aligned with a hypernym of the noun.
            specific = (match.class_iri for match in by_hypernym)
            if any(self._is_more_specific(iri, by_term[0].class_iri) for iri in specific):
                by_term = ()
        matches = (*by_term, *by_hypernym)
        return (*self._match_in_place(key, head, matches, places), *matches) if matches else ()

    def _is_more_specific(self, foreign: ClassIRI, home: ClassIRI) -> bool:
        """Return whether a class that the home TBox lacks is more specific than a class of the home TBox.

        A subclass is. Any class but a superclass counts as more specific than a general home class: the other ontology
        may have a class for artifacts that have none of their own in the home TBox.
        """
        if home not in self._lexicon.home_classes or foreign in self._lexicon.home_classes:
            return False
        return self._tbox.is_subclass(foreign, home) or (
            self._is_general_home_class(home) and foreign not in self._tbox.closure(home)
        )

    def _is_general_home_class(self, iri: ClassIRI) -> bool:
        """Return whether a class of a mixed TBox is one of the home TBox with subclasses there."""
        return self._has_foreign and iri in self._lexicon.home_classes and bool(load_home_tbox().children[iri])

    def _match_term(self, term: Term | None) -> tuple[Match, ...]:
        if term is None:
            return ()
        score = MATCHING.term_score * term.kind.weight
        is_listed = term.kind in _LISTED_KINDS
        return (Match(term.class_iri, score, partial(self._explain_term, term), is_listed=is_listed),)

    def _match_in_place(
        self, key: str, head: str, matches: tuple[Match, ...], places: tuple[str, ...]
    ) -> Iterator[Match]:
        """Yield the subclass named after a place: a cabinet in the kitchen is a kitchen cabinet.

        A noun that is the label of a class is understood without the place.
        """
        term = self._lexicon.terms.get(key)
        if term is not None and term.kind is TermKind.LABEL:
            return
        found = {match.class_iri for match in matches}
        for place in places:
            special = self._lexicon.terms.get(place + key) or self._lexicon.terms.get(place + head)
            if special is None or special.class_iri in found or special.class_iri in self._lexicon.general_classes:
                continue
            if any(self._tbox.is_subclass(special.class_iri, iri) for iri in found):
                score = MATCHING.term_score * special.kind.weight * MATCHING.place_factor
                yield Match(special.class_iri, score, partial(self._explain_place, key, place, special))
                return

    def _match_hypernyms(self, key: str, is_compound: bool) -> Iterator[Match]:
        """Yield for each sense of a noun the class of its nearest aligned hypernym."""
        if len(key) < READING.min_noun_letters and not _is_short_home_name(key):
            return
        usual = usual_sense(key, self._taxonomy)
        nearest = None if usual is None else self._nearest_class(usual.synset)
        lacks_usual = nearest is not None and nearest[2].class_iri == self._lexicon.default_class
        for sense in self._taxonomy.senses(key):
            found = self._nearest_class(sense.synset)
            if found is None:
                continue
            hypernym, steps, aligned = found
            weight = sense_weight(sense)
            score = (MATCHING.compound_score if is_compound else MATCHING.noun_score) * aligned.weight
            is_label = self._has_foreign and steps == 0 and aligned.weight == 1.0
            if not (is_label and weight >= MATCHING.min_label_sense_weight):
                # If the TBox lacks the usual sense, do not fall back to a rarer one.
                is_rarer = lacks_usual and sense is not usual
                score *= weight * (MATCHING.general_factor if is_rarer else 1.0)
            if aligned.class_iri in self._lexicon.general_classes:
                # A near match with a root is weaker evidence than a distant match: a noun far below the root probably
                # has no class of its own.
                decay = MATCHING.step_decay ** max(0, MATCHING.root_steps - steps)
                score *= MATCHING.general_factor * decay
            else:
                score *= MATCHING.step_decay**steps
            reason = partial(self._explain_hypernym, sense.synset, hypernym, aligned)
            yield Match(aligned.class_iri, score, reason, is_listed=self._is_listed(hypernym, aligned))

    def _nearest_class(self, synset: int) -> tuple[int, int, AlignedClass] | None:
        """Return the nearest aligned hypernym, its steps and its class.

        In a TBox with classes that the home TBox lacks, a more distant hypernym wins if its class is a subclass: a
        teddy bear is an artifact in the home vocabulary, and the ontology may have a class of toys below artifacts. Of
        hypernyms at the same distance the one with the deepest class wins: a range hood is a kitchen appliance rather
        than a covering.
        """
        nearest: tuple[int, int, AlignedClass] | None = None
        excluded: frozenset[ClassIRI] = frozenset()
        for up, steps in self._taxonomy.walk_up(synset):
            aligned = self._lexicon.sense_classes.get(up)
            excluded |= self._lexicon.excluded_classes.get(up, frozenset())
            if (
                aligned is None
                or aligned.class_iri in excluded
                or (nearest is not None and aligned.class_iri == self._lexicon.default_class)
            ):
                continue
            if nearest is None or self._is_preferred(aligned, steps, nearest):
                nearest = up, steps, aligned
            if not self._has_foreign:
                break
        return nearest

    def _is_preferred(self, aligned: AlignedClass, steps: int, nearest: tuple[int, int, AlignedClass]) -> bool:
        iri, other = aligned.class_iri, nearest[2].class_iri
        is_deeper = steps == nearest[1] and len(self._tbox.closure(iri)) > len(self._tbox.closure(other))
        return is_deeper or self._is_strict_subclass(iri, other)

    def _is_strict_subclass(self, iri: ClassIRI, other: ClassIRI) -> bool:
        return iri != other and self._tbox.is_subclass(iri, other)

    def _find_places_of_parents(self, parents: tuple[str, ...]) -> tuple[str, ...]:
        words = (word.lower() for parent in reversed(parents) for word in split_identifier(parent))
        return tuple(filter(self._begins_term, words))

    def _begins_term(self, word: str) -> bool:
        return bool(self._rests_of_terms(word))

    def _find_rests_of_terms(self, word: str) -> tuple[str, ...]:
        """Return what follows a word in each term that begins with it."""
        keys = self._term_keys
        start, end = bisect_left(keys, word), bisect_left(keys, word + chr(sys.maxunicode))
        return tuple(key.removeprefix(word) for key in keys[start:end])

    @cached_property
    def _term_keys(self) -> list[str]:
        return sorted(self._lexicon.terms)

    def _explain_classifier(self, words: tuple[str, ...], iri: ClassIRI) -> str:
        similar = similar_name(words, iri)
        example = f", like “{similar}”," if similar else ""
        return f"a name like “{' '.join(words)}”{example} usually means {self._label(iri)}"

    def _explain_term(self, term: Term) -> str:
        return f"“{term.text}” {_NAMED_BY_KIND.get(term.kind, 'is a name for')} {self._label(term.class_iri)}"

    def _explain_place(self, key: str, place: str, special: Term) -> str:
        return f"a “{key}” in “{place}” is a {special.text}, which is {self._label(special.class_iri)}"

    def _explain_hypernym(self, synset: int, hypernym: int, aligned: AlignedClass) -> str:
        names = [self._taxonomy.name(step) for step in self._taxonomy.path_up(synset, hypernym)]
        chain = names if len(names) <= 4 else [*names[:2], "…", names[-1]]
        kinds = " is a kind of ".join(f"“{name}”" if name != "…" else name for name in chain)
        is_aligned = self._lexicon.sense_classes.get(hypernym) == aligned
        if hypernym in self._lexicon.curated_synsets:
            return f"{kinds}, which the alignment file puts in {self._label(aligned.class_iri)}"
        link = ", which is" if is_aligned else " counts as" if len(chain) == 1 else ", which counts as"
        return f"{kinds}{link} {self._label(aligned.class_iri)}"

    def _label(self, class_iri: ClassIRI) -> str:
        return self._tbox.by_iri[class_iri].readable_name


def _best_class(matches: tuple[Match, ...]) -> ClassIRI:
    return max(matches, key=lambda match: match.score).class_iri


def _best_by_class(matches: tuple[Match, ...]) -> dict[ClassIRI, Match]:
    return {match.class_iri: match for match in sorted(matches, key=lambda match: match.score)}


def _sorted(matches: list[Match]) -> tuple[Match, ...]:
    return tuple(sorted(matches, key=lambda match: (-match.score, match.class_iri)))


def _is_short_home_name(key: str) -> bool:
    return key in home_words().short_names
