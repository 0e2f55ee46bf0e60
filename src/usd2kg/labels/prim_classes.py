"""read_prim_classes: the class of each prim from a mapping, a queue of decisions, gold labels or a graph."""

import csv
import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import pyoxigraph as ox

from usd2kg.errors import GroundingError, OntologyError
from usd2kg.graph.vocabulary import OWL, RDF, SKOS, SSSOM, U2K
from usd2kg.grounding import PERSON, Grounding, Status, read_grounding
from usd2kg.grounding.sssom_decisions import EXPECTED, REQUIRED, is_decided, is_sssom, last_rows, read_class
from usd2kg.grounding.sssom_file import read_sssom_file
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.query import GraphStore, load_graph

__all__ = ["PrimClass", "PrimClasses", "classes_of_grounding", "read_prim_classes"]

_OTHER_COLUMNS = ("confidence", "status", "grounder", "concept_label")
_EXPECTED = "expected CSV with the columns path and class (or decision)"


@dataclass(frozen=True, slots=True)
class PrimClass:
    """The class of one prim."""

    prim_path: str
    class_iri: ClassIRI | None
    """None if the prim has no class; `status` gives the reason."""
    confidence: float | None
    """Probability that the class is right; None if unknown."""
    status: str
    is_reviewed: bool
    """Whether a person decided the class."""
    concept: str = ""
    """Noun for the concept of the object, independent of its class; empty if it has none."""


@dataclass(frozen=True)
class PrimClasses:
    """The classes of the prims of one scene."""

    source: str
    entries: tuple[PrimClass, ...]
    """In file order; each prim once."""

    @cached_property
    def by_path(self) -> Mapping[str, PrimClass]:
        """Prim path → class."""
        return {entry.prim_path: entry for entry in self.entries}


def read_prim_classes(path: Path, tbox: TBox) -> PrimClasses:
    """Return the classes in a mapping (`.csv`, `.json`, SSSOM as `.tsv`), a filled-in queue, gold labels, or a graph.

    Raises:
        GroundingError: a mapping cannot be read, a class is not in the scope of `tbox`, a prim has two classes, a prim
            path is not text, or a confidence is not a number from 0 to 1.
        GraphError: a graph cannot be read.
    """
    ending = path.suffix.lower()
    if ending == ".json":
        found = _read_grounding_file(path)
    elif ending == ".csv":
        found = _read_csv(path)
    elif is_sssom(path):
        found = _read_sssom(path, tbox)
    else:
        found = _read_graph(load_graph(path), tbox)
    entries: dict[str, PrimClass] = {}
    for where, raw in found:
        entry = _resolve_class(where, raw, tbox)
        if entries.setdefault(entry.prim_path, entry).class_iri != entry.class_iri:
            raise GroundingError(f"{where}: {entry.prim_path} has two classes; keep one")
    return PrimClasses(str(path), tuple(entries.values()))


def _resolve_class(where: str, entry: PrimClass, tbox: TBox) -> PrimClass:
    if entry.class_iri is None:
        return entry
    try:
        return replace(entry, class_iri=tbox.resolve(entry.class_iri))
    except OntologyError as error:
        raise GroundingError(f"{where}: {error}; give the ontology of these classes with --ontology") from error


def _parse_confidence(where: str, prim_path: str, value: object) -> float | None:
    """Return the confidence of a prim; None for None.

    Raises:
        GroundingError: the confidence is not a number from 0 to 1.
    """
    if value is None:
        return None
    try:
        number = float(str(value))
    except ValueError:
        number = math.nan
    if not 0 <= number <= 1:
        raise GroundingError(f"{where}: {prim_path} has the confidence {value!r}, expected a number from 0 to 1")
    return number


def classes_of_grounding(grounding: Grounding) -> PrimClasses:
    """Return the classes of a grounding as those of prims."""
    entries = []
    for p in grounding.predictions:
        concept = grounding.concepts.get(p.concept or "")
        label, is_reviewed = concept.label if concept else "", p.status is Status.REVIEWED
        entries.append(PrimClass(p.prim_path, p.class_iri, p.confidence, p.status.value, is_reviewed, label))
    return PrimClasses(grounding.scene, tuple(entries))


def _read_grounding_file(path: Path) -> Iterator[tuple[str, PrimClass]]:
    for entry in classes_of_grounding(read_grounding(path)).entries:
        _parse_confidence(str(path), entry.prim_path, entry.confidence)
        yield str(path), entry


def _read_csv(path: Path) -> Iterator[tuple[str, PrimClass]]:
    try:
        rows = csv.DictReader(path.read_text("utf-8-sig").splitlines())
        columns = rows.fieldnames or ()
        column = next((name for name in ("decision", "class") if name in columns), None)
        if column is None or "path" not in columns:
            raise GroundingError(f"{path}: line 1 has the columns {', '.join(columns) or 'nothing'}; {_EXPECTED}")
        for row in rows:
            where = f"{path}: line {rows.line_num}"
            if (row["path"] or "").strip():
                yield where, _parse_row(where, row, column)
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise GroundingError(f"{path}: cannot be read as a mapping ({error}); {_EXPECTED}") from error


