"""find_colors: the colours of the objects in a picture of a scene."""

from pathlib import Path
from typing import TYPE_CHECKING

from usd2kg.cli.options.coloring import ColorOptions
from usd2kg.cli.output import count_noun, notify

if TYPE_CHECKING:
    from usd2kg.diagrams import Coloring, ColorMode
    from usd2kg.scene import ReadOptions

__all__ = ["find_colors"]


def find_colors(source: Path, reading: "ReadOptions", mode: "ColorMode", options: ColorOptions) -> "Coloring":
    """Ground the objects of a scene with the lexical grounder and return their colours.

    Raises:
        Usd2kgError: the scene, the ontology or the decisions cannot be read, or the question is not understood.
    """
    from usd2kg.diagrams import ColorMode, color_by_answer, color_scene  # noqa: PLC0415 - loads OpenUSD
    from usd2kg.grounding import apply_decisions, ground, make_grounder, read_decisions  # noqa: PLC0415
    from usd2kg.grounding.built_in_choice import stated_places  # noqa: PLC0415
    from usd2kg.pipeline import open_tbox  # noqa: PLC0415
    from usd2kg.progress import show_steps  # noqa: PLC0415
    from usd2kg.relations import find_relations  # noqa: PLC0415
    from usd2kg.scene import read_scene  # noqa: PLC0415

    with show_steps("read", "ground", "relate"):
        scene = read_scene(source, options=reading)
        tbox = open_tbox(options.ontology, scene, stated=stated_places(options.decisions))
        decisions = read_decisions(options.decisions, tbox) if options.decisions is not None else {}
        suggestions = ground(scene, tbox, make_grounder("lexical"))
        grounding = apply_decisions(suggestions, decisions, scene, tbox)
        relations = find_relations(scene, tbox, grounding)
    if mode is not ColorMode.ANSWER:
        return color_scene(mode, tbox, grounding, suggestions, relations)
    from usd2kg.assistant import ask_offline  # noqa: PLC0415
    from usd2kg.graph import instantiate  # noqa: PLC0415
    from usd2kg.query import GraphStore, find_prim_paths  # noqa: PLC0415

    graph = instantiate(scene, tbox, grounding, relations=relations)
    asked = ask_offline(GraphStore.from_triples(graph.triples, scene.source), options.ask or "")
    found = find_prim_paths(asked.answer, graph.base, scene.by_path)
    notify(f"understood as: {asked.understood}; {count_noun(len(found), 'object')}")
    return color_by_answer([obj.prim_path for obj in scene.objects], found)
