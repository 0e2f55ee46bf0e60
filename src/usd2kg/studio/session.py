"""StudioSession: one scene under review, with everything that follows from the decisions."""

import threading
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from functools import cached_property
from pathlib import Path
from typing import Any

from usd2kg.errors import GroundingError
from usd2kg.files import write_whole
from usd2kg.graph import KnowledgeGraph, instantiate
from usd2kg.graph.iris import default_base
from usd2kg.grounding import Grounding, Prediction, Status, apply_decisions, ground, make_grounder, read_grounding
from usd2kg.grounding.built_in_choice import stated_places
from usd2kg.grounding.context.views import ObjectView, view_objects
from usd2kg.grounding.lexical.alignment.alignment_file import read_alignment_file
from usd2kg.grounding.lexical.candidate_evidence import CandidateEvidence
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.pipeline import open_tbox
from usd2kg.query import GraphStore
from usd2kg.relations import Relation, find_relations
from usd2kg.scene import ReadOptions, Scene, read_scene
from usd2kg.scene.stage import open_stage
from usd2kg.studio.audit import Audit, fit_audit, make_audit
from usd2kg.studio.journal import Journal
from usd2kg.studio.lessons import Lesson, find_lessons, format_lessons
from usd2kg.studio.object_review import ObjectReview, state_of, suggestion_of
from usd2kg.studio.project import Project
from usd2kg.studio.review_state import ReviewState
from usd2kg.studio.verdicts import Event, Verdict

__all__ = ["StudioSession", "open_stage_session"]


