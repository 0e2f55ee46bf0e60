"""Time instantiating and writing a graph, against pyoxigraph's serialiser on the same triples.

Usage: python benchmarks/graph/run.py [--without-relations] [--profile soma|plain] [OBJECTS...]

The default is 1000, 10000 and 100000 objects: tables with nine cups each, with the usual metadata of a stage. Files are
written alternately by usd2kg and pyoxigraph in one process; compare the ratio. Times are processor time on one core.
Memory is the peak of the process.
"""

import argparse
import resource
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import pyoxigraph as ox

from usd2kg.graph import KnowledgeGraph, instantiate, write_graph
from usd2kg.grounding import Candidate, Grounding, Prediction, Status
from usd2kg.ontology import TBox, load_home_tbox
from usd2kg.relations import find_relations
from usd2kg.scene import Box, MaterialDetails, Scene, SceneObject, StageFrame

CUPS = 9
PER_ROW = 100
PORCELAIN = MaterialDetails("Porcelain", "/Looks/Porcelain", base_color=(0.9, 0.9, 0.85))
UPRIGHT = (0.0, 0.0, 0.0, 1.0)


def make_scene(count: int) -> Scene:
    """Return a hall with `count` objects: tables, two metres apart, with nine cups on each."""
    objects = []
    for index in range(count):
        table, cup = divmod(index, CUPS + 1)
        x, y = 2.0 * (table % PER_ROW), 2.0 * (table // PER_ROW)
        path = f"/World/Hall_{table // 1000}/Table_{table}"
        if cup == 0:
            objects.append(_make_object(path, (x, y, 0.0), (1.0, 1.0, 0.7), 20.0))
        else:
            place = (x + 0.1 + 0.3 * (cup % 3), y + 0.1 + 0.3 * ((cup - 1) // 3), 0.7)
            objects.append(_make_object(f"{path}/Cup_{cup}", place, (0.09, 0.09, 0.1), 0.25))
    return Scene(
        source="hall.usdc",
        content_hash="sha256:0",
        frame=StageFrame("Z", 1.0, 1.0, True),
        time=None,
        prim_count=count,
        objects=tuple(objects),
        left_out={},
    )


def _make_object(path: str, lower: tuple[float, ...], size: tuple[float, ...], mass: float) -> SceneObject:
    (x0, y0, z0), (x1, y1, z1) = lower, (low + side for low, side in zip(lower, size, strict=True))
    name = path.rpartition("/")[2]
    box = Box((x0, y0, z0), (x1, y1, z1))
    kind = name.partition("_")[0].lower()
    return SceneObject(
        prim_path=path,
        name=name,
        type_name="Xform",
        kind="component",
        selected_by="authored kind: component",
        parent_path=None,
        box=box,
        own_box=box,
        part_boxes=(),
        position=(x0, y0, z0),
        orientation=UPRIGHT,
        mass_kg=mass,
        display_name="",
        documentation="",
        asset=(kind,),
        materials=("Porcelain",),
        parts=("geo",),
        display_color=None,
        instance_of=None,
        geometry_file=f"assets/{kind}.usdc",
        material_details=(PORCELAIN,),
    )


def make_grounding(scene: Scene, tbox: TBox) -> Grounding:
    """Return a grounding of all objects, with three alternatives each."""
    classes = {name: tbox.resolve(name) for name in ("Table", "Cup", "Glass", "Bowl", "Plate")}
    predictions = []
    for obj in scene.objects:
        name = obj.name.partition("_")[0]
        others = [iri for other, iri in classes.items() if other != name][:3]
        candidates = (Candidate(classes[name], 0.9), *(Candidate(iri, 0.1) for iri in others))
        text = f"“{name.lower()}” is the label of {name}"
        predictions.append(
            Prediction(obj.prim_path, classes[name], 0.9, Status.GROUNDED, "lexical", text, ("name",), candidates)
        )
    return Grounding(
        scene=scene.source,
        scene_hash=scene.content_hash,
        ontology=tbox.ontology_iri,
        ontology_hash=tbox.content_hash,
        grounder="lexical",
        settings={"regime": "semantic"},
        is_calibrated=True,
        tool_version="0",
        predictions=tuple(predictions),
    )


class Timed(NamedTuple):
    """A result with its processor time."""

    result: Any
    seconds: float


def timed(action: Callable[[], Any]) -> Timed:
    """Return the result of a call and its processor time in seconds."""
    start = time.process_time()
    result = action()
    return Timed(result, time.process_time() - start)


def compare_writing(graph: KnowledgeGraph, folder: Path, ending: str, rdf_format: ox.RdfFormat) -> tuple[float, float]:
    """Return the best of three serialisation times, ours and pyoxigraph's, in seconds."""
    prefixes = graph.prefixes if rdf_format == ox.RdfFormat.TURTLE else None
    own = str(folder / f"theirs{ending}")
    ours, theirs = [], []
    for _ in range(3):
        ours.append(timed(lambda: write_graph(graph, folder / f"ours{ending}")).seconds)
        theirs.append(timed(lambda: ox.serialize(graph.triples, own, format=rdf_format, prefixes=prefixes)).seconds)
    return min(ours), min(theirs)


def peak_memory() -> float:
    """Return the peak resident memory of this process in GB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / 1e9


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description="Time making and writing graphs.")
    parser.add_argument("objects", nargs="*", type=int, default=[1_000, 10_000, 100_000])
    parser.add_argument("--without-relations", action="store_true")
    parser.add_argument("--profile", default="soma")
    arguments = parser.parse_args()
    tbox = load_home_tbox()
    print(
        "objects   triples    relations s  graph s  Turtle s (own)  N-Triples s (own)  peak GB: records, graph, files"
    )
    for count in arguments.objects:
        scene = make_scene(count)
        grounding = make_grounding(scene, tbox)
        before = peak_memory()
        no_relations = arguments.without_relations
        relations = Timed((), 0.0) if no_relations else timed(lambda s=scene, g=grounding: find_relations(s, tbox, g))
        made = timed(
            lambda s=scene, g=grounding, r=relations.result: instantiate(
                s, tbox, g, profile=arguments.profile, relations=r
            )
        )
        after = peak_memory()
        with tempfile.TemporaryDirectory() as folder:
            turtle = compare_writing(made.result, Path(folder), ".ttl", ox.RdfFormat.TURTLE)
            n_triples = compare_writing(made.result, Path(folder), ".nt", ox.RdfFormat.N_TRIPLES)
        print(
            f"{count:<9} {len(made.result.triples):<10} {relations.seconds:<12.2f} {made.seconds:<8.2f} "
            f"{turtle[0]:.2f} ({turtle[1]:.2f})     {n_triples[0]:.2f} ({n_triples[1]:.2f})        "
            f"{before:.2f}, {after:.2f}, {peak_memory():.2f}"
        )


if __name__ == "__main__":
    main()
