"""The default grounder: no network, no key, no GPU.

A name is read as a noun phrase; the TBox's terms, then the taxonomy of nouns, say which class it names. Where the
name says nothing, other evidence speaks: asset, documentation, parts, and at last the company the object keeps.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property, lru_cache, partial

import numpy as np

from usd2kg.garbage import paused_collection
from usd2kg.grounding.context.neighbours import Companion, Company, Nearness
from usd2kg.grounding.context.placement import Neighbour
from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.lexical.alignment.lexicon import build_lexicon, home_names
from usd2kg.grounding.lexical.alignment.matching import Matcher
from usd2kg.grounding.lexical.alignment.naming import Match
from usd2kg.grounding.lexical.alignment.residual_class import is_residual
from usd2kg.grounding.lexical.class_choice import agree_by_asset, safest_class
from usd2kg.grounding.lexical.concepts.object_likelihoods import (
    NO_BELIEFS,
    Beliefs,
    ThingBeliefs,
    log_likelihoods_of_look,
    neighbour_weights,
)
from usd2kg.grounding.lexical.concepts.places import (
    PLACE_TEXTS,
    PLACES,
    Floats,
    Stance,
    log_stances,
    place_of_look,
    place_of_thing,
    place_shares,
    places_named,
    stance_of,
)
from usd2kg.grounding.lexical.concepts.sizes import Size, likelihoods_of, rounded
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.confidence import features_of, general_odds, probability
from usd2kg.grounding.lexical.evidence_combination import Finding, weigh
from usd2kg.grounding.lexical.neighbour_vote import Vote, ask_company, siblings_as_company, vote_of
from usd2kg.grounding.lexical.reading.abbreviations import AbbreviationReader, Reading
from usd2kg.grounding.lexical.reading.english_words import SHORTEST_WORD, is_english_word
from usd2kg.grounding.lexical.reading.evidence_texts import is_made_up, texts_of
from usd2kg.grounding.lexical.reading.noun_phrase import NameReader
from usd2kg.grounding.lexical.reading.shortening import may_be_short
from usd2kg.grounding.model import Candidate, Prediction, Status
from usd2kg.languages import translate
from usd2kg.ontology import ClassIRI, OntologyClass, TBox
from usd2kg.words import is_telling, split_identifier

__all__ = ["LexicalGrounder"]

_SHARES = {"name": 1.0, "asset": 0.9, "documentation": 0.8, "hierarchy": 0.55, "labels": 0.9, "parts": 0.35}
"""How far each source of words is trusted, as a share of what the name would be."""
_SOURCES = {
    "asset": "asset",
    "documentation": "documentation",
    "hierarchy": "group",
    "labels": "label",
    "parts": "parts",
}
_CLEAR = 0.6
"""A name that scores this is believed before other evidence is asked."""
_MOST_TOKENS = 5
_SHORTEST_NOUN = 3
"""The SS of `tblspn_ss` is no noun, though a dictionary may have it."""
_SAME_SIZE = 0.03
_MOST_NEIGHBOURS = 48
_SIBLING_METRES = 4.0
"""How far away a sibling is taken to be of which only the name is known."""
_NEARNESS_TEXTS = {
    Nearness.NEXT: "right beside it",
    Nearness.SIBLING: "in the same group",
    Nearness.TWIN: "of the same size",
    Nearness.ALIKE: "of about the same size",
}
_OF_OTHERS = frozenset(["company", "geometry"])
"""The evidence that is not about the object itself, or about its size alone."""
_BELIEVED, _UNLIKELY = 0.6, 0.02
"""Of the readings of a name with unknown words: one that is heeded, and one that is not asked what it names."""
_UNREAD = 0.2
"""The weight of a reading of an abbreviation that names no class: it may be right all the same."""
_UNKNOWN = 0.12
_DEFAULT = 0.1
_CANDIDATES = 8
_NO_CLASS = "no class of the ontology"
_ALL_ELSE = f"urn:usd2kg:{_NO_CLASS}"
"""IRI of the class that stands for having none; it is never an answer."""


class LexicalGrounder:
    """Grounds by the words of names, a noun taxonomy and the company an object keeps."""

    name = "lexical"
    is_calibrated = True

    def __init__(self, *, use_home_synonyms: bool = True, abstains: bool = False) -> None:
        """Make the grounder.

        Args:
            use_home_synonyms: also use the synonyms of the built-in home TBox, for classes with the same IRI.
            abstains: take the class above, where the candidates are split; better by hierarchical F1, and less often
                exactly right.
        """
        self._use_home_synonyms = use_home_synonyms
        self._abstains = abstains

    @property
    def settings(self) -> Mapping[str, str]:
        """The settings that its answers depend on."""
        return {
            "home_synonyms": str(self._use_home_synonyms).lower(),
            **({"decision": "hierarchical"} if self._abstains else {}),
        }

    def ground_views(self, views: Sequence[tuple[str, ObjectView]], tbox: TBox) -> list[Prediction]:
        """Return one prediction for each (prim path, view)."""
        with paused_collection():
            answers = self.decide(views, tbox)
            general = self.general_classes(tbox)
            odds = general_odds((answer for answer, _ in answers), general)
            decided = [
                replace(answer, confidence=probability(features_of(answer, look, tbox, general, odds)))
                if answer.class_iri is not None
                else answer
                for answer, look in answers
            ]
            return agree_by_asset([view for _, view in views], decided, tbox)

    def general_classes(self, tbox: TBox) -> frozenset[ClassIRI]:
        """Return the classes of which little is said by saying that something is of them."""
        return _run_for(tbox, self._use_home_synonyms).general

    def decide(self, views: Sequence[tuple[str, ObjectView]], tbox: TBox) -> list[tuple[Prediction, Beliefs]]:
        """Return for each (prim path, view) a prediction with a score for confidence, and what its look says."""
        run = _run_for(tbox, self._use_home_synonyms)
        answers = [run.predict(path, view) for path, view in views]
        return [(_abstaining(answer, tbox), look) for answer, look in answers] if self._abstains else answers


def _abstaining(prediction: Prediction, tbox: TBox) -> Prediction:
    """Return the prediction with the class above its candidates, where that is the safer answer."""
    if prediction.class_iri is None:
        return prediction
    iri = safest_class({candidate.class_iri: candidate.score for candidate in prediction.candidates}, tbox)
    if iri == prediction.class_iri:
        return prediction
    names = ", ".join(tbox.by_iri[candidate.class_iri].readable_name for candidate in prediction.candidates[:3])
    explanation = f"{prediction.explanation}; {tbox.by_iri[iri].readable_name} is safer than any of {names}"
    return replace(prediction, class_iri=iri, status=Status.SUPERCLASS, explanation=explanation)


@lru_cache(maxsize=4)
def _run_for(tbox: TBox, use_home_synonyms: bool) -> "_Run":
    """Return the run of a TBox; what it remembers depends on the TBox alone, so that it serves many scenes."""
    return _Run(tbox, home_names() if use_home_synonyms else {})


def _below_one_root(tbox: TBox, root: OntologyClass) -> TBox:
    """Return the TBox with a class, which may be none of its own, above all others without one above."""
    others = [cls for cls in tbox.classes if cls.iri != root.iri]
    classes = [cls if cls.parents else replace(cls, parents=(root.iri,)) for cls in others]
    return replace(tbox, classes=tuple(sorted([*classes, root], key=lambda cls: cls.iri)))


class _Run:
    """One TBox's lexicon and matcher; remembers what names mean, which depends on nothing else."""

    def __init__(self, tbox: TBox, synonyms: Mapping[ClassIRI, tuple[str, ...]]) -> None:
        taxonomy = load_taxonomy()
        self._lexicon = build_lexicon(tbox, taxonomy, synonyms)
        default = self._lexicon.default
        if default is None:
            is_home = self._lexicon.listed.issuperset(tbox.by_iri)
            root = OntologyClass(_ALL_ELSE, label=_NO_CLASS, alt_labels=(), comment="", parents=())
            # Among classes of the home TBox alone it is no other ontology's.
            synonyms = {**synonyms, _ALL_ELSE: (_NO_CLASS,)} if is_home else synonyms
            tbox = _below_one_root(tbox, root)
            self._lexicon = build_lexicon(tbox, taxonomy, synonyms)
        elif len(tbox.roots) > 1 and default in tbox.roots and is_residual(tbox.by_iri[default], taxonomy):
            # In a list of labels chairs and tables are beside the rest of all things.
            tbox = _below_one_root(tbox, tbox.by_iri[default])
            self._lexicon = build_lexicon(tbox, taxonomy, synonyms)
        self.tbox = tbox
        """With the class of all else above the others, where none of its own is true of most things."""
        self.general = self._lexicon.general
        self._reader = NameReader(self._lexicon, taxonomy)
        self._matcher = Matcher(tbox, self._lexicon, taxonomy, self._reader)
        self._match = lru_cache(maxsize=8192)(self._match_text)
        # Copies of one model look the same and stand alike.
        self._looks = lru_cache(maxsize=8192)(self._believe_look)
        self._vote, self._place = self._voting, self._placing
        """One object each for all scenes, which remember what they were told by it."""

    @cached_property
    def _beliefs(self) -> ThingBeliefs:
        return ThingBeliefs(self._match)

    @cached_property
    def _abbreviations(self) -> AbbreviationReader:
        # Most stages spell their names out and never need it.
        return AbbreviationReader(self._lexicon, load_taxonomy())

    def predict(self, prim_path: str, view: ObjectView) -> tuple[Prediction, Beliefs]:
        """Return the class of a view, with a score for confidence, and what it looks like whatever it is called."""
        look = self._look(view)
        is_nameless = is_made_up(view.name)
        findings = [] if view.is_masked else self._by_words(replace(view, name="") if is_nameless else view)
        if findings and findings[0].score >= _CLEAR and findings[0].group == "name":
            findings = self._completed(view, findings)
        spelled_out = findings[0].score if findings else 0.0
        if not findings or findings[0].score < _CLEAR:
            # A tulip that is no class of the TBox is none of the things beside it either.
            is_understood = not (findings or view.is_masked or is_nameless) and self._says_what_it_is(view.name)
            short = [] if is_nameless or is_understood else self._by_abbreviation(view)
            findings = [] if is_understood else self._weigh(view, [*findings, *short])
        if not findings or max(findings[0].score, spelled_out) < _UNKNOWN:
            return self._default(prim_path, "what is known about it does not say what it is"), look
        best = findings[0]
        if best.class_iri == _ALL_ELSE:
            return _refusal(prim_path, best.explain()), look
        if best.group in _OF_OTHERS and self._matcher.is_fallback(best.class_iri):
            # Two things of which nothing is known do not vouch for each other.
            return self._default(prim_path, best.explain()), look
        scores = {found.class_iri: found.score for found in reversed(findings) if found.class_iri != _ALL_ELSE}
        candidates = sorted(scores.items(), key=lambda candidate: (-candidate[1], candidate[0]))
        prediction = Prediction(
            prim_path=prim_path,
            class_iri=best.class_iri,
            confidence=round(best.score, 4),
            status=Status.GROUNDED,
            grounder=LexicalGrounder.name,
            explanation=best.explain(),
            evidence=(best.group,),
            candidates=tuple(Candidate(iri, score) for iri, score in candidates[:_CANDIDATES]),
        )
        return prediction, look

    def _look(self, view: ObjectView) -> Beliefs:
        """Return what an object is believed to be by its size and how it stands, and by where the names above say."""
        look = view.look
        if look is None:
            return NO_BELIEFS
        return self._looks(rounded(look.size), stance_of(look), places_named(view.parents))

    def _weigh(self, view: ObjectView, words: list[Finding]) -> list[Finding]:
        beliefs = self._believe(view)
        return weigh(
            words,
            self._by_company(view),
            beliefs.ranked(),
            partial(self._belief_text, view, beliefs.place),
            is_masked=view.is_masked,
        )

    def _believe(self, view: ObjectView) -> Beliefs:
        """Return what an object is believed to be by its size, how it stands and what is around it."""
        if view.look is None:
            return NO_BELIEFS
        return self._beliefs.ask(
            log_likelihoods_of_look(view.look), place_shares(self._place_around(view), places_named(view.parents))
        )

    def _believe_look(self, size: Size, stance: Stance, named: tuple[str, ...]) -> Beliefs:
        logs = likelihoods_of(size) + log_stances(stance)
        return self._beliefs.ask(logs, place_shares(np.zeros(len(PLACES)), named))

    def _place_around(self, view: ObjectView) -> Floats:
        """Return the logarithm of how likely the objects around it are in each kind of place."""
        if view.standing is not None:
            told, metres = view.standing.around(self._place, _MOST_NEIGHBOURS)
            return neighbour_weights(metres) @ told if len(told) else np.zeros(len(PLACES))
        siblings = [self._thing_place(name, view.parents) for name in view.siblings[:_MOST_NEIGHBOURS]]
        return sum(siblings, start=np.zeros(len(PLACES))) * neighbour_weights(_SIBLING_METRES)

    def _belief_text(self, view: ObjectView, place: str | None, iri: ClassIRI) -> str:
        elevation = view.look.elevation if view.look is not None else None
        where = "" if elevation is None else f", {elevation:.1f} m above the ground"
        among = f", in what seems {PLACE_TEXTS[place]}" if place else ""
        return (
            f"its name does not say; of its size{where}{among}, it is likeliest {self.tbox.by_iri[iri].readable_name}"
        )

    def _by_abbreviation(self, view: ObjectView) -> list[Finding]:
        """Return what the name says if it is an abbreviation."""
        tokens = [part.lower() for part in split_identifier(view.name) if part.isalpha()]
        tokens = [token for token in tokens if is_telling(token)][:_MOST_TOKENS]
        if not tokens or (not view.is_masked and self._is_spelled_out(tokens)):
            return []
        spelled = {token for token in tokens if len(token) >= SHORTEST_WORD and self._is_word(token)}
        return self._of_readings(view, self._abbreviations.read(tokens, view.company, spelled, _parent_of(view)))

    def _is_spelled_out(self, tokens: Sequence[str]) -> bool:
        """Return whether the words of a name are all known, or are a name in another language."""
        return all(map(self._is_word, tokens)) or translate(tuple(tokens)) is not None

    def _is_word(self, word: str) -> bool:
        return self._reader.kinds.is_known(word) or is_english_word(word)

    def _completed(self, view: ObjectView, said: list[Finding]) -> list[Finding]:
        """Return what the name says where words of it are unknown and likely abbreviations: the blade of a `fan_bld`.

        Args:
            view: the object.
            said: what the name says without those words, returned as it is where they are likelier none.
        """
        matches = self._match(view.name, view.parents, view.own_size)
        words = matches[0].phrase.words[-_MOST_TOKENS:] if matches else ()
        spelled = {word for word in words if self._is_word(word) or not may_be_short(word)}
        if spelled.issuperset(words):
            return said
        readings = self._abbreviations.read(words, view.company, spelled, _parent_of(view))
        if not readings or readings[0].probability < _BELIEVED or spelled.issuperset(readings[0].words):
            return said
        rest = 1 - readings[0].probability
        findings = [
            *self._of_readings(view, [found for found in readings if found.probability > _UNLIKELY]),
            *(finding._replace(score=rest * finding.score) for finding in said),
        ]
        return sorted(findings, key=lambda finding: (-finding.score, finding.class_iri))

    def _of_readings(self, view: ObjectView, readings: Sequence[Reading]) -> list[Finding]:
        """Return what the readings of a name say."""
        shares: dict[ClassIRI, float] = {}
        best: dict[ClassIRI, tuple[float, Reading, Match]] = {}
        # What is left of the probability is that it is no word at all.
        total = _UNREAD * (1 - sum(reading.probability for reading in readings))
        for reading in readings:
            matches, weight = self._matcher.weigh(self._reader.phrase(reading.words), view.parents, view.own_size)
            likelihood = reading.probability * max(weight, _UNREAD)
            total += likelihood
            if matches:
                iri, share = matches[0].class_iri, likelihood * matches[0].score
                shares[iri] = shares.get(iri, 0.0) + share
                if iri not in best or best[iri][0] < share:
                    best[iri] = share, reading, matches[0]
        explain = {iri: partial(_short_text, view.name, reading, match) for iri, (_, reading, match) in best.items()}
        return [Finding("name", iri, share / total, explain[iri]) for iri, share in shares.items()]

    def _by_words(self, view: ObjectView) -> list[Finding]:
        """Return what the words say, best first; other sources are asked only if the name is not clear."""
        findings: list[Finding] = []
        for group, text in texts_of(view):
            if group in {"hierarchy", "parts"} and self._says_what_it_is(view.name):
                # A tulip is no class of the TBox; that it has a stem does not make it a tube.
                break
            is_name = group == "name"
            for match in self._match(text, view.parents if is_name else (), view.own_size if is_name else None):
                explain = partial(_match_text, match, group)
                findings.append(Finding(group, match.class_iri, match.score * _SHARES[group], explain))
            findings.sort(key=lambda finding: (-finding.score, finding.class_iri))
            if findings and findings[0].score >= _CLEAR:
                break
        return findings

    def _says_what_it_is(self, name: str) -> bool:
        words = self._reader.read(name).words
        if not words or len(words[-1]) < _SHORTEST_NOUN:
            return False
        return not self._reader.kinds.is_modifier(words[-1]) and self._reader.kinds.is_noun(words[-1])

    def _match_text(
        self, text: str, parents: tuple[str, ...], size: tuple[float, float, float] | None = None
    ) -> tuple[Match, ...]:
        return tuple(self._matcher.match(self._reader.read(text, parents), parents, size))

    def _voting(self, name: str, parents: tuple[str, ...], size: Size | None) -> Vote | None:
        return None if is_made_up(name) else vote_of(self._match(name, parents, size))

    def _placing(self, neighbour: Neighbour) -> Floats:
        """Return the logarithm of how likely a thing is in each kind of place, by its name or else by its look."""
        by_name = self._thing_place(neighbour.name, neighbour.parents)
        return by_name if by_name.any() else place_of_look(log_likelihoods_of_look(neighbour.look))

    def _thing_place(self, name: str, parents: tuple[str, ...]) -> Floats:
        row = None if is_made_up(name) else self._matcher.thing(self._reader.read(name, parents))
        return np.zeros(len(PLACES)) if row is None else place_of_thing(row)

    def _by_company(self, view: ObjectView) -> list[Finding]:
        """Return the classes of the things beside it and of its size, by their share."""
        if view.company is not None:
            return self._by_companions(view.company)
        siblings = siblings_as_company(view.siblings, view.parents)
        told = ((self._vote(found.name, found.parents, found.size), found) for found in siblings)
        votes = ask_company((vote, found.nearness, found.distance, found) for vote, found in told if vote is not None)
        return [
            Finding("hierarchy", iri, share, partial(self._company_text, iri, votes.heaviest[iri][-1]))
            for iri, share in votes.shares.items()
        ]

    def _by_companions(self, company: Company) -> list[Finding]:
        votes = ask_company(company.judged(self._vote))

        def explain(iri: ClassIRI) -> str:
            _, nearness, distance, other = votes.heaviest[iri]
            return self._company_text(iri, company.companion(other, nearness, distance))

        return [Finding("company", iri, share, partial(explain, iri)) for iri, share in votes.shares.items()]

    def _company_text(self, iri: ClassIRI, companion: Companion) -> str:
        where = _NEARNESS_TEXTS[companion.nearness]
        alike = companion.distance is not None and companion.distance < _SAME_SIZE
        is_told = companion.nearness in {Nearness.TWIN, Nearness.ALIKE}
        size = ", of the same size," if alike and not is_told else ""
        return f"“{companion.name}” {where}{size} is {self.tbox.by_iri[iri].readable_name}"

    def _default(self, prim_path: str, reason: str) -> Prediction:
        iri = self._lexicon.default
        if iri is None or iri == _ALL_ELSE:
            return _refusal(prim_path, f"{reason}; {_NO_CLASS} is true of most things")
        return Prediction(
            prim_path=prim_path,
            class_iri=iri,
            confidence=_DEFAULT,
            status=Status.SUPERCLASS,
            grounder=LexicalGrounder.name,
            explanation=f"{reason}; {self.tbox.by_iri[iri].readable_name} is true of most things",
            candidates=(Candidate(iri, _DEFAULT),),
        )


def _parent_of(view: ObjectView) -> str:
    return view.parents[-1] if view.parents else ""


def _refusal(prim_path: str, explanation: str) -> Prediction:
    return Prediction(prim_path, None, None, Status.REFUSED, LexicalGrounder.name, explanation)


def _match_text(match: Match, group: str) -> str:
    return match.explanation if group == "name" else f"{match.explanation} (from its {_SOURCES[group]})"


def _short_text(name: str, reading: Reading, match: Match) -> str:
    return f"“{name}” may be short for “{' '.join(reading.words)}”: {match.explanation}"