class StudioSession:
    """A scene, its grounding, the decisions, and the graph that they lead to.

    Decisions are made one after another, under a lock; reading is safe from any thread.
    """

    def __init__(
        self,
        project: Project,
        scene: Scene,
        tbox: TBox,
        grounding: Grounding,
        relations: Sequence[Relation],
        *,
        base: str | None = None,
        second: Grounding | None = None,
    ) -> None:
        self.project = project
        self.scene = scene
        self.tbox = tbox
        self.suggestions = grounding
        """The grounding without the decisions of the project; open objects may have been grounded again."""
        self.second = second
        """What another grounder says; None without one."""
        self.relations = tuple(relations)
        """The relations by the classes of the last graph that was built; at first by the suggestions."""
        self.stage: Path | None = project.sources.scene
        """The stage of the geometry; None if there is only a graph."""
        self.stage_note = ""
        """What is known of the stage of a graph, for people; empty if the source is a stage."""
        self.limits: Mapping[str, str] = {}
        """What cannot be done in this session (`meshes`, `labels`, `reground`) → why."""
        self.base = base or project.sources.base or default_base(scene.source)
        self.journal = Journal(project.journal, self.base, tbox)
        self.review = ReviewState(self.journal.events)
        self._relations_of = self.relations, _by_object(self.relations)
        self._lock = threading.Lock()
        self._graph_lock = threading.Lock()
        self._graph: tuple[Grounding, int, KnowledgeGraph] | None = None
        self._answers: tuple[KnowledgeGraph, GraphStore] | None = None
        self._explainer: LexicalGrounder | None = None

    @property
    def version(self) -> int:
        """Number of the last event."""
        return self.review.version

    @property
    def predictions(self) -> Mapping[str, Prediction]:
        """Prim path → suggestion, in scene order."""
        return self.suggestions.by_path

    def evidence(
        self, prim_path: str, candidates: Iterable[ClassIRI]
    ) -> Mapping[ClassIRI, tuple[CandidateEvidence, ...]]:
        """Return what words, other objects, size, stance and place say about candidates, whichever grounder chose."""
        if self._explainer is None:
            lessons = self.project.applied_lessons
            learned = lessons if self._learns() and lessons.exists() else None
            edited = self.project.sources.alignment or learned
            self._explainer = LexicalGrounder(alignment=None if edited is None else read_alignment_file(edited))
        return self._explainer.weigh(self._views[prim_path], candidates, self.tbox)

    @cached_property
    def _views(self) -> Mapping[str, ObjectView]:
        return {obj.prim_path: view for obj, view in view_objects(self.scene)}

    def relations_of(self, prim_path: str) -> list[Relation]:
        """Return the relations of which an object is the target or an anchor."""
        relations, found = self._relations_of
        if relations is not self.relations:
            relations, found = self.relations, _by_object(self.relations)
            self._relations_of = relations, found
        return found.get(prim_path, [])

    def state(self, prim_path: str) -> ObjectReview:
        """Return the state of one object."""
        return state_of(self.predictions[prim_path], self.review)

    def states(self) -> list[ObjectReview]:
        """Return the states of all objects, in scene order."""
        return [state_of(prediction, self.review) for prediction in self.suggestions.predictions]

    # Decisions.

    def decide(
        self, verdicts: Mapping[str, Verdict], reviewer: str, seen: int, *, concept: str = "", is_audit: bool = False
    ) -> list[ObjectReview]:
        """Record the verdicts on several objects as one event; return their states once the journal is on disk.

        Args:
            verdicts: prim path → kind, class and comment.
            reviewer: who decides.
            seen: number of the last event that the reviewer had seen.
            concept: IRI of the concept, if the decision is about all its objects.
            is_audit: whether the objects were drawn at random.

        Raises:
            GroundingError: there are no objects, or one is unknown.
            OutputError: the journal cannot be written; nothing has changed.
        """
        unknown = [path for path in verdicts if path not in self.predictions]
        if unknown or not verdicts:
            raise GroundingError(
                f"decision about {unknown[0] if unknown else 'nothing'}; expected objects of the scene"
            )
        with self._lock:
            suggested = {path: suggestion_of(self.predictions[path]) for path in verdicts}
            event = self.review.decide(
                verdicts, reviewer, _now(), seen, suggested=suggested, concept=concept, is_audit=is_audit
            )
            return self._record(event)

    def undo(self, reviewer: str) -> list[ObjectReview]:
        """Take back a reviewer's last decision, as `decide`.

        Raises:
            GroundingError: there is none.
            OutputError: the journal cannot be written.
        """
        with self._lock:
            return self._record(self.review.undo(reviewer, _now()))

    def redo(self, reviewer: str) -> list[ObjectReview]:
        """Make a reviewer's last undone decision again, as `decide`.

        Raises:
            GroundingError: there is none.
            OutputError: the journal cannot be written.
        """
        with self._lock:
            return self._record(self.review.redo(reviewer, _now()))

    def _record(self, event: Event) -> list[ObjectReview]:
        self.journal.append(event, self.review.before(event))
        self.review.apply(event)
        return [self.state(change.prim_path) for change in event.changes if change.prim_path in self.predictions]

    def audit(self) -> Audit:
        """Return the random sample that is audited, and what is found so far."""
        return make_audit(self.states(), self.review.standing())

    # Learning.

    def lessons(self) -> list[Lesson]:
        """Return what the decisions teach about concepts and words."""
        return find_lessons(self.suggestions, self.review.decisions(), self.scene, self.review.standing())

    def ground_again(self) -> list[tuple[Prediction, Prediction]]:
        """Ground the open objects again with what the decisions teach; return the predictions that changed.

        The lessons are kept in the project, so that they are applied again when it is opened.

        Raises:
            GroundingError: the suggestions come from another grounder, or from an edited alignment.
            OutputError: the lessons cannot be written.
        """
        if not self._learns():
            given = self.project.sources.mapping or self.project.sources.alignment
            raise GroundingError(f"the suggestions come from {given}; only those of the built alignment can be learned")
        # Lessons that cannot be applied would keep the project from being opened again.
        tried = self.project.applied_lessons.with_suffix(".tried.tsv")
        write_whole(tried, format_lessons(self.lessons(), self.tbox).encode())
        try:
            renewed = self._ground_with_lessons(tried)
            tried.replace(self.project.applied_lessons)
        finally:
            tried.unlink(missing_ok=True)
        with self._lock:
            before = self.suggestions
            self.suggestions = self._merge_open(before, renewed)
            self._explainer = None
            after = self.suggestions
        pairs = zip(before.predictions, after.predictions, strict=True)
        return [(old, new) for old, new in pairs if old.class_iri != new.class_iri]

    def apply_kept_lessons(self) -> None:
        """Apply the lessons that `ground_again` has kept in the project, if there are any."""
        if self.project.applied_lessons.exists() and self._learns():
            renewed = self._ground_with_lessons(self.project.applied_lessons)
            self.suggestions = self._merge_open(self.suggestions, renewed)

    def _learns(self) -> bool:
        """Return whether the suggestions come from the alignment that is built, which lessons can change."""
        return self.project.sources.mapping is None and self.project.sources.alignment is None

    def _ground_with_lessons(self, lessons: Path) -> Grounding:
        """Return the grounding of the open objects by the alignment and the lessons of a file."""
        decided = self.review.decisions()
        grounder = make_grounder("lexical", alignment=lessons)
        still_open = [p.prim_path for p in self.suggestions.predictions if p.prim_path not in decided]
        return ground(self.scene, self.tbox, grounder, paths=still_open)

    def _merge_open(self, before: Grounding, renewed: Grounding) -> Grounding:
        """Return a grounding with the renewed predictions of the objects that are still open.

        A decided object keeps what was suggested when a person decided, so that a correction stays one.
        """
        decided = self.review.decisions()
        predictions = tuple(
            p if p.prim_path in decided else renewed.by_path.get(p.prim_path, p) for p in before.predictions
        )
        return replace(before, predictions=predictions, concepts={**renewed.concepts, **before.concepts})

    # What follows.

    def grounding(self) -> Grounding:
        """Return the grounding with all decisions; an audit calibrates the confidences of the open objects."""
        decided = apply_decisions(self.suggestions, self.review.decisions(), self.scene, self.tbox)
        scaling = fit_audit(self.audit())
        if scaling is None:
            return decided
        predictions = tuple(
            p if p.confidence is None or p.status is Status.REVIEWED else replace(p, confidence=scaling(p.confidence))
            for p in decided.predictions
        )
        return replace(decided, predictions=predictions, is_calibrated=True)

    def graph(self) -> KnowledgeGraph:
        """Return the graph of the current decisions; it is built when it is first needed after a decision."""
        with self._graph_lock:
            suggestions, version = self.suggestions, self.version
            if self._graph is None or self._graph[0] is not suggestions or self._graph[1] != version:
                self._graph = suggestions, version, self._make_graph(self.grounding())
            return self._graph[2]

    def _make_graph(self, grounding: Grounding) -> KnowledgeGraph:
        # What a person says an object is decides what it may hold and bear.
        self.relations = find_relations(self.scene, self.tbox, grounding)
        return instantiate(self.scene, self.tbox, grounding, base=self.base, relations=self.relations)

    def answers(self) -> GraphStore:
        """Return the graph of the current decisions, to be queried."""
        graph = self.graph()
        with self._graph_lock:
            if self._answers is None or self._answers[0] is not graph:
                self._answers = graph, GraphStore.from_triples(graph.triples, self.scene.source)
            return self._answers[1]

    @cached_property
    def label_stage(self) -> Any:
        """The stage that labels are written over; it stays open.

        OpenUSD never frees the Python objects of the layers of a closed stage.
        """
        assert self.stage is not None, "a graph without a stage has no label layer"
        return open_stage(self.stage, ReadOptions()).stage

    @property
    def last_answers(self) -> GraphStore | None:
        """The graph that was last built to be queried, possibly of earlier decisions; None if there is none yet."""
        return self._answers[1] if self._answers is not None else None

    def close(self) -> None:
        """Close the journal."""
        self.journal.close()


