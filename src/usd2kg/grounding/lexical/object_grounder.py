"""Ground one object: score classes by its name, then by other evidence, and choose the class with the best score."""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial

from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.lexical.alignment.lexicon import Lexicon, build_lexicon
from usd2kg.grounding.lexical.alignment.residual_class import is_residual
from usd2kg.grounding.lexical.class_posterior import ClassPosterior
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy, load_taxonomy
from usd2kg.grounding.lexical.context_evidence import ContextEvidence
from usd2kg.grounding.lexical.evidence_combination import CONTEXT_GROUPS, ScoredClass, combine_evidence
from usd2kg.grounding.lexical.matching.phrase_matching import PhraseMatcher
from usd2kg.grounding.lexical.matching.term_matching import TermMatcher
from usd2kg.grounding.lexical.name_evidence import NameEvidence
from usd2kg.grounding.lexical.reading.conventions import view_without_prefix, without_prefix
from usd2kg.grounding.lexical.reading.evidence_texts import is_generated_name
from usd2kg.grounding.lexical.reading.noun_phrase import NameReader
from usd2kg.grounding.lexical.settings import EVIDENCE
from usd2kg.grounding.model import Candidate, Prediction, Status
from usd2kg.ontology import ClassIRI, OntologyClass, TBox

__all__ = ["ObjectGrounder"]

_GROUNDER = "lexical"
_NO_CLASS = "no class of the ontology"
_OTHER_IRI = f"urn:usd2kg:{_NO_CLASS}"
"""IRI of a root added to TBoxes without a general class; it is never an answer."""


class ObjectGrounder:
    """Grounds single objects to the classes of one TBox."""

    def __init__(self, tbox: TBox, synonyms: Mapping[ClassIRI, tuple[str, ...]]) -> None:
        """Build the lexicon of a TBox; `synonyms` are further terms by class IRI."""
        taxonomy = load_taxonomy()
        self._tbox, self._lexicon = _with_default_class(tbox, taxonomy, synonyms)
        self.general_classes = self._lexicon.general_classes
        """The roots, and the default class."""
        reader = self._reader = NameReader(self._lexicon, taxonomy)
        terms = TermMatcher(self._tbox, self._lexicon, taxonomy, reader)
        matcher = PhraseMatcher(terms, taxonomy, reader)
        self._is_fallback = terms.is_fallback
        self._words = NameEvidence(self._lexicon, taxonomy, reader, matcher)
        self._context = ContextEvidence(self._tbox, self._words, reader, matcher)

    def predict(self, prim_path: str, view: ObjectView) -> tuple[Prediction, ClassPosterior]:
        """Return the class of a view with an uncalibrated score, and the posterior by its appearance."""
        prefix = self._context.shared_prefix(view)
        prediction, posterior = self._predict(prim_path, view_without_prefix(view, prefix))
        if without_prefix(view.name, prefix) != view.name:
            note = f"most names of the stage begin with “{' '.join(prefix)}”, which was left out"
            prediction = replace(prediction, explanation=f"{prediction.explanation}; {note}")
        return prediction, posterior

    def _predict(self, prim_path: str, view: ObjectView) -> tuple[Prediction, ClassPosterior]:
        posterior = self._context.posterior_by_appearance(view)
        scored, word_score = self._score(view)
        if not scored or max(scored[0].score, word_score) < EVIDENCE.min_score:
            return self._default(prim_path, "the evidence does not determine its class"), posterior
        best = scored[0]
        if best.class_iri == _OTHER_IRI:
            return _refusal(prim_path, best.explain()), posterior
        if best.group in CONTEXT_GROUPS and self._is_fallback(best.class_iri):
            # Two unidentified objects are no evidence for each other.
            return self._default(prim_path, best.explain()), posterior
        scores = {found.class_iri: found.score for found in reversed(scored) if found.class_iri != _OTHER_IRI}
        candidates = sorted(scores.items(), key=lambda candidate: (-candidate[1], candidate[0]))
        prediction = Prediction(
            prim_path=prim_path,
            class_iri=best.class_iri,
            confidence=round(best.score, 4),
            status=Status.GROUNDED,
            grounder=_GROUNDER,
            explanation=best.explain(),
            evidence=(best.group,),
            candidates=tuple(Candidate(iri, score) for iri, score in candidates[: EVIDENCE.max_candidates]),
            words=best.words,
        )
        return prediction, posterior

    def _score(self, view: ObjectView) -> tuple[list[ScoredClass], float]:
        """Return the classes by all evidence that is needed, best first, and the best score of spelled-out words."""
        is_generated = is_generated_name(view.name)
        scored: list[ScoredClass] = []
        if not view.is_masked:
            scored = self._words.score_words(replace(view, name="") if is_generated else view)
        if scored and scored[0].score >= EVIDENCE.clear_score and scored[0].group == "name":
            scored = self._words.complete(view, scored)
        word_score = scored[0].score if scored else 0.0
        if word_score >= EVIDENCE.clear_score:
            return scored, word_score
        if not (scored or view.is_masked or is_generated) and self._reader.names_known_noun(view.name):
            # A tulip without a class in the TBox is not what stands beside it either.
            return [], word_score
        expanded = [] if is_generated else self._words.score_abbreviation(view)
        return self._combine(view, [*scored, *expanded]), word_score

    def _combine(self, view: ObjectView, by_words: list[ScoredClass]) -> list[ScoredClass]:
        posterior = self._context.posterior(view)
        return combine_evidence(
            by_words,
            self._context.score_neighbours(view),
            posterior.ranked(),
            partial(self._context.explain_posterior, view, posterior.place),
            is_masked=view.is_masked,
        )

    def _default(self, prim_path: str, reason: str) -> Prediction:
        iri = self._lexicon.default_class
        if iri is None or iri == _OTHER_IRI:
            return _refusal(prim_path, f"{reason}; {_NO_CLASS} applies to most objects")
        return Prediction(
            prim_path=prim_path,
            class_iri=iri,
            confidence=EVIDENCE.default_confidence,
            status=Status.SUPERCLASS,
            grounder=_GROUNDER,
            explanation=f"{reason}; {self._tbox.by_iri[iri].readable_name} applies to most objects",
            candidates=(Candidate(iri, EVIDENCE.default_confidence),),
        )


