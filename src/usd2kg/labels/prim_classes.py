"""read_prim_classes: which class each prim has, from whatever file of a run is at hand."""

import csv
import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import pyoxigraph as ox

from usd2kg.errors import GroundingError, OntologyError
from usd2kg.graph.vocabulary import OWL, RDF, SSSOM, U2K
from usd2kg.grounding import PERSON, Status, read_grounding
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.query import GraphStore, load_graph

__all__ = ["PrimClass", "PrimClasses", "read_prim_classes"]

_EXPECTED = "expected CSV with the columns path and class (or decision)"


@dataclass(frozen=True, slots=True)
class PrimClass:
    """The class of one prim, as a run has it."""

    prim_path: str
    class_iri: ClassIRI | None
    """None where the run has none; `status` says why."""
    confidence: float | None
    """Probability that it is right, None where nobody knows."""
    status: str
    is_reviewed: bool
    """Whether a person decided."""


@dataclass(frozen=True)
class PrimClasses:
    """The entries of one run."""

    source: str
    entries: tuple[PrimClass, ...]
    """In the order of the file; each prim once."""

    @cached_property
    def by_path(self) -> Mapping[str, PrimClass]:
        """Prim path → answer."""
        return {answer.prim_path: answer for answer in self.entries}


def read_prim_classes(path: Path, tbox: TBox) -> PrimClasses:
    """Return the classes in a mapping (`.csv` or `.json` of `usd2kg ground`, a filled-in queue), else in a graph.

    Raises:
        GroundingError: a mapping cannot be read, or names a class that is not in the scope of `tbox`; a prim path is no
            text, or a confidence no number from 0 to 1.
        GraphError: a graph cannot be read.
    """
    ending = path.suffix.lower()
    if ending == ".json":
        found = _of_grounding(path)
    elif ending == ".csv":
        found = _of_csv(path)
    else:
        found = _of_graph(load_graph(path), tbox)
    entries: dict[str, PrimClass] = {}
    for where, told in found:
        answer = _resolved(where, told, tbox)
        if entries.setdefault(answer.prim_path, answer).class_iri != answer.class_iri:
            raise GroundingError(f"{where}: {answer.prim_path} has two classes; leave one")
    return PrimClasses(str(path), tuple(entries.values()))


def _resolved(where: str, answer: PrimClass, tbox: TBox) -> PrimClass:
    if answer.class_iri is None:
        return answer
    try:
        iri = tbox.resolve(answer.class_iri)
    except OntologyError as error:
        message = f"{where}: {error}; name the run's own ontology with --ontology"
        raise GroundingError(message) from error
    return PrimClass(answer.prim_path, iri, answer.confidence, answer.status, answer.is_reviewed)


def _confidence(where: str, prim_path: str, told: object) -> float | None:
    """Return a confidence as a file has it; None where it has none."""
    if told is None:
        return None
    try:
        number = float(str(told))
    except ValueError:
        number = math.nan
    if not 0 <= number <= 1:
        raise GroundingError(f"{where}: {prim_path} has the confidence {told!r}, expected a number from 0 to 1")
    return number


def _of_grounding(path: Path) -> Iterator[tuple[str, PrimClass]]:
    for p in read_grounding(path).predictions:
        confidence = _confidence(str(path), p.prim_path, p.confidence)
        yield str(path), PrimClass(p.prim_path, p.class_iri, confidence, p.status.value, p.status is Status.REVIEWED)


def _of_csv(path: Path) -> Iterator[tuple[str, PrimClass]]:
    try:
        rows = csv.DictReader(path.read_text("utf-8-sig").splitlines())
        columns = rows.fieldnames or ()
        column = next((name for name in ("decision", "class") if name in columns), None)
        if column is None or "path" not in columns:
            raise GroundingError(f"{path}: line 1 has the columns {', '.join(columns) or 'nothing'}; {_EXPECTED}")
        for row in rows:
            where = f"{path}: line {rows.line_num}"
            if (row["path"] or "").strip():
                yield where, _of_row(where, row, column)
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise GroundingError(f"{path}: cannot be read as a mapping ({error}); {_EXPECTED}") from error


def _of_row(where: str, row: dict[str, str | None], column: str) -> PrimClass:
    told = {key: (row.get(key) or "").strip() for key in ("path", column, "confidence", "status", "grounder")}
    by_person = column == "decision" or told["status"] == Status.REVIEWED or told["grounder"] == PERSON
    answer = told[column] or None
    status = told["status"] or ("undecided" if answer is None else Status.REVIEWED if by_person else Status.GROUNDED)
    # The queue's confidence is that of the machine's answer, not of the person's.
    number = None if column == "decision" else told["confidence"] or None
    confidence = _confidence(where, told["path"], number)
    return PrimClass(told["path"], answer, confidence, str(status), by_person and answer is not None)


def _of_graph(store: GraphStore, tbox: TBox) -> Iterator[tuple[str, PrimClass]]:
    graph = store.store
    about = _annotations(graph)
    for subject, _, path, _ in graph.quads_for_pattern(None, U2K.primPath, None, None):
        if not isinstance(path, ox.Literal):
            message = f'{store.source}: {subject} has the prim path {path}, expected a text such as "/World/Mug"'
            raise GroundingError(message)
        classes = [node for _, _, node, _ in graph.quads_for_pattern(subject, RDF.type, None, None)]
        iri = _most_specific([node.value for node in classes if isinstance(node, ox.NamedNode)], tbox)
        told = about.get((subject, ox.NamedNode(iri))) if iri else None
        notes = _literals(graph, told if told is not None else subject)
        status = notes.get(U2K.status, "grounded" if iri else "")
        confidence = _confidence(store.source, path.value, notes.get(SSSOM.confidence))
        yield store.source, PrimClass(path.value, iri, confidence, status, status == Status.REVIEWED)


def _most_specific(iris: Iterable[str], tbox: TBox) -> str | None:
    known = [iri for iri in iris if iri in tbox.by_iri]
    lowest = [iri for iri in known if not any(other != iri and tbox.is_subclass(other, iri) for other in known)]
    return min(lowest, default=None)


def _annotations(graph: ox.Store) -> dict[tuple[object, object], ox.NamedNode | ox.BlankNode]:
    """Return (object, class) → the node that carries what is said of the type, as OWL axioms or in RDF 1.2."""
    found: dict[tuple[object, object], ox.NamedNode | ox.BlankNode] = {}
    for axiom, _, _, _ in graph.quads_for_pattern(None, OWL.annotatedProperty, RDF.type, None):
        subject, target = (
            next((node for _, _, node, _ in graph.quads_for_pattern(axiom, end, None, None)), None)
            for end in (OWL.annotatedSource, OWL.annotatedTarget)
        )
        if not isinstance(axiom, ox.Triple):
            found[subject, target] = axiom
    for reifier, _, triple, _ in graph.quads_for_pattern(None, RDF.reifies, None, None):
        if isinstance(triple, ox.Triple) and triple.predicate == RDF.type and not isinstance(reifier, ox.Triple):
            found[triple.subject, triple.object] = reifier
    return found


def _literals(graph: ox.Store, node: object) -> dict[object, str]:
    quads = graph.quads_for_pattern(node, None, None, None)  # type: ignore[arg-type]
    return {name: value.value for _, name, value, _ in quads if isinstance(value, ox.Literal)}
