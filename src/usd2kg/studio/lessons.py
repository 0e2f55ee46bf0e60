"""What decisions teach: rows of an alignment that a person made, for this scene and others.

If reviewers gave all objects of one concept the same class, the concept belongs to that class. An object without a
concept teaches the same about the words of its name. A reviewer can also decide about a concept: then exceptions among
its objects teach nothing else. Where no class fits, the concept does not belong to the classes that were suggested.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from usd2kg.grounding import Decision, Grounding
from usd2kg.grounding.lexical.alignment.alignment_rows import AlignmentRow, RowKind, format_rows
from usd2kg.grounding.lexical.alignment.artificial_root import NO_CLASS_IRI
from usd2kg.grounding.lexical.alignment.residual_class import find_default_class
from usd2kg.grounding.lexical.alignment.terms import TermKind
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy, load_taxonomy
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.scene import Scene
from usd2kg.studio.verdicts import Event

__all__ = ["Lesson", "find_lessons", "format_lessons"]


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
    is_direct: bool = False
    """Whether a person decided about the concept, not only about its objects."""
    rejected: tuple[ClassIRI, ...] = ()
    """If no class fits, the classes that were suggested, sorted."""


def find_lessons(
    suggestions: Grounding, decisions: Mapping[str, Decision], scene: Scene, standing: Sequence[Event] = ()
) -> list[Lesson]:
    """Return what the decisions teach, sorted by label; nothing about concepts on which they contradict each other.

    Args:
        suggestions: the grounding that was reviewed.
        decisions: prim path → decision.
        scene: the scene.
        standing: the events that are not undone, oldest first, for those about a concept.
    """
    direct = {lesson.concept: lesson for event in standing if event.concept for lesson in [_direct(event, suggestions)]}
    taught: dict[tuple[str, str], list[Decision]] = {}
    suggested: dict[tuple[str, str], set[ClassIRI]] = {}
    for prediction in suggestions.predictions:
        made = decisions.get(prediction.prim_path)
        if made is None:
            continue
        concept = suggestions.concepts.get(prediction.concept or "")
        words = [word for word in scene.by_path[prediction.prim_path].words if not word.isdigit()]
        key = (concept.iri, concept.label) if concept is not None else ("", " ".join(words).lower())
        if key[1] and key[0] not in direct:
            taught.setdefault(key, []).append(made)
            suggested.setdefault(key, set()).update(filter(None, [prediction.class_iri]))
    lessons = [
        Lesson(
            *key,
            found[0].class_iri,
            len(found),
            tuple(sorted({made.reviewer for made in found})),
            rejected=() if found[0].class_iri is not None else tuple(sorted(suggested[key])),
        )
        for key, found in taught.items()
        if len({made.class_iri for made in found}) == 1
    ]
    return sorted([*direct.values(), *lessons], key=lambda lesson: (lesson.label, lesson.concept))


def _direct(event: Event, suggestions: Grounding) -> Lesson:
    """Return the lesson of a decision about a concept."""
    concept = suggestions.concepts.get(event.concept)
    return Lesson(
        event.concept,
        concept.label if concept is not None else "",
        event.changes[0].verdict.class_iri,
        len(event.changes),
        (event.reviewer,),
        is_direct=True,
    )


def format_lessons(lessons: Iterable[Lesson], tbox: TBox) -> str:
    """Return the lessons as SSSOM/TSV, an input of `--alignment` that changes the alignment that is built."""
    taxonomy = load_taxonomy()
    # Everything belongs to a general class, so that an alignment can only state what a concept is not.
    has_general = find_default_class(tbox, taxonomy) is not None
    rows: dict[tuple[RowKind, str, ClassIRI | None], AlignmentRow] = {}
    # Of two rows about one word, that of a decision about a concept counts.
    for lesson in sorted(lessons, key=lambda lesson: not lesson.is_direct):
        is_negated = lesson.class_iri is None and has_general
        for row in _negated_rows(lesson, taxonomy) if is_negated else _rows(lesson, lesson.class_iri or NO_CLASS_IRI):
            rows.setdefault((row.kind, row.subject, row.class_iri if row.is_negated else None), row)
    return format_rows([*rows.values()], tbox)


def _rows(lesson: Lesson, class_iri: ClassIRI) -> Iterator[AlignmentRow]:
    """Yield the row for a concept, if there is one, and that for its noun.

    The noun may be the label of another class, which a row for the concept alone does not change.
    """
    objects = f"{lesson.objects} {'object' if lesson.objects == 1 else 'objects'}"
    row = AlignmentRow(
        RowKind.TERM,
        lesson.label,
        class_iri,
        confidence=1.0,
        label=lesson.label,
        reason=f"decided for the concept, with {objects}" if lesson.is_direct else f"decided for {objects}",
        term_kind=TermKind.CURATED,
        is_curated=True,
        reviewers=lesson.reviewers,
    )
    if lesson.concept:
        yield replace(row, kind=RowKind.CONCEPT, subject=lesson.concept)
    if lesson.label:
        yield row


def _negated_rows(lesson: Lesson, taxonomy: Taxonomy) -> Iterator[AlignmentRow]:
    """Yield a row for the concept, its noun and the other senses of the noun, which may lead to the same class."""
    senses = [taxonomy.concept_iri(sense.synset) for sense in taxonomy.senses(lesson.label)]
    for class_iri in lesson.rejected:
        for row in _rows(lesson, class_iri):
            subjects = senses if row.kind is RowKind.CONCEPT else [row.subject]
            for subject in dict.fromkeys([row.subject, *subjects]):
                yield replace(row, subject=subject, is_negated=True)