def open_stage_session(project: Project) -> StudioSession:
    """Read, ground and relate the stage of a project.

    Raises:
        Usd2kgError: a source cannot be read.
    """
    sources = project.sources
    scene = read_scene(sources.scene, options=sources.reading)
    stated = stated_places(project.journal, sources.mapping, sources.second_mapping)
    tbox = open_tbox(sources.ontology, scene, stated=stated)
    if sources.mapping is not None:
        grounding = _read_mapping(sources.mapping, scene, tbox)
    else:
        grounding = ground(scene, tbox, make_grounder("lexical", alignment=sources.alignment))
    second = _read_mapping(sources.second_mapping, scene, tbox) if sources.second_mapping is not None else None
    session = StudioSession(project, scene, tbox, grounding, find_relations(scene, tbox, grounding), second=second)
    session.apply_kept_lessons()
    return session


def _by_object(relations: Iterable[Relation]) -> dict[str, list[Relation]]:
    """Return prim path → relations of which it is the target or an anchor."""
    found: dict[str, list[Relation]] = {}
    for relation in relations:
        for path in dict.fromkeys((relation.target, relation.anchor, relation.other_anchor)):
            if path is not None:
                found.setdefault(path, []).append(relation)
    return found


def _read_mapping(file: Path, scene: Scene, tbox: TBox) -> Grounding:
    found = read_grounding(file)
    paths, known = [obj.prim_path for obj in scene.objects], found.by_path
    missing = [path for path in paths if path not in known]
    unknown = [p.class_iri for p in found.predictions if p.class_iri and p.class_iri not in tbox.by_iri]
    if missing or unknown:
        problem = f"has no row for {missing[0]}" if missing else f"names the class {unknown[0]}, which is not in scope"
        raise GroundingError(f"{file}: {problem}; expected a grounding of this scene with this ontology")
    return replace(found, predictions=tuple(known[path] for path in paths))


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="milliseconds")
