"""GraphSession: a studio on a knowledge graph instead of a stage."""

from collections import Counter
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import NamedTuple

from usd2kg.errors import GroundingError, SceneError
from usd2kg.graph import KnowledgeGraph, individual_iri
from usd2kg.graph.document_prefixes import document_prefixes
from usd2kg.graph.revise import revise_classes
from usd2kg.grounding import Grounding, Prediction
from usd2kg.grounding.lexical.candidate_evidence import CandidateEvidence
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.pipeline import open_tbox
from usd2kg.scene import ReadOptions
from usd2kg.scene.stage import open_stage
from usd2kg.studio.graph_scene import GraphScene, read_graph_scene
from usd2kg.studio.project import Project
from usd2kg.studio.session import StudioSession

__all__ = ["FoundStage", "GraphSession", "open_graph_session"]

_GROUND_AGAIN = "A graph does not state the evidence for classes. To ground again, open the stage."


class FoundStage(NamedTuple):
    """The stage of a graph."""

    path: Path | None
    """None if it is not there, or is another version."""
    note: str
    """What was found, for people."""


class GraphSession(StudioSession):
    """A graph under review: decisions change what it states about classes; all else stays as in the file."""

    def __init__(self, project: Project, read: GraphScene, tbox: TBox, found: FoundStage) -> None:
        super().__init__(project, read.scene, tbox, read.grounding, read.relations, base=read.base)
        self._read = read
        self.stage = found.path
        self.stage_note = found.note
        missing = {} if found.path is not None else {"meshes": found.note, "labels": found.note}
        self.limits = {"reground": _GROUND_AGAIN, **missing}

    def evidence(
        self, prim_path: str, candidates: Iterable[ClassIRI]
    ) -> Mapping[ClassIRI, tuple[CandidateEvidence, ...]]:
        """Return nothing, since a graph does not state the evidence."""
        del prim_path, candidates
        return {}

    def ground_again(self) -> list[tuple[Prediction, Prediction]]:
        """Refuse, since a graph does not state the evidence.

        Raises:
            GroundingError: always.
        """
        raise GroundingError(_GROUND_AGAIN)

    def _learns(self) -> bool:
        return False

    def _make_graph(self, grounding: Grounding) -> KnowledgeGraph:
        """Return the graph of the file with the classes of a grounding; its relations are those of the file."""
        revised = {
            individual_iri(self.base, p.prim_path): p
            for p in grounding.predictions
            if p is not self.predictions[p.prim_path]
        }
        statements = self._read.statements
        if revised:
            statements = revise_classes(
                statements,
                {iri: self.predictions[p.prim_path] for iri, p in revised.items()},
                revised,
                self.tbox,
                run=individual_iri(self.base, "/", "run"),
                annotations=self._read.style.annotations,
            )
        counts = Counter(p.class_iri for p in grounding.predictions if p.class_iri)
        return KnowledgeGraph(
            iri=self._read.iri or self.base.rstrip("#/"),
            base=self.base,
            profile=self._read.style.profile,
            imports=self._read.imports,
            triples=statements,
            prefixes={**document_prefixes(self.tbox), "": self.base},
            relations=self.relations,
            individuals=len(self.scene.objects),
            classes=dict(sorted(counts.items())),
        )


def open_graph_session(project: Project) -> GraphSession:
    """Read the graph of a project.

    Raises:
        Usd2kgError: it cannot be read, or has classes that the ontology lacks.
    """
    sources = project.sources
    given = next((name for name in ("mapping", "alignment", "base") if getattr(sources, name) is not None), None)
    if given is not None:
        raise GroundingError(f"--{given}: {sources.scene} is a graph, which states its own; open the stage to use it")
    read = read_graph_scene(sources.scene)
    classes = {p.class_iri for p in read.grounding.predictions if p.class_iri is not None}
    tbox = open_tbox(sources.ontology, stated={*read.imports, read.grounding.ontology, *classes})
    unknown = next((p for p in read.grounding.predictions if p.class_iri and p.class_iri not in tbox.by_iri), None)
    if unknown is not None:
        ontology = read.grounding.ontology or "another ontology"
        raise GroundingError(
            f"{sources.scene}: {unknown.prim_path} has the class {unknown.class_iri}, which is not in scope of "
            f"{tbox.source}; the graph was built with {ontology}: name its file with --ontology"
        )
    return GraphSession(project, read, tbox, _find_stage(sources.scene, read, sources.reading))


def _find_stage(graph: Path, read: GraphScene, reading: ReadOptions) -> FoundStage:
    """Look for the stage of a graph beside it and in the current folder.

    The name comes from the graph, so only its last part counts, and the content has to be the one that was read.
    """
    name = Path(read.stage_name.replace("\\", "/")).name
    if not name:
        return FoundStage(None, "The graph does not name its stage, so there are boxes instead of meshes.")
    places = dict.fromkeys((graph.parent / name, Path(name)))
    there = next((place for place in places if place.is_file()), None)
    if there is None:
        return FoundStage(
            None, f"The stage {name} is not beside the graph, so there are boxes instead of meshes, and no labels."
        )
    try:
        is_same = open_stage(there, reading).content_hash == read.scene.content_hash
    except SceneError as error:
        return FoundStage(None, f"The stage {there} cannot be read ({error}), so there are boxes instead of meshes.")
    if not is_same:
        return FoundStage(
            None, f"The stage {there} has changed since the graph was built, so there are boxes instead of meshes."
        )
    return FoundStage(there, f"Meshes come from the stage {there}, from which the graph was built.")
