"""The default grounder: no network, no key, no GPU.

It reads a name as a noun phrase and matches its head noun with the terms of the TBox, else through WordNet's hypernyms.
Where the name is not clear it adds the evidence of assets, documentation, parts, neighbours, size and place.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import chain
from typing import TYPE_CHECKING

from usd2kg.garbage import paused_collection
from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.lexical.alignment.english_labels import as_text, in_english
from usd2kg.grounding.lexical.candidate_evidence import CandidateEvidence
from usd2kg.grounding.lexical.class_choice import choose_superclass, reconcile_copies, superclass_confidence
from usd2kg.grounding.lexical.concepts.home_names import home_names
from usd2kg.grounding.lexical.confidence import calibrate, features_of, general_class_log_odds
from usd2kg.grounding.lexical.object_grounder import ObjectGrounder
from usd2kg.grounding.lexical.scored_view import ScoredView
from usd2kg.grounding.model import Prediction, Status
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.table_cache import NO_CACHE, open_table_cache
from usd2kg.two_processes import compute_in_halves

if TYPE_CHECKING:
    from usd2kg.grounding.lexical.alignment.alignment_file import AlignmentFile
    from usd2kg.grounding.lexical.alignment.alignment_rows import AlignmentRow

__all__ = ["LexicalGrounder"]

_MANY_OBJECTS = 20_000
"""Objects from which a second process saves seconds."""


class LexicalGrounder:
    """Grounds objects by their names, a noun taxonomy, and their context."""

    name = "lexical"
    is_calibrated = True

    def __init__(
        self,
        *,
        use_home_synonyms: bool = True,
        use_member_lists: bool = True,
        abstains: bool = False,
        alignment: "AlignmentFile | None" = None,
    ) -> None:
        """Create a grounder.

        Args:
            use_home_synonyms: whether classes with the IRI of a class of the built-in home TBox get its synonyms too.
            use_member_lists: whether the lists of what belongs to the classes of public ontologies count.
            abstains: whether to answer with the superclass that maximises the expected hierarchical F1; this is less
                often exact.
            alignment: an edited alignment of the ontology; by default it is built from the labels of the classes.
        """
        self._use_home_synonyms = use_home_synonyms
        self._use_member_lists = use_member_lists
        self._abstains = abstains
        self._alignment = alignment

    @property
    def settings(self) -> Mapping[str, str]:
        """The settings that the predictions depend on."""
        return {
            "home_synonyms": str(self._use_home_synonyms).lower(),
            **({} if self._use_member_lists else {"member_lists": "false"}),
            **({"decision": "hierarchical"} if self._abstains else {}),
            **({"alignment": self._alignment.digest} if self._alignment is not None else {}),
        }

    def ground_views(self, views: Sequence[tuple[str, ObjectView]], tbox: TBox) -> list[Prediction]:
        """Return one prediction with a calibrated confidence for each (prim path, view)."""
        with paused_collection():
            grounder = self.object_grounder(tbox)
            scored = _predict_by_size(grounder, [view for _, view in views])
            general = grounder.general_classes
            log_odds = general_class_log_odds((one.prediction for one in scored), general)
            # Copies share one result.
            distinct = {id(one): one for one in scored}
            calibrated = {key: self._calibrate(one, tbox, general, log_odds) for key, one in distinct.items()}
            placed = [
                replace(calibrated[id(one)], prim_path=path) for (path, _), one in zip(views, scored, strict=True)
            ]
            return reconcile_copies([view for _, view in views], placed, tbox)

    def _calibrate(self, scored: ScoredView, tbox: TBox, general: frozenset[ClassIRI], log_odds: float) -> Prediction:
        """Return a prediction with a calibrated confidence, generalised if the grounder abstains."""
        prediction = scored.prediction
        if prediction.class_iri is None:
            return prediction
        confidence = calibrate(features_of(scored, tbox, general, log_odds))
        calibrated = replace(prediction, confidence=confidence)
        return _abstain(calibrated, tbox) if self._abstains else calibrated

    def format_alignment(self, tbox: TBox, others: "Iterable[AlignmentRow]" = ()) -> str:
        """Return the alignment of the classes with concepts and terms as SSSOM/TSV, to be edited.

        Args:
            tbox: the classes.
            others: further rows, such as a language model's.

        Raises:
            GroundingError: the grounder's own alignment is invalid.
        """
        return self.object_grounder(tbox).format_alignment(others)

    def general_classes(self, tbox: TBox) -> frozenset[ClassIRI]:
        """Return the uninformative classes: the roots and the default class."""
        return self.object_grounder(tbox).general_classes

    def weigh(
        self, view: ObjectView, candidates: Iterable[ClassIRI], tbox: TBox
    ) -> Mapping[ClassIRI, tuple[CandidateEvidence, ...]]:
        """Return what each source says about each candidate of a view: words, neighbours, size, stance and place."""
        return self.object_grounder(tbox).weigh(view, candidates)

    def score_views(self, views: Sequence[tuple[str, ObjectView]], tbox: TBox) -> list[ScoredView]:
        """Return the best candidate of each (prim path, view), with an uncalibrated score."""
        grounder = self.object_grounder(tbox)
        scored = _predict_by_size(grounder, [view for _, view in views])
        return [
            one._replace(prediction=replace(one.prediction, prim_path=path))
            for (path, _), one in zip(views, scored, strict=True)
        ]

    def object_grounder(self, tbox: TBox) -> ObjectGrounder:
        """Return the grounder of single objects to the classes of a TBox."""
        return _make_object_grounder(in_english(tbox), self._use_home_synonyms, self._use_member_lists, self._alignment)


def _predict_by_size(grounder: ObjectGrounder, views: Sequence[ObjectView]) -> list[ScoredView]:
    """Return the answer for each view; copies come one after the other, so that small caches find their results."""
    order = sorted(range(len(views)), key=lambda index: views[index].own_size or ())

    def predict(indices: Sequence[int]) -> list[ScoredView]:
        return [grounder.predict(views[index]) for index in indices]

    predicted = chain.from_iterable(compute_in_halves(predict, order, least=_MANY_OBJECTS))
    by_index = dict(zip(order, predicted, strict=True))
    return [by_index[index] for index in range(len(views))]


def _abstain(prediction: Prediction, tbox: TBox) -> Prediction:
    """Return the prediction, generalised to the superclass that `choose_superclass` returns."""
    if prediction.class_iri is None or prediction.confidence is None:
        return prediction
    scores = {candidate.class_iri: candidate.score for candidate in prediction.candidates}
    iri = choose_superclass(scores, tbox)
    if iri == prediction.class_iri:
        return prediction
    confidence = superclass_confidence(iri, prediction.class_iri, prediction.confidence, scores, tbox)
    names = ", ".join(tbox.by_iri[candidate.class_iri].readable_name for candidate in prediction.candidates[:3])
    explanation = f"{prediction.explanation}; {tbox.by_iri[iri].readable_name} is safer than any of {names}"
    return replace(prediction, class_iri=iri, confidence=confidence, status=Status.SUPERCLASS, explanation=explanation)


@lru_cache(maxsize=4)
def _make_object_grounder(
    tbox: TBox, use_home_synonyms: bool, use_member_lists: bool, alignment: "AlignmentFile | None"
) -> ObjectGrounder:
    """Return the grounder of a TBox; it has no state from scenes, so all scenes share it."""
    # An edited alignment may have problems to warn about.
    tables = NO_CACHE
    if alignment is None:
        tables = open_table_cache([f"{use_home_synonyms} {use_member_lists}", *as_text(tbox)])
    synonyms = home_names if use_home_synonyms else dict
    return ObjectGrounder(tbox, synonyms, alignment, use_member_lists=use_member_lists, tables=tables)
