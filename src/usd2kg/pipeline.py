"""build: the whole chain, from a scene and an ontology to a knowledge graph."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from usd2kg.graph import GraphOptions, KnowledgeGraph, instantiate, merge_imports
from usd2kg.grounding import Carried, Grounder, Grounding, NamingRegime, ground
from usd2kg.ontology import ClassIRI, TBox, load_home_tbox, load_tbox, read_closure
from usd2kg.relations import RelationOptions, find_relations
from usd2kg.scene import ReadOptions, Scene, read_scene

__all__ = ["BuildResult", "build", "open_tbox"]


@dataclass(frozen=True)
class BuildResult:
    """What each step of the chain gave."""

    scene: Scene
    tbox: TBox
    grounding: Grounding
    graph: KnowledgeGraph


def build(
    scene: Scene | Path | str,
    ontology: TBox | Path | str | None = None,
    *,
    grounder: Grounder | str = "lexical",
    regime: NamingRegime = NamingRegime.SEMANTIC,
    evidence: frozenset[str] | None = None,
    paths: Iterable[str] | None = None,
    decisions: Mapping[str, ClassIRI] | None = None,
    carried: Mapping[str, Carried] | None = None,
    base: str | None = None,
    profile: str = "auto",
    options: ReadOptions | None = None,
    graph_options: GraphOptions | None = None,
    relations: RelationOptions | None = None,
    merges_imports: bool = False,
) -> BuildResult:
    """Return the knowledge graph of a USD scene, and everything on the way to it.

    Args:
        scene: the stage's root layer, or a scene that was read before.
        ontology: an OWL file, or a TBox that was loaded before; by default the built-in home TBox.
        grounder: a grounder, or the name of one.
        regime: how names are masked; for evaluation.
        evidence: the evidence groups that may be used, all by default.
        paths: prims that are objects whatever the rules of selection say; of a scene that is still to be read.
        decisions: prim path → class for what a person has decided.
        carried: prim path → where its decision comes from, of decisions that were made about another path.
        base: IRI under which individuals lie.
        profile: how objects are written: auto, soma or plain.
        options: what is to be read differently from what the stage says; of a scene that is still to be read.
        graph_options: how the graph is written, where that is not as usual.
        relations: which spatial relations are found, and how; default: the default set by the rules that ship.
        merges_imports: whether the graph holds the ontology, all that it imports and our vocabulary, and so imports
            nothing.

    Raises:
        Usd2kgError: an input cannot be read; the message says which, and what to do.
    """
    read = scene if isinstance(scene, Scene) else read_scene(scene, paths=paths, options=options)
    tbox = ontology if isinstance(ontology, TBox) else open_tbox(ontology)
    grounding = ground(read, tbox, grounder, regime=regime, evidence=evidence, decisions=decisions, carried=carried)
    found = find_relations(read, tbox, grounding, relations)
    graph = instantiate(read, tbox, grounding, base=base, profile=profile, options=graph_options, relations=found)
    if merges_imports:
        graph = merge_imports(graph, read_closure(tbox, graph.imports))
    return BuildResult(read, tbox, grounding, graph)


def open_tbox(ontology: Path | str | None) -> TBox:
    """Return the TBox of an OWL file, or the built-in one if none is named.

    Raises:
        OntologyError: the file cannot be read or has no class in scope.
    """
    return load_tbox(ontology) if ontology is not None else load_home_tbox()