def _parse_row(where: str, row: dict[str, str | None], column: str) -> PrimClass:
    cells = {key: (row.get(key) or "").strip() for key in ("path", column, *_OTHER_COLUMNS)}
    name = cells[column] or None
    by_person = column == "decision" or cells["status"] == Status.REVIEWED or cells["grounder"] == PERSON
    default = "undecided" if name is None else Status.REVIEWED if by_person else Status.GROUNDED
    # In a queue, the confidence belongs to the grounder's answer, not to the decision.
    number = None if column == "decision" else cells["confidence"] or None
    confidence = _parse_confidence(where, cells["path"], number)
    status = str(cells["status"] or default)
    return PrimClass(cells["path"], name, confidence, status, by_person and name is not None, cells["concept_label"])


def _read_sssom(path: Path, tbox: TBox) -> Iterator[tuple[str, PrimClass]]:
    try:
        file = read_sssom_file(path, path.read_text("utf-8-sig"), REQUIRED, EXPECTED)
    except (OSError, UnicodeDecodeError) as error:
        raise GroundingError(f"{path}: cannot be read as a mapping ({error}); {EXPECTED}") from error
    for line, cells in last_rows(file):
        if cells.get("predicate_modifier"):
            continue
        where, is_reviewed = f"{path}: line {line}", is_decided(cells)
        iri = read_class(where, cells, file, tbox)
        default = Status.REVIEWED if is_reviewed else Status.GROUNDED
        confidence = _parse_confidence(where, cells["prim_path"], cells.get("confidence") or None)
        yield (
            where,
            PrimClass(
                cells["prim_path"],
                iri,
                confidence,
                cells.get("status") or default,
                is_reviewed and iri is not None,
                cells.get("concept_label", ""),
            ),
        )


def _read_graph(store: GraphStore, tbox: TBox) -> Iterator[tuple[str, PrimClass]]:
    graph = store.store
    annotations = _type_annotations(graph)
    for subject, _, path, _ in graph.quads_for_pattern(None, U2K.primPath, None, None):
        if not isinstance(path, ox.Literal):
            message = f'{store.source}: {subject} has the prim path {path}, expected a text such as "/World/Mug"'
            raise GroundingError(message)
        types = [node for _, _, node, _ in graph.quads_for_pattern(subject, RDF.type, None, None)]
        if U2K.RoomGroup in types:
            # A group that is a room by its name is not an object, so the run does not ground it.
            continue
        iri = _most_specific([node.value for node in types if isinstance(node, ox.NamedNode)], tbox)
        if iri is None and (other := [node for node in types if (subject, node) in annotations]):
            raise GroundingError(
                f"{store.source}: {path.value} has the class {other[0].value}, which the ontology {tbox.source} lacks; "
                "give the ontology of these classes with --ontology"
            )
        # The annotations of an object without a class are on the object itself.
        values = _literals(graph, annotations.get((subject, ox.NamedNode(iri)), subject) if iri else subject)
        status = values.get(U2K.status, "grounded" if iri else "")
        confidence = _parse_confidence(store.source, path.value, values.get(SSSOM.confidence))
        concept = _concept_label(graph, subject)
        yield store.source, PrimClass(path.value, iri, confidence, status, status == Status.REVIEWED, concept)


def _concept_label(graph: ox.Store, node: object) -> str:
    concepts = graph.quads_for_pattern(node, U2K.concept, None, None)  # type: ignore[arg-type]
    found = (_literals(graph, concept).get(SKOS.prefLabel, "") for _, _, concept, _ in concepts)
    return next(found, "")


def _most_specific(iris: Iterable[ClassIRI], tbox: TBox) -> ClassIRI | None:
    known = [iri for iri in iris if iri in tbox.by_iri]
    lowest = [iri for iri in known if not any(other != iri and tbox.is_subclass(other, iri) for other in known)]
    return min(lowest, default=None)


def _type_annotations(graph: ox.Store) -> dict[tuple[object, object], object]:
    """Return (object, class) → the node that annotates the type assertion: an OWL axiom or an RDF 1.2 reifier."""
    found: dict[tuple[object, object], object] = {}
    for axiom, _, _, _ in graph.quads_for_pattern(None, OWL.annotatedProperty, RDF.type, None):
        subject, target = (
            next((node for _, _, node, _ in graph.quads_for_pattern(axiom, end, None, None)), None)
            for end in (OWL.annotatedSource, OWL.annotatedTarget)
        )
        found[subject, target] = axiom
    for reifier, _, triple, _ in graph.quads_for_pattern(None, RDF.reifies, None, None):
        if isinstance(triple, ox.Triple) and triple.predicate == RDF.type:
            found[triple.subject, triple.object] = reifier
    return found


def _literals(graph: ox.Store, node: object) -> dict[object, str]:
    quads = graph.quads_for_pattern(node, None, None, None)  # type: ignore[arg-type]
    return {name: value.value for _, name, value, _ in quads if isinstance(value, ox.Literal)}
