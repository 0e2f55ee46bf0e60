"""The whole pipeline: scene + ontology → knowledge graph."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from usd2kg.errors import GroundingError
from usd2kg.graph import GraphOptions, KnowledgeGraph, instantiate, merge_imports
from usd2kg.grounding import Decision, DecisionOrigin, Grounder, Grounding, NamingRegime, ground, make_grounder
from usd2kg.grounding.built_in_choice import choose_built_in_tbox
from usd2kg.ontology import (
    PLACES_IRI,
    ClassIRI,
    TBox,
    load_home_tbox,
    load_places_tbox,
    load_tbox,
    read_closure,
)
from usd2kg.progress import show_steps
from usd2kg.relations import RelationOptions, find_relations
from usd2kg.rich_display import RichDisplay
from usd2kg.scene import ReadOptions, Scene, read_scene

__all__ = ["BuildResult", "build", "open_tbox"]


@dataclass(frozen=True)
class BuildResult(RichDisplay):
    """The result of each step."""

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
    decisions: Mapping[str, ClassIRI | Decision] | None = None,
    carried: Mapping[str, DecisionOrigin] | None = None,
    alignment: Path | str | None = None,
    base: str | None = None,
    profile: str = "auto",
    options: ReadOptions | None = None,
    graph_options: GraphOptions | None = None,
    relations: RelationOptions | None = None,
    merges_imports: bool = False,
    progress: bool = False,
) -> BuildResult:
    """Return the knowledge graph of a USD scene, with the results of all steps.

    Args:
        scene: root layer of a stage, a file that is converted to one, or a scene that is already read.
        ontology: an OWL file, `home` or `places` for a built-in TBox, or a loaded TBox; default: the built-in TBox that
            suits the scene.
        grounder: a grounder or its name.
        regime: naming regime, for evaluation.
        evidence: names of the evidence groups to use; default: all.
        paths: prims to treat as objects, regardless of the selection rules; only if the scene is read here.
        decisions: prim path → class that a person chose, alone or with the reviewer.
        carried: prim path → origin of a decision that was made for another prim path.
        alignment: edited file of `usd2kg ontology align`; only if `grounder` is the name of the lexical grounder.
        base: namespace of the individuals, ending in `/` or `#`; default: derived from the file name.
        profile: modelling pattern: auto, soma or plain.
        options: units, time code and object selection; only if the scene is read here.
        graph_options: annotations, colours and time stamp of the graph.
        relations: kinds, rules and viewpoint of spatial relations; default: the default kinds with the built-in rules.
        merges_imports: include the ontology, its imports and the usd2kg vocabulary in the graph.
        progress: show a bar of the steps in a notebook or on a terminal, see `usd2kg.progress.show_steps`.

    Raises:
        Usd2kgError: an input cannot be read, or an option is invalid.
    """
    with show_steps("read", "ontology", "ground", "relate", "instantiate", is_wanted=progress):
        read = scene if isinstance(scene, Scene) else read_scene(scene, paths=paths, options=options)
        tbox = ontology if isinstance(ontology, TBox) else open_tbox(ontology, read, stated=_places_decided(decisions))
        if alignment is not None:
            grounder = _aligned_grounder(grounder, Path(alignment))
        grounding = ground(read, tbox, grounder, regime=regime, evidence=evidence, decisions=decisions, carried=carried)
        found = find_relations(read, tbox, grounding, relations)
        graph = instantiate(read, tbox, grounding, base=base, profile=profile, options=graph_options, relations=found)
        if merges_imports:
            graph = merge_imports(graph, read_closure(tbox, graph.imports))
    return BuildResult(read, tbox, grounding, graph)


def _aligned_grounder(grounder: Grounder | str, alignment: Path) -> Grounder:
    if not isinstance(grounder, str):
        raise GroundingError(f"the grounder is given as an object; expected its name to use the alignment {alignment}")
    return make_grounder(grounder, alignment=alignment)


def open_tbox(ontology: Path | str | None, *scenes: Scene, stated: Iterable[str] = ()) -> TBox:
    """Return the TBox of an OWL file, or a built-in one.

    Args:
        ontology: an OWL file, or `home` or `places`; None for the built-in TBox of what `stated` names, else of what
            suits the scenes, else of homes.
        scenes: what is to be grounded in one TBox.
        stated: IRIs of ontologies or classes that a graph, a mapping or decisions state.

    Raises:
        OntologyError: the file cannot be read or has no class in scope.
    """
    if ontology is not None:
        return load_tbox(ontology)
    named = frozenset(stated)
    if any(iri.startswith(PLACES_IRI) for iri in named):
        return load_places_tbox()
    home = load_home_tbox()
    is_home = home.ontology_iri in named or not named.isdisjoint(home.by_iri)
    return home if is_home else choose_built_in_tbox(*scenes)


def _places_decided(decisions: Mapping[str, ClassIRI | Decision] | None) -> Iterator[str]:
    """Yield the classes of places among decisions; those of homes are in both built-in TBoxes."""
    for decision in (decisions or {}).values():
        iri = decision.class_iri if isinstance(decision, Decision) else decision
        if iri is not None and iri.startswith(PLACES_IRI):
            yield iri
