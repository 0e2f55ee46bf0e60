"""Ground one object: score classes by its name, then by other evidence, and choose the class with the best score."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from functools import lru_cache, partial
from typing import TYPE_CHECKING, Any, NamedTuple

from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.lexical.alignment.artificial_root import NO_CLASS, NO_CLASS_IRI, with_root
from usd2kg.grounding.lexical.alignment.lexicon import Lexicon
from usd2kg.grounding.lexical.alignment.lexicon_json import lexicon_as_json, lexicon_of_json
from usd2kg.grounding.lexical.alignment.terms import TermKind
from usd2kg.grounding.lexical.candidate_evidence import CandidateEvidence, weigh_candidates
from usd2kg.grounding.lexical.class_posterior import NO_POSTERIOR, ClassPosterior
from usd2kg.grounding.lexical.concepts.categories import invert_categories
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy, load_taxonomy
from usd2kg.grounding.lexical.context_evidence import AppearanceKey, ContextEvidence, Surroundings
from usd2kg.grounding.lexical.evidence_combination import CONTEXT_GROUPS, ScoredClass, combine_evidence
from usd2kg.grounding.lexical.matching.head_matching import ClassRanker
from usd2kg.grounding.lexical.matching.kind_ranking import KindRanker
from usd2kg.grounding.lexical.matching.phrase_matching import PhraseMatcher
from usd2kg.grounding.lexical.matching.similar_members import SimilarMembers
from usd2kg.grounding.lexical.matching.term_matching import TermMatcher
from usd2kg.grounding.lexical.name_evidence import NameEvidence
from usd2kg.grounding.lexical.reading.evidence_texts import is_generated_name
from usd2kg.grounding.lexical.reading.noun_phrase import NameReader
from usd2kg.grounding.lexical.reading.object_words import ObjectWords
from usd2kg.grounding.lexical.reading.shared_prefix import view_without_prefix
from usd2kg.grounding.lexical.scored_view import ScoredView
from usd2kg.grounding.lexical.settings import EVIDENCE
from usd2kg.grounding.model import Candidate, Prediction, Status
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.table_cache import NO_CACHE, TableCache

if TYPE_CHECKING:
    from usd2kg.grounding.lexical.alignment.alignment_file import AlignmentFile
    from usd2kg.grounding.lexical.alignment.alignment_rows import AlignmentRow
    from usd2kg.grounding.lexical.alignment.built_alignment import BuiltAlignment

__all__ = ["ObjectGrounder"]

_GROUNDER = "lexical"


class _WordScores(NamedTuple):
    """The classes of one object by its words."""

    words: tuple[ObjectWords, bool] | None
    """The words, and whether they are made for the stage; None if the naming regime masks the name."""
    scored: list[ScoredClass]
    """Best first, those of abbreviations last."""
    best_score: float
    """The best score of spelled-out words."""
    is_enough: bool = False
    """Whether no other evidence is needed."""
    has_abbreviations: bool = False


class ObjectGrounder:
    """Grounds single objects to the classes of one TBox."""

    def __init__(
        self,
        tbox: TBox,
        synonyms: Callable[[], Mapping[ClassIRI, tuple[str, ...]]],
        alignment: "AlignmentFile | None" = None,
        *,
        use_member_lists: bool = True,
        tables: TableCache = NO_CACHE,
    ) -> None:
        """Build or read the lexicon of a TBox.

        Args:
            tbox: the candidate classes.
            synonyms: returns further terms by class IRI.
            alignment: an edited alignment; None to use the one that is built.
            use_member_lists: whether the lists that usd2kg ships for public ontologies count.
            tables: the tables of an earlier process for the same arguments.

        Raises:
            GroundingError: the alignment is invalid, or for another ontology.
        """
        taxonomy = self._taxonomy = load_taxonomy()
        self._build = partial(_build, tbox, taxonomy, synonyms, alignment, use_lists=use_member_lists)
        self._tbox, self._lexicon = tables.get(
            "lexicon",
            lambda found: _rooted_of_json(found, tbox, taxonomy),
            lambda: _edited(self._build(), taxonomy),
            lambda rooted: lexicon_as_json(rooted[1]),
        )
        self.general_classes = self._lexicon.general_classes
        """The roots, and the default class."""
        self.reader = NameReader(self._lexicon, taxonomy)
        terms = TermMatcher(self._tbox, self._lexicon, taxonomy, self.reader)
        self.matcher = PhraseMatcher(terms, taxonomy, self.reader)
        self._is_fallback = terms.is_fallback
        ranker = self._class_ranker(tables)
        self._words = NameEvidence(self._tbox, self._lexicon, taxonomy, self.reader, self.matcher, ranker)
        self._context = ContextEvidence(self._tbox, self._words, self.reader, self.matcher, tables)
        # Copies of one model have the same words and size; they differ in their neighbours, which clear words ignore.
        self._predict_by_words = lru_cache(maxsize=1024)(self._predict_clear)
        self._predict_in_place = lru_cache(maxsize=1024)(self._predict_without_neighbours)
        self._predict_copy = lru_cache(maxsize=1024)(self._predict_looking_alike)

    def _class_ranker(self, tables: TableCache) -> ClassRanker | None:
        """Return what ranks the classes of whole names; None if the head noun is enough.

        That is so if the ontology has home classes, if usd2kg ships lists of what belongs to its classes, and if no
        class applies to most objects, since no ranking can then say that an object has none.
        """
        terms = self._lexicon.terms.values()
        kinds = {term.kind for term in terms}
        if TermKind.MODEL in kinds:
            known = [term for term in terms if term.class_iri in self._tbox.by_iri]
            return SimilarMembers(known, self._taxonomy, self._tbox)
        is_prepared = TermKind.LISTED in kinds or not self._lexicon.home_classes.isdisjoint(self._tbox.by_iri)
        if is_prepared or self._lexicon.default_class in {None, NO_CLASS_IRI}:
            return None
        names = tables.get("kinds", _kinds_of_json, partial(invert_categories, self._taxonomy), dict)
        return KindRanker(
            self._tbox, self._lexicon, self._taxonomy, self.reader, self.matcher, partial(_kinds_in, names)
        )

    def format_alignment(self, others: "Iterable[AlignmentRow]" = ()) -> str:
        """Return the alignment of the classes with concepts and terms, and other rows, as SSSOM/TSV."""
        from usd2kg.grounding.lexical.alignment.alignment_file import format_alignment  # noqa: PLC0415

        built = self._build()
        return format_alignment(built.tbox, built.lexicon, self._taxonomy, [*built.rows, *others])

    def predict(self, view: ObjectView) -> ScoredView:
        """Return the class of a view with an uncalibrated score and no prim path; equal views share one result."""
        prefix = self._context.shared_prefix(view)
        shown = view_without_prefix(view, prefix)
        left_out = "" if shown.name == view.name else " ".join(prefix)
        appearance = self._context.appearance_key(shown)
        if not shown.is_masked and not is_generated_name(shown.name):
            words, is_made_for_it = self._words.words_of(shown), self._words.is_made_for_stage(shown)
            clear = self._predict_copy(words, is_made_for_it, left_out, appearance)
            if clear is not None:
                return clear
        by_words = self._score_words(shown)
        scored = by_words.scored
        if not by_words.is_enough:
            neighbours, seen = self._context.score_neighbours(shown), self._context.surroundings(shown)
            if not neighbours and not by_words.has_abbreviations:
                unknown_share = self._unknown_share((), shown.name, shown.parents)
                return self._predict_in_place(by_words.words, seen, unknown_share, left_out, appearance)
            scored = self._combine(scored, neighbours, seen, is_masked=shown.is_masked)
        found = self._answer(scored, by_words.best_score, appearance)
        unknown_share = self._unknown_share(found.prediction.words, shown.name, shown.parents)
        return _with_note(found._replace(unknown_share=unknown_share), left_out)

    def weigh(
        self, view: ObjectView, candidates: Iterable[ClassIRI]
    ) -> Mapping[ClassIRI, tuple[CandidateEvidence, ...]]:
        """Return what each source says about each candidate of a view."""
        return weigh_candidates(self._words, self._context, view, candidates, self._tbox)

    def _predict_looking_alike(
        self, words: ObjectWords, is_made_for_it: bool, left_out: str, appearance: AppearanceKey | None
    ) -> ScoredView | None:
        """Return the class of an object as `_predict_clear` does, with its posterior by appearance."""
        clear = self._predict_by_words(words, is_made_for_it, left_out)
        return clear and clear._replace(posterior=self._context.posterior_by_appearance(appearance))

    def _predict_clear(self, words: ObjectWords, is_made_for_it: bool, left_out: str) -> ScoredView | None:
        """Return the class of an object whose words are clear and complete; None if others may affect its class."""
        scored = self._words.score_words(words, is_made_for_it=is_made_for_it)
        if not scored or scored[0].score < EVIDENCE.clear_score:
            return None
        if scored[0].group == "name" and not self._words.is_complete(words, is_made_for_it=is_made_for_it):
            return None
        found = self._best_of(scored, NO_POSTERIOR)
        unknown_share = self._unknown_share(found.prediction.words, words.name, words.parents)
        return _with_note(found._replace(unknown_share=unknown_share), left_out)

    def _predict_without_neighbours(
        self,
        words: tuple[ObjectWords, bool] | None,
        seen: Surroundings | None,
        unknown_share: float,
        left_out: str,
        appearance: AppearanceKey | None,
    ) -> ScoredView:
        """Return the class of an object by its words and its surroundings, where no neighbour has a class."""
        scored = self._words.score_words(words[0], is_made_for_it=words[1]) if words is not None else []
        best_score = scored[0].score if scored else 0.0
        found = self._answer(self._combine(scored, [], seen, is_masked=words is None), best_score, appearance)
        return _with_note(found._replace(unknown_share=unknown_share), left_out)

    def _unknown_share(self, expansion: tuple[str, ...], name: str, parents: tuple[str, ...]) -> float:
        words = expansion or self.reader.read(name, parents).words
        unknown = [word for word in words if not self.reader.kinds.is_known(word)]
        return len(unknown) / len(words) if words else 0.0

    def _answer(self, scored: list[ScoredClass], word_score: float, appearance: AppearanceKey | None) -> ScoredView:
        """Return the answer by scored classes, best first, and the best score of spelled-out words."""
        posterior = self._context.posterior_by_appearance(appearance)
        if not scored or max(scored[0].score, word_score) < EVIDENCE.min_score:
            return ScoredView(self._default("the evidence does not determine its class"), posterior)
        return self._best_of(scored, posterior)

    def _best_of(self, scored: list[ScoredClass], posterior: ClassPosterior) -> ScoredView:
        """Return the answer by scored classes, best first, at least one."""
        best = scored[0]
        if best.class_iri == NO_CLASS_IRI:
            return ScoredView(_refusal(best.explain()), posterior)
        if best.group in CONTEXT_GROUPS and self._is_fallback(best.class_iri):
            # Two unidentified objects are not evidence for each other.
            return ScoredView(self._default(best.explain()), posterior)
        scores = {found.class_iri: found.score for found in reversed(scored) if found.class_iri != NO_CLASS_IRI}
        candidates = sorted(scores.items(), key=lambda candidate: (-candidate[1], candidate[0]))
        prediction = Prediction(
            prim_path="",
            class_iri=best.class_iri,
            confidence=round(best.score, 4),
            status=Status.GROUNDED,
            grounder=_GROUNDER,
            explanation=best.explain(),
            evidence=(best.group,),
            candidates=tuple(Candidate(iri, score) for iri, score in candidates[: EVIDENCE.max_candidates]),
            words=best.words,
        )
        return ScoredView(prediction, posterior, best.is_listed)

    def _score_words(self, view: ObjectView) -> _WordScores:
        """Return the classes by words; abbreviations are read only if other evidence is needed."""
        is_generated = is_generated_name(view.name)
        scored: list[ScoredClass] = []
        words = None
        if not view.is_masked:
            read = self._words.words_of(replace(view, name="") if is_generated else view)
            words = read, self._words.is_made_for_stage(view)
            scored = self._words.score_words(read, is_made_for_it=words[1])
        if scored and scored[0].score >= EVIDENCE.clear_score and scored[0].group == "name":
            scored = self._words.complete(view, scored)
        best_score = scored[0].score if scored else 0.0
        if best_score >= EVIDENCE.clear_score:
            return _WordScores(words, scored, best_score, is_enough=True)
        if not (scored or view.is_masked or is_generated) and self.reader.names_known_noun(view.name):
            # The name is understood and no class fits, as for a tulip in a TBox of furniture: the classes of neighbours
            # could only be wrong.
            return _WordScores(words, [], best_score, is_enough=True)
        expanded = [] if is_generated else self._words.score_abbreviation(view)
        return _WordScores(words, [*scored, *expanded], best_score, has_abbreviations=bool(expanded))

    def _combine(
        self,
        by_words: list[ScoredClass],
        by_neighbours: list[ScoredClass],
        seen: Surroundings | None,
        *,
        is_masked: bool = False,
    ) -> list[ScoredClass]:
        posterior = self._context.posterior(seen)
        explain = partial(self._context.explain_posterior, seen, posterior.place)
        return combine_evidence(by_words, by_neighbours, posterior.ranked(), explain, is_masked=is_masked)

    def _default(self, reason: str) -> Prediction:
        iri = self._lexicon.default_class
        if iri is None or iri == NO_CLASS_IRI:
            return _refusal(f"{reason}; {NO_CLASS} applies to most objects")
        return Prediction(
            prim_path="",
            class_iri=iri,
            confidence=EVIDENCE.default_confidence,
            status=Status.SUPERCLASS,
            grounder=_GROUNDER,
            explanation=f"{reason}; {self._tbox.by_iri[iri].readable_name} applies to most objects",
            candidates=(Candidate(iri, EVIDENCE.default_confidence),),
        )


def _refusal(explanation: str) -> Prediction:
    return Prediction("", None, None, Status.REFUSED, _GROUNDER, explanation)


def _with_note(scored: ScoredView, left_out: str) -> ScoredView:
    """Return an answer whose explanation mentions the prefix that was left out, if any."""
    if not left_out:
        return scored
    note = f"most names of the stage begin with “{left_out}”, which was left out"
    explanation = f"{scored.prediction.explanation}; {note}"
    return scored._replace(prediction=replace(scored.prediction, explanation=explanation))


def _build(
    tbox: TBox,
    taxonomy: Taxonomy,
    synonyms: Callable[[], Mapping[ClassIRI, tuple[str, ...]]],
    alignment: "AlignmentFile | None",
    *,
    use_lists: bool,
) -> "BuiltAlignment":
    # Imported here, since most commands read a lexicon that is already built.
    from usd2kg.grounding.lexical.alignment.built_alignment import BuiltAlignment, build_alignment  # noqa: PLC0415

    if alignment is None:
        return build_alignment(tbox, taxonomy, synonyms(), use_lists=use_lists)
    return BuiltAlignment(*alignment.apply(tbox, taxonomy, synonyms(), use_lists=use_lists), ())


def _edited(built: "BuiltAlignment", taxonomy: Taxonomy) -> tuple[TBox, Lexicon]:
    return built.tbox, built.edited(taxonomy)


def _rooted_of_json(found: Any, tbox: TBox, taxonomy: Taxonomy) -> tuple[TBox, Lexicon]:
    rooted = with_root(tbox, found["default"] or NO_CLASS_IRI, taxonomy)
    return rooted, lexicon_of_json(found, rooted)


def _kinds_of_json(found: Mapping[str, list[str]]) -> dict[int, tuple[str, ...]]:
    return {int(synset): tuple(names) for synset, names in found.items()}


def _kinds_in(names: Mapping[int, tuple[str, ...]], synset: int) -> tuple[str, ...]:
    return names.get(synset, ())