def _with_default_class(
    tbox: TBox, taxonomy: Taxonomy, synonyms: Mapping[ClassIRI, tuple[str, ...]]
) -> tuple[TBox, Lexicon]:
    """Return the TBox below one class that is true of most objects, and its lexicon.

    A TBox without a general class gets an artificial root. In a list of labels with a residual class, such as
    `otherprop`, the residual class becomes the superclass of the other roots.
    """
    lexicon = build_lexicon(tbox, taxonomy, synonyms)
    default = lexicon.default_class
    if default is None:
        root = OntologyClass(_OTHER_IRI, label=_NO_CLASS, alt_labels=(), comment="", parents=())
        if lexicon.home_classes.issuperset(tbox.by_iri):
            # Without synonyms the root would turn a TBox of home classes into one with classes of other ontologies.
            synonyms = {**synonyms, _OTHER_IRI: (_NO_CLASS,)}
    elif len(tbox.roots) > 1 and default in tbox.roots and is_residual(tbox.by_iri[default], taxonomy):
        root = tbox.by_iri[default]
    else:
        return tbox, lexicon
    tbox = _below_root(tbox, root)
    return tbox, build_lexicon(tbox, taxonomy, synonyms)


def _below_root(tbox: TBox, root: OntologyClass) -> TBox:
    """Return the TBox with `root`, added if it is missing, as the superclass of all other roots."""
    others = [cls for cls in tbox.classes if cls.iri != root.iri]
    classes = [cls if cls.parents else replace(cls, parents=(root.iri,)) for cls in others]
    return replace(tbox, classes=tuple(sorted([*classes, root], key=lambda cls: cls.iri)))


def _refusal(prim_path: str, explanation: str) -> Prediction:
    return Prediction(prim_path, None, None, Status.REFUSED, _GROUNDER, explanation)
