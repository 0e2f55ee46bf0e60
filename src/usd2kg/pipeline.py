"""build: the whole chain, from a scene and an ontology to a knowledge graph."""

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from usd2kg.graph import KnowledgeGraph, RelationOptions, instantiate
from usd2kg.grounding import Grounder, Grounding, ground
from usd2kg.ontology import TBox, load_home_tbox, load_tbox
from usd2kg.scene import NamingRegime, ReadOptions, Scene, read_scene

__all__ = ["BuildResult", "build", "open_tbox"]


@dataclass(frozen=True)
class BuildResult:
    """What each step of the chain gave."""

    scene: Scene
    tbox: TBox
    grounding: Grounding
    graph: KnowledgeGraph


def build(
    scene: Path | str,
    ontology: TBox | Path | str | None = None,
    *,
    grounder: Grounder | str = "embedded",
    regime: NamingRegime = NamingRegime.SEMANTIC,
    evidence: frozenset[str] | None = None,
    paths: Iterable[str] | None = None,
    base: str | None = None,
    profile: str = "auto",
    options: ReadOptions | None = None,
    relations: RelationOptions | None = None,
) -> BuildResult:
    """Return the knowledge graph of a USD scene, and everything on the way to it.

    Args:
        scene: the stage's root layer.
        ontology: an OWL file, or a TBox that was loaded before; by default the built-in home TBox.
        grounder: a grounder, or the name of one.
        regime: how names are masked; for evaluation.
        evidence: the evidence groups that may be used, all by default.
        paths: prims that are objects whatever the rules of selection say.
        base: IRI under which individuals lie.
        profile: how objects are written: auto, soma or plain.
        options: what is to be read differently from what the stage says.
        relations: which spatial relations are found, and how; default: the default set by the rules that ship.

    Raises:
        Usd2kgError: an input cannot be read; the message says which, and what to do.
    """
    read = read_scene(scene, paths=paths, options=options)
    tbox = ontology if isinstance(ontology, TBox) else open_tbox(ontology)
    grounding = ground(read, tbox, grounder, regime=regime, evidence=evidence)
    graph = instantiate(read, tbox, grounding, base=base, profile=profile, relations=relations)
    return BuildResult(read, tbox, grounding, graph)


def open_tbox(ontology: Path | str | None) -> TBox:
    """Return the TBox of an OWL file, or the built-in one if none is named.

    Raises:
        OntologyError: the file cannot be read or has no class in scope.
    """
    return load_tbox(ontology) if ontology is not None else load_home_tbox()
