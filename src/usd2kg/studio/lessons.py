"""What decisions teach: rows of an alignment that a person made, for this scene and others.

If reviewers gave all objects of one concept the same class, the concept belongs to that class. An object without a
concept teaches the same about the words of its name.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from usd2kg.grounding import Decision, Grounding
from usd2kg.grounding.sssom_decisions import NO_TERM
from usd2kg.grounding.sssom_file import Curies, format_sssom_file, one_line
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.ontology.namespaces import CONCEPT, WORDNET
from usd2kg.ontology.prefixes import PREFIXES
from usd2kg.scene import Scene

__all__ = ["Lesson", "find_lessons", "format_lessons"]

_COLUMNS = (
    *("subject_id", "subject_label", "subject_type", "predicate_id", "object_id", "object_label"),
    *("mapping_justification", "reviewer_label", "comment"),
)
_PREFIXES = {**PREFIXES, "concept": CONCEPT, "wn": WORDNET, "sssom": "https://w3id.org/sssom/"}


@dataclass(frozen=True, slots=True)
class Lesson:
    """A concept or a phrase that belongs to a class."""

    concept: str
    """IRI of the concept; empty for a phrase."""
    label: str
    """The noun of the concept, or the phrase."""
    class_iri: ClassIRI | None
    """None if no class fits."""
    objects: int
    """Number of decided objects that teach it."""
    reviewers: tuple[str, ...]
    """Who decided, sorted."""


def find_lessons(suggestions: Grounding, decisions: Mapping[str, Decision], scene: Scene) -> list[Lesson]:
    """Return what the decisions teach, sorted by label; nothing about what they contradict each other.

    Args:
        suggestions: the grounding that was reviewed.
        decisions: prim path → decision.
        scene: the scene.
    """
    taught: dict[tuple[str, str], list[Decision]] = {}
    for prediction in suggestions.predictions:
        made = decisions.get(prediction.prim_path)
        if made is None:
            continue
        concept = suggestions.concepts.get(prediction.concept or "")
        words = [word for word in scene.by_path[prediction.prim_path].words if not word.isdigit()]
        key = (concept.iri, concept.label) if concept is not None else ("", " ".join(words).lower())
        if key[1]:
            taught.setdefault(key, []).append(made)
    lessons = [
        Lesson(iri, label, found[0].class_iri, len(found), tuple(sorted({made.reviewer for made in found})))
        for (iri, label), found in taught.items()
        if len({made.class_iri for made in found}) == 1
    ]
    return sorted(lessons, key=lambda lesson: (lesson.label, lesson.concept))


def format_lessons(lessons: Iterable[Lesson], tbox: TBox) -> str:
    """Return the lessons as SSSOM/TSV, an input of `--alignment` that changes the alignment that is built."""
    curies = Curies(_PREFIXES, used=("sssom",))
    rows: dict[tuple[str, str], dict[str, str]] = {}
    for lesson in lessons:
        # The noun of a concept may be the label of another class, which a row for the concept alone does not change.
        for concept in dict.fromkeys((lesson.concept, "")):
            rows.setdefault((concept, lesson.label), _row(lesson, concept, tbox, curies))
    header = {
        "mapping_set_id": f"https://w3id.org/usd2kg/lessons/{tbox.content_hash.removeprefix('sha256:')}",
        "mapping_set_title": f"Concepts of {tbox.ontology_iri}, as reviewers decided",
        "license": "https://w3id.org/sssom/license/unspecified",
        "object_source_version": tbox.content_hash,
    }
    return format_sssom_file(header, curies, {}, _COLUMNS, rows.values())


def _row(lesson: Lesson, concept: str, tbox: TBox, curies: Curies) -> dict[str, str]:
    """Return the row for the concept of a lesson, or for its words if `concept` is empty."""
    return {
        "subject_id": curies.shorten(concept) if concept else "",
        "subject_label": one_line(lesson.label),
        "subject_type": "skos concept" if concept else "rdfs literal",
        "predicate_id": "skos:closeMatch" if concept else "skos:exactMatch",
        "object_id": curies.shorten(lesson.class_iri or NO_TERM),
        "object_label": one_line(tbox.by_iri[lesson.class_iri].label) if lesson.class_iri else "",
        "mapping_justification": "semapv:ManualMappingCuration",
        "reviewer_label": "|".join(name.replace("|", r"\|") for name in lesson.reviewers),
        "comment": f"decided for {lesson.objects} {'object' if lesson.objects == 1 else 'objects'}",
    }
