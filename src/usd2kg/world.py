"""open: a stage, a graph file or a store → World, which answers questions."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

from usd2kg.assistant import InterpretedAnswer, ask_offline
from usd2kg.convert import SCENE_ENDINGS, is_stage
from usd2kg.errors import GraphError
from usd2kg.graph import (
    GRAPH_FORMATS,
    RDF_FORMATS,
    GraphDocument,
    GraphPart,
    KnowledgeGraph,
    read_document,
    write_graph,
)
from usd2kg.graph.vocabulary import PREFIXES
from usd2kg.grounding import Grounding
from usd2kg.pipeline import BuildResult, build
from usd2kg.progress import show_steps
from usd2kg.query import Answer, GraphStore, load_graph
from usd2kg.query.body_table import Body
from usd2kg.query.lookup import SceneFacts
from usd2kg.rich_display import RichDisplay
from usd2kg.scene import Scene
from usd2kg.stores import is_store, open_graph, open_store

__all__ = ["ObjectRow", "World", "open"]

_RELATIONS = {"on": "on", "inside": "in", "attached": "attached to", "part": "part of"}
"""Relation of `SceneFacts` → words before the name of the anchor."""


class ObjectRow(NamedTuple):
    """One object of a graph; lengths are metres, along the world axes."""

    name: str
    class_label: str | None
    """Label of its class, or of several, separated by commas; None without one."""
    confidence: float | None
    """Confidence in the class, from 0 to 1; None if the graph states none."""
    size_x: float | None
    """None without a box."""
    size_y: float | None
    size_z: float | None
    relations: str
    """What it is on, in, attached to and part of, separated by commas; empty if nothing is stated."""
    path: str
    """Prim path."""


@dataclass(frozen=True)
class World(RichDisplay):
    """The graph of a scene, built or loaded, with its questions."""

    source: str
    """The stage, graph file or store that was opened."""
    store: GraphStore = field(repr=False)
    """The graph with its ready questions: `on`, `where_is`, `near` and others."""
    built: BuildResult | None = field(default=None, repr=False)
    """The results of all steps, for `usd2kg.to_tables`; None for a loaded graph."""

    @property
    def scene(self) -> Scene | None:
        """The scene that was read; None for a loaded graph."""
        return None if self.built is None else self.built.scene

    @property
    def grounding(self) -> Grounding | None:
        """The classes with their explanations and candidates; None for a loaded graph."""
        return None if self.built is None else self.built.grounding

    @property
    def graph(self) -> KnowledgeGraph | None:
        """The graph that was built; None for a loaded graph."""
        return None if self.built is None else self.built.graph

    @cached_property
    def objects(self) -> tuple[ObjectRow, ...]:
        """The objects by prim path, without rooms and other places: rows for `pandas.DataFrame`."""
        facts = self.store.facts
        return tuple(_rows(facts, facts.things))

    def first_objects(self, count: int) -> tuple[ObjectRow, ...]:
        """Return the first of `objects`, without reading the others."""
        facts = self.store.facts
        return tuple(_rows(facts, facts.things[:count]))

    def ask(self, question: str, *, since: Path | str | None = None) -> InterpretedAnswer:
        """Return the answer to a question in English, as `usd2kg ask` gives it.

        Args:
            question: such as "what is on the table?" or "how heavy is the fridge?".
            since: an older version of the scene, a graph or a stage, for questions like "what changed?".

        Raises:
            GraphError: the question or one of its words is not understood.
        """
        return ask_offline(self.store, question, None if since is None else Path(since))

    def sparql(self, query: str) -> Answer:
        """Return the answer to a SPARQL 1.1 query; prefixes and functions as for `GraphStore.sparql`.

        Raises:
            GraphError: the query does not parse, is an update, is too complex, or contacts another server.
        """
        return self.store.sparql(query)

    def save(self, path: Path | str) -> None:
        """Write the graph in the format of the file extension, see `usd2kg.write_graph`.

        A graph that was loaded from a file is read from it again, in its order and with its prefixes.

        Raises:
            GraphError: the extension is unknown, the file that was loaded is gone, or the format cannot represent the
                graph.
            OutputError: the file cannot be written.
        """
        write_graph(_document(self) if self.built is None else self.built.graph, path)


def open(source: Path | str, *, scene: str | None = None, progress: bool = False, **options: Any) -> World:
    """Return the world of a stage, whose graph is built, or of a graph, which is loaded.

    Args:
        source: a stage, a file or a folder of OBJ files that is converted to one, a graph file, the folder of a store,
            or the address of a server.
        scene: the scene of a store, by IRI, name or label; only needed if it has several.
        progress: show a bar of the steps in a notebook or on a terminal, see `usd2kg.progress.show_steps`.
        options: options of `usd2kg.build`, such as `ontology` and `grounder`; only for a stage.

    Raises:
        Usd2kgError: the source cannot be read, or an option is invalid or does not apply to it.
    """
    place = str(source)
    if is_store(place) and not (Path(place).is_dir() and is_stage(Path(place))):
        _refuse(place, options)
        with show_steps("parse", is_wanted=progress):
            return World(place, open_graph(place, _only_scene(place) if scene is None else scene))
    if scene is not None:
        raise GraphError(f"{place}: is no store; leave out scene={scene!r}, which selects one of its graphs")
    if is_stage(Path(place)):
        built = build(place, progress=progress, **options)
        return World(place, GraphStore.from_triples(built.graph.triples, place), built)
    _check_ending(Path(place))
    _refuse(place, options)
    with show_steps("parse", is_wanted=progress):
        return World(place, load_graph(place, is_indexed=True))


def _refuse(place: str, options: Mapping[str, Any]) -> None:
    if options:
        raise GraphError(f"{place}: is a graph, which is loaded and not built; leave out {', '.join(options)}")


def _only_scene(place: str) -> str | None:
    """Return the IRI of the scene of a store; None if it has no scene.

    Raises:
        GraphError: it has several. Positions of two scenes cannot be compared, so no question is about both.
    """
    scenes = [graph for graph in open_store(place).graphs() if graph.is_scene]
    if len(scenes) > 1:
        names = ", ".join(graph.name for graph in scenes[:8])
        raise GraphError(f"{place}: has {len(scenes)} scenes; expected scene= with one of them: {names}")
    return scenes[0].iri if scenes else None


def _check_ending(path: Path) -> None:
    name = path.with_suffix("") if path.suffix.lower() == ".gz" else path
    # Formats that are only written have a message of their own.
    if name.suffix.lower() not in GRAPH_FORMATS:
        expected = ", ".join((*SCENE_ENDINGS, *RDF_FORMATS))
        raise GraphError(
            f"{path}: the ending {name.suffix!r} names neither a stage nor a graph; expected the folder of a store, or "
            f"one of {expected}"
        )


def _document(world: World) -> GraphDocument:
    """Return the document of a loaded graph; a file is read again, since the store forgets order and prefixes."""
    if not is_store(world.source):
        return read_document(Path(world.source))
    triples = tuple(dict.fromkeys(sorted(world.store.dataset.triples(), key=str)))
    return GraphDocument((GraphPart("", triples),), PREFIXES, world.source)


def _rows(facts: SceneFacts, iris: Iterable[str]) -> Iterable[ObjectRow]:
    wanted = list(iris)
    confidences = facts.confidences(wanted)
    for iri in wanted:
        body = facts.body(iri)
        width, depth, height = _sides(body)
        placed = (
            f"{words} {facts.label(anchor)}"
            for relation, words in _RELATIONS.items()
            for anchor in facts.anchors(relation, iri)
        )
        yield ObjectRow(
            facts.label(iri),
            ", ".join(facts.class_labels(iri)) or None,
            confidences.get(iri),
            width,
            depth,
            height,
            ", ".join(placed),
            facts.path(iri),
        )


def _sides(body: Body) -> tuple[float, float, float] | tuple[None, None, None]:
    if body.lower is None or body.upper is None:
        return None, None, None
    width, depth, height = body.upper - body.lower
    return float(width), float(depth), float(height)
